! Moves a surface by a displacement on the nodes of its mesh: the moved surface is one exact spline for each factor.
program morph
  use, intrinsic :: iso_fortran_env, only: real64
  use planish
  implicit none
  integer, parameter :: side = 40, step_count = 10
  type(planish_mesh_t) :: mesh
  type(planish_field_fitter_t) :: fitter
  type(planish_surface_t) :: parts(2), moved
  real(real64) :: points(3, side**2), displacement(3, side**2), middle(3, 1), highest
  integer :: triangles(3, 2 * (side - 1)**2), step

  call make_plate()
  call mesh%new(points, triangles)
  call mesh%set_parameters(points(1:2, :))
  call fitter%new(mesh)                            ! one factorization for shape and displacement
  call fitter%fit(points, parts(1))
  call fitter%fit(displacement, parts(2))

  highest = 0
  do step = 0, step_count
    call planish_tensor_combine(parts, moved, [1.0_real64, step / real(step_count, real64)])
    call moved%eval(reshape([0.5_real64, 0.5_real64], [2, 1]), middle)
    highest = max(highest, middle(3, 1))
  end do
  print "(i0, a, i0, a, f0.3)", step_count + 1, " states of ", moved%coefficient_count(), &
      " control points, the middle rises to ", highest

contains

  !> A flat unit square, and a bulge for it.
  subroutine make_plate()
    real(real64), parameter :: pi = acos(-1.0_real64)
    integer :: i, j, a, t
    t = 0
    do i = 1, side
      do j = 1, side
        a = (i - 1) * side + j
        points(:, a) = [i - 1, j - 1, 0] / real(side - 1, real64)
        displacement(:, a) = [0.0_real64, 0.0_real64, 0.3_real64 * sin(pi * points(1, a)) * sin(pi * points(2, a))]
        if (i == side .or. j == side) cycle
        triangles(:, t + 1) = [a, a + side, a + side + 1]
        triangles(:, t + 2) = [a, a + side + 1, a + 1]
        t = t + 2
      end do
    end do
  end subroutine
end program
! Output: 11 states of 361 control points, the middle rises to .300
