! SPDX-License-Identifier: MIT OR Apache-2.0
!> Smooth spline surfaces from triangle meshes, rows of points and fields: the Fortran 2018 side of planish.h.
!>
!>     use planish
!>     type(planish_mesh_t) :: mesh
!>     type(planish_surface_t) :: surface
!>     type(planish_tensor_options) :: options                ! born with the defaults
!>     type(planish_fit_report) :: report
!>     call mesh%read("panel.stl")
!>     options%tolerance = 1e-4_real64
!>     call planish_tensor_fit(mesh, surface, options, report)
!>     call surface%eval(uv, points)                          ! uv(2,n), points(3,n)
!>
!> Names. planish_mesh_x, planish_surface_x, planish_curve_x, planish_field_fitter_x and planish_transfer_x of C
!> are mesh%x, surface%x, curve%x, fitter%x and transfer%x; calls that make or use one family keep their names.
!> What planish.h says of a call holds; here stands what is different.
!>
!> Arrays are Fortran's way round: a row of C is a column, so points are (3,n) and parameters (2,n). Whole arrays go
!> in without copies; of a section such as points(1:2,:) the compiler makes one. Where C has a stride, it is the first
!> extent: uv(5,n) holds n points, u and v first. Sizes come from the arrays; strides and pointers of the options
!> from the arguments. Counts that come back are integer(c_size_t).
!>
!> Indices count from 1: nodes, triangles, loops, trims, patches, control curves and their knots, cells, vertices,
!> worst_index, farthest_index, twisted_row, corners, planish_error_index(). Only the sentences of
!> planish_error_message() and the addresses of cells count as C does, from 0: the halves of cell i of a level are
!> 2 i and 2 i + 1 of the next.
!>
!> Errors. Calls end with (..., stat, errmsg), both optional. stat receives a PLANISH_STATUS: negative is an error
!> and nothing has been changed, positive a success with a remark. errmsg receives the sentence of an error, else it
!> stays as it is. Without stat an error stops the program with the sentence.
!>
!> Handles free themselves, and `=` makes a deep copy; fitters and transfers have no copies, and `=` between them
!> stops the program. gfortran 12 has bugs about that which no module can mend: a type of yours that has a handle
!> as a component must not be assigned with `=`, nor handles allocated with `source=` or gathered as [a, b], nor
!> overlapping sections of an array of handles assigned to each other. Function results are safe, and so are arrays
!> assigned one by one.
module planish_types
  use, intrinsic :: iso_c_binding
  use planish_records
  use planish_calls
  implicit none
  private

  abstract interface
    !> Hears how much of a call is done, 0 to 1, and the error so far, NaN while unknown; false cancels the call.
    logical function planish_progress(fraction, error)
      import :: c_double
      implicit none
      real(c_double), intent(in) :: fraction, error
    end function
  end interface

  !> A Fortran procedure on its way through C, where it travels as `user`.
  type :: listener
    procedure(planish_progress), pointer, nopass :: hear => null()
  end type

  ! ---------------------------------------------------------------------------------------------------------
  ! Handles
  ! ---------------------------------------------------------------------------------------------------------

  ! Who frees a handle. They are allocatable components, because gfortran 12 finalizes those of a function result
  ! but not the result itself, and polymorphic, because it copies elements of arrays rightly only then.
  type :: mesh_owner
    type(c_ptr) :: handle = c_null_ptr
  contains
    final :: finalize_mesh
  end type
  type :: surface_owner
    type(c_ptr) :: handle = c_null_ptr
  contains
    final :: finalize_surface
  end type
  type :: curve_owner
    type(c_ptr) :: handle = c_null_ptr
  contains
    final :: finalize_curve
  end type
  type :: model_owner
    type(c_ptr) :: handle = c_null_ptr
  contains
    final :: finalize_model
  end type
  type :: field_fitter_owner
    type(c_ptr) :: handle = c_null_ptr
  contains
    final :: finalize_field_fitter
  end type
  type :: transfer_owner
    type(c_ptr) :: handle = c_null_ptr
  contains
    final :: finalize_transfer
  end type

  type :: layout_owner
    type(c_ptr) :: handle = c_null_ptr
  contains
    final :: finalize_layout
  end type

  !> A triangle mesh. One that nothing was done to yet is no mesh: its counts are 0 and calls refuse it.
  type, public :: planish_mesh_t
    private
    class(mesh_owner), allocatable :: owner
  contains
    procedure :: new => mesh_new
    procedure :: read => mesh_read
    procedure :: read_buffer => mesh_read_buffer
    procedure :: write => mesh_write
    procedure, private :: assign => mesh_assign
    generic :: assignment(=) => assign
    procedure :: free => mesh_free
    procedure :: get => mesh_get
    procedure :: take => mesh_take
    procedure :: point_count => mesh_point_count
    procedure :: triangle_count => mesh_triangle_count
    procedure :: edge_count => mesh_edge_count
    procedure :: component_count => mesh_component_count
    procedure :: genus => mesh_genus
    procedure :: euler_characteristic => mesh_euler_characteristic
    procedure :: loop_count => mesh_loop_count
    procedure :: loop_point_count => mesh_loop_point_count
    procedure :: copy_points => mesh_copy_points
    procedure :: copy_triangles => mesh_copy_triangles
    procedure :: copy_node_map => mesh_copy_node_map
    procedure :: copy_triangle_map => mesh_copy_triangle_map
    procedure :: set_points => mesh_set_points
    procedure :: copy_loop => mesh_copy_loop
    procedure :: field_count => mesh_field_count
    procedure :: field_name => mesh_field_name
    procedure :: copy_field => mesh_copy_field
    procedure :: set_field => mesh_set_field
    procedure :: remove_field => mesh_remove_field
    procedure :: has_parameters => mesh_has_parameters
    procedure :: set_parameters => mesh_set_parameters
    procedure :: copy_parameters => mesh_copy_parameters
    procedure :: remove_triangles => mesh_remove_triangles
    procedure :: cut_along => mesh_cut_along
    procedure :: split_components => mesh_split_components
    procedure :: shortest_path => mesh_shortest_path
    procedure :: decimate => mesh_decimate
    procedure :: sample_rows => mesh_sample_rows
    procedure :: parameterize => mesh_parameterize
    procedure :: map_to_sphere => mesh_map_to_sphere
    procedure :: find_features => mesh_find_features
    procedure :: label_parts => mesh_label_parts
    procedure :: project => mesh_project
  end type

  !> A surface: a map from a rectangle of parameters (u,v) to dim() numbers.
  type, public :: planish_surface_t
    private
    class(surface_owner), allocatable :: owner
  contains
    procedure, private :: assign => surface_assign
    generic :: assignment(=) => assign
    procedure :: free => surface_free
    procedure :: get => surface_get
    procedure :: take => surface_take
    procedure :: kind => surface_kind
    procedure :: dim => surface_dim
    procedure :: coefficient_count => surface_coefficient_count
    procedure :: domain => surface_domain
    procedure :: data_box => surface_data_box
    procedure, private :: eval_rows => surface_eval_rows
    procedure, private :: eval_scalars => surface_eval_scalars
    generic :: eval => eval_rows, eval_scalars
    procedure :: eval_derivatives => surface_eval_derivatives
    procedure :: eval_grid => surface_eval_grid
    procedure :: normals => surface_normals
    procedure :: curvatures => surface_curvatures
    procedure :: field_gradient => surface_field_gradient
    procedure :: name => surface_name
    procedure :: set_name => surface_set_name
    procedure :: unit => surface_unit
    procedure :: set_unit => surface_set_unit
    procedure :: box => surface_box
    procedure :: area => surface_area
    procedure :: is_closed => surface_is_closed
    procedure :: trim_count => surface_trim_count
    procedure :: trim_point_count => surface_trim_point_count
    procedure :: copy_trim => surface_copy_trim
    procedure :: set_trims => surface_set_trims
    procedure :: trim_by_curves => surface_trim_by_curves
    procedure :: patch_count => surface_patch_count
    procedure :: patch_at => surface_patch_at
    procedure :: copy_patch => surface_copy_patch
    procedure :: to_tensor => surface_to_tensor
    procedure :: tessellate => surface_tessellate
    procedure :: project => surface_project
    procedure :: deviation => surface_deviation
    procedure :: fair => surface_fair
    procedure :: write_vtk => surface_write_vtk
    procedure :: write_step => surface_write_step
    procedure :: write_report => surface_write_report
    procedure :: save_size => surface_save_size
    procedure :: save => surface_save
    procedure :: load => surface_load
    procedure :: save_file => surface_save_file
    procedure :: load_file => surface_load_file
  end type

  !> A B-spline curve: a map from an interval of parameters u to dim() numbers.
  type, public :: planish_curve_t
    private
    class(curve_owner), allocatable :: owner
  contains
    procedure, private :: assign => curve_assign
    generic :: assignment(=) => assign
    procedure :: free => curve_free
    procedure :: get => curve_get
    procedure :: take => curve_take
    procedure :: new => curve_new
    procedure, private :: fit_rows => curve_fit_rows
    procedure, private :: fit_scalars => curve_fit_scalars
    generic :: fit => fit_rows, fit_scalars
    procedure :: dim => curve_dim
    procedure :: degree => curve_degree
    procedure :: knot_count => curve_knot_count
    procedure :: control_point_count => curve_control_point_count
    procedure :: copy_knots => curve_copy_knots
    procedure :: copy_control_points => curve_copy_control_points
    procedure :: domain => curve_domain
    procedure, private :: eval_rows => curve_eval_rows
    procedure, private :: eval_scalars => curve_eval_scalars
    generic :: eval => eval_rows, eval_scalars
    procedure :: eval_derivatives => curve_eval_derivatives
    procedure, private :: interpolate_rows => curve_interpolate_rows
    procedure, private :: interpolate_scalars => curve_interpolate_scalars
    generic :: interpolate => interpolate_rows, interpolate_scalars
    procedure :: length => curve_length
    procedure :: arc_lengths => curve_arc_lengths
    procedure :: project => curve_project
    procedure :: save_size => curve_save_size
    procedure :: save => curve_save
    procedure :: load => curve_load
    procedure :: save_file => curve_save_file
    procedure :: load_file => curve_load_file
  end type

  !> Faces, each a bounded part of a surface, that share edges and vertices. Faces, edges, vertices, loops, shells and
  !> the places of edges in a face count from 1; where none is meant, 0 stands.
  type, public :: planish_model_t
    private
    class(model_owner), allocatable :: owner
  contains
    procedure, private :: assign => model_assign
    generic :: assignment(=) => assign
    procedure :: free => model_free
    procedure :: get => model_get
    procedure :: take => model_take
    procedure :: from_surface => model_from_surface
    procedure :: dim => model_dim
    procedure :: face_count => model_face_count
    procedure :: edge_count => model_edge_count
    procedure :: vertex_count => model_vertex_count
    procedure :: shell_count => model_shell_count
    procedure :: loop_count => model_loop_count
    procedure :: coedge_count => model_coedge_count
    procedure :: face_info => model_face_info
    procedure :: copy_face => model_copy_face
    procedure :: copy_edge => model_copy_edge
    procedure :: copy_loops => model_copy_loops
    procedure :: copy_pcurve => model_copy_pcurve
    procedure :: copy_vertices => model_copy_vertices
    procedure :: node_count => model_node_count
    procedure :: locate_nodes => model_locate_nodes
    procedure :: copy_shell => model_copy_shell
    procedure :: eval => model_eval
    procedure :: field_gradient => model_field_gradient
    procedure :: normals => model_normals
    procedure :: curvatures => model_curvatures
    procedure :: project => model_project
    procedure :: deviation => model_deviation
    procedure :: tessellate => model_tessellate
    procedure :: write_vtk => model_write_vtk
    procedure :: write_report => model_write_report
    procedure :: measure => model_measure
    procedure :: write_step => model_write_step
    procedure :: write_step_memory => model_write_step_memory
    procedure :: save_size => model_save_size
    procedure :: save => model_save
    procedure :: load => model_load
    procedure :: save_file => model_save_file
    procedure :: load_file => model_load_file
  end type

  !> Fits fields on the nodes of one mesh, or at the same parameters, again and again. It has no copies, and one
  !> serves all threads: `=` stops the program.
  type, public :: planish_field_fitter_t
    private
    class(field_fitter_owner), allocatable :: owner
  contains
    procedure, private :: new_mesh => field_fitter_new_mesh
    procedure, private :: new_points => field_fitter_new_points
    procedure, private :: new_model => field_fitter_new_model
    generic :: new => new_mesh, new_points, new_model
    procedure, private :: assign => field_fitter_assign
    generic :: assignment(=) => assign
    procedure :: free => field_fitter_free
    procedure :: get => field_fitter_get
    procedure :: take => field_fitter_take
    procedure :: point_count => field_fitter_point_count
    procedure :: grid => field_fitter_grid
    procedure :: copy_parameters => field_fitter_copy_parameters
    procedure, private :: fit_rows => field_fitter_fit_rows
    procedure, private :: fit_scalars => field_fitter_fit_scalars
    procedure, private :: fit_model_rows => field_fitter_fit_model
    generic :: fit => fit_rows, fit_scalars, fit_model_rows
    procedure, private :: update_rows => field_fitter_update_rows
    procedure, private :: update_scalars => field_fitter_update_scalars
    generic :: update => update_rows, update_scalars
  end type

  !> Carries values from the nodes of a source mesh to target points, and forces on these back to the nodes. It has no
  !> copies, and one serves all threads: `=` stops the program.
  type, public :: planish_transfer_t
    private
    class(transfer_owner), allocatable :: owner
  contains
    procedure, private :: new_mesh => transfer_new
    procedure, private :: new_model => transfer_new_model
    generic :: new => new_mesh, new_model
    procedure, private :: assign => transfer_assign
    generic :: assignment(=) => assign
    procedure :: free => transfer_free
    procedure :: get => transfer_get
    procedure :: take => transfer_take
    procedure :: source_count => transfer_source_count
    procedure :: target_count => transfer_target_count
    procedure :: copy_parameters => transfer_copy_parameters
    procedure :: copy_distances => transfer_copy_distances
    procedure, private :: apply_rows => transfer_apply_rows
    procedure, private :: apply_scalars => transfer_apply_scalars
    generic :: apply => apply_rows, apply_scalars
    procedure, private :: apply_transpose_rows => transfer_apply_transpose_rows
    procedure, private :: apply_transpose_scalars => transfer_apply_transpose_scalars
    generic :: apply_transpose => apply_transpose_rows, apply_transpose_scalars
    procedure :: balance => transfer_balance
  end type

  !> Quadrilateral patches and how they meet; made for a mesh, also the places of its nodes. It has no copies: `=` stops
  !> the program.
  type, public :: planish_layout_t
    private
    class(layout_owner), allocatable :: owner
  contains
    procedure :: new => layout_new
    procedure :: cube => layout_cube
    procedure :: of_mesh => layout_of_mesh
    procedure, private :: assign => layout_assign
    generic :: assignment(=) => assign
    procedure :: free => layout_free
    procedure :: get => layout_get
    procedure :: take => layout_take
    procedure :: quad_count => layout_quad_count
    procedure :: vertex_count => layout_vertex_count
    procedure :: edge_count => layout_edge_count
    procedure :: node_count => layout_node_count
    procedure :: copy_corners => layout_copy_corners
    procedure :: copy_edges => layout_copy_edges
    procedure :: copy_valences => layout_copy_valences
    procedure :: copy_node_map => layout_copy_node_map
  end type

  !> Fits a surface to values(dim,n), or with dim = 1 values(n), at parameters uv(2,n).
  interface planish_tensor_fit_points
    module procedure tensor_fit_points_rows, tensor_fit_points_scalars
  end interface

  !> Fits a surface to values(dim,n), or with dim = 1 values(n), on the nodes of a mesh, over its parameters.
  interface planish_tensor_fit_field
    module procedure tensor_fit_field_rows, tensor_fit_field_scalars
  end interface

  !> Fits a PHT-spline to values(dim,n), or with dim = 1 values(n), at parameters uv(2,n).
  interface planish_pht_fit_points
    module procedure pht_fit_points_rows, pht_fit_points_scalars
  end interface

  !> Fits a PHT-spline to values(dim,n), or with dim = 1 values(n), on the nodes of a mesh, over its parameters.
  interface planish_pht_fit_field
    module procedure pht_fit_field_rows, pht_fit_field_scalars
  end interface

  interface handles_of
    module procedure curve_handles, surface_handles
  end interface

  public :: planish_version, planish_check_version, planish_status_name, planish_error_message, planish_error_index
  public :: planish_options_init, planish_progress
  public :: planish_tensor_fit, planish_tensor_fit_points, planish_tensor_fit_field, planish_tensor_new
  public :: planish_tensor_degree, planish_tensor_knot_count, planish_tensor_control_point_count
  public :: planish_tensor_copy_knots, planish_tensor_copy_control_points
  public :: planish_tensor_has_weights, planish_tensor_copy_weights
  public :: planish_tensor_insert_knots, planish_tensor_elevate_degree, planish_tensor_reverse, planish_tensor_split
  public :: planish_tensor_combine
  public :: planish_tspline_skin, planish_tspline_skin_curves, planish_tspline_new
  public :: planish_tspline_curve_count, planish_tspline_clone_curve
  public :: planish_tspline_knot_count, planish_tspline_copy_knots
  public :: planish_tspline_insert_knot_u, planish_tspline_insert_knot_v, planish_tspline_remove_knot_u
  public :: planish_d1rc_fit
  public :: planish_model_fit
  public :: planish_model_smooth_from_patches
  public :: planish_pht_fit, planish_pht_fit_points, planish_pht_fit_field, planish_pht_new
  public :: planish_pht_split, planish_pht_merge, planish_pht_simplify, planish_pht_refine_region
  public :: planish_pht_from_surface, planish_pht_to_tensor_patches, planish_pht_stitch
  public :: planish_pht_cell_count, planish_pht_vertex_count, planish_pht_hanging_count, planish_pht_width
  public :: planish_pht_copy_cells, planish_pht_copy_vertices, planish_pht_copy_hanging, planish_pht_copy_neighbours
  public :: planish_pht_copy_data, planish_pht_set_data, planish_pht_copy_control_points
  public :: planish_pht_set_control_points, planish_pht_copy_extraction, planish_pht_cell_at
  public :: planish_d1rc_new, planish_d1rc_degree, planish_d1rc_set_sharp_edges, planish_d1rc_copy_sharp_edges
  public :: planish_d1rc_copy_control_points, planish_d1rc_set_control_points, planish_d1rc_edge_continuity
  public :: planish_d1rc_copy_influence, planish_d1rc_blending_values, planish_d1rc_knot_count
  public :: planish_d1rc_copy_knots, planish_d1rc_configuration_count, planish_d1rc_copy_configuration

contains

  ! ---------------------------------------------------------------------------------------------------------
  ! Errors
  ! ---------------------------------------------------------------------------------------------------------

  !> The version of the library that is loaded, such as "0.2.0".
  function planish_version() result(text)
    character(:), allocatable :: text
    text = text_at(c_version())
  end function

  !> Fails unless the library that is loaded serves programs that were compiled with this module.
  subroutine planish_check_version(stat, errmsg)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call conclude(c_check_version(PLANISH_VERSION_MAJOR, PLANISH_VERSION_MINOR), stat, errmsg)
  end subroutine

  !> The name of a status, such as "PLANISH_STATUS_OK".
  function planish_status_name(status) result(text)
    integer, intent(in) :: status
    character(:), allocatable :: text
    text = text_at(c_status_name(int(status, c_int32_t)))
  end function

  !> The sentence of the library's last refusal on this thread. What this module refuses itself, such as an array
  !> that is too short, stands in errmsg only.
  function planish_error_message() result(text)
    character(:), allocatable :: text
    character(kind=c_char), allocatable :: letters(:)
    integer(c_size_t) :: length
    length = c_error_message(size=0_c_size_t)
    allocate (letters(length + 1))
    length = c_error_message(letters, size(letters, kind=c_size_t))
    text = text_of(letters(:length))
  end function

  !> What the library's last refusal on this thread was about, counted from 1; 0 if no single thing is to blame.
  function planish_error_index() result(index)
    integer(c_int64_t) :: index
    index = c_error_index() + 1
  end function

  !> What every call ends with: hands the status on, and fails if it is an error.
  subroutine conclude(status, stat, errmsg)
    integer(c_int), intent(in) :: status
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (status < 0) then
      call fail(status, planish_error_message(), stat, errmsg)
    else if (present(stat)) then
      stat = status
    end if
  end subroutine

  !> Refuses what C cannot see, and says whether it did: `if (refuse(too_short, ...)) return`.
  logical function refuse(broken, status, sentence, stat, errmsg)
    logical, intent(in) :: broken
    integer(c_int), intent(in) :: status
    character(*), intent(in) :: sentence
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    refuse = broken
    if (broken) call fail(status, sentence, stat, errmsg)
  end function

  !> Refuses an output that has fewer elements or columns than a call writes.
  logical function refuse_short(available, needed, name, stat, errmsg)
    integer(c_size_t), intent(in) :: available, needed
    character(*), intent(in) :: name
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    refuse_short = refuse(available < needed, PLANISH_STATUS_BUFFER_TOO_SMALL, &
        name // " has room for " // decimal(available) // " of " // decimal(needed), stat, errmsg)
  end function

  !> Refuses an extent that is not what a call needs.
  logical function refuse_extent(found, needed, name, stat, errmsg)
    integer(c_size_t), intent(in) :: found, needed
    character(*), intent(in) :: name
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    refuse_extent = refuse(found /= needed, PLANISH_STATUS_INVALID_ARGUMENT, &
        name // " is " // decimal(found) // ", not " // decimal(needed), stat, errmsg)
  end function

  !> Refuses columns that are not as long as a value. Of something that is no surface or curve the library says so.
  logical function refuse_dim(found, dim, name, stat, errmsg)
    integer(c_size_t), intent(in) :: found, dim
    character(*), intent(in) :: name
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    refuse_dim = .false.
    if (dim > 0) refuse_dim = refuse_extent(found, dim, "the first extent of " // name, stat, errmsg)
  end function

  !> Tells stat and errmsg, or stops the program where nobody asks for the status.
  subroutine fail(status, sentence, stat, errmsg)
    integer(c_int), intent(in) :: status
    character(*), intent(in) :: sentence
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (present(errmsg)) errmsg = sentence
    if (.not. present(stat)) error stop "planish: " // sentence
    stat = status
  end subroutine

  ! ---------------------------------------------------------------------------------------------------------
  ! Between Fortran and C
  ! ---------------------------------------------------------------------------------------------------------

  !> A text as C reads it: without blanks behind, with a NUL.
  pure function terminated(text)
    character(*), intent(in) :: text
    character(kind=c_char, len=len_trim(text) + 1) :: terminated
    terminated = trim(text) // c_null_char
  end function

  !> Leads a pointer of a record to a text, if there is one; `letters` keep it for the call.
  subroutine borrow(text, letters, address)
    character(*), intent(in), optional :: text
    character(kind=c_char), allocatable, intent(out), target :: letters(:)
    type(c_ptr), intent(inout) :: address
    integer :: i
    if (.not. present(text)) return
    allocate (letters(len_trim(text) + 1))
    do i = 1, len_trim(text)
      letters(i) = text(i:i)
    end do
    letters(size(letters)) = c_null_char
    address = c_loc(letters)
  end subroutine

  !> A text as Fortran reads it.
  pure function text_of(letters) result(text)
    character(kind=c_char), intent(in) :: letters(:)
    character(len=size(letters)) :: text
    integer :: i
    do i = 1, size(letters)
      text(i:i) = letters(i)
    end do
  end function

  !> The text of C at an address, up to its NUL.
  function text_at(address) result(text)
    type(c_ptr), intent(in) :: address
    character(:), allocatable :: text
    character(kind=c_char), pointer :: letters(:)
    integer :: length
    ! the pointer spans all that a name of the library could need; nothing behind the NUL is read
    call c_f_pointer(address, letters, [huge(length)])
    length = 0
    do while (letters(length + 1) /= c_null_char)
      length = length + 1
    end do
    text = text_of(letters(:length))
  end function

  !> A number in words' company.
  pure function decimal(number) result(text)
    integer(c_size_t), intent(in) :: number
    character(:), allocatable :: text
    character(20) :: digits
    write (digits, "(i0)") number
    text = trim(digits)
  end function

  !> What C calls for progress: goes on to the Fortran procedure behind `user`.
  integer(c_int32_t) function relay(fraction, error, user) bind(c, name="")
    real(c_double), value :: fraction, error
    type(c_ptr), value :: user
    type(listener), pointer :: heard_by
    call c_f_pointer(user, heard_by)
    relay = merge(0_c_int32_t, 1_c_int32_t, heard_by%hear(fraction, error))
  end function

  ! ---------------------------------------------------------------------------------------------------------
  ! Mesh
  ! ---------------------------------------------------------------------------------------------------------

  !> Makes a mesh from points(3+,n) and triangles(3+,m), whose nodes count from 1.
  !>
  !> repairs:  receives what was welded, dropped and turned over.
  !> node_map: receives for each node given the node of the mesh that it became.
  subroutine mesh_new(self, points, triangles, options, repairs, node_map, stat, errmsg)
    class(planish_mesh_t), intent(inout) :: self
    real(c_double), intent(in), contiguous :: points(:, :)
    integer(c_int32_t), intent(in), contiguous :: triangles(:, :)
    type(planish_mesh_options), intent(in), optional :: options
    type(planish_mesh_repairs), intent(inout), optional, target :: repairs
    integer(c_int32_t), intent(inout), optional, target, contiguous :: node_map(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_mesh_options) :: call_options
    type(c_ptr) :: handle
    integer(c_int) :: status
    if (present(options)) call_options = options
    if (refuse_short(size(points, 1, c_size_t), 3_c_size_t, "a column of points", stat, errmsg)) return
    if (refuse_short(size(triangles, 1, c_size_t), 3_c_size_t, "a column of triangles", stat, errmsg)) return
    call_options%point_stride = size(points, 1, c_size_t)
    call_options%triangle_stride = size(triangles, 1, c_size_t)
    call_options%index_base = 1
    if (present(repairs)) call_options%out_repairs = c_loc(repairs)
    if (present(node_map)) then
      if (refuse_short(size(node_map, kind=c_size_t), size(points, 2, c_size_t), "node_map", stat, errmsg)) return
      call_options%out_node_map = c_loc(node_map)
    end if
    status = c_mesh_new( &
        points, size(points, 2, c_size_t), triangles, size(triangles, 2, c_size_t), call_options, handle)
    if (status >= 0) then
      call self%take(handle)
      if (present(node_map)) node_map(:size(points, 2)) = node_map(:size(points, 2)) + 1
    end if
    call conclude(status, stat, errmsg)
  end subroutine

  !> Reads a mesh from an OFF, OBJ, PLY or STL file. repairs: receives what was welded, dropped and turned over.
  subroutine mesh_read(self, path, options, repairs, stat, errmsg)
    class(planish_mesh_t), intent(inout) :: self
    character(*), intent(in) :: path
    type(planish_mesh_options), intent(in), optional :: options
    type(planish_mesh_repairs), intent(inout), optional, target :: repairs
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_mesh_options) :: call_options
    type(c_ptr) :: handle
    integer(c_int) :: status
    if (present(options)) call_options = options
    if (present(repairs)) call_options%out_repairs = c_loc(repairs)
    status = c_mesh_read(terminated(path), call_options, handle)
    if (status >= 0) call self%take(handle)
    call conclude(status, stat, errmsg)
  end subroutine

  !> Reads a mesh from the content of a file; options%format says which, or the content itself.
  subroutine mesh_read_buffer(self, bytes, options, repairs, stat, errmsg)
    class(planish_mesh_t), intent(inout) :: self
    integer(c_int8_t), intent(in), contiguous :: bytes(:)
    type(planish_mesh_options), intent(in), optional :: options
    type(planish_mesh_repairs), intent(inout), optional, target :: repairs
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_mesh_options) :: call_options
    type(c_ptr) :: handle
    integer(c_int) :: status
    if (present(options)) call_options = options
    if (present(repairs)) call_options%out_repairs = c_loc(repairs)
    status = c_mesh_read_buffer(bytes, size(bytes, kind=c_size_t), call_options, handle)
    if (status >= 0) call self%take(handle)
    call conclude(status, stat, errmsg)
  end subroutine

  !> Writes the mesh as OFF, OBJ, PLY or STL; the name's end says which, or options%format.
  subroutine mesh_write(self, path, options, stat, errmsg)
    class(planish_mesh_t), intent(in) :: self
    character(*), intent(in) :: path
    type(planish_mesh_write_options), intent(in), optional :: options
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call conclude(c_mesh_write(self%get(), terminated(path), options), stat, errmsg)
  end subroutine

  !> What each node was in the arrays or the file, counted from 1: n at least point_count().
  subroutine mesh_copy_node_map(self, nodes, stat, errmsg)
    class(planish_mesh_t), intent(in) :: self
    integer(c_int32_t), intent(inout), contiguous :: nodes(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_size_t) :: count
    integer(c_int) :: status
    status = c_mesh_copy_node_map(self%get(), nodes, size(nodes, kind=c_size_t))
    count = self%point_count()
    if (status >= 0) nodes(:count) = nodes(:count) + 1
    call conclude(status, stat, errmsg)
  end subroutine

  !> What each triangle was in the arrays or the file, counted from 1: n at least triangle_count().
  subroutine mesh_copy_triangle_map(self, triangles, stat, errmsg)
    class(planish_mesh_t), intent(in) :: self
    integer(c_int32_t), intent(inout), contiguous :: triangles(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_size_t) :: count
    integer(c_int) :: status
    status = c_mesh_copy_triangle_map(self%get(), triangles, size(triangles, kind=c_size_t))
    count = self%triangle_count()
    if (status >= 0) triangles(:count) = triangles(:count) + 1
    call conclude(status, stat, errmsg)
  end subroutine

  !> Moves the nodes to points(3,n); triangles, parameters and fields stay.
  subroutine mesh_set_points(self, points, stat, errmsg)
    class(planish_mesh_t), intent(inout) :: self
    real(c_double), intent(in), contiguous :: points(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (refuse_extent(size(points, 1, c_size_t), 3_c_size_t, "the first extent of points", stat, errmsg)) return
    call conclude(c_mesh_set_points(self%get(), points, size(points, 2, c_size_t)), stat, errmsg)
  end subroutine

  !> Removes a field.
  subroutine mesh_remove_field(self, name, stat, errmsg)
    class(planish_mesh_t), intent(inout) :: self
    character(*), intent(in) :: name
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call conclude(c_mesh_remove_field(self%get(), terminated(name)), stat, errmsg)
  end subroutine

  impure elemental subroutine mesh_assign(self, other)
    class(planish_mesh_t), intent(inout) :: self
    class(planish_mesh_t), intent(in) :: other
    type(c_ptr) :: handle
    handle = c_null_ptr
    if (allocated(other%owner)) call conclude(c_mesh_clone(other%owner%handle, handle))
    call self%take(handle)
  end subroutine

  subroutine finalize_mesh(self)
    type(mesh_owner), intent(inout) :: self
    call c_mesh_free(self%handle)
    self%handle = c_null_ptr
  end subroutine

  !> Frees the mesh before the variable ends.
  subroutine mesh_free(self)
    class(planish_mesh_t), intent(inout) :: self
    if (allocated(self%owner)) deallocate (self%owner)
  end subroutine

  !> The handle, for C; it stays this mesh's.
  pure type(c_ptr) function mesh_get(self) result(handle)
    class(planish_mesh_t), intent(in) :: self
    handle = c_null_ptr
    if (allocated(self%owner)) handle = self%owner%handle
  end function

  !> Takes over a handle of C, which is freed by this mesh from now on.
  subroutine mesh_take(self, handle)
    class(planish_mesh_t), intent(inout) :: self
    type(c_ptr), intent(in) :: handle
    call self%free()
    if (.not. c_associated(handle)) return
    allocate (self%owner)
    self%owner%handle = handle
  end subroutine

  !> Number of nodes.
  pure integer(c_size_t) function mesh_point_count(self) result(count)
    class(planish_mesh_t), intent(in) :: self
    count = c_mesh_point_count(self%get())
  end function

  !> Number of triangles.
  pure integer(c_size_t) function mesh_triangle_count(self) result(count)
    class(planish_mesh_t), intent(in) :: self
    count = c_mesh_triangle_count(self%get())
  end function

  !> Number of edges.
  pure integer(c_size_t) function mesh_edge_count(self) result(count)
    class(planish_mesh_t), intent(in) :: self
    count = c_mesh_edge_count(self%get())
  end function

  !> Number of parts that hang together by edges.
  pure integer(c_size_t) function mesh_component_count(self) result(count)
    class(planish_mesh_t), intent(in) :: self
    count = c_mesh_component_count(self%get())
  end function

  !> Number of handles, those that cups have.
  pure integer(c_size_t) function mesh_genus(self) result(genus)
    class(planish_mesh_t), intent(in) :: self
    genus = c_mesh_genus(self%get())
  end function

  !> Nodes that have triangles, minus edges, plus triangles.
  pure integer(c_int64_t) function mesh_euler_characteristic(self) result(characteristic)
    class(planish_mesh_t), intent(in) :: self
    characteristic = c_mesh_euler_characteristic(self%get())
  end function

  !> Number of boundary loops.
  pure integer(c_size_t) function mesh_loop_count(self) result(count)
    class(planish_mesh_t), intent(in) :: self
    count = c_mesh_loop_count(self%get())
  end function

  !> Number of nodes of a boundary loop; 0 if it does not exist. Loop 1 is the longest.
  pure integer(c_size_t) function mesh_loop_point_count(self, loop) result(count)
    class(planish_mesh_t), intent(in) :: self
    integer, intent(in) :: loop
    count = 0
    if (loop >= 1) count = c_mesh_loop_point_count(self%get(), loop - 1_c_size_t)
  end function

  !> points(3,n): n at least point_count().
  subroutine mesh_copy_points(self, points, stat, errmsg)
    class(planish_mesh_t), intent(in) :: self
    real(c_double), intent(inout), contiguous :: points(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (refuse_extent(size(points, 1, c_size_t), 3_c_size_t, "the first extent of points", stat, errmsg)) return
    call conclude(c_mesh_copy_points(self%get(), points, size(points, 2, c_size_t)), stat, errmsg)
  end subroutine

  !> triangles(3,n): n at least triangle_count(); nodes count from 1.
  subroutine mesh_copy_triangles(self, triangles, stat, errmsg)
    class(planish_mesh_t), intent(in) :: self
    integer(c_int32_t), intent(inout), contiguous :: triangles(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_size_t) :: count
    integer(c_int) :: status
    if (refuse_extent(size(triangles, 1, c_size_t), 3_c_size_t, "the first extent of triangles", stat, errmsg)) return
    status = c_mesh_copy_triangles(self%get(), triangles, size(triangles, 2, c_size_t))
    count = self%triangle_count()
    if (status >= 0) triangles(:, :count) = triangles(:, :count) + 1
    call conclude(status, stat, errmsg)
  end subroutine

  !> The nodes of a boundary loop in order, the surface on their left; loop 1 is the longest, nodes count from 1.
  subroutine mesh_copy_loop(self, loop, nodes, stat, errmsg)
    class(planish_mesh_t), intent(in) :: self
    integer, intent(in) :: loop
    integer(c_int32_t), intent(inout), contiguous :: nodes(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_size_t) :: count
    integer(c_int) :: status
    if (refuse(loop < 1, PLANISH_STATUS_INDEX, "loops count from 1", stat, errmsg)) return
    status = c_mesh_copy_loop(self%get(), loop - 1_c_size_t, nodes, size(nodes, kind=c_size_t))
    count = self%loop_point_count(loop)
    if (status >= 0) nodes(:count) = nodes(:count) + 1
    call conclude(status, stat, errmsg)
  end subroutine

  !> Number of fields on the nodes.
  pure integer(c_size_t) function mesh_field_count(self) result(count)
    class(planish_mesh_t), intent(in) :: self
    count = c_mesh_field_count(self%get())
  end function

  !> The name of a field, which counts from 1; empty if it does not exist.
  function mesh_field_name(self, field) result(name)
    class(planish_mesh_t), intent(in) :: self
    integer, intent(in) :: field
    character(:), allocatable :: name
    character(kind=c_char), allocatable :: letters(:)
    integer(c_size_t) :: length
    name = ""
    if (field < 1) return
    length = c_mesh_field_name(self%get(), field - 1_c_size_t, size=0_c_size_t)
    allocate (letters(length + 1))
    length = c_mesh_field_name(self%get(), field - 1_c_size_t, letters, size(letters, kind=c_size_t))
    name = text_of(letters(:length))
  end function

  !> The values of a field: at least point_count() of them.
  subroutine mesh_copy_field(self, name, values, stat, errmsg)
    class(planish_mesh_t), intent(in) :: self
    character(*), intent(in) :: name
    real(c_double), intent(inout), contiguous :: values(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call conclude(c_mesh_copy_field(self%get(), terminated(name), values, size(values, kind=c_size_t)), stat, errmsg)
  end subroutine

  !> Adds a field, or replaces the one of this name: one value for each node.
  subroutine mesh_set_field(self, name, values, stat, errmsg)
    class(planish_mesh_t), intent(inout) :: self
    character(*), intent(in) :: name
    real(c_double), intent(in), contiguous :: values(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call conclude(c_mesh_set_field(self%get(), terminated(name), values, size(values, kind=c_size_t)), stat, errmsg)
  end subroutine

  !> Whether the nodes have parameters.
  pure logical function mesh_has_parameters(self) result(has)
    class(planish_mesh_t), intent(in) :: self
    has = c_mesh_has_parameters(self%get()) /= 0
  end function

  !> Gives each node its uv(2,n).
  subroutine mesh_set_parameters(self, uv, stat, errmsg)
    class(planish_mesh_t), intent(inout) :: self
    real(c_double), intent(in), contiguous :: uv(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (refuse_extent(size(uv, 1, c_size_t), 2_c_size_t, "the first extent of uv", stat, errmsg)) return
    call conclude(c_mesh_set_parameters(self%get(), uv, size(uv, 2, c_size_t)), stat, errmsg)
  end subroutine

  !> uv(2,n): n at least point_count().
  subroutine mesh_copy_parameters(self, uv, stat, errmsg)
    class(planish_mesh_t), intent(in) :: self
    real(c_double), intent(inout), contiguous :: uv(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (refuse_extent(size(uv, 1, c_size_t), 2_c_size_t, "the first extent of uv", stat, errmsg)) return
    call conclude(c_mesh_copy_parameters(self%get(), uv, size(uv, 2, c_size_t)), stat, errmsg)
  end subroutine

  !> Makes a mesh without some of the triangles, which count from 1.
  subroutine mesh_remove_triangles(self, triangles, rest, stat, errmsg)
    class(planish_mesh_t), intent(in) :: self
    integer(c_int32_t), intent(in) :: triangles(:)
    type(planish_mesh_t), intent(inout) :: rest
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: handle
    integer(c_int) :: status
    status = c_mesh_remove_triangles(self%get(), triangles - 1, size(triangles, kind=c_size_t), handle)
    if (status >= 0) call rest%take(handle)
    call conclude(status, stat, errmsg)
  end subroutine

  !> Makes a mesh that is cut open along a path of edges, whose nodes count from 1.
  subroutine mesh_cut_along(self, nodes, cut, stat, errmsg)
    class(planish_mesh_t), intent(in) :: self
    integer(c_int32_t), intent(in) :: nodes(:)
    type(planish_mesh_t), intent(inout) :: cut
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: handle
    integer(c_int) :: status
    status = c_mesh_cut_along(self%get(), nodes - 1, size(nodes, kind=c_size_t), handle)
    if (status >= 0) call cut%take(handle)
    call conclude(status, stat, errmsg)
  end subroutine

  !> Makes a mesh of each part that hangs together by edges.
  subroutine mesh_split_components(self, parts, stat, errmsg)
    class(planish_mesh_t), intent(in) :: self
    type(planish_mesh_t), allocatable, intent(inout) :: parts(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr), allocatable :: handles(:)
    integer(c_int) :: status
    integer :: i
    allocate (handles(self%component_count()))
    status = c_mesh_split_components(self%get(), handles, size(handles, kind=c_size_t))
    if (status >= 0) then
      if (allocated(parts)) deallocate (parts)
      allocate (parts(size(handles)))
      do i = 1, size(handles)
        call parts(i)%take(handles(i))
      end do
    end if
    call conclude(status, stat, errmsg)
  end subroutine

  !> Finds the shortest path along edges between two nodes; nodes count from 1.
  subroutine mesh_shortest_path(self, from, to, nodes, stat, errmsg)
    class(planish_mesh_t), intent(in) :: self
    integer, intent(in) :: from, to
    integer(c_int32_t), allocatable, intent(inout) :: nodes(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: first, last
    integer(c_size_t) :: count
    integer(c_int) :: status
    if (refuse(from < 1 .or. to < 1, PLANISH_STATUS_INDEX, "nodes count from 1", stat, errmsg)) return
    first = int(from - 1, c_int32_t)
    last = int(to - 1, c_int32_t)
    status = c_mesh_shortest_path(self%get(), first, last, count=0_c_size_t, out_count=count)
    if (status >= 0) then
      if (allocated(nodes)) deallocate (nodes)
      allocate (nodes(count))
      status = c_mesh_shortest_path(self%get(), first, last, nodes, count, count)
      nodes = nodes + 1
    end if
    call conclude(status, stat, errmsg)
  end subroutine

  !> Makes a mesh of fewer nodes by collapsing edges where that changes the shape least. Parameters and fields go with
  !> their nodes.
  !>
  !> sharp_edges:        further sharp edges(2,n), whose nodes count from 1.
  !> coarse_sharp_edges: receives the sharp edges(2,n) of the new mesh; its nodes count from 1.
  subroutine mesh_decimate(self, coarse, options, report, sharp_edges, coarse_sharp_edges, progress, stat, errmsg)
    class(planish_mesh_t), intent(in) :: self
    type(planish_mesh_t), intent(inout) :: coarse
    type(planish_decimate_options), intent(in), optional :: options
    type(planish_decimate_report), intent(inout), optional :: report
    integer(c_int32_t), intent(in), optional :: sharp_edges(:, :)
    integer(c_int32_t), allocatable, intent(inout), optional :: coarse_sharp_edges(:, :)
    procedure(planish_progress), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_decimate_options) :: call_options
    type(planish_decimate_report) :: found
    type(listener), target :: user
    type(c_ptr) :: handle
    integer(c_int32_t), allocatable, target :: given(:, :), taken(:, :)
    integer(c_int) :: status
    if (present(options)) call_options = options
    if (present(sharp_edges)) then
      if (refuse_extent(size(sharp_edges, 1, c_size_t), 2_c_size_t, "the first extent of sharp_edges", stat, &
          errmsg)) return
      given = sharp_edges - 1
      call_options%sharp_edges = c_loc(given)
      call_options%sharp_edge_count = size(given, 2, c_size_t)
    end if
    if (present(coarse_sharp_edges)) then
      allocate (taken(2, self%edge_count()))
      call_options%out_sharp_edges = c_loc(taken)
      call_options%out_sharp_edge_count = size(taken, 2, c_size_t)
    end if
    if (present(progress)) then
      user%hear => progress
      call_options%progress = c_funloc(relay)
      call_options%user = c_loc(user)
    end if
    status = c_mesh_decimate(self%get(), call_options, handle, found)
    if (status >= 0) then
      call coarse%take(handle)
      if (present(report)) report = found
      if (present(coarse_sharp_edges)) coarse_sharp_edges = taken(:, :found%sharp_edge_count) + 1
    end if
    call conclude(status, stat, errmsg)
  end subroutine

  !> Takes closed rows of points(3,n) from a mesh, as many as point_counts has room for: level curves of a harmonic
  !> field between two loops or nodes, for planish_tspline_skin() with closed.
  !>
  !> begin_index, end_index: the loop or node that the first and the last row are nearest to, as the options say,
  !>                         counted from 1; 1 and 2 if not given.
  !> progress:               hears of the field, and may cancel; the points are taken afterwards.
  subroutine mesh_sample_rows(self, point_counts, points, options, begin_index, end_index, progress, stat, errmsg)
    class(planish_mesh_t), intent(in) :: self
    integer, intent(inout), contiguous :: point_counts(:)
    real(c_double), allocatable, intent(inout) :: points(:, :)
    type(planish_sample_rows_options), intent(in), optional :: options
    integer, intent(in), optional :: begin_index, end_index
    procedure(planish_progress), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_sample_rows_options) :: call_options
    type(listener), target :: user
    real(c_double), allocatable :: taken(:, :)
    integer(c_size_t) :: counts(size(point_counts)), row_count, point_count
    integer(c_int) :: status
    integer :: sources(2)
    sources = [1, 2]
    if (present(begin_index)) sources(1) = begin_index
    if (present(end_index)) sources(2) = end_index
    if (refuse(any(sources < 1), PLANISH_STATUS_INDEX, "loops and nodes count from 1", stat, errmsg)) return
    if (present(options)) call_options = options
    call_options%begin_index = sources(1) - 1
    call_options%end_index = sources(2) - 1
    if (present(progress)) then
      user%hear => progress
      call_options%progress = c_funloc(relay)
      call_options%user = c_loc(user)
    end if
    row_count = size(point_counts, kind=c_size_t)
    status = c_mesh_sample_rows(self%get(), call_options, counts, row_count, point_count=0_c_size_t, &
        out_point_count=point_count)
    if (status >= 0) then
      allocate (taken(3, point_count))
      call_options%progress = c_null_funptr
      status = c_mesh_sample_rows(self%get(), call_options, counts, row_count, taken, point_count, point_count)
    end if
    if (status >= 0) then
      point_counts = int(counts)
      call move_alloc(taken, points)
    end if
    call conclude(status, stat, errmsg)
  end subroutine

  ! ---------------------------------------------------------------------------------------------------------
  ! Parameterization
  ! ---------------------------------------------------------------------------------------------------------

  !> Gives each node of a disk, possibly with holes, its (u,v). The corners in the options count from 1.
  !>
  !> node_weights: a positive number for each node, in place of 1.
  subroutine mesh_parameterize(self, options, report, node_weights, progress, stat, errmsg)
    class(planish_mesh_t), intent(inout) :: self
    type(planish_parameterize_options), intent(in), optional :: options
    type(planish_parameterize_report), intent(inout), optional :: report
    real(c_double), intent(in), optional, target, contiguous :: node_weights(:)
    procedure(planish_progress), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_parameterize_options) :: call_options
    type(listener), target :: user
    if (present(options)) call_options = counted_from_0(options)
    if (present(node_weights)) then
      if (refuse_short(size(node_weights, kind=c_size_t), self%point_count(), "node_weights", stat, errmsg)) return
      call_options%node_weights = c_loc(node_weights)
    end if
    if (present(progress)) then
      user%hear => progress
      call_options%progress = c_funloc(relay)
      call_options%user = c_loc(user)
    end if
    call conclude(c_mesh_parameterize(self%get(), call_options, report), stat, errmsg)
  end subroutine

  !> Finds the edges(2,n) where the mesh is not smooth: sharp ones, those between labels, those given, and the border.
  !> Nodes count from 1.
  !>
  !> sharp_edges: (2,n), edges that are features whatever their angle; nodes count from 1.
  !> labels:      a number for each triangle.
  !> is_corner:   receives whether each node is the end of a chain, a junction or a turn.
  subroutine mesh_find_features(self, edges, options, report, sharp_edges, labels, is_corner, stat, errmsg)
    class(planish_mesh_t), intent(in) :: self
    integer(c_int32_t), allocatable, intent(inout) :: edges(:, :)
    type(planish_feature_options), intent(in), optional :: options
    type(planish_feature_report), intent(inout), optional, target :: report
    integer(c_int32_t), intent(in), optional :: sharp_edges(:, :)
    integer(c_int32_t), intent(in), optional, target, contiguous :: labels(:)
    logical, allocatable, intent(inout), optional :: is_corner(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_feature_options) :: call_options
    type(planish_feature_report), target :: found
    integer(c_int32_t), allocatable, target :: given(:, :)
    integer(c_int32_t), allocatable :: taken(:, :)
    integer(c_int8_t), allocatable, target :: corners(:)
    integer(c_size_t) :: count
    integer(c_int) :: status
    if (present(options)) call_options = options
    if (present(sharp_edges)) then
      if (refuse_pairs(sharp_edges, "sharp_edges", stat, errmsg)) return
      given = sharp_edges - 1
      call_options%sharp_edges = c_loc(given)
      call_options%sharp_edge_count = size(given, 2, c_size_t)
    end if
    if (present(labels)) then
      if (refuse_extent(size(labels, kind=c_size_t), self%triangle_count(), "the extent of labels", stat, errmsg)) return
      call_options%labels = c_loc(labels)
    end if
    allocate (taken(2, self%edge_count()), corners(self%point_count()))
    call_options%out_is_corner = c_loc(corners)
    call_options%out_report = c_loc(found)
    status = c_mesh_find_features(self%get(), call_options, taken, size(taken, 2, c_size_t), count)
    if (status >= 0) then
      edges = taken(:, :count) + 1
      if (present(report)) report = found
      if (present(is_corner)) is_corner = corners /= 0
    end if
    call conclude(status, stat, errmsg)
  end subroutine

  !> Tells how each label of a mesh hangs together: a face is one piece without handles.
  !>
  !> labels:          a number for each triangle.
  !> found:           receives each label once, in increasing order.
  !> triangle_counts: receives for each its number of triangles.
  !> piece_counts:    receives for each the number of its pieces, which share no edge.
  !> handle_counts:   receives for each the handles of all its pieces.
  subroutine mesh_label_parts(self, labels, found, triangle_counts, piece_counts, handle_counts, stat, errmsg)
    class(planish_mesh_t), intent(in) :: self
    integer(c_int32_t), intent(in), contiguous :: labels(:)
    integer(c_int32_t), allocatable, intent(inout) :: found(:)
    integer(c_size_t), allocatable, intent(inout), optional :: triangle_counts(:), piece_counts(:), handle_counts(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int32_t), allocatable :: taken(:)
    integer(c_size_t), allocatable :: numbers(:, :)
    integer(c_size_t) :: label_count, count
    integer(c_int) :: status
    label_count = size(labels, kind=c_size_t)
    status = c_mesh_label_parts(self%get(), labels, label_count, count=0_c_size_t, out_count=count)
    if (status >= 0) then
      allocate (taken(count), numbers(count, 3))
      status = c_mesh_label_parts(self%get(), labels, label_count, taken, numbers(:, 1), numbers(:, 2), numbers(:, 3), &
          count, count)
    end if
    if (status >= 0) then
      call move_alloc(taken, found)
      if (present(triangle_counts)) triangle_counts = numbers(:, 1)
      if (present(piece_counts)) piece_counts = numbers(:, 2)
      if (present(handle_counts)) handle_counts = numbers(:, 3)
    end if
    call conclude(status, stat, errmsg)
  end subroutine

  !> Finds the place on the mesh nearest to each of points(3,n): the way back from places of a model to triangles, and so
  !> to labels.
  !>
  !> triangles: receives the triangles they lie on, 0 for points farther away than options%max_distance.
  !> places:    (3,n), receives the places.
  !> distances: receives how far they are.
  subroutine mesh_project(self, points, triangles, places, distances, options, stat, errmsg)
    class(planish_mesh_t), intent(in) :: self
    real(c_double), intent(in), contiguous :: points(:, :)
    integer, intent(inout) :: triangles(:)
    real(c_double), intent(inout), optional, contiguous :: places(:, :), distances(:)
    type(planish_project_options), intent(in), optional :: options
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int32_t), allocatable :: found(:)
    integer(c_size_t) :: count
    integer(c_int) :: status
    count = size(points, 2, c_size_t)
    if (refuse_extent(size(points, 1, c_size_t), 3_c_size_t, "the first extent of points", stat, errmsg)) return
    if (refuse_short(size(triangles, kind=c_size_t), count, "triangles", stat, errmsg)) return
    if (present(places)) then
      if (refuse_extent(size(places, 1, c_size_t), 3_c_size_t, "the first extent of places", stat, errmsg)) return
      if (refuse_short(size(places, 2, c_size_t), count, "places", stat, errmsg)) return
    end if
    if (present(distances)) then
      if (refuse_short(size(distances, kind=c_size_t), count, "distances", stat, errmsg)) return
    end if
    allocate (found(count))
    status = c_mesh_project(self%get(), points, count, options, found, places, distances)
    if (status >= 0) triangles(:count) = found + 1
    call conclude(status, stat, errmsg)
  end subroutine

  !> Maps a closed mesh of one component and genus 0 on to the unit sphere, one to one.
  !>
  !> points: receives x, y, z of each node: a unit vector, or zeros for a node without triangles.
  subroutine mesh_map_to_sphere(self, points, options, report, progress, stat, errmsg)
    class(planish_mesh_t), intent(in) :: self
    real(c_double), intent(inout), contiguous :: points(:, :)
    type(planish_sphere_options), intent(in), optional :: options
    type(planish_sphere_report), intent(inout), optional :: report
    procedure(planish_progress), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_sphere_options) :: call_options
    type(listener), target :: user
    if (present(options)) call_options = options
    if (refuse_extent(size(points, 1, c_size_t), 3_c_size_t, "the length of a column of points", stat, errmsg)) return
    if (present(progress)) then
      user%hear => progress
      call_options%progress = c_funloc(relay)
      call_options%user = c_loc(user)
    end if
    call conclude( &
        c_mesh_map_to_sphere(self%get(), call_options, points, size(points, 2, c_size_t), report), stat, errmsg)
  end subroutine

  !> The same options for C. Corners that nobody set are left alone.
  pure type(planish_parameterize_options) function counted_from_0(options) result(same)
    type(planish_parameterize_options), intent(in) :: options
    same = options
    if (options%border == PLANISH_BORDER_CORNERS) same%corners = options%corners - 1
  end function

  ! ---------------------------------------------------------------------------------------------------------
  ! Surface
  ! ---------------------------------------------------------------------------------------------------------

  impure elemental subroutine surface_assign(self, other)
    class(planish_surface_t), intent(inout) :: self
    class(planish_surface_t), intent(in) :: other
    type(c_ptr) :: handle
    handle = c_null_ptr
    if (allocated(other%owner)) call conclude(c_surface_clone(other%owner%handle, handle))
    call self%take(handle)
  end subroutine

  subroutine finalize_surface(self)
    type(surface_owner), intent(inout) :: self
    call c_surface_free(self%handle)
    self%handle = c_null_ptr
  end subroutine

  !> Frees the surface before the variable ends.
  subroutine surface_free(self)
    class(planish_surface_t), intent(inout) :: self
    if (allocated(self%owner)) deallocate (self%owner)
  end subroutine

  !> The handle, for C; it stays this surface's.
  pure type(c_ptr) function surface_get(self) result(handle)
    class(planish_surface_t), intent(in) :: self
    handle = c_null_ptr
    if (allocated(self%owner)) handle = self%owner%handle
  end function

  !> Takes over a handle of C, which is freed by this surface from now on.
  subroutine surface_take(self, handle)
    class(planish_surface_t), intent(inout) :: self
    type(c_ptr), intent(in) :: handle
    call self%free()
    if (.not. c_associated(handle)) return
    allocate (self%owner)
    self%owner%handle = handle
  end subroutine

  !> The family: a PLANISH_KIND.
  pure integer(c_int32_t) function surface_kind(self) result(kind)
    class(planish_surface_t), intent(in) :: self
    kind = c_surface_kind(self%get())
  end function

  !> Numbers of a value: 1 for a scalar field, 3 for a shape.
  pure integer(c_size_t) function surface_dim(self) result(dim)
    class(planish_surface_t), intent(in) :: self
    dim = c_surface_dim(self%get())
  end function

  !> Number of control points.
  pure integer(c_size_t) function surface_coefficient_count(self) result(count)
    class(planish_surface_t), intent(in) :: self
    count = c_surface_coefficient_count(self%get())
  end function

  !> The rectangle of definition: least u, largest u, least v, largest v.
  subroutine surface_domain(self, box, stat, errmsg)
    class(planish_surface_t), intent(in) :: self
    real(c_double), intent(inout) :: box(4)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call conclude(c_surface_domain(self%get(), box), stat, errmsg)
  end subroutine

  !> The box of the data's (u,v): least u, largest u, least v, largest v.
  subroutine surface_data_box(self, box, stat, errmsg)
    class(planish_surface_t), intent(in) :: self
    real(c_double), intent(inout) :: box(4)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call conclude(c_surface_data_box(self%get(), box), stat, errmsg)
  end subroutine

  !> values(:,i) = S(uv(1,i), uv(2,i)). flags: receives bits of PLANISH_FLAG for each point.
  subroutine surface_eval_rows(self, uv, values, options, flags, stat, errmsg)
    class(planish_surface_t), intent(in) :: self
    real(c_double), intent(in), contiguous :: uv(:, :)
    real(c_double), intent(inout), contiguous :: values(:, :)
    type(planish_eval_options), intent(in), optional :: options
    integer(c_int8_t), intent(inout), optional, target, contiguous :: flags(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_eval_options) :: call_options
    if (present(options)) call_options = options
    if (refuse_points(call_options, shape(uv, c_size_t), shape(values, c_size_t), flags, stat, errmsg)) return
    call conclude(c_surface_eval(self%get(), uv, size(uv, 2, c_size_t), call_options, values), stat, errmsg)
  end subroutine

  !> The same for a scalar field, values(n).
  subroutine surface_eval_scalars(self, uv, values, options, flags, stat, errmsg)
    class(planish_surface_t), intent(in) :: self
    real(c_double), intent(in), contiguous :: uv(:, :)
    real(c_double), intent(inout), contiguous, target :: values(:)
    type(planish_eval_options), intent(in), optional :: options
    integer(c_int8_t), intent(inout), optional, target, contiguous :: flags(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    real(c_double), pointer, contiguous :: rows(:, :)
    rows(1:1, 1:size(values)) => values
    call self%eval(uv, rows, options, flags, stat, errmsg)
  end subroutine

  !> out(:,k,i): S; Su, Sv; Suu, Suv, Svv at uv(:,i), 1, 3 or 6 columns for max_derivative 0, 1 or 2.
  subroutine surface_eval_derivatives(self, uv, max_derivative, out, options, flags, stat, errmsg)
    class(planish_surface_t), intent(in) :: self
    real(c_double), intent(in), contiguous :: uv(:, :)
    integer, intent(in) :: max_derivative
    real(c_double), intent(inout), contiguous :: out(:, :, :)
    type(planish_eval_options), intent(in), optional :: options
    integer(c_int8_t), intent(inout), optional, target, contiguous :: flags(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_eval_options) :: call_options
    integer(c_size_t) :: extents(3)
    extents = shape(out, c_size_t)
    if (present(options)) call_options = options
    if (refuse_dim(extents(1), self%dim(), "out", stat, errmsg)) return
    if (refuse_points(call_options, shape(uv, c_size_t), [extents(1) * extents(2), extents(3)], flags, stat, errmsg)) &
        return
    call conclude(c_surface_eval_derivatives(self%get(), uv, size(uv, 2, c_size_t), int(max_derivative, c_int32_t), &
        call_options, out), stat, errmsg)
  end subroutine

  !> values(:,j,i) = S(u(i), v(j)): values(dim, size(v), size(u)).
  subroutine surface_eval_grid(self, u, v, values, options, flags, stat, errmsg)
    class(planish_surface_t), intent(in) :: self
    real(c_double), intent(in), contiguous :: u(:), v(:)
    real(c_double), intent(inout), contiguous :: values(:, :, :)
    type(planish_eval_options), intent(in), optional :: options
    integer(c_int8_t), intent(inout), optional, target, contiguous :: flags(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_eval_options) :: call_options
    integer(c_size_t) :: extents(3)
    extents = shape(values, c_size_t)
    if (present(options)) call_options = options
    if (refuse_dim(extents(1), self%dim(), "values", stat, errmsg)) return
    if (refuse_extent(extents(2), size(v, kind=c_size_t), "the second extent of values", stat, errmsg)) return
    if (refuse_extent(extents(3), size(u, kind=c_size_t), "the third extent of values", stat, errmsg)) return
    call_options%uv_stride = 0
    call_options%out_stride = 0
    if (present(flags)) then
      if (refuse_extent(size(flags, 1, c_size_t), extents(2), "the first extent of flags", stat, errmsg)) return
      if (refuse_extent(size(flags, 2, c_size_t), extents(3), "the second extent of flags", stat, errmsg)) return
      call_options%out_flags = c_loc(flags)
    end if
    call conclude(c_surface_eval_grid(self%get(), u, extents(3), v, extents(2), call_options, values), stat, errmsg)
  end subroutine

  !> Unit normals(3,n) at uv(2,n).
  subroutine surface_normals(self, uv, normals, options, flags, stat, errmsg)
    class(planish_surface_t), intent(in) :: self
    real(c_double), intent(in), contiguous :: uv(:, :)
    real(c_double), intent(inout), contiguous :: normals(:, :)
    type(planish_eval_options), intent(in), optional :: options
    integer(c_int8_t), intent(inout), optional, target, contiguous :: flags(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_eval_options) :: call_options
    if (present(options)) call_options = options
    if (refuse_points(call_options, shape(uv, c_size_t), shape(normals, c_size_t), flags, stat, errmsg)) return
    call conclude(c_surface_normals(self%get(), uv, size(uv, 2, c_size_t), call_options, normals), stat, errmsg)
  end subroutine

  !> Principal curvatures and directions, out(8,n): k1, k2, d1(3), d2(3) at uv(2,n).
  subroutine surface_curvatures(self, uv, out, options, flags, stat, errmsg)
    class(planish_surface_t), intent(in) :: self
    real(c_double), intent(in), contiguous :: uv(:, :)
    real(c_double), intent(inout), contiguous :: out(:, :)
    type(planish_eval_options), intent(in), optional :: options
    integer(c_int8_t), intent(inout), optional, target, contiguous :: flags(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_eval_options) :: call_options
    if (present(options)) call_options = options
    if (refuse_points(call_options, shape(uv, c_size_t), shape(out, c_size_t), flags, stat, errmsg)) return
    call conclude(c_surface_curvatures(self%get(), uv, size(uv, 2, c_size_t), call_options, out), stat, errmsg)
  end subroutine

  !> The name of the surface; empty without one.
  function surface_name(self) result(name)
    class(planish_surface_t), intent(in) :: self
    character(:), allocatable :: name
    character(kind=c_char), allocatable :: letters(:)
    integer(c_size_t) :: length
    length = c_surface_name(self%get(), size=0_c_size_t)
    allocate (letters(length + 1))
    length = c_surface_name(self%get(), letters, size(letters, kind=c_size_t))
    name = text_of(letters(:length))
  end function

  !> Gives the surface a name, which copies and saved files have too.
  subroutine surface_set_name(self, name, stat, errmsg)
    class(planish_surface_t), intent(inout) :: self
    character(*), intent(in) :: name
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call conclude(c_surface_set_name(self%get(), terminated(name)), stat, errmsg)
  end subroutine

  !> What one unit of the surface is: a PLANISH_UNIT.
  integer(c_int32_t) function surface_unit(self)
    class(planish_surface_t), intent(in) :: self
    surface_unit = c_surface_unit(self%get())
  end function

  !> Says what one unit of the surface is; no number changes.
  subroutine surface_set_unit(self, unit, stat, errmsg)
    class(planish_surface_t), intent(inout) :: self
    integer(c_int32_t), intent(in) :: unit
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call conclude(c_surface_set_unit(self%get(), unit), stat, errmsg)
  end subroutine

  !> The box of the surface: box(:,1) has the least, box(:,2) the largest of each component.
  subroutine surface_box(self, box, stat, errmsg)
    class(planish_surface_t), intent(in) :: self
    real(c_double), intent(inout), contiguous :: box(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (refuse_extent(size(box, 2, c_size_t), 2_c_size_t, "the second extent of box", stat, errmsg)) return
    if (self%dim() > 0) then ! of no surface the library says so
      if (refuse_extent(size(box, 1, c_size_t), self%dim(), "the first extent of box", stat, errmsg)) return
    end if
    call conclude(c_surface_box(self%get(), box), stat, errmsg)
  end subroutine

  !> The area of the part of a surface in space that is inside its trims; options say how finely it is divided.
  subroutine surface_area(self, area, options, stat, errmsg)
    class(planish_surface_t), intent(in) :: self
    real(c_double), intent(inout) :: area
    type(planish_tessellate_options), intent(in), optional :: options
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call conclude(c_surface_area(self%get(), options, area), stat, errmsg)
  end subroutine

  !> Whether the two sides of the domain that bound an axis are one curve.
  logical function surface_is_closed(self, axis)
    class(planish_surface_t), intent(in) :: self
    integer(c_int32_t), intent(in) :: axis
    surface_is_closed = c_surface_is_closed(self%get(), axis) /= 0
  end function

  !> gradients(:,k,i): the gradient in space of component k of a field over the parameters of this shape, at uv(:,i).
  !>
  !> thread_count: threads to use; 0, or none given, for all cores.
  subroutine surface_field_gradient(self, field, uv, gradients, thread_count, stat, errmsg)
    class(planish_surface_t), intent(in) :: self
    class(planish_surface_t), intent(in) :: field
    real(c_double), intent(in), contiguous :: uv(:, :)
    real(c_double), intent(inout), contiguous :: gradients(:, :, :)
    integer, intent(in), optional :: thread_count
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_gradient_options) :: options
    integer(c_size_t) :: count
    count = size(uv, 2, c_size_t)
    if (present(thread_count)) options%thread_count = int(thread_count, c_int32_t)
    if (refuse_extent(size(uv, 1, c_size_t), 2_c_size_t, "the first extent of uv", stat, errmsg)) return
    if (refuse_extent(size(gradients, 1, c_size_t), 3_c_size_t, "the first extent of gradients", stat, errmsg)) return
    if (field%dim() > 0) then ! of no field the library says so
      if (refuse_extent(size(gradients, 2, c_size_t), field%dim(), "the second extent of gradients", &
          stat, errmsg)) return
    end if
    if (refuse_short(size(gradients, 3, c_size_t), count, "gradients", stat, errmsg)) return
    call conclude(c_surface_field_gradient(self%get(), field%get(), uv, count, options, gradients), stat, errmsg)
  end subroutine

  !> Sets strides and flags of an evaluation, and refuses arrays that do not go together.
  logical function refuse_points(options, points, values, flags, stat, errmsg) result(refused)
    type(planish_eval_options), intent(inout) :: options
    integer(c_size_t), intent(in) :: points(2), values(2)
    integer(c_int8_t), intent(inout), optional, target, contiguous :: flags(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    refused = .true.
    ! a stride of 0 would mean the default
    if (refuse(any([points(1), values(1)] < 1), PLANISH_STATUS_INVALID_ARGUMENT, &
        "an array has columns of no numbers", stat, errmsg)) return
    if (refuse_short(values(2), points(2), "the array of results", stat, errmsg)) return
    options%uv_stride = points(1)
    options%out_stride = values(1)
    if (present(flags)) then
      if (refuse_short(size(flags, kind=c_size_t), points(2), "flags", stat, errmsg)) return
      options%out_flags = c_loc(flags)
    end if
    refused = .false.
  end function

  !> Number of trims.
  pure integer(c_size_t) function surface_trim_count(self) result(count)
    class(planish_surface_t), intent(in) :: self
    count = c_surface_trim_count(self%get())
  end function

  !> Number of points of a trim; 0 if it does not exist. Trim 1 is the outer one.
  pure integer(c_size_t) function surface_trim_point_count(self, trim) result(count)
    class(planish_surface_t), intent(in) :: self
    integer, intent(in) :: trim
    count = 0
    if (trim >= 1) count = c_surface_trim_point_count(self%get(), trim - 1_c_size_t)
  end function

  !> uv(2,n) of a trim's points: n at least trim_point_count(trim). Trim 1 is the outer one.
  subroutine surface_copy_trim(self, trim, uv, stat, errmsg)
    class(planish_surface_t), intent(in) :: self
    integer, intent(in) :: trim
    real(c_double), intent(inout), contiguous :: uv(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (refuse(trim < 1, PLANISH_STATUS_INDEX, "trims count from 1", stat, errmsg)) return
    if (refuse_extent(size(uv, 1, c_size_t), 2_c_size_t, "the first extent of uv", stat, errmsg)) return
    call conclude(c_surface_copy_trim(self%get(), trim - 1_c_size_t, uv, size(uv, 2, c_size_t)), stat, errmsg)
  end subroutine

  !> Replaces the trims: uv(2,n), trim after trim, and how many points each has.
  subroutine surface_set_trims(self, uv, point_counts, stat, errmsg)
    class(planish_surface_t), intent(inout) :: self
    real(c_double), intent(in), contiguous :: uv(:, :)
    integer, intent(in) :: point_counts(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_size_t) :: counts(size(point_counts))
    if (refuse(any(point_counts < 0), PLANISH_STATUS_INVALID_ARGUMENT, "a trim has less than no points", &
        stat, errmsg)) return
    counts = point_counts
    if (refuse_extent(size(uv, 1, c_size_t), 2_c_size_t, "the first extent of uv", stat, errmsg)) return
    if (refuse_extent(size(uv, 2, c_size_t), sum(counts), "the second extent of uv", stat, errmsg)) return
    call conclude(c_surface_set_trims(self%get(), uv, counts, size(counts, kind=c_size_t)), stat, errmsg)
  end subroutine

  !> Makes trims that follow curves in space, loop after loop, and how many curves each loop has; one without
  !> curve_counts. worst_curve of the report counts from 1.
  subroutine surface_trim_by_curves(self, curves, curve_counts, options, report, progress, stat, errmsg)
    class(planish_surface_t), intent(inout) :: self
    class(planish_curve_t), intent(in) :: curves(:)
    integer, intent(in), optional :: curve_counts(:)
    type(planish_trim_options), intent(in), optional :: options
    type(planish_trim_report), intent(inout), optional :: report
    procedure(planish_progress), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_trim_options) :: call_options
    type(listener), target :: user
    integer(c_size_t), allocatable :: counts(:)
    integer(c_int) :: status
    if (present(options)) call_options = options
    if (present(curve_counts)) then
      if (refuse(any(curve_counts < 0), PLANISH_STATUS_INVALID_ARGUMENT, "a loop has less than no curves", &
          stat, errmsg)) return
      allocate (counts(size(curve_counts)), source=int(curve_counts, c_size_t))
    else
      allocate (counts(size(curves)), source=1_c_size_t)
    end if
    if (refuse_extent(size(curves, kind=c_size_t), sum(counts), "the number of curves", stat, errmsg)) return
    if (present(progress)) then
      user%hear => progress
      call_options%progress = c_funloc(relay)
      call_options%user = c_loc(user)
    end if
    status = c_surface_trim_by_curves(self%get(), handles_of(curves), counts, size(counts, kind=c_size_t), &
      call_options, report)
    if (status >= 0 .and. present(report)) report%worst_curve = report%worst_curve + 1
    call conclude(status, stat, errmsg)
  end subroutine

  !> Number of Bezier patches: they cover the domain without overlap and are the surface exactly.
  pure integer(c_size_t) function surface_patch_count(self) result(count)
    class(planish_surface_t), intent(in) :: self
    count = c_surface_patch_count(self%get())
  end function

  !> The number of the patch over (u,v), beyond the domain of the one continued there; 0 if there are no patches.
  pure integer function surface_patch_at(self, u, v) result(index)
    class(planish_surface_t), intent(in) :: self
    real(c_double), intent(in) :: u, v
    index = 0
    if (self%patch_count() > 0) index = int(c_surface_patch_at(self%get(), u, v)) + 1
  end function

  !> A Bezier patch, counted from 1: where it lies, and its ordinates(ordinate_width, degree_v + 1, degree_u + 1).
  !> Ask for the patch alone first: it says how many ordinates there are.
  subroutine surface_copy_patch(self, index, patch, ordinates, stat, errmsg)
    class(planish_surface_t), intent(in) :: self
    integer, intent(in) :: index
    type(planish_patch), intent(inout) :: patch
    real(c_double), intent(inout), optional, contiguous :: ordinates(:, :, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_patch) :: found
    integer(c_int) :: status
    if (refuse(index < 1, PLANISH_STATUS_INDEX, "patches count from 1", stat, errmsg)) return
    status = c_surface_copy_patch(self%get(), index - 1_c_size_t, found, count=0_c_size_t)
    if (status >= 0 .and. present(ordinates)) then
      if (refuse_extent(size(ordinates, 1, c_size_t), found%ordinate_width, "the first extent of ordinates", &
          stat, errmsg)) return
      if (refuse_extent(size(ordinates, 2, c_size_t), found%degree_v + 1_c_size_t, "the second extent of ordinates", &
          stat, errmsg)) return
      if (refuse_extent(size(ordinates, 3, c_size_t), found%degree_u + 1_c_size_t, "the third extent of ordinates", &
          stat, errmsg)) return
      status = c_surface_copy_patch(self%get(), index - 1_c_size_t, found, ordinates, found%ordinate_count)
    end if
    if (status >= 0) patch = found
    call conclude(status, stat, errmsg)
  end subroutine

  !> Makes a tensor surface that is the same surface exactly, with the same trims.
  subroutine surface_to_tensor(self, tensor, options, stat, errmsg)
    class(planish_surface_t), intent(in) :: self
    class(planish_surface_t), intent(inout) :: tensor
    type(planish_convert_options), intent(in), optional :: options
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: handle
    integer(c_int) :: status
    status = c_surface_to_tensor(self%get(), options, handle)
    if (status >= 0) call tensor%take(handle)
    call conclude(status, stat, errmsg)
  end subroutine

  ! ---------------------------------------------------------------------------------------------------------
  ! Tensor surface
  ! ---------------------------------------------------------------------------------------------------------

  !> Fits a surface to the shape of a mesh. All fits take these:
  !>
  !> report:       receives how good the surface is; worst_index counts from 1.
  !> parameterize: how a mesh without parameters gets them.
  !> weights:      a positive number for each datum, in place of 1.
  !> parameters:   (2,n), receives the (u,v) at which the error of each datum is measured.
  !> errors:       receives the error of each datum.
  !> progress:     hears how far the fit is, and may cancel it.
  subroutine planish_tensor_fit( &
      mesh, surface, options, report, parameterize, weights, parameters, errors, progress, stat, errmsg)
    class(planish_mesh_t), intent(in) :: mesh
    class(planish_surface_t), intent(inout) :: surface
    type(planish_tensor_options), intent(in), optional :: options
    type(planish_fit_report), intent(inout), optional :: report
    type(planish_parameterize_options), intent(in), optional :: parameterize
    real(c_double), intent(in), optional, target, contiguous :: weights(:)
    real(c_double), intent(inout), optional, target, contiguous :: parameters(:, :), errors(:)
    procedure(planish_progress), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_tensor_options) :: call_options
    type(planish_parameterize_options), target :: map
    type(listener), target :: user
    type(c_ptr) :: handle
    integer(c_int) :: status
    if (present(options)) call_options = options
    if (refuse_data(call_options, map, user, mesh%point_count(), parameterize, weights, parameters, errors, progress, &
        stat, errmsg)) return
    status = c_tensor_fit(mesh%get(), call_options, handle, report)
    if (status >= 0) call surface%take(handle)
    call conclude_fit(status, report, stat, errmsg)
  end subroutine

  subroutine tensor_fit_points_rows( &
      uv, values, surface, options, report, weights, parameters, errors, progress, stat, errmsg)
    real(c_double), intent(in), contiguous :: uv(:, :), values(:, :)
    class(planish_surface_t), intent(inout) :: surface
    type(planish_tensor_options), intent(in), optional :: options
    type(planish_fit_report), intent(inout), optional :: report
    real(c_double), intent(in), optional, target, contiguous :: weights(:)
    real(c_double), intent(inout), optional, target, contiguous :: parameters(:, :), errors(:)
    procedure(planish_progress), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_tensor_options) :: call_options
    type(planish_parameterize_options), target :: map
    type(listener), target :: user
    type(c_ptr) :: handle
    integer(c_int) :: status
    integer(c_size_t) :: count
    count = size(uv, 2, c_size_t)
    if (present(options)) call_options = options
    if (refuse_extent(size(uv, 1, c_size_t), 2_c_size_t, "the first extent of uv", stat, errmsg)) return
    if (refuse_extent(size(values, 2, c_size_t), count, "the number of values", stat, errmsg)) return
    if (refuse_data(call_options, map, user, count, weights=weights, parameters=parameters, errors=errors, &
        progress=progress, stat=stat, errmsg=errmsg)) return
    status = c_tensor_fit_points(uv, values, count, size(values, 1, c_size_t), call_options, handle, report)
    if (status >= 0) call surface%take(handle)
    call conclude_fit(status, report, stat, errmsg)
  end subroutine

  subroutine tensor_fit_points_scalars( &
      uv, values, surface, options, report, weights, parameters, errors, progress, stat, errmsg)
    real(c_double), intent(in), contiguous :: uv(:, :)
    real(c_double), intent(in), contiguous, target :: values(:)
    class(planish_surface_t), intent(inout) :: surface
    type(planish_tensor_options), intent(in), optional :: options
    type(planish_fit_report), intent(inout), optional :: report
    real(c_double), intent(in), optional, target, contiguous :: weights(:)
    real(c_double), intent(inout), optional, target, contiguous :: parameters(:, :), errors(:)
    procedure(planish_progress), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    real(c_double), pointer, contiguous :: rows(:, :)
    rows(1:1, 1:size(values)) => values
    ! not by the generic name, which gfortran 12 would take for the C function of the same name
    call tensor_fit_points_rows( &
        uv, rows, surface, options, report, weights, parameters, errors, progress, stat, errmsg)
  end subroutine

  subroutine tensor_fit_field_rows( &
      mesh, values, surface, options, report, parameterize, weights, parameters, errors, progress, stat, errmsg)
    class(planish_mesh_t), intent(in) :: mesh
    real(c_double), intent(in), contiguous :: values(:, :)
    class(planish_surface_t), intent(inout) :: surface
    type(planish_tensor_options), intent(in), optional :: options
    type(planish_fit_report), intent(inout), optional :: report
    type(planish_parameterize_options), intent(in), optional :: parameterize
    real(c_double), intent(in), optional, target, contiguous :: weights(:)
    real(c_double), intent(inout), optional, target, contiguous :: parameters(:, :), errors(:)
    procedure(planish_progress), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_tensor_options) :: call_options
    type(planish_parameterize_options), target :: map
    type(listener), target :: user
    type(c_ptr) :: handle
    integer(c_int) :: status
    if (present(options)) call_options = options
    if (refuse_data(call_options, map, user, size(values, 2, c_size_t), parameterize, weights, parameters, errors, progress, &
        stat, errmsg)) return
    status = c_tensor_fit_field( &
        mesh%get(), values, size(values, 2, c_size_t), size(values, 1, c_size_t), call_options, handle, report)
    if (status >= 0) call surface%take(handle)
    call conclude_fit(status, report, stat, errmsg)
  end subroutine

  subroutine tensor_fit_field_scalars( &
      mesh, values, surface, options, report, parameterize, weights, parameters, errors, progress, stat, errmsg)
    class(planish_mesh_t), intent(in) :: mesh
    real(c_double), intent(in), contiguous, target :: values(:)
    class(planish_surface_t), intent(inout) :: surface
    type(planish_tensor_options), intent(in), optional :: options
    type(planish_fit_report), intent(inout), optional :: report
    type(planish_parameterize_options), intent(in), optional :: parameterize
    real(c_double), intent(in), optional, target, contiguous :: weights(:)
    real(c_double), intent(inout), optional, target, contiguous :: parameters(:, :), errors(:)
    procedure(planish_progress), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    real(c_double), pointer, contiguous :: rows(:, :)
    rows(1:1, 1:size(values)) => values
    call tensor_fit_field_rows( &
        mesh, rows, surface, options, report, parameterize, weights, parameters, errors, progress, stat, errmsg)
  end subroutine

  !> Leads the options of a fit to its optional arguments, and refuses arrays that are too short for `count` data.
  logical function refuse_data(options, map, user, count, parameterize, weights, parameters, errors, progress, &
      stat, errmsg) result(refused)
    type(planish_tensor_options), intent(inout) :: options
    type(planish_parameterize_options), intent(inout), target :: map
    type(listener), intent(inout), target :: user
    integer(c_size_t), intent(in) :: count
    type(planish_parameterize_options), intent(in), optional :: parameterize
    real(c_double), intent(in), optional, target, contiguous :: weights(:)
    real(c_double), intent(inout), optional, target, contiguous :: parameters(:, :), errors(:)
    procedure(planish_progress), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    refused = .true.
    if (present(parameterize)) then
      map = counted_from_0(parameterize)
      options%parameterize = c_loc(map)
    end if
    if (present(weights)) then
      if (refuse_short(size(weights, kind=c_size_t), count, "weights", stat, errmsg)) return
      options%weights = c_loc(weights)
    end if
    if (present(parameters)) then
      if (refuse_extent(size(parameters, 1, c_size_t), 2_c_size_t, "the first extent of parameters", &
          stat, errmsg)) return
      if (refuse_short(size(parameters, 2, c_size_t), count, "parameters", stat, errmsg)) return
      options%out_parameters = c_loc(parameters)
    end if
    if (present(errors)) then
      if (refuse_short(size(errors, kind=c_size_t), count, "errors", stat, errmsg)) return
      options%out_errors = c_loc(errors)
    end if
    if (present(progress)) then
      user%hear => progress
      options%progress = c_funloc(relay)
      options%user = c_loc(user)
    end if
    refused = .false.
  end function

  !> Ends a fit: its report names the worst datum.
  subroutine conclude_fit(status, report, stat, errmsg)
    integer(c_int), intent(in) :: status
    type(planish_fit_report), intent(inout), optional :: report
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (status >= 0 .and. present(report)) report%worst_index = report%worst_index + 1
    call conclude(status, stat, errmsg)
  end subroutine

  !> Makes a tensor surface from its parts: control_points(dim, along v, along u), weights(along v, along u).
  subroutine planish_tensor_new(degree_u, degree_v, knots_u, knots_v, control_points, surface, weights, stat, errmsg)
    integer, intent(in) :: degree_u, degree_v
    real(c_double), intent(in), contiguous :: knots_u(:), knots_v(:), control_points(:, :, :)
    class(planish_surface_t), intent(inout) :: surface
    real(c_double), intent(in), optional, contiguous :: weights(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: handle
    integer(c_size_t) :: extents(3)
    integer(c_int) :: status
    extents = shape(control_points, c_size_t)
    if (refuse_extent(extents(2), size(knots_v, kind=c_size_t) - degree_v - 1, "the second extent of control_points", &
        stat, errmsg)) return
    if (refuse_extent(extents(3), size(knots_u, kind=c_size_t) - degree_u - 1, "the third extent of control_points", &
        stat, errmsg)) return
    if (present(weights)) then
      if (refuse_extent(size(weights, 1, c_size_t), extents(2), "the first extent of weights", stat, errmsg)) return
      if (refuse_extent(size(weights, 2, c_size_t), extents(3), "the second extent of weights", stat, errmsg)) return
    end if
    status = c_tensor_new(extents(1), int(degree_u, c_int32_t), int(degree_v, c_int32_t), knots_u, &
        size(knots_u, kind=c_size_t), knots_v, size(knots_v, kind=c_size_t), control_points, weights, handle)
    if (status >= 0) call surface%take(handle)
    call conclude(status, stat, errmsg)
  end subroutine

  !> Degree along an axis, a PLANISH_AXIS.
  pure integer(c_int32_t) function planish_tensor_degree(surface, axis) result(degree)
    class(planish_surface_t), intent(in) :: surface
    integer(c_int32_t), intent(in) :: axis
    degree = c_tensor_degree(surface%get(), axis)
  end function

  !> Number of knots along an axis, a PLANISH_AXIS.
  pure integer(c_size_t) function planish_tensor_knot_count(surface, axis) result(count)
    class(planish_surface_t), intent(in) :: surface
    integer(c_int32_t), intent(in) :: axis
    count = c_tensor_knot_count(surface%get(), axis)
  end function

  !> Number of control points along an axis, a PLANISH_AXIS.
  pure integer(c_size_t) function planish_tensor_control_point_count(surface, axis) result(count)
    class(planish_surface_t), intent(in) :: surface
    integer(c_int32_t), intent(in) :: axis
    count = c_tensor_control_point_count(surface%get(), axis)
  end function

  !> The knots along an axis, a PLANISH_AXIS.
  subroutine planish_tensor_copy_knots(surface, axis, knots, stat, errmsg)
    class(planish_surface_t), intent(in) :: surface
    integer(c_int32_t), intent(in) :: axis
    real(c_double), intent(inout), contiguous :: knots(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call conclude(c_tensor_copy_knots(surface%get(), axis, knots, size(knots, kind=c_size_t)), stat, errmsg)
  end subroutine

  !> control_points(dim, along v, along u).
  subroutine planish_tensor_copy_control_points(surface, control_points, stat, errmsg)
    class(planish_surface_t), intent(in) :: surface
    real(c_double), intent(inout), contiguous :: control_points(:, :, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_size_t) :: extents(3)
    extents = shape(control_points, c_size_t)
    if (refuse_grid(surface, extents(2:3), "control_points", stat, errmsg)) return
    if (refuse_dim(extents(1), surface%dim(), "control_points", stat, errmsg)) return
    call conclude(c_tensor_copy_control_points(surface%get(), control_points, extents(2) * extents(3)), stat, errmsg)
  end subroutine

  !> Whether the surface has weights.
  pure logical function planish_tensor_has_weights(surface) result(has)
    class(planish_surface_t), intent(in) :: surface
    has = c_tensor_has_weights(surface%get()) /= 0
  end function

  !> weights(along v, along u).
  subroutine planish_tensor_copy_weights(surface, weights, stat, errmsg)
    class(planish_surface_t), intent(in) :: surface
    real(c_double), intent(inout), contiguous :: weights(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (refuse_grid(surface, shape(weights, c_size_t), "weights", stat, errmsg)) return
    call conclude(c_tensor_copy_weights(surface%get(), weights, size(weights, kind=c_size_t)), stat, errmsg)
  end subroutine

  !> Refuses an array that has not one place for each control point of a tensor surface.
  logical function refuse_grid(surface, extents, name, stat, errmsg) result(refused)
    class(planish_surface_t), intent(in) :: surface
    integer(c_size_t), intent(in) :: extents(2)
    character(*), intent(in) :: name
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    refused = .false.
    if (surface%kind() /= PLANISH_KIND_TENSOR) return ! the library says so
    refused = refuse_extent(extents(1), planish_tensor_control_point_count(surface, PLANISH_AXIS_V), &
        "the extent along v of " // name, stat, errmsg)
    if (refused) return
    refused = refuse_extent(extents(2), planish_tensor_control_point_count(surface, PLANISH_AXIS_U), &
        "the extent along u of " // name, stat, errmsg)
  end function

  !> Inserts knots along an axis, a PLANISH_AXIS; the surface stays the same.
  subroutine planish_tensor_insert_knots(surface, axis, knots, stat, errmsg)
    class(planish_surface_t), intent(inout) :: surface
    integer(c_int32_t), intent(in) :: axis
    real(c_double), intent(in), contiguous :: knots(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call conclude(c_tensor_insert_knots(surface%get(), axis, knots, size(knots, kind=c_size_t)), stat, errmsg)
  end subroutine

  !> Raises the degree along an axis, a PLANISH_AXIS; the surface stays the same.
  subroutine planish_tensor_elevate_degree(surface, axis, degree, stat, errmsg)
    class(planish_surface_t), intent(inout) :: surface
    integer(c_int32_t), intent(in) :: axis
    integer, intent(in) :: degree
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call conclude(c_tensor_elevate_degree(surface%get(), axis, int(degree, c_int32_t)), stat, errmsg)
  end subroutine

  !> Turns a surface round along an axis, a PLANISH_AXIS: the same points in the other direction.
  subroutine planish_tensor_reverse(surface, axis, stat, errmsg)
    class(planish_surface_t), intent(inout) :: surface
    integer(c_int32_t), intent(in) :: axis
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call conclude(c_tensor_reverse(surface%get(), axis), stat, errmsg)
  end subroutine

  !> Makes the parts below and above a parameter along an axis, a PLANISH_AXIS.
  subroutine planish_tensor_split(surface, axis, at, lower, upper, stat, errmsg)
    class(planish_surface_t), intent(in) :: surface
    integer(c_int32_t), intent(in) :: axis
    real(c_double), intent(in) :: at
    class(planish_surface_t), intent(inout) :: lower, upper
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: below, above
    integer(c_int) :: status
    status = c_tensor_split(surface%get(), axis, at, below, above)
    if (status >= 0) then
      call lower%take(below)
      call upper%take(above)
    end if
    call conclude(status, stat, errmsg)
  end subroutine

  !> Makes the sum of tensor surfaces, each times its factor: a shape and its displacements, modes and their factors.
  !>
  !> factors: one for each surface, in place of 1.
  subroutine planish_tensor_combine(surfaces, combined, factors, stat, errmsg)
    class(planish_surface_t), intent(in) :: surfaces(:)
    class(planish_surface_t), intent(inout) :: combined
    real(c_double), intent(in), optional, contiguous :: factors(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: handle
    integer(c_size_t) :: count
    integer(c_int) :: status
    count = size(surfaces, kind=c_size_t)
    if (present(factors)) then
      if (refuse_extent(size(factors, kind=c_size_t), count, "the number of factors", stat, errmsg)) return
    end if
    status = c_tensor_combine(handles_of(surfaces), factors, count, handle)
    if (status >= 0) call combined%take(handle)
    call conclude(status, stat, errmsg)
  end subroutine

  !> Surfaces for C.
  pure function surface_handles(surfaces) result(handles)
    class(planish_surface_t), intent(in) :: surfaces(:)
    type(c_ptr) :: handles(size(surfaces))
    integer :: i
    do i = 1, size(surfaces)
      handles(i) = surfaces(i)%get()
    end do
  end function

  ! ---------------------------------------------------------------------------------------------------------
  ! Queries
  ! ---------------------------------------------------------------------------------------------------------

  !> Makes a mesh of a surface in space. report: receives how good the mesh is.
  subroutine surface_tessellate(self, mesh, options, report, stat, errmsg)
    class(planish_surface_t), intent(in) :: self
    class(planish_mesh_t), intent(inout) :: mesh
    type(planish_tessellate_options), intent(in), optional :: options
    type(planish_tessellate_report), intent(inout), optional, target :: report
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_tessellate_options) :: call_options
    type(c_ptr) :: handle
    integer(c_int) :: status
    if (present(options)) call_options = options
    if (present(report)) call_options%out_report = c_loc(report)
    status = c_surface_tessellate(self%get(), call_options, handle)
    if (status >= 0) call mesh%take(handle)
    call conclude(status, stat, errmsg)
  end subroutine

  !> Finds the place on the surface nearest to each of points(dim,n).
  !>
  !> uv:        (2,n), receives the places.
  !> distances: receives how far they are.
  !> guesses:   (2,n), places near them.
  !> flags:     receives PLANISH_FLAG_NOT_PROVEN where no search has proved that no other place is nearer.
  subroutine surface_project(self, points, uv, distances, options, guesses, flags, stat, errmsg)
    class(planish_surface_t), intent(in) :: self
    real(c_double), intent(in), contiguous :: points(:, :)
    real(c_double), intent(inout), optional, contiguous :: uv(:, :), distances(:)
    type(planish_project_options), intent(in), optional :: options
    real(c_double), intent(in), optional, target, contiguous :: guesses(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int8_t), intent(inout), optional, target, contiguous :: flags(:)
    type(planish_project_options) :: call_options
    integer(c_size_t) :: count
    count = size(points, 2, c_size_t)
    if (present(options)) call_options = options
    if (refuse_dim(size(points, 1, c_size_t), self%dim(), "points", stat, errmsg)) return
    if (present(uv)) then
      if (refuse_extent(size(uv, 1, c_size_t), 2_c_size_t, "the first extent of uv", stat, errmsg)) return
      if (refuse_short(size(uv, 2, c_size_t), count, "uv", stat, errmsg)) return
    end if
    if (present(distances)) then
      if (refuse_short(size(distances, kind=c_size_t), count, "distances", stat, errmsg)) return
    end if
    if (present(guesses)) then
      if (refuse_extent(size(guesses, 1, c_size_t), 2_c_size_t, "the first extent of guesses", stat, errmsg)) return
      if (refuse_short(size(guesses, 2, c_size_t), count, "guesses", stat, errmsg)) return
      call_options%guesses = c_loc(guesses)
    end if
    if (present(flags)) then
      if (refuse_short(size(flags, kind=c_size_t), count, "flags", stat, errmsg)) return
      call_options%out_flags = c_loc(flags)
    end if
    call conclude(c_surface_project(self%get(), points, count, call_options, uv, distances), stat, errmsg)
  end subroutine

  !> Makes a surface of less energy that stays within a tolerance of this one, or of values(dim,n) at uv(2,n).
  subroutine surface_fair(self, faired, options, uv, values, report, progress, stat, errmsg)
    class(planish_surface_t), intent(in) :: self
    class(planish_surface_t), intent(inout) :: faired
    type(planish_fair_options), intent(in), optional :: options
    real(c_double), intent(in), optional, contiguous :: uv(:, :), values(:, :)
    type(planish_fair_report), intent(inout), optional :: report
    procedure(planish_progress), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_fair_options) :: call_options
    type(listener), target :: user
    type(c_ptr) :: handle
    integer(c_size_t) :: count
    integer(c_int) :: status
    if (present(options)) call_options = options
    count = 0
    if (present(uv)) then
      count = size(uv, 2, c_size_t)
      if (refuse_extent(size(uv, 1, c_size_t), 2_c_size_t, "the first extent of uv", stat, errmsg)) return
    end if
    if (present(values)) then
      if (refuse_dim(size(values, 1, c_size_t), self%dim(), "values", stat, errmsg)) return
      if (refuse_extent(size(values, 2, c_size_t), count, "the number of values", stat, errmsg)) return
    end if
    if (present(progress)) then
      user%hear => progress
      call_options%progress = c_funloc(relay)
      call_options%user = c_loc(user)
    end if
    status = c_surface_fair(self%get(), uv, values, count, call_options, handle, report)
    if (status >= 0) call faired%take(handle)
    call conclude(status, stat, errmsg)
  end subroutine

  !> Measures how far the nodes of a mesh lie from the surface. worst_index of the report counts from 1.
  subroutine surface_deviation(self, mesh, distances, options, report, stat, errmsg)
    class(planish_surface_t), intent(in) :: self
    class(planish_mesh_t), intent(in) :: mesh
    real(c_double), intent(inout), optional, contiguous :: distances(:)
    type(planish_deviation_options), intent(in), optional :: options
    type(planish_deviation_report), intent(inout), optional :: report
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_size_t) :: room
    integer(c_int) :: status
    room = 0
    if (present(distances)) room = size(distances, kind=c_size_t)
    status = c_surface_deviation(self%get(), mesh%get(), options, distances, room, report)
    if (status >= 0 .and. present(report)) report%worst_index = report%worst_index + 1
    call conclude(status, stat, errmsg)
  end subroutine

  ! ---------------------------------------------------------------------------------------------------------
  ! Files
  ! ---------------------------------------------------------------------------------------------------------

  !> Writes a surface in space as a VTK file: its triangles, patches or control net, as the options say.
  !>
  !> deviation_from: a mesh to compare with.
  !> tessellate:     how fine the triangles are.
  subroutine surface_write_vtk(self, path, options, deviation_from, tessellate, stat, errmsg)
    class(planish_surface_t), intent(in) :: self
    character(*), intent(in) :: path
    type(planish_vtk_options), intent(in), optional :: options
    class(planish_mesh_t), intent(in), optional :: deviation_from
    type(planish_tessellate_options), intent(in), optional, target :: tessellate
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_vtk_options) :: call_options
    if (present(options)) call_options = options
    if (present(deviation_from)) call_options%deviation_from = deviation_from%get()
    if (present(tessellate)) call_options%tessellate = c_loc(tessellate)
    call conclude(c_surface_write_vtk(self%get(), terminated(path), call_options), stat, errmsg)
  end subroutine

  !> Measures the surface against a mesh and writes the result as one HTML page. The texts of the options are those of C:
  !> title and unit here are Fortran's.
  subroutine surface_write_report(self, mesh, path, options, title, unit, stat, errmsg)
    class(planish_surface_t), intent(in) :: self
    class(planish_mesh_t), intent(in) :: mesh
    character(*), intent(in) :: path
    type(planish_report_options), intent(in), optional :: options
    character(*), intent(in), optional :: title, unit
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_report_options) :: call_options
    character(kind=c_char, len=:), allocatable, target :: c_title, c_unit
    if (present(options)) call_options = options
    if (present(title)) then
      c_title = terminated(title)
      call_options%title = c_loc(c_title)
    end if
    if (present(unit)) then
      c_unit = terminated(unit)
      call_options%unit = c_loc(c_unit)
    end if
    call conclude(c_surface_write_report(self%get(), mesh%get(), terminated(path), call_options), stat, errmsg)
  end subroutine

  !> Bytes that save() makes.
  pure integer(c_size_t) function surface_save_size(self) result(size)
    class(planish_surface_t), intent(in) :: self
    size = c_surface_save_size(self%get())
  end function

  !> Everything a surface is, as bytes that are the same on all machines.
  subroutine surface_save(self, bytes, stat, errmsg)
    class(planish_surface_t), intent(in) :: self
    integer(c_int8_t), allocatable, intent(inout) :: bytes(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int8_t), allocatable :: saved(:)
    integer(c_int) :: status
    allocate (saved(self%save_size()))
    status = c_surface_save(self%get(), saved, size(saved, kind=c_size_t))
    if (status >= 0) call move_alloc(saved, bytes)
    call conclude(status, stat, errmsg)
  end subroutine

  !> Makes a surface from the bytes of save().
  subroutine surface_load(self, bytes, stat, errmsg)
    class(planish_surface_t), intent(inout) :: self
    integer(c_int8_t), intent(in), contiguous :: bytes(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: handle
    integer(c_int) :: status
    status = c_surface_load(bytes, size(bytes, kind=c_size_t), handle)
    if (status >= 0) call self%take(handle)
    call conclude(status, stat, errmsg)
  end subroutine

  !> Writes the bytes of save() to a file.
  subroutine surface_save_file(self, path, stat, errmsg)
    class(planish_surface_t), intent(in) :: self
    character(*), intent(in) :: path
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call conclude(c_surface_save_file(self%get(), terminated(path)), stat, errmsg)
  end subroutine

  !> Makes a surface from a file of save_file().
  subroutine surface_load_file(self, path, stat, errmsg)
    class(planish_surface_t), intent(inout) :: self
    character(*), intent(in) :: path
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: handle
    integer(c_int) :: status
    status = c_surface_load_file(terminated(path), handle)
    if (status >= 0) call self%take(handle)
    call conclude(status, stat, errmsg)
  end subroutine

  !> Writes a surface in space as a STEP file: one face, or of a T-spline strips, if the options say so.
  !>
  !> product, author, organization, timestamp: what the file says beside the shape.
  !> report: receives what was written.
  subroutine surface_write_step(self, path, options, product, author, organization, timestamp, report, stat, errmsg)
    class(planish_surface_t), intent(in) :: self
    character(*), intent(in) :: path
    type(planish_step_options), intent(in), optional :: options
    character(*), intent(in), optional :: product, author, organization, timestamp
    type(planish_step_report), intent(inout), optional, target :: report
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_step_options) :: call_options
    character(kind=c_char), allocatable, target :: made(:), by(:), of(:), at(:)
    if (present(options)) call_options = options
    call borrow(product, made, call_options%product)
    call borrow(author, by, call_options%author)
    call borrow(organization, of, call_options%organization)
    call borrow(timestamp, at, call_options%timestamp)
    if (present(report)) call_options%out_report = c_loc(report)
    call conclude(c_surface_write_step(self%get(), terminated(path), call_options), stat, errmsg)
  end subroutine

  ! ---------------------------------------------------------------------------------------------------------
  ! Model
  ! ---------------------------------------------------------------------------------------------------------

  impure elemental subroutine model_assign(self, other)
    class(planish_model_t), intent(inout) :: self
    class(planish_model_t), intent(in) :: other
    type(c_ptr) :: handle
    handle = c_null_ptr
    if (allocated(other%owner)) call conclude(c_model_clone(other%owner%handle, handle))
    call self%take(handle)
  end subroutine

  subroutine finalize_model(self)
    type(model_owner), intent(inout) :: self
    call c_model_free(self%handle)
    self%handle = c_null_ptr
  end subroutine

  !> Frees the model before the variable ends.
  subroutine model_free(self)
    class(planish_model_t), intent(inout) :: self
    if (allocated(self%owner)) deallocate (self%owner)
  end subroutine

  !> The handle, for C; it stays this model's.
  pure type(c_ptr) function model_get(self) result(handle)
    class(planish_model_t), intent(in) :: self
    handle = c_null_ptr
    if (allocated(self%owner)) handle = self%owner%handle
  end function

  !> Takes over a handle of C, which is freed by this model from now on.
  subroutine model_take(self, handle)
    class(planish_model_t), intent(inout) :: self
    type(c_ptr), intent(in) :: handle
    call self%free()
    if (.not. c_associated(handle)) return
    allocate (self%owner)
    self%owner%handle = handle
  end subroutine

  !> Makes a model of the part of a surface inside its trims.
  subroutine model_from_surface(self, surface, stat, errmsg)
    class(planish_model_t), intent(inout) :: self
    class(planish_surface_t), intent(in) :: surface
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: handle
    integer(c_int) :: status
    status = c_model_from_surface(surface%get(), handle)
    if (status >= 0) call self%take(handle)
    call conclude(status, stat, errmsg)
  end subroutine

  !> Number of faces.
  integer(c_size_t) function model_face_count(self)
    class(planish_model_t), intent(in) :: self
    model_face_count = c_model_face_count(self%get())
  end function

  !> Number of edges.
  integer(c_size_t) function model_edge_count(self)
    class(planish_model_t), intent(in) :: self
    model_edge_count = c_model_edge_count(self%get())
  end function

  !> Number of vertices.
  integer(c_size_t) function model_vertex_count(self)
    class(planish_model_t), intent(in) :: self
    model_vertex_count = c_model_vertex_count(self%get())
  end function

  !> Number of shells.
  integer(c_size_t) function model_shell_count(self)
    class(planish_model_t), intent(in) :: self
    model_shell_count = c_model_shell_count(self%get())
  end function

  !> Number of loops of a face.
  integer(c_size_t) function model_loop_count(self, face)
    class(planish_model_t), intent(in) :: self
    integer, intent(in) :: face
    model_loop_count = 0
    if (face > 0) model_loop_count = c_model_loop_count(self%get(), face - 1_c_size_t)
  end function

  !> Number of edges of all loops of a face.
  integer(c_size_t) function model_coedge_count(self, face)
    class(planish_model_t), intent(in) :: self
    integer, intent(in) :: face
    model_coedge_count = 0
    if (face > 0) model_coedge_count = c_model_coedge_count(self%get(), face - 1_c_size_t)
  end function

  !> What a face is; its shell counts from 1.
  subroutine model_face_info(self, face, info, stat, errmsg)
    class(planish_model_t), intent(in) :: self
    integer, intent(in) :: face
    type(planish_face_info), intent(inout) :: info
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int) :: status
    if (refuse(face < 1, PLANISH_STATUS_INDEX, "faces count from 1", stat, errmsg)) return
    status = c_model_face_info(self%get(), face - 1_c_size_t, info)
    if (status >= 0) info%shell = info%shell + 1
    call conclude(status, stat, errmsg)
  end subroutine

  !> Makes a surface of a face, with the loops of the face as trims.
  subroutine model_copy_face(self, face, surface, stat, errmsg)
    class(planish_model_t), intent(in) :: self
    integer, intent(in) :: face
    class(planish_surface_t), intent(inout) :: surface
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: handle
    integer(c_int) :: status
    if (refuse(face < 1, PLANISH_STATUS_INDEX, "faces count from 1", stat, errmsg)) return
    status = c_model_copy_face(self%get(), face - 1_c_size_t, handle)
    if (status >= 0) call surface%take(handle)
    call conclude(status, stat, errmsg)
  end subroutine

  !> Makes a curve of an edge and says what the edge is; faces and vertices of info count from 1, 0 stands for none.
  subroutine model_copy_edge(self, edge, curve, info, stat, errmsg)
    class(planish_model_t), intent(in) :: self
    integer, intent(in) :: edge
    class(planish_curve_t), intent(inout) :: curve
    type(planish_edge_info), intent(inout), optional :: info
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: handle
    integer(c_int) :: status
    if (refuse(edge < 1, PLANISH_STATUS_INDEX, "edges count from 1", stat, errmsg)) return
    status = c_model_copy_edge(self%get(), edge - 1_c_size_t, handle, info)
    if (status >= 0) then
      call curve%take(handle)
      if (present(info)) then
        info%face_along = info%face_along + 1
        info%face_against = info%face_against + 1
        info%vertex_start = info%vertex_start + 1
        info%vertex_end = info%vertex_end + 1
      end if
    end if
    call conclude(status, stat, errmsg)
  end subroutine

  !> The loops of a face: how many edges each has, then their edges in order and whether the loop runs along them.
  subroutine model_copy_loops(self, face, sizes, edges, is_forward, stat, errmsg)
    class(planish_model_t), intent(in) :: self
    integer, intent(in) :: face
    integer, allocatable, intent(inout) :: sizes(:), edges(:)
    logical, allocatable, intent(inout) :: is_forward(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_size_t), allocatable :: counts(:)
    integer(c_int32_t), allocatable :: numbers(:)
    integer(c_int8_t), allocatable :: senses(:)
    integer(c_int) :: status
    if (refuse(face < 1, PLANISH_STATUS_INDEX, "faces count from 1", stat, errmsg)) return
    allocate (counts(self%loop_count(face)))
    allocate (numbers(self%coedge_count(face)), senses(self%coedge_count(face)))
    status = c_model_copy_loops(self%get(), face - 1_c_size_t, counts, size(counts, kind=c_size_t), numbers, senses, &
        size(numbers, kind=c_size_t))
    if (status >= 0) then
      sizes = int(counts)
      edges = numbers + 1
      is_forward = senses /= 0
    end if
    call conclude(status, stat, errmsg)
  end subroutine

  !> Makes a curve of where an edge lies in the parameter plane of a face's surface.
  subroutine model_copy_pcurve(self, face, coedge, curve, stat, errmsg)
    class(planish_model_t), intent(in) :: self
    integer, intent(in) :: face, coedge
    class(planish_curve_t), intent(inout) :: curve
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: handle
    integer(c_int) :: status
    if (refuse(face < 1 .or. coedge < 1, PLANISH_STATUS_INDEX, "faces and their edges count from 1", stat, errmsg)) return
    status = c_model_copy_pcurve(self%get(), face - 1_c_size_t, coedge - 1_c_size_t, handle)
    if (status >= 0) call curve%take(handle)
    call conclude(status, stat, errmsg)
  end subroutine

  !> The places of the vertices: points(3,n).
  subroutine model_copy_vertices(self, points, stat, errmsg)
    class(planish_model_t), intent(in) :: self
    real(c_double), intent(inout), contiguous :: points(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (refuse_extent(size(points, 1, c_size_t), 3_c_size_t, "the first extent of points", stat, errmsg)) return
    call conclude(c_model_copy_vertices(self%get(), points, size(points, 2, c_size_t)), stat, errmsg)
  end subroutine

  !> Numbers of a place: 3, or those of a value for a field over the faces of a model.
  integer(c_size_t) function model_dim(self)
    class(planish_model_t), intent(in) :: self
    model_dim = c_model_dim(self%get())
  end function

  !> gradients(:,k,i): the gradient in space of component k of a field over the faces of this model, at uv(:,i) on
  !> faces(i).
  subroutine model_field_gradient(self, field, faces, uv, gradients, stat, errmsg)
    class(planish_model_t), intent(in) :: self
    class(planish_model_t), intent(in) :: field
    integer, intent(in) :: faces(:)
    real(c_double), intent(in), contiguous :: uv(:, :)
    real(c_double), intent(inout), contiguous :: gradients(:, :, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_gradient_options) :: options
    if (refuse_model_points(faces, uv, size(gradients, 3, c_size_t), stat, errmsg)) return
    if (refuse_extent(size(gradients, 1, c_size_t), 3_c_size_t, "the first extent of gradients", stat, errmsg)) return
    if (field%dim() > 0) then ! of no field the library says so
      if (refuse_extent(size(gradients, 2, c_size_t), field%dim(), "the second extent of gradients", &
          stat, errmsg)) return
    end if
    call conclude(c_model_field_gradient(self%get(), field%get(), int(faces, c_int32_t) - 1_c_int32_t, uv, &
        size(uv, 2, c_size_t), options, gradients), stat, errmsg)
  end subroutine

  !> Number of nodes of the mesh that the model was fitted to.
  integer(c_size_t) function model_node_count(self)
    class(planish_model_t), intent(in) :: self
    model_node_count = c_model_node_count(self%get())
  end function

  !> Where each node of the mesh lies that the model was fitted to: faces(n), 0 for a node without triangles, and
  !> uv(2,n), n being node_count().
  subroutine model_locate_nodes(self, faces, uv, stat, errmsg)
    class(planish_model_t), intent(in) :: self
    integer, intent(inout) :: faces(:)
    real(c_double), intent(inout), contiguous :: uv(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int32_t), allocatable :: found(:)
    integer(c_size_t) :: count
    integer(c_int) :: status
    count = self%node_count()
    if (refuse_extent(size(uv, 1, c_size_t), 2_c_size_t, "the first extent of uv", stat, errmsg)) return
    if (refuse_short(size(uv, 2, c_size_t), count, "uv", stat, errmsg)) return
    if (refuse_short(size(faces, kind=c_size_t), count, "faces", stat, errmsg)) return
    allocate (found(count))
    status = c_model_locate_nodes(self%get(), found, uv, count)
    if (status >= 0) faces(:count) = found + 1
    call conclude(status, stat, errmsg)
  end subroutine

  !> What a shell is, and its faces; info%void_in counts from 1, 0 stands for none.
  subroutine model_copy_shell(self, shell, info, faces, stat, errmsg)
    class(planish_model_t), intent(in) :: self
    integer, intent(in) :: shell
    type(planish_shell_info), intent(inout) :: info
    integer, allocatable, intent(inout) :: faces(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int32_t), allocatable :: numbers(:)
    integer(c_int) :: status
    if (refuse(shell < 1, PLANISH_STATUS_INDEX, "shells count from 1", stat, errmsg)) return
    allocate (numbers(self%face_count()))
    status = c_model_copy_shell(self%get(), shell - 1_c_size_t, info, numbers, size(numbers, kind=c_size_t))
    if (status >= 0) then
      info%void_in = info%void_in + 1
      faces = numbers(:info%face_count) + 1
    end if
    call conclude(status, stat, errmsg)
  end subroutine

  !> Values and derivatives up to max_derivative (0 to 2) at uv(2,n) on faces(n): out(3,m,n) with m = 1, 3 or 6.
  subroutine model_eval(self, faces, uv, max_derivative, out, options, stat, errmsg)
    class(planish_model_t), intent(in) :: self
    integer, intent(in) :: faces(:), max_derivative
    real(c_double), intent(in), contiguous :: uv(:, :)
    real(c_double), intent(inout), contiguous :: out(:, :, :)
    type(planish_eval_options), intent(in), optional :: options
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_size_t) :: row_count
    if (refuse_model_points(faces, uv, size(out, 3, c_size_t), stat, errmsg)) return
    row_count = (max_derivative + 1) * (max_derivative + 2) / 2
    if (refuse_extent(size(out, 1, c_size_t), 3_c_size_t, "the first extent of out", stat, errmsg)) return
    if (refuse_extent(size(out, 2, c_size_t), row_count, "the second extent of out", stat, errmsg)) return
    call conclude(c_model_eval(self%get(), int(faces, c_int32_t) - 1_c_int32_t, uv, size(uv, 2, c_size_t), &
        int(max_derivative, c_int32_t), options, out), stat, errmsg)
  end subroutine

  !> Unit normals(3,n) at uv(2,n) on faces(n), out of the fronts of the faces.
  subroutine model_normals(self, faces, uv, normals, options, stat, errmsg)
    class(planish_model_t), intent(in) :: self
    integer, intent(in) :: faces(:)
    real(c_double), intent(in), contiguous :: uv(:, :)
    real(c_double), intent(inout), contiguous :: normals(:, :)
    type(planish_eval_options), intent(in), optional :: options
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (refuse_model_points(faces, uv, size(normals, 2, c_size_t), stat, errmsg)) return
    if (refuse_extent(size(normals, 1, c_size_t), 3_c_size_t, "the first extent of normals", stat, errmsg)) return
    call conclude(c_model_normals(self%get(), int(faces, c_int32_t) - 1_c_int32_t, uv, size(uv, 2, c_size_t), options, &
        normals), stat, errmsg)
  end subroutine

  !> Principal curvatures and directions, out(8,n): k1, k2, d1(3), d2(3) at uv(2,n) on faces(n).
  subroutine model_curvatures(self, faces, uv, out, options, stat, errmsg)
    class(planish_model_t), intent(in) :: self
    integer, intent(in) :: faces(:)
    real(c_double), intent(in), contiguous :: uv(:, :)
    real(c_double), intent(inout), contiguous :: out(:, :)
    type(planish_eval_options), intent(in), optional :: options
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (refuse_model_points(faces, uv, size(out, 2, c_size_t), stat, errmsg)) return
    if (refuse_extent(size(out, 1, c_size_t), 8_c_size_t, "the first extent of out", stat, errmsg)) return
    call conclude(c_model_curvatures(self%get(), int(faces, c_int32_t) - 1_c_int32_t, uv, size(uv, 2, c_size_t), &
        options, out), stat, errmsg)
  end subroutine

  ! Whether faces(n), uv(2,n) and results for n points do not fit together.
  logical function refuse_model_points(faces, uv, result_count, stat, errmsg) result(refused)
    integer, intent(in) :: faces(:)
    real(c_double), intent(in) :: uv(:, :)
    integer(c_size_t), intent(in) :: result_count
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    refused = refuse_extent(size(uv, 1, c_size_t), 2_c_size_t, "the first extent of uv", stat, errmsg)
    if (.not. refused) refused = refuse_extent(size(faces, kind=c_size_t), size(uv, 2, c_size_t), &
        "the number of faces", stat, errmsg)
    if (.not. refused) refused = refuse_extent(result_count, size(uv, 2, c_size_t), "the number of results", stat, errmsg)
    if (.not. refused) refused = refuse(any(faces < 1), PLANISH_STATUS_INDEX, "faces count from 1", stat, errmsg)
  end function

  !> Finds the place on the model nearest to each of points(3,n).
  !>
  !> faces:     receives the faces, 0 for points farther away than options%max_distance.
  !> uv:        (2,n), receives the places.
  !> distances: receives how far they are.
  subroutine model_project(self, points, faces, uv, distances, options, stat, errmsg)
    class(planish_model_t), intent(in) :: self
    real(c_double), intent(in), contiguous :: points(:, :)
    integer, intent(inout) :: faces(:)
    real(c_double), intent(inout), contiguous :: uv(:, :), distances(:)
    type(planish_project_options), intent(in), optional :: options
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int32_t), allocatable :: found(:)
    integer(c_size_t) :: count
    integer(c_int) :: status
    count = size(points, 2, c_size_t)
    if (refuse_extent(size(points, 1, c_size_t), 3_c_size_t, "the first extent of points", stat, errmsg)) return
    if (refuse_extent(size(uv, 1, c_size_t), 2_c_size_t, "the first extent of uv", stat, errmsg)) return
    if (refuse_short(size(uv, 2, c_size_t), count, "uv", stat, errmsg)) return
    if (refuse_short(size(distances, kind=c_size_t), count, "distances", stat, errmsg)) return
    if (refuse_short(size(faces, kind=c_size_t), count, "faces", stat, errmsg)) return
    allocate (found(count))
    status = c_model_project(self%get(), points, count, options, found, uv, distances)
    if (status >= 0) faces(:count) = found + 1
    call conclude(status, stat, errmsg)
  end subroutine

  !> Measures how far the nodes of a mesh lie from the model. worst_index of the report counts from 1.
  subroutine model_deviation(self, mesh, distances, options, report, stat, errmsg)
    class(planish_model_t), intent(in) :: self
    class(planish_mesh_t), intent(in) :: mesh
    real(c_double), intent(inout), optional, contiguous :: distances(:)
    type(planish_deviation_options), intent(in), optional :: options
    type(planish_deviation_report), intent(inout), optional :: report
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_size_t) :: room
    integer(c_int) :: status
    room = 0
    if (present(distances)) room = size(distances, kind=c_size_t)
    status = c_model_deviation(self%get(), mesh%get(), options, distances, room, report)
    if (status >= 0 .and. present(report)) report%worst_index = report%worst_index + 1
    call conclude(status, stat, errmsg)
  end subroutine

  !> Makes a watertight triangle mesh of the model.
  subroutine model_tessellate(self, mesh, options, report, stat, errmsg)
    class(planish_model_t), intent(in) :: self
    class(planish_mesh_t), intent(inout) :: mesh
    type(planish_tessellate_options), intent(in), optional :: options
    type(planish_tessellate_report), intent(inout), optional, target :: report
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_tessellate_options) :: call_options
    type(c_ptr) :: handle
    integer(c_int) :: status
    if (present(options)) call_options = options
    if (present(report)) call_options%out_report = c_loc(report)
    status = c_model_tessellate(self%get(), call_options, handle)
    if (status >= 0) call mesh%take(handle)
    call conclude(status, stat, errmsg)
  end subroutine

  !> Writes the triangles of the model as a VTK file.
  !>
  !> deviation_from: a mesh to compare with.
  !> tessellate:     how fine the triangles are.
  subroutine model_write_vtk(self, path, options, deviation_from, tessellate, stat, errmsg)
    class(planish_model_t), intent(in) :: self
    character(*), intent(in) :: path
    type(planish_vtk_options), intent(in), optional :: options
    class(planish_mesh_t), intent(in), optional :: deviation_from
    type(planish_tessellate_options), intent(in), optional, target :: tessellate
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_vtk_options) :: call_options
    if (present(options)) call_options = options
    if (present(deviation_from)) call_options%deviation_from = deviation_from%get()
    if (present(tessellate)) call_options%tessellate = c_loc(tessellate)
    call conclude(c_model_write_vtk(self%get(), terminated(path), call_options), stat, errmsg)
  end subroutine

  !> Measures the model against a mesh and writes the result as one HTML page, as a surface's.
  subroutine model_write_report(self, mesh, path, options, title, unit, stat, errmsg)
    class(planish_model_t), intent(in) :: self
    class(planish_mesh_t), intent(in) :: mesh
    character(*), intent(in) :: path
    type(planish_report_options), intent(in), optional :: options
    character(*), intent(in), optional :: title, unit
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_report_options) :: call_options
    character(kind=c_char, len=:), allocatable, target :: c_title, c_unit
    if (present(options)) call_options = options
    if (present(title)) then
      c_title = terminated(title)
      call_options%title = c_loc(c_title)
    end if
    if (present(unit)) then
      c_unit = terminated(unit)
      call_options%unit = c_loc(c_unit)
    end if
    call conclude(c_model_write_report(self%get(), mesh%get(), terminated(path), call_options), stat, errmsg)
  end subroutine

  !> Box, area, volume, and how well the faces meet.
  subroutine model_measure(self, report, stat, errmsg)
    class(planish_model_t), intent(in) :: self
    type(planish_measure_report), intent(inout) :: report
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call conclude(c_model_measure(self%get(), report), stat, errmsg)
  end subroutine

  !> Writes a STEP file.
  subroutine model_write_step(self, path, options, product, author, organization, timestamp, report, stat, errmsg)
    class(planish_model_t), intent(in) :: self
    character(*), intent(in) :: path
    type(planish_step_options), intent(in), optional :: options
    character(*), intent(in), optional :: product, author, organization, timestamp
    type(planish_step_report), intent(inout), optional, target :: report
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_step_options) :: call_options
    character(kind=c_char), allocatable, target :: made(:), by(:), of(:), at(:)
    if (present(options)) call_options = options
    call borrow(product, made, call_options%product)
    call borrow(author, by, call_options%author)
    call borrow(organization, of, call_options%organization)
    call borrow(timestamp, at, call_options%timestamp)
    if (present(report)) call_options%out_report = c_loc(report)
    call conclude(c_model_write_step(self%get(), terminated(path), call_options), stat, errmsg)
  end subroutine

  !> The content of that file.
  subroutine model_write_step_memory(self, bytes, options, stat, errmsg)
    class(planish_model_t), intent(in) :: self
    integer(c_int8_t), allocatable, intent(inout) :: bytes(:)
    type(planish_step_options), intent(in), optional :: options
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_step_options) :: call_options
    integer(c_int8_t), allocatable :: written(:)
    integer(c_size_t) :: needed
    integer(c_int) :: status
    if (present(options)) call_options = options
    needed = 0
    status = c_model_write_step_memory(self%get(), call_options, size=0_c_size_t, out_size=needed)
    if (status >= 0) then
      allocate (written(needed))
      status = c_model_write_step_memory(self%get(), call_options, written, needed, needed)
      if (status >= 0) call move_alloc(written, bytes)
    end if
    call conclude(status, stat, errmsg)
  end subroutine

  !> How many bytes save() makes.
  integer(c_size_t) function model_save_size(self)
    class(planish_model_t), intent(in) :: self
    model_save_size = c_model_save_size(self%get())
  end function

  !> Everything the model is.
  subroutine model_save(self, bytes, stat, errmsg)
    class(planish_model_t), intent(in) :: self
    integer(c_int8_t), allocatable, intent(inout) :: bytes(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int8_t), allocatable :: saved(:)
    integer(c_int) :: status
    allocate (saved(self%save_size()))
    status = c_model_save(self%get(), saved, size(saved, kind=c_size_t))
    if (status >= 0) call move_alloc(saved, bytes)
    call conclude(status, stat, errmsg)
  end subroutine

  !> Makes a model from the bytes of save().
  subroutine model_load(self, bytes, stat, errmsg)
    class(planish_model_t), intent(inout) :: self
    integer(c_int8_t), intent(in), contiguous :: bytes(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: handle
    integer(c_int) :: status
    status = c_model_load(bytes, size(bytes, kind=c_size_t), handle)
    if (status >= 0) call self%take(handle)
    call conclude(status, stat, errmsg)
  end subroutine

  !> Writes the bytes of save() to a file.
  subroutine model_save_file(self, path, stat, errmsg)
    class(planish_model_t), intent(in) :: self
    character(*), intent(in) :: path
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call conclude(c_model_save_file(self%get(), terminated(path)), stat, errmsg)
  end subroutine

  !> Makes a model from a file of save_file().
  subroutine model_load_file(self, path, stat, errmsg)
    class(planish_model_t), intent(inout) :: self
    character(*), intent(in) :: path
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: handle
    integer(c_int) :: status
    status = c_model_load_file(terminated(path), handle)
    if (status >= 0) call self%take(handle)
    call conclude(status, stat, errmsg)
  end subroutine

  ! ---------------------------------------------------------------------------------------------------------
  ! Curve
  ! ---------------------------------------------------------------------------------------------------------

  impure elemental subroutine curve_assign(self, other)
    class(planish_curve_t), intent(inout) :: self
    class(planish_curve_t), intent(in) :: other
    type(c_ptr) :: handle
    handle = c_null_ptr
    if (allocated(other%owner)) call conclude(c_curve_clone(other%owner%handle, handle))
    call self%take(handle)
  end subroutine

  subroutine finalize_curve(self)
    type(curve_owner), intent(inout) :: self
    call c_curve_free(self%handle)
    self%handle = c_null_ptr
  end subroutine

  !> Frees the curve before the variable ends.
  subroutine curve_free(self)
    class(planish_curve_t), intent(inout) :: self
    if (allocated(self%owner)) deallocate (self%owner)
  end subroutine

  !> The handle, for C; it stays this curve's.
  pure type(c_ptr) function curve_get(self) result(handle)
    class(planish_curve_t), intent(in) :: self
    handle = c_null_ptr
    if (allocated(self%owner)) handle = self%owner%handle
  end function

  !> Takes over a handle of C, which is freed by this curve from now on.
  subroutine curve_take(self, handle)
    class(planish_curve_t), intent(inout) :: self
    type(c_ptr), intent(in) :: handle
    call self%free()
    if (.not. c_associated(handle)) return
    allocate (self%owner)
    self%owner%handle = handle
  end subroutine

  !> Makes a curve from its parts: knots and control_points(dim,n).
  subroutine curve_new(self, degree, knots, control_points, stat, errmsg)
    class(planish_curve_t), intent(inout) :: self
    integer, intent(in) :: degree
    real(c_double), intent(in), contiguous :: knots(:), control_points(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: handle
    integer(c_int) :: status
    if (refuse_extent(size(control_points, 2, c_size_t), size(knots, kind=c_size_t) - degree - 1, &
        "the number of control points", stat, errmsg)) return
    status = c_curve_new(size(control_points, 1, c_size_t), int(degree, c_int32_t), knots, &
        size(knots, kind=c_size_t), control_points, handle)
    if (status >= 0) call self%take(handle)
    call conclude(status, stat, errmsg)
  end subroutine

  !> Fits a curve to values(dim,n) at u(n); the optional arguments are those of planish_tensor_fit().
  subroutine curve_fit_rows(self, u, values, options, report, weights, errors, progress, stat, errmsg)
    class(planish_curve_t), intent(inout) :: self
    real(c_double), intent(in), contiguous :: u(:), values(:, :)
    type(planish_curve_options), intent(in), optional :: options
    type(planish_fit_report), intent(inout), optional :: report
    real(c_double), intent(in), optional, target, contiguous :: weights(:)
    real(c_double), intent(inout), optional, target, contiguous :: errors(:)
    procedure(planish_progress), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_curve_options) :: call_options
    type(planish_tensor_options) :: data
    type(planish_parameterize_options), target :: map
    type(listener), target :: user
    type(c_ptr) :: handle
    integer(c_int) :: status
    integer(c_size_t) :: count
    count = size(u, kind=c_size_t)
    if (present(options)) call_options = options
    if (refuse_extent(size(values, 2, c_size_t), count, "the number of values", stat, errmsg)) return
    if (refuse_data(data, map, user, count, weights=weights, errors=errors, progress=progress, &
        stat=stat, errmsg=errmsg)) return
    call_options%weights = data%weights
    call_options%out_errors = data%out_errors
    call_options%progress = data%progress
    call_options%user = data%user
    status = c_curve_fit(u, values, count, size(values, 1, c_size_t), call_options, handle, report)
    if (status >= 0) call self%take(handle)
    call conclude_fit(status, report, stat, errmsg)
  end subroutine

  !> The same for numbers, values(n).
  subroutine curve_fit_scalars(self, u, values, options, report, weights, errors, progress, stat, errmsg)
    class(planish_curve_t), intent(inout) :: self
    real(c_double), intent(in), contiguous :: u(:)
    real(c_double), intent(in), contiguous, target :: values(:)
    type(planish_curve_options), intent(in), optional :: options
    type(planish_fit_report), intent(inout), optional :: report
    real(c_double), intent(in), optional, target, contiguous :: weights(:)
    real(c_double), intent(inout), optional, target, contiguous :: errors(:)
    procedure(planish_progress), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    real(c_double), pointer, contiguous :: rows(:, :)
    rows(1:1, 1:size(values)) => values
    call self%fit(u, rows, options, report, weights, errors, progress, stat, errmsg)
  end subroutine

  !> Makes the cubic curve through values(dim,n) at u(n), which rises.
  !>
  !> end_slopes: (dim,2), for PLANISH_SECTION_ENDS_SLOPES the derivatives at the first and the last point.
  subroutine curve_interpolate_rows(self, u, values, options, end_slopes, stat, errmsg)
    class(planish_curve_t), intent(inout) :: self
    real(c_double), intent(in), contiguous :: u(:), values(:, :)
    type(planish_interpolate_options), intent(in), optional :: options
    real(c_double), intent(in), optional, target, contiguous :: end_slopes(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_interpolate_options) :: call_options
    type(c_ptr) :: handle
    integer(c_size_t) :: count, dim
    integer(c_int) :: status
    count = size(u, kind=c_size_t)
    dim = size(values, 1, c_size_t)
    if (present(options)) call_options = options
    if (refuse_extent(size(values, 2, c_size_t), count, "the number of values", stat, errmsg)) return
    if (present(end_slopes)) then
      if (refuse_extent(size(end_slopes, 1, c_size_t), dim, "the first extent of end_slopes", stat, errmsg)) return
      if (refuse_extent(size(end_slopes, 2, c_size_t), 2_c_size_t, "the number of end_slopes", stat, errmsg)) return
      call_options%end_slopes = c_loc(end_slopes)
    end if
    status = c_curve_interpolate(u, values, count, dim, call_options, handle)
    if (status >= 0) call self%take(handle)
    call conclude(status, stat, errmsg)
  end subroutine

  !> The same for numbers, values(n) and end_slopes(2).
  subroutine curve_interpolate_scalars(self, u, values, options, end_slopes, stat, errmsg)
    class(planish_curve_t), intent(inout) :: self
    real(c_double), intent(in), contiguous :: u(:)
    real(c_double), intent(in), contiguous, target :: values(:)
    type(planish_interpolate_options), intent(in), optional :: options
    real(c_double), intent(in), optional, target, contiguous :: end_slopes(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    real(c_double), pointer, contiguous :: rows(:, :), slopes(:, :)
    rows(1:1, 1:size(values)) => values
    if (present(end_slopes)) then
      slopes(1:1, 1:size(end_slopes)) => end_slopes
      call self%interpolate(u, rows, options, slopes, stat, errmsg)
    else
      call self%interpolate(u, rows, options, stat=stat, errmsg=errmsg)
    end if
  end subroutine

  !> Length of the curve, but for 1e-12 of it and the roundoff of its coordinates.
  pure real(c_double) function curve_length(self) result(length)
    class(planish_curve_t), intent(in) :: self
    length = c_curve_length(self%get())
  end function

  !> Lengths from the start of the curve to u(n).
  subroutine curve_arc_lengths(self, u, lengths, stat, errmsg)
    class(planish_curve_t), intent(in) :: self
    real(c_double), intent(in), contiguous :: u(:)
    real(c_double), intent(inout), contiguous :: lengths(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_size_t) :: count
    count = size(u, kind=c_size_t)
    if (refuse_short(size(lengths, kind=c_size_t), count, "lengths", stat, errmsg)) return
    call conclude(c_curve_arc_lengths(self%get(), u, count, lengths), stat, errmsg)
  end subroutine

  !> Finds the places u(n) on the curve nearest to points(dim,n), and the distances.
  subroutine curve_project(self, points, u, distances, options, guesses, stat, errmsg)
    class(planish_curve_t), intent(in) :: self
    real(c_double), intent(in), contiguous :: points(:, :)
    real(c_double), intent(inout), optional, contiguous :: u(:), distances(:)
    type(planish_project_options), intent(in), optional :: options
    real(c_double), intent(in), optional, target, contiguous :: guesses(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_project_options) :: call_options
    integer(c_size_t) :: count
    count = size(points, 2, c_size_t)
    if (present(options)) call_options = options
    if (refuse_dim(size(points, 1, c_size_t), self%dim(), "points", stat, errmsg)) return
    if (present(u)) then
      if (refuse_short(size(u, kind=c_size_t), count, "u", stat, errmsg)) return
    end if
    if (present(distances)) then
      if (refuse_short(size(distances, kind=c_size_t), count, "distances", stat, errmsg)) return
    end if
    if (present(guesses)) then
      if (refuse_short(size(guesses, kind=c_size_t), count, "guesses", stat, errmsg)) return
      call_options%guesses = c_loc(guesses)
    end if
    call conclude(c_curve_project(self%get(), points, count, call_options, u, distances), stat, errmsg)
  end subroutine

  !> Bytes that save() makes.
  pure integer(c_size_t) function curve_save_size(self) result(size)
    class(planish_curve_t), intent(in) :: self
    size = c_curve_save_size(self%get())
  end function

  !> Everything the curve is, as bytes that are the same on all machines.
  subroutine curve_save(self, bytes, stat, errmsg)
    class(planish_curve_t), intent(in) :: self
    integer(c_int8_t), allocatable, intent(inout) :: bytes(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int8_t), allocatable :: saved(:)
    integer(c_int) :: status
    allocate (saved(self%save_size()))
    status = c_curve_save(self%get(), saved, size(saved, kind=c_size_t))
    if (status >= 0) call move_alloc(saved, bytes)
    call conclude(status, stat, errmsg)
  end subroutine

  !> Makes a curve from the bytes of save().
  subroutine curve_load(self, bytes, stat, errmsg)
    class(planish_curve_t), intent(inout) :: self
    integer(c_int8_t), intent(in), contiguous :: bytes(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: handle
    integer(c_int) :: status
    status = c_curve_load(bytes, size(bytes, kind=c_size_t), handle)
    if (status >= 0) call self%take(handle)
    call conclude(status, stat, errmsg)
  end subroutine

  !> Writes the bytes of save() to a file.
  subroutine curve_save_file(self, path, stat, errmsg)
    class(planish_curve_t), intent(in) :: self
    character(*), intent(in) :: path
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call conclude(c_curve_save_file(self%get(), terminated(path)), stat, errmsg)
  end subroutine

  !> Makes a curve from a file of save_file().
  subroutine curve_load_file(self, path, stat, errmsg)
    class(planish_curve_t), intent(inout) :: self
    character(*), intent(in) :: path
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: handle
    integer(c_int) :: status
    status = c_curve_load_file(terminated(path), handle)
    if (status >= 0) call self%take(handle)
    call conclude(status, stat, errmsg)
  end subroutine

  !> Numbers of a value.
  pure integer(c_size_t) function curve_dim(self) result(dim)
    class(planish_curve_t), intent(in) :: self
    dim = c_curve_dim(self%get())
  end function

  !> Degree of the polynomial pieces.
  pure integer(c_int32_t) function curve_degree(self) result(degree)
    class(planish_curve_t), intent(in) :: self
    degree = c_curve_degree(self%get())
  end function

  !> Number of knots, each as often as it occurs.
  pure integer(c_size_t) function curve_knot_count(self) result(count)
    class(planish_curve_t), intent(in) :: self
    count = c_curve_knot_count(self%get())
  end function

  !> Number of control points.
  pure integer(c_size_t) function curve_control_point_count(self) result(count)
    class(planish_curve_t), intent(in) :: self
    count = c_curve_control_point_count(self%get())
  end function

  !> The knots: at least knot_count() of them.
  subroutine curve_copy_knots(self, knots, stat, errmsg)
    class(planish_curve_t), intent(in) :: self
    real(c_double), intent(inout), contiguous :: knots(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call conclude(c_curve_copy_knots(self%get(), knots, size(knots, kind=c_size_t)), stat, errmsg)
  end subroutine

  !> control_points(dim,n): n at least control_point_count().
  subroutine curve_copy_control_points(self, control_points, stat, errmsg)
    class(planish_curve_t), intent(in) :: self
    real(c_double), intent(inout), contiguous :: control_points(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (refuse_dim(size(control_points, 1, c_size_t), self%dim(), "control_points", stat, errmsg)) return
    call conclude(c_curve_copy_control_points(self%get(), control_points, size(control_points, 2, c_size_t)), &
        stat, errmsg)
  end subroutine

  !> The interval of definition: least u, largest u.
  subroutine curve_domain(self, interval, stat, errmsg)
    class(planish_curve_t), intent(in) :: self
    real(c_double), intent(inout) :: interval(2)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call conclude(c_curve_domain(self%get(), interval), stat, errmsg)
  end subroutine

  !> values(:,i) = C(u(i)). flags: receives bits of PLANISH_FLAG for each point.
  subroutine curve_eval_rows(self, u, values, options, flags, stat, errmsg)
    class(planish_curve_t), intent(in) :: self
    real(c_double), intent(in), contiguous :: u(:)
    real(c_double), intent(inout), contiguous :: values(:, :)
    type(planish_eval_options), intent(in), optional :: options
    integer(c_int8_t), intent(inout), optional, target, contiguous :: flags(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_eval_options) :: call_options
    integer(c_size_t) :: count
    count = size(u, kind=c_size_t)
    if (present(options)) call_options = options
    if (refuse_points(call_options, [1_c_size_t, count], shape(values, c_size_t), flags, stat, errmsg)) return
    call conclude(c_curve_eval(self%get(), u, count, 0_c_int32_t, call_options, values), stat, errmsg)
  end subroutine

  !> The same for numbers, values(n).
  subroutine curve_eval_scalars(self, u, values, options, flags, stat, errmsg)
    class(planish_curve_t), intent(in) :: self
    real(c_double), intent(in), contiguous :: u(:)
    real(c_double), intent(inout), contiguous, target :: values(:)
    type(planish_eval_options), intent(in), optional :: options
    integer(c_int8_t), intent(inout), optional, target, contiguous :: flags(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    real(c_double), pointer, contiguous :: rows(:, :)
    rows(1:1, 1:size(values)) => values
    call self%eval(u, rows, options, flags, stat, errmsg)
  end subroutine

  !> out(:,k,i): C, C', C'', C''' at u(i), max_derivative + 1 columns, max_derivative 0 to 3.
  subroutine curve_eval_derivatives(self, u, max_derivative, out, options, flags, stat, errmsg)
    class(planish_curve_t), intent(in) :: self
    real(c_double), intent(in), contiguous :: u(:)
    integer, intent(in) :: max_derivative
    real(c_double), intent(inout), contiguous :: out(:, :, :)
    type(planish_eval_options), intent(in), optional :: options
    integer(c_int8_t), intent(inout), optional, target, contiguous :: flags(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_eval_options) :: call_options
    integer(c_size_t) :: count, extents(3)
    count = size(u, kind=c_size_t)
    extents = shape(out, c_size_t)
    if (present(options)) call_options = options
    if (refuse_dim(extents(1), self%dim(), "out", stat, errmsg)) return
    if (refuse_points(call_options, [1_c_size_t, count], [extents(1) * extents(2), extents(3)], flags, stat, errmsg)) &
        return
    call conclude(c_curve_eval(self%get(), u, count, int(max_derivative, c_int32_t), call_options, out), stat, errmsg)
  end subroutine

  ! ---------------------------------------------------------------------------------------------------------
  ! T-spline
  ! ---------------------------------------------------------------------------------------------------------

  !> Skins points(dim,n), row after row, and how many points each row has.
  !>
  !> report:         receives how good the surface is; worst_index counts from 1.
  !> skin_report:    receives what only skins report; twisted_row counts from 1, 0 is none.
  !> end_slopes:     (dim, 2, rows), slopes at begin and end of each row, for PLANISH_SECTION_ENDS_SLOPES.
  !> begin_tangents: (dim,n), derivatives across the first row, one for each of its points.
  !> end_tangents:   (dim,n), the same at the last row.
  !> parameters:     (2,n), receives the (u,v) at which the error of each point is measured.
  !> errors:         receives the error of each point.
  !> progress:       hears how far the fit is, and may cancel it.
  subroutine planish_tspline_skin(points, point_counts, surface, options, report, skin_report, end_slopes, &
      begin_tangents, end_tangents, parameters, errors, progress, stat, errmsg)
    real(c_double), intent(in), contiguous :: points(:, :)
    integer, intent(in) :: point_counts(:)
    class(planish_surface_t), intent(inout) :: surface
    type(planish_skin_options), intent(in), optional :: options
    type(planish_fit_report), intent(inout), optional :: report
    type(planish_skin_report), intent(inout), optional, target :: skin_report
    real(c_double), intent(in), optional, target, contiguous :: end_slopes(:, :, :)
    real(c_double), intent(in), optional, target, contiguous :: begin_tangents(:, :), end_tangents(:, :)
    real(c_double), intent(inout), optional, target, contiguous :: parameters(:, :), errors(:)
    procedure(planish_progress), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_skin_options) :: call_options
    type(planish_tensor_options) :: data
    type(planish_parameterize_options), target :: map
    type(listener), target :: user
    type(c_ptr) :: handle
    integer(c_size_t) :: counts(size(point_counts)), dim, row_count
    integer(c_int) :: status
    if (present(options)) call_options = options
    dim = size(points, 1, c_size_t)
    row_count = size(point_counts, kind=c_size_t)
    if (refuse(any(point_counts < 0), PLANISH_STATUS_INVALID_ARGUMENT, "a row has less than no points", &
        stat, errmsg)) return
    counts = point_counts
    if (refuse_extent(size(points, 2, c_size_t), sum(counts), "the number of points", stat, errmsg)) return
    if (refuse_data(data, map, user, sum(counts), parameters=parameters, errors=errors, progress=progress, &
        stat=stat, errmsg=errmsg)) return
    if (present(end_slopes)) then
      if (refuse_extent(size(end_slopes, 1, c_size_t), dim, "the first extent of end_slopes", stat, errmsg)) return
      if (refuse_extent(size(end_slopes, 2, c_size_t), 2_c_size_t, "the second extent of end_slopes", &
          stat, errmsg)) return
      if (refuse_extent(size(end_slopes, 3, c_size_t), row_count, "the third extent of end_slopes", stat, errmsg)) &
          return
      call_options%end_slopes = c_loc(end_slopes)
    end if
    if (row_count > 0) then ! with no rows the library says what is wrong
      if (refuse_tangents(begin_tangents, dim, counts(1), "begin_tangents", call_options%begin_tangents, &
          stat, errmsg)) return
      if (refuse_tangents(end_tangents, dim, counts(row_count), "end_tangents", call_options%end_tangents, &
          stat, errmsg)) return
    end if
    call_options%dim = dim
    call_options%out_parameters = data%out_parameters
    call_options%out_errors = data%out_errors
    call_options%progress = data%progress
    call_options%user = data%user
    if (present(skin_report)) call_options%out_report = c_loc(skin_report)
    status = c_tspline_skin(points, counts, row_count, call_options, handle, report)
    if (status >= 0) call surface%take(handle)
    call conclude_skin(status, report, skin_report, stat, errmsg)
  end subroutine

  !> Skins section curves; the arguments are those of planish_tspline_skin(). The tangents have one vector for each
  !> different knot of the first and of the last curve.
  subroutine planish_tspline_skin_curves(curves, surface, options, report, skin_report, begin_tangents, &
      end_tangents, progress, stat, errmsg)
    class(planish_curve_t), intent(in) :: curves(:)
    class(planish_surface_t), intent(inout) :: surface
    type(planish_skin_options), intent(in), optional :: options
    type(planish_fit_report), intent(inout), optional :: report
    type(planish_skin_report), intent(inout), optional, target :: skin_report
    real(c_double), intent(in), optional, target, contiguous :: begin_tangents(:, :), end_tangents(:, :)
    procedure(planish_progress), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_skin_options) :: call_options
    type(planish_tensor_options) :: data
    type(planish_parameterize_options), target :: map
    type(listener), target :: user
    type(c_ptr) :: handle
    integer(c_size_t) :: count
    integer(c_int) :: status
    if (present(options)) call_options = options
    count = size(curves, kind=c_size_t)
    if (refuse_data(data, map, user, count, progress=progress, stat=stat, errmsg=errmsg)) return
    if (count > 0) then ! with no curves the library says what is wrong
      if (refuse_tangents(begin_tangents, curves(1)%dim(), different_knots(curves(1)), "begin_tangents", &
          call_options%begin_tangents, stat, errmsg)) return
      if (refuse_tangents(end_tangents, curves(count)%dim(), different_knots(curves(count)), "end_tangents", &
          call_options%end_tangents, stat, errmsg)) return
    end if
    call_options%progress = data%progress
    call_options%user = data%user
    if (present(skin_report)) call_options%out_report = c_loc(skin_report)
    status = c_tspline_skin_curves(handles_of(curves), count, call_options, handle, report)
    if (status >= 0) call surface%take(handle)
    call conclude_skin(status, report, skin_report, stat, errmsg)
  end subroutine

  !> Leads options to the tangents across a row, and refuses those that are not one for each of its data.
  logical function refuse_tangents(tangents, dim, count, name, address, stat, errmsg) result(refused)
    real(c_double), intent(in), optional, target, contiguous :: tangents(:, :)
    integer(c_size_t), intent(in) :: dim, count
    character(*), intent(in) :: name
    type(c_ptr), intent(inout) :: address
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    refused = .false.
    if (.not. present(tangents)) return
    refused = .true.
    if (refuse_extent(size(tangents, 1, c_size_t), dim, "the first extent of " // name, stat, errmsg)) return
    if (refuse_extent(size(tangents, 2, c_size_t), count, "the second extent of " // name, stat, errmsg)) return
    address = c_loc(tangents)
    refused = .false.
  end function

  !> Ends a skin: its reports name data and rows.
  subroutine conclude_skin(status, report, skin_report, stat, errmsg)
    integer(c_int), intent(in) :: status
    type(planish_fit_report), intent(inout), optional :: report
    type(planish_skin_report), intent(inout), optional :: skin_report
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (status >= 0 .and. present(skin_report)) skin_report%twisted_row = skin_report%twisted_row + 1
    call conclude_fit(status, report, stat, errmsg)
  end subroutine

  !> Curves for C.
  pure function curve_handles(curves) result(handles)
    class(planish_curve_t), intent(in) :: curves(:)
    type(c_ptr) :: handles(size(curves))
    integer :: i
    do i = 1, size(curves)
      handles(i) = curves(i)%get()
    end do
  end function

  !> How many different knots a curve has in its domain.
  integer(c_size_t) function different_knots(curve) result(count)
    class(planish_curve_t), intent(in) :: curve
    real(c_double) :: knots(curve%knot_count()), interval(2)
    integer(c_size_t) :: i
    integer :: stat
    count = 0
    call curve%domain(interval, stat)
    if (stat < 0) return
    call curve%copy_knots(knots, stat)
    knots = min(max(knots, interval(1)), interval(2))
    count = 1
    do i = 2, size(knots, kind=c_size_t)
      if (knots(i) > knots(i - 1)) count = count + 1
    end do
  end function

  !> Makes a T-spline from its parts: the knots along v, and size(knots) - 4 control curves.
  subroutine planish_tspline_new(knots, curves, surface, stat, errmsg)
    real(c_double), intent(in), contiguous :: knots(:)
    class(planish_curve_t), intent(in) :: curves(:)
    class(planish_surface_t), intent(inout) :: surface
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: handle
    integer(c_int) :: status
    status = c_tspline_new(knots, size(knots, kind=c_size_t), handles_of(curves), size(curves, kind=c_size_t), handle)
    if (status >= 0) call surface%take(handle)
    call conclude(status, stat, errmsg)
  end subroutine

  !> Number of control curves.
  pure integer(c_size_t) function planish_tspline_curve_count(surface) result(count)
    class(planish_surface_t), intent(in) :: surface
    count = c_tspline_curve_count(surface%get())
  end function

  !> Makes a copy of a control curve, which counts from 1.
  subroutine planish_tspline_clone_curve(surface, index, curve, stat, errmsg)
    class(planish_surface_t), intent(in) :: surface
    integer, intent(in) :: index
    class(planish_curve_t), intent(inout) :: curve
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: handle
    integer(c_int) :: status
    if (refuse(index < 1, PLANISH_STATUS_INDEX, "control curves count from 1", stat, errmsg)) return
    status = c_tspline_clone_curve(surface%get(), index - 1_c_size_t, handle)
    if (status >= 0) call curve%take(handle)
    call conclude(status, stat, errmsg)
  end subroutine

  !> Number of knots along v.
  pure integer(c_size_t) function planish_tspline_knot_count(surface) result(count)
    class(planish_surface_t), intent(in) :: surface
    count = c_tspline_knot_count(surface%get())
  end function

  !> The knots along v: at least planish_tspline_knot_count() of them.
  subroutine planish_tspline_copy_knots(surface, knots, stat, errmsg)
    class(planish_surface_t), intent(in) :: surface
    real(c_double), intent(inout), contiguous :: knots(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call conclude(c_tspline_copy_knots(surface%get(), knots, size(knots, kind=c_size_t)), stat, errmsg)
  end subroutine

  !> Inserts a knot into one control curve, which counts from 1; the surface stays the same.
  subroutine planish_tspline_insert_knot_u(surface, curve, u, stat, errmsg)
    class(planish_surface_t), intent(inout) :: surface
    integer, intent(in) :: curve
    real(c_double), intent(in) :: u
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (refuse(curve < 1, PLANISH_STATUS_INDEX, "control curves count from 1", stat, errmsg)) return
    call conclude(c_tspline_insert_knot_u(surface%get(), curve - 1_c_size_t, u), stat, errmsg)
  end subroutine

  !> Inserts a knot along v; the surface stays the same and has one control curve more.
  subroutine planish_tspline_insert_knot_v(surface, v, stat, errmsg)
    class(planish_surface_t), intent(inout) :: surface
    real(c_double), intent(in) :: v
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call conclude(c_tspline_insert_knot_v(surface%get(), v), stat, errmsg)
  end subroutine

  !> Removes a knot from one control curve if the surface then moves by no more than a tolerance; else stat is
  !> PLANISH_STATUS_TOLERANCE_NOT_MET. Curve and knot count from 1.
  !>
  !> error: receives a bound of the distance that the surface moves, or would have moved.
  subroutine planish_tspline_remove_knot_u(surface, curve, knot, tolerance, error, stat, errmsg)
    class(planish_surface_t), intent(inout) :: surface
    integer, intent(in) :: curve, knot
    real(c_double), intent(in) :: tolerance
    real(c_double), intent(inout), optional :: error
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (refuse(curve < 1 .or. knot < 1, PLANISH_STATUS_INDEX, "control curves and knots count from 1", &
        stat, errmsg)) return
    call conclude(c_tspline_remove_knot_u(surface%get(), curve - 1_c_size_t, knot - 1_c_size_t, tolerance, error), &
        stat, errmsg)
  end subroutine

  ! ---------------------------------------------------------------------------------------------------------
  ! D1RC-spline
  ! ---------------------------------------------------------------------------------------------------------

  !> Fits a D1RC-spline to the shape of a mesh.
  !>
  !> control_mesh: the control mesh to use as it is, in place of the mesh with fewer nodes.
  !> sharp_edges:  (2,n), nodes of the control mesh if it is given, else of the mesh; they count from 1.
  !> The other arguments are those of planish_tensor_fit().
  subroutine planish_d1rc_fit( &
      mesh, surface, options, report, control_mesh, sharp_edges, parameterize, weights, parameters, errors, progress, &
      stat, errmsg)
    class(planish_mesh_t), intent(in) :: mesh
    class(planish_surface_t), intent(inout) :: surface
    type(planish_d1rc_options), intent(in), optional :: options
    type(planish_fit_report), intent(inout), optional :: report
    class(planish_mesh_t), intent(in), optional :: control_mesh
    integer(c_int32_t), intent(in), optional :: sharp_edges(:, :)
    type(planish_parameterize_options), intent(in), optional :: parameterize
    real(c_double), intent(in), optional, target, contiguous :: weights(:)
    real(c_double), intent(inout), optional, target, contiguous :: parameters(:, :), errors(:)
    procedure(planish_progress), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_d1rc_options) :: call_options
    type(planish_tensor_options) :: data
    type(planish_parameterize_options), target :: map
    type(listener), target :: user
    integer(c_int32_t), allocatable, target :: edges(:, :)
    type(c_ptr) :: handle
    integer(c_int) :: status
    if (present(options)) call_options = options
    if (refuse_data(data, map, user, mesh%point_count(), parameterize, weights, parameters, errors, progress, &
        stat, errmsg)) return
    call_options%parameterize = data%parameterize
    call_options%weights = data%weights
    call_options%progress = data%progress
    call_options%user = data%user
    call_options%out_parameters = data%out_parameters
    call_options%out_errors = data%out_errors
    if (present(control_mesh)) call_options%control_mesh = control_mesh%get()
    if (present(sharp_edges)) then
      if (refuse_extent(size(sharp_edges, 1, c_size_t), 2_c_size_t, "the first extent of sharp_edges", stat, &
          errmsg)) return
      edges = sharp_edges - 1
      call_options%sharp_edges = c_loc(edges)
      call_options%sharp_edge_count = size(edges, 2, c_size_t)
    end if
    status = c_d1rc_fit(mesh%get(), call_options, handle, report)
    if (status >= 0) call surface%take(handle)
    call conclude_fit(status, report, stat, errmsg)
  end subroutine

  ! ---------------------------------------------------------------------------------------------------------
  ! Models of meshes
  ! ---------------------------------------------------------------------------------------------------------

  !> Makes a model of any mesh: smooth patches and a solid of a closed one, one chart of a mesh with a boundary.
  !>
  !> report: receives what the fit did; worst_node counts from 1.
  !> errors: receives the error of each node.
  !> labels: a number for each triangle: edges between different ones are features, and exact faces have it as label.
  subroutine planish_model_fit(mesh, model, options, report, errors, labels, progress, stat, errmsg)
    class(planish_mesh_t), intent(in) :: mesh
    class(planish_model_t), intent(inout) :: model
    type(planish_model_options), intent(in), optional :: options
    type(planish_model_report), intent(inout), optional :: report
    real(c_double), intent(inout), optional, target, contiguous :: errors(:)
    integer(c_int32_t), intent(in), optional, target, contiguous :: labels(:)
    procedure(planish_progress), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_model_options) :: call_options
    type(listener), target :: user
    type(c_ptr) :: handle
    integer(c_int) :: status
    if (present(options)) call_options = options
    if (present(errors)) then
      if (refuse_extent(size(errors, 1, c_size_t), mesh%point_count(), "the length of errors", stat, errmsg)) return
      call_options%out_errors = c_loc(errors)
    end if
    if (present(labels)) then
      call_options%labels = c_loc(labels)
      call_options%label_count = size(labels, kind=c_size_t)
    end if
    if (present(progress)) then
      user%hear => progress
      call_options%progress = c_funloc(relay)
      call_options%user = c_loc(user)
    end if
    status = c_model_fit(mesh%get(), call_options, handle, report)
    if (status >= 0) call model%take(handle)
    if (status >= 0 .and. present(report)) report%worst_node = report%worst_node + 1
    call conclude(status, stat, errmsg)
  end subroutine

  !> Makes one smooth model of tensor surfaces that meet edge to edge within a tolerance. worst_patch of the report
  !> counts from 1.
  subroutine planish_model_smooth_from_patches(surfaces, model, options, report, progress, stat, errmsg)
    class(planish_surface_t), intent(in) :: surfaces(:)
    class(planish_model_t), intent(inout) :: model
    type(planish_smooth_options), intent(in), optional :: options
    type(planish_smooth_report), intent(inout), optional :: report
    procedure(planish_progress), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_smooth_options) :: call_options
    type(listener), target :: user
    type(c_ptr) :: handle
    integer(c_int) :: status
    if (present(options)) call_options = options
    if (present(progress)) then
      user%hear => progress
      call_options%progress = c_funloc(relay)
      call_options%user = c_loc(user)
    end if
    status = c_model_smooth_from_patches( &
        handles_of(surfaces), size(surfaces, kind=c_size_t), call_options, handle, report)
    if (status >= 0) call model%take(handle)
    if (status >= 0 .and. present(report)) report%worst_patch = report%worst_patch + 1
    call conclude(status, stat, errmsg)
  end subroutine

  ! ---------------------------------------------------------------------------------------------------------
  ! PHT-spline
  ! ---------------------------------------------------------------------------------------------------------

  !> Fits a PHT-spline to the shape of a mesh; the optional arguments are those of planish_tensor_fit().
  subroutine planish_pht_fit( &
      mesh, surface, options, report, parameterize, weights, parameters, errors, progress, stat, errmsg)
    class(planish_mesh_t), intent(in) :: mesh
    class(planish_surface_t), intent(inout) :: surface
    type(planish_pht_options), intent(in), optional :: options
    type(planish_fit_report), intent(inout), optional :: report
    type(planish_parameterize_options), intent(in), optional :: parameterize
    real(c_double), intent(in), optional, target, contiguous :: weights(:)
    real(c_double), intent(inout), optional, target, contiguous :: parameters(:, :), errors(:)
    procedure(planish_progress), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_pht_options) :: call_options
    type(planish_tensor_options) :: data
    type(planish_parameterize_options), target :: map
    type(listener), target :: user
    type(c_ptr) :: handle
    integer(c_int) :: status
    if (present(options)) call_options = options
    if (refuse_data(data, map, user, mesh%point_count(), parameterize, weights, parameters, errors, progress, &
        stat, errmsg)) return
    call lead(call_options, data)
    status = c_pht_fit(mesh%get(), call_options, handle, report)
    if (status >= 0) call surface%take(handle)
    call conclude_fit(status, report, stat, errmsg)
  end subroutine

  subroutine pht_fit_points_rows( &
      uv, values, surface, options, report, weights, parameters, errors, progress, stat, errmsg)
    real(c_double), intent(in), contiguous :: uv(:, :), values(:, :)
    class(planish_surface_t), intent(inout) :: surface
    type(planish_pht_options), intent(in), optional :: options
    type(planish_fit_report), intent(inout), optional :: report
    real(c_double), intent(in), optional, target, contiguous :: weights(:)
    real(c_double), intent(inout), optional, target, contiguous :: parameters(:, :), errors(:)
    procedure(planish_progress), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_pht_options) :: call_options
    type(planish_tensor_options) :: data
    type(planish_parameterize_options), target :: map
    type(listener), target :: user
    type(c_ptr) :: handle
    integer(c_int) :: status
    integer(c_size_t) :: count
    count = size(uv, 2, c_size_t)
    if (present(options)) call_options = options
    if (refuse_extent(size(uv, 1, c_size_t), 2_c_size_t, "the first extent of uv", stat, errmsg)) return
    if (refuse_extent(size(values, 2, c_size_t), count, "the number of values", stat, errmsg)) return
    if (refuse_data(data, map, user, count, weights=weights, parameters=parameters, errors=errors, &
        progress=progress, stat=stat, errmsg=errmsg)) return
    call lead(call_options, data)
    status = c_pht_fit_points(uv, values, count, size(values, 1, c_size_t), call_options, handle, report)
    if (status >= 0) call surface%take(handle)
    call conclude_fit(status, report, stat, errmsg)
  end subroutine

  subroutine pht_fit_points_scalars( &
      uv, values, surface, options, report, weights, parameters, errors, progress, stat, errmsg)
    real(c_double), intent(in), contiguous :: uv(:, :)
    real(c_double), intent(in), contiguous, target :: values(:)
    class(planish_surface_t), intent(inout) :: surface
    type(planish_pht_options), intent(in), optional :: options
    type(planish_fit_report), intent(inout), optional :: report
    real(c_double), intent(in), optional, target, contiguous :: weights(:)
    real(c_double), intent(inout), optional, target, contiguous :: parameters(:, :), errors(:)
    procedure(planish_progress), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    real(c_double), pointer, contiguous :: rows(:, :)
    rows(1:1, 1:size(values)) => values
    call pht_fit_points_rows( &
        uv, rows, surface, options, report, weights, parameters, errors, progress, stat, errmsg)
  end subroutine

  subroutine pht_fit_field_rows( &
      mesh, values, surface, options, report, parameterize, weights, parameters, errors, progress, stat, errmsg)
    class(planish_mesh_t), intent(in) :: mesh
    real(c_double), intent(in), contiguous :: values(:, :)
    class(planish_surface_t), intent(inout) :: surface
    type(planish_pht_options), intent(in), optional :: options
    type(planish_fit_report), intent(inout), optional :: report
    type(planish_parameterize_options), intent(in), optional :: parameterize
    real(c_double), intent(in), optional, target, contiguous :: weights(:)
    real(c_double), intent(inout), optional, target, contiguous :: parameters(:, :), errors(:)
    procedure(planish_progress), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_pht_options) :: call_options
    type(planish_tensor_options) :: data
    type(planish_parameterize_options), target :: map
    type(listener), target :: user
    type(c_ptr) :: handle
    integer(c_int) :: status
    if (present(options)) call_options = options
    if (refuse_data(data, map, user, size(values, 2, c_size_t), parameterize, weights, parameters, errors, progress, &
        stat, errmsg)) return
    call lead(call_options, data)
    status = c_pht_fit_field( &
        mesh%get(), values, size(values, 2, c_size_t), size(values, 1, c_size_t), call_options, handle, report)
    if (status >= 0) call surface%take(handle)
    call conclude_fit(status, report, stat, errmsg)
  end subroutine

  subroutine pht_fit_field_scalars( &
      mesh, values, surface, options, report, parameterize, weights, parameters, errors, progress, stat, errmsg)
    class(planish_mesh_t), intent(in) :: mesh
    real(c_double), intent(in), contiguous, target :: values(:)
    class(planish_surface_t), intent(inout) :: surface
    type(planish_pht_options), intent(in), optional :: options
    type(planish_fit_report), intent(inout), optional :: report
    type(planish_parameterize_options), intent(in), optional :: parameterize
    real(c_double), intent(in), optional, target, contiguous :: weights(:)
    real(c_double), intent(inout), optional, target, contiguous :: parameters(:, :), errors(:)
    procedure(planish_progress), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    real(c_double), pointer, contiguous :: rows(:, :)
    rows(1:1, 1:size(values)) => values
    call pht_fit_field_rows( &
        mesh, rows, surface, options, report, parameterize, weights, parameters, errors, progress, stat, errmsg)
  end subroutine

  !> Leads options to the same arguments as those of a tensor fit.
  subroutine lead(options, data)
    type(planish_pht_options), intent(inout) :: options
    type(planish_tensor_options), intent(in) :: data
    options%parameterize = data%parameterize
    options%weights = data%weights
    options%progress = data%progress
    options%user = data%user
    options%out_parameters = data%out_parameters
    options%out_errors = data%out_errors
  end subroutine

  !> Makes a PHT-spline of values of dim numbers from an initial grid and cells(3,n) to split, each level, i, j.
  !>
  !> data:        (width, 4, vertices), f, f_u, f_v, f_uv of each basis vertex; zeros, and weights of 1, without it.
  !> is_rational: whether values are followed by a weight and multiplied by it.
  subroutine planish_pht_new(dim, lines_u, lines_v, cells, surface, data, is_rational, stat, errmsg)
    integer, intent(in) :: dim
    real(c_double), intent(in), contiguous :: lines_u(:), lines_v(:)
    integer(c_int32_t), intent(in), contiguous :: cells(:, :)
    class(planish_surface_t), intent(inout) :: surface
    real(c_double), intent(in), optional, contiguous :: data(:, :, :)
    logical, intent(in), optional :: is_rational
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: handle
    integer(c_int32_t) :: with_weights
    integer(c_size_t) :: data_count
    integer(c_int) :: status
    with_weights = 0
    if (present(is_rational)) with_weights = merge(1_c_int32_t, 0_c_int32_t, is_rational)
    data_count = 0
    if (present(data)) then
      if (refuse_extent(size(data, 1, c_size_t), int(dim + with_weights, c_size_t), "the first extent of data", &
          stat, errmsg)) return
      if (refuse_extent(size(data, 2, c_size_t), 4_c_size_t, "the second extent of data", stat, errmsg)) return
      data_count = size(data, kind=c_size_t)
    end if
    if (refuse_extent(size(cells, 1, c_size_t), 3_c_size_t, "the first extent of cells", stat, errmsg)) return
    if (refuse(dim < 1, PLANISH_STATUS_INVALID_ARGUMENT, "dim is less than 1", stat, errmsg)) return
    status = c_pht_new(int(dim, c_size_t), with_weights, lines_u, size(lines_u, kind=c_size_t), lines_v, &
        size(lines_v, kind=c_size_t), cells, size(cells, 2, c_size_t), data, data_count, handle)
    if (status >= 0) call surface%take(handle)
    call conclude(status, stat, errmsg)
  end subroutine

  !> Splits cells(3,n), each level, i, j, at their middles; the surface stays the same.
  subroutine planish_pht_split(surface, cells, stat, errmsg)
    class(planish_surface_t), intent(inout) :: surface
    integer(c_int32_t), intent(in), contiguous :: cells(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (refuse_extent(size(cells, 1, c_size_t), 3_c_size_t, "the first extent of cells", stat, errmsg)) return
    call conclude(c_pht_split(surface%get(), cells, size(cells, 2, c_size_t)), stat, errmsg)
  end subroutine

  !> Merges the quarters of cells(3,n), each level, i, j: the inverse of planish_pht_split().
  subroutine planish_pht_merge(surface, cells, stat, errmsg)
    class(planish_surface_t), intent(inout) :: surface
    integer(c_int32_t), intent(in), contiguous :: cells(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (refuse_extent(size(cells, 1, c_size_t), 3_c_size_t, "the first extent of cells", stat, errmsg)) return
    call conclude(c_pht_merge(surface%get(), cells, size(cells, 2, c_size_t)), stat, errmsg)
  end subroutine

  !> Merges as many cells as it can while no point moves by more than a tolerance.
  !>
  !> deviation: receives a bound of how far a point has moved.
  subroutine planish_pht_simplify(surface, tolerance, deviation, stat, errmsg)
    class(planish_surface_t), intent(inout) :: surface
    real(c_double), intent(in) :: tolerance
    real(c_double), intent(inout), optional :: deviation
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call conclude(c_pht_simplify(surface%get(), tolerance, out_deviation=deviation), stat, errmsg)
  end subroutine

  !> Splits all cells that meet the inside of a region, least u, largest u, least v, largest v, until they have at
  !> least some level; the surface stays the same. With more than max_cells cells the call fails.
  subroutine planish_pht_refine_region(surface, region, level, max_cells, stat, errmsg)
    class(planish_surface_t), intent(inout) :: surface
    real(c_double), intent(in) :: region(4)
    integer, intent(in) :: level, max_cells
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (refuse(max_cells < 0, PLANISH_STATUS_INVALID_ARGUMENT, "max_cells is negative", stat, errmsg)) return
    call conclude(c_pht_refine_region(surface%get(), region, int(level, c_int32_t), int(max_cells, c_size_t)), &
        stat, errmsg)
  end subroutine

  !> Makes a PHT-spline of a tensor surface, with its weights and trims.
  subroutine planish_pht_from_surface(surface, pht, options, stat, errmsg)
    class(planish_surface_t), intent(in) :: surface
    class(planish_surface_t), intent(inout) :: pht
    type(planish_pht_convert_options), intent(in), optional :: options
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: handle
    integer(c_int) :: status
    status = c_pht_from_surface(surface%get(), options, handle)
    if (status >= 0) call pht%take(handle)
    call conclude(status, stat, errmsg)
  end subroutine

  !> Makes tensor surfaces that together are a PHT-spline, each over cells whose levels differ by at most level_spread.
  subroutine planish_pht_to_tensor_patches(surface, level_spread, patches, stat, errmsg)
    class(planish_surface_t), intent(in) :: surface
    integer, intent(in) :: level_spread
    type(planish_surface_t), allocatable, intent(inout) :: patches(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr), allocatable :: handles(:)
    integer(c_size_t) :: count
    integer(c_int) :: status
    integer :: i
    type(planish_pht_patches_options) :: options
    options%level_spread = int(level_spread, c_int32_t)
    status = c_pht_to_tensor_patches(surface%get(), options, count=0_c_size_t, out_count=count)
    if (status >= 0) then
      allocate (handles(count))
      status = c_pht_to_tensor_patches(surface%get(), options, handles, count, count)
    end if
    if (status >= 0) then
      if (allocated(patches)) deallocate (patches)
      allocate (patches(size(handles)))
      do i = 1, size(handles)
        call patches(i)%take(handles(i))
      end do
    end if
    call conclude(status, stat, errmsg)
  end subroutine

  !> Makes two PHT-splines meet with common tangents along an edge of each, a PLANISH_BORDER_SIDE.
  !>
  !> is_reversed: whether the edges run in opposite directions; they do not without it.
  subroutine planish_pht_stitch(first, first_side, second, second_side, is_reversed, stat, errmsg)
    class(planish_surface_t), intent(inout) :: first, second
    integer(c_int32_t), intent(in) :: first_side, second_side
    logical, intent(in), optional :: is_reversed
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: turned
    turned = 0
    if (present(is_reversed)) turned = merge(1_c_int32_t, 0_c_int32_t, is_reversed)
    call conclude(c_pht_stitch(first%get(), first_side, second%get(), second_side, turned), stat, errmsg)
  end subroutine

  !> Number of cells. Cell k is patch k of copy_patch().
  pure integer(c_size_t) function planish_pht_cell_count(surface) result(count)
    class(planish_surface_t), intent(in) :: surface
    count = c_pht_cell_count(surface%get())
  end function

  !> Number of basis vertices, each with four control points.
  pure integer(c_size_t) function planish_pht_vertex_count(surface) result(count)
    class(planish_surface_t), intent(in) :: surface
    count = c_pht_vertex_count(surface%get())
  end function

  !> Number of T-vertices: they lie inside an edge of a cell, their host, and have its data.
  pure integer(c_size_t) function planish_pht_hanging_count(surface) result(count)
    class(planish_surface_t), intent(in) :: surface
    count = c_pht_hanging_count(surface%get())
  end function

  !> Numbers of a row of data: dim, or dim + 1 with weights.
  pure integer(c_size_t) function planish_pht_width(surface) result(width)
    class(planish_surface_t), intent(in) :: surface
    width = c_pht_width(surface%get())
  end function

  !> cells(3,n), each level, i, j: n at least planish_pht_cell_count().
  subroutine planish_pht_copy_cells(surface, cells, stat, errmsg)
    class(planish_surface_t), intent(in) :: surface
    integer(c_int32_t), intent(inout), contiguous :: cells(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (refuse_extent(size(cells, 1, c_size_t), 3_c_size_t, "the first extent of cells", stat, errmsg)) return
    call conclude(c_pht_copy_cells(surface%get(), cells, size(cells, 2, c_size_t)), stat, errmsg)
  end subroutine

  !> uv(2,n) of the basis vertices, ordered along u, then along v: n at least planish_pht_vertex_count().
  subroutine planish_pht_copy_vertices(surface, uv, stat, errmsg)
    class(planish_surface_t), intent(in) :: surface
    real(c_double), intent(inout), contiguous :: uv(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (refuse_extent(size(uv, 1, c_size_t), 2_c_size_t, "the first extent of uv", stat, errmsg)) return
    call conclude(c_pht_copy_vertices(surface%get(), uv, size(uv, 2, c_size_t)), stat, errmsg)
  end subroutine

  !> uv(2,n) of the T-vertices and the cells that host them, which count from 1: n at least
  !> planish_pht_hanging_count().
  subroutine planish_pht_copy_hanging(surface, uv, hosts, stat, errmsg)
    class(planish_surface_t), intent(in) :: surface
    real(c_double), intent(inout), contiguous :: uv(:, :)
    integer(c_int32_t), intent(inout), contiguous :: hosts(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_size_t) :: count
    integer(c_int) :: status
    if (refuse_extent(size(uv, 1, c_size_t), 2_c_size_t, "the first extent of uv", stat, errmsg)) return
    count = planish_pht_hanging_count(surface)
    status = c_pht_copy_hanging(surface%get(), uv, hosts, min(size(uv, 2, c_size_t), size(hosts, kind=c_size_t)))
    if (status >= 0) hosts(:count) = hosts(:count) + 1
    call conclude(status, stat, errmsg)
  end subroutine

  !> The cells that share a part of an edge with a cell: those at its least u, largest u, least v and largest v, in
  !> order along each; cells count from 1.
  subroutine planish_pht_copy_neighbours(surface, cell, cells, stat, errmsg)
    class(planish_surface_t), intent(in) :: surface
    integer, intent(in) :: cell
    integer, allocatable, intent(inout) :: cells(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int32_t), allocatable :: found(:)
    integer(c_size_t) :: count
    integer(c_int) :: status
    if (refuse(cell < 1, PLANISH_STATUS_INDEX, "cells count from 1", stat, errmsg)) return
    status = c_pht_copy_neighbours(surface%get(), cell - 1_c_size_t, count=0_c_size_t, out_count=count)
    if (status >= 0) then
      allocate (found(count))
      status = c_pht_copy_neighbours(surface%get(), cell - 1_c_size_t, found, count, count)
      cells = int(found) + 1
    end if
    call conclude(status, stat, errmsg)
  end subroutine

  !> data(width, 4, n), f, f_u, f_v, f_uv of each basis vertex; with weights those of (w x, .., w). n at least
  !> planish_pht_vertex_count().
  subroutine planish_pht_copy_data(surface, data, stat, errmsg)
    class(planish_surface_t), intent(in) :: surface
    real(c_double), intent(inout), contiguous :: data(:, :, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (refuse_quadruples(surface, shape(data, c_size_t), "data", stat, errmsg)) return
    call conclude(c_pht_copy_data(surface%get(), data, size(data, 3, c_size_t)), stat, errmsg)
  end subroutine

  !> Replaces the data(width, 4, n) of some basis vertices, which count from 1.
  subroutine planish_pht_set_data(surface, vertices, data, stat, errmsg)
    class(planish_surface_t), intent(inout) :: surface
    integer, intent(in) :: vertices(:)
    real(c_double), intent(in), contiguous :: data(:, :, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (refuse_quadruples(surface, shape(data, c_size_t), "data", stat, errmsg)) return
    if (refuse_vertices(vertices, size(data, 3, c_size_t), "data", stat, errmsg)) return
    call conclude(c_pht_set_data(surface%get(), vertices - 1_c_int32_t, size(vertices, kind=c_size_t), data), &
        stat, errmsg)
  end subroutine

  !> points(width, 4, n), towards less or more u, then v, --, +-, -+, ++ of each basis vertex, in a PLANISH_PHT_BASIS;
  !> with weights those of (w x, .., w). n at least planish_pht_vertex_count().
  subroutine planish_pht_copy_control_points(surface, basis, points, stat, errmsg)
    class(planish_surface_t), intent(in) :: surface
    integer(c_int32_t), intent(in) :: basis
    real(c_double), intent(inout), contiguous :: points(:, :, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (refuse_quadruples(surface, shape(points, c_size_t), "points", stat, errmsg)) return
    call conclude(c_pht_copy_control_points(surface%get(), basis, points, size(points, 3, c_size_t)), stat, errmsg)
  end subroutine

  !> Replaces the control points(width, 4, n) of some basis vertices, which count from 1.
  subroutine planish_pht_set_control_points(surface, vertices, basis, points, stat, errmsg)
    class(planish_surface_t), intent(inout) :: surface
    integer, intent(in) :: vertices(:)
    integer(c_int32_t), intent(in) :: basis
    real(c_double), intent(in), contiguous :: points(:, :, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (refuse_quadruples(surface, shape(points, c_size_t), "points", stat, errmsg)) return
    if (refuse_vertices(vertices, size(points, 3, c_size_t), "points", stat, errmsg)) return
    call conclude(c_pht_set_control_points(surface%get(), vertices - 1_c_int32_t, size(vertices, kind=c_size_t), &
        basis, points), stat, errmsg)
  end subroutine

  !> Refuses an array that has not four rows of the surface's width for each vertex.
  logical function refuse_quadruples(surface, extents, name, stat, errmsg) result(refused)
    class(planish_surface_t), intent(in) :: surface
    integer(c_size_t), intent(in) :: extents(3)
    character(*), intent(in) :: name
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    refused = refuse_dim(extents(1), planish_pht_width(surface), name, stat, errmsg)
    if (.not. refused) refused = refuse_extent(extents(2), 4_c_size_t, "the second extent of " // name, stat, errmsg)
  end function

  !> Refuses vertices that do not count from 1, or are not as many as their rows.
  logical function refuse_vertices(vertices, row_count, name, stat, errmsg) result(refused)
    integer, intent(in) :: vertices(:)
    integer(c_size_t), intent(in) :: row_count
    character(*), intent(in) :: name
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    refused = refuse(any(vertices < 1), PLANISH_STATUS_INDEX, "vertices count from 1", stat, errmsg)
    if (refused) return
    refused = refuse_extent(row_count, size(vertices, kind=c_size_t), "the third extent of " // name, stat, errmsg)
  end function

  !> The operator that makes the Bezier ordinates of a cell from the control points that act on it, those of
  !> vertices(n): ordinates(:,k) are the sums of matrix(q,i,k) times control point q of vertex i, matrix(4,n,16).
  !> Cells and vertices count from 1.
  subroutine planish_pht_copy_extraction(surface, cell, basis, vertices, matrix, stat, errmsg)
    class(planish_surface_t), intent(in) :: surface
    integer, intent(in) :: cell
    integer(c_int32_t), intent(in) :: basis
    integer(c_int32_t), allocatable, intent(inout) :: vertices(:)
    real(c_double), allocatable, intent(inout) :: matrix(:, :, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_size_t) :: count
    integer(c_int) :: status
    if (refuse(cell < 1, PLANISH_STATUS_INDEX, "cells count from 1", stat, errmsg)) return
    status = c_pht_copy_extraction(surface%get(), cell - 1_c_size_t, basis, count=0_c_size_t, out_count=count)
    if (status >= 0) then
      if (allocated(vertices)) deallocate (vertices)
      if (allocated(matrix)) deallocate (matrix)
      allocate (vertices(count), matrix(4, count, 16))
      status = c_pht_copy_extraction(surface%get(), cell - 1_c_size_t, basis, vertices, matrix, count, count)
      vertices = vertices + 1
    end if
    call conclude(status, stat, errmsg)
  end subroutine

  !> The number of the cell that has (u,v), beyond the domain of the nearest one; 0 if there are no cells.
  pure integer function planish_pht_cell_at(surface, u, v) result(cell)
    class(planish_surface_t), intent(in) :: surface
    real(c_double), intent(in) :: u, v
    cell = 0
    if (planish_pht_cell_count(surface) > 0) cell = int(c_pht_cell_at(surface%get(), u, v)) + 1
  end function

  ! ---------------------------------------------------------------------------------------------------------
  ! D1RC-spline
  ! ---------------------------------------------------------------------------------------------------------

  !> Makes a smooth surface from a triangular control mesh: a disk, possibly with holes. Its nodes are the control
  !> points; its parameters the domain, computed if it has none.
  !>
  !> sharp_edges: (2,n), nodes joined by edges; nodes count from 1.
  !> corners:     nodes to be interpolated.
  subroutine planish_d1rc_new( &
      mesh, surface, options, sharp_edges, corners, parameterize, progress, stat, errmsg)
    class(planish_mesh_t), intent(in) :: mesh
    class(planish_surface_t), intent(inout) :: surface
    type(planish_d1rc_options), intent(in), optional :: options
    integer(c_int32_t), intent(in), optional :: sharp_edges(:, :), corners(:)
    type(planish_parameterize_options), intent(in), optional :: parameterize
    procedure(planish_progress), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_d1rc_options) :: call_options
    type(planish_parameterize_options), target :: map
    type(listener), target :: user
    integer(c_int32_t), allocatable, target :: edges(:, :), fixed(:)
    type(c_ptr) :: handle
    integer(c_int) :: status
    if (present(options)) call_options = options
    if (present(sharp_edges)) then
      if (refuse_pairs(sharp_edges, "sharp_edges", stat, errmsg)) return
      edges = sharp_edges - 1
      call_options%sharp_edges = c_loc(edges)
      call_options%sharp_edge_count = size(edges, 2, c_size_t)
    end if
    if (present(corners)) then
      if (refuse(any(corners < 1), PLANISH_STATUS_INDEX, "corners count from 1", stat, errmsg)) return
      fixed = corners - 1
      call_options%corners = c_loc(fixed)
      call_options%corner_count = size(fixed, kind=c_size_t)
    end if
    if (present(parameterize)) then
      map = counted_from_0(parameterize)
      call_options%parameterize = c_loc(map)
    end if
    if (present(progress)) then
      user%hear => progress
      call_options%progress = c_funloc(relay)
      call_options%user = c_loc(user)
    end if
    status = c_d1rc_new(mesh%get(), call_options, handle)
    if (status >= 0) call surface%take(handle)
    call conclude(status, stat, errmsg)
  end subroutine

  !> Whether pairs(2,n) are none, or count from 0.
  logical function refuse_pairs(pairs, name, stat, errmsg) result(refused)
    integer(c_int32_t), intent(in) :: pairs(:, :)
    character(*), intent(in) :: name
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    refused = refuse_extent(size(pairs, 1, c_size_t), 2_c_size_t, "the first extent of " // name, stat, errmsg)
    if (.not. refused) refused = refuse(any(pairs < 1), PLANISH_STATUS_INDEX, name // " count from 1", stat, errmsg)
  end function

  !> The degree; 0 for surfaces of other kinds.
  pure integer function planish_d1rc_degree(surface) result(degree)
    class(planish_surface_t), intent(in) :: surface
    degree = int(c_d1rc_degree(surface%get()))
  end function

  !> Replaces the sharp edges, sharp_edges(2,n), and the corners; control points count from 1.
  subroutine planish_d1rc_set_sharp_edges(surface, sharp_edges, corners, stat, errmsg)
    class(planish_surface_t), intent(inout) :: surface
    integer(c_int32_t), intent(in) :: sharp_edges(:, :)
    integer(c_int32_t), intent(in), optional :: corners(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int32_t), allocatable :: fixed(:)
    if (refuse_pairs(sharp_edges, "sharp_edges", stat, errmsg)) return
    allocate (fixed(0))
    if (present(corners)) then
      if (refuse(any(corners < 1), PLANISH_STATUS_INDEX, "corners count from 1", stat, errmsg)) return
      fixed = corners - 1
    end if
    call conclude(c_d1rc_set_sharp_edges(surface%get(), sharp_edges - 1, size(sharp_edges, 2, c_size_t), fixed, &
        size(fixed, kind=c_size_t)), stat, errmsg)
  end subroutine

  !> The sharp edges, sharp_edges(2,n), those found by their angle included; control points count from 1.
  subroutine planish_d1rc_copy_sharp_edges(surface, sharp_edges, stat, errmsg)
    class(planish_surface_t), intent(in) :: surface
    integer(c_int32_t), allocatable, intent(inout) :: sharp_edges(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int32_t), allocatable :: found(:, :)
    integer(c_size_t) :: count
    integer(c_int) :: status
    status = c_d1rc_copy_sharp_edges(surface%get(), count=0_c_size_t, out_count=count)
    if (status >= 0) then
      allocate (found(2, count))
      status = c_d1rc_copy_sharp_edges(surface%get(), found, count, count)
      sharp_edges = found + 1
    end if
    call conclude(status, stat, errmsg)
  end subroutine

  !> points(dim,n) of the control points in the order of the control mesh: n at least coefficient_count().
  subroutine planish_d1rc_copy_control_points(surface, points, stat, errmsg)
    class(planish_surface_t), intent(in) :: surface
    real(c_double), intent(inout), contiguous :: points(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (refuse_dim(surface%dim(), size(points, 1, c_size_t), "points", stat, errmsg)) return
    call conclude(c_d1rc_copy_control_points(surface%get(), points, size(points, 2, c_size_t)), stat, errmsg)
  end subroutine

  !> Moves control points, which count from 1, to points(dim,n).
  subroutine planish_d1rc_set_control_points(surface, vertices, points, stat, errmsg)
    class(planish_surface_t), intent(inout) :: surface
    integer(c_int32_t), intent(in) :: vertices(:)
    real(c_double), intent(in), contiguous :: points(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (refuse_dim(surface%dim(), size(points, 1, c_size_t), "points", stat, errmsg)) return
    if (refuse_extent(size(points, 2, c_size_t), size(vertices, kind=c_size_t), "the second extent of points", &
        stat, errmsg)) return
    if (refuse(any(vertices < 1), PLANISH_STATUS_INDEX, "vertices count from 1", stat, errmsg)) return
    call conclude(c_d1rc_set_control_points(surface%get(), vertices - 1, size(vertices, kind=c_size_t), points), &
        stat, errmsg)
  end subroutine

  !> How often the surface is differentiable across edges(2,n), for knots in general position: orders(n).
  subroutine planish_d1rc_edge_continuity(surface, edges, orders, stat, errmsg)
    class(planish_surface_t), intent(in) :: surface
    integer(c_int32_t), intent(in) :: edges(:, :)
    integer(c_int32_t), intent(inout), contiguous :: orders(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (refuse_pairs(edges, "edges", stat, errmsg)) return
    if (refuse_short(size(orders, kind=c_size_t), size(edges, 2, c_size_t), "orders", stat, errmsg)) return
    call conclude(c_d1rc_edge_continuity(surface%get(), edges - 1, size(edges, 2, c_size_t), orders), stat, errmsg)
  end subroutine

  !> The faces of the control mesh whose surface moves with a control point; all count from 1.
  subroutine planish_d1rc_copy_influence(surface, vertex, faces, stat, errmsg)
    class(planish_surface_t), intent(in) :: surface
    integer, intent(in) :: vertex
    integer(c_int32_t), allocatable, intent(inout) :: faces(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int32_t), allocatable :: found(:)
    integer(c_size_t) :: count
    integer(c_int) :: status
    if (refuse(vertex < 1, PLANISH_STATUS_INDEX, "vertices count from 1", stat, errmsg)) return
    status = c_d1rc_copy_influence(surface%get(), vertex - 1_c_int32_t, count=0_c_size_t, out_count=count)
    if (status >= 0) then
      allocate (found(count))
      status = c_d1rc_copy_influence(surface%get(), vertex - 1_c_int32_t, found, count, count)
      faces = found + 1
    end if
    call conclude(status, stat, errmsg)
  end subroutine

  !> The share of one control point, counted from 1, at uv(2,n): values(n).
  subroutine planish_d1rc_blending_values(surface, vertex, uv, values, stat, errmsg)
    class(planish_surface_t), intent(in) :: surface
    integer, intent(in) :: vertex
    real(c_double), intent(in), contiguous :: uv(:, :)
    real(c_double), intent(inout), contiguous :: values(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (refuse(vertex < 1, PLANISH_STATUS_INDEX, "vertices count from 1", stat, errmsg)) return
    if (refuse_extent(size(uv, 1, c_size_t), 2_c_size_t, "the first extent of uv", stat, errmsg)) return
    if (refuse_short(size(values, kind=c_size_t), size(uv, 2, c_size_t), "values", stat, errmsg)) return
    call conclude(c_d1rc_blending_values(surface%get(), vertex - 1_c_int32_t, uv, size(uv, 2, c_size_t), values), &
        stat, errmsg)
  end subroutine

  !> Number of knots, those beyond the border included; 0 for surfaces of other kinds.
  pure integer(c_size_t) function planish_d1rc_knot_count(surface) result(count)
    class(planish_surface_t), intent(in) :: surface
    count = c_d1rc_knot_count(surface%get())
  end function

  !> uv(2,n) of the knots, first those of the control mesh: n at least planish_d1rc_knot_count().
  subroutine planish_d1rc_copy_knots(surface, uv, stat, errmsg)
    class(planish_surface_t), intent(in) :: surface
    real(c_double), intent(inout), contiguous :: uv(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (refuse_extent(size(uv, 1, c_size_t), 2_c_size_t, "the first extent of uv", stat, errmsg)) return
    call conclude(c_d1rc_copy_knots(surface%get(), uv, size(uv, 2, c_size_t)), stat, errmsg)
  end subroutine

  !> Number of functions; 0 for surfaces of other kinds.
  pure integer(c_size_t) function planish_d1rc_configuration_count(surface) result(count)
    class(planish_surface_t), intent(in) :: surface
    count = c_d1rc_configuration_count(surface%get())
  end function

  !> What a function is made of: knots(degree) and edges(2,n) around them; functions and knots count from 1.
  subroutine planish_d1rc_copy_configuration(surface, index, knots, edges, stat, errmsg)
    class(planish_surface_t), intent(in) :: surface
    integer, intent(in) :: index
    integer(c_int32_t), allocatable, intent(inout) :: knots(:), edges(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int32_t), allocatable :: found(:), around(:, :)
    integer(c_size_t) :: count
    integer(c_int) :: status
    if (refuse(index < 1, PLANISH_STATUS_INDEX, "configurations count from 1", stat, errmsg)) return
    status = c_d1rc_copy_configuration(surface%get(), index - 1_c_size_t, count=0_c_size_t, out_count=count)
    if (status >= 0) then
      allocate (found(planish_d1rc_degree(surface)), around(2, count))
      status = c_d1rc_copy_configuration(surface%get(), index - 1_c_size_t, found, around, count, count)
      knots = found + 1
      edges = around + 1
    end if
    call conclude(status, stat, errmsg)
  end subroutine

  ! ---------------------------------------------------------------------------------------------------------
  ! Field fitter
  ! ---------------------------------------------------------------------------------------------------------

  !> Makes a fitter for fields on the nodes of a mesh, which may go afterwards.
  !>
  !> parameterize:  how a mesh without parameters gets them.
  !> weights:       a positive number for each node, in place of 1.
  !> mask:          whether fields have values at a node; those of others are never looked at.
  !> sample_values: (dim,n), a field for which grid and smoothing are found that meet the tolerance.
  !> progress:      hears how far the making is, and may cancel it.
  subroutine field_fitter_new_mesh( &
      self, mesh, options, parameterize, weights, mask, sample_values, progress, stat, errmsg)
    class(planish_field_fitter_t), intent(inout) :: self
    class(planish_mesh_t), intent(in) :: mesh
    type(planish_field_options), intent(in), optional :: options
    type(planish_parameterize_options), intent(in), optional :: parameterize
    real(c_double), intent(in), optional, target, contiguous :: weights(:), sample_values(:, :)
    logical, intent(in), optional :: mask(:)
    procedure(planish_progress), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_field_options) :: call_options
    type(planish_parameterize_options), target :: map
    type(listener), target :: user
    integer(c_int8_t), allocatable, target :: has_values(:)
    type(c_ptr) :: handle
    integer(c_int) :: status
    if (present(options)) call_options = options
    if (refuse_nodes(call_options, map, user, has_values, mesh%point_count(), parameterize, weights, mask, &
        sample_values, progress, stat, errmsg)) return
    status = c_field_fitter_new(mesh%get(), call_options, handle)
    if (status >= 0) call self%take(handle)
    call conclude(status, stat, errmsg)
  end subroutine

  !> The same for fields on the nodes of the mesh that a model of patches was fitted to; fit() then gives a model of
  !> dimension dim.
  subroutine field_fitter_new_model( &
      self, model, mesh, options, weights, mask, sample_values, progress, stat, errmsg)
    class(planish_field_fitter_t), intent(inout) :: self
    class(planish_model_t), intent(in) :: model
    class(planish_mesh_t), intent(in) :: mesh
    type(planish_field_options), intent(in), optional :: options
    real(c_double), intent(in), optional, target, contiguous :: weights(:), sample_values(:, :)
    logical, intent(in), optional :: mask(:)
    procedure(planish_progress), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_field_options) :: call_options
    type(planish_parameterize_options), target :: map
    type(listener), target :: user
    integer(c_int8_t), allocatable, target :: has_values(:)
    type(c_ptr) :: handle
    integer(c_int) :: status
    if (present(options)) call_options = options
    if (refuse_nodes(call_options, map, user, has_values, mesh%point_count(), weights=weights, mask=mask, &
        sample_values=sample_values, progress=progress, stat=stat, errmsg=errmsg)) return
    status = c_field_fitter_new_model(model%get(), mesh%get(), call_options, handle)
    if (status >= 0) call self%take(handle)
    call conclude(status, stat, errmsg)
  end subroutine

  !> The same for fields at parameters uv(2,n).
  subroutine field_fitter_new_points(self, uv, options, weights, mask, sample_values, progress, stat, errmsg)
    class(planish_field_fitter_t), intent(inout) :: self
    real(c_double), intent(in), contiguous :: uv(:, :)
    type(planish_field_options), intent(in), optional :: options
    real(c_double), intent(in), optional, target, contiguous :: weights(:), sample_values(:, :)
    logical, intent(in), optional :: mask(:)
    procedure(planish_progress), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_field_options) :: call_options
    type(planish_parameterize_options), target :: map
    type(listener), target :: user
    integer(c_int8_t), allocatable, target :: has_values(:)
    type(c_ptr) :: handle
    integer(c_size_t) :: count
    integer(c_int) :: status
    count = size(uv, 2, c_size_t)
    if (present(options)) call_options = options
    if (refuse_extent(size(uv, 1, c_size_t), 2_c_size_t, "the first extent of uv", stat, errmsg)) return
    if (refuse_nodes(call_options, map, user, has_values, count, weights=weights, mask=mask, &
        sample_values=sample_values, progress=progress, stat=stat, errmsg=errmsg)) return
    status = c_field_fitter_new_points(uv, count, call_options, handle)
    if (status >= 0) call self%take(handle)
    call conclude(status, stat, errmsg)
  end subroutine

  !> Leads the options of a fitter to its optional arguments, and refuses those that are not for `count` nodes.
  logical function refuse_nodes(options, map, user, has_values, count, parameterize, weights, mask, sample_values, &
      progress, stat, errmsg) result(refused)
    type(planish_field_options), intent(inout) :: options
    type(planish_parameterize_options), intent(inout), target :: map
    type(listener), intent(inout), target :: user
    integer(c_int8_t), allocatable, intent(out), target :: has_values(:)
    integer(c_size_t), intent(in) :: count
    type(planish_parameterize_options), intent(in), optional :: parameterize
    real(c_double), intent(in), optional, target, contiguous :: weights(:), sample_values(:, :)
    logical, intent(in), optional :: mask(:)
    procedure(planish_progress), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_tensor_options) :: data
    refused = .true.
    if (refuse_data(data, map, user, count, parameterize, weights, progress=progress, stat=stat, errmsg=errmsg)) return
    options%parameterize = data%parameterize
    options%weights = data%weights
    options%progress = data%progress
    options%user = data%user
    if (present(mask)) then
      if (refuse_extent(size(mask, kind=c_size_t), count, "the number of elements of mask", stat, errmsg)) return
      has_values = merge(1_c_int8_t, 0_c_int8_t, mask)
      options%mask = c_loc(has_values)
    end if
    if (present(sample_values)) then
      if (refuse_extent(size(sample_values, 2, c_size_t), count, "the number of sample_values", stat, errmsg)) return
      options%sample_values = c_loc(sample_values)
      options%sample_dim = size(sample_values, 1, c_size_t)
    end if
    refused = .false.
  end function

  impure elemental subroutine field_fitter_assign(self, other)
    class(planish_field_fitter_t), intent(inout) :: self
    class(planish_field_fitter_t), intent(in) :: other
    if (allocated(other%owner)) call fail(PLANISH_STATUS_INVALID_ARGUMENT, "a field fitter has no copies")
    call self%free()
  end subroutine

  subroutine finalize_field_fitter(self)
    type(field_fitter_owner), intent(inout) :: self
    call c_field_fitter_free(self%handle)
    self%handle = c_null_ptr
  end subroutine

  !> Frees the fitter before the variable ends.
  subroutine field_fitter_free(self)
    class(planish_field_fitter_t), intent(inout) :: self
    if (allocated(self%owner)) deallocate (self%owner)
  end subroutine

  !> The handle, for C; it stays this fitter's.
  pure type(c_ptr) function field_fitter_get(self) result(handle)
    class(planish_field_fitter_t), intent(in) :: self
    handle = c_null_ptr
    if (allocated(self%owner)) handle = self%owner%handle
  end function

  !> Takes over a handle of C, which is freed by this fitter from now on.
  subroutine field_fitter_take(self, handle)
    class(planish_field_fitter_t), intent(inout) :: self
    type(c_ptr), intent(in) :: handle
    call self%free()
    if (.not. c_associated(handle)) return
    allocate (self%owner)
    self%owner%handle = handle
  end subroutine

  !> Number of nodes, those without values included.
  pure integer(c_size_t) function field_fitter_point_count(self) result(count)
    class(planish_field_fitter_t), intent(in) :: self
    count = c_field_fitter_point_count(self%get())
  end function

  !> Knots of the grid along u and v.
  subroutine field_fitter_grid(self, grid, stat, errmsg)
    class(planish_field_fitter_t), intent(in) :: self
    integer(c_size_t), intent(inout) :: grid(2)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call conclude(c_field_fitter_grid(self%get(), grid), stat, errmsg)
  end subroutine

  !> uv(2,n) of the nodes: n at least point_count().
  subroutine field_fitter_copy_parameters(self, uv, stat, errmsg)
    class(planish_field_fitter_t), intent(in) :: self
    real(c_double), intent(inout), contiguous :: uv(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (refuse_extent(size(uv, 1, c_size_t), 2_c_size_t, "the first extent of uv", stat, errmsg)) return
    call conclude(c_field_fitter_copy_parameters(self%get(), uv, size(uv, 2, c_size_t)), stat, errmsg)
  end subroutine

  !> Fits a surface to values(dim,n), one a node. report: receives how good it is; without it nothing is measured.
  subroutine field_fitter_fit_rows(self, values, surface, report, stat, errmsg)
    class(planish_field_fitter_t), intent(in) :: self
    real(c_double), intent(in), contiguous :: values(:, :)
    class(planish_surface_t), intent(inout) :: surface
    type(planish_fit_report), intent(inout), optional :: report
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: handle
    integer(c_int) :: status
    status = c_field_fitter_fit( &
        self%get(), values, size(values, 2, c_size_t), size(values, 1, c_size_t), handle, report)
    if (status >= 0) call surface%take(handle)
    call conclude_fit(status, report, stat, errmsg)
  end subroutine

  !> Fits values(dim,n), one a node, over the faces of a model: field is a model of dimension dim.
  subroutine field_fitter_fit_model(self, values, field, report, stat, errmsg)
    class(planish_field_fitter_t), intent(in) :: self
    real(c_double), intent(in), contiguous :: values(:, :)
    class(planish_model_t), intent(inout) :: field
    type(planish_fit_report), intent(inout), optional :: report
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: handle
    integer(c_int) :: status
    status = c_field_fitter_fit_model( &
        self%get(), values, size(values, 2, c_size_t), size(values, 1, c_size_t), handle, report)
    if (status >= 0) call field%take(handle)
    call conclude_fit(status, report, stat, errmsg)
  end subroutine

  !> The same for numbers, values(n).
  subroutine field_fitter_fit_scalars(self, values, surface, report, stat, errmsg)
    class(planish_field_fitter_t), intent(in) :: self
    real(c_double), intent(in), contiguous, target :: values(:)
    class(planish_surface_t), intent(inout) :: surface
    type(planish_fit_report), intent(inout), optional :: report
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    real(c_double), pointer, contiguous :: rows(:, :)
    rows(1:1, 1:size(values)) => values
    call self%fit(rows, surface, report, stat, errmsg)
  end subroutine

  !> Turns a surface of fit() into the one of other values(dim,n), in its place.
  subroutine field_fitter_update_rows(self, surface, values, stat, errmsg)
    class(planish_field_fitter_t), intent(in) :: self
    class(planish_surface_t), intent(inout) :: surface
    real(c_double), intent(in), contiguous :: values(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call conclude(c_field_fitter_update( &
        self%get(), surface%get(), values, size(values, 2, c_size_t), size(values, 1, c_size_t)), stat, errmsg)
  end subroutine

  !> The same for numbers, values(n).
  subroutine field_fitter_update_scalars(self, surface, values, stat, errmsg)
    class(planish_field_fitter_t), intent(in) :: self
    class(planish_surface_t), intent(inout) :: surface
    real(c_double), intent(in), contiguous, target :: values(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    real(c_double), pointer, contiguous :: rows(:, :)
    rows(1:1, 1:size(values)) => values
    call self%update(surface, rows, stat, errmsg)
  end subroutine

  ! ---------------------------------------------------------------------------------------------------------
  ! Layout
  ! ---------------------------------------------------------------------------------------------------------

  !> Makes a layout of quads with these corners(4,n), counter-clockwise seen from outside; vertices count from 1.
  !>
  !> edges: (4,n), the number of the edge of each side, where two edges join the same vertices.
  subroutine layout_new(self, corners, edges, stat, errmsg)
    class(planish_layout_t), intent(inout) :: self
    integer(c_int32_t), intent(in) :: corners(:, :)
    integer(c_int32_t), intent(in), optional, target, contiguous :: edges(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_layout_options) :: options
    type(c_ptr) :: handle
    integer(c_int) :: status
    if (refuse_extent(size(corners, 1, c_size_t), 4_c_size_t, "the first extent of corners", stat, errmsg)) return
    if (present(edges)) then
      if (refuse_extent(size(edges, kind=c_size_t), size(corners, kind=c_size_t), "the size of edges", stat, errmsg)) &
          return
      options%edges = c_loc(edges)
    end if
    status = c_layout_new(corners - 1, size(corners, 2, c_size_t), options, handle)
    if (status >= 0) call self%take(handle)
    call conclude(status, stat, errmsg)
  end subroutine

  !> Makes the layout of the six faces of a cube.
  subroutine layout_cube(self, stat, errmsg)
    class(planish_layout_t), intent(inout) :: self
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: handle
    integer(c_int) :: status
    status = c_layout_cube(handle)
    if (status >= 0) call self%take(handle)
    call conclude(status, stat, errmsg)
  end subroutine

  !> Makes a layout for a closed mesh of one component and any genus, with the places of its nodes.
  subroutine layout_of_mesh(self, mesh, options, report, progress, stat, errmsg)
    class(planish_layout_t), intent(inout) :: self
    class(planish_mesh_t), intent(in) :: mesh
    type(planish_mesh_layout_options), intent(in), optional :: options
    type(planish_mesh_layout_report), intent(inout), optional :: report
    procedure(planish_progress), optional :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_mesh_layout_options) :: call_options
    type(listener), target :: user
    type(c_ptr) :: handle
    integer(c_int) :: status
    if (present(options)) call_options = options
    if (present(progress)) then
      user%hear => progress
      call_options%progress = c_funloc(relay)
      call_options%user = c_loc(user)
    end if
    status = c_layout_of_mesh(mesh%get(), call_options, handle, report)
    if (status >= 0) call self%take(handle)
    call conclude(status, stat, errmsg)
  end subroutine

  impure elemental subroutine layout_assign(self, other)
    class(planish_layout_t), intent(inout) :: self
    class(planish_layout_t), intent(in) :: other
    if (allocated(other%owner)) call fail(PLANISH_STATUS_INVALID_ARGUMENT, "a layout has no copies")
    call self%free()
  end subroutine

  subroutine finalize_layout(self)
    type(layout_owner), intent(inout) :: self
    call c_layout_free(self%handle)
    self%handle = c_null_ptr
  end subroutine

  !> Frees the layout before the variable ends.
  subroutine layout_free(self)
    class(planish_layout_t), intent(inout) :: self
    if (allocated(self%owner)) deallocate (self%owner)
  end subroutine

  !> The handle, for C; it stays this layout's.
  pure type(c_ptr) function layout_get(self) result(handle)
    class(planish_layout_t), intent(in) :: self
    handle = c_null_ptr
    if (allocated(self%owner)) handle = self%owner%handle
  end function

  !> Takes over a handle of C, which is freed by this layout from now on.
  subroutine layout_take(self, handle)
    class(planish_layout_t), intent(inout) :: self
    type(c_ptr), intent(in) :: handle
    call self%free()
    if (.not. c_associated(handle)) return
    allocate (self%owner)
    self%owner%handle = handle
  end subroutine

  !> Number of quads.
  pure integer(c_size_t) function layout_quad_count(self) result(count)
    class(planish_layout_t), intent(in) :: self
    count = c_layout_quad_count(self%get())
  end function

  !> Largest number of a vertex.
  pure integer(c_size_t) function layout_vertex_count(self) result(count)
    class(planish_layout_t), intent(in) :: self
    count = c_layout_vertex_count(self%get())
  end function

  !> Number of edges.
  pure integer(c_size_t) function layout_edge_count(self) result(count)
    class(planish_layout_t), intent(in) :: self
    count = c_layout_edge_count(self%get())
  end function

  !> Number of nodes with places; 0 if the layout was not made for a mesh.
  pure integer(c_size_t) function layout_node_count(self) result(count)
    class(planish_layout_t), intent(in) :: self
    count = c_layout_node_count(self%get())
  end function

  !> The corners(4,n) of the quads, at (0,0), (1,0), (1,1), (0,1); vertices count from 1.
  subroutine layout_copy_corners(self, corners, stat, errmsg)
    class(planish_layout_t), intent(in) :: self
    integer(c_int32_t), intent(inout), contiguous :: corners(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int) :: status
    if (refuse_extent(size(corners, 1, c_size_t), 4_c_size_t, "the first extent of corners", stat, errmsg)) return
    status = c_layout_copy_corners(self%get(), corners, size(corners, 2, c_size_t))
    if (status >= 0) corners(:, :self%quad_count()) = corners(:, :self%quad_count()) + 1
    call conclude(status, stat, errmsg)
  end subroutine

  !> The edges(6,n): two vertices, the quad and the side that run this way, the quad and the side that run the other way,
  !> which are 0 at a border; all count from 1.
  subroutine layout_copy_edges(self, edges, stat, errmsg)
    class(planish_layout_t), intent(in) :: self
    integer(c_int32_t), intent(inout), contiguous :: edges(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int) :: status
    if (refuse_extent(size(edges, 1, c_size_t), 6_c_size_t, "the first extent of edges", stat, errmsg)) return
    status = c_layout_copy_edges(self%get(), edges, size(edges, 2, c_size_t))
    if (status >= 0) edges(:, :self%edge_count()) = edges(:, :self%edge_count()) + 1
    call conclude(status, stat, errmsg)
  end subroutine

  !> The number of quads around each vertex.
  subroutine layout_copy_valences(self, valences, stat, errmsg)
    class(planish_layout_t), intent(in) :: self
    integer(c_int32_t), intent(inout), contiguous :: valences(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call conclude(c_layout_copy_valences(self%get(), valences, size(valences, kind=c_size_t)), stat, errmsg)
  end subroutine

  !> Where the nodes of the mesh lie: their quads, which count from 1, 0 for a node without triangles, and uv(2,n) there.
  subroutine layout_copy_node_map(self, quads, uv, stat, errmsg)
    class(planish_layout_t), intent(in) :: self
    integer(c_int32_t), intent(inout), contiguous :: quads(:)
    real(c_double), intent(inout), contiguous :: uv(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int) :: status
    if (refuse_extent(size(uv, 1, c_size_t), 2_c_size_t, "the first extent of uv", stat, errmsg)) return
    if (refuse_extent(size(uv, 2, c_size_t), size(quads, kind=c_size_t), "the second extent of uv", stat, errmsg)) return
    status = c_layout_copy_node_map(self%get(), quads, uv, size(quads, kind=c_size_t))
    if (status >= 0) quads(:self%node_count()) = quads(:self%node_count()) + 1
    call conclude(status, stat, errmsg)
  end subroutine

  ! ---------------------------------------------------------------------------------------------------------
  ! Transfer
  ! ---------------------------------------------------------------------------------------------------------

  !> Makes a transfer from the nodes of a mesh to targets(3,n); both may go afterwards.
  !>
  !> field:  how fields on the source are fitted; the arguments after it are those of field_fitter%new().
  !> report: receives how well the two lie on one another.
  subroutine transfer_new(self, source, targets, options, field, parameterize, weights, mask, sample_values, &
      progress, report, stat, errmsg)
    class(planish_transfer_t), intent(inout) :: self
    class(planish_mesh_t), intent(in) :: source
    real(c_double), intent(in), contiguous :: targets(:, :)
    type(planish_transfer_options), intent(in), optional :: options
    type(planish_field_options), intent(in), optional :: field
    type(planish_parameterize_options), intent(in), optional :: parameterize
    real(c_double), intent(in), optional, target, contiguous :: weights(:), sample_values(:, :)
    logical, intent(in), optional :: mask(:)
    procedure(planish_progress), optional :: progress
    type(planish_transfer_report), intent(inout), optional :: report
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_transfer_options) :: call_options
    type(planish_field_options), target :: field_options
    type(planish_parameterize_options), target :: map
    type(listener), target :: user
    integer(c_int8_t), allocatable, target :: has_values(:)
    type(c_ptr) :: handle
    integer(c_int) :: status
    if (present(options)) call_options = options
    if (present(field)) field_options = field
    if (refuse_extent(size(targets, 1, c_size_t), 3_c_size_t, "the first extent of targets", stat, errmsg)) return
    if (refuse_nodes(field_options, map, user, has_values, source%point_count(), parameterize, weights, mask, &
        sample_values, progress, stat, errmsg)) return
    call_options%field = c_loc(field_options)
    status = c_transfer_new(source%get(), targets, size(targets, 2, c_size_t), call_options, handle, report)
    if (status >= 0) call self%take(handle)
    if (status >= 0 .and. present(report)) report%farthest_index = report%farthest_index + 1
    call conclude(status, stat, errmsg)
  end subroutine

  !> The same from the nodes of the mesh that a model of patches was fitted to.
  subroutine transfer_new_model(self, model, source, targets, options, field, weights, mask, sample_values, &
      progress, report, stat, errmsg)
    class(planish_transfer_t), intent(inout) :: self
    class(planish_model_t), intent(in) :: model
    class(planish_mesh_t), intent(in) :: source
    real(c_double), intent(in), contiguous :: targets(:, :)
    type(planish_transfer_options), intent(in), optional :: options
    type(planish_field_options), intent(in), optional :: field
    real(c_double), intent(in), optional, target, contiguous :: weights(:), sample_values(:, :)
    logical, intent(in), optional :: mask(:)
    procedure(planish_progress), optional :: progress
    type(planish_transfer_report), intent(inout), optional :: report
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(planish_transfer_options) :: call_options
    type(planish_field_options), target :: field_options
    type(planish_parameterize_options), target :: map
    type(listener), target :: user
    integer(c_int8_t), allocatable, target :: has_values(:)
    type(c_ptr) :: handle
    integer(c_int) :: status
    if (present(options)) call_options = options
    if (present(field)) field_options = field
    if (refuse_extent(size(targets, 1, c_size_t), 3_c_size_t, "the first extent of targets", stat, errmsg)) return
    if (refuse_nodes(field_options, map, user, has_values, source%point_count(), weights=weights, mask=mask, &
        sample_values=sample_values, progress=progress, stat=stat, errmsg=errmsg)) return
    call_options%field = c_loc(field_options)
    status = c_transfer_new_model(model%get(), source%get(), targets, size(targets, 2, c_size_t), call_options, &
        handle, report)
    if (status >= 0) call self%take(handle)
    if (status >= 0 .and. present(report)) report%farthest_index = report%farthest_index + 1
    call conclude(status, stat, errmsg)
  end subroutine

  impure elemental subroutine transfer_assign(self, other)
    class(planish_transfer_t), intent(inout) :: self
    class(planish_transfer_t), intent(in) :: other
    if (allocated(other%owner)) call fail(PLANISH_STATUS_INVALID_ARGUMENT, "a transfer has no copies")
    call self%free()
  end subroutine

  subroutine finalize_transfer(self)
    type(transfer_owner), intent(inout) :: self
    call c_transfer_free(self%handle)
    self%handle = c_null_ptr
  end subroutine

  !> Frees the transfer before the variable ends.
  subroutine transfer_free(self)
    class(planish_transfer_t), intent(inout) :: self
    if (allocated(self%owner)) deallocate (self%owner)
  end subroutine

  !> The handle, for C; it stays this transfer's.
  pure type(c_ptr) function transfer_get(self) result(handle)
    class(planish_transfer_t), intent(in) :: self
    handle = c_null_ptr
    if (allocated(self%owner)) handle = self%owner%handle
  end function

  !> Takes over a handle of C, which is freed by this transfer from now on.
  subroutine transfer_take(self, handle)
    class(planish_transfer_t), intent(inout) :: self
    type(c_ptr), intent(in) :: handle
    call self%free()
    if (.not. c_associated(handle)) return
    allocate (self%owner)
    self%owner%handle = handle
  end subroutine

  !> Number of nodes of the source, those without values included.
  pure integer(c_size_t) function transfer_source_count(self) result(count)
    class(planish_transfer_t), intent(in) :: self
    count = c_transfer_source_count(self%get())
  end function

  !> Number of targets.
  pure integer(c_size_t) function transfer_target_count(self) result(count)
    class(planish_transfer_t), intent(in) :: self
    count = c_transfer_target_count(self%get())
  end function

  !> Where the targets lie on the source's surface: uv(2,n), n at least target_count().
  subroutine transfer_copy_parameters(self, uv, stat, errmsg)
    class(planish_transfer_t), intent(in) :: self
    real(c_double), intent(inout), contiguous :: uv(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (refuse_extent(size(uv, 1, c_size_t), 2_c_size_t, "the first extent of uv", stat, errmsg)) return
    call conclude(c_transfer_copy_parameters(self%get(), uv, size(uv, 2, c_size_t)), stat, errmsg)
  end subroutine

  !> How far the targets are from the source's surface.
  subroutine transfer_copy_distances(self, distances, stat, errmsg)
    class(planish_transfer_t), intent(in) :: self
    real(c_double), intent(inout), contiguous :: distances(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    call conclude(c_transfer_copy_distances(self%get(), distances, size(distances, kind=c_size_t)), stat, errmsg)
  end subroutine

  !> Values at the targets, out_values(dim,m), from values(dim,n) at the nodes of the source.
  subroutine transfer_apply_rows(self, values, out_values, stat, errmsg)
    class(planish_transfer_t), intent(in) :: self
    real(c_double), intent(in), contiguous :: values(:, :)
    real(c_double), intent(inout), contiguous :: out_values(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_size_t) :: dim
    dim = size(values, 1, c_size_t)
    if (refuse_extent(size(out_values, 1, c_size_t), dim, "the first extent of out_values", stat, errmsg)) return
    if (refuse_short(size(out_values, 2, c_size_t), self%target_count(), "out_values", stat, errmsg)) return
    call conclude(c_transfer_apply(self%get(), values, size(values, 2, c_size_t), dim, out_values), stat, errmsg)
  end subroutine

  !> The same for numbers, values(n) and out_values(m).
  subroutine transfer_apply_scalars(self, values, out_values, stat, errmsg)
    class(planish_transfer_t), intent(in) :: self
    real(c_double), intent(in), contiguous, target :: values(:)
    real(c_double), intent(inout), contiguous, target :: out_values(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    real(c_double), pointer, contiguous :: rows(:, :), out_rows(:, :)
    rows(1:1, 1:size(values)) => values
    out_rows(1:1, 1:size(out_values)) => out_values
    call self%apply(rows, out_rows, stat, errmsg)
  end subroutine

  !> Forces at the nodes of the source, out_forces(dim,n), from forces(dim,m) on the targets: the transpose of apply().
  subroutine transfer_apply_transpose_rows(self, forces, out_forces, stat, errmsg)
    class(planish_transfer_t), intent(in) :: self
    real(c_double), intent(in), contiguous :: forces(:, :)
    real(c_double), intent(inout), contiguous :: out_forces(:, :)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_size_t) :: dim
    dim = size(forces, 1, c_size_t)
    if (refuse_extent(size(out_forces, 1, c_size_t), dim, "the first extent of out_forces", stat, errmsg)) return
    if (refuse_short(size(out_forces, 2, c_size_t), self%source_count(), "out_forces", stat, errmsg)) return
    call conclude(c_transfer_apply_transpose( &
        self%get(), forces, size(forces, 2, c_size_t), dim, out_forces), stat, errmsg)
  end subroutine

  !> The same for numbers, forces(m) and out_forces(n).
  subroutine transfer_apply_transpose_scalars(self, forces, out_forces, stat, errmsg)
    class(planish_transfer_t), intent(in) :: self
    real(c_double), intent(in), contiguous, target :: forces(:)
    real(c_double), intent(inout), contiguous, target :: out_forces(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    real(c_double), pointer, contiguous :: rows(:, :), out_rows(:, :)
    rows(1:1, 1:size(forces)) => forces
    out_rows(1:1, 1:size(out_forces)) => out_forces
    call self%apply_transpose(rows, out_rows, stat, errmsg)
  end subroutine

  !> Carries displacements(3,n) one way and forces(3,m) the other, and adds up forces, moments about a point (the
  !> origin if it is left out) and work on both sides.
  subroutine transfer_balance(self, displacements, forces, report, about, stat, errmsg)
    class(planish_transfer_t), intent(in) :: self
    real(c_double), intent(in), contiguous :: displacements(:, :), forces(:, :)
    type(planish_balance_report), intent(inout) :: report
    real(c_double), intent(in), optional :: about(3)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    if (refuse_extent(size(displacements, 1, c_size_t), 3_c_size_t, "the first extent of displacements", &
        stat, errmsg)) return
    if (refuse_extent(size(forces, 1, c_size_t), 3_c_size_t, "the first extent of forces", stat, errmsg)) return
    call conclude(c_transfer_balance(self%get(), displacements, size(displacements, 2, c_size_t), forces, &
        size(forces, 2, c_size_t), about, report), stat, errmsg)
  end subroutine

end module

!> All that users see.
module planish
  use planish_records
  use planish_types
  implicit none
  public
end module
