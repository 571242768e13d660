! Rank 0 fits a field and broadcasts its bytes; every rank evaluates its own nodes, and rank 0 gathers them.
program broadcast
  use, intrinsic :: iso_fortran_env, only: real64, int8
  use mpi_f08
  use planish
  implicit none
  integer, parameter :: side = 61, node_count = side**2
  type(planish_surface_t) :: field
  type(planish_eval_options) :: options
  real(real64) :: uv(2, node_count), values(node_count), gathered(node_count), serial(node_count)
  real(real64), allocatable :: own(:)
  integer(int8), allocatable :: bytes(:)
  integer, allocatable :: firsts(:), counts(:)
  integer :: rank, ranks, byte_count, i
  logical :: equal

  call MPI_Init()
  call MPI_Comm_rank(MPI_COMM_WORLD, rank)
  call MPI_Comm_size(MPI_COMM_WORLD, ranks)
  call make_nodes()

  byte_count = 0
  if (rank == 0) then
    call planish_tensor_fit_points(uv, values, field)
    call field%save(bytes)
    byte_count = size(bytes)
  end if
  call MPI_Bcast(byte_count, 1, MPI_INTEGER, 0, MPI_COMM_WORLD)
  if (rank /= 0) allocate (bytes(byte_count))
  call MPI_Bcast(bytes, byte_count, MPI_BYTE, 0, MPI_COMM_WORLD)
  if (rank /= 0) call field%load(bytes)

  options%thread_count = 1 ! the ranks share the cores
  firsts = [(first_of(i), i=0, ranks)]
  counts = firsts(2:) - firsts(:ranks)
  allocate (own(counts(rank + 1)))
  call field%eval(uv(:, firsts(rank + 1):firsts(rank + 2) - 1), own, options)
  call MPI_Gatherv(own, size(own), MPI_DOUBLE_PRECISION, gathered, counts, firsts(:ranks) - 1, MPI_DOUBLE_PRECISION, 0, &
      MPI_COMM_WORLD)

  equal = .true.
  if (rank == 0) then
    call field%eval(uv, serial)
    equal = all(transfer(gathered, bytes) == transfer(serial, bytes))
    print "(i0, a, i0, a, i0, 3a)", ranks, " ranks, ", node_count, " nodes, ", byte_count, " bytes broadcast, ", &
        trim(merge("equal to    ", "not equal to", equal)), " the serial run"
  end if
  call MPI_Bcast(equal, 1, MPI_LOGICAL, 0, MPI_COMM_WORLD)
  call MPI_Finalize()
  if (.not. equal) error stop 1

contains

  !> The first of the nodes that a rank has; no rank has more than one more than another.
  integer function first_of(rank)
    integer, intent(in) :: rank
    first_of = 1 + rank * (node_count / ranks) + min(rank, mod(node_count, ranks))
  end function

  !> The nodes that all ranks know: their (u,v) and the field.
  subroutine make_nodes()
    integer :: i
    do i = 0, node_count - 1
      uv(:, i + 1) = [i / side, mod(i, side)] / real(side - 1, real64)
    end do
    values = sin(6 * uv(1, :)) * cos(5 * uv(2, :))
  end subroutine
end program
! Output: 3 ranks, 3721 nodes, 1336 bytes broadcast, equal to the serial run
