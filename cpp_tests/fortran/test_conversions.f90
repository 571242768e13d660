! What surfaces are turned into: refined, reversed and split surfaces, patches, triangles, files.
program test_conversions
  use, intrinsic :: iso_c_binding, only: c_int32_t
  use, intrinsic :: iso_fortran_env, only: real64
  use planish
  use checks
  implicit none
  !> Control points are below 1 and each step makes some ten combinations of them.
  real(real64), parameter :: roundoff = 1000 * epsilon(1.0_real64)

  call options_go_back_to_defaults()
  call knots_are_inserted()
  call degrees_are_raised()
  call surfaces_are_reversed()
  call surfaces_are_split()
  call patches_count_from_1()
  call surfaces_become_tensor_surfaces()
  call meshes_come_with_a_report()
  call files_show_what_is_asked()
  call curves_have_parts()
  call refusals_are_told()
  call finish()

contains

  !> A surface of degrees 1 and 2 over [0,1] x [0,2], with weights if asked for.
  function ribbon(has_weights) result(surface)
    logical, intent(in) :: has_weights
    type(planish_surface_t) :: surface
    real(real64) :: knots_u(4), knots_v(6), control_points(3, 3, 2)
    knots_u = [0, 0, 1, 1]
    knots_v = [0, 0, 0, 2, 2, 2]
    control_points = reshape([0, 0, 0, 0, 4, 3, 0, 8, 0, 8, 0, 1, 8, 4, 5, 8, 8, 2] / 8.0_real64, [3, 3, 2])
    if (has_weights) then
      call planish_tensor_new(1, 2, knots_u, knots_v, control_points, surface, &
          reshape([1, 2, 1, 1, 3, 1] * 1.0_real64, [3, 2]))
    else
      call planish_tensor_new(1, 2, knots_u, knots_v, control_points, surface)
    end if
  end function

  function value(surface, u, v)
    class(planish_surface_t), intent(in) :: surface
    real(real64), intent(in) :: u, v
    real(real64) :: value(3), values(3, 1)
    call surface%eval(reshape([u, v], [2, 1]), values)
    value = values(:, 1)
  end function

  !> Values on an even grid over [0,1] x [0,2].
  function sampled(surface) result(values)
    class(planish_surface_t), intent(in) :: surface
    real(real64) :: values(3, 9, 9)
    integer :: i
    call surface%eval_grid([(i / 8.0_real64, i=0, 8)], [(i / 4.0_real64, i=0, 8)], values)
  end function

  subroutine options_go_back_to_defaults()
    type(planish_convert_options) :: convert
    type(planish_skin_options) :: skin
    convert%max_coefficients = 7
    skin%extra_checks = 7
    call planish_options_init(convert)
    call planish_options_init(skin)
    call check(convert%max_coefficients == 4000000 .and. skin%extra_checks == 3, "defaults")
  end subroutine

  subroutine knots_are_inserted()
    type(planish_surface_t) :: surface, same
    surface = ribbon(has_weights=.true.)
    same = surface
    call planish_tensor_insert_knots(same, PLANISH_AXIS_V, [1.5_real64, 0.5_real64])
    call check(planish_tensor_control_point_count(same, PLANISH_AXIS_V) == 5, "two control points more along v")
    call check(planish_tensor_control_point_count(same, PLANISH_AXIS_U) == 2, "and none along u")
    call check(maxval(abs(sampled(same) - sampled(surface))) <= roundoff, "insertion keeps the surface")
  end subroutine

  subroutine degrees_are_raised()
    type(planish_surface_t) :: surface, same
    surface = ribbon(has_weights=.true.)
    same = surface
    call planish_tensor_elevate_degree(same, PLANISH_AXIS_U, 3)
    call check(planish_tensor_degree(same, PLANISH_AXIS_U) == 3, "the degree along u is raised")
    call check(planish_tensor_degree(same, PLANISH_AXIS_V) == 2, "that along v is not")
    call check(maxval(abs(sampled(same) - sampled(surface))) <= roundoff, "elevation keeps the surface")
  end subroutine

  subroutine surfaces_are_reversed()
    type(planish_surface_t) :: surface, turned
    real(real64) :: values(3, 9, 9)
    surface = ribbon(has_weights=.false.)
    turned = surface
    call planish_tensor_reverse(turned, PLANISH_AXIS_V)
    values = sampled(turned)
    call check(maxval(abs(values(:, 9:1:-1, :) - sampled(surface))) <= roundoff, "v runs the other way")
  end subroutine

  subroutine surfaces_are_split()
    type(planish_surface_t) :: surface, lower, upper
    real(real64) :: below(4), above(4)
    surface = ribbon(has_weights=.false.)
    call planish_tensor_split(surface, PLANISH_AXIS_V, 0.5_real64, lower, upper)
    call lower%domain(below)
    call upper%domain(above)
    call check(all(below == [0.0_real64, 1.0_real64, 0.0_real64, 0.5_real64]), "below the cut")
    call check(all(above == [0.0_real64, 1.0_real64, 0.5_real64, 2.0_real64]), "above the cut")
    call check(all(abs(value(lower, 0.25_real64, 0.25_real64) - value(surface, 0.25_real64, 0.25_real64)) <= roundoff) &
        .and. all(abs(value(upper, 0.25_real64, 1.5_real64) - value(surface, 0.25_real64, 1.5_real64)) <= roundoff), &
        "parts keep the surface")
  end subroutine

  subroutine patches_count_from_1()
    type(planish_surface_t) :: surface, nothing
    type(planish_patch) :: patch
    real(real64) :: corner(3), ordinates(4, 3, 2)
    surface = ribbon(has_weights=.true.)
    call planish_tensor_insert_knots(surface, PLANISH_AXIS_V, [0.5_real64])
    call check(surface%patch_count() == 2, "two patches")
    call check(surface%patch_at(0.5_real64, 0.25_real64) == 1 .and. surface%patch_at(0.5_real64, 1.0_real64) == 2, &
        "the first lies below, the second above")
    call check(nothing%patch_count() == 0 .and. nothing%patch_at(0.0_real64, 0.0_real64) == 0, "nothing has no patches")
    call surface%copy_patch(2, patch)
    call check(patch%degree_u == 1 .and. patch%degree_v == 2 .and. patch%is_rational == 1, "degrees and weights")
    call check(patch%ordinate_width == size(ordinates, 1) .and. patch%ordinate_count == 6, "how many ordinates")
    call check(patch%v_min == 0.5_real64 .and. patch%v_max == 2, "where it lies")
    call surface%copy_patch(2, patch, ordinates)
    corner = ordinates(:3, 3, 1) / ordinates(4, 3, 1)
    call check(all(abs(corner - value(surface, 0.0_real64, 2.0_real64)) <= roundoff), "v runs fastest")
    corner = ordinates(:3, 1, 2) / ordinates(4, 1, 2)
    call check(all(abs(corner - value(surface, 1.0_real64, 0.5_real64)) <= roundoff), "u runs slowest")
  end subroutine

  subroutine surfaces_become_tensor_surfaces()
    type(planish_surface_t) :: surface, tensor
    type(planish_convert_options) :: few
    integer :: stat
    character(100) :: errmsg
    surface = ribbon(has_weights=.true.)
    call surface%to_tensor(tensor)
    call check(tensor%kind() == PLANISH_KIND_TENSOR .and. all(sampled(tensor) == sampled(surface)), "the same surface")
    few%max_coefficients = 5
    call surface%to_tensor(tensor, few, stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_TOO_LARGE, "")
  end subroutine

  subroutine meshes_come_with_a_report()
    type(planish_surface_t) :: surface
    type(planish_mesh_t) :: mesh
    type(planish_tessellate_options) :: fine
    type(planish_tessellate_report) :: report
    surface = ribbon(has_weights=.false.)
    fine%chord_tolerance = 1e-3_real64
    call surface%tessellate(mesh, fine, report)
    call check(mesh%triangle_count() > 0, "triangles")
    call check(report%chord_error > 0 .and. report%chord_error <= fine%chord_tolerance, "the chord tolerance is kept")
    call check(report%smallest_angle > 0 .and. report%smallest_angle <= acos(-1.0_real64) / 3, "an angle of a triangle")
  end subroutine

  subroutine files_show_what_is_asked()
    type(planish_surface_t) :: surface
    type(planish_vtk_options) :: options
    surface = ribbon(has_weights=.false.)
    options%content = PLANISH_VTK_CONTENT_PATCHES
    call surface%write_vtk("ribbon.vtu", options)
    call check(index(piece("ribbon.vtu"), '"6" NumberOfCells="1"') > 0, "six ordinates of one patch")
    options%content = PLANISH_VTK_CONTENT_CONTROL_NET
    call surface%write_vtk("ribbon.vtu", options)
    call check(index(piece("ribbon.vtu"), '"6" NumberOfCells="5"') > 0, "three lines along u, two along v")
  end subroutine

  !> The line of a VTK file that says how many points and cells it has.
  function piece(path) result(line)
    character(*), intent(in) :: path
    character(100) :: line
    integer :: unit
    open (newunit=unit, file=path, action="read")
    line = ""
    do while (index(line, "<Piece") == 0)
      read (unit, "(a)") line
    end do
    close (unit)
  end function

  subroutine curves_have_parts()
    type(planish_curve_t) :: curve
    real(real64) :: knots(6), control_points(2, 3), knots_back(6), back(2, 3), values(2, 2)
    knots = [0, 0, 0, 2, 2, 2]
    control_points = reshape([0, 0, 1, 2, 2, 0] * 1.0_real64, [2, 3])
    call curve%new(2, knots, control_points)
    call check(curve%dim() == 2 .and. curve%degree() == 2, "dim and degree")
    call curve%copy_knots(knots_back)
    call curve%copy_control_points(back)
    call check(all(knots_back == knots) .and. all(back == control_points), "parts come back")
    call curve%eval([1.0_real64, 2.0_real64], values)
    call check(all(abs(values - reshape([1, 1, 2, 0], [2, 2])) <= roundoff), "a parabola")
  end subroutine

  subroutine refusals_are_told()
    type(planish_surface_t) :: surface, nothing
    type(planish_patch) :: patch
    real(real64) :: ordinates(3, 2, 3)
    integer :: stat
    character(100) :: errmsg
    surface = ribbon(has_weights=.false.)
    call surface%copy_patch(0, patch, stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INDEX, "count from 1")
    call surface%copy_patch(2, patch, stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INDEX, "")
    call surface%copy_patch(1, patch, ordinates, stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INVALID_ARGUMENT, "the second extent of ordinates is 2, not 3")
    call planish_tensor_insert_knots(surface, PLANISH_AXIS_U, [0.5_real64, 7.0_real64], stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_OUTSIDE, "")
    call planish_tensor_elevate_degree(surface, PLANISH_AXIS_V, 1, stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INVALID_ARGUMENT, "")
    call planish_tensor_reverse(surface, 2_c_int32_t, stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_INVALID_ARGUMENT, "")
    call planish_tensor_split(surface, PLANISH_AXIS_U, 1.0_real64, nothing, nothing, stat, errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_OUTSIDE, "")
    call check(nothing%kind() == PLANISH_KIND_NONE, "what is refused makes nothing")
    call nothing%to_tensor(surface, stat=stat, errmsg=errmsg)
    call check_fails(stat, errmsg, PLANISH_STATUS_NULL_POINTER, "surface")
    call check(surface%kind() == PLANISH_KIND_TENSOR, "what was there stays")
  end subroutine
end program
