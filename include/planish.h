/* SPDX-License-Identifier: MIT OR Apache-2.0 */

#ifndef PLANISH_H
#define PLANISH_H

/* Generated from src/ffi: do not edit. `cargo run -p planish-header` renews it. */

#include <stddef.h>
#include <stdint.h>

/* The version of this header; planish_version() is that of the library. */
#define PLANISH_VERSION_MAJOR 0
#define PLANISH_VERSION_MINOR 2
#define PLANISH_VERSION_PATCH 0
#define PLANISH_VERSION "0.2.0"

#if defined(_WIN32) && !defined(PLANISH_STATIC)
#  define PLANISH_API __declspec(dllimport)
#else
#  define PLANISH_API
#endif

#if defined(__GNUC__) || defined(__clang__)
#  define PLANISH_NODISCARD __attribute__((warn_unused_result))
#elif defined(_MSC_VER)
#  define PLANISH_NODISCARD _Check_return_
#else
#  define PLANISH_NODISCARD
#endif


/**
 * The value of stretch_steps that goes on until the stretch no longer falls.
 */
#define PLANISH_UNLIMITED UINT32_MAX

/**
 * Stands for "none" where a number of a face or shell is expected.
 */
#define PLANISH_NONE UINT32_MAX

/**
 * What a call came to: 0 or positive is success, negative is an error. Test with `status < 0`.
 *
 * A positive status is a success with a remark: all outputs are filled. Where several remarks hold the
 * gravest is returned, in the order FOLDED_PARAMETERS, TOLERANCE_NOT_MET, STAGNATED, POINTS_OUTSIDE,
 * NOT_PROVEN, INPUT_REPAIRED; reports have all of them. After an error no output has been touched, and
 * planish_error_message() and planish_error_index() say more. Numbers are never reused; new ones may come.
 */
typedef enum planish_status {
    /**
     * All went well.
     */
    PLANISH_STATUS_OK = 0,
    /**
     * The surface misses the tolerance; it is the best one found.
     */
    PLANISH_STATUS_TOLERANCE_NOT_MET = 1,
    /**
     * The fit ended because refinement no longer lowered the error.
     */
    PLANISH_STATUS_STAGNATED = 2,
    /**
     * Some points lie outside the domain; their values are NaN.
     */
    PLANISH_STATUS_POINTS_OUTSIDE = 3,
    /**
     * The mesh is not all that was given: nodes were welded, split or passed over, triangles dropped or turned over, or
     * texture coordinates that are no parameters left out. planish_mesh_repairs counts them.
     */
    PLANISH_STATUS_INPUT_REPAIRED = 4,
    /**
     * Some triangles are turned over or flat in the parameter plane: a surface over them may fold.
     */
    PLANISH_STATUS_FOLDED_PARAMETERS = 5,
    /**
     * A search could not prove that its answers are the nearest places; a flag says for which points.
     */
    PLANISH_STATUS_NOT_PROVEN = 6,
    /**
     * An argument that must not be NULL is.
     */
    PLANISH_STATUS_NULL_POINTER = -1,
    /**
     * An argument or option is out of its range, or contradicts another.
     */
    PLANISH_STATUS_INVALID_ARGUMENT = -2,
    /**
     * A number is NaN or infinite.
     */
    PLANISH_STATUS_NOT_FINITE = -3,
    /**
     * An index is out of range.
     */
    PLANISH_STATUS_INDEX = -4,
    /**
     * The mesh is not connected as the call needs it.
     */
    PLANISH_STATUS_TOPOLOGY = -5,
    /**
     * The geometry is degenerate: lengths, areas or ranges are zero.
     */
    PLANISH_STATUS_DEGENERATE = -6,
    /**
     * A parameter lies outside the domain.
     */
    PLANISH_STATUS_OUTSIDE = -7,
    /**
     * The data do not determine the result.
     */
    PLANISH_STATUS_SINGULAR = -8,
    /**
     * The call does not apply to this family of surface.
     */
    PLANISH_STATUS_WRONG_KIND = -9,
    /**
     * The caller's array is too short for the result.
     */
    PLANISH_STATUS_BUFFER_TOO_SMALL = -10,
    /**
     * A size exceeds a limit, or what memory can address.
     */
    PLANISH_STATUS_TOO_LARGE = -11,
    /**
     * A file cannot be opened, read or written.
     */
    PLANISH_STATUS_FILE = -12,
    /**
     * The content of a file is not what it claims to be.
     */
    PLANISH_STATUS_FORMAT = -13,
    /**
     * A record has fields that this version of the library does not know, and they are not zero.
     */
    PLANISH_STATUS_VERSION = -14,
    /**
     * The progress callback asked to stop.
     */
    PLANISH_STATUS_CANCELLED = -15,
    /**
     * Memory for a copy of the caller's arrays could not be had.
     */
    PLANISH_STATUS_OUT_OF_MEMORY = -16,
    /**
     * A bug in the library. Handles stay valid; arrays of results may be partly written.
     */
    PLANISH_STATUS_INTERNAL = -17,
} planish_status;

/**
 * What a long call is doing.
 */
enum planish_stage
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /**
     * Looks at what it was given.
     */
    PLANISH_STAGE_PREPARE = 0,
    /**
     * Gives a mesh its parameters, or its places on a sphere.
     */
    PLANISH_STAGE_PARAMETERIZE = 1,
    /**
     * Makes a mesh coarser.
     */
    PLANISH_STAGE_COARSEN = 2,
    /**
     * Lays quadrilaterals over a mesh.
     */
    PLANISH_STAGE_LAYOUT = 3,
    /**
     * Fits, measures and refines.
     */
    PLANISH_STAGE_FIT = 4,
    /**
     * Looks for the nearest places.
     */
    PLANISH_STAGE_PROJECT = 5,
    /**
     * Makes triangles of a surface.
     */
    PLANISH_STAGE_TESSELLATE = 6,
    /**
     * Makes another form of a surface.
     */
    PLANISH_STAGE_CONVERT = 7,
    /**
     * Writes a file.
     */
    PLANISH_STAGE_WRITE = 8,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum planish_stage planish_stage;
#else
typedef uint32_t planish_stage;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/**
 * Faults that are mended when arrays or a file become a mesh. All others are refused.
 */
typedef enum planish_mesh_repair {
    /**
     * All that change no shape and need no guess: the five that follow NONE.
     */
    PLANISH_MESH_REPAIR_SAFE = 0,
    /**
     * None.
     */
    PLANISH_MESH_REPAIR_NONE = 1,
    /**
     * Nodes that no triangle needs are kept and passed over, whatever their coordinates are.
     */
    PLANISH_MESH_REPAIR_UNUSED_NODES = 2,
    /**
     * Triangles with a corner twice are left out, and faces of less than three corners.
     */
    PLANISH_MESH_REPAIR_REPEATED_CORNERS = 4,
    /**
     * Of triangles with the same three nodes, whatever their orientation, only the first is kept.
     */
    PLANISH_MESH_REPAIR_DUPLICATE_TRIANGLES = 8,
    /**
     * Nodes where the surface touches itself become one for each part; the copies come after all other nodes.
     */
    PLANISH_MESH_REPAIR_TOUCHING_NODES = 16,
    /**
     * Triangles are turned over until neighbours agree, as few as that takes.
     */
    PLANISH_MESH_REPAIR_ORIENTATION = 32,
    /**
     * Edges of three and more triangles are parted: sheets that meet others only there get nodes of their own.
     */
    PLANISH_MESH_REPAIR_SHEETS = 64,
    /**
     * All of them.
     */
    PLANISH_MESH_REPAIR_ALL = 126,
} planish_mesh_repair;

/**
 * Which parts of a mesh that hang together by edges are taken.
 */
typedef enum planish_mesh_components {
    /**
     * All.
     */
    PLANISH_MESH_COMPONENTS_ALL = 0,
    /**
     * The one of most triangles; of equals the first.
     */
    PLANISH_MESH_COMPONENTS_LARGEST = 1,
    /**
     * One by its number.
     */
    PLANISH_MESH_COMPONENTS_ONE = 2,
} planish_mesh_components;

/**
 * A format of mesh files.
 */
typedef enum planish_mesh_format {
    /**
     * The one that the name ends in; if that says nothing, or there is no name, the one that the content begins like.
     */
    PLANISH_MESH_FORMAT_AUTO = 0,
    /**
     * Object file format of Geomview. Parameters are its texture coordinates.
     */
    PLANISH_MESH_FORMAT_OFF = 1,
    /**
     * Wavefront OBJ. Parameters are its `vt`.
     */
    PLANISH_MESH_FORMAT_OBJ = 2,
    /**
     * Polygon file format. Parameters are its numbers u and v, and every other number on its nodes is a field.
     */
    PLANISH_MESH_FORMAT_PLY = 3,
    /**
     * Stereolithography: triangles alone. Corners with equal coordinates become one node.
     */
    PLANISH_MESH_FORMAT_STL = 4,
} planish_mesh_format;

/**
 * Which weights an interior node gives its neighbours.
 */
typedef enum planish_map_method {
    /**
     * Mean value coordinates: no triangle turns over over a convex border.
     */
    PLANISH_MAP_METHOD_MEAN_VALUE = 0,
    /**
     * Cotangents: the conformal map of a flat sheet. Triangles may turn over; the report counts them.
     */
    PLANISH_MAP_METHOD_HARMONIC = 1,
} planish_map_method;

/**
 * Where the longest boundary loop goes.
 */
typedef enum planish_border {
    /**
     * The one of circle, square by turns, square by arc and (if `unroll` says so) free with the least L2
     * stretch.
     */
    PLANISH_BORDER_AUTO = 0,
    /**
     * The circle inscribed in the unit square, spaced by chord length.
     */
    PLANISH_BORDER_CIRCLE = 1,
    /**
     * The unit square with corners at the four sharpest turns of the loop.
     */
    PLANISH_BORDER_SQUARE_BY_TURNS = 2,
    /**
     * The unit square with corners at each quarter of the loop's length.
     */
    PLANISH_BORDER_SQUARE_BY_ARC = 3,
    /**
     * The unit square with the nodes `corners` at (0,0), (1,0), (1,1), (0,1).
     */
    PLANISH_BORDER_CORNERS = 4,
    /**
     * All boundary nodes, those of holes too, keep the parameters that the mesh has.
     */
    PLANISH_BORDER_KEPT = 5,
    /**
     * No border at all: unrolled so that lengths are kept best, in the units of the mesh. Refused if that
     * folds or overlaps itself.
     */
    PLANISH_BORDER_FREE = 6,
} planish_border;

/**
 * Which layout a mesh gets.
 */
typedef enum planish_layout_kind {
    /**
     * The cube for closed meshes of genus 0, else the base complex.
     */
    PLANISH_LAYOUT_KIND_AUTO = 0,
    /**
     * The six faces of a cube; for closed meshes of genus 0 only.
     */
    PLANISH_LAYOUT_KIND_CUBE = 1,
    /**
     * Pairs of triangles of a coarse mesh that follows the shape.
     */
    PLANISH_LAYOUT_KIND_COMPLEX = 2,
} planish_layout_kind;

/**
 * Things worth knowing about a map or a fit: the bits of `remarks` in reports, several may hold.
 */
typedef enum planish_remark {
    /**
     * The surface misses the tolerance.
     */
    PLANISH_REMARK_TOLERANCE_NOT_MET = 1,
    /**
     * The fit ended because refinement no longer lowered the error.
     */
    PLANISH_REMARK_STAGNATED = 2,
    /**
     * Some triangles are turned over or flat in the parameter plane: the surface may fold there.
     */
    PLANISH_REMARK_FOLDED_PARAMETERS = 4,
    /**
     * The mesh had no parameters and was parameterized first.
     */
    PLANISH_REMARK_PARAMETERIZED = 8,
    /**
     * Given parameters were uneven and have been regularized.
     */
    PLANISH_REMARK_REGULARIZED = 16,
    /**
     * The tolerance was below what double precision can keep and was raised.
     */
    PLANISH_REMARK_TOLERANCE_RAISED = 32,
    /**
     * Some cells hold no data; the surface is extrapolated there.
     */
    PLANISH_REMARK_EMPTY_CELLS = 64,
    /**
     * Between the nodes the surface departs from the facets by more than the tolerance and what the facets explain:
     * beside sharp edges, or where it swings.
     */
    PLANISH_REMARK_ROUGH_BETWEEN_NODES = 128,
    /**
     * The map is so compressed that one chart is the wrong tool: cut the mesh into several.
     */
    PLANISH_REMARK_SEGMENTATION_ADVISED = 256,
    /**
     * The data do not determine the beam energy's null space; the plate energy was used instead.
     */
    PLANISH_REMARK_PLATE_ENERGY_USED = 512,
    /**
     * Triangles of the mesh, or of the triangulated model, cross each other.
     */
    PLANISH_REMARK_SELF_INTERSECTING = 1024,
    /**
     * Points that lay on the one before them in their row have been merged with it.
     */
    PLANISH_REMARK_MERGED_POINTS = 1048576,
    /**
     * A row looks reversed or shifted against the one before it: see align in planish_skin_options.
     */
    PLANISH_REMARK_TWISTED_ROWS = 2097152,
    /**
     * Some rows are much nearer to one another than to the next: control curves overshoot.
     */
    PLANISH_REMARK_CLUSTERED_ROWS = 4194304,
    /**
     * The end points of rows are too near to those of the next to say how far apart rows are; mean distances do.
     */
    PLANISH_REMARK_MEAN_STEPS = 8388608,
    /**
     * Holes were closed by fans of triangles while the map was computed.
     */
    PLANISH_REMARK_HOLES_FILLED = 65536,
    /**
     * Triangles without area in space were left out of the map's weights.
     */
    PLANISH_REMARK_ZERO_AREA_TRIANGLES = 131072,
} planish_remark;

/**
 * Why a fit ended.
 */
typedef enum planish_stop_reason {
    /**
     * The tolerance is met.
     */
    PLANISH_STOP_REASON_TOLERANCE_MET = 0,
    /**
     * The caller fixed the grid, so there was nothing to refine.
     */
    PLANISH_STOP_REASON_FIXED_GRID = 1,
    /**
     * The limit on grid or coefficients is reached.
     */
    PLANISH_STOP_REASON_LIMIT = 2,
    /**
     * There would be more coefficients than data.
     */
    PLANISH_STOP_REASON_DATA_EXHAUSTED = 3,
    /**
     * Refinement no longer lowered the error.
     */
    PLANISH_STOP_REASON_STAGNATED = 4,
} planish_stop_reason;

/**
 * The family of a surface.
 */
typedef enum planish_kind {
    /**
     * No surface: the answer for NULL.
     */
    PLANISH_KIND_NONE = 0,
    /**
     * Tensor product B-spline, with or without weights.
     */
    PLANISH_KIND_TENSOR = 1,
    /**
     * T-spline with control curves.
     */
    PLANISH_KIND_TSPLINE = 2,
    /**
     * Bicubic spline over a hierarchical T-mesh.
     */
    PLANISH_KIND_PHT = 3,
    /**
     * Spline over a triangular control mesh.
     */
    PLANISH_KIND_D1RC = 4,
} planish_kind;

/**
 * What to do with points outside the domain.
 */
typedef enum planish_outside {
    /**
     * Refuse all points, before one value is written.
     */
    PLANISH_OUTSIDE_FAIL = 0,
    /**
     * NaN and a flag; the call returns PLANISH_STATUS_POINTS_OUTSIDE.
     */
    PLANISH_OUTSIDE_FLAG = 1,
    /**
     * The polynomial at the domain's end is continued, and the point flagged.
     * A D1RC-spline, whose domain are the faces of its control mesh, is continued by its tangent plane at the nearest
     * place of the border.
     */
    PLANISH_OUTSIDE_EXTRAPOLATE = 2,
} planish_outside;

/**
 * Flags of a point: bits of the elements of out_flags.
 */
typedef enum planish_flag {
    /**
     * The parameters lie outside the domain.
     */
    PLANISH_FLAG_OUTSIDE_DOMAIN = 1,
    /**
     * The point lies outside the trims: in a hole, or beyond the boundary of the data.
     */
    PLANISH_FLAG_OUTSIDE_TRIMS = 2,
    /**
     * The parameters lie in the domain but beyond the box of the data: the surface is extrapolated there.
     */
    PLANISH_FLAG_IN_BUFFER = 4,
    /**
     * The surface has no normal there, so that normal and curvatures are NaN.
     */
    PLANISH_FLAG_NO_NORMAL = 8,
    /**
     * The answer for the point is not proved: the distance is that of a place on the surface, and the least one may
     * be smaller.
     */
    PLANISH_FLAG_NOT_PROVEN = 16,
} planish_flag;

/**
 * Whether the fit of a mesh's shape is its own mirror image.
 */
typedef enum planish_symmetry {
    /**
     * As it comes.
     */
    PLANISH_SYMMETRY_NONE = 0,
    /**
     * About a plane that is given. The mesh must be its own image within the tolerance, and the plane must cut it into
     * two halves along one line from border to border.
     */
    PLANISH_SYMMETRY_ABOUT = 1,
    /**
     * About the plane for which the mesh is nearest to its image.
     */
    PLANISH_SYMMETRY_FOUND = 2,
} planish_symmetry;

/**
 * What a tolerance is measured in.
 */
typedef enum planish_tolerance_scale {
    /**
     * The diagonal of the data's bounding box; for a field, of the box of its values.
     */
    PLANISH_TOLERANCE_SCALE_RELATIVE = 0,
    /**
     * Model units.
     */
    PLANISH_TOLERANCE_SCALE_ABSOLUTE = 1,
} planish_tolerance_scale;

/**
 * What the values of points and fields mean that are NaN.
 */
typedef enum planish_missing {
    /**
     * A mistake: PLANISH_STATUS_NOT_FINITE.
     */
    PLANISH_MISSING_REFUSED = 0,
    /**
     * There is none: the datum is passed over, and its error is NaN.
     */
    PLANISH_MISSING_SKIPPED = 1,
} planish_missing;

/**
 * Where the knot lines of a tensor fit stand.
 */
typedef enum planish_knots {
    /**
     * Where the error asks for them: lines are inserted and taken out one by one.
     */
    PLANISH_KNOTS_ADAPTIVE = 0,
    /**
     * At equal distances: all cells are halved in one direction at a time.
     */
    PLANISH_KNOTS_UNIFORM = 1,
} planish_knots;

/**
 * Which equations determine a tensor surface on a grid.
 */
typedef enum planish_tensor_method {
    /**
     * Least squares in the spline space.
     */
    PLANISH_TENSOR_METHOD_LEAST_SQUARES = 0,
    /**
     * The equations of Dannenhoffer and Haimes, 2009: less accurate on fine grids, for comparison.
     */
    PLANISH_TENSOR_METHOD_FERGUSON = 1,
} planish_tensor_method;

/**
 * What happens at the ends of the knots.
 */
typedef enum planish_ends {
    /**
     * Zero curvature across the ends.
     */
    PLANISH_ENDS_NATURAL = 0,
    /**
     * Two more unknowns a direction.
     */
    PLANISH_ENDS_FREE = 1,
} planish_ends;

/**
 * Which second derivatives cost energy.
 */
typedef enum planish_energy {
    /**
     * Elastic beams along the knot lines.
     */
    PLANISH_ENERGY_BEAM = 0,
    /**
     * An elastic plate over the cells.
     */
    PLANISH_ENERGY_PLATE = 1,
} planish_energy;

/**
 * What to do with parameters that came with a mesh.
 */
typedef enum planish_regularize {
    /**
     * Even them out if they are uneven and it helps.
     */
    PLANISH_REGULARIZE_AUTO = 0,
    /**
     * Take them as they are.
     */
    PLANISH_REGULARIZE_NEVER = 1,
    /**
     * Even them out.
     */
    PLANISH_REGULARIZE_ALWAYS = 2,
} planish_regularize;

/**
 * A parameter direction.
 */
typedef enum planish_axis {
    /**
     * The first parameter.
     */
    PLANISH_AXIS_U = 0,
    /**
     * The second parameter.
     */
    PLANISH_AXIS_V = 1,
} planish_axis;

/**
 * What happens to targets beyond max_distance.
 */
typedef enum planish_far_rule {
    /**
     * The first of them is an error, PLANISH_STATUS_OUTSIDE.
     */
    PLANISH_FAR_RULE_REFUSE = 0,
    /**
     * They take part like all others; the call returns PLANISH_STATUS_POINTS_OUTSIDE.
     */
    PLANISH_FAR_RULE_KEEP = 1,
} planish_far_rule;

/**
 * What the rows of planish_mesh_sample_rows() lie between.
 */
typedef enum planish_row_source {
    /**
     * A boundary loop.
     */
    PLANISH_ROW_SOURCE_LOOP = 0,
    /**
     * A node.
     */
    PLANISH_ROW_SOURCE_NODE = 1,
} planish_row_source;

/**
 * Which energy of a surface is lowered.
 */
typedef enum planish_fairness {
    /**
     * Bending: flat is best.
     */
    PLANISH_FAIRNESS_THIN_PLATE = 0,
    /**
     * Change of bending: round is as good as flat. For surfaces of continuous curvature: no PHT-splines.
     */
    PLANISH_FAIRNESS_CURVATURE_VARIATION = 1,
} planish_fairness;

/**
 * What of the border of a surface's domain stays as it is.
 */
typedef enum planish_kept_border {
    /**
     * Nothing.
     */
    PLANISH_KEPT_BORDER_NONE = 0,
    /**
     * Its place.
     */
    PLANISH_KEPT_BORDER_POSITION = 1,
    /**
     * Its place and its tangent planes.
     */
    PLANISH_KEPT_BORDER_TANGENT = 2,
} planish_kept_border;

/**
 * How far the energy of a surface is lowered where there are data.
 */
typedef enum planish_fair_limit {
    /**
     * Until the surface tells each datum best from the others (generalized cross-validation): noise goes, and what is no
     * noise stays.
     */
    PLANISH_FAIR_LIMIT_NOISE = 0,
    /**
     * As far as the tolerance lets it: what is narrower than that allows is flattened too.
     */
    PLANISH_FAIR_LIMIT_TOLERANCE = 1,
} planish_fair_limit;

/**
 * What a VTK file holds of a surface.
 */
typedef enum planish_vtk_content {
    /**
     * Triangles of the part inside the trims, or of deviation_from.
     */
    PLANISH_VTK_CONTENT_TRIANGLES = 0,
    /**
     * Its Bezier patches as cells of type VTK_BEZIER_QUADRILATERAL (VTK 9): the surface itself. Trims are not
     * shown; cell data "parameters" has least and largest u, least and largest v of each patch.
     */
    PLANISH_VTK_CONTENT_PATCHES = 1,
    /**
     * Its control points, joined by polylines as neighbours in the control net.
     */
    PLANISH_VTK_CONTENT_CONTROL_NET = 2,
} planish_vtk_content;

/**
 * The application protocol of a STEP file.
 */
typedef enum planish_step_schema {
    /**
     * AP214, automotive design: read by every CAD system.
     */
    PLANISH_STEP_SCHEMA_AP214 = 0,
    /**
     * AP242, managed model-based 3D engineering.
     */
    PLANISH_STEP_SCHEMA_AP242 = 1,
} planish_step_schema;

/**
 * What one model unit is.
 */
typedef enum planish_unit {
    /**
     * A millimetre.
     */
    PLANISH_UNIT_MILLIMETRE = 0,
    /**
     * A metre.
     */
    PLANISH_UNIT_METRE = 1,
    /**
     * An inch, 25.4 mm.
     */
    PLANISH_UNIT_INCH = 2,
} planish_unit;

/**
 * What a STEP file holds of a T-spline or PHT-spline.
 */
typedef enum planish_step_form {
    /**
     * The same surface as one tensor surface.
     */
    PLANISH_STEP_FORM_TENSOR = 0,
    /**
     * One face for each span of v, over the knots of four control curves: far fewer control points.
     */
    PLANISH_STEP_FORM_STRIPS = 1,
    /**
     * A PHT-spline as a shell of faces that share edges, each over a rectangle of cells whose levels differ by at
     * most level_spread.
     */
    PLANISH_STEP_FORM_PATCHES = 2,
} planish_step_form;

/**
 * What a face lies on.
 */
typedef enum planish_carrier {
    /**
     * A spline surface.
     */
    PLANISH_CARRIER_SPLINE = 0,
    /**
     * A plane.
     */
    PLANISH_CARRIER_PLANE = 1,
    /**
     * A cylinder.
     */
    PLANISH_CARRIER_CYLINDER = 2,
} planish_carrier;

/**
 * What a shell bounds.
 */
typedef enum planish_shell_role {
    /**
     * Nothing: it may have edges of one face.
     */
    PLANISH_SHELL_ROLE_OPEN = 0,
    /**
     * A solid, from outside.
     */
    PLANISH_SHELL_ROLE_SOLID = 1,
    /**
     * A void inside a solid.
     */
    PLANISH_SHELL_ROLE_VOID = 2,
} planish_shell_role;

/**
 * What the curve of an edge is.
 */
typedef enum planish_edge_shape {
    /**
     * A spline.
     */
    PLANISH_EDGE_SHAPE_SPLINE = 0,
    /**
     * A straight line.
     */
    PLANISH_EDGE_SHAPE_LINE = 1,
    /**
     * A piece of a circle.
     */
    PLANISH_EDGE_SHAPE_CIRCLE = 2,
    /**
     * A piece of an ellipse, the longer axis first.
     */
    PLANISH_EDGE_SHAPE_ELLIPSE = 3,
} planish_edge_shape;

/**
 * Which way a mesh becomes a model.
 */
typedef enum planish_model_family {
    /**
     * Exact faces where planes and cylinders explain the mesh, else patches that keep sharp edges where that serves; one
     * chart for a mesh with one border loop and no features inside, and for other open ones where it does better.
     */
    PLANISH_MODEL_FAMILY_AUTO = 0,
    /**
     * One chart: a PHT-spline inside its trims.
     */
    PLANISH_MODEL_FAMILY_CHART = 1,
    /**
     * Patches over a layout of quadrilaterals.
     */
    PLANISH_MODEL_FAMILY_PATCHES = 2,
} planish_model_family;

/**
 * Which layout the patches have.
 */
typedef enum planish_model_layout {
    /**
     * Over its features, if it has some; else the cube for genus 0, a base complex with handles, or where the cube misses
     * the tolerance and the complex does better.
     */
    PLANISH_MODEL_LAYOUT_AUTO = 0,
    /**
     * The six faces of a cube, which round sharp edges off; genus 0 only.
     */
    PLANISH_MODEL_LAYOUT_CUBE = 1,
    /**
     * Over its features, if it has some; else a base complex: patches that follow the shape.
     */
    PLANISH_MODEL_LAYOUT_COMPLEX = 2,
} planish_model_layout;

/**
 * Which knots the control curves of a skin get.
 */
typedef enum planish_skin_method {
    /**
     * Each its own, as few as the tolerance allows.
     */
    PLANISH_SKIN_METHOD_CONTROL_CURVES = 0,
    /**
     * All the same: the classical skin, for comparison.
     */
    PLANISH_SKIN_METHOD_COMMON_KNOTS = 1,
} planish_skin_method;

/**
 * What happens at the ends of rows.
 */
typedef enum planish_section_ends {
    /**
     * Periodic for closed rows, parabolic for open ones.
     */
    PLANISH_SECTION_ENDS_AUTO = 0,
    /**
     * The slope of the parabola through three points; at the seam of closed rows a kink may remain.
     */
    PLANISH_SECTION_ENDS_PARABOLIC = 1,
    /**
     * No curvature.
     */
    PLANISH_SECTION_ENDS_NATURAL = 2,
    /**
     * The slopes in end_slopes.
     */
    PLANISH_SECTION_ENDS_SLOPES = 3,
    /**
     * Closed rows go on over the seam without a break in two derivatives.
     */
    PLANISH_SECTION_ENDS_PERIODIC = 4,
} planish_section_ends;

/**
 * How far apart rows are along v.
 */
typedef enum planish_v_rule {
    /**
     * As their first and last points are; where that gives a step of next to nothing, as PLANISH_V_RULE_MEAN.
     */
    PLANISH_V_RULE_ENDPOINTS = 0,
    /**
     * As points at equal fractions of their lengths are on average.
     */
    PLANISH_V_RULE_MEAN = 1,
} planish_v_rule;

/**
 * How a skin runs from row to row.
 */
typedef enum planish_v_slopes {
    /**
     * Without a break in two derivatives; bunched rows make it swing between others.
     */
    PLANISH_V_SLOPES_SMOOTH = 0,
    /**
     * Without a break in one derivative, and no coordinate leaves the range of the two rows that it is between: it
     * cannot overshoot. Not together with tangents, closed_v or approximate_v.
     */
    PLANISH_V_SLOPES_MONOTONE = 1,
} planish_v_slopes;

/**
 * What determines a PHT-spline at its vertices.
 */
typedef enum planish_pht_estimator {
    /**
     * Least squares over all data with a weak bending energy: fewest coefficients.
     */
    PLANISH_PHT_ESTIMATOR_GLOBAL = 0,
    /**
     * A quadratic fit around each datum, interpolated linearly (Deng et al., 2008): for comparison.
     */
    PLANISH_PHT_ESTIMATOR_LOCAL_QUADRATIC = 1,
    /**
     * A weighted cubic fit around each vertex: no system to solve, for very large data.
     */
    PLANISH_PHT_ESTIMATOR_LOCAL_CUBIC = 2,
} planish_pht_estimator;

/**
 * Whether a PHT fit merges cells again as long as the tolerance is met, at the cost of up to 40 further fits.
 */
typedef enum planish_coarsening {
    /**
     * Where the surface has two continuous derivatives.
     */
    PLANISH_COARSENING_AUTO = 0,
    /**
     * Yes.
     */
    PLANISH_COARSENING_ON = 1,
    /**
     * No.
     */
    PLANISH_COARSENING_OFF = 2,
} planish_coarsening;

/**
 * An edge of a surface's domain.
 */
typedef enum planish_border_side {
    /**
     * Least u.
     */
    PLANISH_BORDER_SIDE_LOW_U = 0,
    /**
     * Largest u.
     */
    PLANISH_BORDER_SIDE_HIGH_U = 1,
    /**
     * Least v.
     */
    PLANISH_BORDER_SIDE_LOW_V = 2,
    /**
     * Largest v.
     */
    PLANISH_BORDER_SIDE_HIGH_V = 3,
} planish_border_side;

/**
 * Which control points a PHT-spline has.
 */
typedef enum planish_pht_basis {
    /**
     * Of the cells at the birth of a vertex (Deng et al., 2008): independent of later splits.
     */
    PLANISH_PHT_BASIS_CANONICAL = 0,
    /**
     * Of the widest cell of a vertex's support on each side: well conditioned whatever the levels.
     */
    PLANISH_PHT_BASIS_SUPPORT_SIZED = 1,
} planish_pht_basis;

/**
 * Which functions a D1RC-spline has.
 */
typedef enum planish_d1rc_mode {
    /**
     * They sum to one and reproduce polynomials, on the whole domain; the surface is polynomial on pieces.
     */
    PLANISH_D1RC_MODE_REPRODUCING = 0,
    /**
     * As printed (Cao, Zheng, 2016): rational, only inner vertices count, the surface ends before the mesh does.
     */
    PLANISH_D1RC_MODE_PAPER = 1,
} planish_d1rc_mode;

/**
 * The border of a D1RC-spline of PLANISH_D1RC_MODE_REPRODUCING.
 */
typedef enum planish_d1rc_boundary {
    /**
     * Smooth everywhere; the border follows the boundary polygon as a B-spline follows its control points.
     */
    PLANISH_D1RC_BOUNDARY_PHANTOM = 0,
    /**
     * The boundary polygon is interpolated; across the edges that touch it the surface is only continuous.
     */
    PLANISH_D1RC_BOUNDARY_CLAMPED = 1,
    /**
     * The domain ends some faces before the mesh does.
     */
    PLANISH_D1RC_BOUNDARY_OPEN = 2,
} planish_d1rc_boundary;

/**
 * What happens at sharp edges of a D1RC-spline.
 */
typedef enum planish_d1rc_sharp {
    /**
     * PLANISH_D1RC_SHARP_CUT, in PLANISH_D1RC_MODE_PAPER PLANISH_D1RC_SHARP_ADDITIVE.
     */
    PLANISH_D1RC_SHARP_AUTOMATIC = 0,
    /**
     * The crease is the control polyline, at its full angle. In PLANISH_D1RC_MODE_REPRODUCING only.
     */
    PLANISH_D1RC_SHARP_CUT = 1,
    /**
     * Functions of the crease, and smooth functions only on their side of it. In PLANISH_D1RC_MODE_PAPER only.
     */
    PLANISH_D1RC_SHARP_SECTOR = 2,
    /**
     * Functions of the crease beside all smooth ones: a soft crease. The surface is rational then.
     */
    PLANISH_D1RC_SHARP_ADDITIVE = 3,
} planish_d1rc_sharp;

/**
 * A B-spline curve: a map from an interval of parameters u to R^dim. Made by planish_curve_fit(),
 * planish_curve_interpolate(), planish_curve_new() or planish_curve_load(), destroyed by planish_curve_free().
 *
 * Calls that take it const may run at once on any threads.
 * The first projection onto it builds an index, which it keeps.
 */
typedef struct planish_curve planish_curve;

/**
 * Fits fields on the nodes of one mesh, or at the same parameters, again and again: grid, factorization and threads
 * are kept. Made by planish_field_fitter_new(), destroyed by planish_field_fitter_free().
 *
 * Calls that take it const may run at once on any threads. A process forked after its first use does not have its
 * threads: calls return PLANISH_STATUS_INVALID_ARGUMENT there, and only planish_field_fitter_free() is left to do. One
 * made with thread_count 1 has no threads and stays of use.
 */
typedef struct planish_field_fitter planish_field_fitter;

/**
 * Quadrilateral patches and how they meet; made for a mesh, also the places of its nodes on them.
 *
 * Const calls may run at once on any threads.
 */
typedef struct planish_layout planish_layout;

/**
 * A triangle mesh: manifold and consistently oriented, possibly with several components, holes and nodes
 * without triangles, which are passed over. Made by planish_mesh_new() and others, destroyed by planish_mesh_free().
 *
 * Calls that take it const may run at once on any threads; a call that takes it non-const needs it alone.
 */
typedef struct planish_mesh planish_mesh;

/**
 * A model: faces, each a bounded part of a surface, that share edges and vertices. Made by
 * planish_model_from_surface() and others, destroyed by planish_model_free(). A field over the faces of a model, made by
 * planish_field_fitter_fit_model(), is one of another dimension: calls that need places in space refuse it with
 * PLANISH_STATUS_WRONG_KIND.
 *
 * Faces, edges, vertices and shells have numbers from 0 on. Calls that take a model const may run at once on any
 * threads.
 */
typedef struct planish_model planish_model;

/**
 * A surface: a map from a rectangle of parameters (u,v) to R^dim. Made by planish_tensor_fit() and others,
 * destroyed by planish_surface_free().
 *
 * Calls that take it const may run at once on any threads; a call that takes it non-const needs it alone.
 * The first projection onto it builds an index, some hundred bytes for each control point, which it keeps until it
 * is changed or destroyed.
 */
typedef struct planish_surface planish_surface;

/**
 * Carries values from the nodes of a source mesh to target points, and forces on these back to the nodes. Made by
 * planish_transfer_new(), destroyed by planish_transfer_free().
 *
 * Calls that take it const may run at once on any threads.
 */
typedef struct planish_transfer planish_transfer;

/**
 * What was done to arrays or a file to make a mesh of them. Set struct_size to sizeof(planish_mesh_repairs)
 * before the call.
 */
typedef struct planish_mesh_repairs {
    /**
     * sizeof(planish_mesh_repairs) as the caller sees it.
     */
    size_t struct_size;
    /**
     * Nodes that vanished because they were welded to others.
     */
    size_t welded_node_count;
    /**
     * Triangles and faces that were left out because two of their corners are one node, as given or by welding,
     * or because they have less than three.
     */
    size_t dropped_triangle_count;
    /**
     * Triangles that were turned over.
     */
    size_t flipped_triangle_count;
    /**
     * 1 if the file has texture coordinates that are no parameters, because a node has several or none, or because
     * they are not finite or lie on a line.
     */
    uint32_t dropped_parameters;
    /**
     * 1 if the file ends before it says that it does; what it has is whole.
     */
    uint32_t missing_end;
    /**
     * Nodes that no triangle needs.
     */
    size_t unused_node_count;
    /**
     * Copies of nodes that were appended.
     */
    size_t split_node_count;
    /**
     * Triangles that were left out because an earlier one has the same nodes.
     */
    size_t duplicate_triangle_count;
    /**
     * Edges of three and more triangles that were parted.
     */
    size_t parted_edge_count;
    /**
     * Triangles of components that were not asked for: a choice, no repair.
     */
    size_t excluded_triangle_count;
} planish_mesh_repairs;

/**
 * How arrays or files become a mesh. Fill with planish_mesh_options_init(), then change what you need.
 */
typedef struct planish_mesh_options {
    /**
     * Set by planish_mesh_options_init().
     */
    size_t struct_size;
    /**
     * Doubles from one node to the next in `points`; at least 3, or 0 (default) for 3. Ignored for files.
     */
    size_t point_stride;
    /**
     * Indices from one triangle to the next in `triangles`; at least 3, or 0 (default) for 3. Ignored for
     * files.
     */
    size_t triangle_stride;
    /**
     * Nodes not further apart than this become one, in model units. Default 0: nothing is welded, except
     * that nodes of STL files with equal coordinates always are.
     */
    double weld_distance;
    /**
     * Receives what was repaired, or NULL (default). Set its struct_size before. Filled on success only.
     */
    struct planish_mesh_repairs *out_repairs;
    /**
     * Receives for each node given the node of the mesh that it became, counted from 0: point_count
     * elements, or NULL (default). Filled on success only. Must be NULL for files;
     * planish_mesh_copy_node_map() tells the same the other way round.
     * Array: [nodes].
     */
    uint32_t *out_node_map;
    /**
     * 1 turns triangles over until neighbours agree, whatever repair says; 0 (default) leaves that to repair.
     */
    uint32_t orient;
    /**
     * The number that `triangles` uses for the first node, such as 1 from Fortran. Default 0. Ignored for
     * files. Everything that the library hands back counts from 0.
     */
    uint32_t index_base;
    /**
     * Corners of each face, at least 3: `triangles` then holds polygons, one behind the other, and
     * triangle_count is their number. NULL (default) for corner_count each. Borrowed. Ignored for files.
     * Array: [faces].
     */
    const uint32_t *face_sizes;
    /**
     * Most bytes of a file, unpacked; 0 (default) for three quarters of what the machine or its control group
     * has.
     */
    uint64_t max_memory;
    /**
     * Which faults are mended: bits of planish_mesh_repair. 0 (default) is PLANISH_MESH_REPAIR_SAFE.
     */
    uint32_t repair;
    /**
     * A planish_mesh_components: which parts that hang together by edges become the mesh. The nodes of others
     * stay, as nodes that no triangle needs. Default PLANISH_MESH_COMPONENTS_ALL.
     */
    uint32_t components;
    /**
     * The part for PLANISH_MESH_COMPONENTS_ONE, counted from 0 in the order of their first triangles. Default 0.
     */
    uint32_t component;
    /**
     * A planish_mesh_format, of files and buffers. Default PLANISH_MESH_FORMAT_AUTO.
     */
    uint32_t format;
    /**
     * Corners of every face if face_sizes is NULL: 0 (default) or 3 for triangles, 4 for quads and so on.
     * Polygons become triangles. Ignored for files.
     */
    uint32_t corner_count;
    /**
     * 0.
     */
    uint32_t reserved;
} planish_mesh_options;

/**
 * How a mesh is written. Fill with planish_mesh_write_options_init(), then change what you need.
 */
typedef struct planish_mesh_write_options {
    /**
     * Set by planish_mesh_write_options_init().
     */
    size_t struct_size;
    /**
     * A planish_mesh_format. Default PLANISH_MESH_FORMAT_AUTO: what the name ends in.
     */
    uint32_t format;
    /**
     * 1 writes PLY and STL as text; with 0 (default) they are binary. OFF and OBJ are texts always.
     */
    uint32_t text;
} planish_mesh_write_options;

/**
 * Hears how far a call is and may end it. It is asked at least every 50 ms while other threads do the work.
 *
 * fraction: how much is done, 0 to 1; it never falls.
 * error:    while a surface is fitted the largest error so far in model units; in calls that only parameterize a mesh
 *           the L2 stretch so far; NaN while unknown.
 * user:     the pointer from the options.
 * Returns 0 to go on; anything else cancels, and the call returns PLANISH_STATUS_CANCELLED when the step in
 * progress, such as a factorization, has ended.
 *
 * It is called on the thread that made the call. With thread_count 1 that thread does the work too and asks between its
 * steps. It must not throw or longjmp: a C++ exception that leaves it ends the process. It may call the library, but not
 * change or destroy what the call was given.
 */
typedef int32_t (*planish_progress)(double fraction, double error, void *user);

/**
 * How coarse a mesh becomes, and what stays. Fill with planish_decimate_options_init(), then change what you need.
 */
typedef struct planish_decimate_options {
    /**
     * Set by planish_decimate_options_init().
     */
    size_t struct_size;
    /**
     * Nodes that are to be left, at least 3. Default 1000.
     */
    size_t target_count;
    /**
     * Edges whose triangles turn by more than this are sharp, in radians, at most pi; 0 (default) looks for none.
     */
    double sharp_angle;
    /**
     * Where the boundary or a chain of sharp edges turns by more than this, in radians, at most pi, its node
     * stays. Default pi / 4.
     */
    double corner_angle;
    /**
     * Further sharp edges: two nodes each, counted from 0; NULL (default) for none.
     * Array: [sharp_edge_count, 2].
     */
    const uint32_t *sharp_edges;
    /**
     * Edges in sharp_edges. Default 0.
     */
    size_t sharp_edge_count;
    /**
     * Receives the sharp edges of the new mesh, two nodes each, counted from 0, the smaller first; or NULL
     * (default). Written on success only.
     * Array: [out_sharp_edge_count, 2].
     */
    uint32_t *out_sharp_edges;
    /**
     * Edges that out_sharp_edges has room for; there are at most as many as sharp edges before. Default 0.
     */
    size_t out_sharp_edge_count;
    /**
     * Hears of the progress and may cancel; NULL (default) for nobody.
     */
    planish_progress progress;
    /**
     * Handed to progress as it is.
     */
    void *user;
    /**
     * Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
     */
    const volatile int32_t *cancel;
    /**
     * Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
     * Array: [1].
     */
    uint32_t *out_stage;
    /**
     * 1 (default) lets no triangle turn over in the parameter plane, if the mesh has parameters; 0 does not look.
     */
    uint32_t keep_map;
    /**
     * 0.
     */
    uint32_t reserved;
} planish_decimate_options;

/**
 * What was done to make a mesh coarser. Set struct_size to sizeof(planish_decimate_report) before the call; the
 * report is filled as far as that goes, on success only.
 */
typedef struct planish_decimate_report {
    /**
     * sizeof(planish_decimate_report) as the caller sees it.
     */
    size_t struct_size;
    /**
     * Edges that were collapsed.
     */
    size_t collapse_count;
    /**
     * Nodes beyond the target that had to stay, because nothing more can be collapsed.
     */
    size_t excess_count;
    /**
     * Sharp edges of the new mesh.
     */
    size_t sharp_edge_count;
    /**
     * Wall time in seconds.
     */
    double seconds;
} planish_decimate_report;

/**
 * How a mesh gets its parameters. Fill with planish_parameterize_options_init(), then change what you need.
 */
typedef struct planish_parameterize_options {
    /**
     * Set by planish_parameterize_options_init().
     */
    size_t struct_size;
    /**
     * A positive number for each node: large where more parameter area is wanted. NULL (default) for all 1.
     * Array: [nodes].
     */
    const double *node_weights;
    /**
     * Hears of the progress and may cancel; NULL (default) for nobody.
     */
    planish_progress progress;
    /**
     * Handed to progress as it is.
     */
    void *user;
    /**
     * Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
     */
    const volatile int32_t *cancel;
    /**
     * Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
     * Array: [1].
     */
    uint32_t *out_stage;
    /**
     * Outward bulge of a square's sides, in sides, 0 to 0.5: keeps triangles between nodes of one side open.
     * Default 0.02.
     */
    double bulge;
    /**
     * How far border nodes slide with the stretch, 0 to 1. Default 0.
     */
    double boundary_slide;
    /**
     * A planish_map_method. Default PLANISH_MAP_METHOD_MEAN_VALUE.
     */
    uint32_t method;
    /**
     * A planish_border. Default PLANISH_BORDER_AUTO.
     */
    uint32_t border;
    /**
     * For PLANISH_BORDER_CORNERS: four nodes of the longest boundary loop in its order, counted from 0.
     */
    uint32_t corners[4];
    /**
     * Most steps that lower the stretch after the first map: 0 for none, PLANISH_UNLIMITED (default) until it
     * no longer falls.
     */
    uint32_t stretch_steps;
    /**
     * Sweeps that smooth the logarithm of the stretch before each step. Default 0.
     */
    uint32_t rings;
    /**
     * 1 (default) closes holes by fans of triangles while the map is computed; 0 lets them become convex.
     */
    uint32_t fill_holes;
    /**
     * With PLANISH_BORDER_AUTO: 1 (default) also unrolls the map with a free border, and takes that if it
     * neither folds nor overlaps itself and stretches less; 0 does not.
     */
    uint32_t unroll;
    /**
     * Threads to use, at most 1024; 0 (default) for all cores. Results do not depend on it.
     */
    uint32_t thread_count;
    /**
     * 0.
     */
    uint32_t reserved;
} planish_parameterize_options;

/**
 * How good a map is and what it took. Set struct_size to sizeof(planish_parameterize_report) before the call;
 * the report is filled as far as that goes, on success only.
 */
typedef struct planish_parameterize_report {
    /**
     * sizeof(planish_parameterize_report) as the caller sees it.
     */
    size_t struct_size;
    /**
     * L2 stretch of all triangles: 1 is an isometry; infinite if a triangle has no parameter area.
     */
    double stretch;
    /**
     * The largest stretch in any direction anywhere, in the same scale.
     */
    double max_stretch;
    /**
     * The largest ratio of a triangle's area in space to that in the parameters, by the smallest.
     */
    double area_ratio;
    /**
     * Wall time in seconds.
     */
    double seconds;
    /**
     * Triangles turned over against the rest: folds of the map.
     */
    size_t flipped_count;
    /**
     * Triangles of exactly zero parameter area.
     */
    size_t degenerate_count;
    /**
     * Factorizations of the linear system, all candidates together.
     */
    size_t solve_count;
    /**
     * Steps that lowered the stretch of the map returned.
     */
    size_t step_count;
    /**
     * Everything worth knowing: bits of planish_remark.
     */
    uint64_t remarks;
    /**
     * The border that was taken: a planish_border.
     */
    uint32_t border;
    /**
     * 1 if the border slid with the stretch.
     */
    uint32_t border_slid;
} planish_parameterize_report;

/**
 * How a mesh is mapped on to the sphere. Fill with planish_sphere_options_init(), then change what you need.
 */
typedef struct planish_sphere_options {
    /**
     * Set by planish_sphere_options_init().
     */
    size_t struct_size;
    /**
     * Hears of the progress and may cancel; NULL (default) for nobody.
     */
    planish_progress progress;
    /**
     * Handed to progress as it is.
     */
    void *user;
    /**
     * Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
     */
    const volatile int32_t *cancel;
    /**
     * Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
     * Array: [1].
     */
    uint32_t *out_stage;
    /**
     * Sweeps over all nodes at the end. Default 10.
     */
    uint32_t sweeps;
    /**
     * Threads that share the work; 0 (default) for all cores. The result does not depend on it.
     */
    uint32_t thread_count;
} planish_sphere_options;

/**
 * How good a map to the sphere is. Set struct_size to sizeof(planish_sphere_report) before the call; the report is
 * filled as far as that goes, on success only.
 */
typedef struct planish_sphere_report {
    /**
     * sizeof(planish_sphere_report) as the caller sees it.
     */
    size_t struct_size;
    /**
     * Symmetric Dirichlet energy by area, both scaled to those of the sphere: 4 if all lengths are kept.
     */
    double energy;
    /**
     * Triangles whose images are turned over or flat, by the exact sign; 0 but beyond the digits of a double.
     */
    size_t folded_triangles;
    /**
     * Triangles so thin that they counted as wider.
     */
    size_t clamped_triangles;
    /**
     * Image area by area in space, each as a share of its whole: 5 percent of the area have less than this.
     */
    double low_area_ratio;
    /**
     * 5 percent of the area have more than this.
     */
    double high_area_ratio;
    /**
     * Wall time in seconds.
     */
    double seconds;
} planish_sphere_report;

/**
 * What was found of features. Set struct_size to sizeof(planish_feature_report) before the call; the report is
 * filled as far as that goes, on success only.
 */
typedef struct planish_feature_report {
    /**
     * sizeof(planish_feature_report) as the caller sees it.
     */
    size_t struct_size;
    /**
     * Feature edges.
     */
    size_t edge_count;
    /**
     * Those of them on the border.
     */
    size_t border_edge_count;
    /**
     * Chains of feature edges between corners, and closed ones.
     */
    size_t chain_count;
    /**
     * Chains without ends.
     */
    size_t closed_chain_count;
    /**
     * Nodes that are no part of a smooth chain.
     */
    size_t corner_count;
    /**
     * Edges by which chains were made longer.
     */
    size_t prolonged_edge_count;
    /**
     * Edges that were dropped in short bits.
     */
    size_t dropped_edge_count;
    /**
     * Noise of the nodes along the normal, as standard deviation by the mean edge length: an estimate.
     */
    double noise;
} planish_feature_report;

/**
 * How features of a mesh are found. Fill with planish_feature_options_init(), then change what you need.
 */
typedef struct planish_feature_options {
    /**
     * Set by planish_feature_options_init().
     */
    size_t struct_size;
    /**
     * Edges whose facets turn by more than this are features, in radians, at most pi; 0 looks for none. Default
     * 0.7, which is 40 degrees.
     */
    double sharp_angle;
    /**
     * Chains of feature edges that end go on along edges whose facets turn by more than this, in radians, at most
     * pi, which lets none go on. Chains of such edges that turn three times more than the surface beside them bends
     * are features too if they divide it, and a chain that fades out goes on to the next feature straight ahead.
     * Default 0.26, which is 15 degrees; none of this happens if sharp_angle is 0 or this is pi.
     */
    double weak_angle;
    /**
     * Where a chain turns by more than this, in radians, at most pi, it has a corner. Default 0.6, which is
     * 34 degrees.
     */
    double corner_angle;
    /**
     * Bits of chains that end in nothing and are shorter than this part of the diagonal, 0 to 1, are dropped.
     * Default 0.04.
     */
    double least_length;
    /**
     * Edges that are features whatever their angle: two nodes each, counted from 0; NULL (default) for none.
     * Array: [sharp_edge_count, 2].
     */
    const uint32_t *sharp_edges;
    /**
     * Edges in sharp_edges. Default 0.
     */
    size_t sharp_edge_count;
    /**
     * A number for each triangle: edges between triangles of different numbers are features; NULL (default) for
     * none.
     * Array: [mesh_triangle_count].
     */
    const uint32_t *labels;
    /**
     * Receives 1 for each node that is a corner: the end of a chain, a junction, a turn; 0 for all others; or NULL
     * (default). Written on success only.
     * Array: [mesh_point_count].
     */
    uint8_t *out_is_corner;
    /**
     * Receives what was found, or NULL (default). Set its struct_size before. Filled on success only.
     */
    struct planish_feature_report *out_report;
    /**
     * 1 (default) filters the normals of a noisy mesh before angles are measured; 0 takes them as they are.
     */
    uint32_t filter_noise;
    /**
     * 0.
     */
    uint32_t reserved;
} planish_feature_options;

/**
 * How quads make a layout. Fill with planish_layout_options_init(), then change what you need.
 */
typedef struct planish_layout_options {
    /**
     * Set by planish_layout_options_init().
     */
    size_t struct_size;
    /**
     * The number of the edge of each side, where two edges join the same vertices; NULL (default) for edges that
     * are told by their ends. Numbers need not be without gaps.
     * Array: [quad_count, 4].
     */
    const uint32_t *edges;
} planish_layout_options;

/**
 * How a mesh gets a layout. Fill with planish_mesh_layout_options_init(), then change what you need.
 */
typedef struct planish_mesh_layout_options {
    /**
     * Set by planish_mesh_layout_options_init().
     */
    size_t struct_size;
    /**
     * Hears of the progress and may cancel; NULL (default) for nobody.
     */
    planish_progress progress;
    /**
     * Handed to progress as it is.
     */
    void *user;
    /**
     * Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
     */
    const volatile int32_t *cancel;
    /**
     * Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
     * Array: [1].
     */
    uint32_t *out_stage;
    /**
     * A planish_layout_kind. Default PLANISH_LAYOUT_KIND_AUTO.
     */
    uint32_t kind;
    /**
     * About how many patches a base complex has, at least 6. Default 40.
     */
    uint32_t patches;
    /**
     * Most sweeps over all nodes at the end. Default 300.
     */
    uint32_t sweeps;
    /**
     * Threads that share the work; 0 (default) for all cores. The result does not depend on it.
     */
    uint32_t thread_count;
} planish_mesh_layout_options;

/**
 * How good the layout of a mesh is. Set struct_size to sizeof(planish_mesh_layout_report) before the call; the
 * report is filled as far as that goes, on success only.
 */
typedef struct planish_mesh_layout_report {
    /**
     * sizeof(planish_mesh_layout_report) as the caller sees it.
     */
    size_t struct_size;
    /**
     * Symmetric Dirichlet energy of the node map by area: 4 if all lengths are kept; of a cube that of the map to
     * the sphere.
     */
    double energy;
    /**
     * The same before nodes moved over the layout.
     */
    double first_energy;
    /**
     * Nodes with a triangle whose image is turned over.
     */
    size_t folded_node_count;
    /**
     * Nodes whose triangles are spread over patches without a common corner.
     */
    size_t spread_node_count;
    /**
     * Vertices of only two patches that were removed, each with one patch.
     */
    size_t doublet_count;
    /**
     * Edges of the coarse mesh that were split because its triangles could not be paired.
     */
    size_t split_count;
    /**
     * Wall time in seconds.
     */
    double seconds;
    /**
     * The kind that was made: a planish_layout_kind.
     */
    uint32_t kind;
    /**
     * 0.
     */
    uint32_t reserved;
} planish_mesh_layout_report;

/**
 * How points are evaluated. Fill with planish_eval_options_init(), then change what you need.
 */
typedef struct planish_eval_options {
    /**
     * Set by planish_eval_options_init().
     */
    size_t struct_size;
    /**
     * Doubles from one point to the next in `uv`; at least 2, or 0 (default) for 2. Must be 0 for grids.
     */
    size_t uv_stride;
    /**
     * Doubles from one point's results to the next; at least as many as a point has, or 0 (default) for
     * exactly so many. What lies between is left alone.
     */
    size_t out_stride;
    /**
     * Receives bits of planish_flag, one element for each point; NULL (default) for none.
     * Array: [points].
     */
    uint8_t *out_flags;
    /**
     * A planish_outside. Default PLANISH_OUTSIDE_FAIL.
     */
    uint32_t outside;
    /**
     * Threads to use, at most 1024; 0 (default) for all cores. Results do not depend on it, and fewer than
     * about a thousand points are evaluated on the calling thread alone.
     */
    uint32_t thread_count;
} planish_eval_options;

/**
 * How trims follow curves. Fill with planish_trim_options_init(), then change what you need.
 */
typedef struct planish_trim_options {
    /**
     * Set by planish_trim_options_init().
     */
    size_t struct_size;
    /**
     * How far the trims may lie from the curves, and the curves from the surface, positive, measured in
     * tolerance_scale. Default 1e-3.
     */
    double tolerance;
    /**
     * Hears of the progress and may cancel; NULL (default) for nobody.
     */
    planish_progress progress;
    /**
     * Handed to progress as it is.
     */
    void *user;
    /**
     * Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
     */
    const volatile int32_t *cancel;
    /**
     * Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
     * Array: [1].
     */
    uint32_t *out_stage;
    /**
     * A planish_tolerance_scale; relative is to the diagonal of the box of the curves' control points. Default
     * PLANISH_TOLERANCE_SCALE_RELATIVE.
     */
    uint32_t tolerance_scale;
    /**
     * 1 adds the loops to the trims that the surface has, so that a closed curve inside cuts a hole; 0 (default)
     * replaces them.
     */
    uint32_t add;
    /**
     * Threads to use, at most 1024; 0 (default) for all cores. Results do not depend on it.
     */
    uint32_t thread_count;
    /**
     * 0.
     */
    uint32_t reserved;
} planish_trim_options;

/**
 * How near trims are to the curves that they follow: distances of the surface over them to the pieces of curve that
 * they stand for, in model units. Set struct_size to sizeof(planish_trim_report) before the call; the report is
 * filled as far as that goes, on success only.
 */
typedef struct planish_trim_report {
    /**
     * sizeof(planish_trim_report) as the caller sees it.
     */
    size_t struct_size;
    /**
     * Largest distance at a vertex.
     */
    double max_vertex_distance;
    /**
     * Root mean square of the distances at vertices.
     */
    double rms_vertex_distance;
    /**
     * Largest distance between vertices, measured at seven places of each side.
     */
    double max_distance_between;
    /**
     * Root mean square of the distances between vertices.
     */
    double rms_distance_between;
    /**
     * The parameter of the place on its curve that the trims are farthest from.
     */
    double worst_parameter;
    /**
     * The tolerance, which is no less than what rounding leaves.
     */
    double tolerance;
    /**
     * What a relative tolerance is measured in.
     */
    double diagonal;
    /**
     * Wall time in seconds.
     */
    double seconds;
    /**
     * The curve of that place.
     */
    size_t worst_curve;
    /**
     * Vertices of the new trims.
     */
    size_t vertex_count;
    /**
     * Of these those whose places are not proved to be nearest to the curve.
     */
    size_t unproven_count;
} planish_trim_report;

/**
 * A Bezier patch: the polynomial or rational piece of a surface over a rectangle of parameters. Set struct_size
 * to sizeof(planish_patch) before the call; filled as far as that goes, on success only.
 */
typedef struct planish_patch {
    /**
     * sizeof(planish_patch) as the caller sees it.
     */
    size_t struct_size;
    /**
     * Least u of the rectangle.
     */
    double u_min;
    /**
     * Largest u of the rectangle.
     */
    double u_max;
    /**
     * Least v of the rectangle.
     */
    double v_min;
    /**
     * Largest v of the rectangle.
     */
    double v_max;
    /**
     * Number of ordinates: (degree_u + 1) * (degree_v + 1).
     */
    size_t ordinate_count;
    /**
     * Numbers of an ordinate: dim, or dim + 1 if the patch is rational.
     */
    size_t ordinate_width;
    /**
     * Degree along u.
     */
    uint32_t degree_u;
    /**
     * Degree along v.
     */
    uint32_t degree_v;
    /**
     * 1 if the last number of each ordinate is a weight, and the others are multiplied by it; else 0.
     */
    uint32_t is_rational;
    /**
     * 0.
     */
    uint32_t reserved;
} planish_patch;

/**
 * How a surface is converted. Fill with planish_convert_options_init(), then change what you need.
 */
typedef struct planish_convert_options {
    /**
     * Set by planish_convert_options_init().
     */
    size_t struct_size;
    /**
     * Most control points of the result; with more the call fails. Default 4000000.
     */
    size_t max_coefficients;
    /**
     * Hears of the progress and may cancel; NULL (default) for nobody.
     */
    planish_progress progress;
    /**
     * Handed to progress as it is.
     */
    void *user;
    /**
     * Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
     */
    const volatile int32_t *cancel;
    /**
     * Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
     * Array: [1].
     */
    uint32_t *out_stage;
} planish_convert_options;

/**
 * Options of tensor fits. Fill with planish_tensor_options_init(), then change what you need.
 *
 * A datum is a node of the mesh, or a point.
 */
typedef struct planish_tensor_options {
    /**
     * Set by planish_tensor_options_init().
     */
    size_t struct_size;
    /**
     * The largest error allowed at the data, positive, measured in tolerance_scale. Default 1e-3.
     */
    double tolerance;
    /**
     * Weight of the bending energy; 0 (default) finds one: of uniform knots the largest of 1e-3, 1e-4, 1e-5,
     * 1e-6 that meets the tolerance (for PLANISH_TENSOR_METHOD_FERGUSON 1e-3), of adaptive knots 1e-11 or
     * less, the weight of a thin plate over the unit square against the mean square error; where the
     * tolerance is out of reach, adaptive knots take the one of least generalized cross-validation.
     */
    double smoothing;
    /**
     * How far the knots reach beyond the data, as a fraction of the data's range, 0 to 10. Default 0.1.
     * Adaptive knots reach less far where the surface would leave the box of its data.
     */
    double buffer;
    /**
     * How a mesh without parameters gets them; NULL (default) for the defaults. Of this record progress, user
     * and thread_count are not looked at, and node_weights must be NULL. Not used for points.
     */
    const struct planish_parameterize_options *parameterize;
    /**
     * A positive weight for each datum; NULL (default) for all 1.
     * Array: [data].
     */
    const double *weights;
    /**
     * Hears of the progress and may cancel; NULL (default) for nobody.
     */
    planish_progress progress;
    /**
     * Handed to progress as it is.
     */
    void *user;
    /**
     * Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
     */
    const volatile int32_t *cancel;
    /**
     * Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
     * Array: [1].
     */
    uint32_t *out_stage;
    /**
     * Receives the (u,v) at which the error of each datum is measured: two numbers for each datum, or NULL
     * (default). Written on success only.
     * Array: [data, 2].
     */
    double *out_parameters;
    /**
     * Receives the error of each datum in model units: one number for each datum, or NULL (default). Written
     * on success only.
     * Array: [data].
     */
    double *out_errors;
    /**
     * Most unknowns of one grid, at least 4. Default 66049.
     */
    size_t max_coefficients;
    /**
     * A planish_tolerance_scale. Default PLANISH_TOLERANCE_SCALE_RELATIVE.
     */
    uint32_t tolerance_scale;
    /**
     * A planish_tensor_method. Default PLANISH_TENSOR_METHOD_LEAST_SQUARES.
     */
    uint32_t method;
    /**
     * A planish_ends, of uniform knots. Default PLANISH_ENDS_NATURAL.
     */
    uint32_t ends;
    /**
     * A planish_energy, of uniform knots. Default PLANISH_ENERGY_BEAM.
     */
    uint32_t energy;
    /**
     * A planish_regularize. Default PLANISH_REGULARIZE_AUTO.
     */
    uint32_t regularize;
    /**
     * Most knots along one direction, at least 2. Default 257.
     */
    uint32_t max_grid;
    /**
     * Knots along u to use without refinement, 2 to 8193; 0 (default, then grid_v too) refines.
     */
    uint32_t grid_u;
    /**
     * Knots along v to use without refinement, 2 to 8193; 0 (default, then grid_u too) refines.
     */
    uint32_t grid_v;
    /**
     * Sweeps of parameter correction on each grid: data move to their foot points, then the fit is repeated.
     * Default 0.
     */
    uint32_t correction_sweeps;
    /**
     * 1 measures the closest-point distance of the nodes for the report. Default 0.
     */
    uint32_t measure_distance;
    /**
     * Threads to use, at most 1024; 0 (default) for all cores. Results do not depend on it.
     */
    uint32_t thread_count;
    /**
     * A planish_knots. Default PLANISH_KNOTS_ADAPTIVE. Knots given by grid_u and grid_v, and those of
     * PLANISH_TENSOR_METHOD_FERGUSON, are uniform always.
     */
    uint32_t knots;
    /**
     * A planish_missing: what values of points and fields mean that are NaN. Default PLANISH_MISSING_REFUSED. Not
     * used for the shape of a mesh.
     */
    uint32_t missing;
    /**
     * A planish_symmetry, for the shape of a mesh over adaptive knots. Default PLANISH_SYMMETRY_NONE.
     */
    uint32_t symmetry;
    /**
     * A tolerance for each datum in tolerance_scale, positive, in place of tolerance; infinity leaves the datum
     * out: it is not fitted, and its error does not count. NULL (default): tolerance for all.
     * Array: [data].
     */
    const double *tolerances;
    /**
     * Numbers of data that the surface passes through, to 1e-12 of the diagonal of the data's box, by linear
     * conditions on its coefficients. Default NULL.
     * Array: [fixed_count].
     */
    const uint32_t *fixed;
    /**
     * Receives 1 for each datum that was taken for a gross error and left out, else 0; NULL (default) for no such
     * list. Written on success only.
     * Array: [data].
     */
    uint8_t *out_left_out;
    /**
     * The largest share of the data that may be gross errors, at most 0.25: those that stand out most from their
     * neighbours are left out of the fit. 0 (default) for none.
     */
    double outlier_share;
    /**
     * A gross error misses the surface of the other data by more than this, in tolerance_scale: such data are
     * left out. 0 (default) for none; not together with outlier_share.
     */
    double outlier_scale;
    /**
     * Numbers in fixed. Default 0.
     */
    size_t fixed_count;
    /**
     * A place in the plane of symmetry and a normal of it, for PLANISH_SYMMETRY_ABOUT; else NULL (default).
     * Array: [6].
     */
    const double *plane;
    /**
     * Receives a place in the plane of symmetry and its unit normal, if symmetry was asked for; NULL (default) for
     * nobody. Written on success only.
     * Array: [6].
     */
    double *out_plane;
    /**
     * The curve that the side at the least u is, exactly; NULL (default) for a free side. Clamped, of degree 3 at most,
     * without knots of more than one inside. With sides that are given the surface has their lines among its own, free
     * ends and no buffer.
     */
    const struct planish_curve *curve_u_low;
    /**
     * The curve that the side at the largest u is, exactly; NULL (default) for a free side. As curve_u_low.
     */
    const struct planish_curve *curve_u_high;
    /**
     * The curve that the side at the least v is, exactly; NULL (default) for a free side. As curve_u_low.
     */
    const struct planish_curve *curve_v_low;
    /**
     * The curve that the side at the largest v is, exactly; NULL (default) for a free side. As curve_u_low.
     */
    const struct planish_curve *curve_v_high;
    /**
     * The tensor surface beyond the side at the least u; NULL (default) for none. Bicubic, clamped, without weights:
     * the side takes over its side that lies nearest to the data, and its tangent planes there.
     */
    const struct planish_surface *neighbour_u_low;
    /**
     * The tensor surface beyond the side at the largest u; NULL (default) for none. As neighbour_u_low.
     */
    const struct planish_surface *neighbour_u_high;
    /**
     * The tensor surface beyond the side at the least v; NULL (default) for none. As neighbour_u_low.
     */
    const struct planish_surface *neighbour_v_low;
    /**
     * The tensor surface beyond the side at the largest v; NULL (default) for none. As neighbour_u_low.
     */
    const struct planish_surface *neighbour_v_high;
    /**
     * The period of a surface that closes along u: after so much of it the surface goes on as it began, with slope and
     * curvature. For points; at least the range of their u. 0 (default) for an open surface. Ends are free, and there is
     * no buffer.
     */
    double period_u;
    /**
     * The same along v. Default 0.
     */
    double period_v;
} planish_tensor_options;

/**
 * What a fit did and how good it is. Set struct_size to sizeof(planish_fit_report) before the call; the
 * report is filled as far as that goes, on success only. Errors and lengths are in model units (for a field,
 * in units of its values) and measured on the finished surface.
 */
typedef struct planish_fit_report {
    /**
     * sizeof(planish_fit_report) as the caller sees it.
     */
    size_t struct_size;
    /**
     * Largest distance between a datum and the surface at the datum's (u,v): what the tolerance bounds.
     */
    double max_error;
    /**
     * Square root of the mean of its square.
     */
    double rms_error;
    /**
     * Its mean.
     */
    double mean_error;
    /**
     * The tolerance that was kept or missed.
     */
    double tolerance;
    /**
     * Diagonal of the data's bounding box: an error divided by it is relative.
     */
    double diagonal;
    /**
     * Largest distance from a triangle's centroid or an edge's middle to the surface's tangent plane at the
     * mean of the nodes' (u,v) (for a field: to its value there); 0 for data without triangles.
     */
    double max_interior_error;
    /**
     * The part of max_interior_error that flat facets on a curved shape explain: max_interior_error - facet_sagitta is
     * the largest distance beyond what its own facet explains, and PLANISH_REMARK_ROUGH_BETWEEN_NODES tells where that
     * is above the tolerance. Facets at an edge across which normals turn by more than 30 degrees explain nothing: they
     * are the shape.
     */
    double facet_sagitta;
    /**
     * Largest closest-point distance from a node to the surface; NaN unless measure_distance asked for it.
     */
    double max_distance;
    /**
     * Weight of the smoothing energy in the surface returned.
     */
    double smoothing;
    /**
     * L2 stretch of the map: 1 is an isometry; 0 for data without triangles.
     */
    double stretch;
    /**
     * Wall time spent on the map, in seconds.
     */
    double parameterize_seconds;
    /**
     * Wall time in all, in seconds.
     */
    double seconds;
    /**
     * The datum with the largest error, counted from 0.
     */
    size_t worst_index;
    /**
     * Different knots along u.
     */
    size_t grid_u;
    /**
     * Different knots along v.
     */
    size_t grid_v;
    /**
     * Unknowns of the fit. The surface may have more control points, which these determine.
     */
    size_t coefficient_count;
    /**
     * Cells without data inside the trims.
     */
    size_t empty_cell_count;
    /**
     * Triangles that are turned over or flat in the parameter plane.
     */
    size_t flipped_count;
    /**
     * Everything worth knowing: bits of planish_remark.
     */
    uint64_t remarks;
    /**
     * Rounds of fitting and measuring.
     */
    uint32_t pass_count;
    /**
     * Why the fit ended: a planish_stop_reason.
     */
    uint32_t stop_reason;
    /**
     * Cells of an adaptive mesh; 0 for a grid.
     */
    size_t cell_count;
    /**
     * Cells of it in which an error exceeds the tolerance.
     */
    size_t rough_cell_count;
    /**
     * The deepest level of its cells: how often one of the first was halved.
     */
    uint32_t deepest_level;
    /**
     * 0.
     */
    uint32_t reserved;
    /**
     * Largest error of a fixed datum; 0 without any.
     */
    double max_fixed_error;
    /**
     * Largest error of the other data as a share of the tolerance of its own: at most 1 where all are met.
     */
    double max_tolerance_share;
    /**
     * Data that were taken for gross errors and left out.
     */
    size_t left_out_count;
    /**
     * Largest distance of the mirror image of a node to the mesh, if symmetry was asked for; else 0.
     */
    double mirror_distance;
    /**
     * Largest distance of the surface to the curves of sides that were given; 0 without any.
     */
    double max_side_error;
    /**
     * Largest angle between the tangent planes of the surface and those of its neighbours along such sides, in
     * radians.
     */
    double max_side_angle;
    /**
     * Unknowns before cells were merged again, as coarsening asks; that of coefficient_count where none were, 0 for a
     * fit without cells.
     */
    size_t refined_coefficient_count;
} planish_fit_report;

/**
 * How fields are fitted. Fill with planish_field_options_init(), then change what you need. All pointers are borrowed
 * for the call.
 */
typedef struct planish_field_options {
    /**
     * Set by planish_field_options_init().
     */
    size_t struct_size;
    /**
     * What reports compare the errors with, positive, measured in tolerance_scale. Default 1e-3.
     */
    double tolerance;
    /**
     * Weight of the bending energy, positive. Default 1e-6. Where sample_values choose the grid they choose it too.
     */
    double smoothing;
    /**
     * How far the knots reach beyond the nodes, as a fraction of their range, 0 to 10. Default 0.1.
     */
    double buffer;
    /**
     * How a mesh without parameters gets them; NULL (default) for the defaults. Not used for points.
     */
    const struct planish_parameterize_options *parameterize;
    /**
     * A positive weight for each node; NULL (default) for all 1.
     * Array: [nodes].
     */
    const double *weights;
    /**
     * For each node 1 if fields have values there, 0 if not: those values are never looked at and may be NaN. NULL
     * (default) for values at all nodes.
     * Array: [nodes].
     */
    const uint8_t *mask;
    /**
     * A field for which grid and smoothing are found that meet the tolerance: sample_dim numbers for each node; NULL
     * (default) for none. grid_u and grid_v must then be 0.
     * Array: [nodes, sample_dim].
     */
    const double *sample_values;
    /**
     * Numbers of a value of sample_values.
     */
    size_t sample_dim;
    /**
     * Hears of the progress of making the fitter and may cancel; NULL (default) for nobody.
     */
    planish_progress progress;
    /**
     * Handed to progress as it is.
     */
    void *user;
    /**
     * Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
     */
    const volatile int32_t *cancel;
    /**
     * Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
     * Array: [1].
     */
    uint32_t *out_stage;
    /**
     * A planish_tolerance_scale. Default PLANISH_TOLERANCE_SCALE_RELATIVE.
     */
    uint32_t tolerance_scale;
    /**
     * A planish_ends. Default PLANISH_ENDS_NATURAL.
     */
    uint32_t ends;
    /**
     * A planish_energy. Default PLANISH_ENERGY_BEAM.
     */
    uint32_t energy;
    /**
     * Knots along u, 2 to 8193; 0 (default, then grid_v too) for as many as the nodes bear, at most 129.
     */
    uint32_t grid_u;
    /**
     * Knots along v, 2 to 8193; 0 (default, then grid_u too) for as many as the nodes bear, at most 129.
     */
    uint32_t grid_v;
    /**
     * Threads to keep, at most 1024; 0 (default) for all cores. Results do not depend on it.
     */
    uint32_t thread_count;
    /**
     * A planish_missing: whether values of fields that are NaN are refused or missing. A field that lacks other values
     * than the one before costs a factorization. Not for fields over models. Default PLANISH_MISSING_REFUSED.
     */
    uint32_t missing;
    /**
     * 0.
     */
    uint32_t reserved;
} planish_field_options;

/**
 * How gradients are computed. Fill with planish_gradient_options_init(), then change what you need.
 */
typedef struct planish_gradient_options {
    /**
     * Set by planish_gradient_options_init().
     */
    size_t struct_size;
    /**
     * Doubles from one point to the next in `uv`; at least 2, or 0 (default) for 2.
     */
    size_t uv_stride;
    /**
     * Threads to use, at most 1024; 0 (default) for all cores. Results do not depend on it.
     */
    uint32_t thread_count;
    /**
     * 0.
     */
    uint32_t reserved;
} planish_gradient_options;

/**
 * How patches become one smooth model. Fill with planish_smooth_options_init(), then change what you need.
 */
typedef struct planish_smooth_options {
    /**
     * Set by planish_smooth_options_init().
     */
    size_t struct_size;
    /**
     * Hears of the progress and may cancel; NULL (default) for nobody.
     */
    planish_progress progress;
    /**
     * Handed to progress as it is.
     */
    void *user;
    /**
     * Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
     */
    const volatile int32_t *cancel;
    /**
     * Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
     * Array: [1].
     */
    uint32_t *out_stage;
    /**
     * Largest deviation from the given surfaces allowed. Default 1e-3.
     */
    double tolerance;
    /**
     * Within what distance corners and sides of patches meet. Default 1e-3.
     */
    double join_tolerance;
    /**
     * Weight of the plate energy of each cell of a patch, mapped to the unit cell. Default 1e-6.
     */
    double smoothing;
    /**
     * Most cells of all patches of a piece. Default 200000.
     */
    size_t max_cells;
    /**
     * What both tolerances are measured in: a planish_tolerance_scale; PLANISH_TOLERANCE_SCALE_RELATIVE (default): the
     * diagonal of the box around all control points.
     */
    uint32_t tolerance_scale;
    /**
     * Most rounds of fitting and refining. Default 12.
     */
    uint32_t max_rounds;
    /**
     * By how much the levels of the cells in one face may differ. Default 1.
     */
    uint32_t level_spread;
    /**
     * Threads that share the work; 0 (default) for all cores. The result does not depend on it.
     */
    uint32_t thread_count;
} planish_smooth_options;

/**
 * What became of patches. Set struct_size to sizeof(planish_smooth_report) before the call; the report is filled as
 * far as that goes, on success only. Lengths are in model units.
 */
typedef struct planish_smooth_report {
    /**
     * sizeof(planish_smooth_report) as the caller sees it.
     */
    size_t struct_size;
    /**
     * Largest distance between places all over the given surfaces and the model.
     */
    double max_deviation;
    /**
     * Square root of the mean of its square.
     */
    double rms_deviation;
    /**
     * Its mean.
     */
    double mean_deviation;
    /**
     * The tolerance that was kept or missed.
     */
    double tolerance;
    /**
     * Diagonal of the box around all given control points.
     */
    double diagonal;
    /**
     * Largest distance between given sides that were joined.
     */
    double given_gap;
    /**
     * Largest difference of unit normals across given sides that were joined.
     */
    double given_normal_jump;
    /**
     * Largest distance between the two sides of an edge of the model.
     */
    double gap;
    /**
     * Largest difference of unit normals across edges of the model.
     */
    double normal_jump;
    /**
     * Volume that closed pieces enclose.
     */
    double volume;
    /**
     * Seconds in all.
     */
    double seconds;
    /**
     * The given patch that deviates most.
     */
    size_t worst_patch;
    /**
     * Sides that were joined, counted once for both.
     */
    size_t joined_count;
    /**
     * Sides that stayed free.
     */
    size_t free_count;
    /**
     * Pieces: shells of the model.
     */
    size_t piece_count;
    /**
     * Control points, four a vertex of the cells of each patch.
     */
    size_t coefficient_count;
    /**
     * Cells of all patches.
     */
    size_t cell_count;
    /**
     * Everything worth knowing: bits of planish_remark.
     */
    uint64_t remarks;
    /**
     * Rounds of fitting and measuring of the piece that took most.
     */
    uint32_t pass_count;
    /**
     * A planish_stop_reason, why the fit ended.
     */
    uint32_t stop_reason;
} planish_smooth_report;

/**
 * How values are carried. Fill with planish_transfer_options_init(), then change what you need.
 */
typedef struct planish_transfer_options {
    /**
     * Set by planish_transfer_options_init().
     */
    size_t struct_size;
    /**
     * How fields on the source are fitted: the grid (given, found for a sample field, or chosen from the number of
     * nodes, about four of them a coefficient), mask, weights; also threads and progress of the transfer. NULL
     * (default) for the defaults. Borrowed for the call.
     */
    const struct planish_field_options *field;
    /**
     * How far from the source's surface a target may lie, measured in distance_scale, not negative; infinity for
     * anywhere. Default 0.05.
     */
    double max_distance;
    /**
     * A planish_tolerance_scale: of the diagonal of the source's points, or model units. Default
     * PLANISH_TOLERANCE_SCALE_RELATIVE.
     */
    uint32_t distance_scale;
    /**
     * A planish_far_rule. Default PLANISH_FAR_RULE_REFUSE.
     */
    uint32_t far_rule;
} planish_transfer_options;

/**
 * How well source and targets lie on one another. Set struct_size to sizeof(planish_transfer_report) before the
 * call; the report is filled as far as that goes, on success only. Lengths are in model units.
 */
typedef struct planish_transfer_report {
    /**
     * sizeof(planish_transfer_report) as the caller sees it.
     */
    size_t struct_size;
    /**
     * The largest distance of a target to the source's surface.
     */
    double max_distance;
    /**
     * Square root of the mean of its square.
     */
    double rms_distance;
    /**
     * The distance that was allowed.
     */
    double limit;
    /**
     * The largest distance between a node of the source and its surface at the node's (u,v).
     */
    double max_shape_error;
    /**
     * Square root of the mean of its square.
     */
    double rms_shape_error;
    /**
     * Wall time in all, in seconds.
     */
    double seconds;
    /**
     * The target with the largest distance, counted from 0.
     */
    size_t farthest_index;
    /**
     * Targets beyond the limit.
     */
    size_t far_count;
    /**
     * Knots of the grid along u.
     */
    size_t grid_u;
    /**
     * Knots of the grid along v.
     */
    size_t grid_v;
    /**
     * Unknowns of a fit on the grid.
     */
    size_t coefficient_count;
    /**
     * Everything worth knowing of the source's surface: bits of planish_remark.
     */
    uint64_t remarks;
} planish_transfer_report;

/**
 * What a transfer keeps of forces, moments and work. Set struct_size to sizeof(planish_balance_report) before the
 * call; the report is filled as far as that goes, on success only.
 */
typedef struct planish_balance_report {
    /**
     * sizeof(planish_balance_report) as the caller sees it.
     */
    size_t struct_size;
    /**
     * Sum of the forces on the targets.
     */
    double force_given[3];
    /**
     * Sum of the forces that arrive at the nodes of the source.
     */
    double force_arrived[3];
    /**
     * Length of the difference, as a fraction of the sum of the lengths of the forces given: roundoff.
     */
    double force_error;
    /**
     * Moment of the forces on the targets.
     */
    double moment_given[3];
    /**
     * Moment of the forces that arrive.
     */
    double moment_arrived[3];
    /**
     * Length of the difference.
     */
    double moment_error;
    /**
     * What moment_error cannot exceed but by roundoff: the sum over the targets of the force's length times the
     * distance to the source's surface.
     */
    double moment_bound;
    /**
     * Work of the forces given along the displacements that arrive at the targets.
     */
    double work_given;
    /**
     * Work of the forces that arrive along the displacements given.
     */
    double work_arrived;
    /**
     * The difference, as a fraction of the sum of the targets' works without their signs: roundoff.
     */
    double work_error;
} planish_balance_report;

/**
 * How good a tessellation is. Set struct_size to sizeof(planish_tessellate_report) before the call; filled as far
 * as that goes.
 */
typedef struct planish_tessellate_report {
    /**
     * sizeof(planish_tessellate_report) as the caller sees it.
     */
    size_t struct_size;
    /**
     * Smallest angle of a triangle in space, in radians.
     */
    double smallest_angle;
    /**
     * Largest distance measured between the middle of an edge and the surface, in model units.
     */
    double chord_error;
} planish_tessellate_report;

/**
 * How fine a tessellation is. Fill with planish_tessellate_options_init(), then change what you need.
 */
typedef struct planish_tessellate_options {
    /**
     * Set by planish_tessellate_options_init().
     */
    size_t struct_size;
    /**
     * Largest distance between the surface and the middles of the edges, in model units, positive; 0 (default)
     * takes 1e-3 of the surface's diagonal.
     */
    double chord_tolerance;
    /**
     * Longest edge in model units, positive; 0 (default) for no limit.
     */
    double max_edge_length;
    /**
     * Most nodes; with more the call fails. Default 4000000.
     */
    size_t max_point_count;
    /**
     * Hears of the progress and may cancel; NULL (default) for nobody.
     */
    planish_progress progress;
    /**
     * Handed to progress as it is.
     */
    void *user;
    /**
     * Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
     */
    const volatile int32_t *cancel;
    /**
     * Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
     * Array: [1].
     */
    uint32_t *out_stage;
    /**
     * 1 (default) keeps to the part inside the trims, 0 covers the whole domain.
     */
    uint32_t keep_trims;
    /**
     * Threads that share the faces of a model, at most 1024; 0 (default) for all cores. A surface takes one. The
     * result does not depend on it.
     */
    uint32_t thread_count;
    /**
     * Receives how good the mesh is, or NULL (default). Set its struct_size before. Filled on success only; not
     * looked at where the options are part of others.
     */
    struct planish_tessellate_report *out_report;
} planish_tessellate_options;

/**
 * How points are projected. Fill with planish_project_options_init(), then change what you need.
 */
typedef struct planish_project_options {
    /**
     * Set by planish_project_options_init().
     */
    size_t struct_size;
    /**
     * A row u, v near the answer for each point, or NULL (default). It saves time and may choose between
     * equally near places; the answer is the nearest place all the same. Borrowed.
     * Array: [points, 2].
     */
    const double *guesses;
    /**
     * Points farther from the surface than this get NaN, and the call returns
     * PLANISH_STATUS_POINTS_OUTSIDE. Not negative. Default infinity.
     */
    double max_distance;
    /**
     * Hears of the progress and may cancel; NULL (default) for nobody.
     */
    planish_progress progress;
    /**
     * Handed to progress as it is.
     */
    void *user;
    /**
     * Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
     */
    const volatile int32_t *cancel;
    /**
     * Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
     * Array: [1].
     */
    uint32_t *out_stage;
    /**
     * 1 (default) looks for the nearest place inside the trims, 0 in the whole domain.
     */
    uint32_t keep_trims;
    /**
     * Threads to use, at most 1024; 0 (default) for all cores. Results do not depend on it.
     */
    uint32_t thread_count;
    /**
     * Receives the planish_flag bits of each point, of which PLANISH_FLAG_NOT_PROVEN occurs here, or NULL
     * (default).
     * Array: [points].
     */
    uint8_t *out_flags;
} planish_project_options;

/**
 * How a surface is compared with a mesh. Fill with planish_deviation_options_init(), then change what you
 * need.
 */
typedef struct planish_deviation_options {
    /**
     * Set by planish_deviation_options_init().
     */
    size_t struct_size;
    /**
     * Chord tolerance of the tessellation that is measured back from, in model units; 0 (default) takes 1e-3
     * of the surface's diagonal.
     */
    double chord_tolerance;
    /**
     * Longest edge of that tessellation in model units; 0 (default) takes 1e-2 of the mesh's diagonal,
     * and at least 2e-3 of the surface's.
     * Smaller holes may be missed.
     */
    double max_edge_length;
    /**
     * Hears of the progress and may cancel; NULL (default) for nobody.
     */
    planish_progress progress;
    /**
     * Handed to progress as it is.
     */
    void *user;
    /**
     * Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
     */
    const volatile int32_t *cancel;
    /**
     * Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
     * Array: [1].
     */
    uint32_t *out_stage;
    /**
     * 1 (default): only the part of the surface inside its trims counts.
     */
    uint32_t keep_trims;
    /**
     * 1 (default): the mesh's parameters, if it has any, are where searches start. The distances are the
     * least ones all the same.
     */
    uint32_t use_parameters;
    /**
     * 1: measure from the surface to the mesh as well, which notices filled holes and surplus sheets.
     * Default 0.
     */
    uint32_t measure_back;
    /**
     * Threads to use, at most 1024; 0 (default) for all cores. Results do not depend on it.
     */
    uint32_t thread_count;
    /**
     * Receives the distances of the nodes with the sign of their side: positive on the side of the normal, which is
     * the outside of a solid; NaN for a node without triangles. NULL (default) for none. Written on success only.
     * Array: [mesh_point_count].
     */
    double *out_signed;
    /**
     * Receives the u, v nearest to each node; NaN for a node without triangles. NULL (default) for none. Written on
     * success only.
     * Array: [mesh_point_count, 2].
     */
    double *out_uv;
    /**
     * Receives the face of the model nearest to each node, PLANISH_NONE where there is none; NULL (default) for none,
     * and for a surface. Written on success only.
     * Array: [mesh_point_count].
     */
    uint32_t *out_faces;
} planish_deviation_options;

/**
 * Distances between a surface and a mesh, in model units. Set struct_size to
 * sizeof(planish_deviation_report) before the call; filled as far as that goes, on success only.
 */
typedef struct planish_deviation_report {
    /**
     * sizeof(planish_deviation_report) as the caller sees it.
     */
    size_t struct_size;
    /**
     * Largest distance from a node to its nearest place on the surface.
     */
    double max_distance;
    /**
     * Square root of the mean of its square.
     */
    double rms_distance;
    /**
     * Its mean.
     */
    double mean_distance;
    /**
     * Largest distance from a place on the surface to the mesh; NaN unless measure_back asked for it.
     */
    double max_back_distance;
    /**
     * u of that place; NaN unless asked for.
     */
    double worst_back_u;
    /**
     * v of that place; NaN unless asked for.
     */
    double worst_back_v;
    /**
     * The node farthest from the surface.
     */
    size_t worst_index;
    /**
     * Places on the surface that were measured back from.
     */
    size_t back_count;
    /**
     * Nodes whose distance is not proved to be the least one: planish_surface_project() says when.
     */
    size_t unproven_count;
    /**
     * What half of the distances do not exceed.
     */
    double median_distance;
    /**
     * What 95 of a hundred distances do not exceed.
     */
    double distance_95;
    /**
     * What 99 of a hundred distances do not exceed.
     */
    double distance_99;
} planish_deviation_report;

/**
 * What rows to take from a mesh. Fill with planish_sample_rows_options_init(), then change what you need.
 */
typedef struct planish_sample_rows_options {
    /**
     * Set by planish_sample_rows_options_init().
     */
    size_t struct_size;
    /**
     * About how far apart points are along a row, in model units; 0 (default) takes the mean length of edges.
     */
    double spacing;
    /**
     * The loop or node that the first row is nearest to. Default 0.
     */
    size_t begin_index;
    /**
     * The loop or node that the last row is nearest to. Default 1.
     */
    size_t end_index;
    /**
     * Hears of the progress and may cancel; NULL (default) for nobody.
     */
    planish_progress progress;
    /**
     * Handed to progress as it is.
     */
    void *user;
    /**
     * Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
     */
    const volatile int32_t *cancel;
    /**
     * Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
     * Array: [1].
     */
    uint32_t *out_stage;
    /**
     * A planish_row_source: what begin_index counts. Default PLANISH_ROW_SOURCE_LOOP.
     */
    uint32_t begin;
    /**
     * A planish_row_source: what end_index counts. Default PLANISH_ROW_SOURCE_LOOP.
     */
    uint32_t end;
} planish_sample_rows_options;

/**
 * How a surface is made fair. Fill with planish_fair_options_init(), then change what you need.
 */
typedef struct planish_fair_options {
    /**
     * Set by planish_fair_options_init().
     */
    size_t struct_size;
    /**
     * How far the surface may come to lie from itself, or from the data, positive, measured in tolerance_scale.
     * Default 1e-3.
     */
    double tolerance;
    /**
     * Hears of the progress and may cancel; NULL (default) for nobody.
     */
    planish_progress progress;
    /**
     * Handed to progress as it is.
     */
    void *user;
    /**
     * Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
     */
    const volatile int32_t *cancel;
    /**
     * Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
     * Array: [1].
     */
    uint32_t *out_stage;
    /**
     * A planish_tolerance_scale; relative is to the diagonal of the box of the control points, or of the data.
     * Default PLANISH_TOLERANCE_SCALE_RELATIVE.
     */
    uint32_t tolerance_scale;
    /**
     * A planish_fairness. Default PLANISH_FAIRNESS_THIN_PLATE.
     */
    uint32_t energy;
    /**
     * A planish_kept_border. Default PLANISH_KEPT_BORDER_NONE.
     */
    uint32_t border;
    /**
     * A planish_fair_limit, for data; without data the energy is lowered as far as the tolerance lets it. Default
     * PLANISH_FAIR_LIMIT_NOISE.
     */
    uint32_t limit;
} planish_fair_options;

/**
 * What fairing did. Set struct_size to sizeof(planish_fair_report) before the call; the report is filled as far as
 * that goes, on success only. Lengths are in model units.
 */
typedef struct planish_fair_report {
    /**
     * sizeof(planish_fair_report) as the caller sees it.
     */
    size_t struct_size;
    /**
     * Energy before: the integral over the surface, in its own parameters, which count as much as their lines are
     * long on the average.
     */
    double energy_before;
    /**
     * Energy after; never more.
     */
    double energy_after;
    /**
     * Largest distance to the reference at equal (u,v): of data an error, of the surface itself a proven bound.
     */
    double max_deviation;
    /**
     * Root mean square of the errors of the data; without data, of the bounds of the cells.
     */
    double rms_deviation;
    /**
     * No place of the surface moved by more.
     */
    double max_movement;
    /**
     * The tolerance.
     */
    double tolerance;
    /**
     * What a relative tolerance is measured in.
     */
    double diagonal;
    /**
     * The weight of the energy against the square of distances; 0 if nothing was gained.
     */
    double smoothing;
    /**
     * Wall time in seconds.
     */
    double seconds;
    /**
     * Systems solved.
     */
    size_t pass_count;
} planish_fair_report;

/**
 * What a VTK file shows. Fill with planish_vtk_options_init(), then change what you need.
 */
typedef struct planish_vtk_options {
    /**
     * Set by planish_vtk_options_init().
     */
    size_t struct_size;
    /**
     * A mesh to compare with, or NULL (default). Its triangles are then written instead of a tessellation,
     * each node moved to its nearest place on the surface, with the distance as point data "deviation".
     * Borrowed.
     */
    const struct planish_mesh *deviation_from;
    /**
     * How the surface is tessellated otherwise; NULL (default) for the defaults. Borrowed.
     */
    const struct planish_tessellate_options *tessellate;
    /**
     * Hears of the progress and may cancel; NULL (default) for nobody.
     */
    planish_progress progress;
    /**
     * Handed to progress as it is.
     */
    void *user;
    /**
     * Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
     */
    const volatile int32_t *cancel;
    /**
     * Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
     * Array: [1].
     */
    uint32_t *out_stage;
    /**
     * Threads to use, at most 1024; 0 (default) for all cores.
     */
    uint32_t thread_count;
    /**
     * A planish_vtk_content. Default PLANISH_VTK_CONTENT_TRIANGLES.
     */
    uint32_t content;
} planish_vtk_options;

/**
 * What was written to a STEP file.
 */
typedef struct planish_step_report {
    /**
     * sizeof(planish_step_report) as the caller sees it.
     */
    size_t struct_size;
    /**
     * Largest distance between an edge's curve in space and the image of its p-curve, measured on the curves
     * written, in model units.
     */
    double curve_deviation;
    /**
     * The uncertainty that the file states, in model units: 1e-7 of the diagonal, or more if the curves need it.
     */
    double uncertainty;
    /**
     * Diagonal of the box around the part of the surface inside the trims.
     */
    double diagonal;
    /**
     * Bounds of all faces, the outer ones included.
     */
    size_t loop_count;
    /**
     * Edges; one between two faces counts once.
     */
    size_t edge_count;
    /**
     * Faces.
     */
    size_t face_count;
    /**
     * Control points of the surfaces of all faces.
     */
    size_t pole_count;
} planish_step_report;

/**
 * What a STEP file says beside the shape. Fill with planish_step_options_init(), then change what you need.
 * Texts are UTF-8, end with a NUL and are borrowed.
 */
typedef struct planish_step_options {
    /**
     * Set by planish_step_options_init().
     */
    size_t struct_size;
    /**
     * Name of the product; NULL (default) for the surface's, or "surface" if it has none.
     */
    const char *product;
    /**
     * Who made it; NULL (default) for nobody.
     */
    const char *author;
    /**
     * For whom; NULL (default) for nobody.
     */
    const char *organization;
    /**
     * When, such as "2026-01-31T12:00:00"; NULL (default) for 1970-01-01T00:00:00, so that equal input gives
     * equal bytes.
     */
    const char *timestamp;
    /**
     * Receives what was written, or NULL (default). Set its struct_size before. Filled on success only.
     */
    struct planish_step_report *out_report;
    /**
     * Hears of the progress and may cancel; NULL (default) for nobody.
     */
    planish_progress progress;
    /**
     * Handed to progress as it is.
     */
    void *user;
    /**
     * Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
     */
    const volatile int32_t *cancel;
    /**
     * Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
     * Array: [1].
     */
    uint32_t *out_stage;
    /**
     * A planish_step_schema; PLANISH_STEP_SCHEMA_AP214 (default).
     */
    uint32_t schema;
    /**
     * A planish_unit, what one model unit is; PLANISH_UNIT_MILLIMETRE (default) leaves it to the surface.
     */
    uint32_t unit;
    /**
     * Most control points of PLANISH_STEP_FORM_TENSOR. Default 4000000.
     */
    size_t max_coefficients;
    /**
     * A planish_step_form, what is written of a T-spline or PHT-spline; PLANISH_STEP_FORM_TENSOR (default), which
     * is also taken where the form is of another family.
     */
    uint32_t form;
    /**
     * By how much the levels of cells in one face of PLANISH_STEP_FORM_PATCHES may differ. Default 1; more gives
     * fewer faces with more control points.
     */
    uint32_t level_spread;
    /**
     * A D1RC-spline is written as a tensor surface fitted within this, in model units, at the nodes of a fine
     * tessellation; 0 (default) takes 1e-3 of the diagonal.
     */
    double tolerance;
    /**
     * Threads to use, at most 1024; 0 (default) for all cores. Results do not depend on it.
     */
    uint32_t thread_count;
    /**
     * 0.
     */
    uint32_t reserved;
} planish_step_options;

/**
 * What a report says beside what it measures. Fill with planish_report_options_init(), then change what you need.
 * Texts are UTF-8, end with a NUL and are borrowed.
 */
typedef struct planish_report_options {
    /**
     * Set by planish_report_options_init().
     */
    size_t struct_size;
    /**
     * The headline; NULL (default) for "Deviation".
     */
    const char *title;
    /**
     * What one unit of length is called; NULL (default) for "mm".
     */
    const char *unit;
    /**
     * The largest distance allowed, where the colours end, measured in tolerance_scale; 0 (default) takes the
     * largest distance found.
     */
    double tolerance;
    /**
     * Hears of the progress and may cancel; NULL (default) for nobody.
     */
    planish_progress progress;
    /**
     * Handed to progress as it is.
     */
    void *user;
    /**
     * Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
     */
    const volatile int32_t *cancel;
    /**
     * Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
     * Array: [1].
     */
    uint32_t *out_stage;
    /**
     * What the fit had to remark, explained on the page: bits of planish_remark. Default 0.
     */
    uint64_t remarks;
    /**
     * A planish_tolerance_scale; PLANISH_TOLERANCE_SCALE_RELATIVE (default): to the diagonal of the mesh's box.
     */
    uint32_t tolerance_scale;
    /**
     * Threads to use, at most 1024; 0 (default) for all cores. The page does not depend on it.
     */
    uint32_t thread_count;
} planish_report_options;

/**
 * What a face is. Set struct_size to sizeof(planish_face_info) before the call; filled on success only.
 */
typedef struct planish_face_info {
    /**
     * sizeof(planish_face_info) as the caller sees it.
     */
    size_t struct_size;
    /**
     * A point of the plane, or of the cylinder's axis; zeros for a spline.
     */
    double origin[3];
    /**
     * The normal of the plane, or the direction of the cylinder's axis, of length 1; zeros for a spline.
     */
    double axis[3];
    /**
     * The direction of u in the plane, or where the angle u is 0, of length 1; zeros for a spline.
     */
    double x_axis[3];
    /**
     * Radius of the cylinder; 0 for others.
     */
    double radius;
    /**
     * Loops, the outer one first.
     */
    size_t loop_count;
    /**
     * Edges of all loops.
     */
    size_t coedge_count;
    /**
     * A planish_carrier, what the face lies on.
     */
    uint32_t carrier;
    /**
     * What the maker of the model calls it, such as the label of the triangles it was made from.
     */
    uint32_t label;
    /**
     * The shell that it is in.
     */
    uint32_t shell;
    /**
     * 1 if its front is the side to which the normal of its surface points, else 0.
     */
    uint32_t is_forward;
    /**
     * The largest distance between a node of the fitted mesh on the face and the model; NaN without such nodes.
     */
    double max_error;
    /**
     * Square root of the mean of its square; NaN without such nodes.
     */
    double rms_error;
    /**
     * Nodes of the fitted mesh on the face; 0 for a model that no fit made.
     */
    size_t node_count;
} planish_face_info;

/**
 * What an edge is. Set struct_size to sizeof(planish_edge_info) before the call; filled on success only.
 */
typedef struct planish_edge_info {
    /**
     * sizeof(planish_edge_info) as the caller sees it.
     */
    size_t struct_size;
    /**
     * Largest angle between the normals of both faces along it, in radians; 0 for an edge of one face.
     */
    double angle;
    /**
     * Largest distance between its images on the surfaces of both faces; 0 for an edge of one face.
     */
    double gap;
    /**
     * The face whose loop runs along it; PLANISH_NONE if there is none.
     */
    uint32_t face_along;
    /**
     * The face whose loop runs against it; PLANISH_NONE if there is none.
     */
    uint32_t face_against;
    /**
     * The vertex where it begins.
     */
    uint32_t vertex_start;
    /**
     * The vertex where it ends.
     */
    uint32_t vertex_end;
    /**
     * 1 if its faces meet at an angle on purpose, else 0.
     */
    uint32_t is_sharp;
    /**
     * A planish_edge_shape, what its curve is.
     */
    uint32_t shape;
    /**
     * The middle of a circle or ellipse; zeros for others.
     */
    double origin[3];
    /**
     * The direction about which a circle or ellipse turns counter-clockwise, of length 1; zeros for others.
     */
    double axis[3];
    /**
     * The direction from the middle where the parameter, an angle in radians, is 0, of length 1; zeros for others.
     */
    double x_axis[3];
    /**
     * Half the width of a circle or ellipse along x_axis and across it; zeros for others.
     */
    double radii[2];
} planish_edge_info;

/**
 * What a shell is. Set struct_size to sizeof(planish_shell_info) before the call; filled on success only.
 */
typedef struct planish_shell_info {
    /**
     * sizeof(planish_shell_info) as the caller sees it.
     */
    size_t struct_size;
    /**
     * Faces.
     */
    size_t face_count;
    /**
     * A planish_shell_role.
     */
    uint32_t role;
    /**
     * The shell inside which it is a void; PLANISH_NONE if it is none.
     */
    uint32_t void_in;
} planish_shell_info;

/**
 * What a model measures. Set struct_size to sizeof(planish_measure_report) before the call.
 */
typedef struct planish_measure_report {
    /**
     * sizeof(planish_measure_report) as the caller sees it.
     */
    size_t struct_size;
    /**
     * Least x, y, z, from samples of every span.
     */
    double box_min[3];
    /**
     * Largest x, y, z, from samples of every span.
     */
    double box_max[3];
    /**
     * Area of all faces.
     */
    double area;
    /**
     * Volume of all solids, voids taken off; 0 for open shells.
     */
    double volume;
    /**
     * Largest distance between the images of an edge on the surfaces of both its faces.
     */
    double max_gap;
    /**
     * Largest angle between the normals on both sides of an edge that is not sharp, in radians.
     */
    double max_normal_jump;
    /**
     * Largest distance between an edge's curve in space and its images on the surfaces, and between its ends and
     * its vertices.
     */
    double curve_deviation;
    /**
     * Diagonal of the box around the model, from samples.
     */
    double diagonal;
    /**
     * Edges of one face.
     */
    size_t free_edge_count;
    /**
     * Edges that are sharp on purpose.
     */
    size_t sharp_edge_count;
    /**
     * Control points of the spline surfaces under all faces.
     */
    size_t pole_count;
    /**
     * Loops of all faces.
     */
    size_t loop_count;
    /**
     * Vertices - edges + the sum of 2 - loops over all faces: for each shell 2, less 2 for each handle and 1 for
     * each hole in it.
     */
    int64_t euler_characteristic;
} planish_measure_report;

/**
 * How a mesh becomes a model. Fill with planish_model_options_init(), then change what you need.
 */
typedef struct planish_model_options {
    /**
     * Set by planish_model_options_init().
     */
    size_t struct_size;
    /**
     * Hears of the progress and may cancel; NULL (default) for nobody.
     */
    planish_progress progress;
    /**
     * Handed to progress as it is.
     */
    void *user;
    /**
     * Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
     */
    const volatile int32_t *cancel;
    /**
     * Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
     * Array: [1].
     */
    uint32_t *out_stage;
    /**
     * Receives the face on which each node lies, PLANISH_NONE for a node without triangles; NULL (default) for
     * nobody.
     * Array: [mesh_point_count].
     */
    uint32_t *out_faces;
    /**
     * Receives (u,v) of each node on its face; NULL (default) for nobody.
     * Array: [mesh_point_count, 2].
     */
    double *out_uv;
    /**
     * Receives the error of each node, NaN for a node without triangles; NULL (default) for nobody.
     * Array: [mesh_point_count].
     */
    double *out_errors;
    /**
     * Largest error allowed at the nodes. Default 1e-3.
     */
    double tolerance;
    /**
     * Weight of the plate energy of each cell of a patch, mapped to the unit cell. Default 1e-4.
     */
    double smoothing;
    /**
     * Most cells of all patches of a component, beside those that patches need to meet. Default 200000.
     */
    size_t max_cells;
    /**
     * A cell with fewer samples is not split, as long as others help. Default 6.
     */
    size_t min_samples;
    /**
     * About how many patches a base complex has, or the regions between features that few do not fill; a base complex
     * takes 0.85 to 4 times as many where it would fold nodes, or where the fit folds or misses the tolerance by less
     * than twice and another number does better. Default 40.
     */
    size_t patches;
    /**
     * A planish_tolerance_scale; PLANISH_TOLERANCE_SCALE_RELATIVE (default): to the diagonal of the mesh's box.
     */
    uint32_t tolerance_scale;
    /**
     * A planish_model_family. Default PLANISH_MODEL_FAMILY_AUTO.
     */
    uint32_t family;
    /**
     * A planish_model_layout, for patches. Default PLANISH_MODEL_LAYOUT_AUTO.
     */
    uint32_t layout;
    /**
     * Level of the cells to start from, 1 to 8; 0 (default) takes 3 over a cube and 2 over a base complex.
     */
    uint32_t start_level;
    /**
     * Deepest level of a cell, at most 20. Default 12.
     */
    uint32_t max_level;
    /**
     * Levels by which neighbours in a patch may differ; 0 for any number. Default 1.
     */
    uint32_t grade;
    /**
     * Steps of the samples towards their foot points in each round. Default 1.
     */
    uint32_t foot_steps;
    /**
     * Whether cells with few samples are held to the mesh between them: 0 or 1 (default).
     */
    uint32_t guard;
    /**
     * Most rounds of fitting and refining. Default 20.
     */
    uint32_t max_rounds;
    /**
     * Most sweeps over all nodes while a base complex is laid. Default 300.
     */
    uint32_t sweeps;
    /**
     * By how much the levels of the cells in one face may differ. Default 1.
     */
    uint32_t level_spread;
    /**
     * Threads that share the work; 0 (default) for all cores. The result does not depend on it.
     */
    uint32_t thread_count;
    /**
     * Edges whose facets turn by more than this are sharp, in radians, at most pi; 0 looks for none. Default 0.7, which
     * is 40 degrees.
     */
    double sharp_angle;
    /**
     * A number for each triangle, such as the face of a CAD model that it comes from: edges between triangles of
     * different numbers are features unless label_angle says otherwise, and faces have the number as their label;
     * NULL (default) for none.
     * Array: [label_count].
     */
    const uint32_t *labels;
    /**
     * Numbers in labels: planish_mesh_triangle_count(), or 0 (default).
     */
    size_t label_count;
    /**
     * Whether a mesh of planes and cylinders becomes exact faces instead of patches or a chart, with
     * PLANISH_MODEL_FAMILY_AUTO: 0 or 1 (default).
     */
    uint32_t exact;
    /**
     * 1 ignores all features: smooth patches everywhere; 0 (default) does not. Each patch then has the label that most
     * of it comes from.
     */
    uint32_t smooth;
    /**
     * Two labels are one where the facets turn by no more than this along all edges between them, in radians, at most
     * pi: labels of one smooth skin become one region, with the label of its first triangle. Default 0: all edges
     * between labels are features.
     */
    double label_angle;
} planish_model_options;

/**
 * What a fit of a model did and how good it is, of all components together. Set struct_size to
 * sizeof(planish_model_report) before the call; the report is filled as far as that goes, on success only.
 * Errors and lengths are in model units and measured on the finished surfaces.
 */
typedef struct planish_model_report {
    /**
     * sizeof(planish_model_report) as the caller sees it.
     */
    size_t struct_size;
    /**
     * Largest distance between a node and the model at the node's place: what the tolerance bounds.
     */
    double max_error;
    /**
     * Square root of the mean of its square.
     */
    double rms_error;
    /**
     * Its mean.
     */
    double mean_error;
    /**
     * The tolerance that was kept or missed.
     */
    double tolerance;
    /**
     * Diagonal of the mesh's box: an error divided by it is relative.
     */
    double diagonal;
    /**
     * Largest distance of a centroid of a facet or a middle of an edge from the model.
     */
    double max_interior_error;
    /**
     * The part of that which flat facets on a curved shape explain: max_interior_error - facet_sagitta is the largest
     * distance beyond what its own facet explains.
     */
    double facet_sagitta;
    /**
     * Largest distance from places all over the model to the mesh; NaN for a chart.
     */
    double max_back_distance;
    /**
     * Largest difference of unit normals across edges of patches.
     */
    double normal_jump;
    /**
     * Largest distance between the two sides of an edge.
     */
    double gap;
    /**
     * Volume that the model encloses; NaN for an open one.
     */
    double volume;
    /**
     * Volume that the mesh encloses; NaN for an open one.
     */
    double mesh_volume;
    /**
     * Largest symmetric Dirichlet energy of a component's map, by area: 4 if all lengths are kept; NaN for a chart.
     */
    double map_energy;
    /**
     * Seconds for layouts and maps.
     */
    double map_seconds;
    /**
     * Seconds for fits.
     */
    double fit_seconds;
    /**
     * Seconds in all.
     */
    double seconds;
    /**
     * The node with the largest error.
     */
    size_t worst_node;
    /**
     * Components of the mesh: shells of the model.
     */
    size_t component_count;
    /**
     * Components that are voids in others.
     */
    size_t void_count;
    /**
     * Components that were inside out and have been turned.
     */
    size_t turned_count;
    /**
     * Handles of all components.
     */
    size_t genus;
    /**
     * Patches of all components; 0 for a chart or exact faces.
     */
    size_t patch_count;
    /**
     * Control points, four a vertex of the cells of each patch.
     */
    size_t coefficient_count;
    /**
     * Unknowns a coordinate that remain when patches meet smoothly.
     */
    size_t free_count;
    /**
     * Cells of all patches.
     */
    size_t cell_count;
    /**
     * Nodes or triangles that the maps fold.
     */
    size_t fold_count;
    /**
     * Samples left out because their facets are spread over too many patches.
     */
    size_t dropped_count;
    /**
     * Everything worth knowing: bits of planish_remark.
     */
    uint64_t remarks;
    /**
     * The deepest level of a cell.
     */
    uint32_t deepest_level;
    /**
     * Rounds of fitting and measuring of the component that took most.
     */
    uint32_t pass_count;
    /**
     * A planish_stop_reason, why the fit ended.
     */
    uint32_t stop_reason;
    /**
     * 1 for one chart, 0 for patches and exact faces.
     */
    uint32_t is_chart;
    /**
     * Pairs of triangles of the mesh that cross.
     */
    size_t mesh_crossing_count;
    /**
     * Pairs of triangles of the model that cross, triangulated as finely as the tolerance: walls that are thinner
     * than that, or folds. SIZE_MAX if the model could not be triangulated.
     */
    size_t crossing_count;
    /**
     * Faces on planes and cylinders.
     */
    size_t exact_face_count;
    /**
     * Components whose sharp edges were found and are rounded off, because what keeps them was no better or the cube was
     * asked for.
     */
    size_t rounded_count;
} planish_model_report;

/**
 * Options of curve fits. Fill with planish_curve_options_init(), then change what you need.
 */
typedef struct planish_curve_options {
    /**
     * Set by planish_curve_options_init().
     */
    size_t struct_size;
    /**
     * The largest error allowed at the data, positive, measured in tolerance_scale. Default 1e-3.
     */
    double tolerance;
    /**
     * Weight of the bending energy; 0 (default) takes the largest of 1e-3, 1e-4, 1e-5, 1e-6 that meets the
     * tolerance (for PLANISH_TENSOR_METHOD_FERGUSON 1e-3).
     */
    double smoothing;
    /**
     * How far the knots reach beyond the data, as a fraction of the data's range, 0 to 10. Default 0.1.
     */
    double buffer;
    /**
     * A positive weight for each datum; NULL (default) for all 1.
     * Array: [data].
     */
    const double *weights;
    /**
     * Hears of the progress and may cancel; NULL (default) for nobody.
     */
    planish_progress progress;
    /**
     * Handed to progress as it is.
     */
    void *user;
    /**
     * Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
     */
    const volatile int32_t *cancel;
    /**
     * Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
     * Array: [1].
     */
    uint32_t *out_stage;
    /**
     * Receives the error of each datum in model units: one number for each datum, or NULL (default). Written
     * on success only.
     * Array: [data].
     */
    double *out_errors;
    /**
     * A planish_tolerance_scale. Default PLANISH_TOLERANCE_SCALE_RELATIVE.
     */
    uint32_t tolerance_scale;
    /**
     * A planish_tensor_method. Default PLANISH_TENSOR_METHOD_LEAST_SQUARES.
     */
    uint32_t method;
    /**
     * A planish_ends. Default PLANISH_ENDS_NATURAL.
     */
    uint32_t ends;
    /**
     * Most knots, at least 2. Default 257.
     */
    uint32_t max_grid;
    /**
     * Knots to use without refinement, 2 to 8193; 0 (default) refines.
     */
    uint32_t grid;
    /**
     * Threads to use, at most 1024; 0 (default) for all cores. Results do not depend on it.
     */
    uint32_t thread_count;
} planish_curve_options;

/**
 * How points are interpolated. Fill with planish_interpolate_options_init(), then change what you need.
 */
typedef struct planish_interpolate_options {
    /**
     * Set by planish_interpolate_options_init().
     */
    size_t struct_size;
    /**
     * For PLANISH_SECTION_ENDS_SLOPES: 2 rows of dim numbers, the derivatives with respect to u at the first and at
     * the last point; otherwise NULL (default). Borrowed for the call.
     * Array: [2, dim].
     */
    const double *end_slopes;
    /**
     * A planish_section_ends. Default PLANISH_SECTION_ENDS_AUTO: periodic if the last point is the first one, else
     * parabolic.
     */
    uint32_t ends;
    /**
     * 0.
     */
    uint32_t reserved;
} planish_interpolate_options;

/**
 * What a skin did beside what every fit reports. Lengths are in model units.
 */
typedef struct planish_skin_report {
    /**
     * sizeof(planish_skin_report) as the caller sees it.
     */
    size_t struct_size;
    /**
     * By how much control curves may be larger than the rows, 1 at least. Equal steps give 3 at most; rows much
     * nearer to one another than to the next make it large.
     */
    double overshoot;
    /**
     * A bound of the distance between the surface and the skin through the section curves at any (u,v); NaN unless
     * certify asked for it, or if a section is no cubic.
     */
    double certified_distance;
    /**
     * The part of the error that fewer knots along v leave; 0 with a knot for each row.
     */
    double v_error;
    /**
     * The first row that looks reversed or shifted against the one before it, counted from 0; -1 if there is none.
     */
    int64_t twisted_row;
    /**
     * Control curves of the surface.
     */
    size_t curve_count;
    /**
     * Control points of the shortest control curve.
     */
    size_t least_count;
    /**
     * Control points of the longest control curve.
     */
    size_t largest_count;
    /**
     * Control points of the same surface as a tensor surface: what planish_surface_to_tensor() makes.
     */
    size_t tensor_count;
    /**
     * Control points of the same surface in strips: what PLANISH_STEP_FORM_STRIPS writes.
     */
    size_t strip_count;
    /**
     * Control points of the skin over common knots; 0 unless compare asked for it.
     */
    size_t common_count;
    /**
     * Knots that the removal pass took out.
     */
    size_t removed_knot_count;
    /**
     * Points that lay on the one before them.
     */
    size_t merged_point_count;
    /**
     * Rows that were turned round or given another first point.
     */
    size_t aligned_row_count;
} planish_skin_report;

/**
 * Options of skins. Fill with planish_skin_options_init(), then change what you need.
 */
typedef struct planish_skin_options {
    /**
     * Set by planish_skin_options_init().
     */
    size_t struct_size;
    /**
     * The largest error allowed at the points, positive, measured in tolerance_scale. Default 1e-3.
     */
    double tolerance;
    /**
     * For each row two vectors of dim numbers, the slopes at its begin and its end, derivatives with respect to
     * chord length (a unit tangent keeps the pace); NULL (default) unless ends is PLANISH_SECTION_ENDS_SLOPES. Not
     * used for curves.
     * Array: [rows, 2, dim].
     */
    const double *end_slopes;
    /**
     * For each point of the first row, or each different knot of the first curve, a vector of dim numbers: the
     * derivative across it with respect to length along v; NULL (default) for no curvature there.
     * Array: [*, dim].
     */
    const double *begin_tangents;
    /**
     * The same at the last row.
     * Array: [*, dim].
     */
    const double *end_tangents;
    /**
     * Hears of the progress and may cancel; NULL (default) for nobody.
     */
    planish_progress progress;
    /**
     * Handed to progress as it is.
     */
    void *user;
    /**
     * Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
     */
    const volatile int32_t *cancel;
    /**
     * Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
     * Array: [1].
     */
    uint32_t *out_stage;
    /**
     * Receives the (u,v) at which the error of each point is measured: two numbers for each point, or NULL
     * (default; for curves it must be). Written on success only.
     * Array: [data, 2].
     */
    double *out_parameters;
    /**
     * Receives the error of each point in model units, or NULL (default; for curves it must be). Written on success
     * only.
     * Array: [data].
     */
    double *out_errors;
    /**
     * Receives what only skins report, or NULL (default). Set its struct_size before. Filled on success only.
     */
    struct planish_skin_report *out_report;
    /**
     * Numbers of a point, at least 1. Default 3. Not used for curves.
     */
    size_t dim;
    /**
     * A planish_tolerance_scale. Default PLANISH_TOLERANCE_SCALE_RELATIVE.
     */
    uint32_t tolerance_scale;
    /**
     * A planish_skin_method. Default PLANISH_SKIN_METHOD_CONTROL_CURVES.
     */
    uint32_t method;
    /**
     * 1 if rows are closed: their first point is not repeated. Default 0.
     */
    uint32_t closed;
    /**
     * A planish_section_ends. Default PLANISH_SECTION_ENDS_AUTO. Not used for curves.
     */
    uint32_t ends;
    /**
     * 1 if the last row is followed by the first one; needs three rows, and no tangents. Default 0.
     */
    uint32_t closed_v;
    /**
     * A planish_v_rule. Default PLANISH_V_RULE_ENDPOINTS.
     */
    uint32_t v_rule;
    /**
     * 1 turns rows round, and moves the first point of closed ones, where that brings them nearer to the row
     * before. Default 0. Not used for curves.
     */
    uint32_t align;
    /**
     * 1 looks for fewer knots along v than rows. Default 0.
     */
    uint32_t approximate_v;
    /**
     * Places between two data at which a control curve is checked too, at most 100; 0 as in the paper. Default 3.
     */
    uint32_t extra_checks;
    /**
     * 1 inserts a knot into every span that needs one in each pass: faster, some more control points. Default 0.
     */
    uint32_t batch;
    /**
     * 1 takes knots out again that turn out not to be needed. Default 0.
     */
    uint32_t removal;
    /**
     * 1 bounds the distance from the skin through the section curves. Default 0.
     */
    uint32_t certify;
    /**
     * 1 counts the control points of PLANISH_SKIN_METHOD_COMMON_KNOTS for the report. Default 0.
     */
    uint32_t compare;
    /**
     * Threads to use, at most 1024; 0 (default) for all cores. Results do not depend on it.
     */
    uint32_t thread_count;
    /**
     * A planish_v_slopes. Default PLANISH_V_SLOPES_SMOOTH.
     */
    uint32_t v_slopes;
    /**
     * 0.
     */
    uint32_t reserved;
} planish_skin_options;

/**
 * Options of PHT fits. Fill with planish_pht_options_init(), then change what you need.
 *
 * A datum is a node of the mesh, or a point; a sample is a datum, or the middle of a triangle.
 */
typedef struct planish_pht_options {
    /**
     * Set by planish_pht_options_init().
     */
    size_t struct_size;
    /**
     * The largest error allowed at the data, positive, measured in tolerance_scale. Default 1e-3.
     */
    double tolerance;
    /**
     * Weight of the bending energy of each cell, mapped to the unit cell; lowered where cells cannot be split any
     * more. Default 1e-3.
     */
    double smoothing;
    /**
     * How a mesh without parameters gets them; NULL (default) for a circle, with one stretch step unless the
     * tolerance is fine and the plain map even. Of this record progress, user and thread_count are not looked at, and node_weights must be
     * NULL. Not used for points.
     */
    const struct planish_parameterize_options *parameterize;
    /**
     * A positive weight for each datum; NULL (default) for all 1.
     * Array: [data].
     */
    const double *weights;
    /**
     * Hears of the progress and may cancel; NULL (default) for nobody.
     */
    planish_progress progress;
    /**
     * Handed to progress as it is.
     */
    void *user;
    /**
     * Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
     */
    const volatile int32_t *cancel;
    /**
     * Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
     * Array: [1].
     */
    uint32_t *out_stage;
    /**
     * Receives the (u,v) at which the error of each datum is measured: two numbers for each datum, or NULL
     * (default). Written on success only.
     * Array: [data, 2].
     */
    double *out_parameters;
    /**
     * Receives the error of each datum in model units: one number for each datum, or NULL (default). Written
     * on success only.
     * Array: [data].
     */
    double *out_errors;
    /**
     * Most cells, at least the initial ones. Default 200000.
     */
    size_t max_cells;
    /**
     * A planish_tolerance_scale. Default PLANISH_TOLERANCE_SCALE_RELATIVE.
     */
    uint32_t tolerance_scale;
    /**
     * A planish_pht_estimator. Default PLANISH_PHT_ESTIMATOR_GLOBAL.
     */
    uint32_t estimator;
    /**
     * A planish_regularize. Default PLANISH_REGULARIZE_AUTO.
     */
    uint32_t regularize;
    /**
     * Cells along u to start from, 1 to 4095. Default 1.
     */
    uint32_t grid_u;
    /**
     * Cells along v to start from, 1 to 4095. Default 1.
     */
    uint32_t grid_v;
    /**
     * Deepest level of a cell, at most 20. Default 12.
     */
    uint32_t max_level;
    /**
     * A cell with fewer samples is not split, at least 1. Default 2.
     */
    uint32_t min_samples;
    /**
     * Levels by which cells that share an edge may differ; 0 for any number. Default 1.
     */
    uint32_t grade;
    /**
     * Sweeps of parameter correction in each round of the fit of a shape. Default 1.
     */
    uint32_t correction_sweeps;
    /**
     * 1 measures the closest-point distance of the nodes for the report. Default 0.
     */
    uint32_t measure_distance;
    /**
     * Threads to use, at most 1024; 0 (default) for all cores. Results do not depend on it.
     */
    uint32_t thread_count;
    /**
     * A planish_symmetry, for the shape of a mesh. Default PLANISH_SYMMETRY_NONE.
     */
    uint32_t symmetry;
    /**
     * A planish_missing: what values of points and fields mean that are NaN. Default PLANISH_MISSING_REFUSED. Not
     * used for the shape of a mesh.
     */
    uint32_t missing;
    /**
     * 0.
     */
    uint32_t reserved_end;
    /**
     * A tolerance for each datum in tolerance_scale, positive, in place of tolerance; infinity leaves the datum
     * out: it is not fitted, and its error does not count. NULL (default): tolerance for all.
     * Array: [data].
     */
    const double *tolerances;
    /**
     * Numbers of data that the surface passes through, to 1e-12 of the diagonal of the data's box, by linear
     * conditions on its coefficients. Default NULL.
     * Array: [fixed_count].
     */
    const uint32_t *fixed;
    /**
     * Receives 1 for each datum that was taken for a gross error and left out, else 0; NULL (default) for no such
     * list. Written on success only.
     * Array: [data].
     */
    uint8_t *out_left_out;
    /**
     * The largest share of the data that may be gross errors, at most 0.25: those that stand out most from their
     * neighbours are left out of the fit. 0 (default) for none.
     */
    double outlier_share;
    /**
     * A gross error misses the surface of the other data by more than this, in tolerance_scale: such data are
     * left out. 0 (default) for none; not together with outlier_share.
     */
    double outlier_scale;
    /**
     * Numbers in fixed. Default 0.
     */
    size_t fixed_count;
    /**
     * A place in the plane of symmetry and a normal of it, for PLANISH_SYMMETRY_ABOUT; else NULL (default).
     * Array: [6].
     */
    const double *plane;
    /**
     * Receives a place in the plane of symmetry and its unit normal, if symmetry was asked for; NULL (default) for
     * nobody. Written on success only.
     * Array: [6].
     */
    double *out_plane;
    /**
     * The curve that the side at the least u is, exactly; NULL (default) for a free side. Clamped, of degree 3 at most,
     * with continuous tangents. Its knots are lines of the first grid.
     */
    const struct planish_curve *curve_u_low;
    /**
     * The curve that the side at the largest u is, exactly; NULL (default) for a free side. As curve_u_low.
     */
    const struct planish_curve *curve_u_high;
    /**
     * The curve that the side at the least v is, exactly; NULL (default) for a free side. As curve_u_low.
     */
    const struct planish_curve *curve_v_low;
    /**
     * The curve that the side at the largest v is, exactly; NULL (default) for a free side. As curve_u_low.
     */
    const struct planish_curve *curve_v_high;
    /**
     * The tensor surface or PHT-spline beyond the side at the least u; NULL (default) for none. Bicubic,
     * clamped, without weights: the side takes over its side that lies nearest to the data, and its tangent planes.
     */
    const struct planish_surface *neighbour_u_low;
    /**
     * The tensor surface or PHT-spline beyond the side at the largest u; NULL (default) for none. As neighbour_u_low.
     */
    const struct planish_surface *neighbour_u_high;
    /**
     * The tensor surface or PHT-spline beyond the side at the least v; NULL (default) for none. As neighbour_u_low.
     */
    const struct planish_surface *neighbour_v_low;
    /**
     * The tensor surface or PHT-spline beyond the side at the largest v; NULL (default) for none. As neighbour_u_low.
     */
    const struct planish_surface *neighbour_v_high;
    /**
     * Continuous derivatives of the surface: 1 (default), or 2. With 2 it is a truncated hierarchical B-spline, with
     * fewest coefficients; estimator must be PLANISH_PHT_ESTIMATOR_GLOBAL, symmetry PLANISH_SYMMETRY_NONE and all sides
     * free, grade is not looked at, several initial grids are tried unless grid_u or grid_v is given, smoothing weighs one plate
     * over the whole surface, 1e-8 of it against the mean square error, and parameters are corrected by a fit with
     * one continuous derivative that comes first.
     */
    uint32_t continuity;
    /**
     * A planish_coarsening. Default PLANISH_COARSENING_AUTO.
     */
    uint32_t coarsening;
} planish_pht_options;

/**
 * How a PHT-spline is simplified. Fill with planish_pht_simplify_options_init(), then change what you need.
 */
typedef struct planish_pht_simplify_options {
    /**
     * Set by planish_pht_simplify_options_init().
     */
    size_t struct_size;
    /**
     * Hears of the progress and may cancel; NULL (default) for nobody.
     */
    planish_progress progress;
    /**
     * Handed to progress as it is.
     */
    void *user;
    /**
     * Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
     */
    const volatile int32_t *cancel;
    /**
     * Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
     * Array: [1].
     */
    uint32_t *out_stage;
} planish_pht_simplify_options;

/**
 * How a tensor surface becomes a PHT-spline. Fill with planish_pht_convert_options_init(), then change what you
 * need.
 */
typedef struct planish_pht_convert_options {
    /**
     * Set by planish_pht_convert_options_init().
     */
    size_t struct_size;
    /**
     * Largest distance at equal parameters, in model units; 0 (default) takes all knot lines, which is exact up to
     * degree 3.
     */
    double tolerance;
    /**
     * Most cells; with more the call fails. Default 200000.
     */
    size_t max_cells;
    /**
     * Hears of the progress and may cancel; NULL (default) for nobody.
     */
    planish_progress progress;
    /**
     * Handed to progress as it is.
     */
    void *user;
    /**
     * Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
     */
    const volatile int32_t *cancel;
    /**
     * Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
     * Array: [1].
     */
    uint32_t *out_stage;
    /**
     * Deepest level of a cell, at most 20. Default 12.
     */
    uint32_t max_level;
    /**
     * 0.
     */
    uint32_t reserved;
} planish_pht_convert_options;

/**
 * How a PHT-spline becomes tensor surfaces. Fill with planish_pht_patches_options_init(), then change what you need.
 */
typedef struct planish_pht_patches_options {
    /**
     * Set by planish_pht_patches_options_init().
     */
    size_t struct_size;
    /**
     * Hears of the progress and may cancel; NULL (default) for nobody.
     */
    planish_progress progress;
    /**
     * Handed to progress as it is.
     */
    void *user;
    /**
     * Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
     */
    const volatile int32_t *cancel;
    /**
     * Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
     * Array: [1].
     */
    uint32_t *out_stage;
    /**
     * By how much the levels of cells in one surface may differ: many small ones for 0 (default), one for 20.
     */
    uint32_t level_spread;
    /**
     * 0.
     */
    uint32_t reserved;
} planish_pht_patches_options;

/**
 * Options of D1RC-splines and of fits by them. Fill with planish_d1rc_options_init(), then change what you need.
 */
typedef struct planish_d1rc_options {
    /**
     * Set by planish_d1rc_options_init().
     */
    size_t struct_size;
    /**
     * sharp_edge_count pairs of nodes joined by an edge; NULL (default) for none. Edges on the boundary do nothing.
     * Array: [sharp_edge_count, 2].
     */
    const uint32_t *sharp_edges;
    /**
     * Pairs in sharp_edges. Default 0.
     */
    size_t sharp_edge_count;
    /**
     * corner_count nodes to be interpolated; NULL (default) for none.
     * Array: [corner_count].
     */
    const uint32_t *corners;
    /**
     * Nodes in corners. Default 0.
     */
    size_t corner_count;
    /**
     * Edges whose faces meet at more than this angle in radians are sharp as well, up to pi; 0 (default) for none.
     */
    double sharp_angle;
    /**
     * Weight of the functions that sharp edges and corners add with PLANISH_D1RC_SHARP_SECTOR and
     * PLANISH_D1RC_SHARP_ADDITIVE, positive. Default 1.
     */
    double sharp_weight;
    /**
     * How a mesh without parameters gets them; NULL (default) for the defaults. Of this record progress, user and
     * thread_count are not looked at, and node_weights must be NULL.
     */
    const struct planish_parameterize_options *parameterize;
    /**
     * Hears of the progress of the parameters and may cancel; NULL (default) for nobody.
     */
    planish_progress progress;
    /**
     * Handed to progress as it is.
     */
    void *user;
    /**
     * Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
     */
    const volatile int32_t *cancel;
    /**
     * Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
     * Array: [1].
     */
    uint32_t *out_stage;
    /**
     * Fits only: the largest error allowed at the nodes, positive, measured in tolerance_scale. Default 1e-3.
     */
    double tolerance;
    /**
     * Fits only: weight of the energy that determines control points without data, positive. Default 1e-5.
     */
    double smoothing;
    /**
     * Fits only: the control mesh to use as it is; NULL (default) for the mesh itself with fewer nodes, its boundary
     * and sharp edges kept.
     */
    const struct planish_mesh *control_mesh;
    /**
     * Fits only: a positive weight for each node; NULL (default) for all 1.
     * Array: [nodes].
     */
    const double *weights;
    /**
     * Fits only: receives the (u,v) at which the error of each node is measured: two numbers for each node, or NULL
     * (default). Written on success only.
     * Array: [nodes, 2].
     */
    double *out_parameters;
    /**
     * Fits only: receives the error of each node in model units: one number for each node, or NULL (default).
     * Written on success only.
     * Array: [nodes].
     */
    double *out_errors;
    /**
     * Fits only: vertices of the control mesh that is made, at least 3; 0 (default) for as many as the tolerance
     * takes.
     */
    size_t control_count;
    /**
     * Fits only: most vertices of a control mesh that is made, at least 3. Default 100000.
     */
    size_t max_control_count;
    /**
     * 1, 2 or 3. Default 3.
     */
    uint32_t degree;
    /**
     * A planish_d1rc_mode. Default PLANISH_D1RC_MODE_REPRODUCING.
     */
    uint32_t mode;
    /**
     * A planish_d1rc_boundary. Default PLANISH_D1RC_BOUNDARY_PHANTOM.
     */
    uint32_t boundary;
    /**
     * A planish_d1rc_sharp. Default PLANISH_D1RC_SHARP_AUTOMATIC.
     */
    uint32_t sharp;
    /**
     * Fits only: a planish_tolerance_scale. Default PLANISH_TOLERANCE_SCALE_RELATIVE.
     */
    uint32_t tolerance_scale;
    /**
     * Fits only: sweeps in each round in which nodes move to their foot points and those with large errors gain
     * weight. Default 3.
     */
    uint32_t correction_sweeps;
    /**
     * Threads to use, at most 1024; 0 (default) for all cores. Results do not depend on it.
     */
    uint32_t thread_count;
    /**
     * 0.
     */
    uint32_t reserved;
} planish_d1rc_options;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/**
 * The version of the library that is loaded, such as "0.2.0": compare it with PLANISH_VERSION, the version
 * of this header. Never NULL; the text is static.
 */
PLANISH_API const char *planish_version(void);

/**
 * Whether the library that is loaded serves programs that were compiled with a version of this header: that is so with
 * the same major version, and before version 1 the same minor version too, if the header is not newer.
 *
 * major: PLANISH_VERSION_MAJOR.
 * minor: PLANISH_VERSION_MINOR.
 * Returns PLANISH_STATUS_OK or PLANISH_STATUS_VERSION.
 */
PLANISH_API
enum planish_status planish_check_version(uint32_t major,
                                          uint32_t minor);

/**
 * The name of a status, such as "PLANISH_STATUS_OK"; "unknown status" for a number that is none. Never
 * NULL; the text is static.
 */
PLANISH_API const char *planish_status_name(int32_t status);

/**
 * The sentence that explains this thread's last failure: the last call on this thread that returned a
 * negative status, or 0 because of a NULL handle. Later successes leave it as it is.
 *
 * text: receives the sentence in UTF-8, cut off if it is too long and always terminated; NULL if size is 0.
 * size: bytes that text has room for, the NUL included.
 * Arrays: text[size].
 * Returns the length of the whole sentence in bytes without the NUL; 0 if nothing has failed yet.
 * planish_error_message(NULL, 0) asks for it.
 */
PLANISH_API size_t planish_error_message(char *text, size_t size);

/**
 * What this thread's last failure was about: a node, triangle, row, value, knot, line or byte, counted from
 * 0 (the sentence says which); -1 if no single one is to blame or nothing has failed yet.
 */
PLANISH_API int64_t planish_error_index(void);

/**
 * Fills options with the defaults.
 *
 * options:     struct_size writable bytes.
 * struct_size: sizeof(planish_mesh_options).
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INVALID_ARGUMENT (struct_size).
 */
PLANISH_API
enum planish_status planish_mesh_options_init(struct planish_mesh_options *options,
                                              size_t struct_size);

/**
 * Makes a mesh from arrays, which are copied.
 *
 * points:         point_count rows of x, y, z in model units; rows start options->point_stride doubles apart.
 * point_count:    at least 1.
 * triangles:      triangle_count rows of three nodes, counter-clockwise seen from outside, counted from
 *                 options->index_base; rows start options->triangle_stride indices apart. Rows of more nodes with
 *                 options->corner_count or options->face_sizes: polygons, which become triangles.
 * triangle_count: at least 1.
 * options:        NULL for the defaults.
 * out_mesh:       receives a new mesh; destroy with planish_mesh_free().
 * Arrays: points[point_count, 3], triangles[triangle_count, 3].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_INPUT_REPAIRED (something was welded or mended, see
 * options->out_repairs) or an error: PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (empty
 * arrays, an option), PLANISH_STATUS_NOT_FINITE (a coordinate of a node that has triangles; the index is the node),
 * PLANISH_STATUS_INDEX (a triangle refers to a node that does not exist; the index is the triangle; or there is no
 * such component), PLANISH_STATUS_DEGENERATE (no triangle is left), PLANISH_STATUS_TOPOLOGY (an edge of three
 * triangles, unless PLANISH_MESH_REPAIR_SHEETS parts it; a surface of one side), PLANISH_STATUS_TOO_LARGE,
 * PLANISH_STATUS_VERSION or PLANISH_STATUS_OUT_OF_MEMORY. What options->repair does not mend is refused:
 * PLANISH_STATUS_TOPOLOGY, or PLANISH_STATUS_DEGENERATE for corners that come twice.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_mesh_new(const double *points,
                                     size_t point_count,
                                     const uint32_t *triangles,
                                     size_t triangle_count,
                                     const struct planish_mesh_options *options,
                                     struct planish_mesh **out_mesh);

/**
 * Makes a copy of a mesh with its parameters and fields.
 *
 * mesh:     not NULL.
 * out_mesh: receives a new mesh; destroy with planish_mesh_free().
 * Returns PLANISH_STATUS_OK or PLANISH_STATUS_NULL_POINTER.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_mesh_clone(const struct planish_mesh *mesh,
                                       struct planish_mesh **out_mesh);

/**
 * Destroys a mesh.
 *
 * mesh: from this library and not destroyed yet; NULL does nothing.
 */
PLANISH_API void planish_mesh_free(struct planish_mesh *mesh);

/**
 * Number of nodes; 0 for NULL.
 */
PLANISH_API size_t planish_mesh_point_count(const struct planish_mesh *mesh);

/**
 * Number of triangles; 0 for NULL.
 */
PLANISH_API size_t planish_mesh_triangle_count(const struct planish_mesh *mesh);

/**
 * Number of edges, each counted once; 0 for NULL.
 */
PLANISH_API size_t planish_mesh_edge_count(const struct planish_mesh *mesh);

/**
 * Number of parts that hang together by edges; 0 for NULL.
 */
PLANISH_API size_t planish_mesh_component_count(const struct planish_mesh *mesh);

/**
 * Number of handles of all components together; 0 for NULL.
 */
PLANISH_API size_t planish_mesh_genus(const struct planish_mesh *mesh);

/**
 * Nodes that have triangles, minus edges, plus triangles; 0 for NULL.
 */
PLANISH_API int64_t planish_mesh_euler_characteristic(const struct planish_mesh *mesh);

/**
 * Number of boundary loops; 0 for NULL.
 */
PLANISH_API size_t planish_mesh_loop_count(const struct planish_mesh *mesh);

/**
 * Number of nodes of a boundary loop; 0 for NULL or a loop that does not exist.
 *
 * loop: below planish_mesh_loop_count(); loop 0 is the longest.
 */
PLANISH_API size_t planish_mesh_loop_point_count(const struct planish_mesh *mesh, size_t loop);

/**
 * Copies the nodes' coordinates.
 *
 * mesh:       not NULL.
 * out_points: receives planish_mesh_point_count() rows of x, y, z.
 * count:      rows that out_points has room for.
 * Arrays: out_points[mesh_point_count, 3].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_mesh_copy_points(const struct planish_mesh *mesh,
                                             double *out_points,
                                             size_t count);

/**
 * Copies the triangles.
 *
 * mesh:          not NULL.
 * out_triangles: receives planish_mesh_triangle_count() rows of three nodes, counted from 0.
 * count:         rows that out_triangles has room for.
 * Arrays: out_triangles[mesh_triangle_count, 3].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_mesh_copy_triangles(const struct planish_mesh *mesh,
                                                uint32_t *out_triangles,
                                                size_t count);

/**
 * Copies what each node of the mesh was in the arrays or the file that it comes from, or in the mesh that it was cut
 * from: copies of nodes name the node that they are copies of, and welded nodes the first of those that became one.
 *
 * mesh:      not NULL.
 * out_nodes: receives planish_mesh_point_count() nodes, counted from 0.
 * count:     nodes that out_nodes has room for.
 * Arrays: out_nodes[mesh_point_count].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_mesh_copy_node_map(const struct planish_mesh *mesh,
                                               uint32_t *out_nodes,
                                               size_t count);

/**
 * Copies what each triangle of the mesh was: the triangle or polygon of the arrays, the face of the file, or the
 * triangle of the mesh that it was cut from.
 *
 * mesh:          not NULL.
 * out_triangles: receives planish_mesh_triangle_count() numbers, counted from 0.
 * count:         numbers that out_triangles has room for.
 * Arrays: out_triangles[mesh_triangle_count].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_mesh_copy_triangle_map(const struct planish_mesh *mesh,
                                                   uint32_t *out_triangles,
                                                   size_t count);

/**
 * Moves the nodes of a mesh, which keeps its triangles, parameters and fields: a step of a simulation.
 *
 * mesh:   not NULL; changed.
 * points: count rows of x, y, z in model units. Copied.
 * count:  planish_mesh_point_count().
 * Arrays: points[count, 3].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (count),
 * PLANISH_STATUS_NOT_FINITE (of a node that has triangles, which is the index), PLANISH_STATUS_TOO_LARGE or
 * PLANISH_STATUS_OUT_OF_MEMORY.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_mesh_set_points(struct planish_mesh *mesh,
                                            const double *points,
                                            size_t count);

/**
 * Copies the nodes of a boundary loop in order, the surface on their left. The first is not repeated.
 *
 * mesh:      not NULL.
 * loop:      below planish_mesh_loop_count(); loop 0 is the longest in space.
 * out_nodes: receives planish_mesh_loop_point_count() nodes, counted from 0.
 * count:     nodes that out_nodes has room for.
 * Arrays: out_nodes[mesh_loop_point_count].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INDEX (the loop) or
 * PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_mesh_copy_loop(const struct planish_mesh *mesh,
                                           size_t loop,
                                           uint32_t *out_nodes,
                                           size_t count);

/**
 * Number of fields on the nodes; 0 for NULL.
 */
PLANISH_API size_t planish_mesh_field_count(const struct planish_mesh *mesh);

/**
 * The name of a field.
 *
 * mesh:  not NULL.
 * field: below planish_mesh_field_count().
 * name:  receives the name in UTF-8, cut off if it is too long and always terminated; NULL if size is 0.
 * size:  bytes that name has room for, the NUL included.
 * Arrays: name[size].
 * Returns the length of the whole name in bytes without the NUL; 0 for NULL or a field that does not exist.
 */
PLANISH_API
size_t planish_mesh_field_name(const struct planish_mesh *mesh,
                               size_t field,
                               char *name,
                               size_t size);

/**
 * Copies the values of a field.
 *
 * mesh:       not NULL.
 * name:       the field's name in UTF-8, terminated.
 * out_values: receives planish_mesh_point_count() values; NaN where nothing is known.
 * count:      values that out_values has room for.
 * Arrays: out_values[mesh_point_count].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (no such field, or
 * name is not UTF-8) or PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_mesh_copy_field(const struct planish_mesh *mesh,
                                            const char *name,
                                            double *out_values,
                                            size_t count);

/**
 * Adds a field, or replaces the one of this name.
 *
 * mesh:   not NULL; changed.
 * name:   the field's name in UTF-8, terminated.
 * values: count values, one for each node; NaN where nothing is known. Copied.
 * count:  planish_mesh_point_count().
 * Arrays: values[count].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (count, or name is
 * not UTF-8), PLANISH_STATUS_TOO_LARGE or PLANISH_STATUS_OUT_OF_MEMORY.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_mesh_set_field(struct planish_mesh *mesh,
                                           const char *name,
                                           const double *values,
                                           size_t count);

/**
 * Removes a field.
 *
 * mesh: not NULL; changed.
 * name: the field's name in UTF-8, terminated.
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INVALID_ARGUMENT (no such field, or name is
 * not UTF-8).
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_mesh_remove_field(struct planish_mesh *mesh,
                                              const char *name);

/**
 * 1 if the nodes have parameters, else 0; 0 for NULL.
 */
PLANISH_API uint32_t planish_mesh_has_parameters(const struct planish_mesh *mesh);

/**
 * Gives each node its (u,v).
 *
 * mesh:  not NULL; changed.
 * uv:    count rows of u, v. Copied.
 * count: planish_mesh_point_count().
 * Arrays: uv[count, 2].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (count),
 * PLANISH_STATUS_NOT_FINITE (the index is the node), PLANISH_STATUS_TOO_LARGE or PLANISH_STATUS_OUT_OF_MEMORY.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_mesh_set_parameters(struct planish_mesh *mesh,
                                                const double *uv,
                                                size_t count);

/**
 * Copies the (u,v) of the nodes.
 *
 * mesh:   not NULL.
 * out_uv: receives planish_mesh_point_count() rows of u, v.
 * count:  rows that out_uv has room for.
 * Arrays: out_uv[mesh_point_count, 2].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (the mesh has no
 * parameters) or PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_mesh_copy_parameters(const struct planish_mesh *mesh,
                                                 double *out_uv,
                                                 size_t count);

/**
 * Makes a mesh without some of the triangles, and without the nodes that no triangle needs any more.
 *
 * Parameters and fields go with their nodes, and planish_mesh_copy_node_map() of the new mesh tells which node each
 * one was.
 *
 * mesh:      not NULL; stays as it is.
 * triangles: count triangles to leave out, counted from 0, in any order.
 * count:     may be 0.
 * out_mesh:  receives a new mesh; destroy with planish_mesh_free().
 * Arrays: triangles[count].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INDEX (no such triangle; it is the
 * index) or PLANISH_STATUS_INVALID_ARGUMENT (nothing is left).
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_mesh_remove_triangles(const struct planish_mesh *mesh,
                                                  const uint32_t *triangles,
                                                  size_t count,
                                                  struct planish_mesh **out_mesh);

/**
 * Makes a mesh that is cut open along a path of edges: how a closed mesh or a handle is opened.
 *
 * Nodes inside the path are doubled, and so are its ends on the boundary; ends inside the mesh are not. A
 * closed path, whose last node is its first, separates what it surrounds. Triangles keep their numbers and
 * nodes theirs; copies come after them. Parameters and fields go with their nodes.
 *
 * mesh:     not NULL; stays as it is.
 * nodes:    count nodes of the path in order, counted from 0; see planish_mesh_shortest_path().
 * count:    at least 2.
 * out_mesh: receives a new mesh; destroy with planish_mesh_free().
 * Arrays: nodes[count].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (count),
 * PLANISH_STATUS_INDEX (no such node; it is the index) or PLANISH_STATUS_TOPOLOGY (two nodes that follow each
 * other have no common edge, the index is the first; or the path opens nothing).
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_mesh_cut_along(const struct planish_mesh *mesh,
                                           const uint32_t *nodes,
                                           size_t count,
                                           struct planish_mesh **out_mesh);

/**
 * Makes a mesh of each part that hangs together by edges, in the order of their first triangles. Parameters
 * and fields go with their nodes.
 *
 * mesh:       not NULL; stays as it is.
 * out_meshes: receives planish_mesh_component_count() new meshes, all or none; destroy each with
 *             planish_mesh_free().
 * count:      meshes that out_meshes has room for.
 * Arrays: out_meshes[mesh_component_count].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_mesh_split_components(const struct planish_mesh *mesh,
                                                  struct planish_mesh **out_meshes,
                                                  size_t count);

/**
 * Finds the shortest path along edges, by length in space.
 *
 * mesh:      not NULL.
 * from, to:  its ends, nodes counted from 0.
 * out_nodes: receives the nodes of the path, both ends included. NULL asks for their number.
 * count:     nodes that out_nodes has room for.
 * out_count: receives the number of nodes of the path; not NULL.
 * Arrays: out_nodes[count], out_count[1].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INDEX (no such node; it is the
 * index), PLANISH_STATUS_TOPOLOGY (no path joins them) or PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_mesh_shortest_path(const struct planish_mesh *mesh,
                                               uint32_t from,
                                               uint32_t to,
                                               uint32_t *out_nodes,
                                               size_t count,
                                               size_t *out_count);

/**
 * Fills options with the defaults.
 *
 * options:     struct_size writable bytes.
 * struct_size: sizeof(planish_mesh_write_options).
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INVALID_ARGUMENT (struct_size).
 */
PLANISH_API
enum planish_status planish_mesh_write_options_init(struct planish_mesh_write_options *options,
                                                    size_t struct_size);

/**
 * Reads a mesh from an OFF, OBJ, PLY or STL file, packed by gzip or not.
 *
 * Polygons become triangles. The `vt` of an OBJ become parameters if each node has one; the numbers that a
 * PLY has on its nodes become fields. Faults are mended as options->repair says; planish_mesh_copy_node_map() and
 * planish_mesh_copy_triangle_map() tell what nodes and triangles of the mesh were in the file.
 *
 * path:     the file, terminated; on Unix any bytes, elsewhere UTF-8.
 * options:  NULL for the defaults.
 * out_mesh: receives a new mesh; destroy with planish_mesh_free().
 * Returns what planish_mesh_new() returns, or PLANISH_STATUS_FILE (cannot be read), PLANISH_STATUS_FORMAT (not
 * what it claims to be; the index is the line or the byte, counted from 0), PLANISH_STATUS_TOO_LARGE (more bytes than
 * options->max_memory) or PLANISH_STATUS_INVALID_ARGUMENT (out_node_map is not NULL, or the file has points only).
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_mesh_read(const char *path,
                                      const struct planish_mesh_options *options,
                                      struct planish_mesh **out_mesh);

/**
 * Reads a mesh from the content of a file in memory, as planish_mesh_read() does from a file.
 *
 * buffer:   size bytes; borrowed for the call.
 * size:     at least 1.
 * options:  NULL for the defaults; with PLANISH_MESH_FORMAT_AUTO the content says what it is.
 * out_mesh: receives a new mesh; destroy with planish_mesh_free().
 * Arrays: buffer[size].
 * Returns what planish_mesh_read() returns, but for PLANISH_STATUS_FILE.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_mesh_read_buffer(const void *buffer,
                                             size_t size,
                                             const struct planish_mesh_options *options,
                                             struct planish_mesh **out_mesh);

/**
 * Writes a mesh as OFF, OBJ, PLY or STL. Numbers read back to the same bits, but for STL, which has floats of four
 * bytes in its binary form, and neither numbers of nodes nor parameters. Parameters go into the others, fields into PLY.
 *
 * The file appears whole or not at all: it is written beside its place under another name, synced to the disk and
 * renamed. An existing file keeps its mode and survives every failure, a symbolic link is followed; what is no regular
 * file, such as a device or a FIFO, is written to. So it is with every function that writes a file.
 *
 * mesh:    not NULL.
 * path:    ends with a NUL; on Unix any bytes, elsewhere UTF-8. An existing file is replaced.
 * options: NULL for the defaults.
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option, or a name that
 * ends in no known format without one), PLANISH_STATUS_FILE or PLANISH_STATUS_VERSION.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_mesh_write(const struct planish_mesh *mesh,
                                       const char *path,
                                       const struct planish_mesh_write_options *options);

/**
 * Fills options with the defaults.
 *
 * options:     struct_size writable bytes.
 * struct_size: sizeof(planish_decimate_options).
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INVALID_ARGUMENT (struct_size).
 */
PLANISH_API
enum planish_status planish_decimate_options_init(struct planish_decimate_options *options,
                                                  size_t struct_size);

/**
 * Makes a mesh of fewer nodes by collapsing edges where that changes the shape least.
 *
 * The nodes left are nodes of the mesh given, with their places, parameters and fields: to know which node each
 * one was, give the mesh a field of node numbers before. Loops, components and handles stay, sharp edges and the
 * boundary stay edges and their corners nodes. No triangle turns by more than 60 degrees in one collapse.
 *
 * mesh:       not NULL; stays as it is.
 * options:    NULL for the defaults.
 * out_mesh:   receives a new mesh; destroy with planish_mesh_free().
 * out_report: receives what was done; NULL for no report.
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_STAGNATED (more nodes than asked for had to stay; out_mesh is there)
 * or an error: PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option), PLANISH_STATUS_INDEX (a
 * sharp edge has a node that does not exist; the index is the edge), PLANISH_STATUS_TOPOLOGY (a sharp edge is no
 * edge; it is the index), PLANISH_STATUS_DEGENERATE (with keep_map a triangle is flat or turned over in the
 * parameter plane; it is the index), PLANISH_STATUS_BUFFER_TOO_SMALL (out_sharp_edges), PLANISH_STATUS_TOO_LARGE,
 * PLANISH_STATUS_VERSION or PLANISH_STATUS_CANCELLED.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_mesh_decimate(const struct planish_mesh *mesh,
                                          const struct planish_decimate_options *options,
                                          struct planish_mesh **out_mesh,
                                          struct planish_decimate_report *out_report);

/**
 * Fills options with the defaults.
 *
 * options:     struct_size writable bytes.
 * struct_size: sizeof(planish_parameterize_options).
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INVALID_ARGUMENT (struct_size).
 */
PLANISH_API
enum planish_status planish_parameterize_options_init(struct planish_parameterize_options *options,
                                                      size_t struct_size);

/**
 * Gives each node of a disk, possibly with holes, its (u,v). Parameters that the mesh has are replaced.
 *
 * mesh:       not NULL; changed on success.
 * options:    NULL for the defaults.
 * out_report: receives how good the map is; NULL for no report.
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_FOLDED_PARAMETERS (the mesh has its parameters, some triangles are
 * turned over or flat) or an error: PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option, a
 * corner, a node weight, or no parameters to keep), PLANISH_STATUS_TOPOLOGY (closed, several components, a
 * handle, a node where the surface touches itself or that no triangle has), PLANISH_STATUS_DEGENERATE (zero
 * areas or lengths, or a free border that would fold or overlap itself), PLANISH_STATUS_SINGULAR, PLANISH_STATUS_VERSION or PLANISH_STATUS_CANCELLED.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_mesh_parameterize(struct planish_mesh *mesh,
                                              const struct planish_parameterize_options *options,
                                              struct planish_parameterize_report *out_report);

/**
 * Fills options with the defaults.
 *
 * options:     struct_size writable bytes.
 * struct_size: sizeof(planish_sphere_options).
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INVALID_ARGUMENT (struct_size).
 */
PLANISH_API
enum planish_status planish_sphere_options_init(struct planish_sphere_options *options,
                                                size_t struct_size);

/**
 * Maps a closed mesh of one component and genus 0 on to the unit sphere, one to one: no triangle is turned over.
 *
 * Triangles that are counter-clockwise seen from outside stay so. The map keeps lengths as well as it can: it lowers
 * the symmetric Dirichlet energy, coarse to fine. The same mesh gives the same bits on any number of threads.
 *
 * mesh:       not NULL; stays as it is.
 * options:    NULL for the defaults.
 * out_points: receives x, y, z of each node: a unit vector, or zeros for a node without triangles.
 * count:      rows that out_points has room for, at least planish_mesh_point_count().
 * out_report: receives how good the map is; NULL for no report.
 * Arrays: out_points[mesh_point_count, 3].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_FOLDED_PARAMETERS (rounding left no room somewhere; out_points is filled)
 * or an error: PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option), PLANISH_STATUS_TOPOLOGY (a
 * boundary, with one of its nodes as the index; several components; handles; a node where the surface touches
 * itself, which is the index), PLANISH_STATUS_DEGENERATE (no triangle has an area, or a node without room, which is
 * the index), PLANISH_STATUS_BUFFER_TOO_SMALL (count), PLANISH_STATUS_VERSION or PLANISH_STATUS_CANCELLED.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_mesh_map_to_sphere(const struct planish_mesh *mesh,
                                               const struct planish_sphere_options *options,
                                               double *out_points,
                                               size_t count,
                                               struct planish_sphere_report *out_report);

/**
 * Fills options with the defaults.
 *
 * options:     struct_size writable bytes.
 * struct_size: sizeof(planish_feature_options).
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INVALID_ARGUMENT (struct_size).
 */
PLANISH_API
enum planish_status planish_feature_options_init(struct planish_feature_options *options,
                                                 size_t struct_size);

/**
 * Finds the edges where a mesh is not smooth: sharp ones, those between labels, those given, and the border.
 *
 * They are what sharp_edges of other calls want. Call it once without out_edges for their number, then with room for
 * all, or ask with room for planish_mesh_edge_count() at once.
 *
 * mesh:      not NULL; stays as it is.
 * options:   NULL for the defaults.
 * out_edges: receives the nodes of each edge, counted from 0, the smaller first, in increasing order; NULL to learn the
 *            number only.
 * count:     edges that out_edges has room for.
 * out_count: receives the number of edges.
 * Arrays: out_edges[count, 2], out_count[1].
 * Returns PLANISH_STATUS_OK or an error: PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option),
 * PLANISH_STATUS_INDEX (a sharp edge has a node that does not exist; the index is the edge), PLANISH_STATUS_TOPOLOGY
 * (a sharp edge is no edge; it is the index), PLANISH_STATUS_BUFFER_TOO_SMALL (count), PLANISH_STATUS_TOO_LARGE or
 * PLANISH_STATUS_VERSION.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_mesh_find_features(const struct planish_mesh *mesh,
                                               const struct planish_feature_options *options,
                                               uint32_t *out_edges,
                                               size_t count,
                                               size_t *out_count);

/**
 * Tells how each label of a mesh hangs together. A label that stands for a face of a CAD model is one piece without
 * handles; one in several pieces or with handles tells that labels are mixed up, or that planish_model_fit() makes
 * several faces of it.
 *
 * Call it once without arrays for the number of labels, then with room for all; there are no more than triangles.
 *
 * mesh:                not NULL; stays as it is.
 * labels:              a number for each triangle.
 * label_count:         planish_mesh_triangle_count(); 0 for no labels, of which nothing is told.
 * out_labels:          receives each label once, in increasing order; NULL for none.
 * out_triangle_counts: receives for each its number of triangles; NULL for none.
 * out_piece_counts:    receives for each the number of its pieces, which share no edge; NULL for none.
 * out_handle_counts:   receives for each the handles of all its pieces together; NULL for none.
 * count:               labels that each of these arrays has room for.
 * out_count:           receives the number of different labels.
 * Arrays: labels[label_count], out_labels[count], out_triangle_counts[count], out_piece_counts[count],
 *   out_handle_counts[count], out_count[1].
 * Returns PLANISH_STATUS_OK or an error: PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (label_count),
 * PLANISH_STATUS_BUFFER_TOO_SMALL (count), PLANISH_STATUS_TOO_LARGE or PLANISH_STATUS_OUT_OF_MEMORY.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_mesh_label_parts(const struct planish_mesh *mesh,
                                             const uint32_t *labels,
                                             size_t label_count,
                                             uint32_t *out_labels,
                                             size_t *out_triangle_counts,
                                             size_t *out_piece_counts,
                                             size_t *out_handle_counts,
                                             size_t count,
                                             size_t *out_count);

/**
 * Fills options with the defaults.
 *
 * options:     struct_size writable bytes.
 * struct_size: sizeof(planish_layout_options).
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INVALID_ARGUMENT (struct_size).
 */
PLANISH_API
enum planish_status planish_layout_options_init(struct planish_layout_options *options,
                                                size_t struct_size);

/**
 * Fills options with the defaults.
 *
 * options:     struct_size writable bytes.
 * struct_size: sizeof(planish_mesh_layout_options).
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INVALID_ARGUMENT (struct_size).
 */
PLANISH_API
enum planish_status planish_mesh_layout_options_init(struct planish_mesh_layout_options *options,
                                                     size_t struct_size);

/**
 * Makes a layout of quads whose sides meet.
 *
 * corners:    four vertices of each quad, counted from 0, counter-clockwise seen from outside.
 * quad_count: at least 1.
 * options:    NULL for the defaults.
 * out_layout: receives a new layout; destroy with planish_layout_free().
 * Arrays: corners[quad_count, 4].
 * Returns PLANISH_STATUS_OK or an error: PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (no quads),
 * PLANISH_STATUS_INDEX (numbers of vertices with gaps so large that they cannot be meant), PLANISH_STATUS_TOPOLOGY (a
 * vertex twice in a quad, three sides at an edge, sides that run the same way: the index is the quad; quads that touch
 * in a vertex only, or fewer than three around a vertex inside: the index is the vertex), PLANISH_STATUS_TOO_LARGE,
 * PLANISH_STATUS_VERSION or PLANISH_STATUS_OUT_OF_MEMORY.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_layout_new(const uint32_t *corners,
                                       size_t quad_count,
                                       const struct planish_layout_options *options,
                                       struct planish_layout **out_layout);

/**
 * Makes the layout of the six faces of a cube: -x, x, -y, y, -z, z.
 *
 * out_layout: receives a new layout; destroy with planish_layout_free().
 * Returns PLANISH_STATUS_OK or PLANISH_STATUS_NULL_POINTER.
 */
PLANISH_API PLANISH_NODISCARD enum planish_status planish_layout_cube(struct planish_layout **out_layout);

/**
 * Makes a layout for a mesh of one component and any genus, closed or with a border, with the places of its nodes.
 *
 * A cube keeps to the sphere; a base complex follows the shape: its patches are nearly square and of nearly equal
 * size. The same mesh gives the same bits on any number of threads.
 *
 * mesh:       not NULL; stays as it is.
 * options:    NULL for the defaults.
 * out_layout: receives a new layout; destroy with planish_layout_free().
 * out_report: receives how good it is; NULL for no report.
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_FOLDED_PARAMETERS (some nodes have triangles that are turned over, or spread
 * over too many patches; out_layout is there) or an error: PLANISH_STATUS_NULL_POINTER,
 * PLANISH_STATUS_INVALID_ARGUMENT (an option), PLANISH_STATUS_TOPOLOGY (several components; for a cube a boundary, with one
 * of its nodes as the index, or handles; a node where the surface touches itself, which is the index),
 * PLANISH_STATUS_DEGENERATE (no triangle has an area, or coarse triangles make no layout), PLANISH_STATUS_VERSION or
 * PLANISH_STATUS_CANCELLED.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_layout_of_mesh(const struct planish_mesh *mesh,
                                           const struct planish_mesh_layout_options *options,
                                           struct planish_layout **out_layout,
                                           struct planish_mesh_layout_report *out_report);

/**
 * Destroys a layout.
 *
 * layout: from a call that makes layouts, or NULL.
 */
PLANISH_API void planish_layout_free(struct planish_layout *layout);

/**
 * The number of quads; 0 for NULL.
 *
 * layout: a layout, or NULL.
 */
PLANISH_API size_t planish_layout_quad_count(const struct planish_layout *layout);

/**
 * One more than the largest number of a vertex; 0 for NULL.
 *
 * layout: a layout, or NULL.
 */
PLANISH_API size_t planish_layout_vertex_count(const struct planish_layout *layout);

/**
 * The number of edges; 0 for NULL.
 *
 * layout: a layout, or NULL.
 */
PLANISH_API size_t planish_layout_edge_count(const struct planish_layout *layout);

/**
 * The number of nodes that have places on the layout; 0 if it was not made for a mesh, and for NULL.
 *
 * layout: a layout, or NULL.
 */
PLANISH_API size_t planish_layout_node_count(const struct planish_layout *layout);

/**
 * Copies the corners of the quads.
 *
 * layout:      not NULL.
 * out_corners: receives four vertices of each quad, counted from 0, counter-clockwise: at (0,0), (1,0), (1,1), (0,1).
 * count:       quads that out_corners has room for, at least planish_layout_quad_count().
 * Arrays: out_corners[count, 4].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_layout_copy_corners(const struct planish_layout *layout,
                                                uint32_t *out_corners,
                                                size_t count);

/**
 * Copies the edges.
 *
 * layout:    not NULL.
 * out_edges: receives six numbers of each edge, counted from 0: the vertices at its begin and its end, the quad and the
 *            side (from corner k to corner k + 1) that run this way, the quad and the side that run the other way, which
 *            are PLANISH_NONE at a border.
 * count:     edges that out_edges has room for, at least planish_layout_edge_count().
 * Arrays: out_edges[count, 6].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_layout_copy_edges(const struct planish_layout *layout,
                                              uint32_t *out_edges,
                                              size_t count);

/**
 * Copies the valences of the vertices.
 *
 * layout:       not NULL.
 * out_valences: receives the number of quads around each vertex; 0 for a number that no quad has.
 * count:        vertices that out_valences has room for, at least planish_layout_vertex_count().
 * Arrays: out_valences[count].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_layout_copy_valences(const struct planish_layout *layout,
                                                 uint32_t *out_valences,
                                                 size_t count);

/**
 * Copies where the nodes of the mesh lie on the layout.
 *
 * layout:    not NULL, made by planish_layout_of_mesh().
 * out_quads: receives the quad of each node, counted from 0; PLANISH_NONE for a node without triangles.
 * out_uv:    receives the parameters of each node on its quad, 0 to 1; NaN for a node without triangles.
 * count:     nodes that both have room for, at least planish_layout_node_count().
 * Arrays: out_quads[count], out_uv[count, 2].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (the layout was not made for
 * a mesh) or PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_layout_copy_node_map(const struct planish_layout *layout,
                                                 uint32_t *out_quads,
                                                 double *out_uv,
                                                 size_t count);

/**
 * The family of a surface: a planish_kind; PLANISH_KIND_NONE for NULL.
 */
PLANISH_API uint32_t planish_surface_kind(const struct planish_surface *surface);

/**
 * Numbers of a value: 1 for a scalar field, 3 for a shape; 0 for NULL.
 */
PLANISH_API size_t planish_surface_dim(const struct planish_surface *surface);

/**
 * Number of control points; 0 for NULL.
 */
PLANISH_API size_t planish_surface_coefficient_count(const struct planish_surface *surface);

/**
 * The rectangle on which the surface is defined.
 *
 * surface: not NULL.
 * out_box: receives 4 numbers: least u, largest u, least v, largest v.
 * Arrays: out_box[4].
 * Returns PLANISH_STATUS_OK or PLANISH_STATUS_NULL_POINTER.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_surface_domain(const struct planish_surface *surface,
                                           double *out_box);

/**
 * The box of the (u,v) of the data that the surface was made from: beyond it the surface is extrapolated. The
 * domain if the surface was not made from data.
 *
 * surface: not NULL.
 * out_box: receives 4 numbers: least u, largest u, least v, largest v.
 * Arrays: out_box[4].
 * Returns PLANISH_STATUS_OK or PLANISH_STATUS_NULL_POINTER.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_surface_data_box(const struct planish_surface *surface,
                                             double *out_box);

/**
 * Makes a copy of a surface with its trims.
 *
 * surface:     not NULL.
 * out_surface: receives a new surface; destroy with planish_surface_free().
 * Returns PLANISH_STATUS_OK or PLANISH_STATUS_NULL_POINTER.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_surface_clone(const struct planish_surface *surface,
                                          struct planish_surface **out_surface);

/**
 * Destroys a surface.
 *
 * surface: from this library and not destroyed yet; NULL does nothing.
 */
PLANISH_API void planish_surface_free(struct planish_surface *surface);

/**
 * Fills options with the defaults.
 *
 * options:     struct_size writable bytes.
 * struct_size: sizeof(planish_eval_options).
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INVALID_ARGUMENT (struct_size).
 */
PLANISH_API
enum planish_status planish_eval_options_init(struct planish_eval_options *options,
                                              size_t struct_size);

/**
 * Evaluates the surface at points.
 *
 * surface:    not NULL.
 * uv:         count rows of u, v; rows start options->uv_stride doubles apart.
 * count:      may be 0.
 * options:    NULL for the defaults.
 * out_values: receives count rows of dim numbers; rows start options->out_stride doubles apart. It must not
 *             overlap uv.
 * Arrays: uv[count, 2], out_values[count, surface_dim].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_POINTS_OUTSIDE (with PLANISH_OUTSIDE_FLAG; the values of those
 * points are NaN) or an error: PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option),
 * PLANISH_STATUS_OUTSIDE (with PLANISH_OUTSIDE_FAIL; the index is the first such point),
 * PLANISH_STATUS_NOT_FINITE (u or v, unless PLANISH_OUTSIDE_FLAG; the index is the point),
 * PLANISH_STATUS_TOO_LARGE (count times stride) or PLANISH_STATUS_VERSION.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_surface_eval(const struct planish_surface *surface,
                                         const double *uv,
                                         size_t count,
                                         const struct planish_eval_options *options,
                                         double *out_values);

/**
 * Evaluates the surface and its derivatives at points.
 *
 * surface:        not NULL.
 * uv:             count rows of u, v; rows start options->uv_stride doubles apart.
 * count:          may be 0.
 * max_derivative: 0, 1 or 2.
 * options:        NULL for the defaults.
 * out:            receives for each point 1, 3 or 6 rows of dim numbers: S; Su, Sv; Suu, Suv, Svv. Points
 *                 start options->out_stride doubles apart. It must not overlap uv.
 * Arrays: uv[count, 2], out[count, *, surface_dim].
 * Returns what planish_surface_eval() returns; PLANISH_STATUS_INVALID_ARGUMENT also for max_derivative.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_surface_eval_derivatives(const struct planish_surface *surface,
                                                     const double *uv,
                                                     size_t count,
                                                     uint32_t max_derivative,
                                                     const struct planish_eval_options *options,
                                                     double *out);

/**
 * Evaluates the surface at all pairs of some u and some v.
 *
 * surface:    not NULL.
 * u, u_count: parameters along u; may be none.
 * v, v_count: parameters along v; may be none.
 * options:    NULL for the defaults; uv_stride must be 0.
 * out_values: receives u_count * v_count rows of dim numbers, v running fastest; rows start
 *             options->out_stride doubles apart. It must not overlap u or v.
 * Arrays: u[u_count], v[v_count], out_values[u_count, v_count, surface_dim].
 * Returns what planish_surface_eval() returns; the index of a point counts as the rows of out_values do.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_surface_eval_grid(const struct planish_surface *surface,
                                              const double *u,
                                              size_t u_count,
                                              const double *v,
                                              size_t v_count,
                                              const struct planish_eval_options *options,
                                              double *out_values);

/**
 * Computes unit normals Su x Sv / |Su x Sv| of a surface in space.
 *
 * surface:     not NULL, of dim 3.
 * uv:          count rows of u, v; rows start options->uv_stride doubles apart.
 * count:       may be 0.
 * options:     NULL for the defaults.
 * out_normals: receives count rows of 3 numbers, NaN where Su and Sv are parallel; rows start
 *              options->out_stride doubles apart. It must not overlap uv.
 * Arrays: uv[count, 2], out_normals[count, 3].
 * Returns what planish_surface_eval() returns; PLANISH_STATUS_INVALID_ARGUMENT also if dim is not 3.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_surface_normals(const struct planish_surface *surface,
                                            const double *uv,
                                            size_t count,
                                            const struct planish_eval_options *options,
                                            double *out_normals);

/**
 * Computes principal curvatures and their directions of a surface in space.
 *
 * surface: not NULL, of dim 3.
 * uv:      count rows of u, v; rows start options->uv_stride doubles apart.
 * count:   may be 0.
 * options: NULL for the defaults.
 * out:     receives count rows of 8 numbers: k1, k2 with k1 >= k2, positive where the surface bends towards
 *          its normal, then the unit tangents d1 and d2 of 3 numbers each, with d1 x d2 the normal; NaN where
 *          there is no normal. Rows start options->out_stride doubles apart. It must not overlap uv.
 * Arrays: uv[count, 2], out[count, 8].
 * Returns what planish_surface_eval() returns; PLANISH_STATUS_INVALID_ARGUMENT also if dim is not 3.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_surface_curvatures(const struct planish_surface *surface,
                                               const double *uv,
                                               size_t count,
                                               const struct planish_eval_options *options,
                                               double *out);

/**
 * Number of trims: closed polylines in the parameter plane that bound the part of the surface that counts. A
 * surface made from a mesh has the mesh's boundary loops. 0 if the whole domain counts, and for NULL.
 */
PLANISH_API size_t planish_surface_trim_count(const struct planish_surface *surface);

/**
 * Number of points of a trim; 0 for NULL or a trim that does not exist.
 *
 * trim: below planish_surface_trim_count(); trim 0 is the outer one.
 */
PLANISH_API size_t planish_surface_trim_point_count(const struct planish_surface *surface, size_t trim);

/**
 * Copies the points of a trim in order. The first is not repeated.
 *
 * surface: not NULL.
 * trim:    below planish_surface_trim_count(); trim 0 is the outer one.
 * out_uv:  receives planish_surface_trim_point_count() rows of u, v.
 * count:   rows that out_uv has room for.
 * Arrays: out_uv[surface_trim_point_count, 2].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INDEX (the trim) or
 * PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_surface_copy_trim(const struct planish_surface *surface,
                                              size_t trim,
                                              double *out_uv,
                                              size_t count);

/**
 * Replaces the trims. A point counts when a ray from it crosses the trims an odd number of times, so the
 * outer one and holes may run in any direction.
 *
 * surface:      not NULL; changed.
 * uv:           rows of u, v inside the domain, trim after trim, the first point of a trim not repeated.
 *               Copied.
 * point_counts: trim_count numbers of points, each at least 3.
 * trim_count:   0 removes all trims.
 * Arrays: uv[*, 2], point_counts[trim_count].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (a trim of fewer
 * than 3 points), PLANISH_STATUS_NOT_FINITE, PLANISH_STATUS_OUTSIDE (the index is the trim for all three),
 * PLANISH_STATUS_TOO_LARGE or PLANISH_STATUS_OUT_OF_MEMORY.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_surface_set_trims(struct planish_surface *surface,
                                              const double *uv,
                                              const size_t *point_counts,
                                              size_t trim_count);

/**
 * Fills options with the defaults.
 *
 * options:     struct_size writable bytes.
 * struct_size: sizeof(planish_trim_options).
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INVALID_ARGUMENT (struct_size).
 */
PLANISH_API
enum planish_status planish_trim_options_init(struct planish_trim_options *options,
                                              size_t struct_size);

/**
 * Makes trims that follow curves in space: each loop is projected on to the surface, to the nearest of all its places
 * whatever trims it has, and its feet are joined by lines in (u, v) that are halved until the surface over them is within
 * the tolerance of the curve, and the curve of it. The surface stays as it is on error.
 *
 * surface:      not NULL, of dimension 3; changed.
 * curves:       curves of dimension 3, loop after loop, none of them NULL. The curves of a loop follow one another, each
 *               in either direction; gaps within the tolerance are closed. A loop may not cross a seam of the surface.
 * curve_counts: trim_count numbers of curves, each at least 1; NULL if each loop is one closed curve.
 * trim_count:   number of loops, at least 1; the outer one first, unless they are added.
 * options:      NULL for the defaults.
 * out_report:   receives how near the trims are to the curves; NULL for no report.
 * Arrays: curves[*], curve_counts[trim_count].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NOT_PROVEN (some places are not proved to be nearest, as on a D1RC-spline) or
 * an error: PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option, no loops, a loop without curves, a
 * dimension, a gap, or a curve farther from the surface than the tolerance; the index is the curve, or the loop without
 * curves), PLANISH_STATUS_TOPOLOGY (a seam or a fold of the surface is in the way of a curve, the index is the curve; or
 * trims meet, the index is the trim), PLANISH_STATUS_DEGENERATE (a loop is no polygon, the index is the loop),
 * PLANISH_STATUS_WRONG_KIND, PLANISH_STATUS_TOO_LARGE, PLANISH_STATUS_OUT_OF_MEMORY, PLANISH_STATUS_VERSION or
 * PLANISH_STATUS_CANCELLED.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_surface_trim_by_curves(struct planish_surface *surface,
                                                   const struct planish_curve *const *curves,
                                                   const size_t *curve_counts,
                                                   size_t trim_count,
                                                   const struct planish_trim_options *options,
                                                   struct planish_trim_report *out_report);

/**
 * Number of Bezier patches of a surface: they cover the domain without overlap and are the surface exactly. 0
 * for NULL and for a family that is not polynomial on rectangles.
 */
PLANISH_API size_t planish_surface_patch_count(const struct planish_surface *surface);

/**
 * The number of the patch over a parameter pair; beyond the domain the one whose polynomial is continued there.
 * 0 for NULL and for a family without patches.
 */
PLANISH_API
size_t planish_surface_patch_at(const struct planish_surface *surface,
                                double u,
                                double v);

/**
 * Copies a Bezier patch.
 *
 * surface:       not NULL.
 * index:         below planish_surface_patch_count().
 * out_patch:     receives rectangle, degrees and sizes; NULL for none.
 * out_ordinates: receives the patch's ordinate_count rows of ordinate_width numbers, v running fastest; NULL for
 *                none: ask for the sizes first.
 * count:         rows that out_ordinates has room for.
 * Arrays: out_ordinates[out_patch.ordinate_count, out_patch.ordinate_width].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INDEX, PLANISH_STATUS_WRONG_KIND (the
 * family has no patches), PLANISH_STATUS_INVALID_ARGUMENT (struct_size) or PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_surface_copy_patch(const struct planish_surface *surface,
                                               size_t index,
                                               struct planish_patch *out_patch,
                                               double *out_ordinates,
                                               size_t count);

/**
 * Fills options with the defaults.
 *
 * options:     struct_size writable bytes.
 * struct_size: sizeof(planish_convert_options).
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INVALID_ARGUMENT (struct_size).
 */
PLANISH_API
enum planish_status planish_convert_options_init(struct planish_convert_options *options,
                                                 size_t struct_size);

/**
 * Makes a tensor surface that is the same surface exactly, with the same trims. A surface with local refinement
 * may need far more control points as a tensor surface.
 *
 * surface:     not NULL.
 * options:     NULL for the defaults.
 * out_surface: receives a new surface; destroy with planish_surface_free().
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option),
 * PLANISH_STATUS_WRONG_KIND (the family is not polynomial on rectangles), PLANISH_STATUS_TOO_LARGE (more than
 * max_coefficients control points) or PLANISH_STATUS_VERSION.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_surface_to_tensor(const struct planish_surface *surface,
                                              const struct planish_convert_options *options,
                                              struct planish_surface **out_surface);

/**
 * Fills options with the defaults.
 *
 * options:     struct_size writable bytes.
 * struct_size: sizeof(planish_tensor_options).
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INVALID_ARGUMENT (struct_size).
 */
PLANISH_API
enum planish_status planish_tensor_options_init(struct planish_tensor_options *options,
                                                size_t struct_size);

/**
 * Fits a bicubic surface to the shape of a mesh, within a tolerance if the limits allow it. A mesh without
 * parameters is parameterized first, which changes nothing in the mesh. The boundary loops become trims.
 *
 * mesh:        not NULL.
 * options:     NULL for the defaults.
 * out_surface: receives a new surface of dim 3; destroy with planish_surface_free().
 * out_report:  receives what the fit did and how good it is; NULL for no report.
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_FOLDED_PARAMETERS, PLANISH_STATUS_TOLERANCE_NOT_MET,
 * PLANISH_STATUS_STAGNATED (all three with the best surface found) or an error: PLANISH_STATUS_NULL_POINTER,
 * PLANISH_STATUS_INVALID_ARGUMENT (an option, or fewer than 3 data; fixed data or sides that contradict each other; a side
 * that is not where the data are; a mesh that is not symmetric), PLANISH_STATUS_INDEX (a fixed datum that does not
 * exist), PLANISH_STATUS_NOT_FINITE (a weight or a tolerance; the index is the datum), PLANISH_STATUS_TOPOLOGY (a plane
 * of symmetry that does not cut the mesh in two), PLANISH_STATUS_DEGENERATE (all data have the same u or the same v),
 * PLANISH_STATUS_SINGULAR (the data do not determine a surface), PLANISH_STATUS_VERSION or
 * PLANISH_STATUS_CANCELLED; for a mesh without parameters also what planish_mesh_parameterize() returns.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_tensor_fit(const struct planish_mesh *mesh,
                                       const struct planish_tensor_options *options,
                                       struct planish_surface **out_surface,
                                       struct planish_fit_report *out_report);

/**
 * Fits a bicubic surface to values at scattered parameters.
 *
 * uv:          count rows of u, v.
 * values:      count rows of dim numbers.
 * count:       at least 3.
 * dim:         numbers of a value, at least 1.
 * options:     NULL for the defaults; parameterize and regularize are not used, and refused unless they are at
 *              their defaults.
 * out_surface: receives a new surface; destroy with planish_surface_free().
 * out_report:  receives what the fit did and how good it is; NULL for no report.
 * Arrays: uv[count, 2], values[count, dim].
 * Returns what planish_tensor_fit() returns; PLANISH_STATUS_NOT_FINITE also for uv and values (the index is
 * the datum), PLANISH_STATUS_TOO_LARGE (count times dim) and PLANISH_STATUS_OUT_OF_MEMORY.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_tensor_fit_points(const double *uv,
                                              const double *values,
                                              size_t count,
                                              size_t dim,
                                              const struct planish_tensor_options *options,
                                              struct planish_surface **out_surface,
                                              struct planish_fit_report *out_report);

/**
 * Fits a bicubic surface to values on the nodes of a mesh, over the same parameters as its shape.
 *
 * mesh:        not NULL.
 * values:      count rows of dim numbers.
 * count:       planish_mesh_point_count(), or planish_mesh_triangle_count() for values that are taken at the centroids of
 *              the triangles; a datum is then a triangle.
 * dim:         numbers of a value, at least 1.
 * options:     NULL for the defaults.
 * out_surface: receives a new surface; destroy with planish_surface_free().
 * out_report:  receives what the fit did and how good it is; NULL for no report.
 * Arrays: values[count, dim].
 * Returns what planish_tensor_fit() returns; PLANISH_STATUS_INVALID_ARGUMENT also for count,
 * PLANISH_STATUS_NOT_FINITE also for values (the index is the node), and PLANISH_STATUS_TOO_LARGE.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_tensor_fit_field(const struct planish_mesh *mesh,
                                             const double *values,
                                             size_t count,
                                             size_t dim,
                                             const struct planish_tensor_options *options,
                                             struct planish_surface **out_surface,
                                             struct planish_fit_report *out_report);

/**
 * Makes a tensor surface from its parts, which are copied.
 *
 * dim:            numbers of a control point, at least 1.
 * degree_u:       1 to 9.
 * degree_v:       1 to 9.
 * knots_u:        knot_count_u knots that do not decrease, none more than degree_u + 1 times.
 * knot_count_u:   at least 2 * (degree_u + 1); there are knot_count_u - degree_u - 1 control points along u.
 * knots_v:        knot_count_v knots that do not decrease, none more than degree_v + 1 times.
 * knot_count_v:   at least 2 * (degree_v + 1); there are knot_count_v - degree_v - 1 control points along v.
 * control_points: rows of dim numbers, v running fastest, not multiplied by weights.
 * weights:        one positive number for each control point in the same order; NULL for a polynomial surface.
 * out_surface:    receives a new surface; destroy with planish_surface_free().
 * Arrays: knots_u[knot_count_u], knots_v[knot_count_v],
 *         control_points[knot_count_u - degree_u - 1, knot_count_v - degree_v - 1, dim],
 *         weights[knot_count_u - degree_u - 1, knot_count_v - degree_v - 1].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (dim, a degree, a
 * count, a knot, a weight; the index is the knot or the control point), PLANISH_STATUS_NOT_FINITE (likewise),
 * PLANISH_STATUS_DEGENERATE (the knots span no interval), PLANISH_STATUS_TOO_LARGE or
 * PLANISH_STATUS_OUT_OF_MEMORY.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_tensor_new(size_t dim,
                                       uint32_t degree_u,
                                       uint32_t degree_v,
                                       const double *knots_u,
                                       size_t knot_count_u,
                                       const double *knots_v,
                                       size_t knot_count_v,
                                       const double *control_points,
                                       const double *weights,
                                       struct planish_surface **out_surface);

/**
 * Degree of a tensor surface; 0 for NULL, another family or an axis that does not exist.
 *
 * axis: a planish_axis.
 */
PLANISH_API uint32_t planish_tensor_degree(const struct planish_surface *surface, uint32_t axis);

/**
 * Number of knots of a tensor surface, each as often as it occurs; 0 for NULL, another family or an axis that
 * does not exist.
 *
 * axis: a planish_axis.
 */
PLANISH_API size_t planish_tensor_knot_count(const struct planish_surface *surface, uint32_t axis);

/**
 * Number of control points of a tensor surface along one axis; 0 for NULL, another family or an axis that does
 * not exist. planish_surface_coefficient_count() is the product of both.
 *
 * axis: a planish_axis.
 */
PLANISH_API
size_t planish_tensor_control_point_count(const struct planish_surface *surface,
                                          uint32_t axis);

/**
 * Copies the knots of a tensor surface.
 *
 * surface:   not NULL.
 * axis:      a planish_axis.
 * out_knots: receives planish_tensor_knot_count() knots.
 * count:     knots that out_knots has room for.
 * Arrays: out_knots[tensor_knot_count].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (the axis),
 * PLANISH_STATUS_WRONG_KIND or PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_tensor_copy_knots(const struct planish_surface *surface,
                                              uint32_t axis,
                                              double *out_knots,
                                              size_t count);

/**
 * Copies the control points of a tensor surface.
 *
 * surface:            not NULL.
 * out_control_points: receives planish_surface_coefficient_count() rows of dim numbers, v running fastest, not
 *                     multiplied by weights.
 * count:              rows that out_control_points has room for.
 * Arrays: out_control_points[surface_coefficient_count, surface_dim].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND or
 * PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_tensor_copy_control_points(const struct planish_surface *surface,
                                                       double *out_control_points,
                                                       size_t count);

/**
 * 1 if a tensor surface has weights, else 0; 0 for NULL and other families.
 */
PLANISH_API uint32_t planish_tensor_has_weights(const struct planish_surface *surface);

/**
 * Copies the weights of a tensor surface; all are 1 if it is polynomial.
 *
 * surface:     not NULL.
 * out_weights: receives planish_surface_coefficient_count() weights, in the order of the control points.
 * count:       weights that out_weights has room for.
 * Arrays: out_weights[surface_coefficient_count].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND or
 * PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_tensor_copy_weights(const struct planish_surface *surface,
                                                double *out_weights,
                                                size_t count);

/**
 * Inserts knots into a tensor surface, which stays the same surface.
 *
 * surface: not NULL; changed.
 * axis:    a planish_axis.
 * knots:   count parameters in the domain, in any order. Inside the domain no knot may occur more than degree
 *          times afterwards; at its ends degree + 1 times, which clamps.
 * count:   may be 0.
 * Arrays: knots[count].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND,
 * PLANISH_STATUS_INVALID_ARGUMENT (the axis, or a knot would occur too often), PLANISH_STATUS_NOT_FINITE (the
 * index is that of knots) or PLANISH_STATUS_OUTSIDE.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_tensor_insert_knots(struct planish_surface *surface,
                                                uint32_t axis,
                                                const double *knots,
                                                size_t count);

/**
 * Raises the degree of a tensor surface along one axis, which stays the same surface.
 *
 * surface: not NULL; changed.
 * axis:    a planish_axis.
 * degree:  from the present degree to 9.
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND or
 * PLANISH_STATUS_INVALID_ARGUMENT (the axis, the degree).
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_tensor_elevate_degree(struct planish_surface *surface,
                                                  uint32_t axis,
                                                  uint32_t degree);

/**
 * Turns a tensor surface round along one axis: the same points over the same domain in the other direction, trims
 * included. Normals turn round.
 *
 * surface: not NULL; changed.
 * axis:    a planish_axis.
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND,
 * PLANISH_STATUS_INVALID_ARGUMENT (the axis) or PLANISH_STATUS_DEGENERATE (the domain is so short that it has no
 * length after rounding).
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_tensor_reverse(struct planish_surface *surface,
                                           uint32_t axis);

/**
 * Makes the two parts of a tensor surface below and above a parameter. Each keeps its side of the trims: a loop
 * that crosses the cut is closed along it, and a part beyond all loops gets one loop without area.
 *
 * surface:   not NULL.
 * axis:      a planish_axis: the parameter that is cut.
 * at:        inside the domain, not at its ends.
 * out_lower: receives a new surface; destroy with planish_surface_free().
 * out_upper: receives a new surface; destroy with planish_surface_free().
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND,
 * PLANISH_STATUS_INVALID_ARGUMENT (the axis) or PLANISH_STATUS_OUTSIDE (at, also if it is NaN).
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_tensor_split(const struct planish_surface *surface,
                                         uint32_t axis,
                                         double at,
                                         struct planish_surface **out_lower,
                                         struct planish_surface **out_upper);

/**
 * Fills options with the defaults.
 *
 * options:     struct_size writable bytes.
 * struct_size: sizeof(planish_field_options).
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INVALID_ARGUMENT (struct_size).
 */
PLANISH_API
enum planish_status planish_field_options_init(struct planish_field_options *options,
                                               size_t struct_size);

/**
 * Makes a fitter for fields on the nodes of a mesh, over its parameters or, if it has none, over those it is given
 * here. It keeps what it needs; the mesh may go.
 *
 * mesh:       not NULL.
 * options:    NULL for the defaults.
 * out_fitter: receives a new fitter; destroy with planish_field_fitter_free().
 * Returns PLANISH_STATUS_OK or an error: PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option, too
 * few nodes with values), PLANISH_STATUS_NOT_FINITE (a parameter, a weight, a value of sample_values; the index is the
 * node), PLANISH_STATUS_TOPOLOGY (a mesh without parameters that is no disk: a closed one must be cut open first),
 * PLANISH_STATUS_DEGENERATE (all nodes have the same u or v), PLANISH_STATUS_SINGULAR (the nodes do not determine a
 * surface), PLANISH_STATUS_CANCELLED or PLANISH_STATUS_VERSION.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_field_fitter_new(const struct planish_mesh *mesh,
                                             const struct planish_field_options *options,
                                             struct planish_field_fitter **out_fitter);

/**
 * Makes a fitter for fields at scattered parameters.
 *
 * uv:         count rows of u, v.
 * count:      at least 3.
 * options:    NULL for the defaults.
 * out_fitter: receives a new fitter; destroy with planish_field_fitter_free().
 * Arrays: uv[count, 2].
 * Returns what planish_field_fitter_new() returns, but for PLANISH_STATUS_TOPOLOGY.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_field_fitter_new_points(const double *uv,
                                                    size_t count,
                                                    const struct planish_field_options *options,
                                                    struct planish_field_fitter **out_fitter);

/**
 * Makes a fitter for fields on the nodes of the mesh that a model was fitted to: closed, of any genus, several
 * components. Fields are fitted over the patches of the model by planish_field_fitter_fit_model(), on the cells that the
 * shape needed, or on cells that are split until sample_values keep the tolerance. It keeps what it needs; model and
 * mesh may go.
 *
 * model:      not NULL, made by planish_model_fit() of patches, or a copy of such a model.
 * mesh:       not NULL, with as many nodes as planish_model_node_count(): the mesh, perhaps moved.
 * options:    NULL for the defaults; grid_u and grid_v must be 0, buffer, ends, energy and parameterize are not used.
 * out_fitter: receives a new fitter; destroy with planish_field_fitter_free().
 * Returns PLANISH_STATUS_OK or an error: PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND (the model was not
 * fitted, is one chart, or has a face that is no part of a patch), PLANISH_STATUS_INVALID_ARGUMENT (an option, the number
 * of nodes, too few nodes with values), PLANISH_STATUS_NOT_FINITE (a weight, a value of sample_values; the index is the
 * node), PLANISH_STATUS_SINGULAR, PLANISH_STATUS_CANCELLED or PLANISH_STATUS_VERSION.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_field_fitter_new_model(const struct planish_model *model,
                                                   const struct planish_mesh *mesh,
                                                   const struct planish_field_options *options,
                                                   struct planish_field_fitter **out_fitter);

/**
 * Destroys a fitter.
 *
 * fitter: from this library and not destroyed yet; NULL does nothing.
 */
PLANISH_API void planish_field_fitter_free(struct planish_field_fitter *fitter);

/**
 * Number of nodes, those without values included; 0 for NULL.
 */
PLANISH_API size_t planish_field_fitter_point_count(const struct planish_field_fitter *fitter);

/**
 * Knots of the grid.
 *
 * fitter:   not NULL.
 * out_grid: receives 2 numbers: knots along u and v.
 * Arrays: out_grid[2].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_WRONG_KIND (of
 * planish_field_fitter_new_model()).
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_field_fitter_grid(const struct planish_field_fitter *fitter,
                                              size_t *out_grid);

/**
 * Copies the (u,v) of the nodes.
 *
 * fitter: not NULL.
 * out_uv: receives planish_field_fitter_point_count() rows of u, v.
 * count:  rows that out_uv has room for.
 * Arrays: out_uv[field_fitter_point_count, 2].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND (of
 * planish_field_fitter_new_model()) or PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_field_fitter_copy_parameters(const struct planish_field_fitter *fitter,
                                                         double *out_uv,
                                                         size_t count);

/**
 * Fits a field.
 *
 * fitter:      not NULL.
 * values:      count rows of dim numbers, one a node.
 * count:       planish_field_fitter_point_count().
 * dim:         numbers of a value, at least 1.
 * out_surface: receives a new surface over the (u,v) of the nodes; destroy with planish_surface_free().
 * out_report:  receives how good it is, measured on the surface; NULL for no report, which saves the measuring.
 * Arrays: values[count, dim].
 * Returns PLANISH_STATUS_OK, with a report also PLANISH_STATUS_TOLERANCE_NOT_MET, or an error:
 * PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND (of planish_field_fitter_new_model()),
 * PLANISH_STATUS_INVALID_ARGUMENT (count, dim), PLANISH_STATUS_NOT_FINITE (the index is the node),
 * PLANISH_STATUS_SINGULAR (numbers overflow) or PLANISH_STATUS_TOO_LARGE.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_field_fitter_fit(const struct planish_field_fitter *fitter,
                                             const double *values,
                                             size_t count,
                                             size_t dim,
                                             struct planish_surface **out_surface,
                                             struct planish_fit_report *out_report);

/**
 * Fits a field over the patches of a model. The result is a model of dimension dim with the same faces: a value for each
 * place of a face, with one gradient along the shape on both sides of every edge. planish_model_eval(),
 * planish_model_field_gradient(), planish_model_copy_face(), copies and files are for it too.
 *
 * fitter:     not NULL, of planish_field_fitter_new_model().
 * values:     count rows of dim numbers, one a node.
 * count:      planish_field_fitter_point_count().
 * dim:        numbers of a value, at least 1.
 * out_field:  receives a new model of dimension dim; destroy with planish_model_free().
 * out_report: receives how good it is, measured on the field; NULL for no report, which saves the measuring.
 * Arrays: values[count, dim].
 * Returns PLANISH_STATUS_OK, with a report also PLANISH_STATUS_TOLERANCE_NOT_MET, or an error:
 * PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND (a fitter over a parameter plane),
 * PLANISH_STATUS_INVALID_ARGUMENT (count, dim), PLANISH_STATUS_NOT_FINITE (the index is the node),
 * PLANISH_STATUS_SINGULAR (numbers overflow) or PLANISH_STATUS_TOO_LARGE.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_field_fitter_fit_model(const struct planish_field_fitter *fitter,
                                                   const double *values,
                                                   size_t count,
                                                   size_t dim,
                                                   struct planish_model **out_field,
                                                   struct planish_fit_report *out_report);

/**
 * Turns a surface of planish_field_fitter_fit() into the one of other values, in its place. Once a field of this dim
 * has been fitted, no memory is asked for that grows with nodes or grid.
 *
 * fitter:  not NULL.
 * surface: from this fitter, or of the same grid; changed.
 * values:  count rows of dim numbers, one a node.
 * count:   planish_field_fitter_point_count().
 * dim:     planish_surface_dim() of the surface.
 * Arrays: values[count, dim].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND, PLANISH_STATUS_INVALID_ARGUMENT
 * (count, dim, a surface of another grid), PLANISH_STATUS_NOT_FINITE (the index is the node) or
 * PLANISH_STATUS_SINGULAR (numbers overflow).
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_field_fitter_update(const struct planish_field_fitter *fitter,
                                                struct planish_surface *surface,
                                                const double *values,
                                                size_t count,
                                                size_t dim);

/**
 * The sum of tensor surfaces, each times a factor, exactly: a shape and its displacements, modes and their factors.
 * All are polynomial, over the same domain and of the same dim; degrees and knots may differ.
 *
 * surfaces:    count surfaces.
 * factors:     count factors; NULL for all 1.
 * count:       at least 1.
 * out_surface: receives a new surface with the trims of the first; destroy with planish_surface_free().
 * Arrays: surfaces[count], factors[count].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND, PLANISH_STATUS_INVALID_ARGUMENT
 * (count, or a surface does not fit the first; the index is the surface) or PLANISH_STATUS_NOT_FINITE (a factor, or
 * the sum overflows; the index is the factor).
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_tensor_combine(const struct planish_surface *const *surfaces,
                                           const double *factors,
                                           size_t count,
                                           struct planish_surface **out_surface);

/**
 * Fills options with the defaults.
 *
 * options:     struct_size writable bytes.
 * struct_size: sizeof(planish_gradient_options).
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INVALID_ARGUMENT (struct_size).
 */
PLANISH_API
enum planish_status planish_gradient_options_init(struct planish_gradient_options *options,
                                                  size_t struct_size);

/**
 * The gradient in space of a field over the parameters of a shape: for each component the vector, tangential to the
 * shape, that gives its change along the shape.
 *
 * shape:         not NULL, of dimension 3.
 * field:         not NULL, over the same (u,v).
 * uv:            count rows of u, v, inside both domains; rows start options->uv_stride doubles apart.
 * count:         may be 0.
 * options:       NULL for the defaults.
 * out_gradients: receives count times dim rows of 3 numbers, dim being that of the field; NaN where the shape has no
 *                tangent plane.
 * Arrays: uv[count, 2], out_gradients[count, surface_dim, 3].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (the dimension of shape,
 * an option), PLANISH_STATUS_NOT_FINITE, PLANISH_STATUS_OUTSIDE (the index is the point for both),
 * PLANISH_STATUS_TOO_LARGE or PLANISH_STATUS_VERSION.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_surface_field_gradient(const struct planish_surface *shape,
                                                   const struct planish_surface *field,
                                                   const double *uv,
                                                   size_t count,
                                                   const struct planish_gradient_options *options,
                                                   double *out_gradients);

/**
 * Fills options with the defaults.
 *
 * options:     struct_size writable bytes.
 * struct_size: sizeof(planish_smooth_options).
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INVALID_ARGUMENT (struct_size).
 */
PLANISH_API
enum planish_status planish_smooth_options_init(struct planish_smooth_options *options,
                                                size_t struct_size);

/**
 * Makes one smooth model of four-sided patches that meet edge to edge within a tolerance: tensor surfaces of any degree,
 * over their whole domains. The patches of the model share position and tangent plane along all their edges to rounding;
 * the report says how far they are from the given ones, and how far those were apart. Patches that look the other way than
 * their neighbours are turned; several pieces become several shells, closed ones solids.
 *
 * surfaces:   count tensor surfaces in space without trims; they stay as they are.
 * count:      at least 1.
 * options:    NULL for the defaults.
 * out_model:  receives a new model; destroy with planish_model_free().
 * out_report: receives what became of the patches; NULL for no report.
 * Arrays: surfaces[count].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_TOLERANCE_NOT_MET or PLANISH_STATUS_STAGNATED (the best model found is
 * there), or an error: PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option, no patches, a dimension
 * that is not 3, trims; the index is the patch), PLANISH_STATUS_WRONG_KIND (no tensor surface),
 * PLANISH_STATUS_DEGENERATE (a side without length; the index is the patch), PLANISH_STATUS_TOPOLOGY (a third side at an
 * edge, a corner inside a side, a patch that meets itself, a one-sided surface: the index is the patch; an inner vertex
 * of two patches), PLANISH_STATUS_SINGULAR, PLANISH_STATUS_CANCELLED or PLANISH_STATUS_VERSION.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_model_smooth_from_patches(const struct planish_surface *const *surfaces,
                                                      size_t count,
                                                      const struct planish_smooth_options *options,
                                                      struct planish_model **out_model,
                                                      struct planish_smooth_report *out_report);

/**
 * Fills options with the defaults.
 *
 * options:     struct_size writable bytes.
 * struct_size: sizeof(planish_transfer_options).
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INVALID_ARGUMENT (struct_size).
 */
PLANISH_API
enum planish_status planish_transfer_options_init(struct planish_transfer_options *options,
                                                  size_t struct_size);

/**
 * Makes a transfer from the nodes of a mesh to points near it. The points of the mesh are fitted by a surface over its
 * parameters or, if it has none, over those it is given here; each target is projected onto that once, inside the
 * mesh's boundary. It keeps what it needs; mesh and points may go.
 *
 * source:       not NULL.
 * targets:      count rows of x, y, z.
 * count:        may be 0.
 * options:      NULL for the defaults.
 * out_transfer: receives a new transfer; destroy with planish_transfer_free().
 * out_report:   receives how well the two lie on one another; NULL for no report.
 * Arrays: targets[count, 3].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_POINTS_OUTSIDE (targets beyond max_distance were kept), or an error:
 * PLANISH_STATUS_OUTSIDE (a target lies beyond it; the index is the target), PLANISH_STATUS_NOT_FINITE (a target; the
 * index), PLANISH_STATUS_INVALID_ARGUMENT (an option), or what planish_field_fitter_new() returns.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_transfer_new(const struct planish_mesh *source,
                                         const double *targets,
                                         size_t count,
                                         const struct planish_transfer_options *options,
                                         struct planish_transfer **out_transfer,
                                         struct planish_transfer_report *out_report);

/**
 * Makes a transfer from the nodes of the mesh that a model was fitted to, closed and of any genus, to points near it.
 * Fields are those of planish_field_fitter_new_model(): the points of the mesh are fitted over the patches of the model,
 * and each target is projected onto that shape once. It keeps what it needs; model, mesh and points may go.
 *
 * model:        not NULL, made by planish_model_fit() of patches, or a copy of such a model.
 * source:       not NULL, with as many nodes as planish_model_node_count(): the mesh, perhaps moved.
 * targets:      count rows of x, y, z.
 * count:        may be 0.
 * options:      NULL for the defaults.
 * out_transfer: receives a new transfer; destroy with planish_transfer_free().
 * out_report:   receives how well the two lie on one another, with 0 for the grid; NULL for no report.
 * Arrays: targets[count, 3].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_POINTS_OUTSIDE (targets beyond max_distance were kept), or an error:
 * PLANISH_STATUS_OUTSIDE (a target lies beyond it; the index is the target), PLANISH_STATUS_NOT_FINITE (a target; the
 * index), PLANISH_STATUS_INVALID_ARGUMENT (an option), or what planish_field_fitter_new_model() returns.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_transfer_new_model(const struct planish_model *model,
                                               const struct planish_mesh *source,
                                               const double *targets,
                                               size_t count,
                                               const struct planish_transfer_options *options,
                                               struct planish_transfer **out_transfer,
                                               struct planish_transfer_report *out_report);

/**
 * Destroys a transfer.
 *
 * transfer: from this library and not destroyed yet; NULL does nothing.
 */
PLANISH_API void planish_transfer_free(struct planish_transfer *transfer);

/**
 * Number of nodes of the source, those without values included; 0 for NULL.
 */
PLANISH_API size_t planish_transfer_source_count(const struct planish_transfer *transfer);

/**
 * Number of targets; 0 for NULL.
 */
PLANISH_API size_t planish_transfer_target_count(const struct planish_transfer *transfer);

/**
 * Copies where the targets lie on the source's surface.
 *
 * transfer: not NULL.
 * out_uv:   receives planish_transfer_target_count() rows of u, v.
 * count:    rows that out_uv has room for.
 * Arrays: out_uv[transfer_target_count, 2].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND (of planish_transfer_new_model()) or
 * PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_transfer_copy_parameters(const struct planish_transfer *transfer,
                                                     double *out_uv,
                                                     size_t count);

/**
 * Copies how far the targets are from the source's surface.
 *
 * transfer:      not NULL.
 * out_distances: receives planish_transfer_target_count() distances.
 * count:         distances that out_distances has room for.
 * Arrays: out_distances[transfer_target_count].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_transfer_copy_distances(const struct planish_transfer *transfer,
                                                    double *out_distances,
                                                    size_t count);

/**
 * Values at the targets, from values at the nodes of the source: they are fitted, and the fit is evaluated where the
 * targets lie. A constant arrives as it is.
 *
 * transfer:   not NULL.
 * values:     count rows of dim numbers, one a node.
 * count:      planish_transfer_source_count().
 * dim:        numbers of a value, at least 1.
 * out_values: receives planish_transfer_target_count() rows of dim numbers; it must not overlap values.
 * Arrays: values[count, dim], out_values[transfer_target_count, dim].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (count, dim),
 * PLANISH_STATUS_NOT_FINITE (the index is the node) or PLANISH_STATUS_TOO_LARGE.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_transfer_apply(const struct planish_transfer *transfer,
                                           const double *values,
                                           size_t count,
                                           size_t dim,
                                           double *out_values);

/**
 * Forces at the nodes of the source, from forces on the targets: the transpose of planish_transfer_apply(), so that
 * both do the same work; the sum of the forces stays.
 *
 * transfer:   not NULL.
 * forces:     count rows of dim numbers, one a target.
 * count:      planish_transfer_target_count().
 * dim:        numbers of a force, at least 1.
 * out_forces: receives planish_transfer_source_count() rows of dim numbers, 0 for nodes without values; it must not
 *             overlap forces.
 * Arrays: forces[count, dim], out_forces[transfer_source_count, dim].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (count, dim),
 * PLANISH_STATUS_NOT_FINITE (the index is the target) or PLANISH_STATUS_TOO_LARGE.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_transfer_apply_transpose(const struct planish_transfer *transfer,
                                                     const double *forces,
                                                     size_t count,
                                                     size_t dim,
                                                     double *out_forces);

/**
 * Carries displacements one way and forces the other, and adds up forces, moments and work on both sides.
 *
 * transfer:      not NULL.
 * displacements: source_count rows of 3 numbers, one a node of the source.
 * source_count:  planish_transfer_source_count().
 * forces:        target_count rows of 3 numbers, one a target.
 * target_count:  planish_transfer_target_count().
 * about:         3 numbers: the point that moments are about; NULL for the origin.
 * out_report:    not NULL; receives the sums.
 * Arrays: displacements[source_count, 3], forces[target_count, 3], about[3].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (a count),
 * PLANISH_STATUS_NOT_FINITE (the index is the node or the target) or PLANISH_STATUS_TOO_LARGE.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_transfer_balance(const struct planish_transfer *transfer,
                                             const double *displacements,
                                             size_t source_count,
                                             const double *forces,
                                             size_t target_count,
                                             const double *about,
                                             struct planish_balance_report *out_report);

/**
 * Fills options with the defaults.
 *
 * options:     struct_size writable bytes.
 * struct_size: sizeof(planish_tessellate_options).
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INVALID_ARGUMENT (struct_size).
 */
PLANISH_API
enum planish_status planish_tessellate_options_init(struct planish_tessellate_options *options,
                                                    size_t struct_size);

/**
 * Makes a triangle mesh of a surface in space. Its nodes lie on the surface and carry their (u,v) as
 * parameters; the trims become its boundary loops.
 *
 * surface:  not NULL, of dimension 3.
 * options:  NULL for the defaults.
 * out_mesh: receives a new mesh; destroy with planish_mesh_free().
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option, or the
 * dimension), PLANISH_STATUS_TOPOLOGY (the trims cross), PLANISH_STATUS_DEGENERATE (they enclose no area),
 * PLANISH_STATUS_TOO_LARGE (more than max_point_count nodes) or PLANISH_STATUS_VERSION.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_surface_tessellate(const struct planish_surface *surface,
                                               const struct planish_tessellate_options *options,
                                               struct planish_mesh **out_mesh);

/**
 * Fills options with the defaults.
 *
 * options:     struct_size writable bytes.
 * struct_size: sizeof(planish_project_options).
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INVALID_ARGUMENT (struct_size).
 */
PLANISH_API
enum planish_status planish_project_options_init(struct planish_project_options *options,
                                                 size_t struct_size);

/**
 * Finds the place on a surface nearest to each point, inside its trims unless the options say otherwise.
 *
 * On tensor surfaces, T-splines and PHT-splines the answer is the nearest of all places: there is no start to
 * choose, and no local minimum to fall into. Should a search end without a proof (it takes a continuum of places
 * that are nearest but for roundoff, such as a tube seen from its axis), the point is flagged. D1RC-splines are
 * searched from the nearest place of a tessellation: the answer is a local minimum, each point that does not lie on
 * the surface is flagged, and the call returns PLANISH_STATUS_NOT_PROVEN.
 *
 * The first call for a surface builds an index that later calls use; points may be given one at a time.
 *
 * surface:       not NULL.
 * points:        count rows of planish_surface_dim() doubles.
 * count:         number of points; with 0 nothing is done.
 * options:       NULL for the defaults.
 * out_uv:        receives count rows u, v; NULL for none.
 * out_distances: receives count distances; NULL for none.
 * Arrays: points[count, surface_dim], out_uv[count, 2], out_distances[count].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_POINTS_OUTSIDE (some points are farther than max_distance),
 * PLANISH_STATUS_NOT_PROVEN (some answers are flagged), PLANISH_STATUS_NULL_POINTER,
 * PLANISH_STATUS_NOT_FINITE (the index is the point),
 * PLANISH_STATUS_INVALID_ARGUMENT, PLANISH_STATUS_WRONG_KIND, PLANISH_STATUS_TOO_LARGE or
 * PLANISH_STATUS_VERSION.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_surface_project(const struct planish_surface *surface,
                                            const double *points,
                                            size_t count,
                                            const struct planish_project_options *options,
                                            double *out_uv,
                                            double *out_distances);

/**
 * Fills options with the defaults.
 *
 * options:     struct_size writable bytes.
 * struct_size: sizeof(planish_deviation_options).
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INVALID_ARGUMENT (struct_size).
 */
PLANISH_API
enum planish_status planish_deviation_options_init(struct planish_deviation_options *options,
                                                   size_t struct_size);

/**
 * Measures how far the nodes of a mesh lie from a surface in space: closest-point distances, as
 * planish_surface_project() finds them.
 *
 * surface:       not NULL, of dimension 3.
 * mesh:          not NULL.
 * options:       NULL for the defaults; out_faces must be NULL.
 * out_distances: receives planish_mesh_point_count() distances; NULL for none.
 * count:         doubles that out_distances has room for.
 * out_report:    receives the sizes of the distances; NULL for none.
 * Arrays: out_distances[count].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NOT_PROVEN (some distances are not proved to be the least ones, as
 * to a D1RC-spline), PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option, or the
 * dimension), PLANISH_STATUS_BUFFER_TOO_SMALL, PLANISH_STATUS_WRONG_KIND, PLANISH_STATUS_TOPOLOGY or
 * PLANISH_STATUS_TOO_LARGE (measuring back only), or PLANISH_STATUS_VERSION.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_surface_deviation(const struct planish_surface *surface,
                                              const struct planish_mesh *mesh,
                                              const struct planish_deviation_options *options,
                                              double *out_distances,
                                              size_t count,
                                              struct planish_deviation_report *out_report);

/**
 * Finds the place on a mesh nearest to each point, and the triangle that it lies on.
 *
 * For points of a model this is the way back to the mesh that it was fitted to: evaluate the model where you want to
 * know, with planish_model_eval(), and ask here for the triangle, and so for the label, that the place came from. That
 * holds for a face of several labels too, of which planish_face_info tells only one. A place no farther from a line
 * between labels, or from the other side of a wall, than from its own triangle may get either.
 *
 * Each call sorts the triangles before it searches them: ask for many points at once.
 *
 * mesh:          not NULL.
 * points:        count rows of x, y, z.
 * count:         number of points; with 0 nothing is done.
 * options:       NULL for the defaults; guesses and out_flags must be NULL, keep_trims 1.
 * out_triangles: receives the triangle of each, counted from 0, one of them where several are equally near;
 *                PLANISH_NONE for points farther away than max_distance, or farther than a double can square. NULL for
 *                none.
 * out_points:    receives count rows of x, y, z, the nearest places, NaN for such points; NULL for none.
 * out_distances: receives count distances in model units, NaN for such points; NULL for none.
 * Arrays: points[count, 3], out_triangles[count], out_points[count, 3], out_distances[count].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_POINTS_OUTSIDE (there are such points), or an error:
 * PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_NOT_FINITE (the index is the point), PLANISH_STATUS_INVALID_ARGUMENT (an
 * option), PLANISH_STATUS_TOO_LARGE, PLANISH_STATUS_OUT_OF_MEMORY, PLANISH_STATUS_VERSION or PLANISH_STATUS_CANCELLED.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_mesh_project(const struct planish_mesh *mesh,
                                         const double *points,
                                         size_t count,
                                         const struct planish_project_options *options,
                                         uint32_t *out_triangles,
                                         double *out_points,
                                         double *out_distances);

/**
 * Fills options with the defaults.
 *
 * options:     struct_size writable bytes.
 * struct_size: sizeof(planish_sample_rows_options).
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INVALID_ARGUMENT (struct_size).
 */
PLANISH_API
enum planish_status planish_sample_rows_options_init(struct planish_sample_rows_options *options,
                                                     size_t struct_size);

/**
 * Takes closed rows of points from a mesh: level curves of a harmonic field between two loops or nodes, which all
 * start on one seam along the field's gradient and run the same way; ready for planish_tspline_skin() with closed.
 * Call it once without out_points for the counts, then with room for all points.
 *
 * mesh:            not NULL, in one piece.
 * options:         NULL for the defaults: rows from the first loop to the second.
 * out_row_counts:  receives the number of points of each row, which does not repeat its first.
 * row_count:       rows to take, 1 to 1000000.
 * out_points:      receives rows of x, y, z, row after row; NULL to learn the counts only.
 * point_count:     points that out_points has room for.
 * out_point_count: receives the number of points of all rows.
 * Arrays: out_row_counts[row_count], out_points[point_count, 3], out_point_count[1].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option, the number of
 * rows, or both sources share a node, which is the index), PLANISH_STATUS_INDEX (no such loop or node),
 * PLANISH_STATUS_TOPOLOGY (the mesh has several pieces; or a row is not one closed curve, as on a mesh with handles or
 * further loops: the index is the row), PLANISH_STATUS_SINGULAR (the field is lost in rounding),
 * PLANISH_STATUS_BUFFER_TOO_SMALL, PLANISH_STATUS_VERSION or PLANISH_STATUS_CANCELLED.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_mesh_sample_rows(const struct planish_mesh *mesh,
                                             const struct planish_sample_rows_options *options,
                                             size_t *out_row_counts,
                                             size_t row_count,
                                             double *out_points,
                                             size_t point_count,
                                             size_t *out_point_count);

/**
 * The box of a surface over its whole domain, whatever its trims.
 *
 * surface: not NULL.
 * out_box: receives dim numbers, the least of each component, then the largest of each. Of a D1RC-spline it is the box of
 *          places on it, a few for each face.
 * Arrays: out_box[2, surface_dim].
 * Returns PLANISH_STATUS_OK or PLANISH_STATUS_NULL_POINTER.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_surface_box(const struct planish_surface *surface,
                                        double *out_box);

/**
 * The area of the part of a surface in space that is inside its trims.
 *
 * surface:  not NULL, of dim 3.
 * options:  how finely the surface is divided, which matters little: pieces are integrated along the surface. NULL for
 *           the defaults; out_report is not looked at.
 * out_area: receives the area, in squares of model units.
 * Arrays: out_area[1].
 * Returns PLANISH_STATUS_OK or what planish_surface_tessellate() returns.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_surface_area(const struct planish_surface *surface,
                                         const struct planish_tessellate_options *options,
                                         double *out_area);

/**
 * 1 if the sides of the domain at the least and the largest parameter of an axis are one curve, as those of a tube are; 0
 * if not, for NULL, for an axis that is none, and for a D1RC-spline, whose domain has no sides.
 *
 * axis: a planish_axis.
 */
PLANISH_API
uint32_t planish_surface_is_closed(const struct planish_surface *surface,
                                   uint32_t axis);

/**
 * Fills options with the defaults.
 *
 * options:     struct_size writable bytes.
 * struct_size: sizeof(planish_fair_options).
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INVALID_ARGUMENT (struct_size).
 */
PLANISH_API
enum planish_status planish_fair_options_init(struct planish_fair_options *options,
                                              size_t struct_size);

/**
 * Makes a surface of less energy that stays within a tolerance of the surface, or of data: of the same family, over the
 * same knots or cells, with the same trims. For tensor surfaces and PHT-splines without weights.
 *
 * surface:     not NULL; stays as it is.
 * uv:          count rows of u, v in the domain, at which the surface is to stay near the data; NULL for no data: near
 *              itself.
 * values:      count rows of planish_surface_dim() numbers; NULL for no data.
 * count:       number of data; 0 for none.
 * options:     NULL for the defaults.
 * out_surface: receives a new surface; destroy with planish_surface_free().
 * out_report:  receives what was done; NULL for no report.
 * Arrays: uv[count, 2], values[count, surface_dim].
 * Returns PLANISH_STATUS_OK or an error: PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option; the
 * surface misses a datum by more than the tolerance, which is the index; or curvature jumps and its variation was
 * asked for), PLANISH_STATUS_NOT_FINITE (uv or values; the index is the datum), PLANISH_STATUS_OUTSIDE (the datum is
 * the index), PLANISH_STATUS_WRONG_KIND (the family, or weights), PLANISH_STATUS_SINGULAR, PLANISH_STATUS_TOO_LARGE,
 * PLANISH_STATUS_OUT_OF_MEMORY, PLANISH_STATUS_VERSION or PLANISH_STATUS_CANCELLED.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_surface_fair(const struct planish_surface *surface,
                                         const double *uv,
                                         const double *values,
                                         size_t count,
                                         const struct planish_fair_options *options,
                                         struct planish_surface **out_surface,
                                         struct planish_fair_report *out_report);

/**
 * The name of a surface, which copies, parts and saved files have too and STEP files take for the product's. A surface is
 * born without one.
 *
 * surface: not NULL.
 * name:    receives the name in UTF-8, cut off if it is too long and always terminated; NULL if size is 0.
 * size:    bytes that name has room for, the NUL included.
 * Arrays: name[size].
 * Returns the length of the whole name in bytes without the NUL; 0 for NULL and without a name.
 */
PLANISH_API
size_t planish_surface_name(const struct planish_surface *surface,
                            char *name,
                            size_t size);

/**
 * Gives a surface a name.
 *
 * surface: not NULL; changed.
 * name:    in UTF-8, terminated; empty for none. Copied.
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INVALID_ARGUMENT (name is not UTF-8).
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_surface_set_name(struct planish_surface *surface,
                                             const char *name);

/**
 * What one unit of a surface is: a planish_unit; PLANISH_UNIT_MILLIMETRE for NULL. The library computes in the units it is
 * given; STEP files say which they are.
 */
PLANISH_API
uint32_t planish_surface_unit(const struct planish_surface *surface);

/**
 * Says what one unit of a surface is. No number changes.
 *
 * surface: not NULL; changed.
 * unit:    a planish_unit.
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INVALID_ARGUMENT (unit).
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_surface_set_unit(struct planish_surface *surface,
                                             uint32_t unit);

/**
 * Fills options with the defaults.
 *
 * options:     struct_size writable bytes.
 * struct_size: sizeof(planish_vtk_options).
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INVALID_ARGUMENT (struct_size).
 */
PLANISH_API
enum planish_status planish_vtk_options_init(struct planish_vtk_options *options,
                                             size_t struct_size);

/**
 * Writes a surface in space as a VTK file (.vtu): triangles with their (u,v) as point data "uv", the patches, or
 * the control net. The file appears whole or not at all.
 *
 * surface: not NULL, of dimension 3.
 * path:    ends with a NUL; on Unix any bytes, elsewhere UTF-8. An existing file is replaced, see planish_mesh_write().
 * options: NULL for the defaults.
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (the dimension, an
 * option, a path that is not UTF-8), PLANISH_STATUS_WRONG_KIND (a family without patches or control net, where these
 * are asked for), PLANISH_STATUS_FILE, or what planish_surface_tessellate() or
 * planish_surface_deviation() return.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_surface_write_vtk(const struct planish_surface *surface,
                                              const char *path,
                                              const struct planish_vtk_options *options);

/**
 * How many bytes planish_surface_save() writes; 0 for NULL.
 */
PLANISH_API size_t planish_surface_save_size(const struct planish_surface *surface);

/**
 * Writes everything a surface is into a buffer, to the bit. The layout is documented in docs/format.md; it is
 * the same on all machines.
 *
 * surface: not NULL.
 * buffer:  receives planish_surface_save_size() bytes.
 * size:    bytes that the buffer has room for.
 * Arrays: buffer[size].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_surface_save(const struct planish_surface *surface,
                                         void *buffer,
                                         size_t size);

/**
 * Makes a surface from bytes of planish_surface_save(). Damaged bytes are refused, sizes are checked before
 * memory is asked for.
 *
 * buffer:      size bytes.
 * out_surface: receives a new surface; destroy with planish_surface_free().
 * Arrays: buffer[size].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_FORMAT (the index is the byte) or
 * PLANISH_STATUS_VERSION (a later library made it).
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_surface_load(const void *buffer,
                                         size_t size,
                                         struct planish_surface **out_surface);

/**
 * Writes the bytes of planish_surface_save() to a file, which appears whole or not at all.
 *
 * surface: not NULL.
 * path:    ends with a NUL; on Unix any bytes, elsewhere UTF-8. An existing file is replaced, see planish_mesh_write().
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (the path is not
 * UTF-8) or PLANISH_STATUS_FILE.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_surface_save_file(const struct planish_surface *surface,
                                              const char *path);

/**
 * Makes a surface from a file of planish_surface_save_file().
 *
 * path:        ends with a NUL; on Unix any bytes, elsewhere UTF-8.
 * out_surface: receives a new surface; destroy with planish_surface_free().
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (the path is not
 * UTF-8), PLANISH_STATUS_FILE, PLANISH_STATUS_FORMAT (the index is the byte) or PLANISH_STATUS_VERSION.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_surface_load_file(const char *path,
                                              struct planish_surface **out_surface);

/**
 * Fills options with the defaults.
 *
 * options:     struct_size writable bytes.
 * struct_size: sizeof(planish_step_options).
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INVALID_ARGUMENT (struct_size).
 */
PLANISH_API
enum planish_status planish_step_options_init(struct planish_step_options *options,
                                              size_t struct_size);

/**
 * Writes a surface in space as a STEP file with one face, bounded by the surface's trims or, if it has none, by its
 * domain. A T-spline or PHT-spline is written as the same tensor surface, or as a shell of faces that share their
 * edges: trims are cut where they cross the faces' common sides, and where they run within 1e-7 of the domain's
 * size beside one they are moved on to it. P-curves are the trims themselves, of degree 1; curves in space are cubic
 * and follow them over the same parameters within the uncertainty that the file states. The file appears whole or
 * not at all; equal input gives equal bytes. A D1RC-spline is written as a tensor surface fitted to it.
 *
 * surface: not NULL, of dimension 3.
 * path:    ends with a NUL; on Unix any bytes, elsewhere UTF-8. An existing file is replaced, see planish_mesh_write().
 * options: NULL for the defaults.
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (the dimension, an
 * option, a text that is not UTF-8), PLANISH_STATUS_WRONG_KIND, PLANISH_STATUS_TOPOLOGY (trims that cross or
 * touch, the index is one of them; trims around several pieces; a knot inside the domain that occurs more often
 * than the degree), PLANISH_STATUS_TOO_LARGE (max_coefficients, or tolerance is
 * missed), PLANISH_STATUS_DEGENERATE (a trim without area, the index; a face without size) or
 * PLANISH_STATUS_FILE.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_surface_write_step(const struct planish_surface *surface,
                                               const char *path,
                                               const struct planish_step_options *options);

/**
 * Fills options with the defaults.
 *
 * options:     struct_size writable bytes.
 * struct_size: sizeof(planish_report_options).
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INVALID_ARGUMENT (struct_size).
 */
PLANISH_API
enum planish_status planish_report_options_init(struct planish_report_options *options,
                                                size_t struct_size);

/**
 * Measures a surface in space against a mesh and writes the result as one HTML page that needs nothing from outside:
 * the mesh in the colours of its signed distances (positive on the side of the normal), the surface and its control
 * net, a section plane, a histogram, the ten worst places, and the numbers in words.
 *
 * surface: not NULL, of dimension 3.
 * mesh:    not NULL.
 * path:    the file, UTF-8; not NULL. Replaced as a whole.
 * options: NULL for the defaults.
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (the dimension, or an option),
 * PLANISH_STATUS_TOO_LARGE (the surface needs too many triangles), PLANISH_STATUS_FILE, PLANISH_STATUS_VERSION or
 * PLANISH_STATUS_CANCELLED.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_surface_write_report(const struct planish_surface *surface,
                                                 const struct planish_mesh *mesh,
                                                 const char *path,
                                                 const struct planish_report_options *options);

/**
 * Measures a model against a mesh and writes the result as one HTML page, as planish_surface_write_report() does: the mesh in
 * the colours of its signed distances (positive in front of the faces), the model, a section plane, a histogram, the ten
 * worst places, and the numbers in words.
 *
 * model:   not NULL.
 * mesh:    not NULL.
 * path:    the file, UTF-8; not NULL. Replaced as a whole.
 * options: NULL for the defaults.
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND (a field), an error of
 * planish_model_deviation() or planish_model_tessellate(), PLANISH_STATUS_INVALID_ARGUMENT (an option),
 * PLANISH_STATUS_FILE, PLANISH_STATUS_VERSION or PLANISH_STATUS_CANCELLED.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_model_write_report(const struct planish_model *model,
                                               const struct planish_mesh *mesh,
                                               const char *path,
                                               const struct planish_report_options *options);

/**
 * Makes a model of a surface in space: the part inside its trims as an open shell. A tensor surface is one face. A
 * T-spline is one face for each span of v, a PHT-spline one for each rectangle of cells whose levels differ by at most
 * one: tensor surfaces that share edges. A D1RC-spline is one face on a tensor surface fitted to it within 1e-3 of the
 * diagonal. Edges have cubic curves in space, within 1e-7 of the diagonal of their p-curves' images, and p-curves of
 * degree 1, the trims themselves.
 *
 * surface:   not NULL, of dimension 3.
 * out_model: receives a new model; destroy with planish_model_free().
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (the dimension),
 * PLANISH_STATUS_WRONG_KIND, PLANISH_STATUS_TOPOLOGY (trims that cross or touch, the index is one of them; trims around
 * several pieces; a knot inside the domain that occurs more often than the degree), PLANISH_STATUS_TOO_LARGE or
 * PLANISH_STATUS_DEGENERATE (a trim without area, the index; a face without size).
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_model_from_surface(const struct planish_surface *surface,
                                               struct planish_model **out_model);

/**
 * Makes a copy of a model.
 *
 * model:     not NULL.
 * out_model: receives a new model; destroy with planish_model_free().
 * Returns PLANISH_STATUS_OK or PLANISH_STATUS_NULL_POINTER.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_model_clone(const struct planish_model *model,
                                        struct planish_model **out_model);

/**
 * Destroys a model.
 *
 * model: NULL is accepted; otherwise not used again.
 */
PLANISH_API void planish_model_free(struct planish_model *model);

/**
 * Numbers of a place: 3 for a model in space, those of a value for a field over the faces of a model; 0 for NULL.
 */
PLANISH_API
size_t planish_model_dim(const struct planish_model *model);

/**
 * Number of faces; 0 for NULL.
 */
PLANISH_API size_t planish_model_face_count(const struct planish_model *model);

/**
 * Number of edges; one between two faces counts once. 0 for NULL.
 */
PLANISH_API size_t planish_model_edge_count(const struct planish_model *model);

/**
 * Number of vertices; 0 for NULL.
 */
PLANISH_API size_t planish_model_vertex_count(const struct planish_model *model);

/**
 * Number of shells; 0 for NULL.
 */
PLANISH_API size_t planish_model_shell_count(const struct planish_model *model);

/**
 * Number of loops of a face; 0 for NULL and for a face that does not exist.
 */
PLANISH_API size_t planish_model_loop_count(const struct planish_model *model, size_t face);

/**
 * Number of edges of all loops of a face; one that two loops or sides of the face share counts twice. 0 for NULL and
 * for a face that does not exist.
 */
PLANISH_API
size_t planish_model_coedge_count(const struct planish_model *model,
                                  size_t face);

/**
 * What a face is.
 *
 * model:    not NULL.
 * face:     below planish_model_face_count().
 * out_info: receives it; not NULL.
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (struct_size) or
 * PLANISH_STATUS_INDEX (the face).
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_model_face_info(const struct planish_model *model,
                                            size_t face,
                                            struct planish_face_info *out_info);

/**
 * Makes a surface of a face: the spline under it, with the loops of the face as trims, the outer one first. A plane
 * becomes a bilinear surface over the same parameters; a cylinder becomes a rational one, whose parameter u is not the
 * angle. Of a field over a model it is the PHT-spline of the values over the patch that the face is a part of.
 *
 * model:       not NULL.
 * face:        below planish_model_face_count().
 * out_surface: receives a new surface, which does not need the model; destroy with planish_surface_free().
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INDEX (the face) or
 * PLANISH_STATUS_DEGENERATE.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_model_copy_face(const struct planish_model *model,
                                            size_t face,
                                            struct planish_surface **out_surface);

/**
 * Makes a curve of an edge, and says what the edge is. An arc of a circle or ellipse becomes a spline over the same angles
 * that is off by at most 2e-11 of its radius.
 *
 * model:     not NULL.
 * edge:      below planish_model_edge_count().
 * out_curve: receives a new curve in space; destroy with planish_curve_free(). NULL for none.
 * out_info:  receives what the edge is; NULL for nothing.
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (struct_size) or
 * PLANISH_STATUS_INDEX (the edge).
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_model_copy_edge(const struct planish_model *model,
                                            size_t edge,
                                            struct planish_curve **out_curve,
                                            struct planish_edge_info *out_info);

/**
 * Copies the loops of a face: their edges in order, loop after loop, the outer loop first. Each edge begins where the
 * one before it ends; the face lies on the left of a loop as seen from its front.
 *
 * model:        not NULL.
 * face:         below planish_model_face_count().
 * out_sizes:    receives the number of edges of each of the planish_model_loop_count() loops; NULL if not wanted.
 * loop_count:   numbers that out_sizes has room for.
 * out_edges:    receives planish_model_coedge_count() edges; NULL if not wanted.
 * out_forward:  for each of them receives 1 if the loop runs along the edge, 0 if it runs against it; NULL if not
 *               wanted.
 * coedge_count: numbers that each of out_edges and out_forward has room for.
 * Arrays: out_sizes[model_loop_count], out_edges[model_coedge_count], out_forward[model_coedge_count].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INDEX (the face) or
 * PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_model_copy_loops(const struct planish_model *model,
                                             size_t face,
                                             size_t *out_sizes,
                                             size_t loop_count,
                                             uint32_t *out_edges,
                                             uint8_t *out_forward,
                                             size_t coedge_count);

/**
 * Makes a curve of where an edge of a face lies in the parameter plane of the face's surface: over the parameters of
 * the edge's curve in space and in its direction, whatever the direction of the loop.
 *
 * model:     not NULL.
 * face:      below planish_model_face_count().
 * coedge:    the place of the edge among those of planish_model_copy_loops().
 * out_curve: receives a new curve of dimension 2; destroy with planish_curve_free().
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INDEX (the face, or the place).
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_model_copy_pcurve(const struct planish_model *model,
                                              size_t face,
                                              size_t coedge,
                                              struct planish_curve **out_curve);

/**
 * Copies the places of the vertices.
 *
 * model:      not NULL.
 * out_points: receives planish_model_vertex_count() rows of x, y, z.
 * count:      rows that out_points has room for.
 * Arrays: out_points[model_vertex_count, 3].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_model_copy_vertices(const struct planish_model *model,
                                                double *out_points,
                                                size_t count);

/**
 * Number of nodes of the mesh that the model was fitted to; 0 for NULL and for a model that no fit made.
 */
PLANISH_API size_t planish_model_node_count(const struct planish_model *model);

/**
 * Where each node of the mesh that a model was fitted to lies on the model. Copies and saved models know it too.
 *
 * model:     not NULL, made by planish_model_fit().
 * out_faces: receives the face of each node, PLANISH_NONE for a node without triangles; NULL for none.
 * out_uv:    receives rows of u, v on the face's surface, NaN for such nodes; NULL for none.
 * count:     nodes that both have room for, at least planish_model_node_count().
 * Arrays: out_faces[model_node_count], out_uv[model_node_count, 2].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND (no fit made the model) or
 * PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_model_locate_nodes(const struct planish_model *model,
                                               uint32_t *out_faces,
                                               double *out_uv,
                                               size_t count);

/**
 * What a shell is, and its faces.
 *
 * model:     not NULL.
 * shell:     below planish_model_shell_count().
 * out_info:  receives what it is; NULL for nothing.
 * out_faces: receives its faces; NULL if not wanted.
 * count:     numbers that out_faces has room for.
 * Arrays: out_faces[out_info.face_count].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (struct_size),
 * PLANISH_STATUS_INDEX (the shell) or PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_model_copy_shell(const struct planish_model *model,
                                             size_t shell,
                                             struct planish_shell_info *out_info,
                                             uint32_t *out_faces,
                                             size_t count);

/**
 * Measures a model: its box, area and volume, and how well its faces meet. Area and volume are integrals over the
 * faces inside their loops; that of the volume is exact but for rounding where surfaces are polynomial and at most
 * bicubic and loops are straight in the parameter plane.
 *
 * model:      not NULL.
 * out_report: not NULL; struct_size must be set.
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INVALID_ARGUMENT (struct_size).
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_model_measure(const struct planish_model *model,
                                          struct planish_measure_report *out_report);

/**
 * Writes a model as a STEP file: solids as solids, with voids, and open shells as a shell-based surface model. Edges
 * are written once, for both faces. The file appears whole or not at all; equal input gives equal bytes.
 *
 * model:   not NULL.
 * path:    ends with a NUL; on Unix any bytes, elsewhere UTF-8. An existing file is replaced, see planish_mesh_write().
 * options: NULL for the defaults. What is said there of forms and tolerances is for surfaces, and not used.
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option, a text that is
 * not UTF-8), PLANISH_STATUS_DEGENERATE (numbers overflow) or PLANISH_STATUS_FILE.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_model_write_step(const struct planish_model *model,
                                             const char *path,
                                             const struct planish_step_options *options);

/**
 * Writes the content of the file of planish_model_write_step() into memory.
 *
 * model:     not NULL.
 * options:   NULL for the defaults.
 * out_bytes: receives the content, which is text without a NUL; NULL to learn its size.
 * size:      bytes that out_bytes has room for.
 * out_size:  receives the size of the content in bytes; not NULL.
 * Arrays: out_bytes[out_size], out_size[1].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option, a text that is
 * not UTF-8), PLANISH_STATUS_DEGENERATE (numbers overflow) or PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_model_write_step_memory(const struct planish_model *model,
                                                    const struct planish_step_options *options,
                                                    void *out_bytes,
                                                    size_t size,
                                                    size_t *out_size);

/**
 * How many bytes planish_model_save() writes; 0 for NULL.
 */
PLANISH_API size_t planish_model_save_size(const struct planish_model *model);

/**
 * Writes everything a model is into a buffer, to the bit. The layout is documented in docs/format.md; it is the same
 * on all machines.
 *
 * model:  not NULL.
 * buffer: receives planish_model_save_size() bytes.
 * size:   bytes that the buffer has room for.
 * Arrays: buffer[size].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_model_save(const struct planish_model *model,
                                       void *buffer,
                                       size_t size);

/**
 * Makes a model from bytes of planish_model_save(). Damaged bytes are refused, sizes are checked before memory is
 * asked for.
 *
 * buffer:    size bytes.
 * out_model: receives a new model; destroy with planish_model_free().
 * Arrays: buffer[size].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_FORMAT (the index is the byte) or
 * PLANISH_STATUS_VERSION (a later library made it).
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_model_load(const void *buffer,
                                       size_t size,
                                       struct planish_model **out_model);

/**
 * Writes the bytes of planish_model_save() to a file, which appears whole or not at all.
 *
 * model: not NULL.
 * path:  ends with a NUL; on Unix any bytes, elsewhere UTF-8. An existing file is replaced, see planish_mesh_write().
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (the path is not UTF-8) or
 * PLANISH_STATUS_FILE.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_model_save_file(const struct planish_model *model,
                                            const char *path);

/**
 * Makes a model from a file of planish_model_save_file().
 *
 * path:      ends with a NUL; on Unix any bytes, elsewhere UTF-8.
 * out_model: receives a new model; destroy with planish_model_free().
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (the path is not UTF-8),
 * PLANISH_STATUS_FILE, PLANISH_STATUS_FORMAT (the index is the byte) or PLANISH_STATUS_VERSION.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_model_load_file(const char *path,
                                            struct planish_model **out_model);

/**
 * Fills options with the defaults.
 *
 * options:     struct_size writable bytes.
 * struct_size: sizeof(planish_model_options).
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INVALID_ARGUMENT (struct_size).
 */
PLANISH_API
enum planish_status planish_model_options_init(struct planish_model_options *options,
                                               size_t struct_size);

/**
 * Makes a model of any mesh within a tolerance. A mesh of planes and cylinders between sharp edges becomes exact faces
 * that meet in lines, circles and ellipses. Any other closed mesh becomes a solid of B-spline faces that share position and
 * tangent plane to rounding, but for sharp edges, which stay sharp where that serves, with one plane face for each flat
 * region between them. One inside another becomes its void, several components several shells. An open mesh becomes such a
 * shell over its features and borders, or one PHT-spline inside its trims where it has one border loop and no features
 * inside, or where that does better. Components that are inside out are turned.
 *
 * mesh:       not NULL; stays as it is.
 * options:    NULL for the defaults.
 * out_model:  receives a new model; destroy with planish_model_free().
 * out_report: receives what the fit did and how good it is; NULL for no report.
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_INPUT_REPAIRED (a component was turned), PLANISH_STATUS_FOLDED_PARAMETERS,
 * PLANISH_STATUS_TOLERANCE_NOT_MET or PLANISH_STATUS_STAGNATED (the best model found is there), or an error:
 * PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option; a start_level that the layout does not
 * allow; labels that are not as many as the triangles), PLANISH_STATUS_TOPOLOGY (patches for a mesh with a boundary, one of whose nodes is the index; a cube for a mesh
 * with handles; a node where the surface touches itself), PLANISH_STATUS_DEGENERATE (a component encloses no volume, one
 * of its nodes is the index; no layout), PLANISH_STATUS_TOO_LARGE (more than 1000 components; coordinates beyond 1e50, or all below 1e-50), PLANISH_STATUS_SINGULAR,
 * PLANISH_STATUS_VERSION, PLANISH_STATUS_CANCELLED, or for a chart what planish_pht_fit() and
 * planish_model_from_surface() return.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_model_fit(const struct planish_mesh *mesh,
                                      const struct planish_model_options *options,
                                      struct planish_model **out_model,
                                      struct planish_model_report *out_report);

/**
 * Evaluates a model, or a field over its faces, and derivatives at parameters on the faces. On a spline u and v are those of
 * the surface of planish_model_copy_face(); on a plane those of that surface too; on a cylinder the angle in radians and the height.
 *
 * model:          not NULL.
 * faces:          for each point its face, below planish_model_face_count().
 * uv:             count rows of u, v; rows start options->uv_stride doubles apart.
 * count:          may be 0.
 * max_derivative: 0, 1 or 2.
 * options:        NULL for the defaults.
 * out:            receives for each point 1, 3 or 6 rows of planish_model_dim() numbers: S; Su, Sv; Suu, Suv, Svv.
 *                 Points start options->out_stride doubles apart. It must not overlap uv.
 * Arrays: faces[count], uv[count, 2], out[count, *, model_dim].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_POINTS_OUTSIDE (with PLANISH_OUTSIDE_FLAG), PLANISH_STATUS_NULL_POINTER,
 * PLANISH_STATUS_INVALID_ARGUMENT (an option, or max_derivative), PLANISH_STATUS_INDEX (a face; the index is the point),
 * PLANISH_STATUS_OUTSIDE (with PLANISH_OUTSIDE_FAIL; the index is the first such point of the first such face),
 * PLANISH_STATUS_NOT_FINITE (the index is the point), PLANISH_STATUS_TOO_LARGE or PLANISH_STATUS_VERSION.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_model_eval(const struct planish_model *model,
                                       const uint32_t *faces,
                                       const double *uv,
                                       size_t count,
                                       uint32_t max_derivative,
                                       const struct planish_eval_options *options,
                                       double *out);

/**
 * The gradient in space of a field over the faces of a model: for each component the vector, tangential to the model,
 * that gives its change along it.
 *
 * shape:         not NULL, in space: the model that the field was fitted over.
 * field:         not NULL, of planish_field_fitter_fit_model().
 * faces:         for each point its face, below planish_model_face_count().
 * uv:            count rows of u, v on the faces; rows start options->uv_stride doubles apart.
 * count:         may be 0.
 * options:       NULL for the defaults.
 * out_gradients: receives count times planish_model_dim() of the field rows of 3 numbers; NaN where the model has no
 *                tangent plane.
 * Arrays: faces[count], uv[count, 2], out_gradients[count, model_dim, 3].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND (shape is a field, or field is
 * none), PLANISH_STATUS_INVALID_ARGUMENT (an option; the numbers of faces differ), PLANISH_STATUS_INDEX (a face),
 * PLANISH_STATUS_NOT_FINITE, PLANISH_STATUS_OUTSIDE (the index is the point for all three), PLANISH_STATUS_TOO_LARGE or
 * PLANISH_STATUS_VERSION.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_model_field_gradient(const struct planish_model *shape,
                                                 const struct planish_model *field,
                                                 const uint32_t *faces,
                                                 const double *uv,
                                                 size_t count,
                                                 const struct planish_gradient_options *options,
                                                 double *out_gradients);

/**
 * Computes unit normals of a model, out of the fronts of its faces.
 *
 * model:       not NULL.
 * faces:       for each point its face, below planish_model_face_count().
 * uv:          count rows of u, v; rows start options->uv_stride doubles apart.
 * count:       may be 0.
 * options:     NULL for the defaults.
 * out_normals: receives count rows of 3 numbers; NaN where there is no normal. Rows start options->out_stride
 *              doubles apart. It must not overlap uv.
 * Arrays: faces[count], uv[count, 2], out_normals[count, 3].
 * Returns what planish_model_eval() returns.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_model_normals(const struct planish_model *model,
                                          const uint32_t *faces,
                                          const double *uv,
                                          size_t count,
                                          const struct planish_eval_options *options,
                                          double *out_normals);

/**
 * Computes principal curvatures of a model and their directions.
 *
 * model:   not NULL.
 * faces:   for each point its face, below planish_model_face_count().
 * uv:      count rows of u, v; rows start options->uv_stride doubles apart.
 * count:   may be 0.
 * options: NULL for the defaults.
 * out:     receives count rows of 8 numbers: k1, k2 with k1 >= k2, positive where the face bends towards its normal,
 *          then the unit tangents d1 and d2 of 3 numbers each, with d1 x d2 the normal; NaN where there is no
 *          normal. Rows start options->out_stride doubles apart. It must not overlap uv.
 * Arrays: faces[count], uv[count, 2], out[count, 8].
 * Returns what planish_model_eval() returns.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_model_curvatures(const struct planish_model *model,
                                             const uint32_t *faces,
                                             const double *uv,
                                             size_t count,
                                             const struct planish_eval_options *options,
                                             double *out);

/**
 * Finds the place on a model nearest to each point, over all faces, inside their loops.
 *
 * model:         not NULL.
 * points:        count rows of x, y, z.
 * count:         number of points; with 0 nothing is done.
 * options:       NULL for the defaults; guesses must be NULL, keep_trims is not used.
 * out_faces:     receives the face of each; PLANISH_NONE for points farther away than max_distance. NULL for none.
 * out_uv:        receives count rows u, v on the face's surface, NaN for such points; NULL for none.
 * out_distances: receives count distances, NaN for such points; NULL for none.
 * Arrays: points[count, 3], out_faces[count], out_uv[count, 2], out_distances[count].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_POINTS_OUTSIDE (some points are farther than max_distance),
 * PLANISH_STATUS_NOT_PROVEN (some answers are flagged), PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_NOT_FINITE (the
 * index is the point), PLANISH_STATUS_INVALID_ARGUMENT, PLANISH_STATUS_TOO_LARGE, PLANISH_STATUS_CANCELLED or PLANISH_STATUS_VERSION.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_model_project(const struct planish_model *model,
                                          const double *points,
                                          size_t count,
                                          const struct planish_project_options *options,
                                          uint32_t *out_faces,
                                          double *out_uv,
                                          double *out_distances);

/**
 * Measures how far the nodes of a mesh lie from a model: closest-point distances, over all faces.
 *
 * model:         not NULL.
 * mesh:          not NULL.
 * options:       NULL for the defaults; use_parameters and keep_trims are not used.
 * out_distances: receives planish_mesh_point_count() distances; NULL for none.
 * count:         doubles that out_distances has room for.
 * out_report:    receives the sizes of the distances; NULL for none. worst_back_u and worst_back_v are NaN.
 * Arrays: out_distances[count].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NOT_PROVEN (some distances are not proved to be the least ones, as
 * unproven_count says), PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option),
 * PLANISH_STATUS_BUFFER_TOO_SMALL, PLANISH_STATUS_TOPOLOGY or PLANISH_STATUS_TOO_LARGE (measuring back only),
 * PLANISH_STATUS_CANCELLED or PLANISH_STATUS_VERSION.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_model_deviation(const struct planish_model *model,
                                            const struct planish_mesh *mesh,
                                            const struct planish_deviation_options *options,
                                            double *out_distances,
                                            size_t count,
                                            struct planish_deviation_report *out_report);

/**
 * Makes a triangle mesh of a model: watertight, with one polyline for each edge, closed where a shell is. Its nodes lie
 * on the model.
 *
 * model:    not NULL.
 * options:  NULL for the defaults; keep_trims is not used.
 * out_mesh: receives a new mesh; destroy with planish_mesh_free().
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option),
 * PLANISH_STATUS_TOPOLOGY (loops cross), PLANISH_STATUS_DEGENERATE, PLANISH_STATUS_TOO_LARGE (more than
 * max_point_count nodes), PLANISH_STATUS_CANCELLED or PLANISH_STATUS_VERSION.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_model_tessellate(const struct planish_model *model,
                                             const struct planish_tessellate_options *options,
                                             struct planish_mesh **out_mesh);

/**
 * Writes the triangles of a model as a VTK file: those of planish_model_tessellate() with the number of the face as
 * cell data "face", or those of a mesh to compare with, each node moved to its nearest place on the model, with the
 * distance as point data "deviation".
 *
 * model:   not NULL.
 * path:    ends with a NUL; on Unix any bytes, elsewhere UTF-8. An existing file is replaced, see planish_mesh_write().
 * options: NULL for the defaults; content must be PLANISH_VTK_CONTENT_TRIANGLES.
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option, a path that is
 * not UTF-8), PLANISH_STATUS_FILE, or what planish_model_tessellate() or planish_model_deviation() return.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_model_write_vtk(const struct planish_model *model,
                                            const char *path,
                                            const struct planish_vtk_options *options);

/**
 * Fills options with the defaults.
 *
 * options:     struct_size writable bytes.
 * struct_size: sizeof(planish_curve_options).
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INVALID_ARGUMENT (struct_size).
 */
PLANISH_API
enum planish_status planish_curve_options_init(struct planish_curve_options *options,
                                               size_t struct_size);

/**
 * Fits a cubic curve to values at parameters, by the method of planish_tensor_fit() in one parameter.
 *
 * u:          count parameters, in any order.
 * values:     count rows of dim numbers.
 * count:      at least 3.
 * dim:        numbers of a value, at least 1.
 * options:    NULL for the defaults.
 * out_curve:  receives a new curve; destroy with planish_curve_free().
 * out_report: receives what the fit did and how good it is; grid_v is 1. NULL for no report.
 * Arrays: u[count], values[count, dim].
 * Returns what planish_tensor_fit_points() returns.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_curve_fit(const double *u,
                                      const double *values,
                                      size_t count,
                                      size_t dim,
                                      const struct planish_curve_options *options,
                                      struct planish_curve **out_curve,
                                      struct planish_fit_report *out_report);

/**
 * Makes a curve from its parts, which are copied.
 *
 * dim:            numbers of a control point, at least 1.
 * degree:         1 to 9.
 * knots:          knot_count knots, never falling.
 * knot_count:     at least 2 * (degree + 1).
 * control_points: knot_count - degree - 1 rows of dim numbers.
 * out_curve:      receives a new curve; destroy with planish_curve_free().
 * Arrays: knots[knot_count], control_points[knot_count - degree - 1, dim].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (dim, degree or knots),
 * PLANISH_STATUS_NOT_FINITE (the index is the knot or the control point), PLANISH_STATUS_DEGENERATE (the knots span
 * no interval), PLANISH_STATUS_TOO_LARGE or PLANISH_STATUS_OUT_OF_MEMORY.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_curve_new(size_t dim,
                                      uint32_t degree,
                                      const double *knots,
                                      size_t knot_count,
                                      const double *control_points,
                                      struct planish_curve **out_curve);

/**
 * Fills options with the defaults.
 *
 * options:     struct_size writable bytes.
 * struct_size: sizeof(planish_interpolate_options).
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INVALID_ARGUMENT (struct_size).
 */
PLANISH_API
enum planish_status planish_interpolate_options_init(struct planish_interpolate_options *options,
                                                     size_t struct_size);

/**
 * Makes the cubic curve with two continuous derivatives that passes through points.
 *
 * u:         count parameters, each above the one before it.
 * values:    count rows of dim numbers.
 * count:     at least 2.
 * dim:       numbers of a value, at least 1.
 * options:   NULL for the defaults.
 * out_curve: receives a new curve; destroy with planish_curve_free().
 * Arrays: u[count], values[count, dim].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_NOT_FINITE (a parameter or a value; the index
 * is the point), PLANISH_STATUS_DEGENERATE (a parameter is not above the one before it; the index is the point),
 * PLANISH_STATUS_INVALID_ARGUMENT (count, dim, ends; a periodic curve whose last point is not the first),
 * PLANISH_STATUS_TOO_LARGE or PLANISH_STATUS_VERSION.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_curve_interpolate(const double *u,
                                              const double *values,
                                              size_t count,
                                              size_t dim,
                                              const struct planish_interpolate_options *options,
                                              struct planish_curve **out_curve);

/**
 * Numbers of a value; 0 for NULL.
 */
PLANISH_API size_t planish_curve_dim(const struct planish_curve *curve);

/**
 * Degree of the polynomial pieces; 0 for NULL.
 */
PLANISH_API uint32_t planish_curve_degree(const struct planish_curve *curve);

/**
 * Number of knots, each as often as it occurs; 0 for NULL.
 */
PLANISH_API size_t planish_curve_knot_count(const struct planish_curve *curve);

/**
 * Number of control points; 0 for NULL.
 */
PLANISH_API size_t planish_curve_control_point_count(const struct planish_curve *curve);

/**
 * Copies the knots of a curve.
 *
 * curve:     not NULL.
 * out_knots: receives planish_curve_knot_count() knots.
 * count:     knots that out_knots has room for.
 * Arrays: out_knots[curve_knot_count].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_curve_copy_knots(const struct planish_curve *curve,
                                             double *out_knots,
                                             size_t count);

/**
 * Copies the control points of a curve.
 *
 * curve:              not NULL.
 * out_control_points: receives planish_curve_control_point_count() rows of dim numbers.
 * count:              rows that out_control_points has room for.
 * Arrays: out_control_points[curve_control_point_count, curve_dim].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_curve_copy_control_points(const struct planish_curve *curve,
                                                      double *out_control_points,
                                                      size_t count);

/**
 * The interval on which the curve is defined.
 *
 * curve:        not NULL.
 * out_interval: receives 2 numbers: least u, largest u.
 * Arrays: out_interval[2].
 * Returns PLANISH_STATUS_OK or PLANISH_STATUS_NULL_POINTER.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_curve_domain(const struct planish_curve *curve,
                                         double *out_interval);

/**
 * Evaluates the curve and its derivatives at parameters.
 *
 * curve:          not NULL.
 * u:              count parameters, options->uv_stride doubles apart (0 for 1).
 * count:          may be 0.
 * max_derivative: 0 to 3.
 * options:        NULL for the defaults; thread_count is not used.
 * out:            receives for each parameter max_derivative + 1 rows of dim numbers: C, C', C'', C''';
 *                 parameters start options->out_stride doubles apart. It must not overlap u.
 * Arrays: u[count], out[count, max_derivative + 1, curve_dim].
 * Returns what planish_surface_eval() returns; PLANISH_STATUS_INVALID_ARGUMENT also for max_derivative.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_curve_eval(const struct planish_curve *curve,
                                       const double *u,
                                       size_t count,
                                       uint32_t max_derivative,
                                       const struct planish_eval_options *options,
                                       double *out);

/**
 * Makes a copy of a curve.
 *
 * curve:     not NULL.
 * out_curve: receives a new curve; destroy with planish_curve_free().
 * Returns PLANISH_STATUS_OK or PLANISH_STATUS_NULL_POINTER.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_curve_clone(const struct planish_curve *curve,
                                        struct planish_curve **out_curve);

/**
 * Destroys a curve.
 *
 * curve: from this library and not destroyed yet; NULL does nothing.
 */
PLANISH_API void planish_curve_free(struct planish_curve *curve);

/**
 * Length of a curve, but for 1e-12 of it and the roundoff of its coordinates; 0 for NULL.
 */
PLANISH_API double planish_curve_length(const struct planish_curve *curve);

/**
 * The lengths of a curve from its start to parameters, as exact as planish_curve_length().
 *
 * curve:       not NULL.
 * u:           count parameters in the domain, in any order.
 * count:       may be 0.
 * out_lengths: receives count lengths.
 * Arrays: u[count], out_lengths[count].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_NOT_FINITE or PLANISH_STATUS_OUTSIDE (the
 * index is the parameter for both).
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_curve_arc_lengths(const struct planish_curve *curve,
                                              const double *u,
                                              size_t count,
                                              double *out_lengths);

/**
 * Finds the place on a curve nearest to each point, anywhere on the curve: there is no start to choose, and no local
 * minimum to fall into.
 *
 * curve:         not NULL.
 * points:        count rows of planish_curve_dim() doubles.
 * count:         number of points; with 0 nothing is done.
 * options:       NULL for the defaults. guesses are count parameters u; keep_trims is not used.
 * out_u:         receives count parameters; NULL for none.
 * out_distances: receives count distances; NULL for none.
 * Arrays: points[count, curve_dim], out_u[count], out_distances[count].
 * Returns what planish_surface_project() returns, but for PLANISH_STATUS_WRONG_KIND.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_curve_project(const struct planish_curve *curve,
                                          const double *points,
                                          size_t count,
                                          const struct planish_project_options *options,
                                          double *out_u,
                                          double *out_distances);

/**
 * How many bytes planish_curve_save() writes; 0 for NULL.
 */
PLANISH_API size_t planish_curve_save_size(const struct planish_curve *curve);

/**
 * Writes everything a curve is into a buffer, to the bit. The layout is documented in docs/format.md; it is the same
 * on all machines.
 *
 * curve:  not NULL.
 * buffer: receives planish_curve_save_size() bytes.
 * size:   bytes that the buffer has room for.
 * Arrays: buffer[size].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_curve_save(const struct planish_curve *curve,
                                       void *buffer,
                                       size_t size);

/**
 * Makes a curve from bytes of planish_curve_save(). Damaged bytes are refused, sizes are checked before memory is
 * asked for.
 *
 * buffer:    size bytes.
 * out_curve: receives a new curve; destroy with planish_curve_free().
 * Arrays: buffer[size].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_FORMAT (the index is the byte) or
 * PLANISH_STATUS_VERSION (a later library made it).
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_curve_load(const void *buffer,
                                       size_t size,
                                       struct planish_curve **out_curve);

/**
 * Writes the bytes of planish_curve_save() to a file, which appears whole or not at all.
 *
 * curve: not NULL.
 * path:  ends with a NUL; on Unix any bytes, elsewhere UTF-8. An existing file is replaced, see planish_mesh_write().
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (the path is not UTF-8) or
 * PLANISH_STATUS_FILE.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_curve_save_file(const struct planish_curve *curve,
                                            const char *path);

/**
 * Makes a curve from a file of planish_curve_save_file().
 *
 * path:      ends with a NUL; on Unix any bytes, elsewhere UTF-8.
 * out_curve: receives a new curve; destroy with planish_curve_free().
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (the path is not UTF-8),
 * PLANISH_STATUS_FILE, PLANISH_STATUS_FORMAT (the index is the byte) or PLANISH_STATUS_VERSION.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_curve_load_file(const char *path,
                                            struct planish_curve **out_curve);

/**
 * Fills options with the defaults.
 *
 * options:     struct_size writable bytes.
 * struct_size: sizeof(planish_skin_options).
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INVALID_ARGUMENT (struct_size).
 */
PLANISH_API
enum planish_status planish_skin_options_init(struct planish_skin_options *options,
                                              size_t struct_size);

/**
 * Skins rows of points: a surface over the unit square on which row after row lies within the tolerance, u along
 * the rows and v across them. Rows may have any counts, one point included.
 *
 * points:      rows of dim numbers (3 unless the options say otherwise), row after row.
 * row_counts:  row_count numbers of points, each at least 1.
 * row_count:   at least 2; at least 3 for a surface closed along v.
 * options:     NULL for the defaults.
 * out_surface: receives a new T-spline; destroy with planish_surface_free().
 * out_report:  receives what the fit did and how good it is; grid_u is the largest number of knots of a control
 *              curve. NULL for no report.
 * Arrays: points[*, options.dim], row_counts[row_count].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_TOLERANCE_NOT_MET, PLANISH_STATUS_STAGNATED (points are so near to one
 * another that no knot fits between), PLANISH_STATUS_INPUT_REPAIRED (points on the one before were merged) or an
 * error: PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option, too few rows, or a row without
 * points, the index is the row), PLANISH_STATUS_NOT_FINITE (the index is the point, or the vector of an option),
 * PLANISH_STATUS_DEGENERATE (a row lies on the one before, the index is the row), PLANISH_STATUS_TOO_LARGE,
 * PLANISH_STATUS_VERSION or PLANISH_STATUS_CANCELLED.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_tspline_skin(const double *points,
                                         const size_t *row_counts,
                                         size_t row_count,
                                         const struct planish_skin_options *options,
                                         struct planish_surface **out_surface,
                                         struct planish_fit_report *out_report);

/**
 * Skins section curves of any degree, over any domains. Their data are their values at their different knots.
 *
 * curves:      curve_count curves of one dimension, none of them NULL.
 * curve_count: at least 2; at least 3 for a surface closed along v.
 * options:     NULL for the defaults. closed says that the curves are closed, and smooth there.
 * out_surface: receives a new T-spline; destroy with planish_surface_free().
 * out_report:  receives what the fit did and how good it is; NULL for no report.
 * Arrays: curves[curve_count].
 * Returns what planish_tspline_skin() returns; PLANISH_STATUS_INVALID_ARGUMENT also for a curve of another dimension
 * than the first, the index is the curve.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_tspline_skin_curves(const struct planish_curve *const *curves,
                                                size_t curve_count,
                                                const struct planish_skin_options *options,
                                                struct planish_surface **out_surface,
                                                struct planish_fit_report *out_report);

/**
 * Makes a T-spline from its parts, which are copied.
 *
 * knots:       the knots along v, never falling, cubic.
 * knot_count:  at least 8.
 * curves:      knot_count - 4 control curves: cubic, their end knots repeated four times, all over one domain and of
 *              one dimension; none of them NULL.
 * curve_count: knot_count - 4.
 * out_surface: receives a new surface; destroy with planish_surface_free().
 * Arrays: knots[knot_count], curves[curve_count].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (knots or curves, the index
 * is the one), PLANISH_STATUS_NOT_FINITE or PLANISH_STATUS_DEGENERATE (the knots span no interval).
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_tspline_new(const double *knots,
                                        size_t knot_count,
                                        const struct planish_curve *const *curves,
                                        size_t curve_count,
                                        struct planish_surface **out_surface);

/**
 * Number of control curves of a T-spline; 0 for NULL and other families.
 */
PLANISH_API size_t planish_tspline_curve_count(const struct planish_surface *surface);

/**
 * Makes a copy of a control curve, whose knots and control points the functions of planish_curve hand out.
 *
 * surface:   not NULL.
 * curve:     below planish_tspline_curve_count().
 * out_curve: receives a new curve; destroy with planish_curve_free().
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND or PLANISH_STATUS_INDEX.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_tspline_clone_curve(const struct planish_surface *surface,
                                                size_t curve,
                                                struct planish_curve **out_curve);

/**
 * Number of knots of a T-spline along v, each as often as it occurs; 0 for NULL and other families.
 */
PLANISH_API size_t planish_tspline_knot_count(const struct planish_surface *surface);

/**
 * Copies the knots of a T-spline along v.
 *
 * surface:   not NULL.
 * out_knots: receives planish_tspline_knot_count() knots.
 * count:     knots that out_knots has room for.
 * Arrays: out_knots[tspline_knot_count].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND or
 * PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_tspline_copy_knots(const struct planish_surface *surface,
                                               double *out_knots,
                                               size_t count);

/**
 * Inserts a knot into one control curve of a T-spline, which stays the same surface; all other curves stay as they
 * are.
 *
 * surface: not NULL; changed.
 * curve:   below planish_tspline_curve_count().
 * u:       inside the domain, where the curve has no more than two knots yet.
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND, PLANISH_STATUS_INDEX,
 * PLANISH_STATUS_OUTSIDE (u, also if it is NaN) or PLANISH_STATUS_INVALID_ARGUMENT (the knot would occur too often).
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_tspline_insert_knot_u(struct planish_surface *surface,
                                                  size_t curve,
                                                  double u);

/**
 * Inserts a knot along v into a T-spline, which stays the same surface and has one control curve more.
 *
 * surface: not NULL; changed.
 * v:       inside the domain, where there are no more than two knots yet.
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND, PLANISH_STATUS_OUTSIDE (v, also
 * if it is NaN) or PLANISH_STATUS_INVALID_ARGUMENT (the knot would occur too often).
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_tspline_insert_knot_v(struct planish_surface *surface,
                                                  double v);

/**
 * Removes a knot from one control curve of a T-spline if the surface then moves by no more than a tolerance.
 *
 * surface:   not NULL; changed unless PLANISH_STATUS_TOLERANCE_NOT_MET is returned.
 * curve:     below planish_tspline_curve_count().
 * knot:      index of a knot of that curve inside the domain, counted from 0 over all its knots.
 * tolerance: in model units; 0 or more, or the knot stays.
 * out_error: receives a bound of the distance that the surface moves at any (u,v), or would have moved; NULL for
 *            none.
 * Arrays: out_error[1].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_TOLERANCE_NOT_MET (the knot stays) or an error:
 * PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND or PLANISH_STATUS_INDEX (no such curve, or no such knot
 * inside the domain).
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_tspline_remove_knot_u(struct planish_surface *surface,
                                                  size_t curve,
                                                  size_t knot,
                                                  double tolerance,
                                                  double *out_error);

/**
 * Fills options with the defaults.
 *
 * options:     struct_size writable bytes.
 * struct_size: sizeof(planish_pht_options).
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INVALID_ARGUMENT (struct_size).
 */
PLANISH_API
enum planish_status planish_pht_options_init(struct planish_pht_options *options,
                                             size_t struct_size);

/**
 * Fits a PHT-spline to the shape of a mesh: a smooth bicubic surface whose cells are as small as the shape asks,
 * place by place. A mesh without parameters is parameterized first, which changes nothing in the mesh. The
 * boundary loops become trims.
 *
 * mesh:        not NULL.
 * options:     NULL for the defaults.
 * out_surface: receives a new surface of dim 3; destroy with planish_surface_free().
 * out_report:  receives what the fit did and how good it is; NULL for no report.
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_FOLDED_PARAMETERS, PLANISH_STATUS_TOLERANCE_NOT_MET,
 * PLANISH_STATUS_STAGNATED (all three with the best surface found) or an error: PLANISH_STATUS_NULL_POINTER,
 * PLANISH_STATUS_INVALID_ARGUMENT (an option, or fewer than 3 data; fixed data that contradict each other; a mesh that
 * is not symmetric), PLANISH_STATUS_INDEX (a fixed datum that does not exist), PLANISH_STATUS_NOT_FINITE (a weight or a
 * tolerance; the index is the datum), PLANISH_STATUS_TOPOLOGY (a plane of symmetry that does not cut the mesh in two),
 * PLANISH_STATUS_DEGENERATE (all data have the same u or the same v),
 * PLANISH_STATUS_SINGULAR (the data do not determine a surface), PLANISH_STATUS_VERSION or
 * PLANISH_STATUS_CANCELLED; for a mesh without parameters also what planish_mesh_parameterize() returns.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_pht_fit(const struct planish_mesh *mesh,
                                    const struct planish_pht_options *options,
                                    struct planish_surface **out_surface,
                                    struct planish_fit_report *out_report);

/**
 * Fits a PHT-spline to values at scattered parameters.
 *
 * uv:          count rows of u, v.
 * values:      count rows of dim numbers.
 * count:       at least 3.
 * dim:         numbers of a value, at least 1.
 * options:     NULL for the defaults; parameterize, regularize and correction_sweeps are not used, and
 *              refused unless they are at their defaults.
 * out_surface: receives a new surface; destroy with planish_surface_free().
 * out_report:  receives what the fit did and how good it is; NULL for no report.
 * Arrays: uv[count, 2], values[count, dim].
 * Returns what planish_pht_fit() returns; PLANISH_STATUS_NOT_FINITE also for uv and values (the index is the
 * datum), PLANISH_STATUS_TOO_LARGE (count times dim) and PLANISH_STATUS_OUT_OF_MEMORY.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_pht_fit_points(const double *uv,
                                           const double *values,
                                           size_t count,
                                           size_t dim,
                                           const struct planish_pht_options *options,
                                           struct planish_surface **out_surface,
                                           struct planish_fit_report *out_report);

/**
 * Fits a PHT-spline to values on the nodes of a mesh, over the same parameters as its shape.
 *
 * mesh:        not NULL.
 * values:      count rows of dim numbers.
 * count:       planish_mesh_point_count(), or planish_mesh_triangle_count() for values that are taken at the centroids of
 *              the triangles; a datum is then a triangle.
 * dim:         numbers of a value, at least 1.
 * options:     NULL for the defaults; correction_sweeps is not used, and refused unless it is at its
 *              default.
 * out_surface: receives a new surface; destroy with planish_surface_free().
 * out_report:  receives what the fit did and how good it is; NULL for no report.
 * Arrays: values[count, dim].
 * Returns what planish_pht_fit() returns; PLANISH_STATUS_INVALID_ARGUMENT also for count,
 * PLANISH_STATUS_NOT_FINITE also for values (the index is the node), and PLANISH_STATUS_TOO_LARGE.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_pht_fit_field(const struct planish_mesh *mesh,
                                          const double *values,
                                          size_t count,
                                          size_t dim,
                                          const struct planish_pht_options *options,
                                          struct planish_surface **out_surface,
                                          struct planish_fit_report *out_report);

/**
 * Makes a PHT-spline from an initial grid and a list of splits.
 *
 * dim:           numbers of a value, at least 1.
 * is_rational:   1 if values are followed by a weight and multiplied by it, else 0.
 * lines_u:       line_count_u increasing parameters.
 * line_count_u:  2 to 4096.
 * lines_v:       line_count_v increasing parameters.
 * line_count_v:  2 to 4096.
 * cells:         split_count rows of level, i, j: the cells to split, a cell before its quarters; i and j are
 *                counted along u and v over the cells of that level.
 * split_count:   may be 0.
 * data:          for each basis vertex, ordered along u, then along v, the rows f, f_u, f_v, f_uv of dim numbers
 *                (dim + 1 with weights); NULL for zeros, and weights of 1: the vertices are known afterwards.
 * data_count:    numbers in data; 0 if it is NULL.
 * out_surface:   receives a new surface; destroy with planish_surface_free().
 * Arrays: lines_u[line_count_u], lines_v[line_count_v], cells[split_count, 3],
 *         data[data_count, 4, dim + is_rational].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (dim, a count, a line
 * that does not increase, a weight that is not positive everywhere), PLANISH_STATUS_NOT_FINITE (the index is the
 * line or the vertex), PLANISH_STATUS_INDEX (a cell that is no leaf when its turn comes; the index is its row),
 * PLANISH_STATUS_TOO_LARGE (lines, or a level above 20) or PLANISH_STATUS_OUT_OF_MEMORY.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_pht_new(size_t dim,
                                    uint32_t is_rational,
                                    const double *lines_u,
                                    size_t line_count_u,
                                    const double *lines_v,
                                    size_t line_count_v,
                                    const uint32_t *cells,
                                    size_t split_count,
                                    const double *data,
                                    size_t data_count,
                                    struct planish_surface **out_surface);

/**
 * Splits cells of a PHT-spline at their middles; the surface stays the same, all cells or none are split.
 *
 * surface: not NULL; changed.
 * cells:   count rows of level, i, j: leaves when their turn comes, so quarters may follow their cell.
 * count:   may be 0.
 * Arrays: cells[count, 3].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND, PLANISH_STATUS_INDEX (a cell
 * is no leaf; the index is its row), PLANISH_STATUS_TOO_LARGE (a level above 20) or
 * PLANISH_STATUS_OUT_OF_MEMORY.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_pht_split(struct planish_surface *surface,
                                      const uint32_t *cells,
                                      size_t count);

/**
 * Merges the quarters of cells of a PHT-spline: the exact inverse of planish_pht_split(). The surface changes
 * where the vertices that vanish acted, which may reach beyond the neighbours. All cells or none are merged.
 *
 * surface: not NULL; changed.
 * cells:   count rows of level, i, j: cells whose quarters are four leaves when their turn comes.
 * count:   may be 0.
 * Arrays: cells[count, 3].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND, PLANISH_STATUS_INDEX (the
 * quarters are not four leaves; the index is the row) or PLANISH_STATUS_OUT_OF_MEMORY.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_pht_merge(struct planish_surface *surface,
                                      const uint32_t *cells,
                                      size_t count);

/**
 * Fills options with the defaults.
 *
 * options:     struct_size writable bytes.
 * struct_size: sizeof(planish_pht_simplify_options).
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INVALID_ARGUMENT (struct_size).
 */
PLANISH_API
enum planish_status planish_pht_simplify_options_init(struct planish_pht_simplify_options *options,
                                                      size_t struct_size);

/**
 * Merges as many cells of a PHT-spline as it can while no point moves by more than a tolerance.
 *
 * surface:       not NULL; changed on success.
 * tolerance:     in model units, not negative.
 * options:       NULL for the defaults.
 * out_deviation: receives a bound of how far a point has moved; NULL for none.
 * Arrays: out_deviation[1].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND,
 * PLANISH_STATUS_INVALID_ARGUMENT (tolerance), PLANISH_STATUS_VERSION or PLANISH_STATUS_CANCELLED.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_pht_simplify(struct planish_surface *surface,
                                         double tolerance,
                                         const struct planish_pht_simplify_options *options,
                                         double *out_deviation);

/**
 * Splits all cells of a PHT-spline that meet the inside of a rectangle until they have at least some level; the
 * surface stays the same.
 *
 * surface:   not NULL; changed.
 * region:    least u, largest u, least v, largest v.
 * level:     at most 20.
 * max_cells: with more cells the call fails.
 * Arrays: region[4].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND or
 * PLANISH_STATUS_TOO_LARGE (level, cells).
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_pht_refine_region(struct planish_surface *surface,
                                              const double *region,
                                              uint32_t level,
                                              size_t max_cells);

/**
 * Fills options with the defaults.
 *
 * options:     struct_size writable bytes.
 * struct_size: sizeof(planish_pht_convert_options).
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INVALID_ARGUMENT (struct_size).
 */
PLANISH_API
enum planish_status planish_pht_convert_options_init(struct planish_pht_convert_options *options,
                                                     size_t struct_size);

/**
 * Makes a PHT-spline of a tensor surface, with its weights and trims.
 *
 * surface:     not NULL, a tensor surface without creases: no knot inside occurs degree times.
 * options:     NULL for the defaults.
 * out_surface: receives a new surface; destroy with planish_surface_free().
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND (a PHT-spline is refused as
 * well), PLANISH_STATUS_INVALID_ARGUMENT (an option; a crease, the index is the knot: convert the parts of
 * planish_tensor_split()), PLANISH_STATUS_TOO_LARGE (the limits do not allow the tolerance) or
 * PLANISH_STATUS_VERSION.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_pht_from_surface(const struct planish_surface *surface,
                                             const struct planish_pht_convert_options *options,
                                             struct planish_surface **out_surface);

/**
 * Fills options with the defaults.
 *
 * options:     struct_size writable bytes.
 * struct_size: sizeof(planish_pht_patches_options).
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INVALID_ARGUMENT (struct_size).
 */
PLANISH_API
enum planish_status planish_pht_patches_options_init(struct planish_pht_patches_options *options,
                                                     size_t struct_size);

/**
 * Makes tensor surfaces that together are a PHT-spline exactly. They meet with equal parameters. Each has its part of
 * the trims; one outside of them has a trim without area.
 *
 * surface:      not NULL.
 * options:      NULL for the defaults.
 * out_surfaces: receives new surfaces; destroy each with planish_surface_free(). NULL asks for the number.
 * count:        handles that out_surfaces has room for.
 * out_count:    receives the number of surfaces.
 * Arrays: out_surfaces[count], out_count[1].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND,
 * PLANISH_STATUS_BUFFER_TOO_SMALL (nothing is made), PLANISH_STATUS_NOT_FINITE (a number would overflow),
 * PLANISH_STATUS_VERSION or PLANISH_STATUS_CANCELLED.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_pht_to_tensor_patches(const struct planish_surface *surface,
                                                  const struct planish_pht_patches_options *options,
                                                  struct planish_surface **out_surfaces,
                                                  size_t count,
                                                  size_t *out_count);

/**
 * Makes two PHT-splines meet with common tangents along an edge of each: both get the same vertices there, by
 * splits, and the means of their positions and derivatives. Changes neither if they cannot be stitched.
 *
 * first:       not NULL, not second; changed.
 * first_side:  a planish_border_side.
 * second:      not NULL; changed.
 * second_side: a planish_border_side.
 * is_reversed: 1 if the edges run in opposite directions, else 0.
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND or
 * PLANISH_STATUS_INVALID_ARGUMENT (a side; the dimensions or the initial grids along the edges differ).
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_pht_stitch(struct planish_surface *first,
                                       uint32_t first_side,
                                       struct planish_surface *second,
                                       uint32_t second_side,
                                       uint32_t is_reversed);

/**
 * Number of cells (leaves) of a PHT-spline; 0 for NULL and other families. Cell k is patch k of
 * planish_surface_copy_patch().
 */
PLANISH_API size_t planish_pht_cell_count(const struct planish_surface *surface);

/**
 * Number of basis vertices of a PHT-spline, each with four control points; 0 for NULL and other families.
 */
PLANISH_API size_t planish_pht_vertex_count(const struct planish_surface *surface);

/**
 * Number of T-vertices of a PHT-spline: they lie inside an edge of a cell, their host, and have its data; 0 for
 * NULL and other families.
 */
PLANISH_API
size_t planish_pht_hanging_count(const struct planish_surface *surface);

/**
 * Numbers of a row of data: dim, or dim + 1 with weights; 0 for NULL and other families.
 */
PLANISH_API size_t planish_pht_width(const struct planish_surface *surface);

/**
 * Copies the addresses of the cells of a PHT-spline.
 *
 * surface:   not NULL.
 * out_cells: receives planish_pht_cell_count() rows of level, i, j.
 * count:     rows that out_cells has room for.
 * Arrays: out_cells[pht_cell_count, 3].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND or
 * PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_pht_copy_cells(const struct planish_surface *surface,
                                           uint32_t *out_cells,
                                           size_t count);

/**
 * Copies the parameters of the basis vertices of a PHT-spline, ordered along u, then along v.
 *
 * surface: not NULL.
 * out_uv:  receives planish_pht_vertex_count() rows of u, v.
 * count:   rows that out_uv has room for.
 * Arrays: out_uv[pht_vertex_count, 2].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND or
 * PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_pht_copy_vertices(const struct planish_surface *surface,
                                              double *out_uv,
                                              size_t count);

/**
 * Copies the T-vertices of a PHT-spline with their hosts.
 *
 * surface:   not NULL.
 * out_uv:    receives planish_pht_hanging_count() rows of u, v; NULL for none.
 * out_hosts: receives as many numbers of cells; NULL for none.
 * count:     rows that each has room for.
 * Arrays: out_uv[pht_hanging_count, 2], out_hosts[pht_hanging_count].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND or
 * PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_pht_copy_hanging(const struct planish_surface *surface,
                                             double *out_uv,
                                             uint32_t *out_hosts,
                                             size_t count);

/**
 * Copies the numbers of the cells that share a part of an edge with a cell: those at its least u, largest u,
 * least v and largest v, in order along each.
 *
 * surface:   not NULL.
 * cell:      below planish_pht_cell_count().
 * out_cells: receives the numbers; NULL asks how many there are.
 * count:     numbers that out_cells has room for.
 * out_count: receives how many there are.
 * Arrays: out_cells[count], out_count[1].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND, PLANISH_STATUS_INDEX or
 * PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_pht_copy_neighbours(const struct planish_surface *surface,
                                                size_t cell,
                                                uint32_t *out_cells,
                                                size_t count,
                                                size_t *out_count);

/**
 * Copies the data of the basis vertices of a PHT-spline.
 *
 * surface:  not NULL.
 * out_data: receives for each of planish_pht_vertex_count() vertices four rows f, f_u, f_v, f_uv of
 *           planish_pht_width() numbers; with weights those of (w x, .., w).
 * count:    vertices that out_data has room for.
 * Arrays: out_data[pht_vertex_count, 4, pht_width].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND or
 * PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_pht_copy_data(const struct planish_surface *surface,
                                          double *out_data,
                                          size_t count);

/**
 * Replaces the data of some basis vertices of a PHT-spline, all or none.
 *
 * surface:  not NULL; changed.
 * vertices: count numbers below planish_pht_vertex_count().
 * count:    may be 0.
 * data:     for each of them four rows f, f_u, f_v, f_uv of planish_pht_width() numbers.
 * Arrays: vertices[count], data[count, 4, pht_width].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND, PLANISH_STATUS_INDEX,
 * PLANISH_STATUS_NOT_FINITE (the index is the vertex), PLANISH_STATUS_INVALID_ARGUMENT (a weight would not be
 * positive everywhere; the index is the cell) or PLANISH_STATUS_TOO_LARGE.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_pht_set_data(struct planish_surface *surface,
                                         const uint32_t *vertices,
                                         size_t count,
                                         const double *data);

/**
 * Copies the control points of a PHT-spline.
 *
 * surface:    not NULL.
 * basis:      a planish_pht_basis.
 * out_points: receives for each of planish_pht_vertex_count() vertices four rows --, +-, -+, ++ (towards less or
 *             more u, then v) of planish_pht_width() numbers; with weights those of (w x, .., w).
 * count:      vertices that out_points has room for.
 * Arrays: out_points[pht_vertex_count, 4, pht_width].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND,
 * PLANISH_STATUS_INVALID_ARGUMENT (basis) or PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_pht_copy_control_points(const struct planish_surface *surface,
                                                    uint32_t basis,
                                                    double *out_points,
                                                    size_t count);

/**
 * Replaces the control points of some basis vertices of a PHT-spline, all or none.
 *
 * surface:  not NULL; changed.
 * vertices: count numbers below planish_pht_vertex_count().
 * count:    may be 0.
 * basis:    a planish_pht_basis.
 * points:   for each of them four rows --, +-, -+, ++ of planish_pht_width() numbers.
 * Arrays: vertices[count], points[count, 4, pht_width].
 * Returns what planish_pht_set_data() returns; PLANISH_STATUS_INVALID_ARGUMENT also for basis.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_pht_set_control_points(struct planish_surface *surface,
                                                   const uint32_t *vertices,
                                                   size_t count,
                                                   uint32_t basis,
                                                   const double *points);

/**
 * Copies the operator that makes the Bezier ordinates of a cell from the control points that act on it.
 *
 * surface:      not NULL.
 * cell:         below planish_pht_cell_count().
 * basis:        a planish_pht_basis.
 * out_vertices: receives the basis vertices, ascending; NULL asks how many there are.
 * out_matrix:   receives 16 rows, v running fastest, of four numbers for each vertex; NULL for none.
 * count:        vertices that both have room for.
 * out_count:    receives how many there are.
 * Arrays: out_vertices[count], out_matrix[16, 4 * count], out_count[1].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND, PLANISH_STATUS_INDEX,
 * PLANISH_STATUS_INVALID_ARGUMENT (basis) or PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_pht_copy_extraction(const struct planish_surface *surface,
                                                size_t cell,
                                                uint32_t basis,
                                                uint32_t *out_vertices,
                                                double *out_matrix,
                                                size_t count,
                                                size_t *out_count);

/**
 * The number of the cell that has a parameter pair: on a line the one to the right or above; beyond the domain the
 * nearest. 0 for NULL and other families.
 */
PLANISH_API
size_t planish_pht_cell_at(const struct planish_surface *surface,
                           double u,
                           double v);

/**
 * Fills options with the defaults.
 *
 * options:     struct_size writable bytes.
 * struct_size: sizeof(planish_d1rc_options).
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INVALID_ARGUMENT (struct_size).
 */
PLANISH_API
enum planish_status planish_d1rc_options_init(struct planish_d1rc_options *options,
                                              size_t struct_size);

/**
 * Makes a smooth surface from a triangular control mesh: a disk, possibly with holes. Its nodes are the control
 * points; its parameters the domain, computed if it has none. The boundary loops become the trims.
 *
 * control_mesh: not NULL; not kept.
 * options:      NULL for the defaults.
 * out_surface:  receives a new surface; destroy with planish_surface_free().
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option),
 * PLANISH_STATUS_NOT_FINITE (an option), PLANISH_STATUS_INDEX (a node that does not exist; the index is its place
 * among the edges or corners), PLANISH_STATUS_TOPOLOGY (no disk; a sharp edge that is no edge, the index is its
 * place; configurations that do not close, the index is the node), PLANISH_STATUS_DEGENERATE (a face turned over
 * or without area in the parameters, the index is the face; too few faces for the degree; no room for knots beyond
 * the boundary, the index is the node), or what planish_mesh_parameterize() returns.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_d1rc_new(const struct planish_mesh *control_mesh,
                                     const struct planish_d1rc_options *options,
                                     struct planish_surface **out_surface);

/**
 * The degree of a D1RC-spline; 0 for NULL and for surfaces of other kinds.
 */
PLANISH_API uint32_t planish_d1rc_degree(const struct planish_surface *surface);

/**
 * Gives a D1RC-spline other sharp edges and corners; control points and trims stay.
 *
 * surface:      not NULL; changed.
 * sharp_edges:  edge_count pairs of control points joined by an edge.
 * edge_count:   may be 0.
 * corners:      corner_count control points to be interpolated; NULL if there are none.
 * corner_count: may be 0.
 * Arrays: sharp_edges[edge_count, 2], corners[corner_count].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND, PLANISH_STATUS_INDEX,
 * PLANISH_STATUS_TOPOLOGY or PLANISH_STATUS_DEGENERATE, with the index, as planish_d1rc_new().
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_d1rc_set_sharp_edges(struct planish_surface *surface,
                                                 const uint32_t *sharp_edges,
                                                 size_t edge_count,
                                                 const uint32_t *corners,
                                                 size_t corner_count);

/**
 * Copies the sharp edges of a D1RC-spline, those found by their angle included.
 *
 * surface:   not NULL.
 * out_edges: receives pairs of control points; NULL asks how many there are.
 * count:     pairs that out_edges has room for.
 * out_count: receives how many there are.
 * Arrays: out_edges[count, 2], out_count[1].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND or
 * PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_d1rc_copy_sharp_edges(const struct planish_surface *surface,
                                                  uint32_t *out_edges,
                                                  size_t count,
                                                  size_t *out_count);

/**
 * Copies the control points of a D1RC-spline, in the order of the nodes of its control mesh.
 *
 * surface:    not NULL.
 * out_points: receives planish_surface_coefficient_count() rows of dim numbers.
 * count:      rows that out_points has room for.
 * Arrays: out_points[surface_coefficient_count, surface_dim].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND or
 * PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_d1rc_copy_control_points(const struct planish_surface *surface,
                                                     double *out_points,
                                                     size_t count);

/**
 * Moves control points of a D1RC-spline. Parameters and functions stay, so this takes microseconds a point.
 *
 * surface:  not NULL; changed.
 * vertices: count control points.
 * count:    may be 0.
 * points:   count rows of dim numbers.
 * Arrays: vertices[count], points[count, surface_dim].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND, PLANISH_STATUS_INDEX or
 * PLANISH_STATUS_NOT_FINITE (the index is the row).
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_d1rc_set_control_points(struct planish_surface *surface,
                                                    const uint32_t *vertices,
                                                    size_t count,
                                                    const double *points);

/**
 * How often a D1RC-spline is differentiable across edges of its control mesh, for knots in general position: 0 on
 * creases and on edges that touch repeated knots, else the degree less one.
 *
 * surface:    not NULL.
 * edges:      count pairs of control points joined by an edge.
 * count:      may be 0.
 * out_orders: receives count numbers.
 * Arrays: edges[count, 2], out_orders[count].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND, PLANISH_STATUS_INDEX (no such
 * control point) or PLANISH_STATUS_TOPOLOGY (no edge); the index is the pair.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_d1rc_edge_continuity(const struct planish_surface *surface,
                                                 const uint32_t *edges,
                                                 size_t count,
                                                 uint32_t *out_orders);

/**
 * Copies the numbers of the faces of the control mesh whose surface moves with a control point, in order.
 *
 * surface:   not NULL.
 * vertex:    below planish_surface_coefficient_count().
 * out_faces: receives the numbers; NULL asks how many there are.
 * count:     numbers that out_faces has room for.
 * out_count: receives how many there are.
 * Arrays: out_faces[count], out_count[1].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND, PLANISH_STATUS_INDEX or
 * PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_d1rc_copy_influence(const struct planish_surface *surface,
                                                uint32_t vertex,
                                                uint32_t *out_faces,
                                                size_t count,
                                                size_t *out_count);

/**
 * The share of one control point in the surface at points; those of all control points sum to one.
 *
 * surface:    not NULL.
 * vertex:     below planish_surface_coefficient_count().
 * uv:         count rows of u, v.
 * count:      may be 0.
 * out_values: receives count numbers.
 * Arrays: uv[count, 2], out_values[count].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND, PLANISH_STATUS_INDEX (vertex),
 * PLANISH_STATUS_NOT_FINITE or PLANISH_STATUS_OUTSIDE (the index is the point).
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_d1rc_blending_values(const struct planish_surface *surface,
                                                 uint32_t vertex,
                                                 const double *uv,
                                                 size_t count,
                                                 double *out_values);

/**
 * Number of knots of a D1RC-spline, those beyond its border included; 0 for NULL and for surfaces of other kinds.
 */
PLANISH_API
size_t planish_d1rc_knot_count(const struct planish_surface *surface);

/**
 * Copies the (u,v) of the knots of a D1RC-spline: first those of the control mesh's nodes.
 *
 * surface: not NULL.
 * out_uv:  receives planish_d1rc_knot_count() rows of u, v.
 * count:   rows that out_uv has room for.
 * Arrays: out_uv[d1rc_knot_count, 2].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND or
 * PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_d1rc_copy_knots(const struct planish_surface *surface,
                                            double *out_uv,
                                            size_t count);

/**
 * Number of functions of a D1RC-spline; 0 for NULL and for surfaces of other kinds.
 */
PLANISH_API size_t planish_d1rc_configuration_count(const struct planish_surface *surface);

/**
 * Copies what a function of a D1RC-spline is made of: b(t) = sum over the edges (a,b) of det(a,b,t) M(t|X,a,b).
 *
 * surface:   not NULL.
 * index:     below planish_d1rc_configuration_count().
 * out_knots: receives the knots X, as many as the degree; NULL for none.
 * out_edges: receives pairs of knots, with X on their left; NULL asks how many there are.
 * count:     pairs that out_edges has room for.
 * out_count: receives how many there are.
 * Arrays: out_knots[d1rc_degree], out_edges[count, 2], out_count[1].
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND, PLANISH_STATUS_INDEX or
 * PLANISH_STATUS_BUFFER_TOO_SMALL.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_d1rc_copy_configuration(const struct planish_surface *surface,
                                                    size_t index,
                                                    uint32_t *out_knots,
                                                    uint32_t *out_edges,
                                                    size_t count,
                                                    size_t *out_count);

/**
 * Fits a D1RC-spline to the shape of a mesh within a tolerance: control points by least squares over a control mesh
 * that is given, or that grows until the tolerance is met. Nodes beyond the edges of the control mesh, which cuts
 * corners of the boundary, are measured at the nearest place on it.
 *
 * mesh:        a disk, possibly with holes; parameterized first if it has no parameters and no control mesh is
 *              given.
 * options:     NULL for the defaults; corners must be NULL. sharp_edges and sharp_angle are those of the control
 *              mesh if it is given, else of the mesh, and all of them stay sharp. parameterize NULL means a circle
 *              with one stretch step.
 * out_surface: receives a new surface; destroy with planish_surface_free().
 * out_report:  receives what the fit did and how good it is; NULL for no report. cell_count is that of the faces.
 * Returns PLANISH_STATUS_OK, PLANISH_STATUS_FOLDED_PARAMETERS, PLANISH_STATUS_TOLERANCE_NOT_MET or
 * PLANISH_STATUS_STAGNATED (the best surface found is there), or an error: PLANISH_STATUS_NULL_POINTER,
 * PLANISH_STATUS_INVALID_ARGUMENT (an option), PLANISH_STATUS_INDEX and PLANISH_STATUS_TOPOLOGY (sharp edges; the
 * index is the edge), PLANISH_STATUS_DEGENERATE (a triangle is flat or turned over in the parameters; it is the
 * index), PLANISH_STATUS_SINGULAR, PLANISH_STATUS_VERSION, PLANISH_STATUS_CANCELLED, or what
 * planish_mesh_parameterize() and planish_d1rc_new() return.
 */
PLANISH_API
PLANISH_NODISCARD
enum planish_status planish_d1rc_fit(const struct planish_mesh *mesh,
                                     const struct planish_d1rc_options *options,
                                     struct planish_surface **out_surface,
                                     struct planish_fit_report *out_report);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* PLANISH_H */
