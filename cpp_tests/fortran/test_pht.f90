! PHT-splines from Fortran: cells and vertices count from 1, addresses of cells as in C.
program test_pht
  use, intrinsic :: iso_fortran_env, only: real64, int32
  use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
  use planish
  use checks
  implicit none
  integer, parameter :: side = 9
  !> Values are at most 3, sums of some sixteen products.
  real(real64), parameter :: roundoff = 1000 * epsilon(1.0_real64), unit_line(2) = [0, 1]
  integer :: times = 0

  call options_go_back_to_defaults()
  call cells_and_vertices_count_from_1()
  call cells_are_split_and_merged()
  call regions_are_refined()
  call surfaces_are_simplified()
  call data_come_in_columns()
  call control_points_come_in_columns()
  call extraction_makes_ordinates()
  call weights_are_data()
  call patches_are_the_surface()
  call tensor_surfaces_become_pht()
  call surfaces_are_stitched()
  call shapes_are_fitted()
  call points_are_fitted()
  call fields_are_fitted()
  call refusals_are_told()
  call finish()

contains

  !> A field over seven cells: 1 at the vertex in the middle, flat there and at all others.
  function hat() result(surface)
    type(planish_surface_t) :: surface
    real(real64) :: data(1, 4, 1)
    call planish_pht_new(1, unit_line, unit_line, reshape([0, 0, 0, 1, 0, 0], [3, 2]), surface)
    data(1, :, 1) = [1, 0, 0, 0]
    call planish_pht_set_data(surface, [middle(surface)], data)
  end function

  !> The vertex at the middle of the unit square.
  integer function middle(surface)
    class(planish_surface_t), intent(in) :: surface
    real(real64) :: uv(2, planish_pht_vertex_count(surface))
    call planish_pht_copy_vertices(surface, uv)
    middle = findloc(all(uv == 0.5_real64, 1), .true., 1)
  end function

  real(real64) function value(surface, u, v)
    class(planish_surface_t), intent(in) :: surface
    real(real64), intent(in) :: u, v
    real(real64) :: values(1)
    call surface%eval(reshape([u, v], [2, 1]), values)
    value = values(1)
  end function

  !> Values of a field on an even grid over the unit square.
  function sampled(surface) result(values)
    class(planish_surface_t), intent(in) :: surface
    real(real64) :: values(1, 21, 21)
    integer :: i
    call surface%eval_grid([(0.05_real64 * i, i=0, 20)], [(0.05_real64 * i, i=0, 20)], values)
  end function

  function flat_sheet() result(mesh)
    type(planish_mesh_t) :: mesh
    real(real64), allocatable :: points(:, :)
    integer(int32), allocatable :: triangles(:, :)
    call make_sheet(side, points, triangles)
    call mesh%new(points, triangles)
    call mesh%set_parameters(points(:2, :))
  end function

  logical function count_on(fraction, error)
    real(real64), intent(in) :: fraction, error
    times = times + 1
    count_on = fraction >= 0 .and. (ieee_is_nan(error) .or. error >= 0)
  end function

  subroutine options_go_back_to_defaults()
    type(planish_pht_options) :: fit
    type(planish_pht_convert_options) :: convert
    fit%grade = 7
    convert%max_level = 7
    call planish_options_init(fit)
    call planish_options_init(convert)
    call check(fit%grade == 1 .and. convert%max_level == 12, "defaults")
  end subroutine

  subroutine cells_and_vertices_count_from_1()
    type(planish_surface_t) :: surface
    integer(int32) :: cells(3, 7), hosts(2)
    integer, allocatable :: neighbours(:)
    real(real64) :: uv(2, 12), hanging(2, 2)
    integer :: i
    surface = hat()
    call check(surface%kind() == PLANISH_KIND_PHT .and. planish_pht_width(surface) == 1, "kind and width")
    call check(planish_pht_cell_count(surface) == 7 .and. surface%patch_count() == 7, "cell_count")
    call check(planish_pht_vertex_count(surface) == 12, "vertex_count")
    call check(planish_pht_hanging_count(surface) == 2, "hanging_count")
    call planish_pht_copy_cells(surface, cells)
    call check(count(cells(1, :) == 2) == 4 .and. minval(cells(2:, :)) == 0, "four cells of level 2, from 0")
    call planish_pht_copy_vertices(surface, uv)
    call check(all(uv(:, 1) == 0) .and. all(uv(:, 12) == 1), "vertices from corner to corner")
    ! of the split quarter the two edges inside have a T-vertex each
    call planish_pht_copy_hanging(surface, hanging, hosts)
    call check(all(abs(sum(hanging, 1) - 0.75_real64) == 0), "T-vertices at (1/2,1/4) and (1/4,1/2)")
    do i = 1, 2
      call check(cells(1, hosts(i)) == 1 .and. all(cells(2:, hosts(i)) == merge(1, 0, hanging(:, i) == 0.5_real64)), &
          "its host lies beyond the edge")
    end do
    call check(planish_pht_cell_at(surface, 0.9_real64, 0.9_real64) > 0, "cell_at")
    call check(all(cells(:, planish_pht_cell_at(surface, 0.9_real64, 0.9_real64)) == [1, 1, 1]), "cells count from 1")
    call planish_pht_copy_neighbours(surface, planish_pht_cell_at(surface, 0.9_real64, 0.9_real64), neighbours)
    call check(size(neighbours) == 2, "a corner has two neighbours")
    call check(all(cells(:, neighbours(1)) == [1, 0, 1]) .and. all(cells(:, neighbours(2)) == [1, 1, 0]), &
        "at least u, then at least v")
  end subroutine

  subroutine cells_are_split_and_merged()
    type(planish_surface_t) :: surface, same
    integer(int32) :: cells(3, 3)
    surface = hat()
    same = surface
    cells = reshape([1, 0, 1, 2, 1, 2, 3, 2, 5], [3, 3])
    call planish_pht_split(same, cells)
    call check(planish_pht_cell_count(same) == 16, "three cells become twelve")
    call check(maxval(abs(sampled(same) - sampled(surface))) <= roundoff, "a split keeps the surface")
    call planish_pht_merge(same, cells(:, 3:1:-1))
    call check(planish_pht_cell_count(same) == 7 .and. all(sampled(same) == sampled(surface)), "a merge undoes it")
  end subroutine

  subroutine regions_are_refined()
    type(planish_surface_t) :: surface
    integer :: stat
    character(100) :: errmsg
    surface = hat()
    call planish_pht_refine_region(surface, [0.5_real64, 1.0_real64, 0.5_real64, 1.0_real64], 3, 1000)
    call check(planish_pht_cell_count(surface) == 6 + 16, "a quarter becomes sixteen cells")
    call planish_pht_refine_region(surface, [0.0_real64, 1.0_real64, 0.0_real64, 1.0_real64], 5, 100, stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_TOO_LARGE, "")
  end subroutine

  subroutine surfaces_are_simplified()
    type(planish_surface_t) :: surface, simple
    real(real64) :: deviation
    surface = hat()
    simple = surface
    call planish_pht_simplify(simple, 2.0_real64, deviation)
    call check(planish_pht_cell_count(simple) == 1 .and. deviation <= 2, "all cells are merged")
    call check(maxval(abs(sampled(simple) - sampled(surface))) <= deviation + roundoff, "deviation bounds the change")
  end subroutine

  subroutine data_come_in_columns()
    type(planish_surface_t) :: surface, again
    integer(int32) :: splits(3, 2)
    real(real64) :: data(1, 4, 12), slope(1, 4, 1), out(1, 3, 1)
    surface = hat()
    call planish_pht_copy_data(surface, data)
    call check(data(1, 1, middle(surface)) == 1 .and. sum(abs(data)) == 1, "1 in the middle, else 0")
    call check(value(surface, 0.5_real64, 0.5_real64) == 1, "where the surface has it")
    splits = reshape([0, 0, 0, 1, 0, 0], [3, 2])
    call planish_pht_new(1, unit_line, unit_line, splits, again, data)
    call check(all(sampled(again) == sampled(surface)), "made of its data")
    slope(1, :, 1) = [0, 0, 5, 0]
    call planish_pht_set_data(surface, [middle(surface)], slope)
    call surface%eval_derivatives(reshape([0.5_real64, 0.5_real64], [2, 1]), 1, out)
    call check(all(abs(out(1, :, 1) - [0, 0, 5]) <= roundoff), "the third of four is f_v")
  end subroutine

  subroutine control_points_come_in_columns()
    type(planish_surface_t) :: surface
    real(real64) :: points(1, 4, 12)
    surface = hat()
    call planish_pht_copy_control_points(surface, PLANISH_PHT_BASIS_CANONICAL, points)
    ! a flat vertex has four equal points
    call check(all(abs(points(1, :, middle(surface)) - 1) <= roundoff), "four points in the middle")
    call check(abs(sum(points) - 4) <= roundoff, "and zeros elsewhere")
    points(1, :, 1) = 2
    call planish_pht_set_control_points(surface, [1], PLANISH_PHT_BASIS_CANONICAL, points(:, :, :1))
    call check(abs(value(surface, 0.0_real64, 0.0_real64) - 2) <= roundoff, "vertex 1 is the first corner")
  end subroutine

  subroutine extraction_makes_ordinates()
    type(planish_surface_t) :: surface
    type(planish_patch) :: patch
    integer(int32), allocatable :: vertices(:)
    real(real64), allocatable :: matrix(:, :, :)
    real(real64) :: points(1, 4, 12), ordinates(1, 4, 4), made(16)
    integer :: cell, k
    surface = hat()
    call planish_pht_copy_control_points(surface, PLANISH_PHT_BASIS_SUPPORT_SIZED, points)
    do cell = 1, int(planish_pht_cell_count(surface))
      call planish_pht_copy_extraction(surface, cell, PLANISH_PHT_BASIS_SUPPORT_SIZED, vertices, matrix)
      call check(minval(vertices) >= 1 .and. maxval(vertices) <= 12, "vertices count from 1")
      call surface%copy_patch(cell, patch, ordinates)
      made = [(sum(matrix(:, :, k) * points(1, :, vertices)), k=1, 16)]
      call check(maxval(abs(made - reshape(ordinates, [16]))) <= roundoff, "the ordinates of the cell's patch")
    end do
  end subroutine

  subroutine weights_are_data()
    type(planish_surface_t) :: surface
    real(real64) :: data(2, 4, 4)
    integer :: corner
    data = 0
    do corner = 1, 4
      data(:, 1, corner) = [2, 4] ! a value of 1/2 with weight 4
    end do
    call planish_pht_new(1, unit_line, unit_line, reshape([integer(int32) ::], [3, 0]), surface, data, &
        is_rational=.true.)
    call check(planish_pht_width(surface) == 2 .and. surface%dim() == 1, "the width has the weight")
    call check(abs(value(surface, 0.3_real64, 0.6_real64) - 0.5_real64) <= roundoff, "values are divided by it")
  end subroutine

  subroutine patches_are_the_surface()
    type(planish_surface_t) :: surface
    type(planish_surface_t), allocatable :: patches(:)
    real(real64) :: box(4), area
    integer :: i
    surface = hat()
    call planish_pht_to_tensor_patches(surface, 20, patches)
    call check(size(patches) == 1 .and. patches(1)%kind() == PLANISH_KIND_TENSOR, "one for all levels")
    call check(maxval(abs(sampled(patches(1)) - sampled(surface))) <= roundoff, "it is the surface")
    call planish_pht_to_tensor_patches(surface, 0, patches)
    area = 0
    do i = 1, size(patches)
      call patches(i)%domain(box)
      area = area + (box(2) - box(1)) * (box(4) - box(3))
    end do
    call check(size(patches) > 1 .and. area == 1, "several that cover the domain")
    deallocate (patches)
  end subroutine

  subroutine tensor_surfaces_become_pht()
    type(planish_surface_t) :: tensor, surface
    type(planish_pht_convert_options) :: few
    integer :: stat
    character(100) :: errmsg
    call planish_tensor_new(2, 2, [0, 0, 0, 1, 1, 1] * 1.0_real64, [0, 0, 0, 1, 1, 1] * 1.0_real64, &
        reshape([0, 1, 0, 2, 3, 1, 0, 0, 1] * 1.0_real64, [1, 3, 3]), tensor)
    call planish_pht_from_surface(tensor, surface)
    call check(surface%kind() == PLANISH_KIND_PHT, "from_surface")
    call check(maxval(abs(sampled(surface) - sampled(tensor))) <= roundoff, "the same surface")
    few%max_cells = 0
    call planish_pht_from_surface(tensor, surface, few, stat, errmsg)
    call check(stat < 0, "limits are kept")
  end subroutine

  subroutine surfaces_are_stitched()
    type(planish_surface_t) :: first, second
    integer :: i
    first = hat()
    second = hat()
    call planish_pht_split(second, reshape([1, 1, 0], [3, 1]))
    call planish_pht_stitch(first, PLANISH_BORDER_SIDE_HIGH_U, second, PLANISH_BORDER_SIDE_LOW_V, is_reversed=.true.)
    call check(all([(abs(value(first, 1.0_real64, 0.1_real64 * i) - value(second, 1 - 0.1_real64 * i, 0.0_real64)) &
        <= roundoff, i=0, 10)]), "the edges meet")
    call planish_pht_stitch(first, PLANISH_BORDER_SIDE_HIGH_U, second, PLANISH_BORDER_SIDE_LOW_U)
    call check(planish_pht_cell_count(first) >= 7, "and others too")
  end subroutine

  subroutine shapes_are_fitted()
    type(planish_surface_t) :: surface
    type(planish_pht_options) :: options
    type(planish_fit_report) :: report
    real(real64) :: uv(2, side**2), errors(side**2), values(3, side**2), points(3, side**2)
    type(planish_mesh_t) :: mesh
    mesh = flat_sheet()
    call mesh%copy_points(points)
    options%tolerance = 1e-3_real64
    call planish_pht_fit(mesh, surface, options, report, weights=spread(2.0_real64, 1, side**2), parameters=uv, &
        errors=errors, progress=count_on)
    call check(surface%kind() == PLANISH_KIND_PHT .and. surface%dim() == 3, "a PHT-spline in space")
    call check(report%max_error <= report%tolerance, "the tolerance is kept")
    call check(report%cell_count == planish_pht_cell_count(surface), "cells of the report")
    call check(maxloc(errors, 1) == report%worst_index, "worst_index counts from 1")
    call surface%eval(uv, values)
    call check(maxval(abs(norm2(values - points, 1) - errors)) <= roundoff, "errors are those at parameters")
    call check(times > 0, "progress is heard")
  end subroutine

  subroutine points_are_fitted()
    type(planish_surface_t) :: numbers, rows
    type(planish_fit_report) :: report
    real(real64) :: uv(2, side**2), points(3, side**2), values(1, side**2), single(side**2)
    type(planish_mesh_t) :: mesh
    mesh = flat_sheet()
    call mesh%copy_points(points)
    uv = points(:2, :)
    values = points(3:3, :)
    call planish_pht_fit_points(uv, values, rows, report=report)
    call check(report%max_error <= report%tolerance, "rows of one number")
    call planish_pht_fit_points(uv, values(1, :), numbers)
    call check(all(sampled(numbers) == sampled(rows)), "or numbers")
    call numbers%eval(uv, single)
    call check(maxval(abs(single - values(1, :))) <= report%max_error + roundoff, "as far as the report says")
  end subroutine

  subroutine fields_are_fitted()
    type(planish_surface_t) :: numbers, rows
    type(planish_pht_options) :: options
    type(planish_parameterize_options) :: map
    type(planish_fit_report) :: report
    real(real64) :: points(3, side**2)
    type(planish_mesh_t) :: mesh
    mesh = flat_sheet()
    call mesh%copy_points(points)
    options%regularize = PLANISH_REGULARIZE_NEVER
    options%grid_u = 2
    call planish_pht_fit_field(mesh, points(3:3, :), rows, options, report, map)
    call check(report%max_error <= report%tolerance .and. report%cell_count >= 2, "rows of one number")
    call planish_pht_fit_field(mesh, points(3, :), numbers, options)
    call check(all(sampled(numbers) == sampled(rows)), "or numbers")
  end subroutine

  subroutine refusals_are_told()
    type(planish_surface_t) :: surface, nothing
    real(real64) :: data(1, 4, 2), wide(2, 4, 12), uv(2, 1)
    integer(int32) :: cells(3, 1), hosts(1)
    integer, allocatable :: neighbours(:)
    integer :: stat
    character(100) :: errmsg
    surface = hat()
    data = 0
    wide = 0
    call planish_pht_split(surface, reshape([1, 1, 1, 1, 0, 0], [3, 2]), stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INDEX, "")
    call check(planish_error_index() == 2 .and. planish_pht_cell_count(surface) == 7, "the second cell is no leaf")
    call planish_pht_merge(surface, reshape([1, 1], [2, 1]), stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INVALID_ARGUMENT, "the first extent of cells is 2, not 3")
    call planish_pht_set_data(surface, [1, 0], data, stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INDEX, "count from 1")
    call planish_pht_set_data(surface, [1, 13], data, stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INDEX, "")
    call planish_pht_set_data(surface, [1], data, stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INVALID_ARGUMENT, "the third extent of data is 2, not 1")
    call planish_pht_copy_data(surface, data, stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_BUFFER_TOO_SMALL, "")
    call planish_pht_copy_control_points(surface, PLANISH_PHT_BASIS_CANONICAL, wide, stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INVALID_ARGUMENT, "the first extent of points is 2, not 1")
    call planish_pht_copy_cells(surface, cells, stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_BUFFER_TOO_SMALL, "")
    call planish_pht_copy_hanging(surface, uv, hosts, stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_BUFFER_TOO_SMALL, "")
    call planish_pht_copy_neighbours(surface, 8, neighbours, stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INDEX, "")
    call planish_pht_copy_neighbours(surface, 0, neighbours, stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INDEX, "count from 1")
    call planish_pht_simplify(surface, -1.0_real64, stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INVALID_ARGUMENT, "tolerance")
    call planish_pht_refine_region(surface, [0, 1, 0, 1] * 1.0_real64, 2, -1, stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INVALID_ARGUMENT, "max_cells")
    call planish_pht_new(0, unit_line, unit_line, cells(:, :0), nothing, stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INVALID_ARGUMENT, "dim")
    call planish_pht_split(nothing, cells(:, :0), stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_NULL_POINTER, "surface")
    call planish_pht_copy_data(nothing, data, stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_NULL_POINTER, "surface")
    call check(planish_pht_cell_at(nothing, 0.5_real64, 0.5_real64) == 0, "nothing has no cells")
  end subroutine
end program
