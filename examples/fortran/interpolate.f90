! Fits the temperature on the nodes of a plate once, then follows a thousand probes that drift over it.
program interpolate
  use, intrinsic :: iso_fortran_env, only: real64
  use planish
  implicit none
  integer, parameter :: side = 40, probe_count = 1000, step_count = 100
  real(real64), parameter :: time_step = 0.01_real64
  type(planish_mesh_t) :: mesh
  type(planish_surface_t) :: temperature
  type(planish_tensor_options) :: fit
  type(planish_eval_options) :: eval
  type(planish_fit_report) :: report
  real(real64) :: points(3, side**2), values(side**2), uv(2, probe_count), felt(probe_count), warmest
  integer :: triangles(3, 2 * (side - 1)**2), step

  call make_plate()
  call mesh%new(points, triangles)
  call mesh%set_parameters(points(1:2, :))         ! the plate is flat: x and y are its parameters
  fit%tolerance = 1e-4_real64                      ! of the range of temperatures
  fit%regularize = PLANISH_REGULARIZE_NEVER        ! so that (u,v) stays (x,y)
  call planish_tensor_fit_field(mesh, values, temperature, fit, report)

  eval%thread_count = 1                            ! as in an MPI rank; 0 would take all cores
  call random_seed(put=spread(1, 1, 100))
  call random_number(uv)
  warmest = -huge(warmest)
  do step = 1, step_count
    call drift()
    call temperature%eval(uv, felt, eval)
    warmest = max(warmest, maxval(felt))
  end do
  print "(i0, a, es7.1, a, f0.1, a)", report%coefficient_count, " coefficients, max error ", report%max_error, &
      " K, warmest probe ", warmest, " K"

contains

  !> A unit square with a warm spot.
  subroutine make_plate()
    integer :: i, j, a, t
    t = 0
    do i = 1, side
      do j = 1, side
        a = (i - 1) * side + j
        points(:, a) = [i - 1, j - 1, 0] / real(side - 1, real64)
        values(a) = 300 + 40 * exp(-20 * sum((points(1:2, a) - 0.4_real64)**2))
        if (i == side .or. j == side) cycle
        triangles(:, t + 1) = [a, a + side, a + side + 1]
        triangles(:, t + 2) = [a, a + side + 1, a + 1]
        t = t + 2
      end do
    end do
  end subroutine

  !> Probes circle around the middle of the plate and are kept on it.
  subroutine drift()
    real(real64) :: x(probe_count), y(probe_count)
    x = uv(1, :) - 0.5_real64
    y = uv(2, :) - 0.5_real64
    uv(1, :) = min(max(uv(1, :) - time_step * y, 0.0_real64), 1.0_real64)
    uv(2, :) = min(max(uv(2, :) + time_step * x, 0.0_real64), 1.0_real64)
  end subroutine
end program
! Output: 1089 coefficients, max error 5.8E-04 K, warmest probe 340.0 K
