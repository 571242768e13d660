! Values and forces between meshes, and what curves can be asked, from Fortran.
program test_transfer
  use, intrinsic :: iso_fortran_env, only: real64, int8, int32
  use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_value, ieee_quiet_nan
  use planish
  use checks
  implicit none
  integer, parameter :: sources = 15**2, targets = 22**2
  !> Sums of some hundred products of numbers of about 1.
  real(real64), parameter :: roundoff = 1e5_real64 * epsilon(1.0_real64)
  real(real64), allocatable :: points(:, :), places(:, :)
  integer(int32), allocatable :: triangles(:, :), others(:, :)
  integer :: times = 0

  call make_sheet(15, points, triangles)
  call make_sheet(22, places, others)
  call options_go_back_to_defaults()
  call values_go_there_and_forces_come_back()
  call numbers_go_too()
  call masked_values_are_not_looked_at()
  call far_targets_are_told()
  call transfers_end_by_themselves()
  call refusals_are_told()
  call curves_are_interpolated_and_measured()
  call curves_are_saved()
  deallocate (points, triangles, places, others) ! valgrind counts what a main program leaves
  call finish()

contains

  function source() result(mesh)
    type(planish_mesh_t) :: mesh
    call mesh%new(points, triangles)
    call mesh%set_parameters(points(:2, :))
  end function

  logical function count_on(fraction, error)
    real(real64), intent(in) :: fraction, error
    times = times + 1
    count_on = fraction >= 0 .and. fraction <= 1 .and. (ieee_is_nan(error) .or. error >= 0)
  end function

  subroutine options_go_back_to_defaults()
    type(planish_transfer_options) :: options
    type(planish_interpolate_options) :: ends
    options%far_rule = 1
    ends%ends = 3
    call planish_options_init(options)
    call planish_options_init(ends)
    call check(options%far_rule == PLANISH_FAR_RULE_REFUSE .and. ends%ends == 0, "defaults")
  end subroutine

  subroutine values_go_there_and_forces_come_back()
    type(planish_transfer_t) :: transfer
    type(planish_field_options) :: field
    type(planish_transfer_report) :: report
    type(planish_balance_report) :: balance
    real(real64) :: values(2, sources), out_values(2, targets), forces(3, targets), back(3, sources)
    real(real64) :: uv(2, targets), distances(targets)
    field%grid_u = 9
    field%grid_v = 11
    call transfer%new(source(), places, field=field, progress=count_on, report=report)
    call check(times > 0, "progress is heard")
    call check(report%grid_u == 9 .and. report%grid_v == 11, "the grid asked for")
    call check(transfer%source_count() == sources .and. transfer%target_count() == targets, "counts")
    call transfer%copy_parameters(uv)
    call transfer%copy_distances(distances)
    call check(maxval(distances) == distances(report%farthest_index), "farthest_index counts from 1")
    call check(maxval(distances) == report%max_distance .and. report%far_count == 0, "distances")
    call check(all(abs(uv - places(:2, :)) <= 0.1_real64), "the parameters are x and y, nearly")
    values(1, :) = 7
    values(2, :) = points(1, :)
    call transfer%apply(values, out_values)
    call check(all(abs(out_values(1, :) - 7) <= roundoff), "constants stay")
    call check(all(abs(out_values(2, :) - places(1, :)) <= report%max_distance + roundoff), "so do positions, nearly")
    forces(1, :) = places(2, :)
    forces(2, :) = -places(1, :)
    forces(3, :) = 1
    call transfer%apply_transpose(forces, back)
    call check(all(abs(sum(back, 2) - sum(forces, 2)) <= 1e-12_real64 * targets), "forces stay")
    call transfer%balance(points, forces, balance, [1.0_real64, 0.0_real64, 0.0_real64])
    call check(balance%force_error <= 1e-12_real64 .and. balance%work_error <= 1e-12_real64, "balanced")
    call check(all(abs(balance%force_given - sum(forces, 2)) <= roundoff), "a vector of the report")
    call check(balance%moment_error <= balance%moment_bound + roundoff, "moments to the distance")
  end subroutine

  subroutine numbers_go_too()
    type(planish_transfer_t) :: transfer
    real(real64) :: values(2, sources), rows(2, targets), out(targets), back(sources), row_back(1, sources)
    call transfer%new(source(), places)
    values(1, :) = sin(3 * points(1, :))
    values(2, :) = 0
    call transfer%apply(values, rows)
    call transfer%apply(values(1, :), out)
    call check(all(abs(out - rows(1, :)) <= roundoff), "numbers as rows")
    call transfer%apply_transpose(out, back)
    call transfer%apply_transpose(reshape(out, [1, targets]), row_back)
    call check(all(back == row_back(1, :)), "numbers as rows, back")
  end subroutine

  subroutine masked_values_are_not_looked_at()
    type(planish_transfer_t) :: transfer
    real(real64) :: values(sources), out(targets), back(sources)
    logical :: mask(sources)
    mask = .true.
    mask([5, 77]) = .false.
    values = 2
    values([5, 77]) = ieee_value(1.0_real64, ieee_quiet_nan)
    call transfer%new(source(), places, mask=mask, weights=spread(2.0_real64, 1, sources))
    call transfer%apply(values, out)
    call check(all(abs(out - 2) <= roundoff), "values may be NaN where masked")
    call transfer%apply_transpose(out, back)
    call check(all(back([5, 77]) == 0), "nodes without values get no force")
  end subroutine

  subroutine far_targets_are_told()
    type(planish_transfer_t) :: transfer
    type(planish_transfer_options) :: options
    type(planish_transfer_report) :: report
    real(real64) :: far(3, targets)
    integer :: stat
    character(200) :: errmsg
    far = places
    far(3, 40) = far(3, 40) + 3
    call transfer%new(source(), far, stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_OUTSIDE, "away from the source's surface")
    call check(planish_error_index() == 40, "targets count from 1")
    options%far_rule = PLANISH_FAR_RULE_KEEP
    call transfer%new(source(), far, options, report=report, stat=stat)
    call check(stat == PLANISH_STATUS_POINTS_OUTSIDE .and. report%far_count == 1, "or kept and counted")
    call check(report%farthest_index == 40, "and named")
    options%far_rule = PLANISH_FAR_RULE_REFUSE
    options%max_distance = 4
    options%distance_scale = PLANISH_TOLERANCE_SCALE_ABSOLUTE
    call transfer%new(source(), far, options, stat=stat)
    call check(stat == PLANISH_STATUS_OK, "or within the limit")
  end subroutine

  function transfer_of_sheet() result(transfer)
    type(planish_transfer_t) :: transfer
    call transfer%new(source(), places)
  end function

  !> Results of functions go to an argument, since they cannot be assigned; valgrind sees that they are freed.
  subroutine transfers_end_by_themselves()
    type(planish_transfer_t) :: transfer, nothing
    call check(counted(transfer_of_sheet()) == targets, "a function's transfer")
    call transfer%new(source(), places)
    call transfer%new(source(), places(:, :9))
    call check(transfer%target_count() == 9, "a transfer made anew")
    transfer = nothing
    call check(transfer%target_count() == 0, "no transfer may be assigned")
    call transfer%free()
  end subroutine

  integer function counted(transfer)
    type(planish_transfer_t), intent(in) :: transfer
    counted = int(transfer%target_count())
  end function

  subroutine refusals_are_told()
    type(planish_transfer_t) :: transfer, nothing
    type(planish_balance_report) :: balance
    real(real64) :: out(1, targets), values(sources)
    integer :: stat
    character(200) :: errmsg
    values = 1
    call transfer%new(source(), places(:2, :), stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INVALID_ARGUMENT, "the first extent of targets is 2, not 3")
    call transfer%new(source(), places, mask=[.true.], stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INVALID_ARGUMENT, "mask is 1, not 225")
    call transfer%new(source(), places)
    call transfer%apply(points(:1, :), out(:, :7), stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_BUFFER_TOO_SMALL, "out_values has room for 7 of 484")
    call transfer%apply(points, out, stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INVALID_ARGUMENT, "the first extent of out_values is 1, not 3")
    values(8) = ieee_value(1.0_real64, ieee_quiet_nan)
    call transfer%apply(reshape(values, [1, sources]), out, stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_NOT_FINITE, "")
    call check(planish_error_index() == 8, "nodes count from 1")
    call transfer%balance(points(:2, :), places, balance, stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INVALID_ARGUMENT, "the first extent of displacements is 2, not 3")
    call nothing%apply_transpose(values, values, stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_NULL_POINTER, "transfer")
  end subroutine

  !> A quarter of the unit circle, within 1e-5 of it.
  function arc() result(curve)
    type(planish_curve_t) :: curve
    type(planish_interpolate_options) :: options
    real(real64) :: u(17), circle(2, 17), slopes(2, 2)
    integer :: k
    u = [(0.1_real64 * k, k=0, 16)]
    circle(1, :) = cos(u)
    circle(2, :) = sin(u)
    slopes(:, 1) = [0, 1]
    slopes(:, 2) = [-sin(u(17)), cos(u(17))]
    options%ends = PLANISH_SECTION_ENDS_SLOPES
    call curve%interpolate(u, circle, options, slopes)
  end function

  subroutine curves_are_interpolated_and_measured()
    type(planish_curve_t) :: curve, line
    real(real64) :: lengths(2), u(1), distances(1)
    integer :: stat
    character(200) :: errmsg
    curve = arc()
    call check(abs(curve%length() - 1.6_real64) < 1e-4_real64, "length")
    call curve%arc_lengths([0.0_real64, 0.5_real64], lengths)
    call check(lengths(1) == 0 .and. abs(lengths(2) - 0.5_real64) < 1e-4_real64, "lengths to places")
    call curve%project(reshape(2 * [cos(0.7_real64), sin(0.7_real64)], [2, 1]), u, distances, guesses=[0.1_real64])
    call check(abs(u(1) - 0.7_real64) < 1e-4_real64 .and. abs(distances(1) - 1) < 1e-4_real64, "the nearest place")
    call line%interpolate([0.0_real64, 1.0_real64, 3.0_real64], [1.0_real64, 2.0_real64, 4.0_real64])
    call check(abs(line%length() - 3) <= roundoff, "a line of numbers")
    call line%interpolate([0.0_real64, 0.0_real64], [1.0_real64, 2.0_real64], stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_DEGENERATE, "")
    call check(planish_error_index() == 2, "parameters count from 1")
    call curve%arc_lengths([0.0_real64, 0.5_real64], lengths(:1), stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_BUFFER_TOO_SMALL, "lengths has room for 1 of 2")
    call curve%arc_lengths([0.0_real64, 5.0_real64], lengths, stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_OUTSIDE, "")
    call curve%project(points, u, stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INVALID_ARGUMENT, "points")
  end subroutine

  subroutine curves_are_saved()
    type(planish_curve_t) :: curve, loaded
    integer(int8), allocatable :: bytes(:), again(:)
    character(*), parameter :: path = "fortran curve.planish"
    integer :: stat, unit
    character(200) :: errmsg
    curve = arc()
    call curve%save(bytes)
    call check(size(bytes) == curve%save_size(), "save_size")
    call loaded%load(bytes)
    call loaded%save(again)
    call check(all(bytes == again), "to the bit")
    call curve%save_file(path)
    call loaded%load_file(path)
    call check(loaded%length() == curve%length(), "by a file")
    open (newunit=unit, file=path)
    close (unit, status="delete")
    bytes(30) = not(bytes(30))
    call loaded%load(bytes, stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_FORMAT, "checksum")
  end subroutine
end program
