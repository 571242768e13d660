! Splines over triangular control meshes from Fortran: made, inspected, changed and fitted.
program test_d1rc
  use, intrinsic :: iso_fortran_env, only: real64, int32
  use planish
  use checks
  implicit none
  integer, parameter :: side = 9, count = side**2
  !> Some hundred products of numbers of about 1.
  real(real64), parameter :: roundoff = 1e3_real64 * epsilon(1.0_real64)
  real(real64), allocatable :: points(:, :)
  integer(int32), allocatable :: triangles(:, :)

  call make_sheet(side, points, triangles)
  call options_go_back_to_defaults()
  call functions_sum_to_one_and_keep_planes()
  call control_points_move_the_faces_they_influence()
  call sharp_edges_are_creases()
  call functions_are_told()
  call meshes_are_fitted()
  call refusals_are_told()
  deallocate (points, triangles) ! valgrind counts what a main program leaves
  call finish()

contains

  function control_mesh() result(mesh)
    type(planish_mesh_t) :: mesh
    call mesh%new(points, triangles)
    call mesh%set_parameters(points(:2, :))
  end function

  subroutine options_go_back_to_defaults()
    type(planish_d1rc_options) :: options
    options%degree = 1
    call planish_options_init(options)
    call check(options%degree == 3 .and. options%mode == PLANISH_D1RC_MODE_REPRODUCING, "defaults")
  end subroutine

  subroutine functions_sum_to_one_and_keep_planes()
    type(planish_surface_t) :: surface
    type(planish_d1rc_options) :: options
    real(real64) :: uv(2, 3), shares(3), sums(3), row(3, 3)
    integer :: vertex, degree
    uv = reshape([0.31_real64, 0.42_real64, 0.7_real64, 0.2_real64, 0.55_real64, 0.9_real64], [2, 3])
    do degree = 1, 3
      options%degree = degree
      call planish_d1rc_new(control_mesh(), surface, options)
      call check(surface%kind() == PLANISH_KIND_D1RC, "the kind")
      call check(planish_d1rc_degree(surface) == degree, "the degree")
      call check(surface%coefficient_count() == count, "a control point for each node")
      sums = 0
      do vertex = 1, count
        call planish_d1rc_blending_values(surface, vertex, uv, shares)
        sums = sums + shares
      end do
      call check(all(abs(sums - 1) < roundoff), "blending values sum to one")
      call surface%eval(uv, row)
      call check(all(abs(row(:2, :) - uv) < roundoff), "planes are kept")
    end do
  end subroutine

  subroutine control_points_move_the_faces_they_influence()
    type(planish_surface_t) :: surface
    integer(int32), allocatable :: faces(:)
    real(real64) :: before(3, count), after(3, count), uv(2, 1), low(3, 1), high(3, 1), share(1)
    integer, parameter :: middle = (count + 1) / 2
    call planish_d1rc_new(control_mesh(), surface)
    call planish_d1rc_copy_control_points(surface, before)
    call check(all(before == points), "control points are the nodes")
    call planish_d1rc_copy_influence(surface, middle, faces)
    call check(size(faces) > 6 .and. size(faces) < size(triangles, 2), "influence is local")
    uv(:, 1) = points(:2, middle)
    call surface%eval(uv, low)
    call planish_d1rc_set_control_points(surface, [middle], points(:, middle:middle) + 1)
    call planish_d1rc_copy_control_points(surface, after)
    call check(all(after(:, middle) == points(:, middle) + 1), "the control point moved")
    call surface%eval(uv, high)
    call planish_d1rc_blending_values(surface, middle, uv, share)
    call check(all(abs(high(:, 1) - low(:, 1) - share(1)) < roundoff), "the surface moved by its share")
  end subroutine

  subroutine sharp_edges_are_creases()
    type(planish_surface_t) :: surface
    integer(int32), allocatable :: edges(:, :)
    integer(int32) :: orders(1)
    type(planish_d1rc_options) :: options
    integer(int32) :: inner(2, 1)
    inner(:, 1) = inner_edge()
    options%degree = 2
    call planish_d1rc_new(control_mesh(), surface, options)
    call planish_d1rc_edge_continuity(surface, inner, orders)
    call check(orders(1) == 1, "smooth without sharp edges")
    call planish_d1rc_set_sharp_edges(surface, inner)
    call planish_d1rc_copy_sharp_edges(surface, edges)
    call check(all(edges == inner), "the sharp edge is told")
    call planish_d1rc_edge_continuity(surface, inner, orders)
    call check(orders(1) == 0, "a crease is only continuous")
  end subroutine

  !> An edge away from the border.
  function inner_edge() result(ends)
    integer(int32) :: ends(2)
    integer :: k
    do k = 1, size(triangles, 2)
      ends = triangles(:2, k)
      if (all(abs(points(:2, ends) - 0.5_real64) < 0.3_real64)) return
    end do
  end function

  subroutine functions_are_told()
    type(planish_surface_t) :: surface
    integer(int32), allocatable :: knots(:), edges(:, :)
    real(real64), allocatable :: uv(:, :)
    call planish_d1rc_new(control_mesh(), surface)
    call planish_d1rc_copy_configuration(surface, int(planish_d1rc_configuration_count(surface)), knots, edges)
    call check(size(knots) == 3 .and. size(edges, 2) >= 3, "a function of degree 3")
    call check(minval(edges) >= 1 .and. maxval(edges) <= planish_d1rc_knot_count(surface), "knots count from 1")
    allocate (uv(2, planish_d1rc_knot_count(surface)))
    call planish_d1rc_copy_knots(surface, uv)
    call check(all(uv(:, :count) == points(:2, :)), "the first knots are the nodes")
  end subroutine

  subroutine meshes_are_fitted()
    type(planish_surface_t) :: surface
    type(planish_d1rc_options) :: options
    type(planish_fit_report) :: report
    real(real64) :: errors(count)
    options%tolerance = 1e-2_real64
    call planish_d1rc_fit(control_mesh(), surface, options, report, errors=errors)
    call check(maxval(errors) == report%max_error, "the report has the largest error")
    call check(report%max_error <= report%tolerance, "the tolerance is met")
  end subroutine

  subroutine refusals_are_told()
    type(planish_surface_t) :: surface
    integer(int32), allocatable :: faces(:)
    integer :: stat
    character(200) :: errmsg
    call planish_d1rc_new(control_mesh(), surface, sharp_edges=reshape([1, count], [2, 1]), stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_TOPOLOGY, "edge")
    call check(surface%coefficient_count() == 0, "nothing is made")
    call planish_d1rc_new(control_mesh(), surface)
    call planish_d1rc_copy_influence(surface, count + 1, faces, stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INDEX, "81")
    call planish_d1rc_set_control_points(surface, [0], points(:, :1), stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INDEX, "count from 1")
  end subroutine
end program
