# Installs headers, libraries and what find_package and pkg-config need.

include(CMakePackageConfigHelpers)
set(_config_dir "${CMAKE_INSTALL_LIBDIR}/cmake/Planish")

# the Fortran modules are installed as source: a compiled one fits a single compiler
install(FILES include/planish.h include/planish.hpp include/planish.f90 bindings/planish_c.f90
        DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
        COMPONENT Development)

# PROGRAMS, because a shared library is executable; FILES copies links as links
if(WIN32)
  install(PROGRAMS "${PLANISH_LIB_DIR}/${PLANISH_SHARED_FILE}" DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT Runtime)
  install(FILES "${PLANISH_LIB_DIR}/${PLANISH_IMPORT_FILE}" DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT Development)
  set(PLANISH_SHARED_DIR "${CMAKE_INSTALL_BINDIR}")
else()
  install(PROGRAMS "${PLANISH_LIB_DIR}/${PLANISH_SHARED_FILE}" DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT Runtime)
  list(TRANSFORM PLANISH_LINKS PREPEND "${PLANISH_LIB_DIR}/" OUTPUT_VARIABLE _links)
  install(FILES ${_links} DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT Runtime)
  set(PLANISH_SHARED_DIR "${CMAKE_INSTALL_LIBDIR}")
endif()
install(FILES "${PLANISH_LIB_DIR}/${PLANISH_STATIC_FILE}" DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT Development)

if(PLANISH_TOOL)
  install(PROGRAMS "${PLANISH_TOOL_FILE}" DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT Runtime)
  if(NOT CMAKE_CROSSCOMPILING AND NOT WIN32)
    install(DIRECTORY "${PLANISH_PAGES}/man1" DESTINATION "${CMAKE_INSTALL_MANDIR}" COMPONENT Runtime)
    install(FILES "${PLANISH_PAGES}/planish.bash" DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions"
            RENAME planish COMPONENT Runtime)
    install(FILES "${PLANISH_PAGES}/_planish" DESTINATION "${CMAKE_INSTALL_DATADIR}/zsh/site-functions" COMPONENT Runtime)
    install(FILES "${PLANISH_PAGES}/planish.fish" DESTINATION "${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d"
            COMPONENT Runtime)
  endif()
endif()

# pkg-config: paths start from the file itself, so `cmake --install --prefix` and a moved tree stay right
file(RELATIVE_PATH PLANISH_PC_PREFIX "${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig" "${CMAKE_INSTALL_PREFIX}")
foreach(_kind LIBDIR INCLUDEDIR)
  if(IS_ABSOLUTE "${CMAKE_INSTALL_${_kind}}")
    set(PLANISH_PC_${_kind} "${CMAKE_INSTALL_${_kind}}")
  else()
    set(PLANISH_PC_${_kind} "\${prefix}/${CMAKE_INSTALL_${_kind}}")
  endif()
endforeach()
configure_file(cmake/planish.pc.in planish.pc @ONLY)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/planish.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig"
        COMPONENT Development)

configure_package_config_file(
  cmake/PlanishConfig.cmake.in PlanishConfig.cmake
  INSTALL_DESTINATION "${_config_dir}"
  PATH_VARS CMAKE_INSTALL_LIBDIR CMAKE_INSTALL_INCLUDEDIR PLANISH_SHARED_DIR)
# before 1.0 another minor version is another ABI
if(PROJECT_VERSION_MAJOR EQUAL 0)
  set(_compatible SameMinorVersion)
else()
  set(_compatible SameMajorVersion)
endif()
write_basic_package_version_file(PlanishConfigVersion.cmake COMPATIBILITY ${_compatible})
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/PlanishConfig.cmake" "${CMAKE_CURRENT_BINARY_DIR}/PlanishConfigVersion.cmake"
              cmake/fortran.cmake
        DESTINATION "${_config_dir}" COMPONENT Development)
