!> Counts what does not hold, and ends the program with how many. Shapes that several tests need.
module checks
  use, intrinsic :: iso_fortran_env, only: real64, int32
  use planish
  implicit none
  private
  public :: check, check_fails, finish, make_sheet, sheet_height
  integer :: failures = 0, checked = 0

contains

  subroutine check(holds, text)
    logical, intent(in) :: holds
    character(*), intent(in) :: text
    checked = checked + 1
    if (holds) return
    failures = failures + 1
    print "(2a)", "not true: ", text
  end subroutine

  !> A call ended with this status, and its sentence has these words.
  subroutine check_fails(stat, errmsg, expected, words)
    integer, intent(in) :: stat, expected
    character(*), intent(in) :: errmsg, words
    call check(stat == expected, planish_status_name(expected) // ", not " // planish_status_name(stat))
    call check(index(errmsg, words) > 0, "'" // trim(errmsg) // "' has the words: " // words)
  end subroutine

  subroutine finish()
    print "(i0, a, i0, a)", checked, " checks, ", failures, " failed"
    if (failures > 0) error stop 1
  end subroutine

  !> The surface z = x y over the unit square, side by side nodes: a bicubic fit has it exactly.
  subroutine make_sheet(side, points, triangles)
    integer, intent(in) :: side
    real(real64), allocatable, intent(out) :: points(:, :)
    integer(int32), allocatable, intent(out) :: triangles(:, :)
    integer :: i, j, a, t
    allocate (points(3, side**2), triangles(3, 2 * (side - 1)**2))
    t = 0
    do i = 1, side
      do j = 1, side
        a = (i - 1) * side + j
        points(1:2, a) = real([i - 1, j - 1], real64) / (side - 1)
        points(3, a) = sheet_height(points(1, a), points(2, a))
        if (i == side .or. j == side) cycle
        triangles(:, t + 1) = [a, a + side, a + side + 1]
        triangles(:, t + 2) = [a, a + side + 1, a + 1]
        t = t + 2
      end do
    end do
  end subroutine

  elemental real(real64) function sheet_height(x, y)
    real(real64), intent(in) :: x, y
    sheet_height = x * y
  end function
end module
