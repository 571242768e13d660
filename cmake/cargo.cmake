# Drives cargo, and offers what it builds as two imported targets: Planish::planish, the shared library, and
# Planish::planish_static.
#
# One target directory serves CMake and plain cargo, so neither compiles what the other has compiled.

find_program(PLANISH_CARGO cargo HINTS "$ENV{CARGO_HOME}/bin" "$ENV{HOME}/.cargo/bin" REQUIRED)
find_program(PLANISH_RUSTC rustc HINTS "$ENV{CARGO_HOME}/bin" "$ENV{HOME}/.cargo/bin" REQUIRED)
set(PLANISH_CARGO_TARGET "" CACHE STRING "Target triple for cargo; empty builds for this machine")
set(PLANISH_CARGO_FLAGS "" CACHE STRING "More arguments for cargo build, such as --offline")
option(PLANISH_TRIM_PATHS "Keep the folders of this machine out of the library; compiles all dependencies anew" OFF)
mark_as_advanced(PLANISH_CARGO PLANISH_RUSTC)

# cargo's profile and the directory it builds in
if(CMAKE_BUILD_TYPE STREQUAL "Debug")
  set(_profile dev)
  set(_profile_dir debug)
elseif(CMAKE_BUILD_TYPE STREQUAL "RelWithDebInfo")
  set(_profile relwithdebinfo)
  set(_profile_dir relwithdebinfo)
else() # Release, MinSizeRel, and generators that decide only when they build
  set(_profile release)
  set(_profile_dir release)
endif()

set(_target_dir "${CMAKE_CURRENT_SOURCE_DIR}/target")
if(DEFINED ENV{CARGO_TARGET_DIR})
  get_filename_component(_target_dir "$ENV{CARGO_TARGET_DIR}" ABSOLUTE BASE_DIR "${CMAKE_CURRENT_SOURCE_DIR}")
endif()
set(_cargo_out "${_target_dir}/${PLANISH_CARGO_TARGET}/${_profile_dir}")
set(_target_flag)
if(PLANISH_CARGO_TARGET)
  set(_target_flag --target "${PLANISH_CARGO_TARGET}")
endif()

# File names. Before 1.0 every minor version may break the ABI, so it is part of the soname; build.rs follows
# the same rule.
if(PROJECT_VERSION_MAJOR EQUAL 0)
  set(PLANISH_ABI "0.${PROJECT_VERSION_MINOR}")
else()
  set(PLANISH_ABI "${PROJECT_VERSION_MAJOR}")
endif()
if(WIN32)
  set(PLANISH_SHARED_FILE planish.dll)
  set(PLANISH_SONAME planish.dll)
  set(_cargo_shared planish.dll)
  if(MSVC)
    set(PLANISH_STATIC_FILE planish.lib)
    set(PLANISH_IMPORT_FILE planish.dll.lib)
  else()
    set(PLANISH_STATIC_FILE libplanish.a)
    set(PLANISH_IMPORT_FILE libplanish.dll.a)
  endif()
elseif(APPLE)
  set(PLANISH_SHARED_FILE libplanish.${PROJECT_VERSION}.dylib)
  set(PLANISH_SONAME libplanish.${PLANISH_ABI}.dylib)
  set(_cargo_shared libplanish.dylib)
  set(PLANISH_STATIC_FILE libplanish.a)
else()
  set(PLANISH_SHARED_FILE libplanish.so.${PROJECT_VERSION})
  set(PLANISH_SONAME libplanish.so.${PLANISH_ABI})
  set(_cargo_shared libplanish.so)
  set(PLANISH_STATIC_FILE libplanish.a)
endif()

# cargo knows best what is out of date, so it is always asked; copy_if_different keeps dependants still
set(PLANISH_LIB_DIR "${CMAKE_CURRENT_BINARY_DIR}/lib")
set(_files "${PLANISH_LIB_DIR}/${PLANISH_SHARED_FILE}" "${PLANISH_LIB_DIR}/${PLANISH_STATIC_FILE}")
set(_commands
    COMMAND ${CMAKE_COMMAND} -E copy_if_different "${_cargo_out}/${_cargo_shared}"
            "${PLANISH_LIB_DIR}/${PLANISH_SHARED_FILE}"
    COMMAND ${CMAKE_COMMAND} -E copy_if_different "${_cargo_out}/${PLANISH_STATIC_FILE}"
            "${PLANISH_LIB_DIR}/${PLANISH_STATIC_FILE}")
if(WIN32)
  list(APPEND _files "${PLANISH_LIB_DIR}/${PLANISH_IMPORT_FILE}")
  list(APPEND _commands COMMAND ${CMAKE_COMMAND} -E copy_if_different "${_cargo_out}/${PLANISH_IMPORT_FILE}"
       "${PLANISH_LIB_DIR}/${PLANISH_IMPORT_FILE}")
else()
  set(PLANISH_LINKS "${PLANISH_SONAME}" "${_cargo_shared}") # each points to the real file
  foreach(_link IN LISTS PLANISH_LINKS)
    list(APPEND _files "${PLANISH_LIB_DIR}/${_link}")
    list(APPEND _commands COMMAND ${CMAKE_COMMAND} -E create_symlink "${PLANISH_SHARED_FILE}"
         "${PLANISH_LIB_DIR}/${_link}")
  endforeach()
endif()
separate_arguments(_more_flags NATIVE_COMMAND "${PLANISH_CARGO_FLAGS}")
set(_environment "CARGO_TARGET_DIR=${_target_dir}")
if(PLANISH_TRIM_PATHS)
  # messages of panics name the sources of dependencies, and code that they generate; the library names its own below its root
  set(_cargo_home "$ENV{HOME}/.cargo")
  if(DEFINED ENV{CARGO_HOME})
    set(_cargo_home "$ENV{CARGO_HOME}")
  endif()
  set(_rustflags "$ENV{RUSTFLAGS}")
  if(NOT _rustflags MATCHES "--remap-path-prefix") # scripts/paths has done it, and the same flags share one cache
    string(STRIP "${_rustflags} --remap-path-prefix=${_cargo_home}=/cargo --remap-path-prefix=${_target_dir}=/target" _rustflags)
  endif()
  list(APPEND _environment "RUSTFLAGS=${_rustflags}")
endif()
add_custom_target(
  planish_cargo ALL
  COMMAND ${CMAKE_COMMAND} -E env --unset=MAKEFLAGS ${_environment} ${PLANISH_CARGO} build
          --locked --package planish --lib --profile ${_profile} ${_target_flag} ${_more_flags}
  COMMAND ${CMAKE_COMMAND} -E make_directory "${PLANISH_LIB_DIR}"
  ${_commands}
  BYPRODUCTS ${_files}
  WORKING_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}"
  USES_TERMINAL VERBATIM
  COMMENT "cargo build (${_profile})")

# The command line tool needs crates that the library does not, so it is built on its own, after the library
if(PLANISH_TOOL)
  set(PLANISH_TOOL_FILE "${_cargo_out}/planish${CMAKE_EXECUTABLE_SUFFIX}")
  # the tool writes its manual and its completions itself, where it can run
  set(PLANISH_PAGES "${CMAKE_CURRENT_BINARY_DIR}/pages")
  set(_pages)
  if(NOT CMAKE_CROSSCOMPILING AND NOT WIN32)
    file(MAKE_DIRECTORY "${PLANISH_PAGES}/man1")
    set(_pages COMMAND "${PLANISH_TOOL_FILE}" manual "${PLANISH_PAGES}/man1"
               COMMAND "${PLANISH_TOOL_FILE}" completions bash > "${PLANISH_PAGES}/planish.bash"
               COMMAND "${PLANISH_TOOL_FILE}" completions zsh > "${PLANISH_PAGES}/_planish"
               COMMAND "${PLANISH_TOOL_FILE}" completions fish > "${PLANISH_PAGES}/planish.fish")
  endif()
  add_custom_target(
    planish_tool ALL
    COMMAND ${CMAKE_COMMAND} -E env --unset=MAKEFLAGS ${_environment} ${PLANISH_CARGO} build
            --locked --package planish --bin planish --features cli --profile ${_profile} ${_target_flag} ${_more_flags}
    ${_pages}
    BYPRODUCTS "${PLANISH_TOOL_FILE}"
    WORKING_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}"
    USES_TERMINAL VERBATIM
    COMMENT "cargo build of the command line tool (${_profile})")
  add_dependencies(planish_tool planish_cargo)
endif()

# What a program needs beside the static library: rustc says so for any platform
file(WRITE "${CMAKE_CURRENT_BINARY_DIR}/nothing.rs" "")
execute_process(
  COMMAND ${PLANISH_RUSTC} --crate-type staticlib --print native-static-libs ${_target_flag} -o nothing.a nothing.rs
  WORKING_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}"
  ERROR_VARIABLE _said
  RESULT_VARIABLE _failed)
if(_failed OR NOT _said MATCHES "native-static-libs: ([^\n]*)")
  message(FATAL_ERROR "rustc does not say which libraries a static library needs: ${_said}")
endif()
string(STRIP "${CMAKE_MATCH_1}" PLANISH_SYSTEM_FLAGS)
string(REPLACE " " ";" PLANISH_SYSTEM_LIBS "${PLANISH_SYSTEM_FLAGS}")

# GLOBAL, so that a parent project sees them
set(PLANISH_INCLUDE_DIR "${CMAKE_CURRENT_SOURCE_DIR}/include")
add_library(Planish::planish SHARED IMPORTED GLOBAL)
set_target_properties(
  Planish::planish
  PROPERTIES IMPORTED_LOCATION "${PLANISH_LIB_DIR}/${PLANISH_SHARED_FILE}"
             IMPORTED_SONAME "${PLANISH_SONAME}"
             INTERFACE_INCLUDE_DIRECTORIES "${PLANISH_INCLUDE_DIR}")
if(WIN32)
  set_target_properties(Planish::planish PROPERTIES IMPORTED_IMPLIB "${PLANISH_LIB_DIR}/${PLANISH_IMPORT_FILE}")
endif()
add_dependencies(Planish::planish planish_cargo)

add_library(Planish::planish_static STATIC IMPORTED GLOBAL)
set_target_properties(
  Planish::planish_static
  PROPERTIES IMPORTED_LOCATION "${PLANISH_LIB_DIR}/${PLANISH_STATIC_FILE}"
             INTERFACE_INCLUDE_DIRECTORIES "${PLANISH_INCLUDE_DIR}"
             INTERFACE_COMPILE_DEFINITIONS PLANISH_STATIC
             INTERFACE_LINK_LIBRARIES "${PLANISH_SYSTEM_LIBS}")
add_dependencies(Planish::planish_static planish_cargo)
