! The same in Fortran.
program use_fortran
  use, intrinsic :: iso_fortran_env, only: real64
  use planish
  implicit none
  type(planish_surface_t) :: surface
  real(real64) :: knots(4), control_points(1, 2, 2), uv(2, 1), value(1)
  knots = [0, 0, 1, 1]
  control_points = reshape([0, 1, 1, 2], [1, 2, 2])
  uv(:, 1) = [0.25_real64, 0.5_real64]
  call planish_tensor_new(1, 1, knots, knots, control_points, surface)
  call surface%eval(uv, value)
  print "(3a, f0.2)", "planish ", planish_version(), ": ", value
  if (abs(value(1) - 0.75_real64) > 0) error stop "another value is expected"
end program
