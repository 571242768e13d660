# Makes Planish::fortran, the Fortran module, of its source. A compiled module fits a single compiler, so every
# project compiles the source with its own: the build tree of Planish and, through find_package, its users.

function(planish_add_fortran source library)
  add_library(planish_fortran STATIC EXCLUDE_FROM_ALL "${source}")
  set(modules "${CMAKE_CURRENT_BINARY_DIR}/planish_modules")
  set_target_properties(planish_fortran PROPERTIES Fortran_MODULE_DIRECTORY "${modules}"
                                                   POSITION_INDEPENDENT_CODE ON)
  target_include_directories(planish_fortran INTERFACE "${modules}")
  target_link_libraries(planish_fortran PUBLIC ${library})
  add_library(Planish::fortran ALIAS planish_fortran)
endfunction()
