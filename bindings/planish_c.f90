! SPDX-License-Identifier: MIT OR Apache-2.0
! Generated from src/ffi: do not edit. `cargo run -p planish-header` renews it.

!> Names and records of planish.h, which users see through the module planish. Records are the same bytes as in C, born
!> with the defaults. A pointer in one is set by an argument of the call, and indices count from 1.
module planish_records
  use, intrinsic :: iso_c_binding
  implicit none
  private

  !> Bytes of a pointer, and of a size_t.
  integer(c_size_t), parameter :: word = storage_size(0_c_size_t) / 8
  !> IEEE's infinity, which has no literal.
  real(c_double), parameter :: infinity = transfer(int(z'7FF0000000000000', c_int64_t), 1.0_c_double)

  !> The version of planish.h that this follows.
  integer(c_int32_t), parameter, public :: PLANISH_VERSION_MAJOR = 0
  integer(c_int32_t), parameter, public :: PLANISH_VERSION_MINOR = 2
  integer(c_int32_t), parameter, public :: PLANISH_VERSION_PATCH = 0

  !> The value of stretch_steps that goes on until the stretch no longer falls
  integer(c_int32_t), parameter, public :: PLANISH_UNLIMITED = -1

  !> Stands for "none" where a number of a face or shell is expected
  integer(c_int32_t), parameter, public :: PLANISH_NONE = -1

  !> What a call came to: 0 or positive is success, negative is an error.
  integer(c_int), parameter, public :: PLANISH_STATUS_OK = 0 !! All went well
  !> The surface misses the tolerance; it is the best one found
  integer(c_int), parameter, public :: PLANISH_STATUS_TOLERANCE_NOT_MET = 1
  !> The fit ended because refinement no longer lowered the error
  integer(c_int), parameter, public :: PLANISH_STATUS_STAGNATED = 2
  !> Some points lie outside the domain; their values are NaN
  integer(c_int), parameter, public :: PLANISH_STATUS_POINTS_OUTSIDE = 3
  !> The mesh is not all that was given: nodes were welded, split or passed over, triangles dropped or turned over, or
  !> texture coordinates that are no parameters left out
  integer(c_int), parameter, public :: PLANISH_STATUS_INPUT_REPAIRED = 4
  !> Some triangles are turned over or flat in the parameter plane: a surface over them may fold
  integer(c_int), parameter, public :: PLANISH_STATUS_FOLDED_PARAMETERS = 5
  !> A search could not prove that its answers are the nearest places; a flag says for which points
  integer(c_int), parameter, public :: PLANISH_STATUS_NOT_PROVEN = 6
  integer(c_int), parameter, public :: PLANISH_STATUS_NULL_POINTER = -1 !! An argument that must not be NULL is
  !> An argument or option is out of its range, or contradicts another
  integer(c_int), parameter, public :: PLANISH_STATUS_INVALID_ARGUMENT = -2
  integer(c_int), parameter, public :: PLANISH_STATUS_NOT_FINITE = -3 !! A number is NaN or infinite
  integer(c_int), parameter, public :: PLANISH_STATUS_INDEX = -4 !! An index is out of range
  integer(c_int), parameter, public :: PLANISH_STATUS_TOPOLOGY = -5 !! The mesh is not connected as the call needs it
  !> The geometry is degenerate: lengths, areas or ranges are zero
  integer(c_int), parameter, public :: PLANISH_STATUS_DEGENERATE = -6
  integer(c_int), parameter, public :: PLANISH_STATUS_OUTSIDE = -7 !! A parameter lies outside the domain
  integer(c_int), parameter, public :: PLANISH_STATUS_SINGULAR = -8 !! The data do not determine the result
  !> The call does not apply to this family of surface
  integer(c_int), parameter, public :: PLANISH_STATUS_WRONG_KIND = -9
  !> The caller's array is too short for the result
  integer(c_int), parameter, public :: PLANISH_STATUS_BUFFER_TOO_SMALL = -10
  !> A size exceeds a limit, or what memory can address
  integer(c_int), parameter, public :: PLANISH_STATUS_TOO_LARGE = -11
  integer(c_int), parameter, public :: PLANISH_STATUS_FILE = -12 !! A file cannot be opened, read or written
  !> The content of a file is not what it claims to be
  integer(c_int), parameter, public :: PLANISH_STATUS_FORMAT = -13
  !> A record has fields that this version of the library does not know, and they are not zero
  integer(c_int), parameter, public :: PLANISH_STATUS_VERSION = -14
  integer(c_int), parameter, public :: PLANISH_STATUS_CANCELLED = -15 !! The progress callback asked to stop
  !> Memory for a copy of the caller's arrays could not be had
  integer(c_int), parameter, public :: PLANISH_STATUS_OUT_OF_MEMORY = -16
  integer(c_int), parameter, public :: PLANISH_STATUS_INTERNAL = -17 !! A bug in the library

  !> What a long call is doing.
  integer(c_int32_t), parameter, public :: PLANISH_STAGE_PREPARE = 0 !! Looks at what it was given
  !> Gives a mesh its parameters, or its places on a sphere
  integer(c_int32_t), parameter, public :: PLANISH_STAGE_PARAMETERIZE = 1
  integer(c_int32_t), parameter, public :: PLANISH_STAGE_COARSEN = 2 !! Makes a mesh coarser
  integer(c_int32_t), parameter, public :: PLANISH_STAGE_LAYOUT = 3 !! Lays quadrilaterals over a mesh
  integer(c_int32_t), parameter, public :: PLANISH_STAGE_FIT = 4 !! Fits, measures and refines
  integer(c_int32_t), parameter, public :: PLANISH_STAGE_PROJECT = 5 !! Looks for the nearest places
  integer(c_int32_t), parameter, public :: PLANISH_STAGE_TESSELLATE = 6 !! Makes triangles of a surface
  integer(c_int32_t), parameter, public :: PLANISH_STAGE_CONVERT = 7 !! Makes another form of a surface
  integer(c_int32_t), parameter, public :: PLANISH_STAGE_WRITE = 8 !! Writes a file

  !> Faults that are mended when arrays or a file become a mesh.
  !> All that change no shape and need no guess: the five that follow NONE
  integer(c_int32_t), parameter, public :: PLANISH_MESH_REPAIR_SAFE = 0
  integer(c_int32_t), parameter, public :: PLANISH_MESH_REPAIR_NONE = 1 !! None
  !> Nodes that no triangle needs are kept and passed over, whatever their coordinates are
  integer(c_int32_t), parameter, public :: PLANISH_MESH_REPAIR_UNUSED_NODES = 2
  !> Triangles with a corner twice are left out, and faces of less than three corners
  integer(c_int32_t), parameter, public :: PLANISH_MESH_REPAIR_REPEATED_CORNERS = 4
  !> Of triangles with the same three nodes, whatever their orientation, only the first is kept
  integer(c_int32_t), parameter, public :: PLANISH_MESH_REPAIR_DUPLICATE_TRIANGLES = 8
  !> Nodes where the surface touches itself become one for each part; the copies come after all other nodes
  integer(c_int32_t), parameter, public :: PLANISH_MESH_REPAIR_TOUCHING_NODES = 16
  !> Triangles are turned over until neighbours agree, as few as that takes
  integer(c_int32_t), parameter, public :: PLANISH_MESH_REPAIR_ORIENTATION = 32
  !> Edges of three and more triangles are parted: sheets that meet others only there get nodes of their own
  integer(c_int32_t), parameter, public :: PLANISH_MESH_REPAIR_SHEETS = 64
  integer(c_int32_t), parameter, public :: PLANISH_MESH_REPAIR_ALL = 126 !! All of them

  !> Which parts of a mesh that hang together by edges are taken.
  integer(c_int32_t), parameter, public :: PLANISH_MESH_COMPONENTS_ALL = 0 !! All
  !> The one of most triangles; of equals the first
  integer(c_int32_t), parameter, public :: PLANISH_MESH_COMPONENTS_LARGEST = 1
  integer(c_int32_t), parameter, public :: PLANISH_MESH_COMPONENTS_ONE = 2 !! One by its number

  !> A format of mesh files.
  !> The one that the name ends in; if that says nothing, or there is no name, the one that the content begins like
  integer(c_int32_t), parameter, public :: PLANISH_MESH_FORMAT_AUTO = 0
  integer(c_int32_t), parameter, public :: PLANISH_MESH_FORMAT_OFF = 1 !! Object file format of Geomview
  integer(c_int32_t), parameter, public :: PLANISH_MESH_FORMAT_OBJ = 2 !! Wavefront OBJ
  integer(c_int32_t), parameter, public :: PLANISH_MESH_FORMAT_PLY = 3 !! Polygon file format
  integer(c_int32_t), parameter, public :: PLANISH_MESH_FORMAT_STL = 4 !! Stereolithography: triangles alone

  !> Which weights an interior node gives its neighbours.
  !> Mean value coordinates: no triangle turns over over a convex border
  integer(c_int32_t), parameter, public :: PLANISH_MAP_METHOD_MEAN_VALUE = 0
  !> Cotangents: the conformal map of a flat sheet
  integer(c_int32_t), parameter, public :: PLANISH_MAP_METHOD_HARMONIC = 1

  !> Where the longest boundary loop goes.
  !> The one of circle, square by turns, square by arc and (if `unroll` says so) free with the least L2 stretch
  integer(c_int32_t), parameter, public :: PLANISH_BORDER_AUTO = 0
  !> The circle inscribed in the unit square, spaced by chord length
  integer(c_int32_t), parameter, public :: PLANISH_BORDER_CIRCLE = 1
  !> The unit square with corners at the four sharpest turns of the loop
  integer(c_int32_t), parameter, public :: PLANISH_BORDER_SQUARE_BY_TURNS = 2
  !> The unit square with corners at each quarter of the loop's length
  integer(c_int32_t), parameter, public :: PLANISH_BORDER_SQUARE_BY_ARC = 3
  !> The unit square with the nodes `corners` at (0,0), (1,0), (1,1), (0,1)
  integer(c_int32_t), parameter, public :: PLANISH_BORDER_CORNERS = 4
  !> All boundary nodes, those of holes too, keep the parameters that the mesh has
  integer(c_int32_t), parameter, public :: PLANISH_BORDER_KEPT = 5
  !> No border at all: unrolled so that lengths are kept best, in the units of the mesh
  integer(c_int32_t), parameter, public :: PLANISH_BORDER_FREE = 6

  !> Which layout a mesh gets.
  !> The cube for closed meshes of genus 0, else the base complex
  integer(c_int32_t), parameter, public :: PLANISH_LAYOUT_KIND_AUTO = 0
  !> The six faces of a cube; for closed meshes of genus 0 only
  integer(c_int32_t), parameter, public :: PLANISH_LAYOUT_KIND_CUBE = 1
  !> Pairs of triangles of a coarse mesh that follows the shape
  integer(c_int32_t), parameter, public :: PLANISH_LAYOUT_KIND_COMPLEX = 2

  !> Things worth knowing about a map or a fit: the bits of `remarks` in reports, several may hold.
  integer(c_int64_t), parameter, public :: PLANISH_REMARK_TOLERANCE_NOT_MET = 1 !! The surface misses the tolerance
  !> The fit ended because refinement no longer lowered the error
  integer(c_int64_t), parameter, public :: PLANISH_REMARK_STAGNATED = 2
  !> Some triangles are turned over or flat in the parameter plane: the surface may fold there
  integer(c_int64_t), parameter, public :: PLANISH_REMARK_FOLDED_PARAMETERS = 4
  !> The mesh had no parameters and was parameterized first
  integer(c_int64_t), parameter, public :: PLANISH_REMARK_PARAMETERIZED = 8
  !> Given parameters were uneven and have been regularized
  integer(c_int64_t), parameter, public :: PLANISH_REMARK_REGULARIZED = 16
  !> The tolerance was below what double precision can keep and was raised
  integer(c_int64_t), parameter, public :: PLANISH_REMARK_TOLERANCE_RAISED = 32
  !> Some cells hold no data; the surface is extrapolated there
  integer(c_int64_t), parameter, public :: PLANISH_REMARK_EMPTY_CELLS = 64
  !> Between the nodes the surface departs from the facets by more than the tolerance and what the facets explain:
  !> beside sharp edges, or where it swings
  integer(c_int64_t), parameter, public :: PLANISH_REMARK_ROUGH_BETWEEN_NODES = 128
  !> The map is so compressed that one chart is the wrong tool: cut the mesh into several
  integer(c_int64_t), parameter, public :: PLANISH_REMARK_SEGMENTATION_ADVISED = 256
  !> The data do not determine the beam energy's null space; the plate energy was used instead
  integer(c_int64_t), parameter, public :: PLANISH_REMARK_PLATE_ENERGY_USED = 512
  !> Triangles of the mesh, or of the triangulated model, cross each other
  integer(c_int64_t), parameter, public :: PLANISH_REMARK_SELF_INTERSECTING = 1024
  !> Points that lay on the one before them in their row have been merged with it
  integer(c_int64_t), parameter, public :: PLANISH_REMARK_MERGED_POINTS = 1048576
  !> A row looks reversed or shifted against the one before it: see align in planish_skin_options
  integer(c_int64_t), parameter, public :: PLANISH_REMARK_TWISTED_ROWS = 2097152
  !> Some rows are much nearer to one another than to the next: control curves overshoot
  integer(c_int64_t), parameter, public :: PLANISH_REMARK_CLUSTERED_ROWS = 4194304
  !> The end points of rows are too near to those of the next to say how far apart rows are; mean distances do
  integer(c_int64_t), parameter, public :: PLANISH_REMARK_MEAN_STEPS = 8388608
  !> Holes were closed by fans of triangles while the map was computed
  integer(c_int64_t), parameter, public :: PLANISH_REMARK_HOLES_FILLED = 65536
  !> Triangles without area in space were left out of the map's weights
  integer(c_int64_t), parameter, public :: PLANISH_REMARK_ZERO_AREA_TRIANGLES = 131072

  !> Why a fit ended.
  integer(c_int32_t), parameter, public :: PLANISH_STOP_REASON_TOLERANCE_MET = 0 !! The tolerance is met
  !> The caller fixed the grid, so there was nothing to refine
  integer(c_int32_t), parameter, public :: PLANISH_STOP_REASON_FIXED_GRID = 1
  !> The limit on grid or coefficients is reached
  integer(c_int32_t), parameter, public :: PLANISH_STOP_REASON_LIMIT = 2
  !> There would be more coefficients than data
  integer(c_int32_t), parameter, public :: PLANISH_STOP_REASON_DATA_EXHAUSTED = 3
  integer(c_int32_t), parameter, public :: PLANISH_STOP_REASON_STAGNATED = 4 !! Refinement no longer lowered the error

  !> The family of a surface.
  integer(c_int32_t), parameter, public :: PLANISH_KIND_NONE = 0 !! No surface: the answer for NULL
  integer(c_int32_t), parameter, public :: PLANISH_KIND_TENSOR = 1 !! Tensor product B-spline, with or without weights
  integer(c_int32_t), parameter, public :: PLANISH_KIND_TSPLINE = 2 !! T-spline with control curves
  integer(c_int32_t), parameter, public :: PLANISH_KIND_PHT = 3 !! Bicubic spline over a hierarchical T-mesh
  integer(c_int32_t), parameter, public :: PLANISH_KIND_D1RC = 4 !! Spline over a triangular control mesh

  !> What to do with points outside the domain.
  integer(c_int32_t), parameter, public :: PLANISH_OUTSIDE_FAIL = 0 !! Refuse all points, before one value is written
  !> NaN and a flag; the call returns PLANISH_STATUS_POINTS_OUTSIDE
  integer(c_int32_t), parameter, public :: PLANISH_OUTSIDE_FLAG = 1
  !> The polynomial at the domain's end is continued, and the point flagged
  integer(c_int32_t), parameter, public :: PLANISH_OUTSIDE_EXTRAPOLATE = 2

  !> Flags of a point: bits of the elements of out_flags.
  integer(c_int8_t), parameter, public :: PLANISH_FLAG_OUTSIDE_DOMAIN = 1 !! The parameters lie outside the domain
  !> The point lies outside the trims: in a hole, or beyond the boundary of the data
  integer(c_int8_t), parameter, public :: PLANISH_FLAG_OUTSIDE_TRIMS = 2
  !> The parameters lie in the domain but beyond the box of the data: the surface is extrapolated there
  integer(c_int8_t), parameter, public :: PLANISH_FLAG_IN_BUFFER = 4
  !> The surface has no normal there, so that normal and curvatures are NaN
  integer(c_int8_t), parameter, public :: PLANISH_FLAG_NO_NORMAL = 8
  !> The answer for the point is not proved: the distance is that of a place on the surface, and the least one may be
  !> smaller
  integer(c_int8_t), parameter, public :: PLANISH_FLAG_NOT_PROVEN = 16

  !> Whether the fit of a mesh's shape is its own mirror image.
  integer(c_int32_t), parameter, public :: PLANISH_SYMMETRY_NONE = 0 !! As it comes
  integer(c_int32_t), parameter, public :: PLANISH_SYMMETRY_ABOUT = 1 !! About a plane that is given
  !> About the plane for which the mesh is nearest to its image
  integer(c_int32_t), parameter, public :: PLANISH_SYMMETRY_FOUND = 2

  !> What a tolerance is measured in.
  !> The diagonal of the data's bounding box; for a field, of the box of its values
  integer(c_int32_t), parameter, public :: PLANISH_TOLERANCE_SCALE_RELATIVE = 0
  integer(c_int32_t), parameter, public :: PLANISH_TOLERANCE_SCALE_ABSOLUTE = 1 !! Model units

  !> What the values of points and fields mean that are NaN.
  integer(c_int32_t), parameter, public :: PLANISH_MISSING_REFUSED = 0 !! A mistake: PLANISH_STATUS_NOT_FINITE
  !> There is none: the datum is passed over, and its error is NaN
  integer(c_int32_t), parameter, public :: PLANISH_MISSING_SKIPPED = 1

  !> Where the knot lines of a tensor fit stand.
  !> Where the error asks for them: lines are inserted and taken out one by one
  integer(c_int32_t), parameter, public :: PLANISH_KNOTS_ADAPTIVE = 0
  !> At equal distances: all cells are halved in one direction at a time
  integer(c_int32_t), parameter, public :: PLANISH_KNOTS_UNIFORM = 1

  !> Which equations determine a tensor surface on a grid.
  !> Least squares in the spline space
  integer(c_int32_t), parameter, public :: PLANISH_TENSOR_METHOD_LEAST_SQUARES = 0
  !> The equations of Dannenhoffer and Haimes, 2009: less accurate on fine grids, for comparison
  integer(c_int32_t), parameter, public :: PLANISH_TENSOR_METHOD_FERGUSON = 1

  !> What happens at the ends of the knots.
  integer(c_int32_t), parameter, public :: PLANISH_ENDS_NATURAL = 0 !! Zero curvature across the ends
  integer(c_int32_t), parameter, public :: PLANISH_ENDS_FREE = 1 !! Two more unknowns a direction

  !> Which second derivatives cost energy.
  integer(c_int32_t), parameter, public :: PLANISH_ENERGY_BEAM = 0 !! Elastic beams along the knot lines
  integer(c_int32_t), parameter, public :: PLANISH_ENERGY_PLATE = 1 !! An elastic plate over the cells

  !> What to do with parameters that came with a mesh.
  !> Even them out if they are uneven and it helps
  integer(c_int32_t), parameter, public :: PLANISH_REGULARIZE_AUTO = 0
  integer(c_int32_t), parameter, public :: PLANISH_REGULARIZE_NEVER = 1 !! Take them as they are
  integer(c_int32_t), parameter, public :: PLANISH_REGULARIZE_ALWAYS = 2 !! Even them out

  !> A parameter direction.
  integer(c_int32_t), parameter, public :: PLANISH_AXIS_U = 0 !! The first parameter
  integer(c_int32_t), parameter, public :: PLANISH_AXIS_V = 1 !! The second parameter

  !> What happens to targets beyond max_distance.
  !> The first of them is an error, PLANISH_STATUS_OUTSIDE
  integer(c_int32_t), parameter, public :: PLANISH_FAR_RULE_REFUSE = 0
  !> They take part like all others; the call returns PLANISH_STATUS_POINTS_OUTSIDE
  integer(c_int32_t), parameter, public :: PLANISH_FAR_RULE_KEEP = 1

  !> What the rows of planish_mesh_sample_rows() lie between.
  integer(c_int32_t), parameter, public :: PLANISH_ROW_SOURCE_LOOP = 0 !! A boundary loop
  integer(c_int32_t), parameter, public :: PLANISH_ROW_SOURCE_NODE = 1 !! A node

  !> Which energy of a surface is lowered.
  integer(c_int32_t), parameter, public :: PLANISH_FAIRNESS_THIN_PLATE = 0 !! Bending: flat is best
  !> Change of bending: round is as good as flat
  integer(c_int32_t), parameter, public :: PLANISH_FAIRNESS_CURVATURE_VARIATION = 1

  !> What of the border of a surface's domain stays as it is.
  integer(c_int32_t), parameter, public :: PLANISH_KEPT_BORDER_NONE = 0 !! Nothing
  integer(c_int32_t), parameter, public :: PLANISH_KEPT_BORDER_POSITION = 1 !! Its place
  integer(c_int32_t), parameter, public :: PLANISH_KEPT_BORDER_TANGENT = 2 !! Its place and its tangent planes

  !> How far the energy of a surface is lowered where there are data.
  !> Until the surface tells each datum best from the others (generalized cross-validation): noise goes, and what is
  !> no noise stays
  integer(c_int32_t), parameter, public :: PLANISH_FAIR_LIMIT_NOISE = 0
  !> As far as the tolerance lets it: what is narrower than that allows is flattened too
  integer(c_int32_t), parameter, public :: PLANISH_FAIR_LIMIT_TOLERANCE = 1

  !> What a VTK file holds of a surface.
  !> Triangles of the part inside the trims, or of deviation_from
  integer(c_int32_t), parameter, public :: PLANISH_VTK_CONTENT_TRIANGLES = 0
  !> Its Bezier patches as cells of type VTK_BEZIER_QUADRILATERAL (VTK 9): the surface itself
  integer(c_int32_t), parameter, public :: PLANISH_VTK_CONTENT_PATCHES = 1
  !> Its control points, joined by polylines as neighbours in the control net
  integer(c_int32_t), parameter, public :: PLANISH_VTK_CONTENT_CONTROL_NET = 2

  !> The application protocol of a STEP file.
  !> AP214, automotive design: read by every CAD system
  integer(c_int32_t), parameter, public :: PLANISH_STEP_SCHEMA_AP214 = 0
  integer(c_int32_t), parameter, public :: PLANISH_STEP_SCHEMA_AP242 = 1 !! AP242, managed model-based 3D engineering

  !> What one model unit is.
  integer(c_int32_t), parameter, public :: PLANISH_UNIT_MILLIMETRE = 0 !! A millimetre
  integer(c_int32_t), parameter, public :: PLANISH_UNIT_METRE = 1 !! A metre
  integer(c_int32_t), parameter, public :: PLANISH_UNIT_INCH = 2 !! An inch, 25.4 mm

  !> What a STEP file holds of a T-spline or PHT-spline.
  integer(c_int32_t), parameter, public :: PLANISH_STEP_FORM_TENSOR = 0 !! The same surface as one tensor surface
  !> One face for each span of v, over the knots of four control curves: far fewer control points
  integer(c_int32_t), parameter, public :: PLANISH_STEP_FORM_STRIPS = 1
  !> A PHT-spline as a shell of faces that share edges, each over a rectangle of cells whose levels differ by at most
  !> level_spread
  integer(c_int32_t), parameter, public :: PLANISH_STEP_FORM_PATCHES = 2

  !> What a face lies on.
  integer(c_int32_t), parameter, public :: PLANISH_CARRIER_SPLINE = 0 !! A spline surface
  integer(c_int32_t), parameter, public :: PLANISH_CARRIER_PLANE = 1 !! A plane
  integer(c_int32_t), parameter, public :: PLANISH_CARRIER_CYLINDER = 2 !! A cylinder

  !> What a shell bounds.
  integer(c_int32_t), parameter, public :: PLANISH_SHELL_ROLE_OPEN = 0 !! Nothing: it may have edges of one face
  integer(c_int32_t), parameter, public :: PLANISH_SHELL_ROLE_SOLID = 1 !! A solid, from outside
  integer(c_int32_t), parameter, public :: PLANISH_SHELL_ROLE_VOID = 2 !! A void inside a solid

  !> What the curve of an edge is.
  integer(c_int32_t), parameter, public :: PLANISH_EDGE_SHAPE_SPLINE = 0 !! A spline
  integer(c_int32_t), parameter, public :: PLANISH_EDGE_SHAPE_LINE = 1 !! A straight line
  integer(c_int32_t), parameter, public :: PLANISH_EDGE_SHAPE_CIRCLE = 2 !! A piece of a circle
  !> A piece of an ellipse, the longer axis first
  integer(c_int32_t), parameter, public :: PLANISH_EDGE_SHAPE_ELLIPSE = 3

  !> Which way a mesh becomes a model.
  !> Exact faces where planes and cylinders explain the mesh, else patches that keep sharp edges where that serves;
  !> one chart for a mesh with one border loop and no features inside, and for other open ones where it does better
  integer(c_int32_t), parameter, public :: PLANISH_MODEL_FAMILY_AUTO = 0
  integer(c_int32_t), parameter, public :: PLANISH_MODEL_FAMILY_CHART = 1 !! One chart: a PHT-spline inside its trims
  integer(c_int32_t), parameter, public :: PLANISH_MODEL_FAMILY_PATCHES = 2 !! Patches over a layout of quadrilaterals

  !> Which layout the patches have.
  !> Over its features, if it has some; else the cube for genus 0, a base complex with handles, or where the cube
  !> misses the tolerance and the complex does better
  integer(c_int32_t), parameter, public :: PLANISH_MODEL_LAYOUT_AUTO = 0
  !> The six faces of a cube, which round sharp edges off; genus 0 only
  integer(c_int32_t), parameter, public :: PLANISH_MODEL_LAYOUT_CUBE = 1
  !> Over its features, if it has some; else a base complex: patches that follow the shape
  integer(c_int32_t), parameter, public :: PLANISH_MODEL_LAYOUT_COMPLEX = 2

  !> Which knots the control curves of a skin get.
  !> Each its own, as few as the tolerance allows
  integer(c_int32_t), parameter, public :: PLANISH_SKIN_METHOD_CONTROL_CURVES = 0
  !> All the same: the classical skin, for comparison
  integer(c_int32_t), parameter, public :: PLANISH_SKIN_METHOD_COMMON_KNOTS = 1

  !> What happens at the ends of rows.
  !> Periodic for closed rows, parabolic for open ones
  integer(c_int32_t), parameter, public :: PLANISH_SECTION_ENDS_AUTO = 0
  !> The slope of the parabola through three points; at the seam of closed rows a kink may remain
  integer(c_int32_t), parameter, public :: PLANISH_SECTION_ENDS_PARABOLIC = 1
  integer(c_int32_t), parameter, public :: PLANISH_SECTION_ENDS_NATURAL = 2 !! No curvature
  integer(c_int32_t), parameter, public :: PLANISH_SECTION_ENDS_SLOPES = 3 !! The slopes in end_slopes
  !> Closed rows go on over the seam without a break in two derivatives
  integer(c_int32_t), parameter, public :: PLANISH_SECTION_ENDS_PERIODIC = 4

  !> How far apart rows are along v.
  !> As their first and last points are; where that gives a step of next to nothing, as PLANISH_V_RULE_MEAN
  integer(c_int32_t), parameter, public :: PLANISH_V_RULE_ENDPOINTS = 0
  !> As points at equal fractions of their lengths are on average
  integer(c_int32_t), parameter, public :: PLANISH_V_RULE_MEAN = 1

  !> How a skin runs from row to row.
  !> Without a break in two derivatives; bunched rows make it swing between others
  integer(c_int32_t), parameter, public :: PLANISH_V_SLOPES_SMOOTH = 0
  !> Without a break in one derivative, and no coordinate leaves the range of the two rows that it is between: it
  !> cannot overshoot
  integer(c_int32_t), parameter, public :: PLANISH_V_SLOPES_MONOTONE = 1

  !> What determines a PHT-spline at its vertices.
  !> Least squares over all data with a weak bending energy: fewest coefficients
  integer(c_int32_t), parameter, public :: PLANISH_PHT_ESTIMATOR_GLOBAL = 0
  !> A quadratic fit around each datum, interpolated linearly (Deng et al., 2008): for comparison
  integer(c_int32_t), parameter, public :: PLANISH_PHT_ESTIMATOR_LOCAL_QUADRATIC = 1
  !> A weighted cubic fit around each vertex: no system to solve, for very large data
  integer(c_int32_t), parameter, public :: PLANISH_PHT_ESTIMATOR_LOCAL_CUBIC = 2

  !> Whether a PHT fit merges cells again as long as the tolerance is met, at the cost of up to 40 further fits.
  !> Where the surface has two continuous derivatives
  integer(c_int32_t), parameter, public :: PLANISH_COARSENING_AUTO = 0
  integer(c_int32_t), parameter, public :: PLANISH_COARSENING_ON = 1 !! Yes
  integer(c_int32_t), parameter, public :: PLANISH_COARSENING_OFF = 2 !! No

  !> An edge of a surface's domain.
  integer(c_int32_t), parameter, public :: PLANISH_BORDER_SIDE_LOW_U = 0 !! Least u
  integer(c_int32_t), parameter, public :: PLANISH_BORDER_SIDE_HIGH_U = 1 !! Largest u
  integer(c_int32_t), parameter, public :: PLANISH_BORDER_SIDE_LOW_V = 2 !! Least v
  integer(c_int32_t), parameter, public :: PLANISH_BORDER_SIDE_HIGH_V = 3 !! Largest v

  !> Which control points a PHT-spline has.
  !> Of the cells at the birth of a vertex (Deng et al., 2008): independent of later splits
  integer(c_int32_t), parameter, public :: PLANISH_PHT_BASIS_CANONICAL = 0
  !> Of the widest cell of a vertex's support on each side: well conditioned whatever the levels
  integer(c_int32_t), parameter, public :: PLANISH_PHT_BASIS_SUPPORT_SIZED = 1

  !> Which functions a D1RC-spline has.
  !> They sum to one and reproduce polynomials, on the whole domain; the surface is polynomial on pieces
  integer(c_int32_t), parameter, public :: PLANISH_D1RC_MODE_REPRODUCING = 0
  !> As printed (Cao, Zheng, 2016): rational, only inner vertices count, the surface ends before the mesh does
  integer(c_int32_t), parameter, public :: PLANISH_D1RC_MODE_PAPER = 1

  !> The border of a D1RC-spline of PLANISH_D1RC_MODE_REPRODUCING.
  !> Smooth everywhere; the border follows the boundary polygon as a B-spline follows its control points
  integer(c_int32_t), parameter, public :: PLANISH_D1RC_BOUNDARY_PHANTOM = 0
  !> The boundary polygon is interpolated; across the edges that touch it the surface is only continuous
  integer(c_int32_t), parameter, public :: PLANISH_D1RC_BOUNDARY_CLAMPED = 1
  !> The domain ends some faces before the mesh does
  integer(c_int32_t), parameter, public :: PLANISH_D1RC_BOUNDARY_OPEN = 2

  !> What happens at sharp edges of a D1RC-spline.
  !> PLANISH_D1RC_SHARP_CUT, in PLANISH_D1RC_MODE_PAPER PLANISH_D1RC_SHARP_ADDITIVE
  integer(c_int32_t), parameter, public :: PLANISH_D1RC_SHARP_AUTOMATIC = 0
  !> The crease is the control polyline, at its full angle
  integer(c_int32_t), parameter, public :: PLANISH_D1RC_SHARP_CUT = 1
  !> Functions of the crease, and smooth functions only on their side of it
  integer(c_int32_t), parameter, public :: PLANISH_D1RC_SHARP_SECTOR = 2
  !> Functions of the crease beside all smooth ones: a soft crease
  integer(c_int32_t), parameter, public :: PLANISH_D1RC_SHARP_ADDITIVE = 3

  !> How arrays or files become a mesh.
  type, bind(c), public :: planish_mesh_options
    integer(c_size_t) :: struct_size = 6 * word + 48
    !> Doubles from one node to the next in `points`; at least 3, or 0 (default) for 3
    integer(c_size_t) :: point_stride = 0
    !> Indices from one triangle to the next in `triangles`; at least 3, or 0 (default) for 3
    integer(c_size_t) :: triangle_stride = 0
    real(c_double) :: weld_distance = 0 !! Nodes not further apart than this become one, in model units
    type(c_ptr) :: out_repairs = c_null_ptr !! Receives what was repaired, or NULL (default)
    !> Receives for each node given the node of the mesh that it became, counted from 1: point_count elements, or NULL
    !> (default)
    type(c_ptr) :: out_node_map = c_null_ptr
    !> 1 turns triangles over until neighbours agree, whatever repair says; 0 (default) leaves that to repair
    integer(c_int32_t) :: orient = 0
    !> The number that `triangles` uses for the first node, such as 1 from Fortran
    integer(c_int32_t) :: index_base = 0
    !> Corners of each face, at least 3: `triangles` then holds polygons, one behind the other, and triangle_count is
    !> their number
    type(c_ptr) :: face_sizes = c_null_ptr
    !> Most bytes of a file, unpacked; 0 (default) for three quarters of what the machine or its control group has
    integer(c_int64_t) :: max_memory = 0
    integer(c_int32_t) :: repair = 0 !! Which faults are mended: bits of planish_mesh_repair
    !> A planish_mesh_components: which parts that hang together by edges become the mesh
    integer(c_int32_t) :: components = PLANISH_MESH_COMPONENTS_ALL
    !> The part for PLANISH_MESH_COMPONENTS_ONE, counted from 1 in the order of their first triangles
    integer(c_int32_t) :: component = 0
    integer(c_int32_t) :: format = PLANISH_MESH_FORMAT_AUTO !! A planish_mesh_format, of files and buffers
    !> Corners of every face if face_sizes is NULL: 0 (default) or 3 for triangles, 4 for quads and so on
    integer(c_int32_t) :: corner_count = 0
    integer(c_int32_t) :: reserved = 0
  end type

  !> What was done to arrays or a file to make a mesh of them.
  type, bind(c), public :: planish_mesh_repairs
    integer(c_size_t) :: struct_size = 9 * word + 8
    integer(c_size_t) :: welded_node_count = 0 !! Nodes that vanished because they were welded to others
    !> Triangles and faces that were left out because two of their corners are one node, as given or by welding, or
    !> because they have less than three
    integer(c_size_t) :: dropped_triangle_count = 0
    integer(c_size_t) :: flipped_triangle_count = 0 !! Triangles that were turned over
    !> 1 if the file has texture coordinates that are no parameters, because a node has several or none, or because
    !> they are not finite or lie on a line
    integer(c_int32_t) :: dropped_parameters = 0
    integer(c_int32_t) :: missing_end = 0 !! 1 if the file ends before it says that it does; what it has is whole
    integer(c_size_t) :: unused_node_count = 0 !! Nodes that no triangle needs
    integer(c_size_t) :: split_node_count = 0 !! Copies of nodes that were appended
    !> Triangles that were left out because an earlier one has the same nodes
    integer(c_size_t) :: duplicate_triangle_count = 0
    integer(c_size_t) :: parted_edge_count = 0 !! Edges of three and more triangles that were parted
    !> Triangles of components that were not asked for: a choice, no repair
    integer(c_size_t) :: excluded_triangle_count = 0
  end type

  !> How a mesh is written.
  type, bind(c), public :: planish_mesh_write_options
    integer(c_size_t) :: struct_size = 1 * word + 8
    integer(c_int32_t) :: format = PLANISH_MESH_FORMAT_AUTO !! A planish_mesh_format
    integer(c_int32_t) :: text = 0 !! 1 writes PLY and STL as text; with 0 (default) they are binary
  end type

  !> How coarse a mesh becomes, and what stays.
  type, bind(c), public :: planish_decimate_options
    integer(c_size_t) :: struct_size = 10 * word + 24
    integer(c_size_t) :: target_count = 1000 !! Nodes that are to be left, at least 3
    !> Edges whose triangles turn by more than this are sharp, in radians, at most pi; 0 (default) looks for none
    real(c_double) :: sharp_angle = 0
    !> Where the boundary or a chain of sharp edges turns by more than this, in radians, at most pi, its node stays
    real(c_double) :: corner_angle = acos(-1.0_c_double) / 4
    !> Further sharp edges: two nodes each, counted from 1; NULL (default) for none
    type(c_ptr) :: sharp_edges = c_null_ptr
    integer(c_size_t) :: sharp_edge_count = 0 !! Edges in sharp_edges
    !> Receives the sharp edges of the new mesh, two nodes each, counted from 1, the smaller first; or NULL (default)
    type(c_ptr) :: out_sharp_edges = c_null_ptr
    !> Edges that out_sharp_edges has room for; there are at most as many as sharp edges before
    integer(c_size_t) :: out_sharp_edge_count = 0
    type(c_funptr) :: progress = c_null_funptr !! Hears of the progress and may cancel; NULL (default) for nobody
    type(c_ptr) :: user = c_null_ptr !! Handed to progress as it is
    !> Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag
    type(c_ptr) :: cancel = c_null_ptr
    !> Shows what the call is doing, before progress hears of it: a planish_stage
    type(c_ptr) :: out_stage = c_null_ptr
    !> 1 (default) lets no triangle turn over in the parameter plane, if the mesh has parameters; 0 does not look
    integer(c_int32_t) :: keep_map = 1
    integer(c_int32_t) :: reserved = 0
  end type

  !> What was done to make a mesh coarser.
  type, bind(c), public :: planish_decimate_report
    integer(c_size_t) :: struct_size = 4 * word + 8
    integer(c_size_t) :: collapse_count = 0 !! Edges that were collapsed
    !> Nodes beyond the target that had to stay, because nothing more can be collapsed
    integer(c_size_t) :: excess_count = 0
    integer(c_size_t) :: sharp_edge_count = 0 !! Sharp edges of the new mesh
    real(c_double) :: seconds = 0 !! Wall time in seconds
  end type

  !> How a mesh gets its parameters.
  type, bind(c), public :: planish_parameterize_options
    integer(c_size_t) :: struct_size = 6 * word + 64
    !> A positive number for each node: large where more parameter area is wanted
    type(c_ptr) :: node_weights = c_null_ptr
    type(c_funptr) :: progress = c_null_funptr !! Hears of the progress and may cancel; NULL (default) for nobody
    type(c_ptr) :: user = c_null_ptr !! Handed to progress as it is
    !> Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag
    type(c_ptr) :: cancel = c_null_ptr
    !> Shows what the call is doing, before progress hears of it: a planish_stage
    type(c_ptr) :: out_stage = c_null_ptr
    !> Outward bulge of a square's sides, in sides, 0 to 0.5: keeps triangles between nodes of one side open
    real(c_double) :: bulge = 0.02_c_double
    real(c_double) :: boundary_slide = 0 !! How far border nodes slide with the stretch, 0 to 1
    integer(c_int32_t) :: method = PLANISH_MAP_METHOD_MEAN_VALUE !! A planish_map_method
    integer(c_int32_t) :: border = PLANISH_BORDER_AUTO !! A planish_border
    !> For PLANISH_BORDER_CORNERS: four nodes of the longest boundary loop in its order, counted from 1
    integer(c_int32_t) :: corners(4) = 0
    !> Most steps that lower the stretch after the first map: 0 for none, PLANISH_UNLIMITED (default) until it no
    !> longer falls
    integer(c_int32_t) :: stretch_steps = PLANISH_UNLIMITED
    integer(c_int32_t) :: rings = 0 !! Sweeps that smooth the logarithm of the stretch before each step
    !> 1 (default) closes holes by fans of triangles while the map is computed; 0 lets them become convex
    integer(c_int32_t) :: fill_holes = 1
    !> With PLANISH_BORDER_AUTO: 1 (default) also unrolls the map with a free border, and takes that if it neither
    !> folds nor overlaps itself and stretches less; 0 does not
    integer(c_int32_t) :: unroll = 1
    integer(c_int32_t) :: thread_count = 0 !! Threads to use, at most 1024; 0 (default) for all cores
    integer(c_int32_t) :: reserved = 0
  end type

  !> How good a map is and what it took.
  type, bind(c), public :: planish_parameterize_report
    integer(c_size_t) :: struct_size = 5 * word + 48
    !> L2 stretch of all triangles: 1 is an isometry; infinite if a triangle has no parameter area
    real(c_double) :: stretch = 0
    real(c_double) :: max_stretch = 0 !! The largest stretch in any direction anywhere, in the same scale
    !> The largest ratio of a triangle's area in space to that in the parameters, by the smallest
    real(c_double) :: area_ratio = 0
    real(c_double) :: seconds = 0 !! Wall time in seconds
    integer(c_size_t) :: flipped_count = 0 !! Triangles turned over against the rest: folds of the map
    integer(c_size_t) :: degenerate_count = 0 !! Triangles of exactly zero parameter area
    integer(c_size_t) :: solve_count = 0 !! Factorizations of the linear system, all candidates together
    integer(c_size_t) :: step_count = 0 !! Steps that lowered the stretch of the map returned
    integer(c_int64_t) :: remarks = 0 !! Everything worth knowing: bits of planish_remark
    integer(c_int32_t) :: border = 0 !! The border that was taken: a planish_border
    integer(c_int32_t) :: border_slid = 0 !! 1 if the border slid with the stretch
  end type

  !> How a mesh is mapped on to the sphere.
  type, bind(c), public :: planish_sphere_options
    integer(c_size_t) :: struct_size = 5 * word + 8
    type(c_funptr) :: progress = c_null_funptr !! Hears of the progress and may cancel; NULL (default) for nobody
    type(c_ptr) :: user = c_null_ptr !! Handed to progress as it is
    !> Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag
    type(c_ptr) :: cancel = c_null_ptr
    !> Shows what the call is doing, before progress hears of it: a planish_stage
    type(c_ptr) :: out_stage = c_null_ptr
    integer(c_int32_t) :: sweeps = 10 !! Sweeps over all nodes at the end
    integer(c_int32_t) :: thread_count = 0 !! Threads that share the work; 0 (default) for all cores
  end type

  !> How good a map to the sphere is.
  type, bind(c), public :: planish_sphere_report
    integer(c_size_t) :: struct_size = 3 * word + 32
    !> Symmetric Dirichlet energy by area, both scaled to those of the sphere: 4 if all lengths are kept
    real(c_double) :: energy = 0
    !> Triangles whose images are turned over or flat, by the exact sign; 0 but beyond the digits of a double
    integer(c_size_t) :: folded_triangles = 0
    integer(c_size_t) :: clamped_triangles = 0 !! Triangles so thin that they counted as wider
    !> Image area by area in space, each as a share of its whole: 5 percent of the area have less than this
    real(c_double) :: low_area_ratio = 0
    real(c_double) :: high_area_ratio = 0 !! 5 percent of the area have more than this
    real(c_double) :: seconds = 0 !! Wall time in seconds
  end type

  !> How features of a mesh are found.
  type, bind(c), public :: planish_feature_options
    integer(c_size_t) :: struct_size = 6 * word + 40
    !> Edges whose facets turn by more than this are features, in radians, at most pi; 0 looks for none
    real(c_double) :: sharp_angle = 0.7_c_double
    !> Chains of feature edges that end go on along edges whose facets turn by more than this, in radians, at most pi,
    !> which lets none go on
    real(c_double) :: weak_angle = 0.26_c_double
    !> Where a chain turns by more than this, in radians, at most pi, it has a corner
    real(c_double) :: corner_angle = 0.6_c_double
    !> Bits of chains that end in nothing and are shorter than this part of the diagonal, 0 to 1, are dropped
    real(c_double) :: least_length = 0.04_c_double
    !> Edges that are features whatever their angle: two nodes each, counted from 1; NULL (default) for none
    type(c_ptr) :: sharp_edges = c_null_ptr
    integer(c_size_t) :: sharp_edge_count = 0 !! Edges in sharp_edges
    !> A number for each triangle: edges between triangles of different numbers are features; NULL (default) for none
    type(c_ptr) :: labels = c_null_ptr
    !> Receives 1 for each node that is a corner: the end of a chain, a junction, a turn; 0 for all others; or NULL
    !> (default)
    type(c_ptr) :: out_is_corner = c_null_ptr
    type(c_ptr) :: out_report = c_null_ptr !! Receives what was found, or NULL (default)
    !> 1 (default) filters the normals of a noisy mesh before angles are measured; 0 takes them as they are
    integer(c_int32_t) :: filter_noise = 1
    integer(c_int32_t) :: reserved = 0
  end type

  !> What was found of features.
  type, bind(c), public :: planish_feature_report
    integer(c_size_t) :: struct_size = 8 * word + 8
    integer(c_size_t) :: edge_count = 0 !! Feature edges
    integer(c_size_t) :: border_edge_count = 0 !! Those of them on the border
    integer(c_size_t) :: chain_count = 0 !! Chains of feature edges between corners, and closed ones
    integer(c_size_t) :: closed_chain_count = 0 !! Chains without ends
    integer(c_size_t) :: corner_count = 0 !! Nodes that are no part of a smooth chain
    integer(c_size_t) :: prolonged_edge_count = 0 !! Edges by which chains were made longer
    integer(c_size_t) :: dropped_edge_count = 0 !! Edges that were dropped in short bits
    !> Noise of the nodes along the normal, as standard deviation by the mean edge length: an estimate
    real(c_double) :: noise = 0
  end type

  !> How quads make a layout.
  type, bind(c), public :: planish_layout_options
    integer(c_size_t) :: struct_size = 2 * word
    !> The number of the edge of each side, where two edges join the same vertices; NULL (default) for edges that are
    !> told by their ends
    type(c_ptr) :: edges = c_null_ptr
  end type

  !> How a mesh gets a layout.
  type, bind(c), public :: planish_mesh_layout_options
    integer(c_size_t) :: struct_size = 5 * word + 16
    type(c_funptr) :: progress = c_null_funptr !! Hears of the progress and may cancel; NULL (default) for nobody
    type(c_ptr) :: user = c_null_ptr !! Handed to progress as it is
    !> Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag
    type(c_ptr) :: cancel = c_null_ptr
    !> Shows what the call is doing, before progress hears of it: a planish_stage
    type(c_ptr) :: out_stage = c_null_ptr
    integer(c_int32_t) :: kind = PLANISH_LAYOUT_KIND_AUTO !! A planish_layout_kind
    integer(c_int32_t) :: patches = 40 !! About how many patches a base complex has, at least 6
    integer(c_int32_t) :: sweeps = 300 !! Most sweeps over all nodes at the end
    integer(c_int32_t) :: thread_count = 0 !! Threads that share the work; 0 (default) for all cores
  end type

  !> How good the layout of a mesh is.
  type, bind(c), public :: planish_mesh_layout_report
    integer(c_size_t) :: struct_size = 5 * word + 32
    !> Symmetric Dirichlet energy of the node map by area: 4 if all lengths are kept; of a cube that of the map to the
    !> sphere
    real(c_double) :: energy = 0
    real(c_double) :: first_energy = 0 !! The same before nodes moved over the layout
    integer(c_size_t) :: folded_node_count = 0 !! Nodes with a triangle whose image is turned over
    !> Nodes whose triangles are spread over patches without a common corner
    integer(c_size_t) :: spread_node_count = 0
    integer(c_size_t) :: doublet_count = 0 !! Vertices of only two patches that were removed, each with one patch
    !> Edges of the coarse mesh that were split because its triangles could not be paired
    integer(c_size_t) :: split_count = 0
    real(c_double) :: seconds = 0 !! Wall time in seconds
    integer(c_int32_t) :: kind = 0 !! The kind that was made: a planish_layout_kind
    integer(c_int32_t) :: reserved = 0
  end type

  !> What a fit did and how good it is.
  type, bind(c), public :: planish_fit_report
    integer(c_size_t) :: struct_size = 11 * word + 160
    !> Largest distance between a datum and the surface at the datum's (u,v): what the tolerance bounds
    real(c_double) :: max_error = 0
    real(c_double) :: rms_error = 0 !! Square root of the mean of its square
    real(c_double) :: mean_error = 0 !! Its mean
    real(c_double) :: tolerance = 0 !! The tolerance that was kept or missed
    real(c_double) :: diagonal = 0 !! Diagonal of the data's bounding box: an error divided by it is relative
    !> Largest distance from a triangle's centroid or an edge's middle to the surface's tangent plane at the mean of
    !> the nodes' (u,v) (for a field: to its value there); 0 for data without triangles
    real(c_double) :: max_interior_error = 0
    !> The part of max_interior_error that flat facets on a curved shape explain: max_interior_error - facet_sagitta
    !> is the largest distance beyond what its own facet explains, and PLANISH_REMARK_ROUGH_BETWEEN_NODES tells where
    !> that is above the tolerance
    real(c_double) :: facet_sagitta = 0
    !> Largest closest-point distance from a node to the surface; NaN unless measure_distance asked for it
    real(c_double) :: max_distance = 0
    real(c_double) :: smoothing = 0 !! Weight of the smoothing energy in the surface returned
    real(c_double) :: stretch = 0 !! L2 stretch of the map: 1 is an isometry; 0 for data without triangles
    real(c_double) :: parameterize_seconds = 0 !! Wall time spent on the map, in seconds
    real(c_double) :: seconds = 0 !! Wall time in all, in seconds
    integer(c_size_t) :: worst_index = 0 !! The datum with the largest error, counted from 1
    integer(c_size_t) :: grid_u = 0 !! Different knots along u
    integer(c_size_t) :: grid_v = 0 !! Different knots along v
    integer(c_size_t) :: coefficient_count = 0 !! Unknowns of the fit
    integer(c_size_t) :: empty_cell_count = 0 !! Cells without data inside the trims
    integer(c_size_t) :: flipped_count = 0 !! Triangles that are turned over or flat in the parameter plane
    integer(c_int64_t) :: remarks = 0 !! Everything worth knowing: bits of planish_remark
    integer(c_int32_t) :: pass_count = 0 !! Rounds of fitting and measuring
    integer(c_int32_t) :: stop_reason = 0 !! Why the fit ended: a planish_stop_reason
    integer(c_size_t) :: cell_count = 0 !! Cells of an adaptive mesh; 0 for a grid
    integer(c_size_t) :: rough_cell_count = 0 !! Cells of it in which an error exceeds the tolerance
    integer(c_int32_t) :: deepest_level = 0 !! The deepest level of its cells: how often one of the first was halved
    integer(c_int32_t) :: reserved = 0
    real(c_double) :: max_fixed_error = 0 !! Largest error of a fixed datum; 0 without any
    !> Largest error of the other data as a share of the tolerance of its own: at most 1 where all are met
    real(c_double) :: max_tolerance_share = 0
    integer(c_size_t) :: left_out_count = 0 !! Data that were taken for gross errors and left out
    !> Largest distance of the mirror image of a node to the mesh, if symmetry was asked for; else 0
    real(c_double) :: mirror_distance = 0
    !> Largest distance of the surface to the curves of sides that were given; 0 without any
    real(c_double) :: max_side_error = 0
    !> Largest angle between the tangent planes of the surface and those of its neighbours along such sides, in
    !> radians
    real(c_double) :: max_side_angle = 0
    !> Unknowns before cells were merged again, as coarsening asks; that of coefficient_count where none were, 0 for a
    !> fit without cells
    integer(c_size_t) :: refined_coefficient_count = 0
  end type

  !> How points are evaluated.
  type, bind(c), public :: planish_eval_options
    integer(c_size_t) :: struct_size = 4 * word + 8
    integer(c_size_t) :: uv_stride = 0 !! Doubles from one point to the next in `uv`; at least 2, or 0 (default) for 2
    !> Doubles from one point's results to the next; at least as many as a point has, or 0 (default) for exactly so
    !> many
    integer(c_size_t) :: out_stride = 0
    !> Receives bits of planish_flag, one element for each point; NULL (default) for none
    type(c_ptr) :: out_flags = c_null_ptr
    integer(c_int32_t) :: outside = PLANISH_OUTSIDE_FAIL !! A planish_outside
    integer(c_int32_t) :: thread_count = 0 !! Threads to use, at most 1024; 0 (default) for all cores
  end type

  !> How trims follow curves.
  type, bind(c), public :: planish_trim_options
    integer(c_size_t) :: struct_size = 5 * word + 24
    !> How far the trims may lie from the curves, and the curves from the surface, positive, measured in
    !> tolerance_scale
    real(c_double) :: tolerance = 1e-3_c_double
    type(c_funptr) :: progress = c_null_funptr !! Hears of the progress and may cancel; NULL (default) for nobody
    type(c_ptr) :: user = c_null_ptr !! Handed to progress as it is
    !> Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag
    type(c_ptr) :: cancel = c_null_ptr
    !> Shows what the call is doing, before progress hears of it: a planish_stage
    type(c_ptr) :: out_stage = c_null_ptr
    !> A planish_tolerance_scale; relative is to the diagonal of the box of the curves' control points
    integer(c_int32_t) :: tolerance_scale = PLANISH_TOLERANCE_SCALE_RELATIVE
    !> 1 adds the loops to the trims that the surface has, so that a closed curve inside cuts a hole; 0 (default)
    !> replaces them
    integer(c_int32_t) :: add = 0
    integer(c_int32_t) :: thread_count = 0 !! Threads to use, at most 1024; 0 (default) for all cores
    integer(c_int32_t) :: reserved = 0
  end type

  !> How near trims are to the curves that they follow: distances of the surface over them to the pieces of curve that
  !> they stand for, in model units.
  type, bind(c), public :: planish_trim_report
    integer(c_size_t) :: struct_size = 4 * word + 64
    real(c_double) :: max_vertex_distance = 0 !! Largest distance at a vertex
    real(c_double) :: rms_vertex_distance = 0 !! Root mean square of the distances at vertices
    !> Largest distance between vertices, measured at seven places of each side
    real(c_double) :: max_distance_between = 0
    real(c_double) :: rms_distance_between = 0 !! Root mean square of the distances between vertices
    real(c_double) :: worst_parameter = 0 !! The parameter of the place on its curve that the trims are farthest from
    real(c_double) :: tolerance = 0 !! The tolerance, which is no less than what rounding leaves
    real(c_double) :: diagonal = 0 !! What a relative tolerance is measured in
    real(c_double) :: seconds = 0 !! Wall time in seconds
    integer(c_size_t) :: worst_curve = 0 !! The curve of that place
    integer(c_size_t) :: vertex_count = 0 !! Vertices of the new trims
    integer(c_size_t) :: unproven_count = 0 !! Of these those whose places are not proved to be nearest to the curve
  end type

  !> A Bezier patch: the polynomial or rational piece of a surface over a rectangle of parameters.
  type, bind(c), public :: planish_patch
    integer(c_size_t) :: struct_size = 3 * word + 48
    real(c_double) :: u_min = 0 !! Least u of the rectangle
    real(c_double) :: u_max = 0 !! Largest u of the rectangle
    real(c_double) :: v_min = 0 !! Least v of the rectangle
    real(c_double) :: v_max = 0 !! Largest v of the rectangle
    integer(c_size_t) :: ordinate_count = 0 !! Number of ordinates: (degree_u + 1) * (degree_v + 1)
    integer(c_size_t) :: ordinate_width = 0 !! Numbers of an ordinate: dim, or dim + 1 if the patch is rational
    integer(c_int32_t) :: degree_u = 0 !! Degree along u
    integer(c_int32_t) :: degree_v = 0 !! Degree along v
    !> 1 if the last number of each ordinate is a weight, and the others are multiplied by it; else 0
    integer(c_int32_t) :: is_rational = 0
    integer(c_int32_t) :: reserved = 0
  end type

  !> How a surface is converted.
  type, bind(c), public :: planish_convert_options
    integer(c_size_t) :: struct_size = 6 * word
    integer(c_size_t) :: max_coefficients = 4000000 !! Most control points of the result; with more the call fails
    type(c_funptr) :: progress = c_null_funptr !! Hears of the progress and may cancel; NULL (default) for nobody
    type(c_ptr) :: user = c_null_ptr !! Handed to progress as it is
    !> Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag
    type(c_ptr) :: cancel = c_null_ptr
    !> Shows what the call is doing, before progress hears of it: a planish_stage
    type(c_ptr) :: out_stage = c_null_ptr
  end type

  !> Options of tensor fits.
  type, bind(c), public :: planish_tensor_options
    integer(c_size_t) :: struct_size = 24 * word + 112
    !> The largest error allowed at the data, positive, measured in tolerance_scale
    real(c_double) :: tolerance = 1e-3_c_double
    !> Weight of the bending energy; 0 (default) finds one: of uniform knots the largest of 1e-3, 1e-4, 1e-5, 1e-6
    !> that meets the tolerance (for PLANISH_TENSOR_METHOD_FERGUSON 1e-3), of adaptive knots 1e-11 or less, the weight
    !> of a thin plate over the unit square against the mean square error; where the tolerance is out of reach,
    !> adaptive knots take the one of least generalized cross-validation
    real(c_double) :: smoothing = 0
    !> How far the knots reach beyond the data, as a fraction of the data's range, 0 to 10
    real(c_double) :: buffer = 0.1_c_double
    !> How a mesh without parameters gets them; NULL (default) for the defaults
    type(c_ptr) :: parameterize = c_null_ptr
    type(c_ptr) :: weights = c_null_ptr !! A positive weight for each datum; NULL (default) for all 1
    type(c_funptr) :: progress = c_null_funptr !! Hears of the progress and may cancel; NULL (default) for nobody
    type(c_ptr) :: user = c_null_ptr !! Handed to progress as it is
    !> Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag
    type(c_ptr) :: cancel = c_null_ptr
    !> Shows what the call is doing, before progress hears of it: a planish_stage
    type(c_ptr) :: out_stage = c_null_ptr
    !> Receives the (u,v) at which the error of each datum is measured: two numbers for each datum, or NULL (default)
    type(c_ptr) :: out_parameters = c_null_ptr
    !> Receives the error of each datum in model units: one number for each datum, or NULL (default)
    type(c_ptr) :: out_errors = c_null_ptr
    integer(c_size_t) :: max_coefficients = 66049 !! Most unknowns of one grid, at least 4
    integer(c_int32_t) :: tolerance_scale = PLANISH_TOLERANCE_SCALE_RELATIVE !! A planish_tolerance_scale
    integer(c_int32_t) :: method = PLANISH_TENSOR_METHOD_LEAST_SQUARES !! A planish_tensor_method
    integer(c_int32_t) :: ends = PLANISH_ENDS_NATURAL !! A planish_ends, of uniform knots
    integer(c_int32_t) :: energy = PLANISH_ENERGY_BEAM !! A planish_energy, of uniform knots
    integer(c_int32_t) :: regularize = PLANISH_REGULARIZE_AUTO !! A planish_regularize
    integer(c_int32_t) :: max_grid = 257 !! Most knots along one direction, at least 2
    !> Knots along u to use without refinement, 2 to 8193; 0 (default, then grid_v too) refines
    integer(c_int32_t) :: grid_u = 0
    !> Knots along v to use without refinement, 2 to 8193; 0 (default, then grid_u too) refines
    integer(c_int32_t) :: grid_v = 0
    !> Sweeps of parameter correction on each grid: data move to their foot points, then the fit is repeated
    integer(c_int32_t) :: correction_sweeps = 0
    integer(c_int32_t) :: measure_distance = 0 !! 1 measures the closest-point distance of the nodes for the report
    integer(c_int32_t) :: thread_count = 0 !! Threads to use, at most 1024; 0 (default) for all cores
    integer(c_int32_t) :: knots = PLANISH_KNOTS_ADAPTIVE !! A planish_knots
    !> A planish_missing: what values of points and fields mean that are NaN
    integer(c_int32_t) :: missing = PLANISH_MISSING_REFUSED
    !> A planish_symmetry, for the shape of a mesh over adaptive knots
    integer(c_int32_t) :: symmetry = PLANISH_SYMMETRY_NONE
    !> A tolerance for each datum in tolerance_scale, positive, in place of tolerance; infinity leaves the datum out:
    !> it is not fitted, and its error does not count
    type(c_ptr) :: tolerances = c_null_ptr
    !> Numbers of data that the surface passes through, to 1e-12 of the diagonal of the data's box, by linear
    !> conditions on its coefficients
    type(c_ptr) :: fixed = c_null_ptr
    !> Receives 1 for each datum that was taken for a gross error and left out, else 0; NULL (default) for no such
    !> list
    type(c_ptr) :: out_left_out = c_null_ptr
    !> The largest share of the data that may be gross errors, at most 0.25: those that stand out most from their
    !> neighbours are left out of the fit
    real(c_double) :: outlier_share = 0
    !> A gross error misses the surface of the other data by more than this, in tolerance_scale: such data are left
    !> out
    real(c_double) :: outlier_scale = 0
    integer(c_size_t) :: fixed_count = 0 !! Numbers in fixed
    !> A place in the plane of symmetry and a normal of it, for PLANISH_SYMMETRY_ABOUT; else NULL (default)
    type(c_ptr) :: plane = c_null_ptr
    !> Receives a place in the plane of symmetry and its unit normal, if symmetry was asked for; NULL (default) for
    !> nobody
    type(c_ptr) :: out_plane = c_null_ptr
    !> The curve that the side at the least u is, exactly; NULL (default) for a free side
    type(c_ptr) :: curve_u_low = c_null_ptr
    !> The curve that the side at the largest u is, exactly; NULL (default) for a free side
    type(c_ptr) :: curve_u_high = c_null_ptr
    !> The curve that the side at the least v is, exactly; NULL (default) for a free side
    type(c_ptr) :: curve_v_low = c_null_ptr
    !> The curve that the side at the largest v is, exactly; NULL (default) for a free side
    type(c_ptr) :: curve_v_high = c_null_ptr
    !> The tensor surface beyond the side at the least u; NULL (default) for none
    type(c_ptr) :: neighbour_u_low = c_null_ptr
    !> The tensor surface beyond the side at the largest u; NULL (default) for none
    type(c_ptr) :: neighbour_u_high = c_null_ptr
    !> The tensor surface beyond the side at the least v; NULL (default) for none
    type(c_ptr) :: neighbour_v_low = c_null_ptr
    !> The tensor surface beyond the side at the largest v; NULL (default) for none
    type(c_ptr) :: neighbour_v_high = c_null_ptr
    !> The period of a surface that closes along u: after so much of it the surface goes on as it began, with slope
    !> and curvature
    real(c_double) :: period_u = 0
    real(c_double) :: period_v = 0 !! The same along v
  end type

  !> How fields are fitted.
  type, bind(c), public :: planish_field_options
    integer(c_size_t) :: struct_size = 10 * word + 56
    !> What reports compare the errors with, positive, measured in tolerance_scale
    real(c_double) :: tolerance = 1e-3_c_double
    real(c_double) :: smoothing = 1e-6_c_double !! Weight of the bending energy, positive
    !> How far the knots reach beyond the nodes, as a fraction of their range, 0 to 10
    real(c_double) :: buffer = 0.1_c_double
    !> How a mesh without parameters gets them; NULL (default) for the defaults
    type(c_ptr) :: parameterize = c_null_ptr
    type(c_ptr) :: weights = c_null_ptr !! A positive weight for each node; NULL (default) for all 1
    !> For each node 1 if fields have values there, 0 if not: those values are never looked at and may be NaN
    type(c_ptr) :: mask = c_null_ptr
    !> A field for which grid and smoothing are found that meet the tolerance: sample_dim numbers for each node; NULL
    !> (default) for none
    type(c_ptr) :: sample_values = c_null_ptr
    integer(c_size_t) :: sample_dim = 0 !! Numbers of a value of sample_values
    !> Hears of the progress of making the fitter and may cancel; NULL (default) for nobody
    type(c_funptr) :: progress = c_null_funptr
    type(c_ptr) :: user = c_null_ptr !! Handed to progress as it is
    !> Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag
    type(c_ptr) :: cancel = c_null_ptr
    !> Shows what the call is doing, before progress hears of it: a planish_stage
    type(c_ptr) :: out_stage = c_null_ptr
    integer(c_int32_t) :: tolerance_scale = PLANISH_TOLERANCE_SCALE_RELATIVE !! A planish_tolerance_scale
    integer(c_int32_t) :: ends = PLANISH_ENDS_NATURAL !! A planish_ends
    integer(c_int32_t) :: energy = PLANISH_ENERGY_BEAM !! A planish_energy
    !> Knots along u, 2 to 8193; 0 (default, then grid_v too) for as many as the nodes bear, at most 129
    integer(c_int32_t) :: grid_u = 0
    !> Knots along v, 2 to 8193; 0 (default, then grid_u too) for as many as the nodes bear, at most 129
    integer(c_int32_t) :: grid_v = 0
    integer(c_int32_t) :: thread_count = 0 !! Threads to keep, at most 1024; 0 (default) for all cores
    !> A planish_missing: whether values of fields that are NaN are refused or missing
    integer(c_int32_t) :: missing = PLANISH_MISSING_REFUSED
    integer(c_int32_t) :: reserved = 0
  end type

  !> How gradients are computed.
  type, bind(c), public :: planish_gradient_options
    integer(c_size_t) :: struct_size = 2 * word + 8
    integer(c_size_t) :: uv_stride = 0 !! Doubles from one point to the next in `uv`; at least 2, or 0 (default) for 2
    integer(c_int32_t) :: thread_count = 0 !! Threads to use, at most 1024; 0 (default) for all cores
    integer(c_int32_t) :: reserved = 0
  end type

  !> How patches become one smooth model.
  type, bind(c), public :: planish_smooth_options
    integer(c_size_t) :: struct_size = 6 * word + 40
    type(c_funptr) :: progress = c_null_funptr !! Hears of the progress and may cancel; NULL (default) for nobody
    type(c_ptr) :: user = c_null_ptr !! Handed to progress as it is
    !> Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag
    type(c_ptr) :: cancel = c_null_ptr
    !> Shows what the call is doing, before progress hears of it: a planish_stage
    type(c_ptr) :: out_stage = c_null_ptr
    real(c_double) :: tolerance = 1e-3_c_double !! Largest deviation from the given surfaces allowed
    real(c_double) :: join_tolerance = 1e-3_c_double !! Within what distance corners and sides of patches meet
    !> Weight of the plate energy of each cell of a patch, mapped to the unit cell
    real(c_double) :: smoothing = 1e-6_c_double
    integer(c_size_t) :: max_cells = 200000 !! Most cells of all patches of a piece
    !> What both tolerances are measured in: a planish_tolerance_scale; PLANISH_TOLERANCE_SCALE_RELATIVE (default):
    !> the diagonal of the box around all control points
    integer(c_int32_t) :: tolerance_scale = PLANISH_TOLERANCE_SCALE_RELATIVE
    integer(c_int32_t) :: max_rounds = 12 !! Most rounds of fitting and refining
    integer(c_int32_t) :: level_spread = 1 !! By how much the levels of the cells in one face may differ
    integer(c_int32_t) :: thread_count = 0 !! Threads that share the work; 0 (default) for all cores
  end type

  !> What became of patches.
  type, bind(c), public :: planish_smooth_report
    integer(c_size_t) :: struct_size = 7 * word + 104
    real(c_double) :: max_deviation = 0 !! Largest distance between places all over the given surfaces and the model
    real(c_double) :: rms_deviation = 0 !! Square root of the mean of its square
    real(c_double) :: mean_deviation = 0 !! Its mean
    real(c_double) :: tolerance = 0 !! The tolerance that was kept or missed
    real(c_double) :: diagonal = 0 !! Diagonal of the box around all given control points
    real(c_double) :: given_gap = 0 !! Largest distance between given sides that were joined
    real(c_double) :: given_normal_jump = 0 !! Largest difference of unit normals across given sides that were joined
    real(c_double) :: gap = 0 !! Largest distance between the two sides of an edge of the model
    real(c_double) :: normal_jump = 0 !! Largest difference of unit normals across edges of the model
    real(c_double) :: volume = 0 !! Volume that closed pieces enclose
    real(c_double) :: seconds = 0 !! Seconds in all
    integer(c_size_t) :: worst_patch = 0 !! The given patch that deviates most
    integer(c_size_t) :: joined_count = 0 !! Sides that were joined, counted once for both
    integer(c_size_t) :: free_count = 0 !! Sides that stayed free
    integer(c_size_t) :: piece_count = 0 !! Pieces: shells of the model
    integer(c_size_t) :: coefficient_count = 0 !! Control points, four a vertex of the cells of each patch
    integer(c_size_t) :: cell_count = 0 !! Cells of all patches
    integer(c_int64_t) :: remarks = 0 !! Everything worth knowing: bits of planish_remark
    integer(c_int32_t) :: pass_count = 0 !! Rounds of fitting and measuring of the piece that took most
    integer(c_int32_t) :: stop_reason = 0 !! A planish_stop_reason, why the fit ended
  end type

  !> How values are carried.
  type, bind(c), public :: planish_transfer_options
    integer(c_size_t) :: struct_size = 2 * word + 16
    !> How fields on the source are fitted: the grid (given, found for a sample field, or chosen from the number of
    !> nodes, about four of them a coefficient), mask, weights; also threads and progress of the transfer
    type(c_ptr) :: field = c_null_ptr
    !> How far from the source's surface a target may lie, measured in distance_scale, not negative; infinity for
    !> anywhere
    real(c_double) :: max_distance = 0.05_c_double
    !> A planish_tolerance_scale: of the diagonal of the source's points, or model units
    integer(c_int32_t) :: distance_scale = PLANISH_TOLERANCE_SCALE_RELATIVE
    integer(c_int32_t) :: far_rule = PLANISH_FAR_RULE_REFUSE !! A planish_far_rule
  end type

  !> How well source and targets lie on one another.
  type, bind(c), public :: planish_transfer_report
    integer(c_size_t) :: struct_size = 6 * word + 56
    real(c_double) :: max_distance = 0 !! The largest distance of a target to the source's surface
    real(c_double) :: rms_distance = 0 !! Square root of the mean of its square
    real(c_double) :: limit = 0 !! The distance that was allowed
    !> The largest distance between a node of the source and its surface at the node's (u,v)
    real(c_double) :: max_shape_error = 0
    real(c_double) :: rms_shape_error = 0 !! Square root of the mean of its square
    real(c_double) :: seconds = 0 !! Wall time in all, in seconds
    integer(c_size_t) :: farthest_index = 0 !! The target with the largest distance, counted from 1
    integer(c_size_t) :: far_count = 0 !! Targets beyond the limit
    integer(c_size_t) :: grid_u = 0 !! Knots of the grid along u
    integer(c_size_t) :: grid_v = 0 !! Knots of the grid along v
    integer(c_size_t) :: coefficient_count = 0 !! Unknowns of a fit on the grid
    integer(c_int64_t) :: remarks = 0 !! Everything worth knowing of the source's surface: bits of planish_remark
  end type

  !> What a transfer keeps of forces, moments and work.
  type, bind(c), public :: planish_balance_report
    integer(c_size_t) :: struct_size = 1 * word + 144
    real(c_double) :: force_given(3) = 0 !! Sum of the forces on the targets
    real(c_double) :: force_arrived(3) = 0 !! Sum of the forces that arrive at the nodes of the source
    !> Length of the difference, as a fraction of the sum of the lengths of the forces given: roundoff
    real(c_double) :: force_error = 0
    real(c_double) :: moment_given(3) = 0 !! Moment of the forces on the targets
    real(c_double) :: moment_arrived(3) = 0 !! Moment of the forces that arrive
    real(c_double) :: moment_error = 0 !! Length of the difference
    !> What moment_error cannot exceed but by roundoff: the sum over the targets of the force's length times the
    !> distance to the source's surface
    real(c_double) :: moment_bound = 0
    real(c_double) :: work_given = 0 !! Work of the forces given along the displacements that arrive at the targets
    real(c_double) :: work_arrived = 0 !! Work of the forces that arrive along the displacements given
    !> The difference, as a fraction of the sum of the targets' works without their signs: roundoff
    real(c_double) :: work_error = 0
  end type

  !> How fine a tessellation is.
  type, bind(c), public :: planish_tessellate_options
    integer(c_size_t) :: struct_size = 7 * word + 24
    !> Largest distance between the surface and the middles of the edges, in model units, positive; 0 (default) takes
    !> 1e-3 of the surface's diagonal
    real(c_double) :: chord_tolerance = 0
    real(c_double) :: max_edge_length = 0 !! Longest edge in model units, positive; 0 (default) for no limit
    integer(c_size_t) :: max_point_count = 4000000 !! Most nodes; with more the call fails
    type(c_funptr) :: progress = c_null_funptr !! Hears of the progress and may cancel; NULL (default) for nobody
    type(c_ptr) :: user = c_null_ptr !! Handed to progress as it is
    !> Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag
    type(c_ptr) :: cancel = c_null_ptr
    !> Shows what the call is doing, before progress hears of it: a planish_stage
    type(c_ptr) :: out_stage = c_null_ptr
    integer(c_int32_t) :: keep_trims = 1 !! 1 (default) keeps to the part inside the trims, 0 covers the whole domain
    !> Threads that share the faces of a model, at most 1024; 0 (default) for all cores
    integer(c_int32_t) :: thread_count = 0
    type(c_ptr) :: out_report = c_null_ptr !! Receives how good the mesh is, or NULL (default)
  end type

  !> How good a tessellation is.
  type, bind(c), public :: planish_tessellate_report
    integer(c_size_t) :: struct_size = 1 * word + 16
    real(c_double) :: smallest_angle = 0 !! Smallest angle of a triangle in space, in radians
    !> Largest distance measured between the middle of an edge and the surface, in model units
    real(c_double) :: chord_error = 0
  end type

  !> How points are projected.
  type, bind(c), public :: planish_project_options
    integer(c_size_t) :: struct_size = 7 * word + 16
    type(c_ptr) :: guesses = c_null_ptr !! A row u, v near the answer for each point, or NULL (default)
    !> Points farther from the surface than this get NaN, and the call returns PLANISH_STATUS_POINTS_OUTSIDE
    real(c_double) :: max_distance = infinity
    type(c_funptr) :: progress = c_null_funptr !! Hears of the progress and may cancel; NULL (default) for nobody
    type(c_ptr) :: user = c_null_ptr !! Handed to progress as it is
    !> Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag
    type(c_ptr) :: cancel = c_null_ptr
    !> Shows what the call is doing, before progress hears of it: a planish_stage
    type(c_ptr) :: out_stage = c_null_ptr
    !> 1 (default) looks for the nearest place inside the trims, 0 in the whole domain
    integer(c_int32_t) :: keep_trims = 1
    integer(c_int32_t) :: thread_count = 0 !! Threads to use, at most 1024; 0 (default) for all cores
    !> Receives the planish_flag bits of each point, of which PLANISH_FLAG_NOT_PROVEN occurs here, or NULL (default)
    type(c_ptr) :: out_flags = c_null_ptr
  end type

  !> How a surface is compared with a mesh.
  type, bind(c), public :: planish_deviation_options
    integer(c_size_t) :: struct_size = 8 * word + 32
    !> Chord tolerance of the tessellation that is measured back from, in model units; 0 (default) takes 1e-3 of the
    !> surface's diagonal
    real(c_double) :: chord_tolerance = 0
    !> Longest edge of that tessellation in model units; 0 (default) takes 1e-2 of the mesh's diagonal, and at least
    !> 2e-3 of the surface's
    real(c_double) :: max_edge_length = 0
    type(c_funptr) :: progress = c_null_funptr !! Hears of the progress and may cancel; NULL (default) for nobody
    type(c_ptr) :: user = c_null_ptr !! Handed to progress as it is
    !> Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag
    type(c_ptr) :: cancel = c_null_ptr
    !> Shows what the call is doing, before progress hears of it: a planish_stage
    type(c_ptr) :: out_stage = c_null_ptr
    integer(c_int32_t) :: keep_trims = 1 !! 1 (default): only the part of the surface inside its trims counts
    !> 1 (default): the mesh's parameters, if it has any, are where searches start
    integer(c_int32_t) :: use_parameters = 1
    !> 1: measure from the surface to the mesh as well, which notices filled holes and surplus sheets
    integer(c_int32_t) :: measure_back = 0
    integer(c_int32_t) :: thread_count = 0 !! Threads to use, at most 1024; 0 (default) for all cores
    !> Receives the distances of the nodes with the sign of their side: positive on the side of the normal, which is
    !> the outside of a solid; NaN for a node without triangles
    type(c_ptr) :: out_signed = c_null_ptr
    type(c_ptr) :: out_uv = c_null_ptr !! Receives the u, v nearest to each node; NaN for a node without triangles
    !> Receives the face of the model nearest to each node, PLANISH_NONE where there is none; NULL (default) for none,
    !> and for a surface
    type(c_ptr) :: out_faces = c_null_ptr
  end type

  !> Distances between a surface and a mesh, in model units.
  type, bind(c), public :: planish_deviation_report
    integer(c_size_t) :: struct_size = 4 * word + 72
    real(c_double) :: max_distance = 0 !! Largest distance from a node to its nearest place on the surface
    real(c_double) :: rms_distance = 0 !! Square root of the mean of its square
    real(c_double) :: mean_distance = 0 !! Its mean
    !> Largest distance from a place on the surface to the mesh; NaN unless measure_back asked for it
    real(c_double) :: max_back_distance = 0
    real(c_double) :: worst_back_u = 0 !! u of that place; NaN unless asked for
    real(c_double) :: worst_back_v = 0 !! v of that place; NaN unless asked for
    integer(c_size_t) :: worst_index = 0 !! The node farthest from the surface
    integer(c_size_t) :: back_count = 0 !! Places on the surface that were measured back from
    !> Nodes whose distance is not proved to be the least one: planish_surface_project() says when
    integer(c_size_t) :: unproven_count = 0
    real(c_double) :: median_distance = 0 !! What half of the distances do not exceed
    real(c_double) :: distance_95 = 0 !! What 95 of a hundred distances do not exceed
    real(c_double) :: distance_99 = 0 !! What 99 of a hundred distances do not exceed
  end type

  !> What rows to take from a mesh.
  type, bind(c), public :: planish_sample_rows_options
    integer(c_size_t) :: struct_size = 7 * word + 16
    !> About how far apart points are along a row, in model units; 0 (default) takes the mean length of edges
    real(c_double) :: spacing = 0
    integer(c_size_t) :: begin_index = 0 !! The loop or node that the first row is nearest to
    integer(c_size_t) :: end_index = 1 !! The loop or node that the last row is nearest to
    type(c_funptr) :: progress = c_null_funptr !! Hears of the progress and may cancel; NULL (default) for nobody
    type(c_ptr) :: user = c_null_ptr !! Handed to progress as it is
    !> Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag
    type(c_ptr) :: cancel = c_null_ptr
    !> Shows what the call is doing, before progress hears of it: a planish_stage
    type(c_ptr) :: out_stage = c_null_ptr
    integer(c_int32_t) :: begin = PLANISH_ROW_SOURCE_LOOP !! A planish_row_source: what begin_index counts
    integer(c_int32_t) :: end = PLANISH_ROW_SOURCE_LOOP !! A planish_row_source: what end_index counts
  end type

  !> How a surface is made fair.
  type, bind(c), public :: planish_fair_options
    integer(c_size_t) :: struct_size = 5 * word + 24
    !> How far the surface may come to lie from itself, or from the data, positive, measured in tolerance_scale
    real(c_double) :: tolerance = 1e-3_c_double
    type(c_funptr) :: progress = c_null_funptr !! Hears of the progress and may cancel; NULL (default) for nobody
    type(c_ptr) :: user = c_null_ptr !! Handed to progress as it is
    !> Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag
    type(c_ptr) :: cancel = c_null_ptr
    !> Shows what the call is doing, before progress hears of it: a planish_stage
    type(c_ptr) :: out_stage = c_null_ptr
    !> A planish_tolerance_scale; relative is to the diagonal of the box of the control points, or of the data
    integer(c_int32_t) :: tolerance_scale = PLANISH_TOLERANCE_SCALE_RELATIVE
    integer(c_int32_t) :: energy = PLANISH_FAIRNESS_THIN_PLATE !! A planish_fairness
    integer(c_int32_t) :: border = PLANISH_KEPT_BORDER_NONE !! A planish_kept_border
    !> A planish_fair_limit, for data; without data the energy is lowered as far as the tolerance lets it
    integer(c_int32_t) :: limit = PLANISH_FAIR_LIMIT_NOISE
  end type

  !> What fairing did.
  type, bind(c), public :: planish_fair_report
    integer(c_size_t) :: struct_size = 2 * word + 72
    !> Energy before: the integral over the surface, in its own parameters, which count as much as their lines are
    !> long on the average
    real(c_double) :: energy_before = 0
    real(c_double) :: energy_after = 0 !! Energy after; never more
    !> Largest distance to the reference at equal (u,v): of data an error, of the surface itself a proven bound
    real(c_double) :: max_deviation = 0
    !> Root mean square of the errors of the data; without data, of the bounds of the cells
    real(c_double) :: rms_deviation = 0
    real(c_double) :: max_movement = 0 !! No place of the surface moved by more
    real(c_double) :: tolerance = 0 !! The tolerance
    real(c_double) :: diagonal = 0 !! What a relative tolerance is measured in
    !> The weight of the energy against the square of distances; 0 if nothing was gained
    real(c_double) :: smoothing = 0
    real(c_double) :: seconds = 0 !! Wall time in seconds
    integer(c_size_t) :: pass_count = 0 !! Systems solved
  end type

  !> What a VTK file shows.
  type, bind(c), public :: planish_vtk_options
    integer(c_size_t) :: struct_size = 7 * word + 8
    type(c_ptr) :: deviation_from = c_null_ptr !! A mesh to compare with, or NULL (default)
    !> How the surface is tessellated otherwise; NULL (default) for the defaults
    type(c_ptr) :: tessellate = c_null_ptr
    type(c_funptr) :: progress = c_null_funptr !! Hears of the progress and may cancel; NULL (default) for nobody
    type(c_ptr) :: user = c_null_ptr !! Handed to progress as it is
    !> Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag
    type(c_ptr) :: cancel = c_null_ptr
    !> Shows what the call is doing, before progress hears of it: a planish_stage
    type(c_ptr) :: out_stage = c_null_ptr
    integer(c_int32_t) :: thread_count = 0 !! Threads to use, at most 1024; 0 (default) for all cores
    integer(c_int32_t) :: content = PLANISH_VTK_CONTENT_TRIANGLES !! A planish_vtk_content
  end type

  !> What was written to a STEP file.
  type, bind(c), public :: planish_step_report
    integer(c_size_t) :: struct_size = 5 * word + 24
    !> Largest distance between an edge's curve in space and the image of its p-curve, measured on the curves written,
    !> in model units
    real(c_double) :: curve_deviation = 0
    !> The uncertainty that the file states, in model units: 1e-7 of the diagonal, or more if the curves need it
    real(c_double) :: uncertainty = 0
    real(c_double) :: diagonal = 0 !! Diagonal of the box around the part of the surface inside the trims
    integer(c_size_t) :: loop_count = 0 !! Bounds of all faces, the outer ones included
    integer(c_size_t) :: edge_count = 0 !! Edges; one between two faces counts once
    integer(c_size_t) :: face_count = 0 !! Faces
    integer(c_size_t) :: pole_count = 0 !! Control points of the surfaces of all faces
  end type

  !> What a STEP file says beside the shape.
  type, bind(c), public :: planish_step_options
    integer(c_size_t) :: struct_size = 11 * word + 32
    !> Name of the product; NULL (default) for the surface's, or "surface" if it has none
    type(c_ptr) :: product = c_null_ptr
    type(c_ptr) :: author = c_null_ptr !! Who made it; NULL (default) for nobody
    type(c_ptr) :: organization = c_null_ptr !! For whom; NULL (default) for nobody
    !> When, such as "2026-01-31T12:00:00"; NULL (default) for 1970-01-01T00:00:00, so that equal input gives equal
    !> bytes
    type(c_ptr) :: timestamp = c_null_ptr
    type(c_ptr) :: out_report = c_null_ptr !! Receives what was written, or NULL (default)
    type(c_funptr) :: progress = c_null_funptr !! Hears of the progress and may cancel; NULL (default) for nobody
    type(c_ptr) :: user = c_null_ptr !! Handed to progress as it is
    !> Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag
    type(c_ptr) :: cancel = c_null_ptr
    !> Shows what the call is doing, before progress hears of it: a planish_stage
    type(c_ptr) :: out_stage = c_null_ptr
    !> A planish_step_schema; PLANISH_STEP_SCHEMA_AP214 (default)
    integer(c_int32_t) :: schema = PLANISH_STEP_SCHEMA_AP214
    !> A planish_unit, what one model unit is; PLANISH_UNIT_MILLIMETRE (default) leaves it to the surface
    integer(c_int32_t) :: unit = PLANISH_UNIT_MILLIMETRE
    integer(c_size_t) :: max_coefficients = 4000000 !! Most control points of PLANISH_STEP_FORM_TENSOR
    !> A planish_step_form, what is written of a T-spline or PHT-spline; PLANISH_STEP_FORM_TENSOR (default), which is
    !> also taken where the form is of another family
    integer(c_int32_t) :: form = PLANISH_STEP_FORM_TENSOR
    !> By how much the levels of cells in one face of PLANISH_STEP_FORM_PATCHES may differ
    integer(c_int32_t) :: level_spread = 1
    !> A D1RC-spline is written as a tensor surface fitted within this, in model units, at the nodes of a fine
    !> tessellation; 0 (default) takes 1e-3 of the diagonal
    real(c_double) :: tolerance = 0
    integer(c_int32_t) :: thread_count = 0 !! Threads to use, at most 1024; 0 (default) for all cores
    integer(c_int32_t) :: reserved = 0
  end type

  !> What a report says beside what it measures.
  type, bind(c), public :: planish_report_options
    integer(c_size_t) :: struct_size = 7 * word + 24
    type(c_ptr) :: title = c_null_ptr !! The headline; NULL (default) for "Deviation"
    type(c_ptr) :: unit = c_null_ptr !! What one unit of length is called; NULL (default) for "mm"
    !> The largest distance allowed, where the colours end, measured in tolerance_scale; 0 (default) takes the largest
    !> distance found
    real(c_double) :: tolerance = 0
    type(c_funptr) :: progress = c_null_funptr !! Hears of the progress and may cancel; NULL (default) for nobody
    type(c_ptr) :: user = c_null_ptr !! Handed to progress as it is
    !> Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag
    type(c_ptr) :: cancel = c_null_ptr
    !> Shows what the call is doing, before progress hears of it: a planish_stage
    type(c_ptr) :: out_stage = c_null_ptr
    integer(c_int64_t) :: remarks = 0 !! What the fit had to remark, explained on the page: bits of planish_remark
    !> A planish_tolerance_scale; PLANISH_TOLERANCE_SCALE_RELATIVE (default): to the diagonal of the mesh's box
    integer(c_int32_t) :: tolerance_scale = PLANISH_TOLERANCE_SCALE_RELATIVE
    integer(c_int32_t) :: thread_count = 0 !! Threads to use, at most 1024; 0 (default) for all cores
  end type

  !> What an edge is.
  type, bind(c), public :: planish_edge_info
    integer(c_size_t) :: struct_size = 1 * word + 128
    !> Largest angle between the normals of both faces along it, in radians; 0 for an edge of one face
    real(c_double) :: angle = 0
    !> Largest distance between its images on the surfaces of both faces; 0 for an edge of one face
    real(c_double) :: gap = 0
    integer(c_int32_t) :: face_along = 0 !! The face whose loop runs along it; PLANISH_NONE if there is none
    integer(c_int32_t) :: face_against = 0 !! The face whose loop runs against it; PLANISH_NONE if there is none
    integer(c_int32_t) :: vertex_start = 0 !! The vertex where it begins
    integer(c_int32_t) :: vertex_end = 0 !! The vertex where it ends
    integer(c_int32_t) :: is_sharp = 0 !! 1 if its faces meet at an angle on purpose, else 0
    integer(c_int32_t) :: shape = 0 !! A planish_edge_shape, what its curve is
    real(c_double) :: origin(3) = 0 !! The middle of a circle or ellipse; zeros for others
    !> The direction about which a circle or ellipse turns counter-clockwise, of length 1; zeros for others
    real(c_double) :: axis(3) = 0
    !> The direction from the middle where the parameter, an angle in radians, is 0, of length 1; zeros for others
    real(c_double) :: x_axis(3) = 0
    !> Half the width of a circle or ellipse along x_axis and across it; zeros for others
    real(c_double) :: radii(2) = 0
  end type

  !> What a face is.
  type, bind(c), public :: planish_face_info
    integer(c_size_t) :: struct_size = 4 * word + 112
    real(c_double) :: origin(3) = 0 !! A point of the plane, or of the cylinder's axis; zeros for a spline
    !> The normal of the plane, or the direction of the cylinder's axis, of length 1; zeros for a spline
    real(c_double) :: axis(3) = 0
    !> The direction of u in the plane, or where the angle u is 0, of length 1; zeros for a spline
    real(c_double) :: x_axis(3) = 0
    real(c_double) :: radius = 0 !! Radius of the cylinder; 0 for others
    integer(c_size_t) :: loop_count = 0 !! Loops, the outer one first
    integer(c_size_t) :: coedge_count = 0 !! Edges of all loops
    integer(c_int32_t) :: carrier = 0 !! A planish_carrier, what the face lies on
    !> What the maker of the model calls it, such as the label of the triangles it was made from
    integer(c_int32_t) :: label = 0
    integer(c_int32_t) :: shell = 0 !! The shell that it is in
    !> 1 if its front is the side to which the normal of its surface points, else 0
    integer(c_int32_t) :: is_forward = 0
    !> The largest distance between a node of the fitted mesh on the face and the model; NaN without such nodes
    real(c_double) :: max_error = 0
    real(c_double) :: rms_error = 0 !! Square root of the mean of its square; NaN without such nodes
    integer(c_size_t) :: node_count = 0 !! Nodes of the fitted mesh on the face; 0 for a model that no fit made
  end type

  !> What a shell is.
  type, bind(c), public :: planish_shell_info
    integer(c_size_t) :: struct_size = 2 * word + 8
    integer(c_size_t) :: face_count = 0 !! Faces
    integer(c_int32_t) :: role = 0 !! A planish_shell_role
    integer(c_int32_t) :: void_in = 0 !! The shell inside which it is a void; PLANISH_NONE if it is none
  end type

  !> What a model measures.
  type, bind(c), public :: planish_measure_report
    integer(c_size_t) :: struct_size = 5 * word + 104
    real(c_double) :: box_min(3) = 0 !! Least x, y, z, from samples of every span
    real(c_double) :: box_max(3) = 0 !! Largest x, y, z, from samples of every span
    real(c_double) :: area = 0 !! Area of all faces
    real(c_double) :: volume = 0 !! Volume of all solids, voids taken off; 0 for open shells
    real(c_double) :: max_gap = 0 !! Largest distance between the images of an edge on the surfaces of both its faces
    !> Largest angle between the normals on both sides of an edge that is not sharp, in radians
    real(c_double) :: max_normal_jump = 0
    !> Largest distance between an edge's curve in space and its images on the surfaces, and between its ends and its
    !> vertices
    real(c_double) :: curve_deviation = 0
    real(c_double) :: diagonal = 0 !! Diagonal of the box around the model, from samples
    integer(c_size_t) :: free_edge_count = 0 !! Edges of one face
    integer(c_size_t) :: sharp_edge_count = 0 !! Edges that are sharp on purpose
    integer(c_size_t) :: pole_count = 0 !! Control points of the spline surfaces under all faces
    integer(c_size_t) :: loop_count = 0 !! Loops of all faces
    !> Vertices - edges + the sum of 2 - loops over all faces: for each shell 2, less 2 for each handle and 1 for each
    !> hole in it
    integer(c_int64_t) :: euler_characteristic = 0
  end type

  !> How a mesh becomes a model.
  type, bind(c), public :: planish_model_options
    integer(c_size_t) :: struct_size = 13 * word + 88
    type(c_funptr) :: progress = c_null_funptr !! Hears of the progress and may cancel; NULL (default) for nobody
    type(c_ptr) :: user = c_null_ptr !! Handed to progress as it is
    !> Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag
    type(c_ptr) :: cancel = c_null_ptr
    !> Shows what the call is doing, before progress hears of it: a planish_stage
    type(c_ptr) :: out_stage = c_null_ptr
    !> Receives the face on which each node lies, PLANISH_NONE for a node without triangles; NULL (default) for nobody
    type(c_ptr) :: out_faces = c_null_ptr
    type(c_ptr) :: out_uv = c_null_ptr !! Receives (u,v) of each node on its face; NULL (default) for nobody
    !> Receives the error of each node, NaN for a node without triangles; NULL (default) for nobody
    type(c_ptr) :: out_errors = c_null_ptr
    real(c_double) :: tolerance = 1e-3_c_double !! Largest error allowed at the nodes
    !> Weight of the plate energy of each cell of a patch, mapped to the unit cell
    real(c_double) :: smoothing = 1e-4_c_double
    !> Most cells of all patches of a component, beside those that patches need to meet
    integer(c_size_t) :: max_cells = 200000
    integer(c_size_t) :: min_samples = 6 !! A cell with fewer samples is not split, as long as others help
    !> About how many patches a base complex has, or the regions between features that few do not fill; a base complex
    !> takes 0.85 to 4 times as many where it would fold nodes, or where the fit folds or misses the tolerance by less
    !> than twice and another number does better
    integer(c_size_t) :: patches = 40
    !> A planish_tolerance_scale; PLANISH_TOLERANCE_SCALE_RELATIVE (default): to the diagonal of the mesh's box
    integer(c_int32_t) :: tolerance_scale = PLANISH_TOLERANCE_SCALE_RELATIVE
    integer(c_int32_t) :: family = PLANISH_MODEL_FAMILY_AUTO !! A planish_model_family
    integer(c_int32_t) :: layout = PLANISH_MODEL_LAYOUT_AUTO !! A planish_model_layout, for patches
    !> Level of the cells to start from, 1 to 8; 0 (default) takes 3 over a cube and 2 over a base complex
    integer(c_int32_t) :: start_level = 0
    integer(c_int32_t) :: max_level = 12 !! Deepest level of a cell, at most 20
    integer(c_int32_t) :: grade = 1 !! Levels by which neighbours in a patch may differ; 0 for any number
    integer(c_int32_t) :: foot_steps = 1 !! Steps of the samples towards their foot points in each round
    !> Whether cells with few samples are held to the mesh between them: 0 or 1 (default)
    integer(c_int32_t) :: guard = 1
    integer(c_int32_t) :: max_rounds = 20 !! Most rounds of fitting and refining
    integer(c_int32_t) :: sweeps = 300 !! Most sweeps over all nodes while a base complex is laid
    integer(c_int32_t) :: level_spread = 1 !! By how much the levels of the cells in one face may differ
    integer(c_int32_t) :: thread_count = 0 !! Threads that share the work; 0 (default) for all cores
    !> Edges whose facets turn by more than this are sharp, in radians, at most pi; 0 looks for none
    real(c_double) :: sharp_angle = 0.7_c_double
    !> A number for each triangle, such as the face of a CAD model that it comes from: edges between triangles of
    !> different numbers are features unless label_angle says otherwise, and faces have the number as their label;
    !> NULL (default) for none
    type(c_ptr) :: labels = c_null_ptr
    integer(c_size_t) :: label_count = 0 !! Numbers in labels: planish_mesh_triangle_count(), or 0 (default)
    !> Whether a mesh of planes and cylinders becomes exact faces instead of patches or a chart, with
    !> PLANISH_MODEL_FAMILY_AUTO: 0 or 1 (default)
    integer(c_int32_t) :: exact = 1
    integer(c_int32_t) :: smooth = 0 !! 1 ignores all features: smooth patches everywhere; 0 (default) does not
    !> Two labels are one where the facets turn by no more than this along all edges between them, in radians, at most
    !> pi: labels of one smooth skin become one region, with the label of its first triangle
    real(c_double) :: label_angle = 0
  end type

  !> What a fit of a model did and how good it is, of all components together.
  type, bind(c), public :: planish_model_report
    integer(c_size_t) :: struct_size = 16 * word + 152
    !> Largest distance between a node and the model at the node's place: what the tolerance bounds
    real(c_double) :: max_error = 0
    real(c_double) :: rms_error = 0 !! Square root of the mean of its square
    real(c_double) :: mean_error = 0 !! Its mean
    real(c_double) :: tolerance = 0 !! The tolerance that was kept or missed
    real(c_double) :: diagonal = 0 !! Diagonal of the mesh's box: an error divided by it is relative
    !> Largest distance of a centroid of a facet or a middle of an edge from the model
    real(c_double) :: max_interior_error = 0
    !> The part of that which flat facets on a curved shape explain: max_interior_error - facet_sagitta is the largest
    !> distance beyond what its own facet explains
    real(c_double) :: facet_sagitta = 0
    !> Largest distance from places all over the model to the mesh; NaN for a chart
    real(c_double) :: max_back_distance = 0
    real(c_double) :: normal_jump = 0 !! Largest difference of unit normals across edges of patches
    real(c_double) :: gap = 0 !! Largest distance between the two sides of an edge
    real(c_double) :: volume = 0 !! Volume that the model encloses; NaN for an open one
    real(c_double) :: mesh_volume = 0 !! Volume that the mesh encloses; NaN for an open one
    !> Largest symmetric Dirichlet energy of a component's map, by area: 4 if all lengths are kept; NaN for a chart
    real(c_double) :: map_energy = 0
    real(c_double) :: map_seconds = 0 !! Seconds for layouts and maps
    real(c_double) :: fit_seconds = 0 !! Seconds for fits
    real(c_double) :: seconds = 0 !! Seconds in all
    integer(c_size_t) :: worst_node = 0 !! The node with the largest error
    integer(c_size_t) :: component_count = 0 !! Components of the mesh: shells of the model
    integer(c_size_t) :: void_count = 0 !! Components that are voids in others
    integer(c_size_t) :: turned_count = 0 !! Components that were inside out and have been turned
    integer(c_size_t) :: genus = 0 !! Handles of all components
    integer(c_size_t) :: patch_count = 0 !! Patches of all components; 0 for a chart or exact faces
    integer(c_size_t) :: coefficient_count = 0 !! Control points, four a vertex of the cells of each patch
    integer(c_size_t) :: free_count = 0 !! Unknowns a coordinate that remain when patches meet smoothly
    integer(c_size_t) :: cell_count = 0 !! Cells of all patches
    integer(c_size_t) :: fold_count = 0 !! Nodes or triangles that the maps fold
    integer(c_size_t) :: dropped_count = 0 !! Samples left out because their facets are spread over too many patches
    integer(c_int64_t) :: remarks = 0 !! Everything worth knowing: bits of planish_remark
    integer(c_int32_t) :: deepest_level = 0 !! The deepest level of a cell
    integer(c_int32_t) :: pass_count = 0 !! Rounds of fitting and measuring of the component that took most
    integer(c_int32_t) :: stop_reason = 0 !! A planish_stop_reason, why the fit ended
    integer(c_int32_t) :: is_chart = 0 !! 1 for one chart, 0 for patches and exact faces
    integer(c_size_t) :: mesh_crossing_count = 0 !! Pairs of triangles of the mesh that cross
    !> Pairs of triangles of the model that cross, triangulated as finely as the tolerance: walls that are thinner
    !> than that, or folds
    integer(c_size_t) :: crossing_count = 0
    integer(c_size_t) :: exact_face_count = 0 !! Faces on planes and cylinders
    !> Components whose sharp edges were found and are rounded off, because what keeps them was no better or the cube
    !> was asked for
    integer(c_size_t) :: rounded_count = 0
  end type

  !> Options of curve fits.
  type, bind(c), public :: planish_curve_options
    integer(c_size_t) :: struct_size = 7 * word + 48
    !> The largest error allowed at the data, positive, measured in tolerance_scale
    real(c_double) :: tolerance = 1e-3_c_double
    !> Weight of the bending energy; 0 (default) takes the largest of 1e-3, 1e-4, 1e-5, 1e-6 that meets the tolerance
    !> (for PLANISH_TENSOR_METHOD_FERGUSON 1e-3)
    real(c_double) :: smoothing = 0
    !> How far the knots reach beyond the data, as a fraction of the data's range, 0 to 10
    real(c_double) :: buffer = 0.1_c_double
    type(c_ptr) :: weights = c_null_ptr !! A positive weight for each datum; NULL (default) for all 1
    type(c_funptr) :: progress = c_null_funptr !! Hears of the progress and may cancel; NULL (default) for nobody
    type(c_ptr) :: user = c_null_ptr !! Handed to progress as it is
    !> Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag
    type(c_ptr) :: cancel = c_null_ptr
    !> Shows what the call is doing, before progress hears of it: a planish_stage
    type(c_ptr) :: out_stage = c_null_ptr
    !> Receives the error of each datum in model units: one number for each datum, or NULL (default)
    type(c_ptr) :: out_errors = c_null_ptr
    integer(c_int32_t) :: tolerance_scale = PLANISH_TOLERANCE_SCALE_RELATIVE !! A planish_tolerance_scale
    integer(c_int32_t) :: method = PLANISH_TENSOR_METHOD_LEAST_SQUARES !! A planish_tensor_method
    integer(c_int32_t) :: ends = PLANISH_ENDS_NATURAL !! A planish_ends
    integer(c_int32_t) :: max_grid = 257 !! Most knots, at least 2
    integer(c_int32_t) :: grid = 0 !! Knots to use without refinement, 2 to 8193; 0 (default) refines
    integer(c_int32_t) :: thread_count = 0 !! Threads to use, at most 1024; 0 (default) for all cores
  end type

  !> How points are interpolated.
  type, bind(c), public :: planish_interpolate_options
    integer(c_size_t) :: struct_size = 2 * word + 8
    !> For PLANISH_SECTION_ENDS_SLOPES: 2 rows of dim numbers, the derivatives with respect to u at the first and at
    !> the last point; otherwise NULL (default)
    type(c_ptr) :: end_slopes = c_null_ptr
    integer(c_int32_t) :: ends = PLANISH_SECTION_ENDS_AUTO !! A planish_section_ends
    integer(c_int32_t) :: reserved = 0
  end type

  !> What a skin did beside what every fit reports.
  type, bind(c), public :: planish_skin_report
    integer(c_size_t) :: struct_size = 10 * word + 32
    real(c_double) :: overshoot = 0 !! By how much control curves may be larger than the rows, 1 at least
    !> A bound of the distance between the surface and the skin through the section curves at any (u,v); NaN unless
    !> certify asked for it, or if a section is no cubic
    real(c_double) :: certified_distance = 0
    real(c_double) :: v_error = 0 !! The part of the error that fewer knots along v leave; 0 with a knot for each row
    !> The first row that looks reversed or shifted against the one before it, counted from 1; -1 if there is none
    integer(c_int64_t) :: twisted_row = 0
    integer(c_size_t) :: curve_count = 0 !! Control curves of the surface
    integer(c_size_t) :: least_count = 0 !! Control points of the shortest control curve
    integer(c_size_t) :: largest_count = 0 !! Control points of the longest control curve
    !> Control points of the same surface as a tensor surface: what planish_surface_to_tensor() makes
    integer(c_size_t) :: tensor_count = 0
    !> Control points of the same surface in strips: what PLANISH_STEP_FORM_STRIPS writes
    integer(c_size_t) :: strip_count = 0
    !> Control points of the skin over common knots; 0 unless compare asked for it
    integer(c_size_t) :: common_count = 0
    integer(c_size_t) :: removed_knot_count = 0 !! Knots that the removal pass took out
    integer(c_size_t) :: merged_point_count = 0 !! Points that lay on the one before them
    integer(c_size_t) :: aligned_row_count = 0 !! Rows that were turned round or given another first point
  end type

  !> Options of skins.
  type, bind(c), public :: planish_skin_options
    integer(c_size_t) :: struct_size = 12 * word + 72
    !> The largest error allowed at the points, positive, measured in tolerance_scale
    real(c_double) :: tolerance = 1e-3_c_double
    !> For each row two vectors of dim numbers, the slopes at its begin and its end, derivatives with respect to chord
    !> length (a unit tangent keeps the pace); NULL (default) unless ends is PLANISH_SECTION_ENDS_SLOPES
    type(c_ptr) :: end_slopes = c_null_ptr
    !> For each point of the first row, or each different knot of the first curve, a vector of dim numbers: the
    !> derivative across it with respect to length along v; NULL (default) for no curvature there
    type(c_ptr) :: begin_tangents = c_null_ptr
    type(c_ptr) :: end_tangents = c_null_ptr !! The same at the last row
    type(c_funptr) :: progress = c_null_funptr !! Hears of the progress and may cancel; NULL (default) for nobody
    type(c_ptr) :: user = c_null_ptr !! Handed to progress as it is
    !> Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag
    type(c_ptr) :: cancel = c_null_ptr
    !> Shows what the call is doing, before progress hears of it: a planish_stage
    type(c_ptr) :: out_stage = c_null_ptr
    !> Receives the (u,v) at which the error of each point is measured: two numbers for each point, or NULL (default;
    !> for curves it must be)
    type(c_ptr) :: out_parameters = c_null_ptr
    !> Receives the error of each point in model units, or NULL (default; for curves it must be)
    type(c_ptr) :: out_errors = c_null_ptr
    type(c_ptr) :: out_report = c_null_ptr !! Receives what only skins report, or NULL (default)
    integer(c_size_t) :: dim = 3 !! Numbers of a point, at least 1
    integer(c_int32_t) :: tolerance_scale = PLANISH_TOLERANCE_SCALE_RELATIVE !! A planish_tolerance_scale
    integer(c_int32_t) :: method = PLANISH_SKIN_METHOD_CONTROL_CURVES !! A planish_skin_method
    integer(c_int32_t) :: closed = 0 !! 1 if rows are closed: their first point is not repeated
    integer(c_int32_t) :: ends = PLANISH_SECTION_ENDS_AUTO !! A planish_section_ends
    !> 1 if the last row is followed by the first one; needs three rows, and no tangents
    integer(c_int32_t) :: closed_v = 0
    integer(c_int32_t) :: v_rule = PLANISH_V_RULE_ENDPOINTS !! A planish_v_rule
    !> 1 turns rows round, and moves the first point of closed ones, where that brings them nearer to the row before
    integer(c_int32_t) :: align = 0
    integer(c_int32_t) :: approximate_v = 0 !! 1 looks for fewer knots along v than rows
    !> Places between two data at which a control curve is checked too, at most 100; 0 as in the paper
    integer(c_int32_t) :: extra_checks = 3
    !> 1 inserts a knot into every span that needs one in each pass: faster, some more control points
    integer(c_int32_t) :: batch = 0
    integer(c_int32_t) :: removal = 0 !! 1 takes knots out again that turn out not to be needed
    integer(c_int32_t) :: certify = 0 !! 1 bounds the distance from the skin through the section curves
    !> 1 counts the control points of PLANISH_SKIN_METHOD_COMMON_KNOTS for the report
    integer(c_int32_t) :: compare = 0
    integer(c_int32_t) :: thread_count = 0 !! Threads to use, at most 1024; 0 (default) for all cores
    integer(c_int32_t) :: v_slopes = PLANISH_V_SLOPES_SMOOTH !! A planish_v_slopes
    integer(c_int32_t) :: reserved = 0
  end type

  !> Options of PHT fits.
  type, bind(c), public :: planish_pht_options
    integer(c_size_t) :: struct_size = 24 * word + 96
    !> The largest error allowed at the data, positive, measured in tolerance_scale
    real(c_double) :: tolerance = 1e-3_c_double
    !> Weight of the bending energy of each cell, mapped to the unit cell; lowered where cells cannot be split any
    !> more
    real(c_double) :: smoothing = 1e-3_c_double
    !> How a mesh without parameters gets them; NULL (default) for a circle, with one stretch step unless the
    !> tolerance is fine and the plain map even
    type(c_ptr) :: parameterize = c_null_ptr
    type(c_ptr) :: weights = c_null_ptr !! A positive weight for each datum; NULL (default) for all 1
    type(c_funptr) :: progress = c_null_funptr !! Hears of the progress and may cancel; NULL (default) for nobody
    type(c_ptr) :: user = c_null_ptr !! Handed to progress as it is
    !> Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag
    type(c_ptr) :: cancel = c_null_ptr
    !> Shows what the call is doing, before progress hears of it: a planish_stage
    type(c_ptr) :: out_stage = c_null_ptr
    !> Receives the (u,v) at which the error of each datum is measured: two numbers for each datum, or NULL (default)
    type(c_ptr) :: out_parameters = c_null_ptr
    !> Receives the error of each datum in model units: one number for each datum, or NULL (default)
    type(c_ptr) :: out_errors = c_null_ptr
    integer(c_size_t) :: max_cells = 200000 !! Most cells, at least the initial ones
    integer(c_int32_t) :: tolerance_scale = PLANISH_TOLERANCE_SCALE_RELATIVE !! A planish_tolerance_scale
    integer(c_int32_t) :: estimator = PLANISH_PHT_ESTIMATOR_GLOBAL !! A planish_pht_estimator
    integer(c_int32_t) :: regularize = PLANISH_REGULARIZE_AUTO !! A planish_regularize
    integer(c_int32_t) :: grid_u = 1 !! Cells along u to start from, 1 to 4095
    integer(c_int32_t) :: grid_v = 1 !! Cells along v to start from, 1 to 4095
    integer(c_int32_t) :: max_level = 12 !! Deepest level of a cell, at most 20
    integer(c_int32_t) :: min_samples = 2 !! A cell with fewer samples is not split, at least 1
    integer(c_int32_t) :: grade = 1 !! Levels by which cells that share an edge may differ; 0 for any number
    integer(c_int32_t) :: correction_sweeps = 1 !! Sweeps of parameter correction in each round of the fit of a shape
    integer(c_int32_t) :: measure_distance = 0 !! 1 measures the closest-point distance of the nodes for the report
    integer(c_int32_t) :: thread_count = 0 !! Threads to use, at most 1024; 0 (default) for all cores
    integer(c_int32_t) :: symmetry = PLANISH_SYMMETRY_NONE !! A planish_symmetry, for the shape of a mesh
    !> A planish_missing: what values of points and fields mean that are NaN
    integer(c_int32_t) :: missing = PLANISH_MISSING_REFUSED
    integer(c_int32_t) :: reserved_end = 0 !! 0
    !> A tolerance for each datum in tolerance_scale, positive, in place of tolerance; infinity leaves the datum out:
    !> it is not fitted, and its error does not count
    type(c_ptr) :: tolerances = c_null_ptr
    !> Numbers of data that the surface passes through, to 1e-12 of the diagonal of the data's box, by linear
    !> conditions on its coefficients
    type(c_ptr) :: fixed = c_null_ptr
    !> Receives 1 for each datum that was taken for a gross error and left out, else 0; NULL (default) for no such
    !> list
    type(c_ptr) :: out_left_out = c_null_ptr
    !> The largest share of the data that may be gross errors, at most 0.25: those that stand out most from their
    !> neighbours are left out of the fit
    real(c_double) :: outlier_share = 0
    !> A gross error misses the surface of the other data by more than this, in tolerance_scale: such data are left
    !> out
    real(c_double) :: outlier_scale = 0
    integer(c_size_t) :: fixed_count = 0 !! Numbers in fixed
    !> A place in the plane of symmetry and a normal of it, for PLANISH_SYMMETRY_ABOUT; else NULL (default)
    type(c_ptr) :: plane = c_null_ptr
    !> Receives a place in the plane of symmetry and its unit normal, if symmetry was asked for; NULL (default) for
    !> nobody
    type(c_ptr) :: out_plane = c_null_ptr
    !> The curve that the side at the least u is, exactly; NULL (default) for a free side
    type(c_ptr) :: curve_u_low = c_null_ptr
    !> The curve that the side at the largest u is, exactly; NULL (default) for a free side
    type(c_ptr) :: curve_u_high = c_null_ptr
    !> The curve that the side at the least v is, exactly; NULL (default) for a free side
    type(c_ptr) :: curve_v_low = c_null_ptr
    !> The curve that the side at the largest v is, exactly; NULL (default) for a free side
    type(c_ptr) :: curve_v_high = c_null_ptr
    !> The tensor surface or PHT-spline beyond the side at the least u; NULL (default) for none
    type(c_ptr) :: neighbour_u_low = c_null_ptr
    !> The tensor surface or PHT-spline beyond the side at the largest u; NULL (default) for none
    type(c_ptr) :: neighbour_u_high = c_null_ptr
    !> The tensor surface or PHT-spline beyond the side at the least v; NULL (default) for none
    type(c_ptr) :: neighbour_v_low = c_null_ptr
    !> The tensor surface or PHT-spline beyond the side at the largest v; NULL (default) for none
    type(c_ptr) :: neighbour_v_high = c_null_ptr
    integer(c_int32_t) :: continuity = 1 !! Continuous derivatives of the surface: 1 (default), or 2
    integer(c_int32_t) :: coarsening = PLANISH_COARSENING_AUTO !! A planish_coarsening
  end type

  !> How a PHT-spline is simplified.
  type, bind(c), public :: planish_pht_simplify_options
    integer(c_size_t) :: struct_size = 5 * word
    type(c_funptr) :: progress = c_null_funptr !! Hears of the progress and may cancel; NULL (default) for nobody
    type(c_ptr) :: user = c_null_ptr !! Handed to progress as it is
    !> Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag
    type(c_ptr) :: cancel = c_null_ptr
    !> Shows what the call is doing, before progress hears of it: a planish_stage
    type(c_ptr) :: out_stage = c_null_ptr
  end type

  !> How a tensor surface becomes a PHT-spline.
  type, bind(c), public :: planish_pht_convert_options
    integer(c_size_t) :: struct_size = 6 * word + 16
    !> Largest distance at equal parameters, in model units; 0 (default) takes all knot lines, which is exact up to
    !> degree 3
    real(c_double) :: tolerance = 0
    integer(c_size_t) :: max_cells = 200000 !! Most cells; with more the call fails
    type(c_funptr) :: progress = c_null_funptr !! Hears of the progress and may cancel; NULL (default) for nobody
    type(c_ptr) :: user = c_null_ptr !! Handed to progress as it is
    !> Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag
    type(c_ptr) :: cancel = c_null_ptr
    !> Shows what the call is doing, before progress hears of it: a planish_stage
    type(c_ptr) :: out_stage = c_null_ptr
    integer(c_int32_t) :: max_level = 12 !! Deepest level of a cell, at most 20
    integer(c_int32_t) :: reserved = 0
  end type

  !> How a PHT-spline becomes tensor surfaces.
  type, bind(c), public :: planish_pht_patches_options
    integer(c_size_t) :: struct_size = 5 * word + 8
    type(c_funptr) :: progress = c_null_funptr !! Hears of the progress and may cancel; NULL (default) for nobody
    type(c_ptr) :: user = c_null_ptr !! Handed to progress as it is
    !> Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag
    type(c_ptr) :: cancel = c_null_ptr
    !> Shows what the call is doing, before progress hears of it: a planish_stage
    type(c_ptr) :: out_stage = c_null_ptr
    !> By how much the levels of cells in one surface may differ: many small ones for 0 (default), one for 20
    integer(c_int32_t) :: level_spread = 0
    integer(c_int32_t) :: reserved = 0
  end type

  !> Options of D1RC-splines and of fits by them.
  type, bind(c), public :: planish_d1rc_options
    integer(c_size_t) :: struct_size = 16 * word + 64
    !> sharp_edge_count pairs of nodes joined by an edge; NULL (default) for none
    type(c_ptr) :: sharp_edges = c_null_ptr
    integer(c_size_t) :: sharp_edge_count = 0 !! Pairs in sharp_edges
    type(c_ptr) :: corners = c_null_ptr !! corner_count nodes to be interpolated; NULL (default) for none
    integer(c_size_t) :: corner_count = 0 !! Nodes in corners
    !> Edges whose faces meet at more than this angle in radians are sharp as well, up to pi; 0 (default) for none
    real(c_double) :: sharp_angle = 0
    !> Weight of the functions that sharp edges and corners add with PLANISH_D1RC_SHARP_SECTOR and
    !> PLANISH_D1RC_SHARP_ADDITIVE, positive
    real(c_double) :: sharp_weight = 1
    !> How a mesh without parameters gets them; NULL (default) for the defaults
    type(c_ptr) :: parameterize = c_null_ptr
    !> Hears of the progress of the parameters and may cancel; NULL (default) for nobody
    type(c_funptr) :: progress = c_null_funptr
    type(c_ptr) :: user = c_null_ptr !! Handed to progress as it is
    !> Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag
    type(c_ptr) :: cancel = c_null_ptr
    !> Shows what the call is doing, before progress hears of it: a planish_stage
    type(c_ptr) :: out_stage = c_null_ptr
    !> Fits only: the largest error allowed at the nodes, positive, measured in tolerance_scale
    real(c_double) :: tolerance = 1e-3_c_double
    !> Fits only: weight of the energy that determines control points without data, positive
    real(c_double) :: smoothing = 1e-5_c_double
    !> Fits only: the control mesh to use as it is; NULL (default) for the mesh itself with fewer nodes, its boundary
    !> and sharp edges kept
    type(c_ptr) :: control_mesh = c_null_ptr
    type(c_ptr) :: weights = c_null_ptr !! Fits only: a positive weight for each node; NULL (default) for all 1
    !> Fits only: receives the (u,v) at which the error of each node is measured: two numbers for each node, or NULL
    !> (default)
    type(c_ptr) :: out_parameters = c_null_ptr
    !> Fits only: receives the error of each node in model units: one number for each node, or NULL (default)
    type(c_ptr) :: out_errors = c_null_ptr
    !> Fits only: vertices of the control mesh that is made, at least 3; 0 (default) for as many as the tolerance
    !> takes
    integer(c_size_t) :: control_count = 0
    !> Fits only: most vertices of a control mesh that is made, at least 3
    integer(c_size_t) :: max_control_count = 100000
    integer(c_int32_t) :: degree = 3 !! 1, 2 or 3
    integer(c_int32_t) :: mode = PLANISH_D1RC_MODE_REPRODUCING !! A planish_d1rc_mode
    integer(c_int32_t) :: boundary = PLANISH_D1RC_BOUNDARY_PHANTOM !! A planish_d1rc_boundary
    integer(c_int32_t) :: sharp = PLANISH_D1RC_SHARP_AUTOMATIC !! A planish_d1rc_sharp
    integer(c_int32_t) :: tolerance_scale = PLANISH_TOLERANCE_SCALE_RELATIVE !! Fits only: a planish_tolerance_scale
    !> Fits only: sweeps in each round in which nodes move to their foot points and those with large errors gain
    !> weight
    integer(c_int32_t) :: correction_sweeps = 3
    integer(c_int32_t) :: thread_count = 0 !! Threads to use, at most 1024; 0 (default) for all cores
    integer(c_int32_t) :: reserved = 0
  end type

end module

!> The functions of planish.h as they are: planish_x of C is c_x. NULL is an absent argument.
module planish_calls
  use, intrinsic :: iso_c_binding
  use planish_records
  implicit none
  public

  interface
    type(c_ptr) function c_version() bind(c, name="planish_version")
      import
      implicit none
    end function

    integer(c_int) function c_check_version(major, minor) bind(c, name="planish_check_version")
      import
      implicit none
      integer(c_int32_t), value :: major
      integer(c_int32_t), value :: minor
    end function

    type(c_ptr) function c_status_name(status) bind(c, name="planish_status_name")
      import
      implicit none
      integer(c_int32_t), value :: status
    end function

    integer(c_size_t) function c_error_message(text, size) bind(c, name="planish_error_message")
      import
      implicit none
      character(kind=c_char), intent(inout), optional :: text(*)
      integer(c_size_t), value :: size
    end function

    integer(c_int64_t) function c_error_index() bind(c, name="planish_error_index")
      import
      implicit none
    end function

    integer(c_int) function c_mesh_options_init(options, struct_size) bind(c, name="planish_mesh_options_init")
      import
      implicit none
      type(planish_mesh_options), intent(inout) :: options
      integer(c_size_t), value :: struct_size
    end function

    integer(c_int) function c_mesh_new( &
        points, point_count, triangles, triangle_count, options, out_mesh) &
        bind(c, name="planish_mesh_new")
      import
      implicit none
      real(c_double), intent(in) :: points(*)
      integer(c_size_t), value :: point_count
      integer(c_int32_t), intent(in) :: triangles(*)
      integer(c_size_t), value :: triangle_count
      type(planish_mesh_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: out_mesh
    end function

    integer(c_int) function c_mesh_clone(mesh, out_mesh) bind(c, name="planish_mesh_clone")
      import
      implicit none
      type(c_ptr), value :: mesh
      type(c_ptr), intent(inout) :: out_mesh
    end function

    subroutine c_mesh_free(mesh) bind(c, name="planish_mesh_free")
      import
      implicit none
      type(c_ptr), value :: mesh
    end subroutine

    pure integer(c_size_t) function c_mesh_point_count(mesh) bind(c, name="planish_mesh_point_count")
      import
      implicit none
      type(c_ptr), value :: mesh
    end function

    pure integer(c_size_t) function c_mesh_triangle_count(mesh) bind(c, name="planish_mesh_triangle_count")
      import
      implicit none
      type(c_ptr), value :: mesh
    end function

    pure integer(c_size_t) function c_mesh_edge_count(mesh) bind(c, name="planish_mesh_edge_count")
      import
      implicit none
      type(c_ptr), value :: mesh
    end function

    pure integer(c_size_t) function c_mesh_component_count(mesh) bind(c, name="planish_mesh_component_count")
      import
      implicit none
      type(c_ptr), value :: mesh
    end function

    pure integer(c_size_t) function c_mesh_genus(mesh) bind(c, name="planish_mesh_genus")
      import
      implicit none
      type(c_ptr), value :: mesh
    end function

    pure integer(c_int64_t) function c_mesh_euler_characteristic( &
        mesh) &
        bind(c, name="planish_mesh_euler_characteristic")
      import
      implicit none
      type(c_ptr), value :: mesh
    end function

    pure integer(c_size_t) function c_mesh_loop_count(mesh) bind(c, name="planish_mesh_loop_count")
      import
      implicit none
      type(c_ptr), value :: mesh
    end function

    pure integer(c_size_t) function c_mesh_loop_point_count(mesh, loop) bind(c, name="planish_mesh_loop_point_count")
      import
      implicit none
      type(c_ptr), value :: mesh
      integer(c_size_t), value :: loop
    end function

    integer(c_int) function c_mesh_copy_points(mesh, out_points, count) bind(c, name="planish_mesh_copy_points")
      import
      implicit none
      type(c_ptr), value :: mesh
      real(c_double), intent(inout) :: out_points(*)
      integer(c_size_t), value :: count
    end function

    integer(c_int) function c_mesh_copy_triangles( &
        mesh, out_triangles, count) &
        bind(c, name="planish_mesh_copy_triangles")
      import
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int32_t), intent(inout) :: out_triangles(*)
      integer(c_size_t), value :: count
    end function

    integer(c_int) function c_mesh_copy_node_map(mesh, out_nodes, count) bind(c, name="planish_mesh_copy_node_map")
      import
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int32_t), intent(inout) :: out_nodes(*)
      integer(c_size_t), value :: count
    end function

    integer(c_int) function c_mesh_copy_triangle_map( &
        mesh, out_triangles, count) &
        bind(c, name="planish_mesh_copy_triangle_map")
      import
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int32_t), intent(inout) :: out_triangles(*)
      integer(c_size_t), value :: count
    end function

    integer(c_int) function c_mesh_set_points(mesh, points, count) bind(c, name="planish_mesh_set_points")
      import
      implicit none
      type(c_ptr), value :: mesh
      real(c_double), intent(in) :: points(*)
      integer(c_size_t), value :: count
    end function

    integer(c_int) function c_mesh_copy_loop(mesh, loop, out_nodes, count) bind(c, name="planish_mesh_copy_loop")
      import
      implicit none
      type(c_ptr), value :: mesh
      integer(c_size_t), value :: loop
      integer(c_int32_t), intent(inout) :: out_nodes(*)
      integer(c_size_t), value :: count
    end function

    pure integer(c_size_t) function c_mesh_field_count(mesh) bind(c, name="planish_mesh_field_count")
      import
      implicit none
      type(c_ptr), value :: mesh
    end function

    integer(c_size_t) function c_mesh_field_name(mesh, field, name, size) bind(c, name="planish_mesh_field_name")
      import
      implicit none
      type(c_ptr), value :: mesh
      integer(c_size_t), value :: field
      character(kind=c_char), intent(inout), optional :: name(*)
      integer(c_size_t), value :: size
    end function

    integer(c_int) function c_mesh_copy_field(mesh, name, out_values, count) bind(c, name="planish_mesh_copy_field")
      import
      implicit none
      type(c_ptr), value :: mesh
      character(kind=c_char), intent(in) :: name(*)
      real(c_double), intent(inout) :: out_values(*)
      integer(c_size_t), value :: count
    end function

    integer(c_int) function c_mesh_set_field(mesh, name, values, count) bind(c, name="planish_mesh_set_field")
      import
      implicit none
      type(c_ptr), value :: mesh
      character(kind=c_char), intent(in) :: name(*)
      real(c_double), intent(in) :: values(*)
      integer(c_size_t), value :: count
    end function

    integer(c_int) function c_mesh_remove_field(mesh, name) bind(c, name="planish_mesh_remove_field")
      import
      implicit none
      type(c_ptr), value :: mesh
      character(kind=c_char), intent(in) :: name(*)
    end function

    pure integer(c_int32_t) function c_mesh_has_parameters(mesh) bind(c, name="planish_mesh_has_parameters")
      import
      implicit none
      type(c_ptr), value :: mesh
    end function

    integer(c_int) function c_mesh_set_parameters(mesh, uv, count) bind(c, name="planish_mesh_set_parameters")
      import
      implicit none
      type(c_ptr), value :: mesh
      real(c_double), intent(in) :: uv(*)
      integer(c_size_t), value :: count
    end function

    integer(c_int) function c_mesh_copy_parameters(mesh, out_uv, count) bind(c, name="planish_mesh_copy_parameters")
      import
      implicit none
      type(c_ptr), value :: mesh
      real(c_double), intent(inout) :: out_uv(*)
      integer(c_size_t), value :: count
    end function

    integer(c_int) function c_mesh_remove_triangles( &
        mesh, triangles, count, out_mesh) &
        bind(c, name="planish_mesh_remove_triangles")
      import
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int32_t), intent(in) :: triangles(*)
      integer(c_size_t), value :: count
      type(c_ptr), intent(inout) :: out_mesh
    end function

    integer(c_int) function c_mesh_cut_along(mesh, nodes, count, out_mesh) bind(c, name="planish_mesh_cut_along")
      import
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int32_t), intent(in) :: nodes(*)
      integer(c_size_t), value :: count
      type(c_ptr), intent(inout) :: out_mesh
    end function

    integer(c_int) function c_mesh_split_components( &
        mesh, out_meshes, count) &
        bind(c, name="planish_mesh_split_components")
      import
      implicit none
      type(c_ptr), value :: mesh
      type(c_ptr), intent(inout) :: out_meshes(*)
      integer(c_size_t), value :: count
    end function

    integer(c_int) function c_mesh_shortest_path( &
        mesh, from, to, out_nodes, count, out_count) &
        bind(c, name="planish_mesh_shortest_path")
      import
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int32_t), value :: from
      integer(c_int32_t), value :: to
      integer(c_int32_t), intent(inout), optional :: out_nodes(*)
      integer(c_size_t), value :: count
      integer(c_size_t), intent(inout) :: out_count
    end function

    integer(c_int) function c_mesh_write_options_init( &
        options, struct_size) &
        bind(c, name="planish_mesh_write_options_init")
      import
      implicit none
      type(planish_mesh_write_options), intent(inout) :: options
      integer(c_size_t), value :: struct_size
    end function

    integer(c_int) function c_mesh_read(path, options, out_mesh) bind(c, name="planish_mesh_read")
      import
      implicit none
      character(kind=c_char), intent(in) :: path(*)
      type(planish_mesh_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: out_mesh
    end function

    integer(c_int) function c_mesh_read_buffer( &
        buffer, size, options, out_mesh) &
        bind(c, name="planish_mesh_read_buffer")
      import
      implicit none
      integer(c_int8_t), intent(in) :: buffer(*)
      integer(c_size_t), value :: size
      type(planish_mesh_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: out_mesh
    end function

    integer(c_int) function c_mesh_write(mesh, path, options) bind(c, name="planish_mesh_write")
      import
      implicit none
      type(c_ptr), value :: mesh
      character(kind=c_char), intent(in) :: path(*)
      type(planish_mesh_write_options), intent(in), optional :: options
    end function

    integer(c_int) function c_decimate_options_init( &
        options, struct_size) &
        bind(c, name="planish_decimate_options_init")
      import
      implicit none
      type(planish_decimate_options), intent(inout) :: options
      integer(c_size_t), value :: struct_size
    end function

    integer(c_int) function c_mesh_decimate(mesh, options, out_mesh, out_report) bind(c, name="planish_mesh_decimate")
      import
      implicit none
      type(c_ptr), value :: mesh
      type(planish_decimate_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: out_mesh
      type(planish_decimate_report), intent(inout), optional :: out_report
    end function

    integer(c_int) function c_parameterize_options_init( &
        options, struct_size) &
        bind(c, name="planish_parameterize_options_init")
      import
      implicit none
      type(planish_parameterize_options), intent(inout) :: options
      integer(c_size_t), value :: struct_size
    end function

    integer(c_int) function c_mesh_parameterize(mesh, options, out_report) bind(c, name="planish_mesh_parameterize")
      import
      implicit none
      type(c_ptr), value :: mesh
      type(planish_parameterize_options), intent(in), optional :: options
      type(planish_parameterize_report), intent(inout), optional :: out_report
    end function

    integer(c_int) function c_sphere_options_init(options, struct_size) bind(c, name="planish_sphere_options_init")
      import
      implicit none
      type(planish_sphere_options), intent(inout) :: options
      integer(c_size_t), value :: struct_size
    end function

    integer(c_int) function c_mesh_map_to_sphere( &
        mesh, options, out_points, count, out_report) &
        bind(c, name="planish_mesh_map_to_sphere")
      import
      implicit none
      type(c_ptr), value :: mesh
      type(planish_sphere_options), intent(in), optional :: options
      real(c_double), intent(inout) :: out_points(*)
      integer(c_size_t), value :: count
      type(planish_sphere_report), intent(inout), optional :: out_report
    end function

    integer(c_int) function c_feature_options_init(options, struct_size) bind(c, name="planish_feature_options_init")
      import
      implicit none
      type(planish_feature_options), intent(inout) :: options
      integer(c_size_t), value :: struct_size
    end function

    integer(c_int) function c_mesh_find_features( &
        mesh, options, out_edges, count, out_count) &
        bind(c, name="planish_mesh_find_features")
      import
      implicit none
      type(c_ptr), value :: mesh
      type(planish_feature_options), intent(in), optional :: options
      integer(c_int32_t), intent(inout), optional :: out_edges(*)
      integer(c_size_t), value :: count
      integer(c_size_t), intent(inout) :: out_count
    end function

    integer(c_int) function c_mesh_label_parts( &
        mesh, labels, label_count, out_labels, out_triangle_counts, out_piece_counts, out_handle_counts, count, &
        out_count) &
        bind(c, name="planish_mesh_label_parts")
      import
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int32_t), intent(in) :: labels(*)
      integer(c_size_t), value :: label_count
      integer(c_int32_t), intent(inout), optional :: out_labels(*)
      integer(c_size_t), intent(inout), optional :: out_triangle_counts(*)
      integer(c_size_t), intent(inout), optional :: out_piece_counts(*)
      integer(c_size_t), intent(inout), optional :: out_handle_counts(*)
      integer(c_size_t), value :: count
      integer(c_size_t), intent(inout) :: out_count
    end function

    integer(c_int) function c_layout_options_init(options, struct_size) bind(c, name="planish_layout_options_init")
      import
      implicit none
      type(planish_layout_options), intent(inout) :: options
      integer(c_size_t), value :: struct_size
    end function

    integer(c_int) function c_mesh_layout_options_init( &
        options, struct_size) &
        bind(c, name="planish_mesh_layout_options_init")
      import
      implicit none
      type(planish_mesh_layout_options), intent(inout) :: options
      integer(c_size_t), value :: struct_size
    end function

    integer(c_int) function c_layout_new(corners, quad_count, options, out_layout) bind(c, name="planish_layout_new")
      import
      implicit none
      integer(c_int32_t), intent(in) :: corners(*)
      integer(c_size_t), value :: quad_count
      type(planish_layout_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: out_layout
    end function

    integer(c_int) function c_layout_cube(out_layout) bind(c, name="planish_layout_cube")
      import
      implicit none
      type(c_ptr), intent(inout) :: out_layout
    end function

    integer(c_int) function c_layout_of_mesh( &
        mesh, options, out_layout, out_report) &
        bind(c, name="planish_layout_of_mesh")
      import
      implicit none
      type(c_ptr), value :: mesh
      type(planish_mesh_layout_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: out_layout
      type(planish_mesh_layout_report), intent(inout), optional :: out_report
    end function

    subroutine c_layout_free(layout) bind(c, name="planish_layout_free")
      import
      implicit none
      type(c_ptr), value :: layout
    end subroutine

    pure integer(c_size_t) function c_layout_quad_count(layout) bind(c, name="planish_layout_quad_count")
      import
      implicit none
      type(c_ptr), value :: layout
    end function

    pure integer(c_size_t) function c_layout_vertex_count(layout) bind(c, name="planish_layout_vertex_count")
      import
      implicit none
      type(c_ptr), value :: layout
    end function

    pure integer(c_size_t) function c_layout_edge_count(layout) bind(c, name="planish_layout_edge_count")
      import
      implicit none
      type(c_ptr), value :: layout
    end function

    pure integer(c_size_t) function c_layout_node_count(layout) bind(c, name="planish_layout_node_count")
      import
      implicit none
      type(c_ptr), value :: layout
    end function

    integer(c_int) function c_layout_copy_corners( &
        layout, out_corners, count) &
        bind(c, name="planish_layout_copy_corners")
      import
      implicit none
      type(c_ptr), value :: layout
      integer(c_int32_t), intent(inout) :: out_corners(*)
      integer(c_size_t), value :: count
    end function

    integer(c_int) function c_layout_copy_edges(layout, out_edges, count) bind(c, name="planish_layout_copy_edges")
      import
      implicit none
      type(c_ptr), value :: layout
      integer(c_int32_t), intent(inout) :: out_edges(*)
      integer(c_size_t), value :: count
    end function

    integer(c_int) function c_layout_copy_valences( &
        layout, out_valences, count) &
        bind(c, name="planish_layout_copy_valences")
      import
      implicit none
      type(c_ptr), value :: layout
      integer(c_int32_t), intent(inout) :: out_valences(*)
      integer(c_size_t), value :: count
    end function

    integer(c_int) function c_layout_copy_node_map( &
        layout, out_quads, out_uv, count) &
        bind(c, name="planish_layout_copy_node_map")
      import
      implicit none
      type(c_ptr), value :: layout
      integer(c_int32_t), intent(inout) :: out_quads(*)
      real(c_double), intent(inout) :: out_uv(*)
      integer(c_size_t), value :: count
    end function

    pure integer(c_int32_t) function c_surface_kind(surface) bind(c, name="planish_surface_kind")
      import
      implicit none
      type(c_ptr), value :: surface
    end function

    pure integer(c_size_t) function c_surface_dim(surface) bind(c, name="planish_surface_dim")
      import
      implicit none
      type(c_ptr), value :: surface
    end function

    pure integer(c_size_t) function c_surface_coefficient_count( &
        surface) &
        bind(c, name="planish_surface_coefficient_count")
      import
      implicit none
      type(c_ptr), value :: surface
    end function

    integer(c_int) function c_surface_domain(surface, out_box) bind(c, name="planish_surface_domain")
      import
      implicit none
      type(c_ptr), value :: surface
      real(c_double), intent(inout) :: out_box(*)
    end function

    integer(c_int) function c_surface_data_box(surface, out_box) bind(c, name="planish_surface_data_box")
      import
      implicit none
      type(c_ptr), value :: surface
      real(c_double), intent(inout) :: out_box(*)
    end function

    integer(c_int) function c_surface_clone(surface, out_surface) bind(c, name="planish_surface_clone")
      import
      implicit none
      type(c_ptr), value :: surface
      type(c_ptr), intent(inout) :: out_surface
    end function

    subroutine c_surface_free(surface) bind(c, name="planish_surface_free")
      import
      implicit none
      type(c_ptr), value :: surface
    end subroutine

    integer(c_int) function c_eval_options_init(options, struct_size) bind(c, name="planish_eval_options_init")
      import
      implicit none
      type(planish_eval_options), intent(inout) :: options
      integer(c_size_t), value :: struct_size
    end function

    integer(c_int) function c_surface_eval( &
        surface, uv, count, options, out_values) &
        bind(c, name="planish_surface_eval")
      import
      implicit none
      type(c_ptr), value :: surface
      real(c_double), intent(in) :: uv(*)
      integer(c_size_t), value :: count
      type(planish_eval_options), intent(in), optional :: options
      real(c_double), intent(inout) :: out_values(*)
    end function

    integer(c_int) function c_surface_eval_derivatives( &
        surface, uv, count, max_derivative, options, out) &
        bind(c, name="planish_surface_eval_derivatives")
      import
      implicit none
      type(c_ptr), value :: surface
      real(c_double), intent(in) :: uv(*)
      integer(c_size_t), value :: count
      integer(c_int32_t), value :: max_derivative
      type(planish_eval_options), intent(in), optional :: options
      real(c_double), intent(inout) :: out(*)
    end function

    integer(c_int) function c_surface_eval_grid( &
        surface, u, u_count, v, v_count, options, out_values) &
        bind(c, name="planish_surface_eval_grid")
      import
      implicit none
      type(c_ptr), value :: surface
      real(c_double), intent(in) :: u(*)
      integer(c_size_t), value :: u_count
      real(c_double), intent(in) :: v(*)
      integer(c_size_t), value :: v_count
      type(planish_eval_options), intent(in), optional :: options
      real(c_double), intent(inout) :: out_values(*)
    end function

    integer(c_int) function c_surface_normals( &
        surface, uv, count, options, out_normals) &
        bind(c, name="planish_surface_normals")
      import
      implicit none
      type(c_ptr), value :: surface
      real(c_double), intent(in) :: uv(*)
      integer(c_size_t), value :: count
      type(planish_eval_options), intent(in), optional :: options
      real(c_double), intent(inout) :: out_normals(*)
    end function

    integer(c_int) function c_surface_curvatures( &
        surface, uv, count, options, out) &
        bind(c, name="planish_surface_curvatures")
      import
      implicit none
      type(c_ptr), value :: surface
      real(c_double), intent(in) :: uv(*)
      integer(c_size_t), value :: count
      type(planish_eval_options), intent(in), optional :: options
      real(c_double), intent(inout) :: out(*)
    end function

    pure integer(c_size_t) function c_surface_trim_count(surface) bind(c, name="planish_surface_trim_count")
      import
      implicit none
      type(c_ptr), value :: surface
    end function

    pure integer(c_size_t) function c_surface_trim_point_count( &
        surface, trim) &
        bind(c, name="planish_surface_trim_point_count")
      import
      implicit none
      type(c_ptr), value :: surface
      integer(c_size_t), value :: trim
    end function

    integer(c_int) function c_surface_copy_trim( &
        surface, trim, out_uv, count) &
        bind(c, name="planish_surface_copy_trim")
      import
      implicit none
      type(c_ptr), value :: surface
      integer(c_size_t), value :: trim
      real(c_double), intent(inout) :: out_uv(*)
      integer(c_size_t), value :: count
    end function

    integer(c_int) function c_surface_set_trims( &
        surface, uv, point_counts, trim_count) &
        bind(c, name="planish_surface_set_trims")
      import
      implicit none
      type(c_ptr), value :: surface
      real(c_double), intent(in) :: uv(*)
      integer(c_size_t), intent(in) :: point_counts(*)
      integer(c_size_t), value :: trim_count
    end function

    integer(c_int) function c_trim_options_init(options, struct_size) bind(c, name="planish_trim_options_init")
      import
      implicit none
      type(planish_trim_options), intent(inout) :: options
      integer(c_size_t), value :: struct_size
    end function

    integer(c_int) function c_surface_trim_by_curves( &
        surface, curves, curve_counts, trim_count, options, out_report) &
        bind(c, name="planish_surface_trim_by_curves")
      import
      implicit none
      type(c_ptr), value :: surface
      type(c_ptr), intent(in) :: curves(*)
      integer(c_size_t), intent(in), optional :: curve_counts(*)
      integer(c_size_t), value :: trim_count
      type(planish_trim_options), intent(in), optional :: options
      type(planish_trim_report), intent(inout), optional :: out_report
    end function

    pure integer(c_size_t) function c_surface_patch_count(surface) bind(c, name="planish_surface_patch_count")
      import
      implicit none
      type(c_ptr), value :: surface
    end function

    pure integer(c_size_t) function c_surface_patch_at(surface, u, v) bind(c, name="planish_surface_patch_at")
      import
      implicit none
      type(c_ptr), value :: surface
      real(c_double), value :: u
      real(c_double), value :: v
    end function

    integer(c_int) function c_surface_copy_patch( &
        surface, index, out_patch, out_ordinates, count) &
        bind(c, name="planish_surface_copy_patch")
      import
      implicit none
      type(c_ptr), value :: surface
      integer(c_size_t), value :: index
      type(planish_patch), intent(inout), optional :: out_patch
      real(c_double), intent(inout), optional :: out_ordinates(*)
      integer(c_size_t), value :: count
    end function

    integer(c_int) function c_convert_options_init(options, struct_size) bind(c, name="planish_convert_options_init")
      import
      implicit none
      type(planish_convert_options), intent(inout) :: options
      integer(c_size_t), value :: struct_size
    end function

    integer(c_int) function c_surface_to_tensor( &
        surface, options, out_surface) &
        bind(c, name="planish_surface_to_tensor")
      import
      implicit none
      type(c_ptr), value :: surface
      type(planish_convert_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: out_surface
    end function

    integer(c_int) function c_tensor_options_init(options, struct_size) bind(c, name="planish_tensor_options_init")
      import
      implicit none
      type(planish_tensor_options), intent(inout) :: options
      integer(c_size_t), value :: struct_size
    end function

    integer(c_int) function c_tensor_fit(mesh, options, out_surface, out_report) bind(c, name="planish_tensor_fit")
      import
      implicit none
      type(c_ptr), value :: mesh
      type(planish_tensor_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: out_surface
      type(planish_fit_report), intent(inout), optional :: out_report
    end function

    integer(c_int) function c_tensor_fit_points( &
        uv, values, count, dim, options, out_surface, out_report) &
        bind(c, name="planish_tensor_fit_points")
      import
      implicit none
      real(c_double), intent(in) :: uv(*)
      real(c_double), intent(in) :: values(*)
      integer(c_size_t), value :: count
      integer(c_size_t), value :: dim
      type(planish_tensor_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: out_surface
      type(planish_fit_report), intent(inout), optional :: out_report
    end function

    integer(c_int) function c_tensor_fit_field( &
        mesh, values, count, dim, options, out_surface, out_report) &
        bind(c, name="planish_tensor_fit_field")
      import
      implicit none
      type(c_ptr), value :: mesh
      real(c_double), intent(in) :: values(*)
      integer(c_size_t), value :: count
      integer(c_size_t), value :: dim
      type(planish_tensor_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: out_surface
      type(planish_fit_report), intent(inout), optional :: out_report
    end function

    integer(c_int) function c_tensor_new( &
        dim, degree_u, degree_v, knots_u, knot_count_u, knots_v, knot_count_v, control_points, weights, &
        out_surface) &
        bind(c, name="planish_tensor_new")
      import
      implicit none
      integer(c_size_t), value :: dim
      integer(c_int32_t), value :: degree_u
      integer(c_int32_t), value :: degree_v
      real(c_double), intent(in) :: knots_u(*)
      integer(c_size_t), value :: knot_count_u
      real(c_double), intent(in) :: knots_v(*)
      integer(c_size_t), value :: knot_count_v
      real(c_double), intent(in) :: control_points(*)
      real(c_double), intent(in), optional :: weights(*)
      type(c_ptr), intent(inout) :: out_surface
    end function

    pure integer(c_int32_t) function c_tensor_degree(surface, axis) bind(c, name="planish_tensor_degree")
      import
      implicit none
      type(c_ptr), value :: surface
      integer(c_int32_t), value :: axis
    end function

    pure integer(c_size_t) function c_tensor_knot_count(surface, axis) bind(c, name="planish_tensor_knot_count")
      import
      implicit none
      type(c_ptr), value :: surface
      integer(c_int32_t), value :: axis
    end function

    pure integer(c_size_t) function c_tensor_control_point_count( &
        surface, axis) &
        bind(c, name="planish_tensor_control_point_count")
      import
      implicit none
      type(c_ptr), value :: surface
      integer(c_int32_t), value :: axis
    end function

    integer(c_int) function c_tensor_copy_knots( &
        surface, axis, out_knots, count) &
        bind(c, name="planish_tensor_copy_knots")
      import
      implicit none
      type(c_ptr), value :: surface
      integer(c_int32_t), value :: axis
      real(c_double), intent(inout) :: out_knots(*)
      integer(c_size_t), value :: count
    end function

    integer(c_int) function c_tensor_copy_control_points( &
        surface, out_control_points, count) &
        bind(c, name="planish_tensor_copy_control_points")
      import
      implicit none
      type(c_ptr), value :: surface
      real(c_double), intent(inout) :: out_control_points(*)
      integer(c_size_t), value :: count
    end function

    pure integer(c_int32_t) function c_tensor_has_weights(surface) bind(c, name="planish_tensor_has_weights")
      import
      implicit none
      type(c_ptr), value :: surface
    end function

    integer(c_int) function c_tensor_copy_weights( &
        surface, out_weights, count) &
        bind(c, name="planish_tensor_copy_weights")
      import
      implicit none
      type(c_ptr), value :: surface
      real(c_double), intent(inout) :: out_weights(*)
      integer(c_size_t), value :: count
    end function

    integer(c_int) function c_tensor_insert_knots( &
        surface, axis, knots, count) &
        bind(c, name="planish_tensor_insert_knots")
      import
      implicit none
      type(c_ptr), value :: surface
      integer(c_int32_t), value :: axis
      real(c_double), intent(in) :: knots(*)
      integer(c_size_t), value :: count
    end function

    integer(c_int) function c_tensor_elevate_degree( &
        surface, axis, degree) &
        bind(c, name="planish_tensor_elevate_degree")
      import
      implicit none
      type(c_ptr), value :: surface
      integer(c_int32_t), value :: axis
      integer(c_int32_t), value :: degree
    end function

    integer(c_int) function c_tensor_reverse(surface, axis) bind(c, name="planish_tensor_reverse")
      import
      implicit none
      type(c_ptr), value :: surface
      integer(c_int32_t), value :: axis
    end function

    integer(c_int) function c_tensor_split( &
        surface, axis, at, out_lower, out_upper) &
        bind(c, name="planish_tensor_split")
      import
      implicit none
      type(c_ptr), value :: surface
      integer(c_int32_t), value :: axis
      real(c_double), value :: at
      type(c_ptr), intent(inout) :: out_lower
      type(c_ptr), intent(inout) :: out_upper
    end function

    integer(c_int) function c_field_options_init(options, struct_size) bind(c, name="planish_field_options_init")
      import
      implicit none
      type(planish_field_options), intent(inout) :: options
      integer(c_size_t), value :: struct_size
    end function

    integer(c_int) function c_field_fitter_new(mesh, options, out_fitter) bind(c, name="planish_field_fitter_new")
      import
      implicit none
      type(c_ptr), value :: mesh
      type(planish_field_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: out_fitter
    end function

    integer(c_int) function c_field_fitter_new_points( &
        uv, count, options, out_fitter) &
        bind(c, name="planish_field_fitter_new_points")
      import
      implicit none
      real(c_double), intent(in) :: uv(*)
      integer(c_size_t), value :: count
      type(planish_field_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: out_fitter
    end function

    integer(c_int) function c_field_fitter_new_model( &
        model, mesh, options, out_fitter) &
        bind(c, name="planish_field_fitter_new_model")
      import
      implicit none
      type(c_ptr), value :: model
      type(c_ptr), value :: mesh
      type(planish_field_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: out_fitter
    end function

    subroutine c_field_fitter_free(fitter) bind(c, name="planish_field_fitter_free")
      import
      implicit none
      type(c_ptr), value :: fitter
    end subroutine

    pure integer(c_size_t) function c_field_fitter_point_count( &
        fitter) &
        bind(c, name="planish_field_fitter_point_count")
      import
      implicit none
      type(c_ptr), value :: fitter
    end function

    integer(c_int) function c_field_fitter_grid(fitter, out_grid) bind(c, name="planish_field_fitter_grid")
      import
      implicit none
      type(c_ptr), value :: fitter
      integer(c_size_t), intent(inout) :: out_grid(*)
    end function

    integer(c_int) function c_field_fitter_copy_parameters( &
        fitter, out_uv, count) &
        bind(c, name="planish_field_fitter_copy_parameters")
      import
      implicit none
      type(c_ptr), value :: fitter
      real(c_double), intent(inout) :: out_uv(*)
      integer(c_size_t), value :: count
    end function

    integer(c_int) function c_field_fitter_fit( &
        fitter, values, count, dim, out_surface, out_report) &
        bind(c, name="planish_field_fitter_fit")
      import
      implicit none
      type(c_ptr), value :: fitter
      real(c_double), intent(in) :: values(*)
      integer(c_size_t), value :: count
      integer(c_size_t), value :: dim
      type(c_ptr), intent(inout) :: out_surface
      type(planish_fit_report), intent(inout), optional :: out_report
    end function

    integer(c_int) function c_field_fitter_fit_model( &
        fitter, values, count, dim, out_field, out_report) &
        bind(c, name="planish_field_fitter_fit_model")
      import
      implicit none
      type(c_ptr), value :: fitter
      real(c_double), intent(in) :: values(*)
      integer(c_size_t), value :: count
      integer(c_size_t), value :: dim
      type(c_ptr), intent(inout) :: out_field
      type(planish_fit_report), intent(inout), optional :: out_report
    end function

    integer(c_int) function c_field_fitter_update( &
        fitter, surface, values, count, dim) &
        bind(c, name="planish_field_fitter_update")
      import
      implicit none
      type(c_ptr), value :: fitter
      type(c_ptr), value :: surface
      real(c_double), intent(in) :: values(*)
      integer(c_size_t), value :: count
      integer(c_size_t), value :: dim
    end function

    integer(c_int) function c_tensor_combine( &
        surfaces, factors, count, out_surface) &
        bind(c, name="planish_tensor_combine")
      import
      implicit none
      type(c_ptr), intent(in) :: surfaces(*)
      real(c_double), intent(in), optional :: factors(*)
      integer(c_size_t), value :: count
      type(c_ptr), intent(inout) :: out_surface
    end function

    integer(c_int) function c_gradient_options_init( &
        options, struct_size) &
        bind(c, name="planish_gradient_options_init")
      import
      implicit none
      type(planish_gradient_options), intent(inout) :: options
      integer(c_size_t), value :: struct_size
    end function

    integer(c_int) function c_surface_field_gradient( &
        shape, field, uv, count, options, out_gradients) &
        bind(c, name="planish_surface_field_gradient")
      import
      implicit none
      type(c_ptr), value :: shape
      type(c_ptr), value :: field
      real(c_double), intent(in) :: uv(*)
      integer(c_size_t), value :: count
      type(planish_gradient_options), intent(in), optional :: options
      real(c_double), intent(inout) :: out_gradients(*)
    end function

    integer(c_int) function c_smooth_options_init(options, struct_size) bind(c, name="planish_smooth_options_init")
      import
      implicit none
      type(planish_smooth_options), intent(inout) :: options
      integer(c_size_t), value :: struct_size
    end function

    integer(c_int) function c_model_smooth_from_patches( &
        surfaces, count, options, out_model, out_report) &
        bind(c, name="planish_model_smooth_from_patches")
      import
      implicit none
      type(c_ptr), intent(in) :: surfaces(*)
      integer(c_size_t), value :: count
      type(planish_smooth_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: out_model
      type(planish_smooth_report), intent(inout), optional :: out_report
    end function

    integer(c_int) function c_transfer_options_init( &
        options, struct_size) &
        bind(c, name="planish_transfer_options_init")
      import
      implicit none
      type(planish_transfer_options), intent(inout) :: options
      integer(c_size_t), value :: struct_size
    end function

    integer(c_int) function c_transfer_new( &
        source, targets, count, options, out_transfer, out_report) &
        bind(c, name="planish_transfer_new")
      import
      implicit none
      type(c_ptr), value :: source
      real(c_double), intent(in) :: targets(*)
      integer(c_size_t), value :: count
      type(planish_transfer_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: out_transfer
      type(planish_transfer_report), intent(inout), optional :: out_report
    end function

    integer(c_int) function c_transfer_new_model( &
        model, source, targets, count, options, out_transfer, out_report) &
        bind(c, name="planish_transfer_new_model")
      import
      implicit none
      type(c_ptr), value :: model
      type(c_ptr), value :: source
      real(c_double), intent(in) :: targets(*)
      integer(c_size_t), value :: count
      type(planish_transfer_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: out_transfer
      type(planish_transfer_report), intent(inout), optional :: out_report
    end function

    subroutine c_transfer_free(transfer) bind(c, name="planish_transfer_free")
      import
      implicit none
      type(c_ptr), value :: transfer
    end subroutine

    pure integer(c_size_t) function c_transfer_source_count(transfer) bind(c, name="planish_transfer_source_count")
      import
      implicit none
      type(c_ptr), value :: transfer
    end function

    pure integer(c_size_t) function c_transfer_target_count(transfer) bind(c, name="planish_transfer_target_count")
      import
      implicit none
      type(c_ptr), value :: transfer
    end function

    integer(c_int) function c_transfer_copy_parameters( &
        transfer, out_uv, count) &
        bind(c, name="planish_transfer_copy_parameters")
      import
      implicit none
      type(c_ptr), value :: transfer
      real(c_double), intent(inout) :: out_uv(*)
      integer(c_size_t), value :: count
    end function

    integer(c_int) function c_transfer_copy_distances( &
        transfer, out_distances, count) &
        bind(c, name="planish_transfer_copy_distances")
      import
      implicit none
      type(c_ptr), value :: transfer
      real(c_double), intent(inout) :: out_distances(*)
      integer(c_size_t), value :: count
    end function

    integer(c_int) function c_transfer_apply( &
        transfer, values, count, dim, out_values) &
        bind(c, name="planish_transfer_apply")
      import
      implicit none
      type(c_ptr), value :: transfer
      real(c_double), intent(in) :: values(*)
      integer(c_size_t), value :: count
      integer(c_size_t), value :: dim
      real(c_double), intent(inout) :: out_values(*)
    end function

    integer(c_int) function c_transfer_apply_transpose( &
        transfer, forces, count, dim, out_forces) &
        bind(c, name="planish_transfer_apply_transpose")
      import
      implicit none
      type(c_ptr), value :: transfer
      real(c_double), intent(in) :: forces(*)
      integer(c_size_t), value :: count
      integer(c_size_t), value :: dim
      real(c_double), intent(inout) :: out_forces(*)
    end function

    integer(c_int) function c_transfer_balance( &
        transfer, displacements, source_count, forces, target_count, about, out_report) &
        bind(c, name="planish_transfer_balance")
      import
      implicit none
      type(c_ptr), value :: transfer
      real(c_double), intent(in) :: displacements(*)
      integer(c_size_t), value :: source_count
      real(c_double), intent(in) :: forces(*)
      integer(c_size_t), value :: target_count
      real(c_double), intent(in), optional :: about(*)
      type(planish_balance_report), intent(inout) :: out_report
    end function

    integer(c_int) function c_tessellate_options_init( &
        options, struct_size) &
        bind(c, name="planish_tessellate_options_init")
      import
      implicit none
      type(planish_tessellate_options), intent(inout) :: options
      integer(c_size_t), value :: struct_size
    end function

    integer(c_int) function c_surface_tessellate( &
        surface, options, out_mesh) &
        bind(c, name="planish_surface_tessellate")
      import
      implicit none
      type(c_ptr), value :: surface
      type(planish_tessellate_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: out_mesh
    end function

    integer(c_int) function c_project_options_init(options, struct_size) bind(c, name="planish_project_options_init")
      import
      implicit none
      type(planish_project_options), intent(inout) :: options
      integer(c_size_t), value :: struct_size
    end function

    integer(c_int) function c_surface_project( &
        surface, points, count, options, out_uv, out_distances) &
        bind(c, name="planish_surface_project")
      import
      implicit none
      type(c_ptr), value :: surface
      real(c_double), intent(in) :: points(*)
      integer(c_size_t), value :: count
      type(planish_project_options), intent(in), optional :: options
      real(c_double), intent(inout), optional :: out_uv(*)
      real(c_double), intent(inout), optional :: out_distances(*)
    end function

    integer(c_int) function c_deviation_options_init( &
        options, struct_size) &
        bind(c, name="planish_deviation_options_init")
      import
      implicit none
      type(planish_deviation_options), intent(inout) :: options
      integer(c_size_t), value :: struct_size
    end function

    integer(c_int) function c_surface_deviation( &
        surface, mesh, options, out_distances, count, out_report) &
        bind(c, name="planish_surface_deviation")
      import
      implicit none
      type(c_ptr), value :: surface
      type(c_ptr), value :: mesh
      type(planish_deviation_options), intent(in), optional :: options
      real(c_double), intent(inout), optional :: out_distances(*)
      integer(c_size_t), value :: count
      type(planish_deviation_report), intent(inout), optional :: out_report
    end function

    integer(c_int) function c_mesh_project( &
        mesh, points, count, options, out_triangles, out_points, out_distances) &
        bind(c, name="planish_mesh_project")
      import
      implicit none
      type(c_ptr), value :: mesh
      real(c_double), intent(in) :: points(*)
      integer(c_size_t), value :: count
      type(planish_project_options), intent(in), optional :: options
      integer(c_int32_t), intent(inout), optional :: out_triangles(*)
      real(c_double), intent(inout), optional :: out_points(*)
      real(c_double), intent(inout), optional :: out_distances(*)
    end function

    integer(c_int) function c_sample_rows_options_init( &
        options, struct_size) &
        bind(c, name="planish_sample_rows_options_init")
      import
      implicit none
      type(planish_sample_rows_options), intent(inout) :: options
      integer(c_size_t), value :: struct_size
    end function

    integer(c_int) function c_mesh_sample_rows( &
        mesh, options, out_row_counts, row_count, out_points, point_count, out_point_count) &
        bind(c, name="planish_mesh_sample_rows")
      import
      implicit none
      type(c_ptr), value :: mesh
      type(planish_sample_rows_options), intent(in), optional :: options
      integer(c_size_t), intent(inout) :: out_row_counts(*)
      integer(c_size_t), value :: row_count
      real(c_double), intent(inout), optional :: out_points(*)
      integer(c_size_t), value :: point_count
      integer(c_size_t), intent(inout) :: out_point_count
    end function

    integer(c_int) function c_surface_box(surface, out_box) bind(c, name="planish_surface_box")
      import
      implicit none
      type(c_ptr), value :: surface
      real(c_double), intent(inout) :: out_box(*)
    end function

    integer(c_int) function c_surface_area(surface, options, out_area) bind(c, name="planish_surface_area")
      import
      implicit none
      type(c_ptr), value :: surface
      type(planish_tessellate_options), intent(in), optional :: options
      real(c_double), intent(inout) :: out_area
    end function

    pure integer(c_int32_t) function c_surface_is_closed(surface, axis) bind(c, name="planish_surface_is_closed")
      import
      implicit none
      type(c_ptr), value :: surface
      integer(c_int32_t), value :: axis
    end function

    integer(c_int) function c_fair_options_init(options, struct_size) bind(c, name="planish_fair_options_init")
      import
      implicit none
      type(planish_fair_options), intent(inout) :: options
      integer(c_size_t), value :: struct_size
    end function

    integer(c_int) function c_surface_fair( &
        surface, uv, values, count, options, out_surface, out_report) &
        bind(c, name="planish_surface_fair")
      import
      implicit none
      type(c_ptr), value :: surface
      real(c_double), intent(in), optional :: uv(*)
      real(c_double), intent(in), optional :: values(*)
      integer(c_size_t), value :: count
      type(planish_fair_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: out_surface
      type(planish_fair_report), intent(inout), optional :: out_report
    end function

    integer(c_size_t) function c_surface_name(surface, name, size) bind(c, name="planish_surface_name")
      import
      implicit none
      type(c_ptr), value :: surface
      character(kind=c_char), intent(inout), optional :: name(*)
      integer(c_size_t), value :: size
    end function

    integer(c_int) function c_surface_set_name(surface, name) bind(c, name="planish_surface_set_name")
      import
      implicit none
      type(c_ptr), value :: surface
      character(kind=c_char), intent(in) :: name(*)
    end function

    pure integer(c_int32_t) function c_surface_unit(surface) bind(c, name="planish_surface_unit")
      import
      implicit none
      type(c_ptr), value :: surface
    end function

    integer(c_int) function c_surface_set_unit(surface, unit) bind(c, name="planish_surface_set_unit")
      import
      implicit none
      type(c_ptr), value :: surface
      integer(c_int32_t), value :: unit
    end function

    integer(c_int) function c_vtk_options_init(options, struct_size) bind(c, name="planish_vtk_options_init")
      import
      implicit none
      type(planish_vtk_options), intent(inout) :: options
      integer(c_size_t), value :: struct_size
    end function

    integer(c_int) function c_surface_write_vtk(surface, path, options) bind(c, name="planish_surface_write_vtk")
      import
      implicit none
      type(c_ptr), value :: surface
      character(kind=c_char), intent(in) :: path(*)
      type(planish_vtk_options), intent(in), optional :: options
    end function

    pure integer(c_size_t) function c_surface_save_size(surface) bind(c, name="planish_surface_save_size")
      import
      implicit none
      type(c_ptr), value :: surface
    end function

    integer(c_int) function c_surface_save(surface, buffer, size) bind(c, name="planish_surface_save")
      import
      implicit none
      type(c_ptr), value :: surface
      integer(c_int8_t), intent(inout) :: buffer(*)
      integer(c_size_t), value :: size
    end function

    integer(c_int) function c_surface_load(buffer, size, out_surface) bind(c, name="planish_surface_load")
      import
      implicit none
      integer(c_int8_t), intent(in) :: buffer(*)
      integer(c_size_t), value :: size
      type(c_ptr), intent(inout) :: out_surface
    end function

    integer(c_int) function c_surface_save_file(surface, path) bind(c, name="planish_surface_save_file")
      import
      implicit none
      type(c_ptr), value :: surface
      character(kind=c_char), intent(in) :: path(*)
    end function

    integer(c_int) function c_surface_load_file(path, out_surface) bind(c, name="planish_surface_load_file")
      import
      implicit none
      character(kind=c_char), intent(in) :: path(*)
      type(c_ptr), intent(inout) :: out_surface
    end function

    integer(c_int) function c_step_options_init(options, struct_size) bind(c, name="planish_step_options_init")
      import
      implicit none
      type(planish_step_options), intent(inout) :: options
      integer(c_size_t), value :: struct_size
    end function

    integer(c_int) function c_surface_write_step(surface, path, options) bind(c, name="planish_surface_write_step")
      import
      implicit none
      type(c_ptr), value :: surface
      character(kind=c_char), intent(in) :: path(*)
      type(planish_step_options), intent(in), optional :: options
    end function

    integer(c_int) function c_report_options_init(options, struct_size) bind(c, name="planish_report_options_init")
      import
      implicit none
      type(planish_report_options), intent(inout) :: options
      integer(c_size_t), value :: struct_size
    end function

    integer(c_int) function c_surface_write_report( &
        surface, mesh, path, options) &
        bind(c, name="planish_surface_write_report")
      import
      implicit none
      type(c_ptr), value :: surface
      type(c_ptr), value :: mesh
      character(kind=c_char), intent(in) :: path(*)
      type(planish_report_options), intent(in), optional :: options
    end function

    integer(c_int) function c_model_write_report( &
        model, mesh, path, options) &
        bind(c, name="planish_model_write_report")
      import
      implicit none
      type(c_ptr), value :: model
      type(c_ptr), value :: mesh
      character(kind=c_char), intent(in) :: path(*)
      type(planish_report_options), intent(in), optional :: options
    end function

    integer(c_int) function c_model_from_surface(surface, out_model) bind(c, name="planish_model_from_surface")
      import
      implicit none
      type(c_ptr), value :: surface
      type(c_ptr), intent(inout) :: out_model
    end function

    integer(c_int) function c_model_clone(model, out_model) bind(c, name="planish_model_clone")
      import
      implicit none
      type(c_ptr), value :: model
      type(c_ptr), intent(inout) :: out_model
    end function

    subroutine c_model_free(model) bind(c, name="planish_model_free")
      import
      implicit none
      type(c_ptr), value :: model
    end subroutine

    pure integer(c_size_t) function c_model_dim(model) bind(c, name="planish_model_dim")
      import
      implicit none
      type(c_ptr), value :: model
    end function

    pure integer(c_size_t) function c_model_face_count(model) bind(c, name="planish_model_face_count")
      import
      implicit none
      type(c_ptr), value :: model
    end function

    pure integer(c_size_t) function c_model_edge_count(model) bind(c, name="planish_model_edge_count")
      import
      implicit none
      type(c_ptr), value :: model
    end function

    pure integer(c_size_t) function c_model_vertex_count(model) bind(c, name="planish_model_vertex_count")
      import
      implicit none
      type(c_ptr), value :: model
    end function

    pure integer(c_size_t) function c_model_shell_count(model) bind(c, name="planish_model_shell_count")
      import
      implicit none
      type(c_ptr), value :: model
    end function

    pure integer(c_size_t) function c_model_loop_count(model, face) bind(c, name="planish_model_loop_count")
      import
      implicit none
      type(c_ptr), value :: model
      integer(c_size_t), value :: face
    end function

    pure integer(c_size_t) function c_model_coedge_count(model, face) bind(c, name="planish_model_coedge_count")
      import
      implicit none
      type(c_ptr), value :: model
      integer(c_size_t), value :: face
    end function

    integer(c_int) function c_model_face_info(model, face, out_info) bind(c, name="planish_model_face_info")
      import
      implicit none
      type(c_ptr), value :: model
      integer(c_size_t), value :: face
      type(planish_face_info), intent(inout) :: out_info
    end function

    integer(c_int) function c_model_copy_face(model, face, out_surface) bind(c, name="planish_model_copy_face")
      import
      implicit none
      type(c_ptr), value :: model
      integer(c_size_t), value :: face
      type(c_ptr), intent(inout) :: out_surface
    end function

    integer(c_int) function c_model_copy_edge( &
        model, edge, out_curve, out_info) &
        bind(c, name="planish_model_copy_edge")
      import
      implicit none
      type(c_ptr), value :: model
      integer(c_size_t), value :: edge
      type(c_ptr), intent(inout), optional :: out_curve
      type(planish_edge_info), intent(inout), optional :: out_info
    end function

    integer(c_int) function c_model_copy_loops( &
        model, face, out_sizes, loop_count, out_edges, out_forward, coedge_count) &
        bind(c, name="planish_model_copy_loops")
      import
      implicit none
      type(c_ptr), value :: model
      integer(c_size_t), value :: face
      integer(c_size_t), intent(inout), optional :: out_sizes(*)
      integer(c_size_t), value :: loop_count
      integer(c_int32_t), intent(inout), optional :: out_edges(*)
      integer(c_int8_t), intent(inout), optional :: out_forward(*)
      integer(c_size_t), value :: coedge_count
    end function

    integer(c_int) function c_model_copy_pcurve( &
        model, face, coedge, out_curve) &
        bind(c, name="planish_model_copy_pcurve")
      import
      implicit none
      type(c_ptr), value :: model
      integer(c_size_t), value :: face
      integer(c_size_t), value :: coedge
      type(c_ptr), intent(inout) :: out_curve
    end function

    integer(c_int) function c_model_copy_vertices( &
        model, out_points, count) &
        bind(c, name="planish_model_copy_vertices")
      import
      implicit none
      type(c_ptr), value :: model
      real(c_double), intent(inout) :: out_points(*)
      integer(c_size_t), value :: count
    end function

    pure integer(c_size_t) function c_model_node_count(model) bind(c, name="planish_model_node_count")
      import
      implicit none
      type(c_ptr), value :: model
    end function

    integer(c_int) function c_model_locate_nodes( &
        model, out_faces, out_uv, count) &
        bind(c, name="planish_model_locate_nodes")
      import
      implicit none
      type(c_ptr), value :: model
      integer(c_int32_t), intent(inout), optional :: out_faces(*)
      real(c_double), intent(inout), optional :: out_uv(*)
      integer(c_size_t), value :: count
    end function

    integer(c_int) function c_model_copy_shell( &
        model, shell, out_info, out_faces, count) &
        bind(c, name="planish_model_copy_shell")
      import
      implicit none
      type(c_ptr), value :: model
      integer(c_size_t), value :: shell
      type(planish_shell_info), intent(inout), optional :: out_info
      integer(c_int32_t), intent(inout), optional :: out_faces(*)
      integer(c_size_t), value :: count
    end function

    integer(c_int) function c_model_measure(model, out_report) bind(c, name="planish_model_measure")
      import
      implicit none
      type(c_ptr), value :: model
      type(planish_measure_report), intent(inout) :: out_report
    end function

    integer(c_int) function c_model_write_step(model, path, options) bind(c, name="planish_model_write_step")
      import
      implicit none
      type(c_ptr), value :: model
      character(kind=c_char), intent(in) :: path(*)
      type(planish_step_options), intent(in), optional :: options
    end function

    integer(c_int) function c_model_write_step_memory( &
        model, options, out_bytes, size, out_size) &
        bind(c, name="planish_model_write_step_memory")
      import
      implicit none
      type(c_ptr), value :: model
      type(planish_step_options), intent(in), optional :: options
      integer(c_int8_t), intent(inout), optional :: out_bytes(*)
      integer(c_size_t), value :: size
      integer(c_size_t), intent(inout) :: out_size
    end function

    pure integer(c_size_t) function c_model_save_size(model) bind(c, name="planish_model_save_size")
      import
      implicit none
      type(c_ptr), value :: model
    end function

    integer(c_int) function c_model_save(model, buffer, size) bind(c, name="planish_model_save")
      import
      implicit none
      type(c_ptr), value :: model
      integer(c_int8_t), intent(inout) :: buffer(*)
      integer(c_size_t), value :: size
    end function

    integer(c_int) function c_model_load(buffer, size, out_model) bind(c, name="planish_model_load")
      import
      implicit none
      integer(c_int8_t), intent(in) :: buffer(*)
      integer(c_size_t), value :: size
      type(c_ptr), intent(inout) :: out_model
    end function

    integer(c_int) function c_model_save_file(model, path) bind(c, name="planish_model_save_file")
      import
      implicit none
      type(c_ptr), value :: model
      character(kind=c_char), intent(in) :: path(*)
    end function

    integer(c_int) function c_model_load_file(path, out_model) bind(c, name="planish_model_load_file")
      import
      implicit none
      character(kind=c_char), intent(in) :: path(*)
      type(c_ptr), intent(inout) :: out_model
    end function

    integer(c_int) function c_model_options_init(options, struct_size) bind(c, name="planish_model_options_init")
      import
      implicit none
      type(planish_model_options), intent(inout) :: options
      integer(c_size_t), value :: struct_size
    end function

    integer(c_int) function c_model_fit(mesh, options, out_model, out_report) bind(c, name="planish_model_fit")
      import
      implicit none
      type(c_ptr), value :: mesh
      type(planish_model_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: out_model
      type(planish_model_report), intent(inout), optional :: out_report
    end function

    integer(c_int) function c_model_eval( &
        model, faces, uv, count, max_derivative, options, out) &
        bind(c, name="planish_model_eval")
      import
      implicit none
      type(c_ptr), value :: model
      integer(c_int32_t), intent(in) :: faces(*)
      real(c_double), intent(in) :: uv(*)
      integer(c_size_t), value :: count
      integer(c_int32_t), value :: max_derivative
      type(planish_eval_options), intent(in), optional :: options
      real(c_double), intent(inout) :: out(*)
    end function

    integer(c_int) function c_model_field_gradient( &
        shape, field, faces, uv, count, options, out_gradients) &
        bind(c, name="planish_model_field_gradient")
      import
      implicit none
      type(c_ptr), value :: shape
      type(c_ptr), value :: field
      integer(c_int32_t), intent(in) :: faces(*)
      real(c_double), intent(in) :: uv(*)
      integer(c_size_t), value :: count
      type(planish_gradient_options), intent(in), optional :: options
      real(c_double), intent(inout) :: out_gradients(*)
    end function

    integer(c_int) function c_model_normals( &
        model, faces, uv, count, options, out_normals) &
        bind(c, name="planish_model_normals")
      import
      implicit none
      type(c_ptr), value :: model
      integer(c_int32_t), intent(in) :: faces(*)
      real(c_double), intent(in) :: uv(*)
      integer(c_size_t), value :: count
      type(planish_eval_options), intent(in), optional :: options
      real(c_double), intent(inout) :: out_normals(*)
    end function

    integer(c_int) function c_model_curvatures( &
        model, faces, uv, count, options, out) &
        bind(c, name="planish_model_curvatures")
      import
      implicit none
      type(c_ptr), value :: model
      integer(c_int32_t), intent(in) :: faces(*)
      real(c_double), intent(in) :: uv(*)
      integer(c_size_t), value :: count
      type(planish_eval_options), intent(in), optional :: options
      real(c_double), intent(inout) :: out(*)
    end function

    integer(c_int) function c_model_project( &
        model, points, count, options, out_faces, out_uv, out_distances) &
        bind(c, name="planish_model_project")
      import
      implicit none
      type(c_ptr), value :: model
      real(c_double), intent(in) :: points(*)
      integer(c_size_t), value :: count
      type(planish_project_options), intent(in), optional :: options
      integer(c_int32_t), intent(inout), optional :: out_faces(*)
      real(c_double), intent(inout), optional :: out_uv(*)
      real(c_double), intent(inout), optional :: out_distances(*)
    end function

    integer(c_int) function c_model_deviation( &
        model, mesh, options, out_distances, count, out_report) &
        bind(c, name="planish_model_deviation")
      import
      implicit none
      type(c_ptr), value :: model
      type(c_ptr), value :: mesh
      type(planish_deviation_options), intent(in), optional :: options
      real(c_double), intent(inout), optional :: out_distances(*)
      integer(c_size_t), value :: count
      type(planish_deviation_report), intent(inout), optional :: out_report
    end function

    integer(c_int) function c_model_tessellate(model, options, out_mesh) bind(c, name="planish_model_tessellate")
      import
      implicit none
      type(c_ptr), value :: model
      type(planish_tessellate_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: out_mesh
    end function

    integer(c_int) function c_model_write_vtk(model, path, options) bind(c, name="planish_model_write_vtk")
      import
      implicit none
      type(c_ptr), value :: model
      character(kind=c_char), intent(in) :: path(*)
      type(planish_vtk_options), intent(in), optional :: options
    end function

    integer(c_int) function c_curve_options_init(options, struct_size) bind(c, name="planish_curve_options_init")
      import
      implicit none
      type(planish_curve_options), intent(inout) :: options
      integer(c_size_t), value :: struct_size
    end function

    integer(c_int) function c_curve_fit( &
        u, values, count, dim, options, out_curve, out_report) &
        bind(c, name="planish_curve_fit")
      import
      implicit none
      real(c_double), intent(in) :: u(*)
      real(c_double), intent(in) :: values(*)
      integer(c_size_t), value :: count
      integer(c_size_t), value :: dim
      type(planish_curve_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: out_curve
      type(planish_fit_report), intent(inout), optional :: out_report
    end function

    integer(c_int) function c_curve_new( &
        dim, degree, knots, knot_count, control_points, out_curve) &
        bind(c, name="planish_curve_new")
      import
      implicit none
      integer(c_size_t), value :: dim
      integer(c_int32_t), value :: degree
      real(c_double), intent(in) :: knots(*)
      integer(c_size_t), value :: knot_count
      real(c_double), intent(in) :: control_points(*)
      type(c_ptr), intent(inout) :: out_curve
    end function

    integer(c_int) function c_interpolate_options_init( &
        options, struct_size) &
        bind(c, name="planish_interpolate_options_init")
      import
      implicit none
      type(planish_interpolate_options), intent(inout) :: options
      integer(c_size_t), value :: struct_size
    end function

    integer(c_int) function c_curve_interpolate( &
        u, values, count, dim, options, out_curve) &
        bind(c, name="planish_curve_interpolate")
      import
      implicit none
      real(c_double), intent(in) :: u(*)
      real(c_double), intent(in) :: values(*)
      integer(c_size_t), value :: count
      integer(c_size_t), value :: dim
      type(planish_interpolate_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: out_curve
    end function

    pure integer(c_size_t) function c_curve_dim(curve) bind(c, name="planish_curve_dim")
      import
      implicit none
      type(c_ptr), value :: curve
    end function

    pure integer(c_int32_t) function c_curve_degree(curve) bind(c, name="planish_curve_degree")
      import
      implicit none
      type(c_ptr), value :: curve
    end function

    pure integer(c_size_t) function c_curve_knot_count(curve) bind(c, name="planish_curve_knot_count")
      import
      implicit none
      type(c_ptr), value :: curve
    end function

    pure integer(c_size_t) function c_curve_control_point_count( &
        curve) &
        bind(c, name="planish_curve_control_point_count")
      import
      implicit none
      type(c_ptr), value :: curve
    end function

    integer(c_int) function c_curve_copy_knots(curve, out_knots, count) bind(c, name="planish_curve_copy_knots")
      import
      implicit none
      type(c_ptr), value :: curve
      real(c_double), intent(inout) :: out_knots(*)
      integer(c_size_t), value :: count
    end function

    integer(c_int) function c_curve_copy_control_points( &
        curve, out_control_points, count) &
        bind(c, name="planish_curve_copy_control_points")
      import
      implicit none
      type(c_ptr), value :: curve
      real(c_double), intent(inout) :: out_control_points(*)
      integer(c_size_t), value :: count
    end function

    integer(c_int) function c_curve_domain(curve, out_interval) bind(c, name="planish_curve_domain")
      import
      implicit none
      type(c_ptr), value :: curve
      real(c_double), intent(inout) :: out_interval(*)
    end function

    integer(c_int) function c_curve_eval( &
        curve, u, count, max_derivative, options, out) &
        bind(c, name="planish_curve_eval")
      import
      implicit none
      type(c_ptr), value :: curve
      real(c_double), intent(in) :: u(*)
      integer(c_size_t), value :: count
      integer(c_int32_t), value :: max_derivative
      type(planish_eval_options), intent(in), optional :: options
      real(c_double), intent(inout) :: out(*)
    end function

    integer(c_int) function c_curve_clone(curve, out_curve) bind(c, name="planish_curve_clone")
      import
      implicit none
      type(c_ptr), value :: curve
      type(c_ptr), intent(inout) :: out_curve
    end function

    subroutine c_curve_free(curve) bind(c, name="planish_curve_free")
      import
      implicit none
      type(c_ptr), value :: curve
    end subroutine

    pure real(c_double) function c_curve_length(curve) bind(c, name="planish_curve_length")
      import
      implicit none
      type(c_ptr), value :: curve
    end function

    integer(c_int) function c_curve_arc_lengths( &
        curve, u, count, out_lengths) &
        bind(c, name="planish_curve_arc_lengths")
      import
      implicit none
      type(c_ptr), value :: curve
      real(c_double), intent(in) :: u(*)
      integer(c_size_t), value :: count
      real(c_double), intent(inout) :: out_lengths(*)
    end function

    integer(c_int) function c_curve_project( &
        curve, points, count, options, out_u, out_distances) &
        bind(c, name="planish_curve_project")
      import
      implicit none
      type(c_ptr), value :: curve
      real(c_double), intent(in) :: points(*)
      integer(c_size_t), value :: count
      type(planish_project_options), intent(in), optional :: options
      real(c_double), intent(inout), optional :: out_u(*)
      real(c_double), intent(inout), optional :: out_distances(*)
    end function

    pure integer(c_size_t) function c_curve_save_size(curve) bind(c, name="planish_curve_save_size")
      import
      implicit none
      type(c_ptr), value :: curve
    end function

    integer(c_int) function c_curve_save(curve, buffer, size) bind(c, name="planish_curve_save")
      import
      implicit none
      type(c_ptr), value :: curve
      integer(c_int8_t), intent(inout) :: buffer(*)
      integer(c_size_t), value :: size
    end function

    integer(c_int) function c_curve_load(buffer, size, out_curve) bind(c, name="planish_curve_load")
      import
      implicit none
      integer(c_int8_t), intent(in) :: buffer(*)
      integer(c_size_t), value :: size
      type(c_ptr), intent(inout) :: out_curve
    end function

    integer(c_int) function c_curve_save_file(curve, path) bind(c, name="planish_curve_save_file")
      import
      implicit none
      type(c_ptr), value :: curve
      character(kind=c_char), intent(in) :: path(*)
    end function

    integer(c_int) function c_curve_load_file(path, out_curve) bind(c, name="planish_curve_load_file")
      import
      implicit none
      character(kind=c_char), intent(in) :: path(*)
      type(c_ptr), intent(inout) :: out_curve
    end function

    integer(c_int) function c_skin_options_init(options, struct_size) bind(c, name="planish_skin_options_init")
      import
      implicit none
      type(planish_skin_options), intent(inout) :: options
      integer(c_size_t), value :: struct_size
    end function

    integer(c_int) function c_tspline_skin( &
        points, row_counts, row_count, options, out_surface, out_report) &
        bind(c, name="planish_tspline_skin")
      import
      implicit none
      real(c_double), intent(in) :: points(*)
      integer(c_size_t), intent(in) :: row_counts(*)
      integer(c_size_t), value :: row_count
      type(planish_skin_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: out_surface
      type(planish_fit_report), intent(inout), optional :: out_report
    end function

    integer(c_int) function c_tspline_skin_curves( &
        curves, curve_count, options, out_surface, out_report) &
        bind(c, name="planish_tspline_skin_curves")
      import
      implicit none
      type(c_ptr), intent(in) :: curves(*)
      integer(c_size_t), value :: curve_count
      type(planish_skin_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: out_surface
      type(planish_fit_report), intent(inout), optional :: out_report
    end function

    integer(c_int) function c_tspline_new( &
        knots, knot_count, curves, curve_count, out_surface) &
        bind(c, name="planish_tspline_new")
      import
      implicit none
      real(c_double), intent(in) :: knots(*)
      integer(c_size_t), value :: knot_count
      type(c_ptr), intent(in) :: curves(*)
      integer(c_size_t), value :: curve_count
      type(c_ptr), intent(inout) :: out_surface
    end function

    pure integer(c_size_t) function c_tspline_curve_count(surface) bind(c, name="planish_tspline_curve_count")
      import
      implicit none
      type(c_ptr), value :: surface
    end function

    integer(c_int) function c_tspline_clone_curve( &
        surface, curve, out_curve) &
        bind(c, name="planish_tspline_clone_curve")
      import
      implicit none
      type(c_ptr), value :: surface
      integer(c_size_t), value :: curve
      type(c_ptr), intent(inout) :: out_curve
    end function

    pure integer(c_size_t) function c_tspline_knot_count(surface) bind(c, name="planish_tspline_knot_count")
      import
      implicit none
      type(c_ptr), value :: surface
    end function

    integer(c_int) function c_tspline_copy_knots(surface, out_knots, count) bind(c, name="planish_tspline_copy_knots")
      import
      implicit none
      type(c_ptr), value :: surface
      real(c_double), intent(inout) :: out_knots(*)
      integer(c_size_t), value :: count
    end function

    integer(c_int) function c_tspline_insert_knot_u(surface, curve, u) bind(c, name="planish_tspline_insert_knot_u")
      import
      implicit none
      type(c_ptr), value :: surface
      integer(c_size_t), value :: curve
      real(c_double), value :: u
    end function

    integer(c_int) function c_tspline_insert_knot_v(surface, v) bind(c, name="planish_tspline_insert_knot_v")
      import
      implicit none
      type(c_ptr), value :: surface
      real(c_double), value :: v
    end function

    integer(c_int) function c_tspline_remove_knot_u( &
        surface, curve, knot, tolerance, out_error) &
        bind(c, name="planish_tspline_remove_knot_u")
      import
      implicit none
      type(c_ptr), value :: surface
      integer(c_size_t), value :: curve
      integer(c_size_t), value :: knot
      real(c_double), value :: tolerance
      real(c_double), intent(inout), optional :: out_error
    end function

    integer(c_int) function c_pht_options_init(options, struct_size) bind(c, name="planish_pht_options_init")
      import
      implicit none
      type(planish_pht_options), intent(inout) :: options
      integer(c_size_t), value :: struct_size
    end function

    integer(c_int) function c_pht_fit(mesh, options, out_surface, out_report) bind(c, name="planish_pht_fit")
      import
      implicit none
      type(c_ptr), value :: mesh
      type(planish_pht_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: out_surface
      type(planish_fit_report), intent(inout), optional :: out_report
    end function

    integer(c_int) function c_pht_fit_points( &
        uv, values, count, dim, options, out_surface, out_report) &
        bind(c, name="planish_pht_fit_points")
      import
      implicit none
      real(c_double), intent(in) :: uv(*)
      real(c_double), intent(in) :: values(*)
      integer(c_size_t), value :: count
      integer(c_size_t), value :: dim
      type(planish_pht_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: out_surface
      type(planish_fit_report), intent(inout), optional :: out_report
    end function

    integer(c_int) function c_pht_fit_field( &
        mesh, values, count, dim, options, out_surface, out_report) &
        bind(c, name="planish_pht_fit_field")
      import
      implicit none
      type(c_ptr), value :: mesh
      real(c_double), intent(in) :: values(*)
      integer(c_size_t), value :: count
      integer(c_size_t), value :: dim
      type(planish_pht_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: out_surface
      type(planish_fit_report), intent(inout), optional :: out_report
    end function

    integer(c_int) function c_pht_new( &
        dim, is_rational, lines_u, line_count_u, lines_v, line_count_v, cells, split_count, data, data_count, &
        out_surface) &
        bind(c, name="planish_pht_new")
      import
      implicit none
      integer(c_size_t), value :: dim
      integer(c_int32_t), value :: is_rational
      real(c_double), intent(in) :: lines_u(*)
      integer(c_size_t), value :: line_count_u
      real(c_double), intent(in) :: lines_v(*)
      integer(c_size_t), value :: line_count_v
      integer(c_int32_t), intent(in) :: cells(*)
      integer(c_size_t), value :: split_count
      real(c_double), intent(in), optional :: data(*)
      integer(c_size_t), value :: data_count
      type(c_ptr), intent(inout) :: out_surface
    end function

    integer(c_int) function c_pht_split(surface, cells, count) bind(c, name="planish_pht_split")
      import
      implicit none
      type(c_ptr), value :: surface
      integer(c_int32_t), intent(in) :: cells(*)
      integer(c_size_t), value :: count
    end function

    integer(c_int) function c_pht_merge(surface, cells, count) bind(c, name="planish_pht_merge")
      import
      implicit none
      type(c_ptr), value :: surface
      integer(c_int32_t), intent(in) :: cells(*)
      integer(c_size_t), value :: count
    end function

    integer(c_int) function c_pht_simplify_options_init( &
        options, struct_size) &
        bind(c, name="planish_pht_simplify_options_init")
      import
      implicit none
      type(planish_pht_simplify_options), intent(inout) :: options
      integer(c_size_t), value :: struct_size
    end function

    integer(c_int) function c_pht_simplify( &
        surface, tolerance, options, out_deviation) &
        bind(c, name="planish_pht_simplify")
      import
      implicit none
      type(c_ptr), value :: surface
      real(c_double), value :: tolerance
      type(planish_pht_simplify_options), intent(in), optional :: options
      real(c_double), intent(inout), optional :: out_deviation
    end function

    integer(c_int) function c_pht_refine_region( &
        surface, region, level, max_cells) &
        bind(c, name="planish_pht_refine_region")
      import
      implicit none
      type(c_ptr), value :: surface
      real(c_double), intent(in) :: region(*)
      integer(c_int32_t), value :: level
      integer(c_size_t), value :: max_cells
    end function

    integer(c_int) function c_pht_convert_options_init( &
        options, struct_size) &
        bind(c, name="planish_pht_convert_options_init")
      import
      implicit none
      type(planish_pht_convert_options), intent(inout) :: options
      integer(c_size_t), value :: struct_size
    end function

    integer(c_int) function c_pht_from_surface(surface, options, out_surface) bind(c, name="planish_pht_from_surface")
      import
      implicit none
      type(c_ptr), value :: surface
      type(planish_pht_convert_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: out_surface
    end function

    integer(c_int) function c_pht_patches_options_init( &
        options, struct_size) &
        bind(c, name="planish_pht_patches_options_init")
      import
      implicit none
      type(planish_pht_patches_options), intent(inout) :: options
      integer(c_size_t), value :: struct_size
    end function

    integer(c_int) function c_pht_to_tensor_patches( &
        surface, options, out_surfaces, count, out_count) &
        bind(c, name="planish_pht_to_tensor_patches")
      import
      implicit none
      type(c_ptr), value :: surface
      type(planish_pht_patches_options), intent(in), optional :: options
      type(c_ptr), intent(inout), optional :: out_surfaces(*)
      integer(c_size_t), value :: count
      integer(c_size_t), intent(inout) :: out_count
    end function

    integer(c_int) function c_pht_stitch( &
        first, first_side, second, second_side, is_reversed) &
        bind(c, name="planish_pht_stitch")
      import
      implicit none
      type(c_ptr), value :: first
      integer(c_int32_t), value :: first_side
      type(c_ptr), value :: second
      integer(c_int32_t), value :: second_side
      integer(c_int32_t), value :: is_reversed
    end function

    pure integer(c_size_t) function c_pht_cell_count(surface) bind(c, name="planish_pht_cell_count")
      import
      implicit none
      type(c_ptr), value :: surface
    end function

    pure integer(c_size_t) function c_pht_vertex_count(surface) bind(c, name="planish_pht_vertex_count")
      import
      implicit none
      type(c_ptr), value :: surface
    end function

    pure integer(c_size_t) function c_pht_hanging_count(surface) bind(c, name="planish_pht_hanging_count")
      import
      implicit none
      type(c_ptr), value :: surface
    end function

    pure integer(c_size_t) function c_pht_width(surface) bind(c, name="planish_pht_width")
      import
      implicit none
      type(c_ptr), value :: surface
    end function

    integer(c_int) function c_pht_copy_cells(surface, out_cells, count) bind(c, name="planish_pht_copy_cells")
      import
      implicit none
      type(c_ptr), value :: surface
      integer(c_int32_t), intent(inout) :: out_cells(*)
      integer(c_size_t), value :: count
    end function

    integer(c_int) function c_pht_copy_vertices(surface, out_uv, count) bind(c, name="planish_pht_copy_vertices")
      import
      implicit none
      type(c_ptr), value :: surface
      real(c_double), intent(inout) :: out_uv(*)
      integer(c_size_t), value :: count
    end function

    integer(c_int) function c_pht_copy_hanging( &
        surface, out_uv, out_hosts, count) &
        bind(c, name="planish_pht_copy_hanging")
      import
      implicit none
      type(c_ptr), value :: surface
      real(c_double), intent(inout), optional :: out_uv(*)
      integer(c_int32_t), intent(inout), optional :: out_hosts(*)
      integer(c_size_t), value :: count
    end function

    integer(c_int) function c_pht_copy_neighbours( &
        surface, cell, out_cells, count, out_count) &
        bind(c, name="planish_pht_copy_neighbours")
      import
      implicit none
      type(c_ptr), value :: surface
      integer(c_size_t), value :: cell
      integer(c_int32_t), intent(inout), optional :: out_cells(*)
      integer(c_size_t), value :: count
      integer(c_size_t), intent(inout) :: out_count
    end function

    integer(c_int) function c_pht_copy_data(surface, out_data, count) bind(c, name="planish_pht_copy_data")
      import
      implicit none
      type(c_ptr), value :: surface
      real(c_double), intent(inout) :: out_data(*)
      integer(c_size_t), value :: count
    end function

    integer(c_int) function c_pht_set_data(surface, vertices, count, data) bind(c, name="planish_pht_set_data")
      import
      implicit none
      type(c_ptr), value :: surface
      integer(c_int32_t), intent(in) :: vertices(*)
      integer(c_size_t), value :: count
      real(c_double), intent(in) :: data(*)
    end function

    integer(c_int) function c_pht_copy_control_points( &
        surface, basis, out_points, count) &
        bind(c, name="planish_pht_copy_control_points")
      import
      implicit none
      type(c_ptr), value :: surface
      integer(c_int32_t), value :: basis
      real(c_double), intent(inout) :: out_points(*)
      integer(c_size_t), value :: count
    end function

    integer(c_int) function c_pht_set_control_points( &
        surface, vertices, count, basis, points) &
        bind(c, name="planish_pht_set_control_points")
      import
      implicit none
      type(c_ptr), value :: surface
      integer(c_int32_t), intent(in) :: vertices(*)
      integer(c_size_t), value :: count
      integer(c_int32_t), value :: basis
      real(c_double), intent(in) :: points(*)
    end function

    integer(c_int) function c_pht_copy_extraction( &
        surface, cell, basis, out_vertices, out_matrix, count, out_count) &
        bind(c, name="planish_pht_copy_extraction")
      import
      implicit none
      type(c_ptr), value :: surface
      integer(c_size_t), value :: cell
      integer(c_int32_t), value :: basis
      integer(c_int32_t), intent(inout), optional :: out_vertices(*)
      real(c_double), intent(inout), optional :: out_matrix(*)
      integer(c_size_t), value :: count
      integer(c_size_t), intent(inout) :: out_count
    end function

    pure integer(c_size_t) function c_pht_cell_at(surface, u, v) bind(c, name="planish_pht_cell_at")
      import
      implicit none
      type(c_ptr), value :: surface
      real(c_double), value :: u
      real(c_double), value :: v
    end function

    integer(c_int) function c_d1rc_options_init(options, struct_size) bind(c, name="planish_d1rc_options_init")
      import
      implicit none
      type(planish_d1rc_options), intent(inout) :: options
      integer(c_size_t), value :: struct_size
    end function

    integer(c_int) function c_d1rc_new(control_mesh, options, out_surface) bind(c, name="planish_d1rc_new")
      import
      implicit none
      type(c_ptr), value :: control_mesh
      type(planish_d1rc_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: out_surface
    end function

    pure integer(c_int32_t) function c_d1rc_degree(surface) bind(c, name="planish_d1rc_degree")
      import
      implicit none
      type(c_ptr), value :: surface
    end function

    integer(c_int) function c_d1rc_set_sharp_edges( &
        surface, sharp_edges, edge_count, corners, corner_count) &
        bind(c, name="planish_d1rc_set_sharp_edges")
      import
      implicit none
      type(c_ptr), value :: surface
      integer(c_int32_t), intent(in) :: sharp_edges(*)
      integer(c_size_t), value :: edge_count
      integer(c_int32_t), intent(in), optional :: corners(*)
      integer(c_size_t), value :: corner_count
    end function

    integer(c_int) function c_d1rc_copy_sharp_edges( &
        surface, out_edges, count, out_count) &
        bind(c, name="planish_d1rc_copy_sharp_edges")
      import
      implicit none
      type(c_ptr), value :: surface
      integer(c_int32_t), intent(inout), optional :: out_edges(*)
      integer(c_size_t), value :: count
      integer(c_size_t), intent(inout) :: out_count
    end function

    integer(c_int) function c_d1rc_copy_control_points( &
        surface, out_points, count) &
        bind(c, name="planish_d1rc_copy_control_points")
      import
      implicit none
      type(c_ptr), value :: surface
      real(c_double), intent(inout) :: out_points(*)
      integer(c_size_t), value :: count
    end function

    integer(c_int) function c_d1rc_set_control_points( &
        surface, vertices, count, points) &
        bind(c, name="planish_d1rc_set_control_points")
      import
      implicit none
      type(c_ptr), value :: surface
      integer(c_int32_t), intent(in) :: vertices(*)
      integer(c_size_t), value :: count
      real(c_double), intent(in) :: points(*)
    end function

    integer(c_int) function c_d1rc_edge_continuity( &
        surface, edges, count, out_orders) &
        bind(c, name="planish_d1rc_edge_continuity")
      import
      implicit none
      type(c_ptr), value :: surface
      integer(c_int32_t), intent(in) :: edges(*)
      integer(c_size_t), value :: count
      integer(c_int32_t), intent(inout) :: out_orders(*)
    end function

    integer(c_int) function c_d1rc_copy_influence( &
        surface, vertex, out_faces, count, out_count) &
        bind(c, name="planish_d1rc_copy_influence")
      import
      implicit none
      type(c_ptr), value :: surface
      integer(c_int32_t), value :: vertex
      integer(c_int32_t), intent(inout), optional :: out_faces(*)
      integer(c_size_t), value :: count
      integer(c_size_t), intent(inout) :: out_count
    end function

    integer(c_int) function c_d1rc_blending_values( &
        surface, vertex, uv, count, out_values) &
        bind(c, name="planish_d1rc_blending_values")
      import
      implicit none
      type(c_ptr), value :: surface
      integer(c_int32_t), value :: vertex
      real(c_double), intent(in) :: uv(*)
      integer(c_size_t), value :: count
      real(c_double), intent(inout) :: out_values(*)
    end function

    pure integer(c_size_t) function c_d1rc_knot_count(surface) bind(c, name="planish_d1rc_knot_count")
      import
      implicit none
      type(c_ptr), value :: surface
    end function

    integer(c_int) function c_d1rc_copy_knots(surface, out_uv, count) bind(c, name="planish_d1rc_copy_knots")
      import
      implicit none
      type(c_ptr), value :: surface
      real(c_double), intent(inout) :: out_uv(*)
      integer(c_size_t), value :: count
    end function

    pure integer(c_size_t) function c_d1rc_configuration_count( &
        surface) &
        bind(c, name="planish_d1rc_configuration_count")
      import
      implicit none
      type(c_ptr), value :: surface
    end function

    integer(c_int) function c_d1rc_copy_configuration( &
        surface, index, out_knots, out_edges, count, out_count) &
        bind(c, name="planish_d1rc_copy_configuration")
      import
      implicit none
      type(c_ptr), value :: surface
      integer(c_size_t), value :: index
      integer(c_int32_t), intent(inout), optional :: out_knots(*)
      integer(c_int32_t), intent(inout), optional :: out_edges(*)
      integer(c_size_t), value :: count
      integer(c_size_t), intent(inout) :: out_count
    end function

    integer(c_int) function c_d1rc_fit(mesh, options, out_surface, out_report) bind(c, name="planish_d1rc_fit")
      import
      implicit none
      type(c_ptr), value :: mesh
      type(planish_d1rc_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: out_surface
      type(planish_fit_report), intent(inout), optional :: out_report
    end function
  end interface

  !> Puts a record back to the defaults that the library has: `call planish_options_init(options)`.
  interface planish_options_init
    module procedure init_mesh_options
    module procedure init_mesh_write_options
    module procedure init_decimate_options
    module procedure init_parameterize_options
    module procedure init_sphere_options
    module procedure init_feature_options
    module procedure init_layout_options
    module procedure init_mesh_layout_options
    module procedure init_eval_options
    module procedure init_trim_options
    module procedure init_convert_options
    module procedure init_tensor_options
    module procedure init_field_options
    module procedure init_gradient_options
    module procedure init_smooth_options
    module procedure init_transfer_options
    module procedure init_tessellate_options
    module procedure init_project_options
    module procedure init_deviation_options
    module procedure init_sample_rows_options
    module procedure init_fair_options
    module procedure init_vtk_options
    module procedure init_step_options
    module procedure init_report_options
    module procedure init_model_options
    module procedure init_curve_options
    module procedure init_interpolate_options
    module procedure init_skin_options
    module procedure init_pht_options
    module procedure init_pht_simplify_options
    module procedure init_pht_convert_options
    module procedure init_pht_patches_options
    module procedure init_d1rc_options
  end interface
  private :: init_mesh_options
  private :: init_mesh_write_options
  private :: init_decimate_options
  private :: init_parameterize_options
  private :: init_sphere_options
  private :: init_feature_options
  private :: init_layout_options
  private :: init_mesh_layout_options
  private :: init_eval_options
  private :: init_trim_options
  private :: init_convert_options
  private :: init_tensor_options
  private :: init_field_options
  private :: init_gradient_options
  private :: init_smooth_options
  private :: init_transfer_options
  private :: init_tessellate_options
  private :: init_project_options
  private :: init_deviation_options
  private :: init_sample_rows_options
  private :: init_fair_options
  private :: init_vtk_options
  private :: init_step_options
  private :: init_report_options
  private :: init_model_options
  private :: init_curve_options
  private :: init_interpolate_options
  private :: init_skin_options
  private :: init_pht_options
  private :: init_pht_simplify_options
  private :: init_pht_convert_options
  private :: init_pht_patches_options
  private :: init_d1rc_options

contains

  subroutine init_mesh_options(options)
    type(planish_mesh_options), intent(inout) :: options
    integer(c_int) :: status
    status = c_mesh_options_init(options, c_sizeof(options)) ! which cannot fail
  end subroutine

  subroutine init_mesh_write_options(options)
    type(planish_mesh_write_options), intent(inout) :: options
    integer(c_int) :: status
    status = c_mesh_write_options_init(options, c_sizeof(options)) ! which cannot fail
  end subroutine

  subroutine init_decimate_options(options)
    type(planish_decimate_options), intent(inout) :: options
    integer(c_int) :: status
    status = c_decimate_options_init(options, c_sizeof(options)) ! which cannot fail
  end subroutine

  subroutine init_parameterize_options(options)
    type(planish_parameterize_options), intent(inout) :: options
    integer(c_int) :: status
    status = c_parameterize_options_init(options, c_sizeof(options)) ! which cannot fail
  end subroutine

  subroutine init_sphere_options(options)
    type(planish_sphere_options), intent(inout) :: options
    integer(c_int) :: status
    status = c_sphere_options_init(options, c_sizeof(options)) ! which cannot fail
  end subroutine

  subroutine init_feature_options(options)
    type(planish_feature_options), intent(inout) :: options
    integer(c_int) :: status
    status = c_feature_options_init(options, c_sizeof(options)) ! which cannot fail
  end subroutine

  subroutine init_layout_options(options)
    type(planish_layout_options), intent(inout) :: options
    integer(c_int) :: status
    status = c_layout_options_init(options, c_sizeof(options)) ! which cannot fail
  end subroutine

  subroutine init_mesh_layout_options(options)
    type(planish_mesh_layout_options), intent(inout) :: options
    integer(c_int) :: status
    status = c_mesh_layout_options_init(options, c_sizeof(options)) ! which cannot fail
  end subroutine

  subroutine init_eval_options(options)
    type(planish_eval_options), intent(inout) :: options
    integer(c_int) :: status
    status = c_eval_options_init(options, c_sizeof(options)) ! which cannot fail
  end subroutine

  subroutine init_trim_options(options)
    type(planish_trim_options), intent(inout) :: options
    integer(c_int) :: status
    status = c_trim_options_init(options, c_sizeof(options)) ! which cannot fail
  end subroutine

  subroutine init_convert_options(options)
    type(planish_convert_options), intent(inout) :: options
    integer(c_int) :: status
    status = c_convert_options_init(options, c_sizeof(options)) ! which cannot fail
  end subroutine

  subroutine init_tensor_options(options)
    type(planish_tensor_options), intent(inout) :: options
    integer(c_int) :: status
    status = c_tensor_options_init(options, c_sizeof(options)) ! which cannot fail
  end subroutine

  subroutine init_field_options(options)
    type(planish_field_options), intent(inout) :: options
    integer(c_int) :: status
    status = c_field_options_init(options, c_sizeof(options)) ! which cannot fail
  end subroutine

  subroutine init_gradient_options(options)
    type(planish_gradient_options), intent(inout) :: options
    integer(c_int) :: status
    status = c_gradient_options_init(options, c_sizeof(options)) ! which cannot fail
  end subroutine

  subroutine init_smooth_options(options)
    type(planish_smooth_options), intent(inout) :: options
    integer(c_int) :: status
    status = c_smooth_options_init(options, c_sizeof(options)) ! which cannot fail
  end subroutine

  subroutine init_transfer_options(options)
    type(planish_transfer_options), intent(inout) :: options
    integer(c_int) :: status
    status = c_transfer_options_init(options, c_sizeof(options)) ! which cannot fail
  end subroutine

  subroutine init_tessellate_options(options)
    type(planish_tessellate_options), intent(inout) :: options
    integer(c_int) :: status
    status = c_tessellate_options_init(options, c_sizeof(options)) ! which cannot fail
  end subroutine

  subroutine init_project_options(options)
    type(planish_project_options), intent(inout) :: options
    integer(c_int) :: status
    status = c_project_options_init(options, c_sizeof(options)) ! which cannot fail
  end subroutine

  subroutine init_deviation_options(options)
    type(planish_deviation_options), intent(inout) :: options
    integer(c_int) :: status
    status = c_deviation_options_init(options, c_sizeof(options)) ! which cannot fail
  end subroutine

  subroutine init_sample_rows_options(options)
    type(planish_sample_rows_options), intent(inout) :: options
    integer(c_int) :: status
    status = c_sample_rows_options_init(options, c_sizeof(options)) ! which cannot fail
  end subroutine

  subroutine init_fair_options(options)
    type(planish_fair_options), intent(inout) :: options
    integer(c_int) :: status
    status = c_fair_options_init(options, c_sizeof(options)) ! which cannot fail
  end subroutine

  subroutine init_vtk_options(options)
    type(planish_vtk_options), intent(inout) :: options
    integer(c_int) :: status
    status = c_vtk_options_init(options, c_sizeof(options)) ! which cannot fail
  end subroutine

  subroutine init_step_options(options)
    type(planish_step_options), intent(inout) :: options
    integer(c_int) :: status
    status = c_step_options_init(options, c_sizeof(options)) ! which cannot fail
  end subroutine

  subroutine init_report_options(options)
    type(planish_report_options), intent(inout) :: options
    integer(c_int) :: status
    status = c_report_options_init(options, c_sizeof(options)) ! which cannot fail
  end subroutine

  subroutine init_model_options(options)
    type(planish_model_options), intent(inout) :: options
    integer(c_int) :: status
    status = c_model_options_init(options, c_sizeof(options)) ! which cannot fail
  end subroutine

  subroutine init_curve_options(options)
    type(planish_curve_options), intent(inout) :: options
    integer(c_int) :: status
    status = c_curve_options_init(options, c_sizeof(options)) ! which cannot fail
  end subroutine

  subroutine init_interpolate_options(options)
    type(planish_interpolate_options), intent(inout) :: options
    integer(c_int) :: status
    status = c_interpolate_options_init(options, c_sizeof(options)) ! which cannot fail
  end subroutine

  subroutine init_skin_options(options)
    type(planish_skin_options), intent(inout) :: options
    integer(c_int) :: status
    status = c_skin_options_init(options, c_sizeof(options)) ! which cannot fail
  end subroutine

  subroutine init_pht_options(options)
    type(planish_pht_options), intent(inout) :: options
    integer(c_int) :: status
    status = c_pht_options_init(options, c_sizeof(options)) ! which cannot fail
  end subroutine

  subroutine init_pht_simplify_options(options)
    type(planish_pht_simplify_options), intent(inout) :: options
    integer(c_int) :: status
    status = c_pht_simplify_options_init(options, c_sizeof(options)) ! which cannot fail
  end subroutine

  subroutine init_pht_convert_options(options)
    type(planish_pht_convert_options), intent(inout) :: options
    integer(c_int) :: status
    status = c_pht_convert_options_init(options, c_sizeof(options)) ! which cannot fail
  end subroutine

  subroutine init_pht_patches_options(options)
    type(planish_pht_patches_options), intent(inout) :: options
    integer(c_int) :: status
    status = c_pht_patches_options_init(options, c_sizeof(options)) ! which cannot fail
  end subroutine

  subroutine init_d1rc_options(options)
    type(planish_d1rc_options), intent(inout) :: options
    integer(c_int) :: status
    status = c_d1rc_options_init(options, c_sizeof(options)) ! which cannot fail
  end subroutine
end module
