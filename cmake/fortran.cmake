# Makes Planish::fortran, the Fortran modules, of their sources: planish_c.f90 (generated), then planish.f90. A compiled
# module fits a single compiler, so every project compiles the sources with its own: the build tree of Planish and,
# through find_package, its users.

function(planish_add_fortran raw source library)
  add_library(planish_fortran STATIC EXCLUDE_FROM_ALL "${raw}" "${source}")
  set(modules "${CMAKE_CURRENT_BINARY_DIR}/planish_modules")
  set_target_properties(planish_fortran PROPERTIES Fortran_MODULE_DIRECTORY "${modules}"
                                                   POSITION_INDEPENDENT_CODE ON)
  target_include_directories(planish_fortran INTERFACE "${modules}")
  target_link_libraries(planish_fortran PUBLIC ${library})
  add_library(Planish::fortran ALIAS planish_fortran)
endfunction()
