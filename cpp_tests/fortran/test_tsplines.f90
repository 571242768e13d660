! Skins and T-splines from Fortran: rows one after another, curves and knots counted from 1.
program test_tsplines
  use, intrinsic :: iso_fortran_env, only: real64
  use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
  use planish
  use checks
  implicit none
  !> Points of the rows of `vault()`.
  integer, parameter :: counts(4) = [5, 9, 7, 12]
  !> Coordinates are at most 3 and a value is a sum of 16 products: some hundred roundings of that size.
  real(real64), parameter :: roundoff = 1000 * epsilon(1.0_real64)
  integer :: times = 0

  call rows_are_skinned()
  call rows_count_from_1()
  call tangents_are_kept()
  call slopes_are_kept()
  call planes_have_rows_too()
  call curves_are_skinned()
  call tsplines_have_parts()
  call knots_go_in_and_out()
  call rows_are_taken_from_meshes()
  call strips_are_written()
  call refusals_are_told()
  call finish()

contains

  !> Half circles of rising radius, row after row, so near to one another that a row turned round is noticed.
  function vault() result(points)
    real(real64) :: points(3, sum(counts)), angle
    integer :: row, k, n
    n = 0
    do row = 1, size(counts)
      do k = 1, counts(row)
        angle = acos(-1.0_real64) * (k - 1) / (counts(row) - 1)
        points(:, n + k) = [(1 + 0.1_real64 * row**2) * cos(angle), 0.5_real64 * row, sin(angle)]
      end do
      n = n + counts(row)
    end do
  end function

  function skinned_vault() result(surface)
    type(planish_surface_t) :: surface
    call planish_tspline_skin(vault(), counts, surface)
  end function

  !> Values on an even grid over the unit square.
  function sampled(surface) result(values)
    class(planish_surface_t), intent(in) :: surface
    real(real64) :: values(3, 11, 11)
    integer :: i
    call surface%eval_grid([(0.1_real64 * i, i=0, 10)], [(0.1_real64 * i, i=0, 10)], values)
  end function

  !> The straight curve from one point to another over 0 to 1.
  function line(from, to) result(curve)
    real(real64), intent(in) :: from(:), to(:)
    type(planish_curve_t) :: curve
    call curve%new(1, [0, 0, 1, 1] * 1.0_real64, reshape([from, to], [size(from), 2]))
  end function

  !> The same as a cubic.
  function cubic_line(from, to) result(curve)
    real(real64), intent(in) :: from(:), to(:)
    type(planish_curve_t) :: curve
    call curve%new(3, [0, 0, 0, 0, 1, 1, 1, 1] * 1.0_real64, &
        reshape([from, (2 * from + to) / 3, (from + 2 * to) / 3, to], [size(from), 4]))
  end function

  logical function count_on(fraction, error)
    real(real64), intent(in) :: fraction, error
    times = times + 1
    count_on = fraction >= 0 .and. (ieee_is_nan(error) .or. error >= 0)
  end function

  subroutine rows_are_skinned()
    type(planish_surface_t) :: surface
    type(planish_skin_options) :: options
    type(planish_fit_report) :: report
    type(planish_skin_report) :: skin
    real(real64) :: points(3, sum(counts)), uv(2, sum(counts)), errors(sum(counts)), values(3, sum(counts))
    points = vault()
    options%tolerance = 1e-4_real64
    options%certify = 1
    options%compare = 1
    call planish_tspline_skin(points, counts, surface, options, report, skin, parameters=uv, errors=errors, &
        progress=count_on)
    call check(surface%kind() == PLANISH_KIND_TSPLINE .and. surface%dim() == 3, "a T-spline in space")
    call check(report%max_error <= report%tolerance, "the tolerance is kept")
    call check(maxloc(errors, 1) == report%worst_index, "worst_index counts from 1")
    call surface%eval(uv, values)
    call check(maxval(abs(norm2(values - points, 1) - errors)) <= roundoff, "errors are those at parameters")
    call check(all(uv(2, :counts(1)) == 0) .and. all(uv(2, sum(counts(:3)) + 1:) == 1), "v runs across the rows")
    call check(skin%curve_count == planish_tspline_curve_count(surface), "curve_count")
    call check(skin%tensor_count >= surface%coefficient_count() .and. skin%common_count > 0, "counts to compare")
    call check(.not. ieee_is_nan(skin%certified_distance), "a distance is certified where asked")
    call check(times > 0, "progress is heard")
  end subroutine

  subroutine rows_count_from_1()
    type(planish_surface_t) :: surface
    type(planish_skin_report) :: skin
    type(planish_skin_options) :: options
    type(planish_fit_report) :: report
    real(real64) :: points(3, sum(counts)), turned(3, sum(counts))
    integer :: stat
    points = vault()
    call planish_tspline_skin(points, counts, surface, skin_report=skin)
    call check(skin%twisted_row == 0, "no row is twisted")
    turned = points
    turned(:, 6:14) = points(:, 14:6:-1)
    call planish_tspline_skin(turned, counts, surface, report=report, skin_report=skin, stat=stat)
    call check(stat >= 0 .and. skin%twisted_row == 2, "the second row is twisted")
    call check(iand(report%remarks, PLANISH_REMARK_TWISTED_ROWS) /= 0, "and the report says so")
    options%align = 1
    call planish_tspline_skin(turned, counts, surface, options, skin_report=skin)
    call check(skin%aligned_row_count > 0 .and. skin%twisted_row == 0, "rows are turned round where asked")
    call planish_tspline_skin(points, [5, 9, 7, 0], surface, stat=stat)
    call check(stat == PLANISH_STATUS_INVALID_ARGUMENT, "the counts are those of the points")
    call planish_tspline_skin(points, [5, 0, 9, 19], surface, stat=stat)
    call check(stat == PLANISH_STATUS_INVALID_ARGUMENT .and. planish_error_index() == 2, "the second row is empty")
  end subroutine

  !> A vault that begins and ends upright, whatever the rows between say.
  subroutine tangents_are_kept()
    type(planish_surface_t) :: surface
    real(real64) :: begin_tangents(3, counts(1)), end_tangents(3, counts(4)), out(3, 3, 2)
    begin_tangents = spread([0, 0, 1] * 1.0_real64, 2, counts(1))
    end_tangents = spread([0, 0, 1] * 1.0_real64, 2, counts(4))
    call planish_tspline_skin(vault(), counts, surface, begin_tangents=begin_tangents, end_tangents=end_tangents)
    call surface%eval_derivatives(reshape([0, 0, 1, 1] * 1.0_real64, [2, 2]), 1, out)
    call check(all(abs(out(:2, 3, :)) <= roundoff * norm2(out(:, 3, 1))) .and. all(out(3, 3, :) > 0), &
        "Sv at the corners is upright")
  end subroutine

  subroutine slopes_are_kept()
    type(planish_surface_t) :: surface
    type(planish_skin_options) :: options
    real(real64) :: slopes(3, 2, size(counts)), out(3, 3, 1)
    slopes = spread(spread([0, 0, 1] * 1.0_real64, 2, 2), 3, size(counts))
    slopes(3, 2, :) = -1
    options%ends = PLANISH_SECTION_ENDS_SLOPES
    options%tolerance = 1e-4_real64
    call planish_tspline_skin(vault(), counts, surface, options, end_slopes=slopes)
    call surface%eval_derivatives(reshape([0, 0] * 1.0_real64, [2, 1]), 1, out)
    ! the control points next to the end are interpolated, not fitted
    call check(norm2(out(:2, 2, 1)) <= 1e-2_real64 * out(3, 2, 1), "Su at the begin goes up")
  end subroutine

  subroutine planes_have_rows_too()
    type(planish_surface_t) :: surface
    real(real64) :: points(3, sum(counts))
    points = vault()
    call planish_tspline_skin(points(1:2, :), counts, surface)
    call check(surface%dim() == 2, "the first extent is the number of coordinates")
  end subroutine

  !> Three parallel lines make a plane.
  subroutine curves_are_skinned()
    type(planish_surface_t) :: surface
    type(planish_curve_t) :: lines(3)
    type(planish_fit_report) :: report
    type(planish_skin_report) :: skin
    real(real64) :: value(3, 1), up(3, 2)
    integer :: i, stat
    character(100) :: errmsg
    do i = 1, 3
      lines(i) = line([0, i - 1, 0] * 1.0_real64, [2, i - 1, 0] * 1.0_real64)
    end do
    call planish_tspline_skin_curves(lines, surface, report=report, skin_report=skin)
    call check(report%max_error <= roundoff .and. skin%twisted_row == 0, "lines are exact")
    call surface%eval(reshape([0.25_real64, 0.75_real64], [2, 1]), value)
    call check(all(abs(value(:, 1) - [0.5_real64, 1.5_real64, 0.0_real64]) <= roundoff), "a plane over three lines")
    up = spread([0, 0, 1] * 1.0_real64, 2, 2)
    call planish_tspline_skin_curves(lines, surface, begin_tangents=up, end_tangents=-up)
    call surface%eval(reshape([0.5_real64, 0.25_real64], [2, 1]), value)
    call check(value(3, 1) > 0, "tangents lift it")
    call planish_tspline_skin_curves(lines, surface, begin_tangents=vault(), stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INVALID_ARGUMENT, "begin_tangents is 33, not 2")
    call planish_tspline_skin_curves(lines(:1), surface, stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INVALID_ARGUMENT, "")
    lines(2) = line([0.0_real64], [1.0_real64])
    call planish_tspline_skin_curves(lines, surface, stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INVALID_ARGUMENT, "")
    call check(planish_error_index() == 2, "curves count from 1")
  end subroutine

  subroutine tsplines_have_parts()
    type(planish_surface_t) :: surface, again, tensor
    type(planish_curve_t), allocatable :: curves(:)
    real(real64), allocatable :: knots(:)
    integer :: i, stat
    character(100) :: errmsg
    surface = skinned_vault()
    allocate (knots(planish_tspline_knot_count(surface)), curves(planish_tspline_curve_count(surface)))
    call planish_tspline_copy_knots(surface, knots)
    call check(size(knots) == size(curves) + 4, "knots and curves")
    do i = 1, size(curves)
      call planish_tspline_clone_curve(surface, i, curves(i))
    end do
    call planish_tspline_new(knots, curves, again)
    call check(all(sampled(again) == sampled(surface)), "its parts are all of it")
    call surface%to_tensor(tensor)
    call check(maxval(abs(sampled(tensor) - sampled(surface))) <= roundoff, "the same as a tensor surface")
    call planish_tspline_clone_curve(surface, size(curves) + 1, curves(1), stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INDEX, "")
    call planish_tspline_clone_curve(surface, 0, curves(1), stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INDEX, "count from 1")
    deallocate (curves)
  end subroutine

  subroutine knots_go_in_and_out()
    type(planish_surface_t) :: surface, same
    type(planish_curve_t) :: curves(4), curve
    real(real64) :: error
    integer :: i, stat
    do i = 1, 4
      curves(i) = cubic_line([0, i, 0] * 1.0_real64, [3, i, i] * 1.0_real64)
    end do
    call planish_tspline_new([0, 0, 0, 0, 1, 1, 1, 1] * 1.0_real64, curves, surface)
    same = surface
    call planish_tspline_insert_knot_v(same, 0.5_real64)
    call check(planish_tspline_curve_count(same) == 5, "one control curve more")
    call planish_tspline_insert_knot_u(same, 2, 0.25_real64)
    call planish_tspline_clone_curve(same, 2, curve)
    call check(curve%control_point_count() == 5, "one control point more in the second curve")
    call planish_tspline_clone_curve(same, 1, curve)
    call check(curve%control_point_count() == 4, "and none in the first")
    call check(maxval(abs(sampled(same) - sampled(surface))) <= roundoff, "the surface stays")
    call planish_tspline_remove_knot_u(same, 2, 5, roundoff, error, stat)
    call check(stat == PLANISH_STATUS_OK .and. error <= roundoff, "the fifth knot is the one inserted")
    call planish_tspline_clone_curve(same, 2, curve)
    call check(curve%control_point_count() == 4, "it is gone")
    call planish_tspline_remove_knot_u(same, 2, 5, roundoff, stat=stat)
    call check(stat == PLANISH_STATUS_INDEX, "end knots stay")
    ! the third control point of the first curve leaves the line: now its knot counts
    call curves(1)%new(3, [0.0_real64, 0.0_real64, 0.0_real64, 0.0_real64, 0.5_real64, 1.0_real64, 1.0_real64, &
        1.0_real64, 1.0_real64], reshape([0, 1, 0, 1, 1, 0, 2, 1, 5, 2, 1, 1, 3, 1, 1] * 1.0_real64, [3, 5]))
    call planish_tspline_new([0, 0, 0, 0, 1, 1, 1, 1] * 1.0_real64, curves, surface)
    same = surface
    call planish_tspline_remove_knot_u(same, 1, 5, 1e-3_real64, error, stat)
    call check(stat == PLANISH_STATUS_TOLERANCE_NOT_MET .and. error > 1e-3_real64, "a knot that is needed stays")
    call check(all(sampled(same) == sampled(surface)), "and nothing is changed")
  end subroutine

  !> A tube of radius 1 and height 2 between its two loops, with rings of `around` nodes.
  function tube(around, rings) result(mesh)
    integer, intent(in) :: around, rings
    type(planish_mesh_t) :: mesh
    real(real64) :: points(3, around * rings), angle
    integer :: triangles(3, 2 * around * (rings - 1)), ring, k, a, b, t
    t = 0
    do ring = 1, rings
      do k = 1, around
        a = (ring - 1) * around + k
        b = (ring - 1) * around + mod(k, around) + 1
        angle = 2 * acos(-1.0_real64) * k / around
        points(:, a) = [cos(angle), sin(angle), 2.0_real64 * (ring - 1) / (rings - 1)]
        if (ring == rings) cycle
        triangles(:, t + 1) = [a, b, b + around]
        triangles(:, t + 2) = [a, b + around, a + around]
        t = t + 2
      end do
    end do
    call mesh%new(points, triangles)
  end function

  subroutine rows_are_taken_from_meshes()
    type(planish_mesh_t) :: mesh
    type(planish_surface_t) :: surface
    type(planish_sample_rows_options) :: options
    type(planish_skin_options) :: skin
    type(planish_fit_report) :: report
    real(real64), allocatable :: points(:, :), upside_down(:, :)
    integer :: point_counts(6), turned_counts(6), stat
    character(100) :: errmsg
    mesh = tube(24, 9)
    times = 0
    call mesh%sample_rows(point_counts, points, progress=count_on)
    call check(times > 0, "progress is heard")
    call check(all(point_counts > 3) .and. size(points, 2) == sum(point_counts), "six rows of points")
    call mesh%sample_rows(turned_counts, upside_down, begin_index=2, end_index=1)
    ! the field is linear along a tube, but only up to the residual of its system and an edge's interpolation
    call check(abs(points(3, 1) + upside_down(3, 1) - 2) <= 1e-9_real64, "loops count from 1")
    skin%closed = 1
    skin%tolerance = 1e-2_real64
    call planish_tspline_skin(points, point_counts, surface, skin, report)
    call check(report%max_error <= report%tolerance, "rows for a skin")
    options%spacing = 0.1_real64
    call mesh%sample_rows(turned_counts, upside_down, options)
    call check(all(turned_counts > point_counts), "denser where asked")
    options%begin = PLANISH_ROW_SOURCE_NODE
    call mesh%sample_rows(turned_counts, upside_down, options, 217, 2, stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INDEX, "")
    call mesh%sample_rows(turned_counts, upside_down, begin_index=0, stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INDEX, "count from 1")
    call planish_options_init(options)
    call check(options%spacing == 0, "defaults")
  end subroutine

  subroutine strips_are_written()
    type(planish_surface_t) :: surface
    type(planish_skin_report) :: skin
    type(planish_step_options) :: options
    type(planish_step_report) :: whole, strips
    call planish_tspline_skin(vault(), counts, surface, skin_report=skin)
    call surface%write_step("vault.step", report=whole)
    call check(whole%face_count == 1 .and. whole%pole_count == skin%tensor_count, "one face")
    options%form = PLANISH_STEP_FORM_STRIPS
    call surface%write_step("vault.step", options, report=strips)
    call check(strips%face_count == 3 .and. strips%pole_count == skin%strip_count, "three strips between four rows")
  end subroutine

  subroutine refusals_are_told()
    type(planish_surface_t) :: surface, nothing
    type(planish_curve_t) :: curve
    real(real64) :: points(3, sum(counts)), knots(3)
    integer :: stat
    character(100) :: errmsg
    points = vault()
    call planish_tspline_skin(points, [5, -9], surface, stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INVALID_ARGUMENT, "less than no points")
    call planish_tspline_skin(points, counts, surface, end_slopes=reshape(points, [3, 1, 33]), stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INVALID_ARGUMENT, "the second extent of end_slopes is 1, not 2")
    call planish_tspline_skin(points, counts, surface, end_tangents=points, stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INVALID_ARGUMENT, "end_tangents is 33, not 12")
    call planish_tspline_skin(points, counts, surface, errors=knots, stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_BUFFER_TOO_SMALL, "errors has room for 3 of 33")
    call planish_tspline_skin(points(:, :0), [integer ::], surface, stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INVALID_ARGUMENT, "")
    call check(surface%kind() == PLANISH_KIND_NONE, "what is refused makes nothing")
    surface = skinned_vault()
    call planish_tspline_copy_knots(surface, knots, stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_BUFFER_TOO_SMALL, "")
    call planish_tspline_insert_knot_u(surface, 0, 0.5_real64, stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INDEX, "count from 1")
    call planish_tspline_insert_knot_v(surface, 2.0_real64, stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_OUTSIDE, "")
    call planish_tspline_remove_knot_u(surface, 1, 0, 0.0_real64, stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INDEX, "count from 1")
    call planish_tspline_insert_knot_v(nothing, 0.5_real64, stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_NULL_POINTER, "surface")
    call curve%new(3, [0, 0, 1, 1] * 1.0_real64, points(:, :2), stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INVALID_ARGUMENT, "the number of control points is 2, not 0")
    call check(planish_tspline_curve_count(nothing) == 0 .and. planish_tspline_knot_count(nothing) == 0, "none of none")
  end subroutine
end program
