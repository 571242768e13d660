! Models from Fortran: faces, edges, vertices and shells count from 1.
program test_models
  use, intrinsic :: iso_fortran_env, only: real64, int8, int64
  use planish
  use checks
  implicit none
  real(real64), parameter :: knots(4) = [0, 0, 1, 1]

  call parts_count_from_1()
  call models_are_saved_and_written()
  call refusals_are_told()
  call finish()

contains

  !> z = x y over the unit square.
  function saddle() result(surface)
    type(planish_surface_t) :: surface
    real(real64) :: points(3, 2, 2)
    points = reshape([0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 1], [3, 2, 2])
    call planish_tensor_new(1, 1, knots, knots, points, surface)
  end function

  function model() result(made)
    type(planish_model_t) :: made
    call made%from_surface(saddle())
  end function

  subroutine parts_count_from_1()
    type(planish_model_t) :: made
    type(planish_surface_t) :: face
    type(planish_curve_t) :: curve, pcurve
    type(planish_edge_info) :: info
    type(planish_face_info) :: of_face
    type(planish_shell_info) :: shell
    type(planish_measure_report) :: report
    integer, allocatable :: sizes(:), edges(:), faces(:)
    logical, allocatable :: is_forward(:)
    real(real64) :: vertices(3, 4)
    integer :: k
    made = model()
    call check(made%face_count() == 1 .and. made%edge_count() == 4, "one face has four edges")
    call check(made%vertex_count() == 4 .and. made%shell_count() == 1, "and four vertices in one shell")
    call made%copy_loops(1, sizes, edges, is_forward)
    call check(size(sizes) == 1 .and. all(is_forward), "one loop along its edges")
    call check(all(sizes == 4) .and. minval(edges) == 1 .and. maxval(edges) == 4, "edges count from 1")
    call made%copy_vertices(vertices)
    do k = 1, 4
      call made%copy_edge(edges(k), curve, info)
      call check(info%face_along == 1 .and. info%face_against == 0, "faces count from 1, 0 is none")
      call check(info%vertex_start >= 1 .and. info%vertex_start <= 4, "vertices count from 1")
      call made%copy_pcurve(1, k, pcurve)
      call check(pcurve%dim() == 2 .and. curve%dim() == 3, "a p-curve lies in the plane")
    end do
    call made%face_info(1, of_face)
    call check(of_face%shell == 1, "shells count from 1")
    call made%copy_shell(1, shell, faces)
    call check(shell%void_in == 0 .and. all(faces == [1]), "the shell has the face")
    call made%measure(report)
    call check(report%free_edge_count == 4, "all edges are free")
    call made%copy_face(1, face)
    call check(face%trim_count() == 1, "a face brings its loop")
  end subroutine

  subroutine models_are_saved_and_written()
    type(planish_model_t) :: made, loaded
    integer(int8), allocatable :: bytes(:), again(:), text(:)
    made = model()
    call made%save(bytes)
    call loaded%load(bytes)
    call loaded%save(again)
    call check(all(bytes == again), "what is saved comes back")
    call made%save_file("test_models.planish")
    call loaded%load_file("test_models.planish")
    call made%write_step("test_models.step", product="saddle")
    call made%write_step_memory(text)
    call check(size(text) > 1000, "a file in memory")
  end subroutine

  subroutine refusals_are_told()
    type(planish_model_t) :: made
    type(planish_surface_t) :: face
    integer :: stat
    made = model()
    call made%copy_face(2, face, stat=stat)
    call check(stat == PLANISH_STATUS_INDEX, "there is no face 2")
    call made%copy_face(0, face, stat=stat)
    call check(stat == PLANISH_STATUS_INDEX, "faces count from 1")
    call check(made%loop_count(0) == 0 .and. made%coedge_count(2) == 0, "and have no loops")
  end subroutine
end program
