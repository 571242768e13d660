# Installs the library, moves the copy, and builds and runs the project beside this file against it, outside
# the tree: by find_package, by pkg-config, and as a part of the project by FetchContent; each with the shared and
# the static library.
#
# Needs BUILD (the build tree), SOURCE, SCRATCH, LIBDIR, CC, CXX, GENERATOR, BUILD_TYPE; PKG_CONFIG may be empty, and
# FC, which is for the Fortran module.
cmake_policy(VERSION 3.22)
set(here "${CMAKE_CURRENT_LIST_DIR}")
file(REMOVE_RECURSE "${SCRATCH}")
file(COPY "${here}/CMakeLists.txt" "${here}/use.c" "${here}/use.cpp" "${here}/use.f90" DESTINATION "${SCRATCH}/project")

function(run)
  execute_process(COMMAND ${ARGV} OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE failed)
  if(failed)
    string(REPLACE ";" " " command "${ARGV}")
    message(FATAL_ERROR "failed: ${command}\n${output}")
  endif()
endfunction()

set(fortran)
if(FC)
  set(fortran "-DUSE_FORTRAN=ON" "-DCMAKE_Fortran_COMPILER=${FC}")
endif()

function(build_and_test name)
  message(STATUS "${name}")
  run(${CMAKE_COMMAND} -S "${SCRATCH}/project" -B "${SCRATCH}/${name}" -G "${GENERATOR}" "-DCMAKE_C_COMPILER=${CC}"
      "-DCMAKE_CXX_COMPILER=${CXX}" "-DCMAKE_BUILD_TYPE=${BUILD_TYPE}" ${fortran} ${ARGN})
  run(${CMAKE_COMMAND} --build "${SCRATCH}/${name}")
  run(${CMAKE_CTEST_COMMAND} --test-dir "${SCRATCH}/${name}" --output-on-failure)
endfunction()

# packages must work wherever they are put later
run(${CMAKE_COMMAND} --install "${BUILD}" --prefix "${SCRATCH}/installed")
file(RENAME "${SCRATCH}/installed" "${SCRATCH}/moved")

build_and_test(find_package "-DCMAKE_PREFIX_PATH=${SCRATCH}/moved")
build_and_test(fetch_content "-DPLANISH_SOURCE=${SOURCE}")

# another minor version is another ABI
file(WRITE "${SCRATCH}/newer/CMakeLists.txt"
     "cmake_minimum_required(VERSION 3.22)\nproject(Newer NONE)\nfind_package(Planish 0.999 CONFIG REQUIRED)\n")
execute_process(
  COMMAND ${CMAKE_COMMAND} -S "${SCRATCH}/newer" -B "${SCRATCH}/newer/build" "-DCMAKE_PREFIX_PATH=${SCRATCH}/moved"
  OUTPUT_QUIET ERROR_QUIET RESULT_VARIABLE refused)
if(NOT refused)
  message(FATAL_ERROR "find_package(Planish 0.999) found another version")
endif()

if(PKG_CONFIG)
  message(STATUS "pkg_config")
  # a copy without the shared library, so that -lplanish can only be the static one
  file(COPY "${SCRATCH}/moved/" DESTINATION "${SCRATCH}/static")
  file(GLOB shared "${SCRATCH}/static/${LIBDIR}/libplanish.so*" "${SCRATCH}/static/${LIBDIR}/libplanish*.dylib")
  file(REMOVE ${shared})
  foreach(kind moved static)
    set(ENV{PKG_CONFIG_PATH} "${SCRATCH}/${kind}/${LIBDIR}/pkgconfig")
    set(static_flag)
    if(kind STREQUAL static)
      set(static_flag --static)
    endif()
    execute_process(COMMAND ${PKG_CONFIG} ${static_flag} --cflags --libs planish OUTPUT_VARIABLE flags
                    COMMAND_ERROR_IS_FATAL ANY)
    separate_arguments(flags UNIX_COMMAND "${flags}")
    set(program "${SCRATCH}/use_pkg_config_${kind}")
    run(${CC} "${SCRATCH}/project/use.c" -o "${program}" ${flags} "-Wl,-rpath,${SCRATCH}/${kind}/${LIBDIR}")
    run("${program}")
    if(FC)
      # the modules are source files beside the headers
      execute_process(COMMAND ${PKG_CONFIG} --variable=includedir planish OUTPUT_VARIABLE include
                      OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
      run(${FC} "-J${SCRATCH}" "${include}/planish_c.f90" "${include}/planish.f90" "${SCRATCH}/project/use.f90"
          -o "${program}_fortran" ${flags} "-Wl,-rpath,${SCRATCH}/${kind}/${LIBDIR}")
      run("${program}_fortran")
    endif()
  endforeach()
endif()
message(STATUS "every way works")
