! A host in Fortran: two blocks that do not match, linear elastic with Poisson's ratio 0, in 2D, pressed, then drawn aside with friction. All of it
! but contact is here. Runs on one process.
module blocks
  use mortise
  implicit none
  real(c_double), parameter :: youngs_modulus = 1000.0_c_double, down = 0.02_c_double, &
    right = 0.12_c_double, tolerance = 1e-10_c_double
  integer, parameter :: cells(2) = [4, 3], first(2) = [0, 25], nodes = 41, rows = 82
  integer(c_int64_t), parameter :: n = rows
  real(c_double) :: x(2, 0:nodes - 1), K(0:rows - 1, 0:rows - 1) = 0, A(0:rows - 1, 0:rows - 1)
  integer :: pivots(0:rows - 1)
  type(c_ptr) :: contact = c_null_ptr

contains

  subroutine check(status)
    integer(c_int), intent(in) :: status
    if (status == mortise_ok) return
    print '(a)', mortise_last_error(contact)
    stop 1
  end subroutine

  logical function held(row)
    integer, intent(in) :: row
    held = x(2, row/2) <= 0 .or. x(2, row/2) >= 2
  end function

  real(c_double) function target_of(row, time)
    integer, intent(in) :: row
    real(c_double), intent(in) :: time
    target_of = 0
    if (x(2, row/2) >= 2) target_of = merge(right*max(0.0_c_double, time - 1), -down*min(1.0_c_double, time), mod(row, 2) == 0)
  end function

  ! Integral of N_a,i N_b,j over a square; directions from 0.
  real(c_double) function product_of(a, b, i, j)
    integer, intent(in) :: a, b, i, j
    integer :: l, of_a, of_b
    product_of = 1
    do l = 0, 1
      of_a = 2*ibits(a, l, 1) - 1
      of_b = 2*ibits(b, l, 1) - 1
      if (l == i .and. l == j) then
        product_of = product_of*of_a*of_b
      else if (l == i) then
        product_of = product_of*of_a/2
      else if (l == j) then
        product_of = product_of*of_b/2
      else
        product_of = product_of/merge(3, 6, of_a == of_b)
      end if
    end do
  end function

  subroutine assemble
    integer :: block, column, row, a, b, i, j, corners(0:3)
    real(c_double) :: sum_of
    do block = 1, 2
      do row = 0, cells(block)
        do column = 0, cells(block)
          x(:, first(block) + column + (cells(block) + 1)*row) = [real(column, c_double), real(row, c_double)]/cells(block) &
                                                                  + [0, block - 1]
        end do
      end do
      do row = 0, cells(block) - 1
        do column = 0, cells(block) - 1
          corners(0) = first(block) + column + (cells(block) + 1)*row
          corners(1:3) = corners(0) + [1, cells(block) + 1, cells(block) + 2]
          do a = 0, 3
            do b = 0, 3
              sum_of = product_of(a, b, 0, 0) + product_of(a, b, 1, 1)
              do i = 0, 1
                do j = 0, 1
                  associate (entry => K(2*corners(a) + i, 2*corners(b) + j))
                    entry = entry + 0.5_c_double*youngs_modulus*(merge(sum_of, 0.0_c_double, i == j) + product_of(a, b, j, i))
                  end associate
                end do
              end do
            end do
          end do
        end do
      end do
    end do
  end subroutine

  subroutine factorise
    integer :: l, row
    real(c_double) :: swapped(0:rows - 1)
    do l = 0, rows - 1
      pivots(l) = l - 1 + maxloc(abs(A(l:, l)), 1)
      swapped = A(l, :)
      A(l, :) = A(pivots(l), :)
      A(pivots(l), :) = swapped
      do row = l + 1, rows - 1
        A(row, l) = A(row, l)/A(l, l)
        A(row, l + 1:) = A(row, l + 1:) - A(row, l)*A(l, l + 1:)
      end do
    end do
  end subroutine

  function solve(user, size, b, y) result(failed) bind(c)
    type(c_ptr), value :: user
    integer(c_int64_t), value :: size
    real(c_double), intent(in) :: b(size)
    real(c_double), intent(inout) :: y(size)
    integer(c_int) :: failed
    real(c_double) :: all(0:rows - 1), swapped
    integer :: l
    failed = merge(1, 0, c_associated(user) .or. size /= rows)
    if (failed /= 0) return
    all = b
    do l = 0, rows - 1
      swapped = all(l)
      all(l) = all(pivots(l))
      all(pivots(l)) = swapped
    end do
    do l = 1, rows - 1
      all(l) = all(l) - dot_product(A(l, :l - 1), all(:l - 1))
    end do
    do l = rows - 1, 0, -1
      all(l) = (all(l) - dot_product(A(l, l + 1:), all(l + 1:)))/A(l, l)
    end do
    y = all
  end function

end module

program fortran_host
  use blocks
  implicit none
  integer(c_int64_t) :: multipliers, ids(rows), node_ids(nodes), starts(0:rows) = 0
  integer(c_int64_t), allocatable :: columns(:), z_ids(:)
  integer(c_int64_t), pointer :: of_starts(:), of_columns(:)
  real(c_double), allocatable :: values(:), z(:), dz(:)
  real(c_double), pointer :: of_values(:)
  real(c_double) :: d(0:rows - 1) = 0, dd(0:rows - 1), f(0:rows - 1), internal(0:rows - 1), rhs(0:rows - 1), time, off
  integer(c_int32_t) :: marks(rows), pair
  integer :: row, column, step, iteration
  logical :: is_held(0:rows - 1)
  character(kind=c_char) :: message(1000)
  type(mortise_norms) :: norms
  type(mortise_matrix) :: matrix

  call assemble
  do row = 0, rows - 1
    ids(row + 1) = row
    is_held(row) = held(row)
    starts(row + 1) = starts(row) + count(abs(K(row, :)) > 0)
  end do
  node_ids = ids(:nodes)
  marks = merge(1, 0, is_held)
  columns = [((column, column=0, rows - 1), row=0, rows - 1)]
  columns = pack(columns, reshape(transpose(abs(K) > 0), [rows*rows]))
  values = pack(transpose(K), transpose(abs(K) > 0))

  if (mortise_create(mortise_this_process, 2_c_int, int(nodes, c_int64_t), node_ids, x, ids, marks, n, ids, contact=contact, &
                     message=message, message_size=int(size(message), c_int64_t)) /= mortise_ok) then
    print '(*(a))', message
    stop 1
  end if
  call check(mortise_add_pair(contact, 'joint'//c_null_char, youngs_modulus, &
                              'friction/type = coulomb; friction/coefficient = 0.3'//c_null_char, pair))
  call check(mortise_add_facets(contact, pair, mortise_slave, 3_c_int64_t, 2_c_int, [25_c_int64_t, 26_c_int64_t, 26_c_int64_t, &
                                27_c_int64_t, 27_c_int64_t, 28_c_int64_t]))
  call check(mortise_add_facets(contact, pair, mortise_master, 4_c_int64_t, 2_c_int, [21_c_int64_t, 20_c_int64_t, 22_c_int64_t, &
                                21_c_int64_t, 23_c_int64_t, 22_c_int64_t, 24_c_int64_t, 23_c_int64_t]))
  call check(mortise_ready(contact, multipliers))
  allocate (z(multipliers), dz(multipliers), z_ids(multipliers))
  z = 0

  do step = 1, 8
    time = 0.25_c_double*step
    call check(mortise_start_step(contact, n, multipliers, d, z=z))
    do iteration = 0, 29
      call check(mortise_differentiate(contact, n, multipliers, d, z=z, f=f, norms=norms))
      internal = matmul(K, d)
      off = 0
      do row = 0, rows - 1
        if (is_held(row)) off = off + abs(target_of(row, time) - d(row))
      end do
      if (iteration > 0 .and. norm2(pack(internal + f, .not. is_held)) <= tolerance*norm2(internal) .and. off <= tolerance .and. &
          norms%gap <= tolerance .and. norms%complementarity <= tolerance .and. norms%changed == 0) exit
      rhs = -internal
      call check(mortise_condense(contact, n, starts, columns, values, rhs, matrix))
      call mortise_rows(matrix, of_starts, of_columns, of_values)
      A = 0
      do row = 0, rows - 1
        if (is_held(row)) then
          A(row, row) = youngs_modulus
          rhs(row) = youngs_modulus*(target_of(row, time) - d(row))
        else
          do column = int(of_starts(row + 1)) + 1, int(of_starts(row + 2))
            A(row, of_columns(column)) = of_values(column)
          end do
        end if
      end do
      call factorise
      call check(mortise_solve(contact, n, multipliers, rhs, c_funloc(solve), c_null_ptr, dd, dz))
      d = d + dd
      z = z + dz
    end do
    if (iteration == 30) stop 2
    call check(mortise_accept(contact))
  end do
  call check(mortise_multipliers(contact, multipliers, ids=z_ids))
  do row = 0, rows - 1
    print '(a, i0, 1x, es24.16e3)', 'd ', row, d(row)
  end do
  do row = 1, int(multipliers)
    print '(a, i0, 1x, es24.16e3)', 'z ', z_ids(row) - n, z(row)
  end do
  call mortise_destroy(contact)
end program
