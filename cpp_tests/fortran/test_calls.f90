! Every group of calls from Fortran: arrays the right way round, indices from 1, errors in stat and errmsg.

!> Who hears of progress.
module listeners
  use, intrinsic :: iso_fortran_env, only: real64
  use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
  implicit none
  integer :: times = 0

contains

  !> Counts how often it is called, and goes on.
  logical function count_on(fraction, error)
    real(real64), intent(in) :: fraction, error
    times = times + 1
    count_on = fraction >= 0 .and. (ieee_is_nan(error) .or. error >= 0)
  end function

  logical function stop_at_once(fraction, error)
    real(real64), intent(in) :: fraction, error
    stop_at_once = fraction > 1 .and. error < 0
  end function
end module

program test_calls
  use, intrinsic :: iso_c_binding, only: c_loc, c_size_t
  use, intrinsic :: iso_fortran_env, only: real64, int8, int32
  use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_value, ieee_positive_inf
  use planish
  use checks
  use listeners, only: times, count_on, stop_at_once
  implicit none
  integer, parameter :: side = 9
  !> The sheet's coordinates are below 1 and the fit's smoothing does not bend z = x y, so its nodes come back
  !> within the residual of the least squares: some hundred operations of one rounding each.
  real(real64), parameter :: roundoff = 1000 * epsilon(1.0_real64)
  real(real64), allocatable :: points(:, :)
  integer(int32), allocatable :: triangles(:, :)

  call make_sheet(side, points, triangles)
  call versions_and_names()
  call options_go_back_to_defaults()
  call meshes_count_from_1()
  call meshes_are_repaired()
  call meshes_are_cut()
  call meshes_become_coarser()
  call meshes_are_fitted_by_d1rc_splines()
  call fields_have_names()
  call parameters_are_set_and_made()
  call closed_meshes_become_spheres()
  call closed_meshes_get_layouts()
  call shapes_are_fitted()
  call scattered_points_are_fitted()
  call fields_are_fitted()
  call single_points_are_obeyed()
  call sides_are_taken_over()
  call fits_are_heard_and_cancelled()
  call tensor_surfaces_have_parts()
  call values_come_in_columns()
  call extents_are_strides()
  call derivatives_grids_and_normals()
  call points_outside_are_flagged()
  call trims_count_from_1()
  call trims_follow_curves()
  call points_are_projected()
  call files_are_written()
  call curves_are_evaluated()
  call refusals_are_told()
  deallocate (points, triangles) ! valgrind counts what a main program leaves
  call finish()

contains

  function sheet() result(mesh)
    type(planish_mesh_t) :: mesh
    call mesh%new(points, triangles)
  end function

  !> The sheet over x and y as its parameters.
  function flat_sheet() result(mesh)
    type(planish_mesh_t) :: mesh
    call mesh%new(points, triangles)
    call mesh%set_parameters(points(:2, :))
  end function

  function fitted_sheet() result(surface)
    type(planish_surface_t) :: surface
    type(planish_tensor_options) :: options
    options%regularize = PLANISH_REGULARIZE_NEVER
    options%tolerance = 1e-9_real64
    call planish_tensor_fit(flat_sheet(), surface, options)
  end function

  subroutine versions_and_names()
    character(:), allocatable :: version
    version = planish_version()
    call check(index(version, "0.2.") == 1, "the version is 0.2.x")
    call check(planish_status_name(PLANISH_STATUS_SINGULAR) == "PLANISH_STATUS_SINGULAR", "names of statuses")
  end subroutine

  subroutine options_go_back_to_defaults()
    type(planish_mesh_options) :: mesh
    type(planish_parameterize_options) :: map
    type(planish_eval_options) :: eval
    type(planish_tensor_options) :: tensor
    type(planish_tessellate_options) :: tessellate
    type(planish_project_options) :: project
    type(planish_deviation_options) :: deviation
    type(planish_vtk_options) :: vtk
    type(planish_step_options) :: step
    mesh%orient = 7
    map%unroll = 7
    eval%outside = 7
    tensor%max_grid = 7
    tessellate%keep_trims = 7
    project%keep_trims = 7
    deviation%use_parameters = 7
    vtk%thread_count = 7
    step%schema = 7
    call planish_options_init(mesh)
    call planish_options_init(map)
    call planish_options_init(eval)
    call planish_options_init(tensor)
    call planish_options_init(tessellate)
    call planish_options_init(project)
    call planish_options_init(deviation)
    call planish_options_init(vtk)
    call planish_options_init(step)
    call check(all([mesh%orient, eval%outside, vtk%thread_count, step%schema] == 0), "defaults that are 0")
    call check(all([map%unroll, tessellate%keep_trims, project%keep_trims, deviation%use_parameters] == 1), &
        "defaults that are 1")
    call check(tensor%max_grid == 257, "max_grid")
  end subroutine

  subroutine meshes_count_from_1()
    type(planish_mesh_t) :: mesh
    real(real64) :: points_back(3, side**2)
    integer(int32) :: triangles_back(3, 2 * (side - 1)**2), loop(4 * (side - 1))
    integer(int32), allocatable :: path(:)
    mesh = sheet()
    call check(mesh%point_count() == side**2, "point_count")
    call check(mesh%triangle_count() == 2 * (side - 1)**2, "triangle_count")
    call check(mesh%edge_count() == 3 * side**2 - 4 * side + 1, "edge_count")
    call check(mesh%euler_characteristic() == 1, "euler_characteristic")
    call check(mesh%component_count() == 1 .and. mesh%genus() == 0 .and. mesh%loop_count() == 1, "a disk")
    call mesh%copy_points(points_back)
    call check(all(points_back == points), "copy_points")
    call mesh%copy_triangles(triangles_back)
    call check(all(triangles_back == triangles), "copy_triangles")
    call check(mesh%loop_point_count(1) == 4 * (side - 1), "loop_point_count")
    call check(mesh%loop_point_count(0) == 0 .and. mesh%loop_point_count(2) == 0, "loops that are none")
    call mesh%copy_loop(1, loop)
    call check(minval(loop) == 1 .and. maxval(loop) == side**2, "copy_loop")
    call mesh%shortest_path(1, side, path)
    call check(all(path == [1, 2, 3, 4, 5, 6, 7, 8, 9]), "shortest_path")
  end subroutine

  subroutine meshes_are_repaired()
    type(planish_mesh_t) :: mesh
    type(planish_mesh_options) :: options
    type(planish_mesh_repairs) :: repairs
    real(real64) :: doubled(3, 6)
    integer(int32) :: node_map(6)
    integer :: stat
    ! two triangles that do not know of their common edge: nodes 4 and 6 lie on 2 and 3
    doubled = reshape([0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0] * 1.0_real64, [3, 6])
    options%weld_distance = 1e-6_real64
    call mesh%new(doubled, reshape([1, 2, 3, 4, 5, 6], [3, 2]), options, repairs, node_map, stat)
    call check(stat == PLANISH_STATUS_INPUT_REPAIRED, "welding is a remark")
    call check(repairs%welded_node_count == 2 .and. mesh%point_count() == 4, "two nodes are welded")
    call check(all(node_map([2, 3]) == node_map([4, 6])) .and. minval(node_map) == 1, "node_map counts from 1")
  end subroutine

  subroutine meshes_are_cut()
    type(planish_mesh_t) :: mesh, rest, cut
    mesh = sheet()
    call mesh%remove_triangles([1], rest)
    call check(rest%triangle_count() == mesh%triangle_count() - 1, "remove_triangles")
    call mesh%cut_along([1, 1 + (side + 1)], cut)
    call check(cut%point_count() == mesh%point_count() + 1, "cut_along")
  end subroutine

  subroutine meshes_become_coarser()
    type(planish_mesh_t) :: mesh, coarse
    type(planish_decimate_options) :: options
    type(planish_decimate_report) :: report
    integer(int32), allocatable :: sharp_edges(:, :)
    integer :: stat, i
    mesh = sheet()
    options%target_count = 30
    call mesh%decimate(coarse, options, report, reshape([(i, i + 1, i=1, side - 1)], [2, side - 1]), sharp_edges)
    call check(coarse%point_count() == 30 .and. report%collapse_count == side**2 - 30, "decimate")
    call check(coarse%euler_characteristic() == 1 .and. coarse%loop_count() == 1, "still a disk")
    call check(size(sharp_edges, 2) == 0, "sharp edges on the boundary are the boundary")
    options%target_count = 3
    options%keep_map = 0
    call mesh%decimate(coarse, options, report, stat=stat)
    call check(stat == PLANISH_STATUS_STAGNATED .or. coarse%point_count() == 3, "as coarse as it gets")
    call check(coarse%point_count() == 3 + report%excess_count, "excess_count")
  end subroutine

  subroutine meshes_are_fitted_by_d1rc_splines()
    type(planish_mesh_t) :: mesh
    type(planish_surface_t) :: surface
    type(planish_d1rc_options) :: options
    type(planish_fit_report) :: report
    real(real64) :: errors(side**2)
    integer(int32) :: ridge(2, side - 1)
    integer :: stat, i
    mesh = sheet()
    options%control_count = 40
    options%tolerance = 1e-1_real64
    call planish_d1rc_fit(mesh, surface, options, report, errors=errors)
    call check(report%coefficient_count == 40 .and. maxval(errors) <= report%tolerance, "planish_d1rc_fit")
    ! a row of edges across the sheet
    ridge = reshape([(4 * side + i, 4 * side + i + 1, i=1, side - 1)], shape(ridge))
    call planish_d1rc_fit(mesh, surface, options, report, sharp_edges=ridge, stat=stat)
    call check(stat == PLANISH_STATUS_OK .and. surface%kind() == PLANISH_KIND_D1RC, "with a ridge")
    call planish_d1rc_fit(mesh, surface, options, report, control_mesh=mesh)
    call check(report%coefficient_count == side**2, "with a control mesh")
    call surface%free()
  end subroutine

  subroutine fields_have_names()
    type(planish_mesh_t) :: mesh
    real(real64) :: back(side**2)
    mesh = sheet()
    call mesh%set_field("height", points(3, :))
    call check(mesh%field_count() == 1, "field_count")
    call check(mesh%field_name(1) == "height" .and. mesh%field_name(2) == "" .and. mesh%field_name(0) == "", "field_name")
    call mesh%copy_field("height", back)
    call check(all(back == points(3, :)), "copy_field")
  end subroutine

  subroutine parameters_are_set_and_made()
    type(planish_mesh_t) :: mesh
    type(planish_parameterize_options) :: options
    type(planish_parameterize_report) :: report
    real(real64) :: uv(2, side**2)
    mesh = sheet()
    call check(.not. mesh%has_parameters(), "no parameters yet")
    options%border = PLANISH_BORDER_CORNERS
    options%corners = [1, side**2 - side + 1, side**2, side]
    call mesh%parameterize(options, report, node_weights=spread(1.0_real64, 1, side**2))
    call check(mesh%has_parameters() .and. report%flipped_count == 0, "parameterize")
    call mesh%copy_parameters(uv)
    call check(all(uv(:, 1) == 0) .and. all(uv(:, side**2) == 1), "corners count from 1")
  end subroutine

  subroutine closed_meshes_get_layouts()
    type(planish_mesh_t) :: mesh
    type(planish_layout_t) :: layout, cube
    type(planish_mesh_layout_report) :: report
    real(real64) :: corners(3, 4), uv(2, 4)
    integer(int32) :: quads(4), of_cube(4, 6), edges(6, 12), valences(8)
    integer(int32), allocatable :: sharp(:, :), found(:)
    integer(c_size_t), allocatable :: triangle_counts(:), piece_counts(:), handle_counts(:)
    real(real64) :: beside(3, 2), places(3, 2), distances(2)
    integer :: stat, nearest(2)
    ! below the first triangle, and beyond the middle of the third
    beside = reshape([0.2_real64, 0.2_real64, -1.0_real64, 1.0_real64, 1.0_real64, 1.0_real64], [3, 2])
    corners = reshape([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1], [3, 4])
    call mesh%new(corners, reshape([1, 3, 2, 1, 2, 4, 2, 3, 4, 1, 4, 3], [3, 4]))
    call layout%of_mesh(mesh, report=report)
    call layout%copy_node_map(quads, uv)
    call check(report%kind == PLANISH_LAYOUT_KIND_CUBE .and. layout%node_count() == 4, "of_mesh")
    call check(all(quads >= 1 .and. quads <= 6) .and. all(uv >= 0 .and. uv <= 1), "copy_node_map")
    call cube%cube()
    call cube%copy_corners(of_cube)
    call cube%copy_edges(edges)
    call cube%copy_valences(valences)
    call check(minval(of_cube) == 1 .and. maxval(of_cube) == 8 .and. minval(edges) == 1, "a cube counts from 1")
    call check(all(valences == 3) .and. cube%edge_count() == 12 .and. cube%vertex_count() == 8, "valences")
    call layout%new(of_cube)
    call check(layout%quad_count() == 6, "layout%new")
    call layout%new(of_cube(1:3, :), stat=stat)
    call check(stat == PLANISH_STATUS_INVALID_ARGUMENT, "quads have four corners")
    call mesh%find_features(sharp)
    call check(size(sharp, 2) == 6 .and. minval(sharp) == 1 .and. maxval(sharp) == 4, "find_features")
    call mesh%label_parts([5, 2, 5, 5], found, triangle_counts, piece_counts, handle_counts)
    call check(all(found == [2, 5]) .and. all(triangle_counts == [1, 3]), "label_parts")
    call check(all(piece_counts == 1) .and. all(handle_counts == 0), "pieces and handles")
    call mesh%label_parts([5, 2], found, stat=stat)
    call check(stat == PLANISH_STATUS_INVALID_ARGUMENT .and. size(found) == 2, "a label for each triangle")
    call mesh%project(beside, nearest, places, distances)
    call check(all(nearest == [1, 3]), "triangles count from 1")
    call check(all(abs(distances - [1.0_real64, 2 / sqrt(3.0_real64)]) < 1e-14_real64), "project")
    call check(all(abs(places(:, 2) - 1 / 3.0_real64) < 1e-14_real64), "the nearest place")
  end subroutine

  subroutine closed_meshes_become_spheres()
    type(planish_mesh_t) :: mesh
    type(planish_sphere_report) :: report
    real(real64) :: corners(3, 4), places(3, 4)
    integer :: stat
    corners = reshape([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1], [3, 4])
    call mesh%new(corners, reshape([1, 3, 2, 1, 2, 4, 2, 3, 4, 1, 4, 3], [3, 4]))
    call mesh%map_to_sphere(places, report=report)
    call check(all(abs(sum(places**2, 1) - 1) < 1e-14_real64), "map_to_sphere")
    call check(report%folded_triangles == 0 .and. report%energy >= 4, "the map is one to one")
    call mesh%map_to_sphere(places(:, 1:3), stat=stat)
    call check(stat == PLANISH_STATUS_BUFFER_TOO_SMALL, "map_to_sphere needs a column for each node")
  end subroutine

  subroutine shapes_are_fitted()
    type(planish_surface_t) :: surface
    type(planish_tensor_options) :: options
    type(planish_parameterize_options) :: map
    type(planish_fit_report) :: report
    real(real64) :: uv(2, side**2), errors(side**2), values(3, side**2)
    map%border = PLANISH_BORDER_SQUARE_BY_TURNS
    options%tolerance = 1e-2_real64
    call planish_tensor_fit(sheet(), surface, options, report, map, parameters=uv, errors=errors)
    call check(report%max_error <= report%tolerance, "the tolerance is kept")
    call check(iand(report%remarks, PLANISH_REMARK_PARAMETERIZED) /= 0, "the mesh was parameterized")
    call check(maxloc(errors, 1) == report%worst_index, "worst_index counts from 1")
    call surface%eval(uv, values)
    call check(maxval(abs(norm2(values - points, 1) - errors)) <= roundoff, "errors are those at parameters")
  end subroutine

  subroutine scattered_points_are_fitted()
    type(planish_surface_t) :: surface
    type(planish_fit_report) :: report
    real(real64) :: uv(2, side**2), weights(side**2), values(2, 1)
    uv = points(:2, :)
    weights = 2
    call planish_tensor_fit_points(uv, points(2:3, :), surface, report=report, weights=weights)
    call check(surface%dim() == 2 .and. report%max_error <= report%tolerance, "values of two numbers")
    call surface%eval(reshape([0.5_real64, 0.25_real64], [2, 1]), values)
    call check(abs(values(1, 1) - 0.25_real64) <= report%tolerance, "v comes back")
  end subroutine

  subroutine fields_are_fitted()
    type(planish_surface_t) :: surface
    type(planish_tensor_options) :: options
    type(planish_fit_report) :: report
    real(real64) :: uv(2, side**2), field(side**2), values(side**2), rows(1, side**2)
    uv = points(:2, :)
    field = 3 + sheet_height(uv(1, :), uv(2, :))
    options%regularize = PLANISH_REGULARIZE_NEVER
    call planish_tensor_fit_field(flat_sheet(), field, surface, options, report)
    call surface%eval(uv, values)
    call check(maxval(abs(values - field)) <= report%max_error + roundoff, "a field of numbers")
    call surface%eval(uv, rows)
    call check(all(rows(1, :) == values), "numbers or rows of one")
  end subroutine

  subroutine single_points_are_obeyed()
    type(planish_surface_t) :: surface, fair
    type(planish_tensor_options) :: options
    type(planish_fair_options) :: fairness
    type(planish_fit_report) :: report
    type(planish_fair_report) :: faired, near
    real(real64) :: uv(2, 400), values(400)
    real(real64), target :: tolerances(400)
    integer(int32), target :: fixed(2)
    integer(int8), target, volatile :: left_out(400) ! the call does not say that it changes
    integer :: i, stat
    character(100) :: errmsg
    do i = 1, 400
      uv(:, i) = [mod(i - 1, 20), (i - 1) / 20] / 19.0_real64
    end do
    values = sin(3 * uv(1, :)) * uv(2, :)
    values(150) = values(150) + 1
    tolerances = 1e-2_real64
    fixed = [0, 399] ! as in C, numbers in options count from 0
    left_out = 9_int8
    options%tolerance_scale = PLANISH_TOLERANCE_SCALE_ABSOLUTE
    options%fixed = c_loc(fixed)
    options%fixed_count = 2_c_size_t
    options%tolerances = c_loc(tolerances)
    options%out_left_out = c_loc(left_out)
    options%outlier_scale = 0.2_real64
    call planish_tensor_fit_points(uv, values, surface, options, report)
    call check(report%max_fixed_error <= 1e-12_real64 .and. report%max_tolerance_share <= 1, "demands are met")
    call check(report%left_out_count == 1 .and. left_out(150) == 1 .and. sum(int(left_out)) == 1, "left out")
    fixed(2) = 400
    call planish_tensor_fit_points(uv, values, surface, options, report, stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INDEX, "datum 400")
    fairness%tolerance = 1e-2_real64
    fairness%tolerance_scale = PLANISH_TOLERANCE_SCALE_ABSOLUTE
    fairness%border = PLANISH_KEPT_BORDER_POSITION
    call surface%fair(fair, fairness, report=faired)
    call check(faired%energy_after < faired%energy_before .and. faired%max_movement <= 1e-2_real64, "fair")
    values(150) = values(150) - 1
    fairness%tolerance = 2e-2_real64
    call surface%fair(fair, fairness, uv, reshape(values, [1, 400]), faired)
    call check(faired%max_deviation <= 2e-2_real64, "fair near data")
    fairness%limit = PLANISH_FAIR_LIMIT_TOLERANCE
    call surface%fair(fair, fairness, uv, reshape(values, [1, 400]), near)
    call check(near%max_deviation <= 2e-2_real64 .and. near%energy_after <= faired%energy_after, "all of the tolerance")
    call surface%fair(fair, fairness, uv, reshape(values, [1, 399]), stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INVALID_ARGUMENT, "the number of values")
  end subroutine

  subroutine sides_are_taken_over()
    type(planish_surface_t) :: first, second
    type(planish_tensor_options) :: options
    type(planish_pht_options) :: cells
    type(planish_fit_report) :: report
    real(real64) :: uv(2, 900), low(3, 900), high(3, 900)
    integer :: i
    do i = 1, 900
      uv(:, i) = [(i - 1) / 30, mod(i - 1, 30)] / 29.0_real64
    end do
    low = shell(uv(1, :), uv(2, :))
    high = shell(1 + uv(1, :), uv(2, :))
    options%tolerance = 1e-4_real64
    options%buffer = 0
    call planish_tensor_fit_points(uv, low, first, options, report)
    options%neighbour_u_low = first%get()
    call planish_tensor_fit_points(uv, high, second, options, report)
    call check(report%max_side_error <= 1e-12_real64 * report%diagonal, "a side is taken over")
    call check(report%max_side_angle <= 1e-10_real64, "with its tangent planes")
    options%knots = PLANISH_KNOTS_UNIFORM
    call planish_tensor_fit_points(uv, high, second, options, report)
    call check(report%max_side_angle <= 1e-10_real64, "over equal cells")
    cells%tolerance = 1e-4_real64
    cells%neighbour_u_low = first%get()
    call planish_pht_fit_points(uv, high, second, cells, report)
    call check(report%max_side_error <= 1e-12_real64 * report%diagonal, "by a PHT-spline")
    call check(report%max_side_angle <= 1e-10_real64, "with its tangent planes too")
  end subroutine

  function shell(x, y) result(points)
    real(real64), intent(in) :: x(:), y(:)
    real(real64) :: points(3, size(x))
    points(1, :) = x
    points(2, :) = y + 0.1_real64 * x * y
    points(3, :) = 0.3_real64 * sin(1.7_real64 * x) * (1 + y) + 0.2_real64 * cos(3 * y)
  end function

  subroutine fits_are_heard_and_cancelled()
    type(planish_surface_t) :: surface
    integer :: stat
    character(100) :: errmsg
    call planish_tensor_fit(sheet(), surface, progress=count_on)
    call check(times > 0, "progress is heard")
    call surface%free()
    call planish_tensor_fit(sheet(), surface, progress=stop_at_once, stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_CANCELLED, "cancel")
    call check(surface%dim() == 0, "a cancelled fit leaves nothing")
  end subroutine

  subroutine tensor_surfaces_have_parts()
    type(planish_surface_t) :: surface
    real(real64) :: knots_u(4), knots_v(6), control_points(2, 3, 2), weights(3, 2), back(2, 3, 2), weights_back(3, 2)
    real(real64) :: value(2, 1), knots_back(6)
    knots_u = [0, 0, 1, 1]
    knots_v = [0, 0, 0, 2, 2, 2]
    call random_number(control_points)
    weights = reshape([1, 2, 1, 1, 2, 1], [3, 2])
    call planish_tensor_new(1, 2, knots_u, knots_v, control_points, surface, weights)
    call check(surface%kind() == PLANISH_KIND_TENSOR .and. surface%coefficient_count() == 6, "kind and coefficients")
    call check(planish_tensor_degree(surface, PLANISH_AXIS_V) == 2, "degree")
    call check(planish_tensor_knot_count(surface, PLANISH_AXIS_V) == 6, "knot_count")
    call check(planish_tensor_control_point_count(surface, PLANISH_AXIS_V) == 3, "control_point_count")
    call planish_tensor_copy_knots(surface, PLANISH_AXIS_V, knots_back)
    call check(all(knots_back == knots_v), "copy_knots")
    call planish_tensor_copy_control_points(surface, back)
    call check(all(back == control_points), "copy_control_points")
    call check(planish_tensor_has_weights(surface), "has_weights")
    call planish_tensor_copy_weights(surface, weights_back)
    call check(all(weights_back == weights), "copy_weights")
    ! the end of v at the beginning of u is the last of the first three control points
    call surface%eval(reshape([0, 2] * 1.0_real64, [2, 1]), value)
    call check(all(abs(value(:, 1) - control_points(:, 3, 1)) <= roundoff), "v runs fastest")
  end subroutine

  subroutine values_come_in_columns()
    type(planish_surface_t) :: surface
    real(real64) :: uv(2, side**2), values(3, side**2), box(4), data_box(4), none(3, 0), nowhere(2, 0)
    surface = fitted_sheet()
    uv = points(:2, :)
    call surface%eval(uv, values)
    call check(maxval(abs(values - points)) <= roundoff, "the sheet comes back")
    call surface%eval(nowhere, none)
    call surface%domain(box)
    call surface%data_box(data_box)
    call check(all(data_box == [0, 1, 0, 1]), "data_box")
    call check(box(1) < 0 .and. box(2) > 1, "the domain reaches beyond the data")
  end subroutine

  subroutine extents_are_strides()
    type(planish_surface_t) :: surface
    type(planish_mesh_t) :: mesh
    real(real64) :: wide(5, side**2), tight(3, side**2), wide_values(4, side**2), narrow(2, side**2)
    integer(int32) :: wide_triangles(4, 2 * (side - 1)**2)
    integer :: stat
    character(100) :: errmsg
    surface = fitted_sheet()
    wide = huge(wide)
    wide(:3, :) = points
    wide_values = -1
    call surface%eval(wide, wide_values)
    call surface%eval(points(:2, :), tight)
    call check(all(wide_values(:3, :) == tight) .and. all(wide_values(4, :) == -1), "the first extent is the stride")
    wide_triangles = 0
    wide_triangles(:3, :) = triangles
    call mesh%new(wide, wide_triangles)
    call check(mesh%point_count() == side**2, "strides of points and triangles")
    call surface%eval(wide, wide_values(:, :3), stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_BUFFER_TOO_SMALL, "room for 3 of 81")
    call surface%eval(wide, narrow, stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INVALID_ARGUMENT, "stride")
  end subroutine

  subroutine derivatives_grids_and_normals()
    type(planish_surface_t) :: surface
    real(real64) :: uv(2, 1), out(3, 6, 1), grid(3, 2, 3), normals(3, 1), curvatures(8, 1)
    surface = fitted_sheet()
    uv(:, 1) = [0.5_real64, 0.25_real64]
    call surface%eval_derivatives(uv, 2, out)
    ! S = (u, v, u v); each derivative multiplies the rounding by the number of spans, 8
    call check(maxval(abs(out(:, 2, 1) - [1.0_real64, 0.0_real64, 0.25_real64])) <= 64 * roundoff, "Su")
    call check(maxval(abs(out(:, 5, 1) - [0, 0, 1])) <= 512 * roundoff, "Suv")
    call surface%eval_grid([0.0_real64, 0.5_real64, 1.0_real64], [0.25_real64, 0.75_real64], grid)
    call check(abs(grid(1, 1, 3) - 1) <= roundoff .and. abs(grid(2, 1, 3) - 0.25_real64) <= roundoff, "v runs fastest")
    call surface%normals(uv, normals)
    call check(abs(dot_product(normals(:, 1), out(:, 2, 1))) <= 64 * roundoff, "the normal is normal")
    call surface%curvatures(uv, curvatures)
    call check(curvatures(1, 1) > 0 .and. curvatures(2, 1) < 0, "a saddle bends both ways")
  end subroutine

  subroutine points_outside_are_flagged()
    type(planish_surface_t) :: surface
    type(planish_eval_options) :: options
    real(real64) :: uv(2, 3), values(3, 3)
    integer(int8) :: flags(3)
    integer :: stat
    surface = fitted_sheet()
    uv = reshape([0.5_real64, 0.5_real64, 9.0_real64, 0.5_real64, 1.003_real64, 0.5_real64], [2, 3])
    options%outside = PLANISH_OUTSIDE_FLAG
    call surface%eval(uv, values, options, flags, stat)
    call check(stat == PLANISH_STATUS_POINTS_OUTSIDE, "a remark is a status")
    call check(all(ieee_is_nan(values(:, 2))) .and. .not. any(ieee_is_nan(values(:, [1, 3]))), "NaN outside")
    call check(flags(1) == 0, "no flag inside")
    call check(iand(flags(2), PLANISH_FLAG_OUTSIDE_DOMAIN) /= 0, "a flag outside")
    call check(iand(flags(3), PLANISH_FLAG_IN_BUFFER) /= 0, "a flag beyond the data")
  end subroutine

  subroutine trims_count_from_1()
    type(planish_surface_t) :: surface
    real(real64), allocatable :: uv(:, :)
    surface = fitted_sheet()
    call check(surface%trim_count() == 1 .and. surface%trim_point_count(1) == 4 * (side - 1), "the boundary is a trim")
    allocate (uv(2, surface%trim_point_count(1)))
    call surface%copy_trim(1, uv)
    call check(minval(uv) == 0 .and. maxval(uv) == 1, "copy_trim")
    call surface%set_trims(reshape([0, 0, 1, 0, 0, 1] * 0.5_real64, [2, 3]), [3])
    call check(surface%trim_point_count(1) == 3, "set_trims")
    call surface%set_trims(uv(:, :0), [integer ::])
    call check(surface%trim_count() == 0, "no trims")
  end subroutine

  subroutine trims_follow_curves()
    type(planish_surface_t) :: surface
    type(planish_curve_t) :: rings(2), lines(1)
    type(planish_trim_options) :: options
    type(planish_trim_report) :: report
    real(real64), parameter :: ends(4) = [0, 0, 1, 1]
    character(200) :: errmsg
    integer :: stat
    call planish_tensor_new(1, 1, ends, ends, &
      reshape(real([0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0], real64), [3, 2, 2]), surface)
    rings(1) = square(0.1_real64, 0.9_real64)
    rings(2) = square(0.4_real64, 0.6_real64)
    call surface%trim_by_curves(rings, options=options, report=report)
    call check(surface%trim_count() == 2 .and. surface%trim_point_count(2) == 4, "trim_by_curves")
    call check(report%vertex_count == 8 .and. report%max_distance_between < 1e-12_real64, "a report of trims")
    call surface%trim_by_curves(rings(1:1), [1])
    options%add = 1
    call surface%trim_by_curves(rings(2:2), options=options)
    call check(surface%trim_count() == 2, "a hole is added")
    call lines(1)%new(1, ends, reshape(real([0, 0, 0, 1, 0, 0], real64), [3, 2]))
    call surface%trim_by_curves(lines, stat=stat, errmsg=errmsg)
    call check(stat == PLANISH_STATUS_INVALID_ARGUMENT .and. index(errmsg, "not closed") > 0, "an open loop")
    call check(surface%trim_count() == 2, "trims stay")
  end subroutine

  !> A square between two places on the diagonal.
  function square(from, to) result(ring)
    real(real64), intent(in) :: from, to
    type(planish_curve_t) :: ring
    real(real64) :: points(3, 5)
    points = 0
    points(1, :) = [from, to, to, from, from]
    points(2, :) = [from, from, to, to, from]
    call ring%new(1, real([0, 0, 1, 2, 3, 4, 4], real64), points)
  end function

  subroutine points_are_projected()
    type(planish_surface_t) :: surface
    type(planish_mesh_t) :: mesh
    type(planish_project_options) :: near
    type(planish_deviation_options) :: both_ways
    type(planish_deviation_report) :: report
    real(real64) :: lifted(3, side**2), uv(2, side**2), distances(side**2)
    integer :: stat
    surface = fitted_sheet()
    mesh = flat_sheet()
    lifted = points
    call surface%project(lifted, uv, distances, guesses=points(:2, :))
    ! a distance is the root of a sum of squares that is minimized until it no longer falls
    call check(maxval(distances) <= sqrt(epsilon(1.0_real64)), "nodes lie on the surface")
    call surface%project(lifted, distances=distances)
    lifted(3, 1) = 1
    near%max_distance = 0.5_real64
    call surface%project(lifted, uv, options=near, stat=stat)
    call check(stat == PLANISH_STATUS_POINTS_OUTSIDE .and. all(ieee_is_nan(uv(:, 1))), "a point farther than asked")
    both_ways%measure_back = 1
    call surface%deviation(mesh, distances, both_ways, report)
    call check(report%back_count > 0, "measured back")
    call check(maxval(distances) == report%max_distance, "deviation")
    call check(distances(report%worst_index) == report%max_distance, "its worst_index counts from 1")
    call surface%tessellate(mesh)
    call check(mesh%has_parameters() .and. mesh%loop_count() == 1, "tessellate")
  end subroutine

  subroutine files_are_written()
    type(planish_surface_t) :: surface, again
    type(planish_step_report) :: report
    type(planish_step_options) :: in_inches
    type(planish_vtk_options) :: serial
    type(planish_tessellate_options) :: fine
    integer(int8), allocatable :: bytes(:), bytes_again(:)
    character(200) :: line
    integer :: unit
    surface = fitted_sheet()
    call surface%save(bytes)
    call check(size(bytes, kind=c_size_t) == surface%save_size(), "save_size")
    call again%load(bytes)
    call again%save_file("sheet.planish ")
    call again%load_file("sheet.planish")
    call again%save(bytes_again)
    call check(all(bytes == bytes_again), "saved and loaded to the bit")
    fine%chord_tolerance = 1e-2_real64
    call surface%write_vtk("sheet.vtu", deviation_from=flat_sheet())
    serial%thread_count = 1
    call surface%write_vtk("sheet.vtu", serial, tessellate=fine)
    in_inches%unit = PLANISH_UNIT_INCH
    call surface%write_step("sheet.step", in_inches, product="a sheet", author="nobody", report=report)
    call check(report%loop_count == 1, "the report of a STEP file")
    open (newunit=unit, file="sheet.step", action="read")
    do
      read (unit, "(a)") line
      if (index(line, "PRODUCT('a sheet'") > 0) exit
    end do
    close (unit)
  end subroutine

  subroutine curves_are_evaluated()
    type(planish_curve_t) :: curve
    type(planish_fit_report) :: report
    real(real64) :: u(11), values(11), rows(2, 11), out(2, 2, 11), interval(2)
    real(real64), allocatable :: knots(:), control_points(:, :)
    integer :: i
    u = [(0.1_real64 * i, i=0, 10)]
    call curve%fit(u, 2 * u, report=report)
    call curve%eval(u, values)
    call check(maxval(abs(values - 2 * u)) <= roundoff .and. report%max_error <= roundoff, "a line of numbers")
    rows(1, :) = u
    rows(2, :) = 1 - u
    call curve%fit(u, rows)
    call check(curve%dim() == 2 .and. curve%degree() == 3, "a curve in the plane")
    allocate (knots(curve%knot_count()), control_points(2, curve%control_point_count()))
    call curve%copy_knots(knots)
    call curve%copy_control_points(control_points)
    call check(size(knots) == size(control_points, 2) + 4, "knots and control points")
    call curve%domain(interval)
    call check(interval(1) <= 0 .and. interval(2) >= 1, "domain")
    call curve%eval(u, rows)
    call curve%eval_derivatives(u, 1, out)
    call check(all(out(:, 1, :) == rows), "the curve itself comes first")
    call check(maxval(abs(out(1, 2, :) - 1)) <= 64 * roundoff, "then its derivative")
  end subroutine

  subroutine refusals_are_told()
    type(planish_mesh_t) :: mesh, nothing
    type(planish_surface_t) :: surface
    integer :: stat
    integer(int32) :: nodes(3)
    real(real64) :: broken(3, side**2), uv(3, side**2), uv_grid(1, 0, 0), out(3, 6, side**2)
    character(100) :: errmsg
    character(12) :: short
    errmsg = "as it was"
    call mesh%new(points, triangles, stat=stat, errmsg=errmsg)
    call check(stat == PLANISH_STATUS_OK .and. errmsg == "as it was", "success leaves errmsg")
    broken = points
    broken(2, 5) = ieee_value(1.0_real64, ieee_positive_inf)
    call mesh%new(broken, triangles, stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_NOT_FINITE, "node 4")
    call check(planish_error_index() == 5, "the index counts from 1")
    call check(planish_error_message() == errmsg, "planish_error_message")
    call mesh%read("none.stl", stat=stat, errmsg=short)
    call check(short == "cannot read ", "a short errmsg is cut off")
    call planish_tensor_fit(nothing, surface, stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_NULL_POINTER, "mesh")
    call surface%eval_grid(uv(1, :0), uv(1, :0), uv_grid, stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_NULL_POINTER, "surface")
    surface = fitted_sheet()
    call surface%eval_derivatives(uv, -1, out, stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INVALID_ARGUMENT, "derivative")
    call surface%free()
    call mesh%copy_loop(0, nodes, stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INDEX, "count from 1")
    call mesh%copy_loop(2, nodes, stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INDEX, "loop")
    call mesh%copy_loop(1, nodes, stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_BUFFER_TOO_SMALL, "")
    call mesh%set_parameters(uv, stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INVALID_ARGUMENT, "the first extent of uv is 3, not 2")
    call mesh%cut_along([1, 0], nothing, stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INDEX, "")
    call planish_tensor_fit(mesh, surface, weights=[1.0_real64], stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_BUFFER_TOO_SMALL, "weights has room for 1 of 81")
  end subroutine
end program
