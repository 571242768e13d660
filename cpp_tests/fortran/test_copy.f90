! A fitter has no copies: an assignment ends the program with a sentence, before two variables own one fitter.
program test_copy
  use, intrinsic :: iso_fortran_env, only: real64
  use planish
  implicit none
  type(planish_field_fitter_t) :: fitter, copy
  call fitter%new(reshape([0, 0, 1, 0, 0, 1, 1, 1] * 1.0_real64, [2, 4]))
  copy = fitter
  print "(a)", "went on"
end program
