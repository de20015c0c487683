! Contact for programs in Fortran: the functions of mortise.h, which says what arrays hold. Compile it with your program and link libmortise.
! Texts end with c_null_char. Arrays that are optional here may be NULL there. Ids, columns and starts are from 0.
module mortise
  use, intrinsic :: iso_c_binding
  implicit none
  public

  ! Status of a call.
  integer(c_int), parameter :: mortise_ok = 0, mortise_null_pointer = 1, mortise_wrong_length = 2, mortise_not_finite = 3, &
    mortise_wrong_order = 4, mortise_refused = 5, mortise_step_failed = 6, mortise_solve_failed = 7, mortise_bad_bytes = 8, &
    mortise_no_memory = 9, mortise_internal = 10
  ! In the place of a communicator.
  integer(c_int), parameter :: mortise_this_process = -1
  ! Sides of a pair.
  integer(c_int), parameter :: mortise_slave = 0, mortise_master = 1
  ! Blocks of derivatives.
  integer(c_int), parameter :: mortise_f_d = 0, mortise_f_z = 1, mortise_c_d = 2, mortise_c_z = 3

  type, bind(c) :: mortise_matrix
    integer(c_int64_t) :: rows = 0
    type(c_ptr) :: starts = c_null_ptr, columns = c_null_ptr, values = c_null_ptr
  end type

  type, bind(c) :: mortise_norms
    real(c_double) :: gap, complementarity, force
    integer(c_int32_t) :: active, sticking, changed
  end type

  type, bind(c) :: mortise_augmentation
    real(c_double) :: error, tolerance
    integer(c_int32_t) :: more, exhausted
  end type

  type, bind(c) :: mortise_node
    integer(c_int64_t) :: node
    integer(c_int32_t) :: state, carries
    real(c_double) :: pressure, gap, shear, shear_bound, slip, slip_path, weight, traction(3), normal(3)
  end type

  abstract interface
    ! dd = A^-1 right; not 0: it has failed.
    function mortise_linear_solver(user, rows, right, dd) result(failed) bind(c)
      import :: c_int, c_ptr, c_int64_t, c_double
      type(c_ptr), value :: user
      integer(c_int64_t), value :: rows
      real(c_double), intent(in) :: right(rows)
      real(c_double), intent(inout) :: dd(rows)
      integer(c_int) :: failed
    end function
  end interface

  interface
    function mortise_create(comm, dimension, nodes, node_ids, positions, node_rows, marks, rows, row_ids, options, contact, &
                            message, message_size) result(status) bind(c)
      import :: c_int, c_int32_t, c_int64_t, c_double, c_char, c_ptr
      integer(c_int), value :: comm, dimension
      integer(c_int64_t), value :: nodes, rows, message_size
      integer(c_int64_t), intent(in) :: node_ids(*), node_rows(*), row_ids(*)
      real(c_double), intent(in) :: positions(*)
      integer(c_int32_t), intent(in), optional :: marks(*)
      character(kind=c_char), intent(in), optional :: options(*)
      type(c_ptr), intent(out) :: contact
      character(kind=c_char), intent(out), optional :: message(*)
      integer(c_int) :: status
    end function

    function mortise_add_pair(contact, name, youngs_modulus, options, pair) result(status) bind(c)
      import :: c_int, c_int32_t, c_double, c_char, c_ptr
      type(c_ptr), value :: contact
      character(kind=c_char), intent(in) :: name(*)
      real(c_double), value :: youngs_modulus
      character(kind=c_char), intent(in), optional :: options(*)
      integer(c_int32_t), intent(out) :: pair
      integer(c_int) :: status
    end function

    function mortise_add_second_pass(contact, of, pair) result(status) bind(c)
      import :: c_int, c_int32_t, c_ptr
      type(c_ptr), value :: contact
      integer(c_int32_t), value :: of
      integer(c_int32_t), intent(out) :: pair
      integer(c_int) :: status
    end function

    function mortise_add_facets(contact, pair, side, facets, nodes_per_facet, nodes) result(status) bind(c)
      import :: c_int, c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: contact
      integer(c_int32_t), value :: pair
      integer(c_int), value :: side, nodes_per_facet
      integer(c_int64_t), value :: facets
      integer(c_int64_t), intent(in) :: nodes(*)
      integer(c_int) :: status
    end function

    function mortise_ready(contact, multipliers) result(status) bind(c)
      import :: c_int, c_int64_t, c_ptr
      type(c_ptr), value :: contact
      integer(c_int64_t), intent(out) :: multipliers
      integer(c_int) :: status
    end function

    function mortise_multipliers(contact, multipliers, ids, nodes, weights) result(status) bind(c)
      import :: c_int, c_int64_t, c_double, c_ptr
      type(c_ptr), value :: contact
      integer(c_int64_t), value :: multipliers
      integer(c_int64_t), intent(out), optional :: ids(*), nodes(*)
      real(c_double), intent(out), optional :: weights(*)
      integer(c_int) :: status
    end function

    function mortise_start_step(contact, rows, multipliers, d, prescribed, z) result(status) bind(c)
      import :: c_int, c_int64_t, c_double, c_ptr
      type(c_ptr), value :: contact
      integer(c_int64_t), value :: rows, multipliers
      real(c_double), intent(in) :: d(*)
      real(c_double), intent(in), optional :: prescribed(*)
      real(c_double), intent(inout) :: z(*)
      integer(c_int) :: status
    end function

    function mortise_evaluate(contact, rows, multipliers, d, prescribed, z, f, C, norms) result(status) bind(c)
      import :: c_int, c_int64_t, c_double, c_ptr, mortise_norms
      type(c_ptr), value :: contact
      integer(c_int64_t), value :: rows, multipliers
      real(c_double), intent(in) :: d(*), z(*)
      real(c_double), intent(in), optional :: prescribed(*)
      real(c_double), intent(out), optional :: f(*), C(*)
      type(mortise_norms), intent(out), optional :: norms
      integer(c_int) :: status
    end function

    function mortise_differentiate(contact, rows, multipliers, d, prescribed, z, f, C, norms) result(status) bind(c)
      import :: c_int, c_int64_t, c_double, c_ptr, mortise_norms
      type(c_ptr), value :: contact
      integer(c_int64_t), value :: rows, multipliers
      real(c_double), intent(in) :: d(*), z(*)
      real(c_double), intent(in), optional :: prescribed(*)
      real(c_double), intent(out), optional :: f(*), C(*)
      type(mortise_norms), intent(out), optional :: norms
      integer(c_int) :: status
    end function

    function mortise_jacobian(contact, block, matrix) result(status) bind(c)
      import :: c_int, c_ptr, mortise_matrix
      type(c_ptr), value :: contact
      integer(c_int), value :: block
      type(mortise_matrix), intent(out) :: matrix
      integer(c_int) :: status
    end function

    function mortise_condense(contact, rows, starts, columns, values, rhs, matrix) result(status) bind(c)
      import :: c_int, c_int64_t, c_double, c_ptr, mortise_matrix
      type(c_ptr), value :: contact
      integer(c_int64_t), value :: rows
      integer(c_int64_t), intent(in) :: starts(*), columns(*)
      real(c_double), intent(in) :: values(*)
      real(c_double), intent(inout) :: rhs(*)
      type(mortise_matrix), intent(out) :: matrix
      integer(c_int) :: status
    end function

    ! solver: c_funloc of a mortise_linear_solver.
    function mortise_solve(contact, rows, multipliers, right, solver, user, dd, dz) result(status) bind(c)
      import :: c_int, c_int64_t, c_double, c_ptr, c_funptr
      type(c_ptr), value :: contact, user
      integer(c_int64_t), value :: rows, multipliers
      real(c_double), intent(in) :: right(*)
      type(c_funptr), value :: solver
      real(c_double), intent(out) :: dd(*), dz(*)
      integer(c_int) :: status
    end function

    function mortise_recover(contact, rows, multipliers, dd, z) result(status) bind(c)
      import :: c_int, c_int64_t, c_double, c_ptr
      type(c_ptr), value :: contact
      integer(c_int64_t), value :: rows, multipliers
      real(c_double), intent(in) :: dd(*)
      real(c_double), intent(out) :: z(*)
      integer(c_int) :: status
    end function

    function mortise_augment(contact, augmentation) result(status) bind(c)
      import :: c_int, c_ptr, mortise_augmentation
      type(c_ptr), value :: contact
      type(mortise_augmentation), intent(out) :: augmentation
      integer(c_int) :: status
    end function

    function mortise_accept(contact) result(status) bind(c)
      import :: c_int, c_ptr
      type(c_ptr), value :: contact
      integer(c_int) :: status
    end function

    function mortise_count_nodes(contact, pair, nodes) result(status) bind(c)
      import :: c_int, c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value :: contact
      integer(c_int32_t), value :: pair
      integer(c_int64_t), intent(out) :: nodes
      integer(c_int) :: status
    end function

    function mortise_report(contact, pair, nodes, report) result(status) bind(c)
      import :: c_int, c_int32_t, c_int64_t, c_ptr, mortise_node
      type(c_ptr), value :: contact
      integer(c_int32_t), value :: pair
      integer(c_int64_t), value :: nodes
      type(mortise_node), intent(out) :: report(*)
      integer(c_int) :: status
    end function

    function mortise_store(contact, capacity, bytes, size) result(status) bind(c)
      import :: c_int, c_int8_t, c_int64_t, c_ptr
      type(c_ptr), value :: contact
      integer(c_int64_t), value :: capacity
      integer(c_int8_t), intent(out), optional :: bytes(*)
      integer(c_int64_t), intent(out) :: size
      integer(c_int) :: status
    end function

    function mortise_restore(contact, size, bytes, rows, multipliers, d, prescribed, z) result(status) bind(c)
      import :: c_int, c_int8_t, c_int64_t, c_double, c_ptr
      type(c_ptr), value :: contact
      integer(c_int64_t), value :: size, rows, multipliers
      integer(c_int8_t), intent(in) :: bytes(*)
      real(c_double), intent(in) :: d(*), z(*)
      real(c_double), intent(in), optional :: prescribed(*)
      integer(c_int) :: status
    end function

    subroutine mortise_destroy(contact) bind(c)
      import :: c_ptr
      type(c_ptr), intent(inout) :: contact
    end subroutine
  end interface

  interface
    function mortise_last_error_(contact) result(text) bind(c, name='mortise_last_error')
      import :: c_ptr
      type(c_ptr), value :: contact
      type(c_ptr) :: text
    end function

    function c_strlen_(text) result(length) bind(c, name='strlen')
      import :: c_ptr, c_size_t
      type(c_ptr), value :: text
      integer(c_size_t) :: length
    end function
  end interface
  private :: mortise_last_error_, c_strlen_

contains

  ! Why the last call failed; empty if it did not.
  function mortise_last_error(contact) result(text)
    type(c_ptr), intent(in) :: contact
    character(len=:), allocatable :: text
    type(c_ptr) :: given
    character(kind=c_char), pointer :: characters(:)
    integer :: i
    given = mortise_last_error_(contact)
    call c_f_pointer(given, characters, [c_strlen_(given)])
    allocate (character(len=size(characters)) :: text)
    do i = 1, size(characters)
      text(i:i) = characters(i)
    end do
  end function

  ! The arrays of a matrix, whose bounds begin with 1 as usual; what `starts` and `columns` hold begins with 0.
  subroutine mortise_rows(matrix, starts, columns, values)
    type(mortise_matrix), intent(in) :: matrix
    integer(c_int64_t), pointer, intent(out) :: starts(:), columns(:)
    real(c_double), pointer, intent(out) :: values(:)
    call c_f_pointer(matrix%starts, starts, [matrix%rows + 1])
    call c_f_pointer(matrix%columns, columns, [starts(matrix%rows + 1)])
    call c_f_pointer(matrix%values, values, [starts(matrix%rows + 1)])
  end subroutine

end module
