! Handles are assigned, passed and returned in every way that the module promises; valgrind counts them.
program test_handles
  use, intrinsic :: iso_c_binding
  use, intrinsic :: iso_fortran_env, only: real64, int8
  use planish
  use checks
  implicit none
  call assignment_makes_a_deep_copy()
  call assignment_of_nothing_frees()
  call assignment_to_itself_keeps()
  call function_results_are_freed()
  call arrays_copy_their_elements()
  call allocatables_free_what_they_hold()
  call arguments_pass_through()
  call constructors_free_what_was_there()
  call failures_leave_what_was_there()
  call c_takes_part()
  call curves_are_alike()
  call meshes_are_alike()
  call finish()

contains

  !> A bilinear scalar surface: the value at (u,v) is `height` u v.
  function saddle(height) result(surface)
    real(real64), intent(in) :: height
    type(planish_surface_t) :: surface
    real(real64) :: knots(4), control_points(1, 2, 2)
    knots = [0, 0, 1, 1]
    control_points = 0
    control_points(1, 2, 2) = height
    call planish_tensor_new(1, 1, knots, knots, control_points, surface)
  end function

  function saddles() result(surfaces)
    type(planish_surface_t) :: surfaces(2)
    surfaces(1) = saddle(1.0_real64)
    surfaces(2) = saddle(2.0_real64)
  end function

  function some_saddles(n) result(surfaces)
    integer, intent(in) :: n
    type(planish_surface_t), allocatable :: surfaces(:)
    integer :: i
    allocate (surfaces(n))
    do i = 1, n
      surfaces(i) = saddle(real(i, real64))
    end do
  end function

  function one_saddle(height) result(surface)
    real(real64), intent(in) :: height
    type(planish_surface_t), allocatable :: surface
    allocate (surface)
    surface = saddle(height)
  end function

  !> What saddle() was made with.
  real(real64) function height(surface)
    class(planish_surface_t), intent(in) :: surface
    real(real64) :: uv(2, 1), value(1)
    uv = 1
    call surface%eval(uv, value)
    height = value(1)
  end function

  subroutine assignment_makes_a_deep_copy()
    type(planish_surface_t) :: first, second
    first = saddle(1.0_real64)
    second = first
    call check(.not. c_associated(first%get(), second%get()), "a copy is another surface")
    first = saddle(3.0_real64)
    call check(height(first) == 3 .and. height(second) == 1, "a copy lives on its own")
    call first%free()
    call check(height(second) == 1, "a copy outlives the original")
  end subroutine

  subroutine assignment_of_nothing_frees()
    type(planish_surface_t) :: surface, nothing
    surface = saddle(1.0_real64)
    surface = nothing
    call check(.not. c_associated(surface%get()) .and. surface%dim() == 0, "nothing is assigned")
    nothing = surface
    call check(nothing%kind() == PLANISH_KIND_NONE, "nothing is assigned to nothing")
  end subroutine

  subroutine assignment_to_itself_keeps()
    type(planish_surface_t) :: surface, several(2)
    surface = saddle(4.0_real64)
    surface = surface
    call check(height(surface) == 4, "a surface assigned to itself")
    several = saddles()
    several = several
    several(2) = several(2)
    call check(height(several(1)) == 1 .and. height(several(2)) == 2, "an array assigned to itself")
  end subroutine

  subroutine function_results_are_freed()
    type(planish_surface_t) :: surface, several(2)
    integer :: i
    do i = 1, 3
      surface = saddle(real(i, real64))
    end do
    call check(height(surface) == 3, "a result in a loop")
    call check(height(saddle(5.0_real64)) == 5, "a result as an argument")
    surface = one_saddle(6.0_real64)
    call check(height(surface) == 6, "an allocatable result")
    several = saddles()
    call check(height(several(2)) == 2, "a result of two")
    several = some_saddles(2)
    call check(height(several(1)) == 1, "an allocatable result of two")
    several = [saddle(7.0_real64), saddle(8.0_real64)]
    call check(height(several(1)) == 7 .and. height(several(2)) == 8, "results in an array constructor")
  end subroutine

  subroutine arrays_copy_their_elements()
    type(planish_surface_t) :: first(3), second(3)
    integer :: i
    first = saddle(1.0_real64)
    do i = 2, 3
      first(i) = saddle(real(i, real64))
    end do
    second = first
    first(1) = first(3)
    call check(height(second(1)) == 1 .and. height(first(1)) == 3, "elements are copies")
    second(1:2) = first(2:3)
    call check(height(second(1)) == 2 .and. height(second(2)) == 3, "sections are copies")
    second = [first(1), first(2), first(3)]
    call check(height(second(2)) == 2, "an array constructor of variables")
  end subroutine

  subroutine allocatables_free_what_they_hold()
    type(planish_surface_t), allocatable :: surface, other, several(:), grown(:)
    class(planish_surface_t), allocatable :: of_class
    allocate (surface)
    surface = saddle(1.0_real64)
    call move_alloc(surface, other)
    call check(.not. allocated(surface) .and. height(other) == 1, "move_alloc moves")
    allocate (surface)
    surface = other
    deallocate (other)
    call check(height(surface) == 1, "deallocation frees one")
    allocate (several(2), grown(3))
    several = saddles()
    grown(:2) = several
    grown(3) = saddle(3.0_real64)
    call move_alloc(grown, several)
    call check(size(several) == 3 .and. height(several(3)) == 3, "an array that grew")
    allocate (planish_surface_t :: of_class)
    call planish_tensor_fit_points(reshape([0, 0, 0, 1, 1, 0, 1, 1] * 1.0_real64, [2, 4]), &
        [0, 0, 0, 1] * 1.0_real64, of_class)
    call check(of_class%dim() == 1, "a polymorphic variable")
  end subroutine

  subroutine arguments_pass_through()
    type(planish_surface_t) :: surface
    surface = saddle(1.0_real64)
    call replace_inout(surface)
    call check(height(surface) == 2, "intent(inout)")
    call replace_out(surface)
    call check(height(surface) == 3, "intent(out)")
  end subroutine

  subroutine replace_inout(surface)
    type(planish_surface_t), intent(inout) :: surface
    surface = saddle(height(surface) + 1)
  end subroutine

  subroutine replace_out(surface)
    type(planish_surface_t), intent(out) :: surface
    surface = saddle(3.0_real64)
  end subroutine

  subroutine constructors_free_what_was_there()
    type(planish_surface_t) :: surface
    integer(int8), allocatable :: bytes(:)
    surface = saddle(1.0_real64)
    call surface%save(bytes)
    call surface%save(bytes)
    call surface%load(bytes)
    call surface%load(bytes)
    call check(height(surface) == 1, "load replaces")
  end subroutine

  subroutine failures_leave_what_was_there()
    type(planish_surface_t) :: surface
    integer(int8) :: rubbish(40)
    integer :: stat
    surface = saddle(1.0_real64)
    rubbish = 0
    call surface%load(rubbish, stat=stat)
    call check(stat == PLANISH_STATUS_FORMAT, "rubbish is refused")
    call check(height(surface) == 1, "a failure leaves the surface")
  end subroutine

  subroutine c_takes_part()
    type(planish_surface_t) :: surface, heir
    type(c_ptr) :: handle
    interface
      integer(c_int) function clone_in_c(surface, copy) bind(c, name="planish_surface_clone")
        import
        implicit none
        type(c_ptr), value :: surface
        type(c_ptr), intent(inout) :: copy
      end function
    end interface
    surface = saddle(1.0_real64)
    call check(clone_in_c(surface%get(), handle) == PLANISH_STATUS_OK, "C reads a handle")
    call heir%take(handle)
    call check(height(heir) == 1, "a handle of C is taken over")
  end subroutine

  subroutine curves_are_alike()
    type(planish_curve_t) :: first, second, several(2)
    first = line()
    second = first
    first = second
    several = first
    several(1) = line()
    call second%free()
    call check(first%dim() == 1 .and. several(2)%dim() == 1 .and. second%dim() == 0, "curves are copied and freed")
  end subroutine

  function line() result(curve)
    type(planish_curve_t) :: curve
    real(real64) :: u(4)
    u = [0, 1, 2, 3]
    call curve%fit(u, u)
  end function

  subroutine meshes_are_alike()
    type(planish_mesh_t) :: first, second, several(2)
    type(planish_mesh_t), allocatable :: parts(:)
    first = triangle()
    second = first
    first = second
    several = first
    several(1) = triangle()
    call second%free()
    call first%split_components(parts)
    call first%split_components(parts)
    call check(size(parts) == 1 .and. several(2)%point_count() == 3, "meshes are copied and freed")
  end subroutine

  function triangle() result(mesh)
    type(planish_mesh_t) :: mesh
    call mesh%new(reshape([0, 0, 0, 1, 0, 0, 0, 1, 0] * 1.0_real64, [3, 3]), reshape([1, 2, 3], [3, 1]))
  end function
end program
