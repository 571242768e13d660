! Skins measured rows, each with as many points as it took, with one T-spline and hands it to CAD as STEP.
program skin
  use, intrinsic :: iso_fortran_env, only: real64
  use planish
  implicit none
  integer, parameter :: row_count = 14
  type(planish_surface_t) :: panel
  type(planish_skin_options) :: options
  type(planish_fit_report) :: report
  type(planish_skin_report) :: counts
  type(planish_step_options) :: step
  type(planish_step_report) :: written
  integer :: point_counts(row_count), row
  real(real64), allocatable :: points(:, :)

  point_counts = [(60 + mod(7 * row, 12), row=1, row_count)]
  allocate (points(3, sum(point_counts)))
  do row = 1, row_count
    points(:, sum(point_counts(:row - 1)) + 1:sum(point_counts(:row))) = section(row, point_counts(row))
  end do
  options%tolerance = 0.05_real64                  ! mm, since the scale is absolute
  options%tolerance_scale = PLANISH_TOLERANCE_SCALE_ABSOLUTE
  options%compare = 1                              ! what the classical skin would take
  call planish_tspline_skin(points, point_counts, panel, options, report, counts)
  step%form = PLANISH_STEP_FORM_STRIPS             ! a face between two rows has the knots that it needs
  call panel%write_step("panel.step", step, product="panel", report=written)
  print "(i0, a, es7.1, a, i0, a, i0, a, i0, a)", size(points, 2), " points, max error ", report%max_error, " mm: ", &
      report%coefficient_count, " control points (", counts%common_count, " over common knots), ", &
      written%face_count, " faces in panel.step"

contains

  !> A panel across which a bead runs aslant.
  function section(row, count) result(scan)
    integer, intent(in) :: row, count
    real(real64) :: scan(3, count)
    integer :: i
    scan(1, :) = [(300.0_real64 * (i - 1) / (count - 1), i=1, count)]
    scan(2, :) = 20 * row
    scan(3, :) = 12 * exp(-((scan(1, :) - 50 - 15 * row) / 12)**2)
  end function
end program
! Output: 915 points, max error 3.8E-02 mm: 409 control points (928 over common knots), 13 faces in panel.step
