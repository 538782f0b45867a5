! Moments of inertia of standard shapes: ./inertia [mass_kg [size_m]], all sizes the same.
module rotdyn
  use, intrinsic :: iso_c_binding
  implicit none
  integer(c_int), parameter :: rotdyn_ok = 0
  type, bind(c) :: rotdyn_moments
    integer(c_size_t) :: size
    real(c_double) :: mass_kg, moment_kg_m2, ixx_kg_m2, iyy_kg_m2, izz_kg_m2, ixy_kg_m2
    real(c_double) :: beta, gyration_m, centre_m(3), error
  end type
  interface
    integer(c_int) function rotdyn_shape_moments(shape, mass_kg, n_sizes, sizes, out) bind(c)
      import :: c_int, c_char, c_double, c_size_t, rotdyn_moments
      character(kind=c_char), intent(in) :: shape(*)
      real(c_double), value :: mass_kg
      integer(c_size_t), value :: n_sizes
      real(c_double), intent(in) :: sizes(*)
      type(rotdyn_moments), intent(inout) :: out
    end function
  end interface
end module

program inertia
  use rotdyn
  implicit none
  character(len=20), parameter :: shapes(7) = [character(len=20) :: 'rod', 'rod_end', 'hoop', &
    'disk', 'sphere', 'spherical_shell', 'cylinder']
  integer, parameter :: sizes(7) = [1, 1, 1, 1, 1, 1, 2]
  type(rotdyn_moments) :: m
  real(c_double) :: mass, length, same(4)
  integer :: i
  mass = argument(1, 1.5d0)
  length = argument(2, 0.3d0)
  same = length
  print '(a)', 'shape,moment_of_inertia_kg_m2,ixx_kg_m2,iyy_kg_m2,izz_kg_m2'
  do i = 1, 7
    m%size = c_sizeof(m)
    if (rotdyn_shape_moments(trim(shapes(i)) // c_null_char, mass, int(sizes(i), c_size_t), same, &
        m) /= rotdyn_ok) error stop 'mass and size must not be negative'
    print '(a, 4(",", es24.16e3))', trim(shapes(i)), m%moment_kg_m2, m%ixx_kg_m2, m%iyy_kg_m2, &
      m%izz_kg_m2
  end do
contains
  real(c_double) function argument(i, default)
    integer, intent(in) :: i
    real(c_double), intent(in) :: default
    character(len=40) :: text
    argument = default
    if (command_argument_count() < i) return
    call get_command_argument(i, text)
    read (text, *) argument
  end function
end program
