! Fields fitted again and again, sums of surfaces and gradients from Fortran.
program test_fields
  use, intrinsic :: iso_c_binding, only: c_size_t
  use, intrinsic :: iso_fortran_env, only: real64, int32
  use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_value, ieee_quiet_nan
  use planish
  use checks
  implicit none
  integer, parameter :: side = 17
  !> Values are at most 3, sums of some sixteen products of them, or of their derivatives over 16 spans.
  real(real64), parameter :: roundoff = 1e5_real64 * epsilon(1.0_real64)
  real(real64), allocatable :: points(:, :)
  integer(int32), allocatable :: triangles(:, :)
  integer :: times = 0

  call make_sheet(side, points, triangles)
  call options_go_back_to_defaults()
  call fields_are_fitted_and_updated()
  call numbers_are_fitted_and_updated()
  call meshes_get_parameters()
  call points_take_no_mesh()
  call masked_values_are_not_looked_at()
  call samples_choose_the_grid()
  call fitters_end_by_themselves()
  call surfaces_are_added()
  call gradients_lie_along_the_shape()
  call refusals_are_told()
  deallocate (points, triangles) ! valgrind counts what a main program leaves
  call finish()

contains

  !> The sheet over x and y as its parameters.
  function flat_sheet() result(mesh)
    type(planish_mesh_t) :: mesh
    call mesh%new(points, triangles)
    call mesh%set_parameters(points(:2, :))
  end function

  function waves(phase) result(values)
    real(real64), intent(in) :: phase
    real(real64) :: values(2, side**2)
    values(1, :) = sin(3 * points(1, :) + phase)
    values(2, :) = points(1, :) * points(2, :)
  end function

  !> Values of a field of two numbers on an even grid over the sheet.
  function sampled(surface) result(values)
    class(planish_surface_t), intent(in) :: surface
    real(real64) :: values(2, 11, 11)
    integer :: i
    call surface%eval_grid([(0.1_real64 * i, i=0, 10)], [(0.1_real64 * i, i=0, 10)], values)
  end function

  !> The surface (u, v, height u v) of degrees 1 and 1 over the unit square.
  function saddle(height) result(surface)
    real(real64), intent(in) :: height
    type(planish_surface_t) :: surface
    real(real64) :: control_points(3, 2, 2)
    control_points = 0
    control_points(1, :, 2) = 1
    control_points(2, 2, :) = 1
    control_points(3, 2, 2) = height
    call planish_tensor_new(1, 1, [0, 0, 1, 1] * 1.0_real64, [0, 0, 1, 1] * 1.0_real64, control_points, surface)
  end function

  logical function count_on(fraction, error)
    real(real64), intent(in) :: fraction, error
    times = times + 1
    count_on = fraction >= 0 .and. (ieee_is_nan(error) .or. error >= 0)
  end function

  subroutine options_go_back_to_defaults()
    type(planish_field_options) :: options
    options%grid_u = 7
    call planish_options_init(options)
    call check(options%grid_u == 0, "defaults")
  end subroutine

  subroutine fields_are_fitted_and_updated()
    type(planish_field_fitter_t) :: fitter
    type(planish_field_options) :: options
    type(planish_fit_report) :: report
    type(planish_surface_t) :: surface, other
    integer(c_size_t) :: grid(2)
    real(real64) :: uv(2, side**2)
    options%grid_u = 9
    options%grid_v = 5
    call fitter%new(flat_sheet(), options, weights=spread(1.0_real64, 1, side**2))
    call check(fitter%point_count() == side**2, "point_count")
    call fitter%grid(grid)
    call check(all(grid == [9, 5]), "grid along u and v")
    call fitter%copy_parameters(uv)
    call check(all(uv == points(:2, :)), "the parameters are those of the mesh")
    call fitter%fit(waves(0.0_real64), surface, report)
    call check(report%max_error <= report%tolerance .and. surface%dim() == 2, "the tolerance is kept")
    call check(report%worst_index >= 1 .and. report%worst_index <= side**2, "worst_index counts from 1")
    call fitter%fit(waves(1.0_real64), other)
    call check(any(sampled(surface) /= sampled(other)), "another field is another surface")
    call fitter%update(surface, waves(1.0_real64))
    call check(all(sampled(surface) == sampled(other)), "an update is a fit to the bit")
  end subroutine

  subroutine numbers_are_fitted_and_updated()
    type(planish_field_fitter_t) :: fitter
    type(planish_surface_t) :: surface
    type(planish_fit_report) :: report
    real(real64) :: values(2, side**2), back(side**2), uv(2, side**2)
    values = waves(0.0_real64)
    uv = points(:2, :)
    call fitter%new(flat_sheet())
    call fitter%fit(values(1, :), surface, report)
    call surface%eval(uv, back)
    call check(abs(maxval(abs(back - values(1, :))) - report%max_error) <= roundoff, "the error of the report")
    call fitter%update(surface, values(2, :))
    call surface%eval(uv, back)
    call check(maxval(abs(back - values(2, :))) <= report%tolerance, "other numbers in its place")
  end subroutine

  subroutine meshes_get_parameters()
    type(planish_field_fitter_t) :: fitter
    type(planish_mesh_t) :: mesh
    type(planish_parameterize_options) :: map
    real(real64) :: uv(2, side**2)
    call mesh%new(points, triangles)
    map%border = PLANISH_BORDER_CORNERS
    map%corners = [1, side**2 - side + 1, side**2, side]
    call fitter%new(mesh, parameterize=map)
    call fitter%copy_parameters(uv)
    call check(all(uv(:, 1) == 0) .and. all(uv(:, side**2) == 1), "corners count from 1")
    call check(.not. mesh%has_parameters(), "the mesh is left alone")
  end subroutine

  subroutine points_take_no_mesh()
    type(planish_field_fitter_t) :: of_mesh, of_points
    type(planish_surface_t) :: one, other
    real(real64) :: uv(2, side**2)
    uv = points(:2, :)
    call of_mesh%new(flat_sheet())
    call of_points%new(uv)
    call of_mesh%fit(waves(0.5_real64), one)
    call of_points%fit(waves(0.5_real64), other)
    call check(all(sampled(one) == sampled(other)), "a mesh and its parameters")
  end subroutine

  subroutine masked_values_are_not_looked_at()
    type(planish_field_fitter_t) :: fitter
    type(planish_surface_t) :: surface
    type(planish_fit_report) :: report
    real(real64) :: values(2, side**2), back(2, side**2), uv(2, side**2), errors(side**2)
    logical :: mask(side**2)
    integer :: stat
    mask = .true.
    mask([5, 77]) = .false.
    values = waves(0.0_real64)
    values(:, [5, 77]) = ieee_value(1.0_real64, ieee_quiet_nan)
    call fitter%new(flat_sheet(), mask=mask)
    call check(fitter%point_count() == side**2, "nodes without values are nodes")
    call fitter%fit(values, surface, report, stat)
    call check(stat >= 0 .and. all(report%worst_index /= [5, 77]), "values may be NaN where masked")
    uv = points(:2, :)
    call surface%eval(uv, back)
    errors = norm2(back - waves(0.0_real64), 1)
    call check(abs(maxval(errors, mask) - report%max_error) <= roundoff, "the report is about the others")
    call check(all(errors < 0.1_real64), "and the surface goes on between them")
  end subroutine

  subroutine samples_choose_the_grid()
    type(planish_field_fitter_t) :: rough, fine
    type(planish_field_options) :: options
    type(planish_surface_t) :: surface
    type(planish_fit_report) :: report
    integer(c_size_t) :: few(2), many(2)
    options%tolerance = 1e-2_real64
    call rough%new(flat_sheet(), options, sample_values=points(1:1, :), progress=count_on)
    call check(times > 0, "progress is heard")
    call rough%grid(few)
    call fine%new(flat_sheet(), options, sample_values=waves(0.0_real64))
    call fine%grid(many)
    call check(product(few) <= product(many), "a line takes no more knots than waves")
    call fine%fit(waves(0.0_real64), surface, report)
    call check(report%max_error <= report%tolerance, "the sample meets the tolerance")
  end subroutine

  function fitter_of_sheet() result(fitter)
    type(planish_field_fitter_t) :: fitter
    call fitter%new(flat_sheet())
  end function

  !> Results of functions go to an argument, since they cannot be assigned; valgrind sees that they are freed.
  subroutine fitters_end_by_themselves()
    type(planish_field_fitter_t) :: fitter, nothing
    call check(counted(fitter_of_sheet()) == side**2, "a function's fitter")
    call fitter%new(flat_sheet())
    call fitter%new(points(:2, :2 * side))
    call check(fitter%point_count() == 2 * side, "a fitter made anew")
    fitter = nothing
    call check(fitter%point_count() == 0, "no fitter may be assigned")
    call fitter%free()
  end subroutine

  integer(c_size_t) function counted(fitter)
    type(planish_field_fitter_t), intent(in) :: fitter
    counted = fitter%point_count()
  end function

  subroutine surfaces_are_added()
    type(planish_surface_t) :: parts(2), combined
    real(real64) :: values(3, 1)
    integer :: stat
    character(100) :: errmsg
    parts(1) = saddle(1.0_real64)
    parts(2) = saddle(4.0_real64)
    call planish_tensor_elevate_degree(parts(2), PLANISH_AXIS_U, 3)
    call planish_tensor_combine(parts, combined, [1.0_real64, 0.5_real64])
    call combined%eval(reshape([0.5_real64, 0.5_real64], [2, 1]), values)
    call check(all(abs(values(:, 1) - [0.75_real64, 0.75_real64, 0.75_real64]) <= roundoff), "times the factors")
    call planish_tensor_combine(parts, combined)
    call combined%eval(reshape([1.0_real64, 0.5_real64], [2, 1]), values)
    call check(all(abs(values(:, 1) - [2.0_real64, 1.0_real64, 2.5_real64]) <= roundoff), "or times 1")
    call planish_tensor_combine(parts, combined, [1.0_real64], stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INVALID_ARGUMENT, "the number of factors is 1, not 2")
    call planish_tensor_combine(parts(:0), combined, stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INVALID_ARGUMENT, "")
    call parts(2)%free()
    call planish_tensor_combine(parts, combined, stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_NULL_POINTER, "")
  end subroutine

  !> The gradient of a shape over itself is the projection along its normal, I - n n'.
  subroutine gradients_lie_along_the_shape()
    type(planish_surface_t) :: shape
    real(real64) :: uv(2, 2), normals(3, 2), gradients(3, 3, 2)
    integer :: i, k, stat
    character(100) :: errmsg
    shape = saddle(1.0_real64)
    uv = reshape([0.3_real64, 0.4_real64, 0.6_real64, 0.5_real64], [2, 2])
    call shape%normals(uv, normals)
    call shape%field_gradient(shape, uv, gradients, thread_count=1)
    do i = 1, 2
      do k = 1, 3
        call check(all(abs(gradients(:, k, i) - merge(1, 0, k == [1, 2, 3]) + normals(k, i) * normals(:, i)) &
            <= roundoff), "a column for each component")
      end do
    end do
    call shape%field_gradient(shape, 9 * uv, gradients, stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_OUTSIDE, "")
    call check(planish_error_index() == 1, "the first point lies outside")
    call shape%field_gradient(shape, uv, gradients(:, :2, :), stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INVALID_ARGUMENT, "the second extent of gradients is 2, not 3")
    call shape%field_gradient(shape, uv, gradients(:, :, :1), stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_BUFFER_TOO_SMALL, "gradients has room for 1 of 2")
  end subroutine

  subroutine refusals_are_told()
    type(planish_field_fitter_t) :: fitter, nothing
    type(planish_field_options) :: options
    type(planish_surface_t) :: surface
    real(real64) :: values(2, side**2), uv(2, 3)
    integer :: stat
    character(100) :: errmsg
    options%smoothing = -1
    call fitter%new(flat_sheet(), options, stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INVALID_ARGUMENT, "smoothing")
    call check(fitter%point_count() == 0, "what is refused makes nothing")
    call fitter%new(flat_sheet(), mask=[.true.], stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INVALID_ARGUMENT, "mask is 1, not 289")
    call fitter%new(points(:2, :), weights=[1.0_real64], stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_BUFFER_TOO_SMALL, "weights has room for 1 of 289")
    call fitter%new(points(:2, :), sample_values=uv, stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INVALID_ARGUMENT, "the number of sample_values is 3, not 289")
    call fitter%new(points, stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INVALID_ARGUMENT, "the first extent of uv is 3, not 2")
    call fitter%new(flat_sheet())
    values = waves(0.0_real64)
    values(1, 7) = ieee_value(1.0_real64, ieee_quiet_nan)
    call fitter%fit(values, surface, stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_NOT_FINITE, "")
    call check(planish_error_index() == 7, "nodes count from 1")
    call fitter%fit(values(:, :4), surface, stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INVALID_ARGUMENT, "")
    call fitter%update(surface, values, stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_NULL_POINTER, "surface")
    surface = saddle(1.0_real64)
    call fitter%update(surface, waves(0.0_real64), stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INVALID_ARGUMENT, "")
    call fitter%copy_parameters(uv, stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_BUFFER_TOO_SMALL, "")
    call nothing%fit(values, surface, stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_NULL_POINTER, "fitter")
  end subroutine
end program
