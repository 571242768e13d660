! Without stat an error stops the program, with the library's sentence.
program test_stop
  use planish
  implicit none
  type(planish_mesh_t) :: mesh
  call mesh%read("no such file.stl")
  print "(a)", "went on"
end program
