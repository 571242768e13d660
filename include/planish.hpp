/* SPDX-License-Identifier: MIT OR Apache-2.0 */

/// @file
/// C++17 over planish.h: owners that free themselves, exceptions, vectors in and out.
///
/// Everything here is inline and calls planish.h, so no C++ ABI crosses the border of the library: a program
/// built with any compiler may use it. Options and reports are the records of planish.h:
/// @code
///     planish::mesh mesh = planish::mesh::read("panel.stl");
///     auto options = planish::defaults<planish_tensor_options>();
///     options.tolerance = 1e-4;
///     auto [surface, report, status] = planish::tensor_fit(mesh, options);
///     if (status == PLANISH_STATUS_TOLERANCE_NOT_MET) { ... report.max_error ... }
///     planish::point3 middle = surface.point(0.5, 0.5);
/// @endcode
/// Errors are thrown as planish::error. Remarks are not: a call that may have one returns it as its status.

#ifndef PLANISH_HPP
#define PLANISH_HPP

#include "planish.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

/// Smooth spline surfaces from triangle meshes, rows of points and fields, within a tolerance.
namespace planish {

/// u, v.
using point2 = std::array<double, 2>;
/// x, y, z.
using point3 = std::array<double, 3>;
/// Three nodes, counted from 0.
using triangle = std::array<std::uint32_t, 3>;

/// A call failed; nothing has been changed.
class error : public std::runtime_error {
 public:
  /// With its parts.
  error(planish_status status, const std::string &text, std::int64_t index)
      : std::runtime_error(text), status_(status), index_(index) {}

  /// What kind of failure it is: negative.
  planish_status status() const noexcept { return status_; }

  /// The name of the status, such as "PLANISH_STATUS_SINGULAR".
  const char *status_name() const noexcept { return planish_status_name(status_); }

  /// The node, triangle, row, value, knot, line or byte to blame, counted from 0; -1 if there is none.
  std::int64_t index() const noexcept { return index_; }

 private:
  planish_status status_;
  std::int64_t index_;
};

/// Hears how much of a call is done (0 to 1) and the error so far (NaN while unknown), and returns whether to
/// go on. It is called on the thread that made the call. If it returns false the call fails with
/// PLANISH_STATUS_CANCELLED; what it throws ends the call and is thrown on unchanged.
using progress = std::function<bool(double fraction, double error)>;

/// Rows of N numbers in somebody else's memory, which must live as long as the view.
template <class T, std::size_t N>
class rows {
 public:
  /// `count` rows from `data` on.
  rows(const T *data, std::size_t count) noexcept : data_(data), count_(count) {}

  /// All numbers of a vector, N to a row. Throws if some are left over.
  rows(const std::vector<T> &numbers) : data_(numbers.data()), count_(numbers.size() / N) {
    if (numbers.size() % N != 0) {
      throw error(PLANISH_STATUS_INVALID_ARGUMENT,
                  std::to_string(numbers.size()) + " numbers are not rows of " + std::to_string(N), -1);
    }
  }

  /// All rows of a vector.
  rows(const std::vector<std::array<T, N>> &points) noexcept
      : data_(points.empty() ? nullptr : points.front().data()), count_(points.size()) {}

  /// All rows of an array.
  template <std::size_t M>
  rows(const std::array<std::array<T, N>, M> &points) noexcept : data_(points[0].data()), count_(M) {
    static_assert(M > 0, "an array of no rows has no memory");
  }

  /// All numbers of an array, N to a row: a point2 is a row of two.
  template <std::size_t M>
  rows(const std::array<T, M> &numbers) noexcept : data_(numbers.data()), count_(M / N) {
    static_assert(M % N == 0, "numbers are left over");
  }

  /// The first number; may be NULL if there is none.
  const T *data() const noexcept { return data_; }
  /// Number of rows.
  std::size_t count() const noexcept { return count_; }

 private:
  static_assert(sizeof(std::array<T, N>) == N * sizeof(T), "rows are tight");
  const T *data_;
  std::size_t count_;
};

/// Some numbers in somebody else's memory.
template <class T>
using values = rows<T, 1>;

/// @cond
namespace detail {

inline planish_status init(planish_mesh_options &options) {
  return planish_mesh_options_init(&options, sizeof options);
}
inline planish_status init(planish_mesh_write_options &options) {
  return planish_mesh_write_options_init(&options, sizeof options);
}
inline planish_status init(planish_parameterize_options &options) {
  return planish_parameterize_options_init(&options, sizeof options);
}
inline planish_status init(planish_sphere_options &options) {
  return planish_sphere_options_init(&options, sizeof options);
}
inline planish_status init(planish_model_options &options) {
  return planish_model_options_init(&options, sizeof options);
}
inline planish_status init(planish_smooth_options &options) {
  return planish_smooth_options_init(&options, sizeof options);
}
inline planish_status init(planish_feature_options &options) {
  return planish_feature_options_init(&options, sizeof options);
}
inline planish_status init(planish_layout_options &options) {
  return planish_layout_options_init(&options, sizeof options);
}
inline planish_status init(planish_mesh_layout_options &options) {
  return planish_mesh_layout_options_init(&options, sizeof options);
}
inline planish_status init(planish_decimate_options &options) {
  return planish_decimate_options_init(&options, sizeof options);
}
inline planish_status init(planish_tensor_options &options) {
  return planish_tensor_options_init(&options, sizeof options);
}
inline planish_status init(planish_fair_options &options) {
  return planish_fair_options_init(&options, sizeof options);
}
inline planish_status init(planish_trim_options &options) {
  return planish_trim_options_init(&options, sizeof options);
}
inline planish_status init(planish_sample_rows_options &options) {
  return planish_sample_rows_options_init(&options, sizeof options);
}
inline planish_status init(planish_skin_options &options) {
  return planish_skin_options_init(&options, sizeof options);
}
inline planish_status init(planish_pht_options &options) {
  return planish_pht_options_init(&options, sizeof options);
}
inline planish_status init(planish_d1rc_options &options) {
  return planish_d1rc_options_init(&options, sizeof options);
}
inline planish_status init(planish_pht_convert_options &options) {
  return planish_pht_convert_options_init(&options, sizeof options);
}
inline planish_status init(planish_gradient_options &options) {
  return planish_gradient_options_init(&options, sizeof options);
}
inline planish_status init(planish_pht_simplify_options &options) {
  return planish_pht_simplify_options_init(&options, sizeof options);
}
inline planish_status init(planish_pht_patches_options &options) {
  return planish_pht_patches_options_init(&options, sizeof options);
}
inline planish_status init(planish_curve_options &options) {
  return planish_curve_options_init(&options, sizeof options);
}
inline planish_status init(planish_eval_options &options) {
  return planish_eval_options_init(&options, sizeof options);
}
inline planish_status init(planish_project_options &options) {
  return planish_project_options_init(&options, sizeof options);
}
inline planish_status init(planish_deviation_options &options) {
  return planish_deviation_options_init(&options, sizeof options);
}
inline planish_status init(planish_tessellate_options &options) {
  return planish_tessellate_options_init(&options, sizeof options);
}
inline planish_status init(planish_field_options &options) {
  return planish_field_options_init(&options, sizeof options);
}
inline planish_status init(planish_transfer_options &options) {
  return planish_transfer_options_init(&options, sizeof options);
}
inline planish_status init(planish_interpolate_options &options) {
  return planish_interpolate_options_init(&options, sizeof options);
}
inline planish_status init(planish_convert_options &options) {
  return planish_convert_options_init(&options, sizeof options);
}
inline planish_status init(planish_step_options &options) {
  return planish_step_options_init(&options, sizeof options);
}
inline planish_status init(planish_report_options &options) {
  return planish_report_options_init(&options, sizeof options);
}
inline planish_status init(planish_vtk_options &options) {
  return planish_vtk_options_init(&options, sizeof options);
}

[[noreturn]] inline void fail(planish_status status) {
  std::string text(planish_error_message(nullptr, 0), '\0');
  planish_error_message(text.data(), text.size() + 1); // the terminator of a string may be set to NUL
  throw error(status, text, planish_error_index());
}

inline planish_status checked(planish_status status) {
  if (status < 0) fail(status);
  return status;
}

template <class Report>
Report sized() {
  Report report{};
  report.struct_size = sizeof report;
  return report;
}

template <class T, std::size_t N>
T *flat(std::vector<std::array<T, N>> &points) {
  return points.empty() ? nullptr : points.front().data();
}

// Stands between the library and a user's function: what that throws must not meet the library's frames.
class listener {
 public:
  explicit listener(const progress &hear) : hear_(hear) {}

  template <class Options>
  void attach(Options &options) {
    if (!hear_) return; // the options may have a C callback of their own
    options.progress = &listener::call;
    options.user = this;
  }

  planish_status checked(planish_status status) const {
    if (thrown_) std::rethrow_exception(thrown_);
    return detail::checked(status);
  }

 private:
  static std::int32_t call(double fraction, double error, void *user) noexcept {
    auto &self = *static_cast<listener *>(user);
    if (self.thrown_) return 1;
    try {
      return self.hear_(fraction, error) ? 0 : 1;
    } catch (...) {
      self.thrown_ = std::current_exception();
      return 1;
    }
  }

  const progress &hear_;
  std::exception_ptr thrown_;
};

// A call whose options carry a user's function.
template <class Options, class Call>
planish_status heard(Options options, const progress &hear, const Call &call) {
  listener ear(hear);
  ear.attach(options);
  return ear.checked(call(&options));
}

// The numbers that `call` writes for `count` points of `width` numbers, at the stride of the options.
template <class Call>
std::vector<double> filled(std::size_t count, std::size_t width, const planish_eval_options &options,
                           const Call &call) {
  const std::size_t stride = std::max(options.out_stride, width);
  std::vector<double> out(count == 0 ? 0 : (count - 1) * stride + width);
  checked(call(out.data()));
  return out;
}

inline void check_rows(std::size_t value_count, std::size_t row_count, std::size_t dim) {
  if (value_count == row_count * dim) return;
  const std::string text = std::to_string(value_count) + " values do not fit " + std::to_string(row_count) +
                           " rows of " + std::to_string(dim);
  throw error(PLANISH_STATUS_INVALID_ARGUMENT, text, -1);
}

struct destroy {
  void operator()(planish_mesh *mesh) const noexcept { planish_mesh_free(mesh); }
  void operator()(planish_surface *surface) const noexcept { planish_surface_free(surface); }
  void operator()(planish_curve *curve) const noexcept { planish_curve_free(curve); }
  void operator()(planish_model *model) const noexcept { planish_model_free(model); }
  void operator()(planish_field_fitter *fitter) const noexcept { planish_field_fitter_free(fitter); }
  void operator()(planish_transfer *transfer) const noexcept { planish_transfer_free(transfer); }
  void operator()(planish_layout *layout) const noexcept { planish_layout_free(layout); }
};

} // namespace detail
/// @endcond

/// Options with every field at its default: `defaults<planish_tensor_options>()`.
template <class Options>
Options defaults() {
  Options options{};
  detail::checked(detail::init(options));
  return options;
}

/// The version of the library that is loaded, such as "0.2.0".
inline std::string version() { return planish_version(); }

/// Throws unless the library that is loaded serves programs that were compiled with this header.
inline void check_version() {
  detail::checked(planish_check_version(PLANISH_VERSION_MAJOR, PLANISH_VERSION_MINOR));
}

/// What came of a map.
struct parameterized {
  /// How good the map is.
  planish_parameterize_report report;
  /// PLANISH_STATUS_OK or PLANISH_STATUS_FOLDED_PARAMETERS.
  planish_status status;
};

/// How a label of a mesh hangs together.
struct label_part {
  /// The label.
  std::uint32_t label;
  /// Its triangles.
  std::size_t triangle_count;
  /// Its pieces, which share no edge: a face has one.
  std::size_t piece_count;
  /// The handles of all its pieces: a face has none.
  std::size_t handle_count;
};

/// What came of a map to the unit sphere.
struct sphere_map {
  /// x, y, z of each node: a unit vector, or zeros for a node without triangles.
  std::vector<point3> points;
  /// How good the map is.
  planish_sphere_report report;
  /// PLANISH_STATUS_OK or PLANISH_STATUS_FOLDED_PARAMETERS.
  planish_status status;
};

struct decimated;

/// A triangle mesh. Copies are deep; one that was moved from may only be assigned to or destroyed.
///
/// Const members may run at once on any threads; others need the mesh alone.
class mesh {
 public:
  /// From rows of x, y, z and rows of three nodes; both are copied.
  mesh(const rows<double, 3> &points, const rows<std::uint32_t, 3> &triangles,
       planish_mesh_options options = defaults<planish_mesh_options>()) {
    make(options, [&](planish_mesh **out_mesh) {
      return planish_mesh_new(points.data(), points.count(), triangles.data(), triangles.count(), &options,
                              out_mesh);
    });
  }

  /// From an OFF, OBJ, PLY or STL file, packed by gzip or not.
  static mesh read(const std::string &path,
                   planish_mesh_options options = defaults<planish_mesh_options>()) {
    mesh made;
    made.make(options, [&](planish_mesh **out_mesh) {
      return planish_mesh_read(path.c_str(), &options, out_mesh);
    });
    return made;
  }

  /// From the content of such a file; options.format says which, or the content itself.
  static mesh read_buffer(const void *bytes, std::size_t size,
                          planish_mesh_options options = defaults<planish_mesh_options>()) {
    mesh made;
    made.make(options, [&](planish_mesh **out_mesh) {
      return planish_mesh_read_buffer(bytes, size, &options, out_mesh);
    });
    return made;
  }

  /// Writes the mesh as OFF, OBJ, PLY or STL.
  void write(const std::string &path,
             const planish_mesh_write_options &options = defaults<planish_mesh_write_options>()) const {
    detail::checked(planish_mesh_write(get(), path.c_str(), &options));
  }

  /// Takes a mesh of planish.h over.
  explicit mesh(planish_mesh *handle) noexcept : handle_(handle) {}

  /// A deep copy.
  mesh(const mesh &other) : repairs_(other.repairs_) {
    planish_mesh *copy = nullptr;
    detail::checked(planish_mesh_clone(other.get(), &copy));
    handle_.reset(copy);
  }
  /// A deep copy.
  mesh &operator=(const mesh &other) { return *this = mesh(other); }
  /// Takes over.
  mesh(mesh &&other) noexcept = default;
  /// Takes over.
  mesh &operator=(mesh &&other) noexcept = default;
  ~mesh() = default;

  /// The handle, for calls of planish.h; it stays this object's.
  const planish_mesh *get() const noexcept { return handle_.get(); }
  /// The handle, for calls of planish.h; it stays this object's.
  planish_mesh *get() noexcept { return handle_.get(); }
  /// Gives the handle up; the caller destroys it.
  planish_mesh *release() noexcept { return handle_.release(); }

  /// What was done to the arrays or the file to make this mesh of them; all 0 if nothing.
  const planish_mesh_repairs &repairs() const noexcept { return repairs_; }

  /// Number of nodes.
  std::size_t point_count() const noexcept { return planish_mesh_point_count(get()); }
  /// Number of triangles.
  std::size_t triangle_count() const noexcept { return planish_mesh_triangle_count(get()); }
  /// Number of edges.
  std::size_t edge_count() const noexcept { return planish_mesh_edge_count(get()); }
  /// Number of parts that hang together by edges.
  std::size_t component_count() const noexcept { return planish_mesh_component_count(get()); }
  /// Number of handles.
  std::size_t genus() const noexcept { return planish_mesh_genus(get()); }
  /// Nodes that have triangles, minus edges, plus triangles.
  std::int64_t euler_characteristic() const noexcept { return planish_mesh_euler_characteristic(get()); }
  /// Number of boundary loops.
  std::size_t loop_count() const noexcept { return planish_mesh_loop_count(get()); }

  /// The nodes.
  std::vector<point3> points() const {
    std::vector<point3> points(point_count());
    detail::checked(planish_mesh_copy_points(get(), detail::flat(points), points.size()));
    return points;
  }

  /// The triangles.
  std::vector<triangle> triangles() const {
    std::vector<triangle> triangles(triangle_count());
    detail::checked(planish_mesh_copy_triangles(get(), detail::flat(triangles), triangles.size()));
    return triangles;
  }

  /// What each node was in the arrays or the file, or in the mesh that this one was cut from.
  std::vector<std::uint32_t> node_map() const {
    std::vector<std::uint32_t> nodes(point_count());
    detail::checked(planish_mesh_copy_node_map(get(), nodes.data(), nodes.size()));
    return nodes;
  }

  /// What each triangle was.
  std::vector<std::uint32_t> triangle_map() const {
    std::vector<std::uint32_t> triangles(triangle_count());
    detail::checked(planish_mesh_copy_triangle_map(get(), triangles.data(), triangles.size()));
    return triangles;
  }

  /// Moves the nodes; triangles, parameters and fields stay.
  void set_points(const rows<double, 3> &points) {
    detail::checked(planish_mesh_set_points(get(), points.data(), points.count()));
  }

  /// The nodes of a boundary loop in order, the surface on their left; loop 0 is the longest.
  std::vector<std::uint32_t> loop(std::size_t index) const {
    std::vector<std::uint32_t> nodes(planish_mesh_loop_point_count(get(), index));
    detail::checked(planish_mesh_copy_loop(get(), index, nodes.data(), nodes.size()));
    return nodes;
  }

  /// The names of the fields on the nodes.
  std::vector<std::string> field_names() const {
    std::vector<std::string> names(planish_mesh_field_count(get()));
    for (std::size_t i = 0; i < names.size(); ++i) {
      names[i].resize(planish_mesh_field_name(get(), i, nullptr, 0));
      planish_mesh_field_name(get(), i, names[i].data(), names[i].size() + 1);
    }
    return names;
  }

  /// The values of a field, NaN where nothing is known.
  std::vector<double> field(const std::string &name) const {
    std::vector<double> numbers(point_count());
    detail::checked(planish_mesh_copy_field(get(), name.c_str(), numbers.data(), numbers.size()));
    return numbers;
  }

  /// Adds a field with one value for each node, or replaces the one of this name.
  void set_field(const std::string &name, const values<double> &numbers) {
    detail::checked(planish_mesh_set_field(get(), name.c_str(), numbers.data(), numbers.count()));
  }

  /// Removes a field.
  void remove_field(const std::string &name) {
    detail::checked(planish_mesh_remove_field(get(), name.c_str()));
  }

  /// Whether the nodes have parameters.
  bool has_parameters() const noexcept { return planish_mesh_has_parameters(get()) != 0; }

  /// The (u,v) of the nodes.
  std::vector<point2> parameters() const {
    std::vector<point2> uv(point_count());
    detail::checked(planish_mesh_copy_parameters(get(), detail::flat(uv), uv.size()));
    return uv;
  }

  /// Gives each node its (u,v).
  void set_parameters(const rows<double, 2> &uv) {
    detail::checked(planish_mesh_set_parameters(get(), uv.data(), uv.count()));
  }

  /// Computes the (u,v) of the nodes of a disk, possibly with holes.
  parameterized parameterize(
      planish_parameterize_options options = defaults<planish_parameterize_options>(),
      const progress &hear = {}) {
    detail::listener listener(hear);
    listener.attach(options);
    parameterized result{detail::sized<planish_parameterize_report>(), PLANISH_STATUS_OK};
    result.status = listener.checked(planish_mesh_parameterize(get(), &options, &result.report));
    return result;
  }

  /// Finds the edges where the mesh is not smooth, as nodes: sharp ones, those between labels, those given, the border.
  std::vector<std::array<std::uint32_t, 2>> find_features(
      const planish_feature_options &options = defaults<planish_feature_options>()) const {
    std::size_t count = 0;
    std::vector<std::array<std::uint32_t, 2>> edges(edge_count());
    detail::checked(planish_mesh_find_features(get(), &options, detail::flat(edges), edges.size(), &count));
    edges.resize(count);
    return edges;
  }

  /// How each label hangs together, in increasing order; one label for each triangle.
  std::vector<label_part> label_parts(const values<std::uint32_t> &labels) const {
    std::size_t count = 0;
    detail::checked(planish_mesh_label_parts(get(), labels.data(), labels.count(), nullptr, nullptr, nullptr, nullptr, 0,
                                             &count));
    std::vector<std::uint32_t> found(count);
    std::vector<std::size_t> sizes(count), pieces(count), handles(count);
    detail::checked(planish_mesh_label_parts(get(), labels.data(), labels.count(), found.data(), sizes.data(),
                                             pieces.data(), handles.data(), count, &count));
    std::vector<label_part> parts;
    for (std::size_t k = 0; k < count; ++k) parts.push_back({found[k], sizes[k], pieces[k], handles[k]});
    return parts;
  }

  /// The places nearest to points.
  struct feet {
    /// Triangles that they lie on; PLANISH_NONE for points farther away than options.max_distance.
    std::vector<std::uint32_t> triangles;
    /// The places; NaN for the same points.
    std::vector<point3> points;
    /// Their distances; NaN for the same points.
    std::vector<double> distances;
  };

  /// Finds them anywhere on the mesh: the way back from places of a model to triangles, and so to labels.
  feet project(const rows<double, 3> &points,
               const planish_project_options &options = defaults<planish_project_options>(),
               const progress &hear = {}) const {
    const std::size_t count = points.count();
    feet found{std::vector<std::uint32_t>(count), std::vector<point3>(count), std::vector<double>(count)};
    detail::heard(options, hear, [&](const planish_project_options *given) {
      return planish_mesh_project(get(), points.data(), count, given, found.triangles.data(),
                                  detail::flat(found.points), found.distances.data());
    });
    return found;
  }

  /// Maps a closed mesh of one component and genus 0 on to the unit sphere, one to one.
  sphere_map map_to_sphere(planish_sphere_options options = defaults<planish_sphere_options>(),
                           const progress &hear = {}) const {
    detail::listener listener(hear);
    listener.attach(options);
    sphere_map result{std::vector<point3>(point_count()), detail::sized<planish_sphere_report>(), PLANISH_STATUS_OK};
    result.status = listener.checked(planish_mesh_map_to_sphere(
        get(), &options, detail::flat(result.points), result.points.size(), &result.report));
    return result;
  }

  /// A mesh without some triangles and without the nodes that only they used.
  mesh remove_triangles(const values<std::uint32_t> &triangles) const {
    planish_mesh *made = nullptr;
    detail::checked(planish_mesh_remove_triangles(get(), triangles.data(), triangles.count(), &made));
    return mesh(made);
  }

  /// A mesh that is cut open along a path of nodes.
  mesh cut_along(const values<std::uint32_t> &nodes) const {
    planish_mesh *made = nullptr;
    detail::checked(planish_mesh_cut_along(get(), nodes.data(), nodes.count(), &made));
    return mesh(made);
  }

  /// A mesh of each part that hangs together by edges.
  std::vector<mesh> split_components() const {
    std::vector<planish_mesh *> made(component_count(), nullptr);
    std::vector<mesh> meshes;
    meshes.reserve(made.size());
    detail::checked(planish_mesh_split_components(get(), made.data(), made.size()));
    for (planish_mesh *handle : made) meshes.emplace_back(handle);
    return meshes;
  }

  /// A mesh of fewer nodes of the same shape. Parameters and fields go with their nodes.
  decimated decimate(planish_decimate_options options = defaults<planish_decimate_options>(),
                     const progress &hear = {}) const;

  /// The nodes of the shortest path along edges, both ends included.
  std::vector<std::uint32_t> shortest_path(std::uint32_t from, std::uint32_t to) const {
    std::size_t count = 0;
    std::vector<std::uint32_t> nodes(point_count());
    detail::checked(planish_mesh_shortest_path(get(), from, to, nodes.data(), nodes.size(), &count));
    nodes.resize(count);
    return nodes;
  }

 private:
  mesh() = default;

  template <class Call>
  void make(planish_mesh_options &options, const Call &call) {
    if (!options.out_repairs) options.out_repairs = &repairs_;
    planish_mesh *made = nullptr;
    detail::checked(call(&made));
    handle_.reset(made);
    if (options.out_repairs != &repairs_) {
      // the caller's record may be of another version
      const auto size = std::min(options.out_repairs->struct_size, sizeof repairs_);
      std::copy_n(reinterpret_cast<const unsigned char *>(options.out_repairs), size,
                  reinterpret_cast<unsigned char *>(&repairs_));
      repairs_.struct_size = sizeof repairs_;
    }
  }

  std::unique_ptr<planish_mesh, detail::destroy> handle_;
  planish_mesh_repairs repairs_ = detail::sized<planish_mesh_repairs>();
};

/// A mesh of fewer nodes.
struct decimated {
  /// The mesh.
  mesh coarse;
  /// Its sharp edges, the smaller node first; empty if the options have an array of their own for them.
  std::vector<std::array<std::uint32_t, 2>> sharp_edges;
  /// What was done.
  planish_decimate_report report;
  /// PLANISH_STATUS_OK or PLANISH_STATUS_STAGNATED.
  planish_status status;
};

inline decimated mesh::decimate(planish_decimate_options options, const progress &hear) const {
  detail::listener listener(hear);
  listener.attach(options);
  std::vector<std::array<std::uint32_t, 2>> sharp_edges;
  if (!options.out_sharp_edges) {
    sharp_edges.resize(edge_count());
    options.out_sharp_edges = detail::flat(sharp_edges);
    options.out_sharp_edge_count = sharp_edges.size();
  }
  auto report = detail::sized<planish_decimate_report>();
  planish_mesh *made = nullptr;
  const planish_status status = listener.checked(planish_mesh_decimate(get(), &options, &made, &report));
  mesh coarse(made);
  sharp_edges.resize(std::min(sharp_edges.size(), report.sharp_edge_count));
  return {std::move(coarse), std::move(sharp_edges), report, status};
}

/// Principal curvatures of a surface in a point, and their directions; NaN where there is no normal.
struct curvature {
  /// The larger one; positive where the surface bends towards its normal.
  double k1;
  /// The smaller one.
  double k2;
  /// Unit tangent along which the curvature is k1.
  point3 d1;
  /// Unit tangent along which the curvature is k2.
  point3 d2;

  /// From eight numbers, as C has them.
  static curvature of(const std::array<double, 8> &c) {
    return {c[0], c[1], {c[2], c[3], c[4]}, {c[5], c[6], c[7]}};
  }
  /// Whether all numbers are equal.
  friend bool operator==(const curvature &a, const curvature &b) {
    return a.k1 == b.k1 && a.k2 == b.k2 && a.d1 == b.d1 && a.d2 == b.d2;
  }
};

/// Where points lie on a surface.
struct projected {
  /// The (u,v) of the nearest place of each point; NaN for points farther than options.max_distance.
  std::vector<point2> uv;
  /// Its distance; NaN likewise.
  std::vector<double> distances;
  /// PLANISH_STATUS_OK, PLANISH_STATUS_POINTS_OUTSIDE if some points are too far, or PLANISH_STATUS_NOT_PROVEN.
  planish_status status;
  /// The planish_flag bits of each point, of which PLANISH_FLAG_NOT_PROVEN occurs here.
  std::vector<std::uint8_t> flags;
};

/// How far a mesh lies from a surface.
struct deviated {
  /// Least distance of each node, in model units.
  std::vector<double> distances;
  /// Their largest, their means, and the way back if it was asked for.
  planish_deviation_report report;
};

/// A Bezier patch of a surface.
struct patch {
  /// Its rectangle of parameters, its degrees and sizes.
  planish_patch record;
  /// Rows of record.ordinate_width numbers, v running fastest.
  std::vector<double> ordinates;
};

/// A surface: a map from a rectangle of parameters (u,v) to R^dim. Copies are deep; one that was moved from may
/// only be assigned to or destroyed.
///
/// Const members may run at once on any threads; others need the surface alone.
class surface {
 public:
  /// Takes a surface of planish.h over.
  explicit surface(planish_surface *handle) noexcept : handle_(handle) {}

  /// A deep copy.
  surface(const surface &other) {
    planish_surface *copy = nullptr;
    detail::checked(planish_surface_clone(other.get(), &copy));
    handle_.reset(copy);
  }
  /// A deep copy.
  surface &operator=(const surface &other) { return *this = surface(other); }
  /// Takes over.
  surface(surface &&other) noexcept = default;
  /// Takes over.
  surface &operator=(surface &&other) noexcept = default;
  ~surface() = default;

  /// The handle, for calls of planish.h; it stays this object's.
  const planish_surface *get() const noexcept { return handle_.get(); }
  /// The handle, for calls of planish.h; it stays this object's.
  planish_surface *get() noexcept { return handle_.get(); }
  /// Gives the handle up; the caller destroys it.
  planish_surface *release() noexcept { return handle_.release(); }

  /// The family: a planish_kind.
  std::uint32_t kind() const noexcept { return planish_surface_kind(get()); }
  /// Numbers of a value: 1 for a scalar field, 3 for a shape.
  std::size_t dim() const noexcept { return planish_surface_dim(get()); }
  /// Number of control points.
  std::size_t coefficient_count() const noexcept { return planish_surface_coefficient_count(get()); }

  /// The name; empty without one. Copies and saved files have it too.
  std::string name() const {
    std::string text(planish_surface_name(get(), nullptr, 0), '\0');
    planish_surface_name(get(), text.data(), text.size() + 1);
    return text;
  }
  /// Gives the surface a name, in UTF-8.
  void set_name(const std::string &name) { detail::checked(planish_surface_set_name(get(), name.c_str())); }

  /// What one unit is.
  planish_unit unit() const noexcept { return static_cast<planish_unit>(planish_surface_unit(get())); }
  /// Says what one unit is; no number changes.
  void set_unit(planish_unit unit) { detail::checked(planish_surface_set_unit(get(), unit)); }

  /// The box of the surface over its whole domain: the least of each component, then the largest of each.
  std::vector<double> box() const {
    std::vector<double> box(2 * dim());
    detail::checked(planish_surface_box(get(), box.data()));
    return box;
  }

  /// The area of the part inside the trims of a surface in space; options say how finely it is divided.
  double area(const planish_tessellate_options &options = defaults<planish_tessellate_options>(),
              const progress &hear = {}) const {
    double area = 0;
    detail::heard(options, hear, [&](const planish_tessellate_options *given) {
      return planish_surface_area(get(), given, &area);
    });
    return area;
  }

  /// Whether the two sides of the domain that bound an axis are one curve.
  bool is_closed(planish_axis axis) const noexcept { return planish_surface_is_closed(get(), axis) != 0; }

  /// Least u, largest u, least v, largest v.
  std::array<double, 4> domain() const {
    std::array<double, 4> box{};
    detail::checked(planish_surface_domain(get(), box.data()));
    return box;
  }

  /// The box of the data's (u,v), in the same order: beyond it the surface is extrapolated.
  std::array<double, 4> data_box() const {
    std::array<double, 4> box{};
    detail::checked(planish_surface_data_box(get(), box.data()));
    return box;
  }

  /// Values at points, dim numbers each. With options.out_stride they stand that far apart. A point outside
  /// is an error unless options.outside says otherwise; options.out_flags tells which ones are.
  std::vector<double> eval(const rows<double, 2> &uv,
                           const planish_eval_options &options = defaults<planish_eval_options>()) const {
    return detail::filled(uv.count(), dim(), options, [&](double *out) {
      return planish_surface_eval(get(), uv.data(), uv.count(), &options, out);
    });
  }

  /// The value at one point, as a vector of dim numbers.
  std::vector<double> value(double u, double v) const {
    return eval(point2{u, v});
  }

  /// The place of one point of a surface in space.
  point3 point(double u, double v) const {
    if (dim() != 3) {
      const std::string text = "a surface of dimension " + std::to_string(dim()) + " has no points in space";
      throw error(PLANISH_STATUS_INVALID_ARGUMENT, text, -1);
    }
    const point2 uv{u, v};
    point3 point{};
    detail::checked(planish_surface_eval(get(), uv.data(), 1, nullptr, point.data()));
    return point;
  }

  /// Values and derivatives up to `max_derivative` at points: for each the rows S; Su, Sv; Suu, Suv, Svv.
  std::vector<double> eval_derivatives(
      const rows<double, 2> &uv, std::uint32_t max_derivative,
      const planish_eval_options &options = defaults<planish_eval_options>()) const {
    const std::size_t degree = std::min<std::size_t>(max_derivative, 2); // the call refuses more
    const std::size_t row_count = (degree + 1) * (degree + 2) / 2;
    return detail::filled(uv.count(), row_count * dim(), options, [&](double *out) {
      return planish_surface_eval_derivatives(get(), uv.data(), uv.count(), max_derivative, &options, out);
    });
  }

  /// Values at all pairs of some u and some v, v running fastest.
  std::vector<double> eval_grid(
      const values<double> &u, const values<double> &v,
      const planish_eval_options &options = defaults<planish_eval_options>()) const {
    return detail::filled(u.count() * v.count(), dim(), options, [&](double *out) {
      return planish_surface_eval_grid(get(), u.data(), u.count(), v.data(), v.count(), &options, out);
    });
  }

  /// Unit normals at points of a surface in space.
  std::vector<point3> normals(const rows<double, 2> &uv,
                              planish_eval_options options = defaults<planish_eval_options>()) const {
    options.out_stride = 0;
    std::vector<point3> normals(uv.count());
    detail::checked(
        planish_surface_normals(get(), uv.data(), uv.count(), &options, detail::flat(normals)));
    return normals;
  }

  /// Principal curvatures and directions at points of a surface in space.
  std::vector<curvature> curvatures(
      const rows<double, 2> &uv,
      planish_eval_options options = defaults<planish_eval_options>()) const {
    options.out_stride = 0;
    std::vector<std::array<double, 8>> all(uv.count());
    detail::checked(planish_surface_curvatures(get(), uv.data(), uv.count(), &options, detail::flat(all)));
    std::vector<curvature> curvatures;
    std::transform(all.begin(), all.end(), std::back_inserter(curvatures), curvature::of);
    return curvatures;
  }

  /// The closed polylines in (u,v) that bound the part that counts, the outer one first; none if all counts.
  std::vector<std::vector<point2>> trims() const {
    std::vector<std::vector<point2>> trims(planish_surface_trim_count(get()));
    for (std::size_t i = 0; i < trims.size(); ++i) {
      trims[i].resize(planish_surface_trim_point_count(get(), i));
      detail::checked(planish_surface_copy_trim(get(), i, detail::flat(trims[i]), trims[i].size()));
    }
    return trims;
  }

  /// Replaces the trims; none lets the whole domain count.
  void set_trims(const std::vector<std::vector<point2>> &trims) {
    std::vector<point2> uv;
    std::vector<std::size_t> counts;
    for (const auto &trim : trims) {
      uv.insert(uv.end(), trim.begin(), trim.end());
      counts.push_back(trim.size());
    }
    detail::checked(planish_surface_set_trims(get(), detail::flat(uv), counts.data(), counts.size()));
  }

  /// The nearest places of points, rows of dim numbers, inside the trims unless the options say otherwise.
  projected project(const values<double> &points,
                    const planish_project_options &options = defaults<planish_project_options>(),
                    const progress &hear = {}) const {
    const std::size_t width = std::max<std::size_t>(dim(), 1), count = points.count() / width;
    if (points.count() % width != 0) {
      const std::string text = std::to_string(points.count()) + " numbers are not rows of " + std::to_string(width);
      throw error(PLANISH_STATUS_INVALID_ARGUMENT, text, -1);
    }
    projected result{std::vector<point2>(count), std::vector<double>(count), PLANISH_STATUS_OK,
                     std::vector<std::uint8_t>(count)};
    planish_project_options with_flags = options;
    with_flags.out_flags = result.flags.data();
    result.status = detail::heard(with_flags, hear, [&](const planish_project_options *given) {
      return planish_surface_project(get(), points.data(), count, given, detail::flat(result.uv),
                                     result.distances.data());
    });
    return result;
  }

  /// The nearest places of points in space.
  projected project(const std::vector<point3> &points,
                    const planish_project_options &options = defaults<planish_project_options>(),
                    const progress &hear = {}) const {
    const rows<double, 3> flat(points);
    return project(values<double>(flat.data(), 3 * flat.count()), options, hear);
  }

  /// How far the nodes of a mesh lie from a surface in space.
  deviated deviation(const mesh &mesh,
                     const planish_deviation_options &options = defaults<planish_deviation_options>(),
                     const progress &hear = {}) const {
    deviated result{std::vector<double>(mesh.point_count()), detail::sized<planish_deviation_report>()};
    detail::heard(options, hear, [&](const planish_deviation_options *given) {
      return planish_surface_deviation(get(), mesh.get(), given, result.distances.data(), result.distances.size(),
                                       &result.report);
    });
    return result;
  }

  /// A triangle mesh of a surface in space, with its (u,v) as parameters.
  mesh tessellate(const planish_tessellate_options &options = defaults<planish_tessellate_options>(),
                  const progress &hear = {}) const {
    planish_mesh *made = nullptr;
    detail::heard(options, hear, [&](const planish_tessellate_options *given) {
      return planish_surface_tessellate(get(), given, &made);
    });
    return mesh(made);
  }

  /// Writes a VTK file (.vtu) of triangles, patches or the control net; `path` is UTF-8.
  void write_vtk(const std::string &path,
                 const planish_vtk_options &options = defaults<planish_vtk_options>(),
                 const progress &hear = {}) const {
    detail::heard(options, hear, [&](const planish_vtk_options *given) {
      return planish_surface_write_vtk(get(), path.c_str(), given);
    });
  }

  /// Measures the surface against a mesh and writes the result as one HTML page; `path` is UTF-8.
  void write_report(const mesh &measured, const std::string &path,
                    const planish_report_options &options = defaults<planish_report_options>()) const {
    detail::checked(planish_surface_write_report(get(), measured.get(), path.c_str(), &options));
  }

  /// Writes a STEP file of one trimmed face, or of a T-spline in strips; `path` is UTF-8.
  planish_step_report write_step(const std::string &path,
                                 planish_step_options options = defaults<planish_step_options>(),
                                 const progress &hear = {}) const {
    auto report = detail::sized<planish_step_report>();
    if (!options.out_report) options.out_report = &report;
    detail::heard(options, hear, [&](const planish_step_options *given) {
      return planish_surface_write_step(get(), path.c_str(), given);
    });
    return options.out_report == &report ? report : *options.out_report;
  }

  /// Everything the surface is, as bytes that surface::load() takes.
  std::vector<std::uint8_t> save() const {
    std::vector<std::uint8_t> bytes(planish_surface_save_size(get()));
    detail::checked(planish_surface_save(get(), bytes.data(), bytes.size()));
    return bytes;
  }

  /// Writes these bytes to a file; `path` is UTF-8.
  void save_file(const std::string &path) const {
    detail::checked(planish_surface_save_file(get(), path.c_str()));
  }

  /// The surface that bytes of save() hold.
  static surface load(const values<std::uint8_t> &bytes) {
    planish_surface *made = nullptr;
    detail::checked(planish_surface_load(bytes.data(), bytes.count(), &made));
    return surface(made);
  }

  /// The surface that a file of save_file() holds; `path` is UTF-8.
  static surface load_file(const std::string &path) {
    planish_surface *made = nullptr;
    detail::checked(planish_surface_load_file(path.c_str(), &made));
    return surface(made);
  }

  /// Number of Bezier patches; 0 for a family that is not polynomial on rectangles.
  std::size_t patch_count() const noexcept { return planish_surface_patch_count(get()); }

  /// The number of the patch over a parameter pair.
  std::size_t patch_at(double u, double v) const noexcept { return planish_surface_patch_at(get(), u, v); }

  /// The exact Bezier patch of a number below patch_count().
  planish::patch patch(std::size_t index) const {
    planish::patch result{detail::sized<planish_patch>(), {}};
    detail::checked(planish_surface_copy_patch(get(), index, &result.record, nullptr, 0));
    result.ordinates.resize(result.record.ordinate_count * result.record.ordinate_width);
    detail::checked(planish_surface_copy_patch(get(), index, nullptr, result.ordinates.data(),
                                               result.record.ordinate_count));
    return result;
  }

  /// The same surface as a tensor surface.
  surface to_tensor(const planish_convert_options &options = defaults<planish_convert_options>(),
                    const progress &hear = {}) const {
    planish_surface *made = nullptr;
    detail::heard(options, hear, [&](const planish_convert_options *given) {
      return planish_surface_to_tensor(get(), given, &made);
    });
    return surface(made);
  }

  /// Inserts knots into a tensor surface along a planish_axis; the surface stays the same.
  void insert_knots(std::uint32_t axis, const values<double> &knots) {
    detail::checked(planish_tensor_insert_knots(get(), axis, knots.data(), knots.count()));
  }

  /// Raises the degree of a tensor surface along a planish_axis; the surface stays the same.
  void elevate_degree(std::uint32_t axis, std::uint32_t degree) {
    detail::checked(planish_tensor_elevate_degree(get(), axis, degree));
  }

  /// Turns a tensor surface round along a planish_axis.
  void reverse(std::uint32_t axis) { detail::checked(planish_tensor_reverse(get(), axis)); }

  /// The parts of a tensor surface below and above a parameter along a planish_axis.
  std::array<surface, 2> split(std::uint32_t axis, double at) const {
    planish_surface *lower = nullptr, *upper = nullptr;
    detail::checked(planish_tensor_split(get(), axis, at, &lower, &upper));
    return {surface(lower), surface(upper)};
  }

  /// Degree of a tensor surface along a planish_axis; 0 for other families.
  std::uint32_t degree(std::uint32_t axis) const noexcept { return planish_tensor_degree(get(), axis); }

  /// Number of control points of a tensor surface along a planish_axis; 0 for other families.
  std::size_t control_point_count(std::uint32_t axis) const noexcept {
    return planish_tensor_control_point_count(get(), axis);
  }

  /// Knots of a tensor surface along a planish_axis.
  std::vector<double> knots(std::uint32_t axis) const {
    std::vector<double> knots(planish_tensor_knot_count(get(), axis));
    detail::checked(planish_tensor_copy_knots(get(), axis, knots.data(), knots.size()));
    return knots;
  }

  /// Control points of a tensor surface, rows of dim numbers, v running fastest.
  std::vector<double> control_points() const {
    std::vector<double> points(coefficient_count() * dim());
    detail::checked(planish_tensor_copy_control_points(get(), points.data(), coefficient_count()));
    return points;
  }

  /// Whether a tensor surface has weights.
  bool has_weights() const noexcept { return planish_tensor_has_weights(get()) != 0; }

  /// Weights of a tensor surface in the order of its control points; all 1 if it is polynomial.
  std::vector<double> weights() const {
    std::vector<double> weights(coefficient_count());
    detail::checked(planish_tensor_copy_weights(get(), weights.data(), weights.size()));
    return weights;
  }

 private:
  std::unique_ptr<planish_surface, detail::destroy> handle_;
};

/// A B-spline curve: a map from an interval of parameters u to R^dim. Copies are deep; one that was moved from
/// may only be assigned to or destroyed. Const members may run at once on any threads.
class curve {
 public:
  /// Takes a curve of planish.h over.
  explicit curve(planish_curve *handle) noexcept : handle_(handle) {}

  /// A deep copy.
  curve(const curve &other) {
    planish_curve *copy = nullptr;
    detail::checked(planish_curve_clone(other.get(), &copy));
    handle_.reset(copy);
  }
  /// A deep copy.
  curve &operator=(const curve &other) { return *this = curve(other); }
  /// Takes over.
  curve(curve &&other) noexcept = default;
  /// Takes over.
  curve &operator=(curve &&other) noexcept = default;
  ~curve() = default;

  /// The handle, for calls of planish.h; it stays this object's.
  const planish_curve *get() const noexcept { return handle_.get(); }
  /// Gives the handle up; the caller destroys it.
  planish_curve *release() noexcept { return handle_.release(); }

  /// Numbers of a value.
  std::size_t dim() const noexcept { return planish_curve_dim(get()); }
  /// Degree of the polynomial pieces.
  std::uint32_t degree() const noexcept { return planish_curve_degree(get()); }
  /// Number of control points.
  std::size_t control_point_count() const noexcept { return planish_curve_control_point_count(get()); }

  /// Least u, largest u.
  std::array<double, 2> domain() const {
    std::array<double, 2> interval{};
    detail::checked(planish_curve_domain(get(), interval.data()));
    return interval;
  }

  /// The knots, each as often as it occurs.
  std::vector<double> knots() const {
    std::vector<double> knots(planish_curve_knot_count(get()));
    detail::checked(planish_curve_copy_knots(get(), knots.data(), knots.size()));
    return knots;
  }

  /// The control points, rows of dim numbers.
  std::vector<double> control_points() const {
    std::vector<double> points(control_point_count() * dim());
    detail::checked(planish_curve_copy_control_points(get(), points.data(), control_point_count()));
    return points;
  }

  /// Values and derivatives up to `max_derivative` (at most 3) at parameters: for each the rows C, C', C'',
  /// C''' of dim numbers. A parameter outside is an error unless options.outside says otherwise.
  std::vector<double> eval(const values<double> &u, std::uint32_t max_derivative = 0,
                           const planish_eval_options &options = defaults<planish_eval_options>()) const {
    const std::size_t row_count = std::min<std::size_t>(max_derivative, 3) + 1; // the call refuses more
    return detail::filled(u.count(), row_count * dim(), options, [&](double *out) {
      return planish_curve_eval(get(), u.data(), u.count(), max_derivative, &options, out);
    });
  }

  /// The value at one parameter.
  std::vector<double> value(double u) const { return eval(std::array<double, 1>{u}); }

  /// The length, but for 1e-12 of it and the roundoff of the coordinates.
  double length() const noexcept { return planish_curve_length(get()); }

  /// The lengths from the start to parameters.
  std::vector<double> arc_lengths(const values<double> &u) const {
    std::vector<double> lengths(u.count());
    detail::checked(planish_curve_arc_lengths(get(), u.data(), u.count(), lengths.data()));
    return lengths;
  }

  /// The places nearest to rows of dim numbers.
  struct feet {
    /// Their parameters; NaN for points farther away than options.max_distance.
    std::vector<double> u;
    /// Their distances; NaN for the same points.
    std::vector<double> distances;
  };

  /// Finds them anywhere on the curve.
  feet project(const values<double> &points,
               const planish_project_options &options = defaults<planish_project_options>()) const {
    detail::check_rows(points.count(), points.count() / dim(), dim());
    const std::size_t count = points.count() / dim();
    feet found{std::vector<double>(count), std::vector<double>(count)};
    detail::checked(planish_curve_project(get(), points.data(), count, &options, found.u.data(),
                                          found.distances.data()));
    return found;
  }

  /// Everything the curve is, as bytes that curve::load() takes.
  std::vector<std::uint8_t> save() const {
    std::vector<std::uint8_t> bytes(planish_curve_save_size(get()));
    detail::checked(planish_curve_save(get(), bytes.data(), bytes.size()));
    return bytes;
  }
  /// The same into a file, which appears whole or not at all; `path` is UTF-8.
  void save_file(const std::string &path) const {
    detail::checked(planish_curve_save_file(get(), path.c_str()));
  }
  /// The curve that bytes of save() hold.
  static curve load(const values<std::uint8_t> &bytes) {
    planish_curve *made = nullptr;
    detail::checked(planish_curve_load(bytes.data(), bytes.count(), &made));
    return curve(made);
  }
  /// The curve that a file of save_file() holds; `path` is UTF-8.
  static curve load_file(const std::string &path) {
    planish_curve *made = nullptr;
    detail::checked(planish_curve_load_file(path.c_str(), &made));
    return curve(made);
  }

 private:
  std::unique_ptr<planish_curve, detail::destroy> handle_;
};

/// Faces, each a bounded part of a surface, that share edges and vertices. Faces, edges, vertices and shells have
/// numbers from 0 on. Copies are deep; one that was moved from is empty.
class model {
 public:
  /// Takes a model of planish.h over.
  explicit model(planish_model *handle) noexcept : handle_(handle) {}

  /// The part of a surface inside its trims as an open shell.
  static model from_surface(const surface &surface) {
    planish_model *made = nullptr;
    detail::checked(planish_model_from_surface(surface.get(), &made));
    return model(made);
  }

  /// A deep copy.
  model(const model &other) {
    planish_model *copy = nullptr;
    detail::checked(planish_model_clone(other.get(), &copy));
    handle_.reset(copy);
  }
  /// A deep copy.
  model &operator=(const model &other) { return *this = model(other); }
  /// Takes over.
  model(model &&other) noexcept = default;
  /// Takes over.
  model &operator=(model &&other) noexcept = default;
  ~model() = default;

  /// The handle, for calls of planish.h; it stays this object's.
  const planish_model *get() const noexcept { return handle_.get(); }
  /// Gives the handle up; the caller destroys it.
  planish_model *release() noexcept { return handle_.release(); }

  /// Numbers of a place: 3, or those of a value for a field over the faces of a model.
  std::size_t dim() const noexcept { return planish_model_dim(get()); }
  /// Number of faces.
  std::size_t face_count() const noexcept { return planish_model_face_count(get()); }
  /// Number of edges; one between two faces counts once.
  std::size_t edge_count() const noexcept { return planish_model_edge_count(get()); }
  /// Number of vertices.
  std::size_t vertex_count() const noexcept { return planish_model_vertex_count(get()); }
  /// Number of shells.
  std::size_t shell_count() const noexcept { return planish_model_shell_count(get()); }

  /// What a face is.
  planish_face_info face_info(std::size_t face) const {
    auto info = detail::sized<planish_face_info>();
    detail::checked(planish_model_face_info(get(), face, &info));
    return info;
  }

  /// A surface of its own for a face, with the loops of the face as trims.
  planish::surface face(std::size_t face) const {
    planish_surface *made = nullptr;
    detail::checked(planish_model_copy_face(get(), face, &made));
    return planish::surface(made);
  }

  /// What an edge is.
  planish_edge_info edge_info(std::size_t edge) const {
    auto info = detail::sized<planish_edge_info>();
    detail::checked(planish_model_copy_edge(get(), edge, nullptr, &info));
    return info;
  }

  /// The curve of an edge in space.
  planish::curve edge(std::size_t edge) const {
    planish_curve *made = nullptr;
    detail::checked(planish_model_copy_edge(get(), edge, &made, nullptr));
    return planish::curve(made);
  }

  /// An edge as a side of a face.
  struct coedge {
    /// The edge.
    std::uint32_t edge;
    /// Whether the loop runs along it.
    bool is_forward;
  };

  /// The loops of a face, the outer one first; each edge begins where the one before it ends.
  std::vector<std::vector<coedge>> loops(std::size_t face) const {
    std::vector<std::size_t> sizes(planish_model_loop_count(get(), face));
    std::vector<std::uint32_t> edges(planish_model_coedge_count(get(), face));
    std::vector<std::uint8_t> forward(edges.size());
    detail::checked(planish_model_copy_loops(get(), face, sizes.data(), sizes.size(), edges.data(),
                                             forward.data(), edges.size()));
    std::vector<std::vector<coedge>> loops;
    std::size_t next = 0;
    for (const std::size_t size : sizes) {
      loops.emplace_back();
      for (std::size_t k = 0; k < size; ++k, ++next) loops.back().push_back({edges[next], forward[next] != 0});
    }
    return loops;
  }

  /// Where an edge lies in the parameter plane of a face's surface; `index` counts its edges through all loops.
  planish::curve pcurve(std::size_t face, std::size_t index) const {
    planish_curve *made = nullptr;
    detail::checked(planish_model_copy_pcurve(get(), face, index, &made));
    return planish::curve(made);
  }

  /// The places of the vertices.
  std::vector<point3> vertices() const {
    std::vector<point3> points(vertex_count());
    detail::checked(planish_model_copy_vertices(get(), detail::flat(points), points.size()));
    return points;
  }

  /// Where the nodes of a mesh lie.
  struct node_places {
    /// Their faces; PLANISH_NONE for nodes without triangles.
    std::vector<std::uint32_t> faces;
    /// Their parameters; NaN for the same nodes.
    std::vector<point2> uv;
  };

  /// Where each node of the mesh lies that the model was fitted to.
  node_places locate_nodes() const {
    const std::size_t count = planish_model_node_count(get());
    node_places places{std::vector<std::uint32_t>(count), std::vector<point2>(count)};
    detail::checked(planish_model_locate_nodes(get(), places.faces.data(), detail::flat(places.uv), count));
    return places;
  }

  /// What a shell is.
  planish_shell_info shell_info(std::size_t shell) const {
    auto info = detail::sized<planish_shell_info>();
    detail::checked(planish_model_copy_shell(get(), shell, &info, nullptr, 0));
    return info;
  }

  /// The faces of a shell.
  std::vector<std::uint32_t> shell(std::size_t shell) const {
    std::vector<std::uint32_t> faces(shell_info(shell).face_count);
    detail::checked(planish_model_copy_shell(get(), shell, nullptr, faces.data(), faces.size()));
    return faces;
  }

  /// Measures the model against a mesh and writes the result as one HTML page; `path` is UTF-8.
  void write_report(const mesh &measured, const std::string &path,
                    const planish_report_options &options = defaults<planish_report_options>()) const {
    detail::checked(planish_model_write_report(get(), measured.get(), path.c_str(), &options));
  }

  /// Box, area, volume, and how well the faces meet.
  planish_measure_report measure() const {
    auto report = detail::sized<planish_measure_report>();
    detail::checked(planish_model_measure(get(), &report));
    return report;
  }

  /// Values and derivatives up to `max_derivative` (at most 2) at parameters on faces: for each point the rows S; Su,
  /// Sv; Suu, Suv, Svv of dim() numbers.
  std::vector<double> eval(const values<std::uint32_t> &faces, const rows<double, 2> &uv,
                           std::uint32_t max_derivative = 0,
                           const planish_eval_options &options = defaults<planish_eval_options>()) const {
    constexpr std::size_t row_counts[3] = {1, 3, 6};
    const std::size_t width = dim() * row_counts[std::min<std::uint32_t>(max_derivative, 2)]; // the call refuses more
    detail::check_rows(faces.count(), uv.count(), 1);
    return detail::filled(uv.count(), width, options, [&](double *out) {
      return planish_model_eval(get(), faces.data(), uv.data(), uv.count(), max_derivative, &options, out);
    });
  }

  /// The gradients in space of a field over the faces of this model, at parameters on faces: for each point
  /// field.dim() rows of 3 numbers.
  std::vector<double> field_gradient(const model &field, const values<std::uint32_t> &faces,
                                     const rows<double, 2> &uv) const {
    detail::check_rows(faces.count(), uv.count(), 1);
    std::vector<double> gradients(3 * field.dim() * uv.count());
    detail::checked(planish_model_field_gradient(get(), field.get(), faces.data(), uv.data(), uv.count(), nullptr,
                                                 gradients.data()));
    return gradients;
  }

  /// Unit normals at parameters on faces, out of the fronts of the faces.
  std::vector<point3> normals(const values<std::uint32_t> &faces, const rows<double, 2> &uv,
                              planish_eval_options options = defaults<planish_eval_options>()) const {
    detail::check_rows(faces.count(), uv.count(), 1);
    options.out_stride = 0;
    std::vector<point3> normals(uv.count());
    detail::checked(
        planish_model_normals(get(), faces.data(), uv.data(), uv.count(), &options, detail::flat(normals)));
    return normals;
  }

  /// Principal curvatures and directions at parameters on faces.
  std::vector<curvature> curvatures(const values<std::uint32_t> &faces, const rows<double, 2> &uv,
                                    planish_eval_options options = defaults<planish_eval_options>()) const {
    detail::check_rows(faces.count(), uv.count(), 1);
    options.out_stride = 0;
    std::vector<std::array<double, 8>> all(uv.count());
    detail::checked(
        planish_model_curvatures(get(), faces.data(), uv.data(), uv.count(), &options, detail::flat(all)));
    std::vector<curvature> curvatures;
    std::transform(all.begin(), all.end(), std::back_inserter(curvatures), curvature::of);
    return curvatures;
  }

  /// The places nearest to points.
  struct feet {
    /// Their faces; PLANISH_NONE for points farther away than options.max_distance.
    std::vector<std::uint32_t> faces;
    /// Their parameters; NaN for the same points.
    std::vector<point2> uv;
    /// Their distances; NaN for the same points.
    std::vector<double> distances;
  };

  /// Finds them anywhere on the model.
  feet project(const rows<double, 3> &points,
               const planish_project_options &options = defaults<planish_project_options>()) const {
    const std::size_t count = points.count();
    feet found{std::vector<std::uint32_t>(count), std::vector<point2>(count), std::vector<double>(count)};
    detail::checked(planish_model_project(get(), points.data(), count, &options, found.faces.data(),
                                          detail::flat(found.uv), found.distances.data()));
    return found;
  }

  /// How far the nodes of a mesh are from the model.
  deviated deviation(
      const planish::mesh &mesh,
      const planish_deviation_options &options = defaults<planish_deviation_options>()) const {
    deviated result{std::vector<double>(mesh.point_count()), detail::sized<planish_deviation_report>()};
    detail::checked(planish_model_deviation(get(), mesh.get(), &options, result.distances.data(),
                                            result.distances.size(), &result.report));
    return result;
  }

  /// A watertight triangle mesh of the model.
  planish::mesh tessellate(
      const planish_tessellate_options &options = defaults<planish_tessellate_options>()) const {
    planish_mesh *made = nullptr;
    detail::checked(planish_model_tessellate(get(), &options, &made));
    return planish::mesh(made);
  }

  /// Writes its triangles as a VTK file; `path` is UTF-8.
  void write_vtk(const std::string &path,
                 const planish_vtk_options &options = defaults<planish_vtk_options>()) const {
    detail::checked(planish_model_write_vtk(get(), path.c_str(), &options));
  }

  /// Writes a STEP file; `path` is UTF-8.
  planish_step_report write_step(const std::string &path,
                                 planish_step_options options = defaults<planish_step_options>()) const {
    auto report = detail::sized<planish_step_report>();
    if (!options.out_report) options.out_report = &report;
    detail::checked(planish_model_write_step(get(), path.c_str(), &options));
    return options.out_report == &report ? report : *options.out_report;
  }

  /// The content of that file.
  std::string step(const planish_step_options &options = defaults<planish_step_options>()) const {
    std::size_t size = 0;
    detail::checked(planish_model_write_step_memory(get(), &options, nullptr, 0, &size));
    std::string content(size, '\0');
    detail::checked(planish_model_write_step_memory(get(), &options, &content[0], size, &size));
    return content;
  }

  /// Everything the model is, as bytes that model::load() takes.
  std::vector<std::uint8_t> save() const {
    std::vector<std::uint8_t> bytes(planish_model_save_size(get()));
    detail::checked(planish_model_save(get(), bytes.data(), bytes.size()));
    return bytes;
  }
  /// The same into a file, which appears whole or not at all; `path` is UTF-8.
  void save_file(const std::string &path) const { detail::checked(planish_model_save_file(get(), path.c_str())); }
  /// The model that bytes of save() hold.
  static model load(const values<std::uint8_t> &bytes) {
    planish_model *made = nullptr;
    detail::checked(planish_model_load(bytes.data(), bytes.count(), &made));
    return model(made);
  }
  /// The model that a file of save_file() holds; `path` is UTF-8.
  static model load_file(const std::string &path) {
    planish_model *made = nullptr;
    detail::checked(planish_model_load_file(path.c_str(), &made));
    return model(made);
  }

 private:
  std::unique_ptr<planish_model, detail::destroy> handle_;
};

/// What came of a skin.
struct skinned {
  /// The T-spline.
  planish::surface surface;
  /// What every fit reports.
  planish_fit_report report;
  /// What only skins report.
  planish_skin_report skin;
  /// PLANISH_STATUS_OK, or the gravest remark, such as PLANISH_STATUS_INPUT_REPAIRED.
  planish_status status;
};

/// What came of a fit.
struct fitted {
  /// The best surface found.
  planish::surface surface;
  /// What the fit did and how good it is.
  planish_fit_report report;
  /// PLANISH_STATUS_OK, or the gravest remark, such as PLANISH_STATUS_TOLERANCE_NOT_MET.
  planish_status status;
};

/// What came of fitting a curve.
struct fitted_curve {
  /// The best curve found.
  planish::curve curve;
  /// What the fit did and how good it is.
  planish_fit_report report;
  /// PLANISH_STATUS_OK, or the gravest remark, such as PLANISH_STATUS_TOLERANCE_NOT_MET.
  planish_status status;
};

/// @cond
namespace detail {

template <class Fitted, class Owner, class Handle, class Options, class Call>
Fitted fit_any(Options options, const progress &hear, const Call &call) {
  listener listener(hear);
  listener.attach(options);
  auto report = sized<planish_fit_report>();
  Handle *made = nullptr;
  const planish_status status = call(&options, &made, &report);
  Owner owner(made); // freed even if the callback's last call has thrown
  listener.checked(status);
  return {std::move(owner), report, status};
}

template <class Options, class Call>
fitted fit(const Options &options, const progress &hear, const Call &call) {
  return fit_any<fitted, surface, planish_surface>(options, hear, call);
}

template <class Call>
skinned skin(planish_skin_options options, const progress &hear, const Call &call) {
  auto skin = sized<planish_skin_report>();
  if (!options.out_report) options.out_report = &skin;
  auto made = fit_any<fitted, surface, planish_surface>(options, hear, call);
  return {std::move(made.surface), made.report, options.out_report == &skin ? skin : *options.out_report,
          made.status};
}

} // namespace detail
/// @endcond

/// Fits a bicubic surface to the shape of a mesh. A mesh without parameters is parameterized first.
inline fitted tensor_fit(const mesh &mesh,
                         const planish_tensor_options &options = defaults<planish_tensor_options>(),
                         const progress &hear = {}) {
  return detail::fit(options, hear, [&](const planish_tensor_options *given, auto out, auto report) {
    return planish_tensor_fit(mesh.get(), given, out, report);
  });
}

/// Fits a bicubic surface to rows of `dim` numbers at scattered parameters.
inline fitted tensor_fit_points(const rows<double, 2> &uv, const values<double> &values, std::size_t dim,
                                const planish_tensor_options &options = defaults<planish_tensor_options>(),
                                const progress &hear = {}) {
  detail::check_rows(values.count(), uv.count(), dim);
  return detail::fit(options, hear, [&](const planish_tensor_options *given, auto out, auto report) {
    return planish_tensor_fit_points(uv.data(), values.data(), uv.count(), dim, given, out, report);
  });
}

namespace detail {

// Rows of a field of so many numbers: one a node, or one a triangle.
inline std::size_t field_rows(const mesh &mesh, std::size_t value_count, std::size_t dim) {
  const std::size_t nodes = mesh.point_count(), triangles = mesh.triangle_count();
  if (value_count != nodes * dim && value_count == triangles * dim) return triangles;
  check_rows(value_count, nodes, dim);
  return nodes;
}

} // namespace detail

/// Fits a bicubic surface to rows of `dim` numbers on the nodes of a mesh, or at the centroids of its triangles.
inline fitted tensor_fit_field(const mesh &mesh, const values<double> &values, std::size_t dim,
                               const planish_tensor_options &options = defaults<planish_tensor_options>(),
                               const progress &hear = {}) {
  const std::size_t count = detail::field_rows(mesh, values.count(), dim);
  return detail::fit(options, hear, [&](const planish_tensor_options *given, auto out, auto report) {
    return planish_tensor_fit_field(mesh.get(), values.data(), count, dim, given, out, report);
  });
}

/// What came of fairing.
struct faired {
  /// The surface of less energy.
  planish::surface surface;
  /// What was done.
  planish_fair_report report;
};

/// Lowers the energy of a surface within a tolerance of it, or of rows of data at places in its domain.
inline faired fair(const surface &surface, const planish_fair_options &given = defaults<planish_fair_options>(),
                   const rows<double, 2> &uv = rows<double, 2>(nullptr, 0),
                   const values<double> &values = planish::values<double>(nullptr, 0), const progress &hear = {}) {
  detail::check_rows(values.count(), uv.count(), surface.dim());
  planish_fair_options options = given;
  detail::listener listener(hear);
  listener.attach(options);
  auto report = detail::sized<planish_fair_report>();
  planish_surface *made = nullptr;
  const planish_status status =
      planish_surface_fair(surface.get(), uv.data(), values.data(), uv.count(), &options, &made, &report);
  planish::surface owner(made); // freed even if the callback's last call has thrown
  listener.checked(status);
  return {std::move(owner), report};
}

/// Gives a surface trims that follow loops of curves in space within the tolerance; a loop is one closed curve, or several
/// in order. Says how near they are.
inline planish_trim_report trim_by_curves(surface &surface, const std::vector<std::vector<curve>> &loops,
                                          const planish_trim_options &given = defaults<planish_trim_options>(),
                                          const progress &hear = {}) {
  std::vector<const planish_curve *> handles;
  std::vector<std::size_t> counts;
  for (const auto &loop : loops) {
    for (const curve &one : loop) handles.push_back(one.get());
    counts.push_back(loop.size());
  }
  auto report = detail::sized<planish_trim_report>();
  detail::heard(given, hear, [&](const planish_trim_options *options) {
    return planish_surface_trim_by_curves(surface.get(), handles.data(), counts.data(), counts.size(), options, &report);
  });
  return report;
}

/// Fits a D1RC-spline to the shape of a mesh: a triangular control mesh, sharp edges kept. A mesh without parameters
/// is parameterized first.
inline fitted d1rc_fit(const mesh &mesh, const planish_d1rc_options &options = defaults<planish_d1rc_options>(),
                       const progress &hear = {}) {
  return detail::fit(options, hear, [&](const planish_d1rc_options *given, auto out, auto report) {
    return planish_d1rc_fit(mesh.get(), given, out, report);
  });
}

/// Fits a PHT-spline to the shape of a mesh: cells as small as the shape asks. A mesh without parameters is
/// parameterized first.
inline fitted pht_fit(const mesh &mesh, const planish_pht_options &options = defaults<planish_pht_options>(),
                      const progress &hear = {}) {
  return detail::fit(options, hear, [&](const planish_pht_options *given, auto out, auto report) {
    return planish_pht_fit(mesh.get(), given, out, report);
  });
}

/// What came of fitting a field over the faces of a model.
struct fitted_field {
  /// A model of dimension dim with the faces of the one that it was fitted over.
  planish::model model;
  /// How good it is.
  planish_fit_report report;
  /// PLANISH_STATUS_OK or PLANISH_STATUS_TOLERANCE_NOT_MET.
  planish_status status;
};

/// What came of making a model of a mesh.
struct fitted_model {
  /// The best model found.
  planish::model model;
  /// What the fit did and how good it is.
  planish_model_report report;
  /// PLANISH_STATUS_OK, or the gravest remark, such as PLANISH_STATUS_TOLERANCE_NOT_MET.
  planish_status status;
  /// The face on which each node lies; PLANISH_NONE for a node without triangles.
  std::vector<std::uint32_t> faces;
  /// (u,v) of each node on its face.
  std::vector<point2> uv;
  /// The error of each node.
  std::vector<double> errors;
};

/// Makes a model of any mesh: a solid of a closed one, of exact faces or smooth patches, one chart of a mesh with a
/// boundary.
inline fitted_model model_fit(const mesh &mesh, planish_model_options options = defaults<planish_model_options>(),
                              const progress &hear = {}) {
  detail::listener listener(hear);
  listener.attach(options);
  const std::size_t count = mesh.point_count();
  std::vector<std::uint32_t> faces(count);
  std::vector<point2> uv(count);
  std::vector<double> errors(count);
  options.out_faces = faces.data();
  options.out_uv = detail::flat(uv);
  options.out_errors = errors.data();
  auto report = detail::sized<planish_model_report>();
  planish_model *made = nullptr;
  const planish_status status = planish_model_fit(mesh.get(), &options, &made, &report);
  model owner(made); // freed even if the callback's last call has thrown
  listener.checked(status);
  return {std::move(owner), report, status, std::move(faces), std::move(uv), std::move(errors)};
}

/// What came of making one smooth model of patches.
struct smoothed_model {
  /// The best model found.
  planish::model model;
  /// How far it is from the patches, and how far those were apart.
  planish_smooth_report report;
  /// PLANISH_STATUS_OK, or the gravest remark, such as PLANISH_STATUS_TOLERANCE_NOT_MET.
  planish_status status;
};

/// Makes one smooth model of tensor surfaces that meet edge to edge within a tolerance.
inline smoothed_model model_smooth_from_patches(const std::vector<const surface *> &patches,
                                                planish_smooth_options options = defaults<planish_smooth_options>(),
                                                const progress &hear = {}) {
  detail::listener listener(hear);
  listener.attach(options);
  std::vector<const planish_surface *> handles;
  for (const surface *patch : patches) handles.push_back(patch->get());
  auto report = detail::sized<planish_smooth_report>();
  planish_model *made = nullptr;
  const planish_status status =
      planish_model_smooth_from_patches(handles.data(), handles.size(), &options, &made, &report);
  model owner(made); // freed even if the callback's last call has thrown
  listener.checked(status);
  return {std::move(owner), report, status};
}

/// Fits a PHT-spline to rows of `dim` numbers at scattered parameters.
inline fitted pht_fit_points(const rows<double, 2> &uv, const values<double> &values, std::size_t dim,
                             const planish_pht_options &options = defaults<planish_pht_options>(),
                             const progress &hear = {}) {
  detail::check_rows(values.count(), uv.count(), dim);
  return detail::fit(options, hear, [&](const planish_pht_options *given, auto out, auto report) {
    return planish_pht_fit_points(uv.data(), values.data(), uv.count(), dim, given, out, report);
  });
}

/// Fits a PHT-spline to rows of `dim` numbers on the nodes of a mesh, or at the centroids of its triangles.
inline fitted pht_fit_field(const mesh &mesh, const values<double> &values, std::size_t dim,
                            const planish_pht_options &options = defaults<planish_pht_options>(),
                            const progress &hear = {}) {
  const std::size_t count = detail::field_rows(mesh, values.count(), dim);
  return detail::fit(options, hear, [&](const planish_pht_options *given, auto out, auto report) {
    return planish_pht_fit_field(mesh.get(), values.data(), count, dim, given, out, report);
  });
}

/// A cell of a PHT-spline: level, i, j.
using pht_cell = std::array<std::uint32_t, 3>;

/// Makes a PHT-spline from an initial grid and splits, with data of zero (and weights of 1).
inline surface pht_new(std::size_t dim, bool is_rational, const values<double> &lines_u,
                       const values<double> &lines_v, const std::vector<pht_cell> &splits = {}) {
  planish_surface *made = nullptr;
  detail::checked(planish_pht_new(dim, is_rational ? 1 : 0, lines_u.data(), lines_u.count(), lines_v.data(),
                                  lines_v.count(), splits.empty() ? nullptr : splits.front().data(),
                                  splits.size(), nullptr, 0, &made));
  return surface(made);
}

/// Makes a PHT-spline of a tensor surface, with its weights and trims.
inline surface pht_from_surface(
    const surface &tensor, const planish_pht_convert_options &options = defaults<planish_pht_convert_options>(),
    const progress &hear = {}) {
  planish_surface *made = nullptr;
  detail::heard(options, hear, [&](const planish_pht_convert_options *given) {
    return planish_pht_from_surface(tensor.get(), given, &made);
  });
  return surface(made);
}

/// Makes two PHT-splines meet with common tangents along an edge of each.
inline void pht_stitch(surface &first, planish_border_side first_side, surface &second,
                       planish_border_side second_side, bool is_reversed) {
  detail::checked(planish_pht_stitch(first.get(), first_side, second.get(), second_side, is_reversed ? 1 : 0));
}

/// An edge of a control mesh, by its ends.
using edge = std::array<std::uint32_t, 2>;

/// Makes a smooth surface from a triangular control mesh: a disk, possibly with holes. The edges in `sharp_edges` stay
/// sharp, the nodes in `corners` are interpolated.
inline surface d1rc_new(const mesh &control_mesh,
                        planish_d1rc_options options = defaults<planish_d1rc_options>(),
                        const std::vector<edge> &sharp_edges = {}, const std::vector<std::uint32_t> &corners = {},
                        const progress &hear = {}) {
  if (!sharp_edges.empty()) options.sharp_edges = sharp_edges.front().data();
  if (!sharp_edges.empty()) options.sharp_edge_count = sharp_edges.size();
  if (!corners.empty()) options.corners = corners.data();
  if (!corners.empty()) options.corner_count = corners.size();
  planish_surface *made = nullptr;
  detail::heard(options, hear, [&](const planish_d1rc_options *given) {
    return planish_d1rc_new(control_mesh.get(), given, &made);
  });
  return surface(made);
}

/// Fits a cubic curve to rows of `dim` numbers at parameters in any order.
inline fitted_curve curve_fit(const values<double> &u, const values<double> &values, std::size_t dim,
                              const planish_curve_options &options = defaults<planish_curve_options>(),
                              const progress &hear = {}) {
  detail::check_rows(values.count(), u.count(), dim);
  return detail::fit_any<fitted_curve, curve, planish_curve>(
      options, hear, [&](const planish_curve_options *given, auto out, auto report) {
        return planish_curve_fit(u.data(), values.data(), u.count(), dim, given, out, report);
      });
}

/// A D1RC-spline, seen as one: control points and sharp edges. It must not outlive its surface.
class d1rc {
 public:
  /// Throws if the surface is of another family.
  explicit d1rc(surface &of) : surface_(of.get()) {
    if (planish_surface_kind(surface_) != PLANISH_KIND_D1RC) {
      throw error(PLANISH_STATUS_WRONG_KIND, "the surface is no D1RC-spline", -1);
    }
  }

  /// Its degree.
  std::uint32_t degree() const noexcept { return planish_d1rc_degree(surface_); }
  /// Number of knots, those beyond the border included.
  std::size_t knot_count() const noexcept { return planish_d1rc_knot_count(surface_); }
  /// Number of functions.
  std::size_t configuration_count() const noexcept { return planish_d1rc_configuration_count(surface_); }

  /// The control points in the order of the control mesh.
  std::vector<double> control_points() const {
    const std::size_t count = planish_surface_coefficient_count(surface_);
    std::vector<double> points(count * planish_surface_dim(surface_));
    detail::checked(planish_d1rc_copy_control_points(surface_, points.data(), count));
    return points;
  }

  /// Moves control points to rows of `points`.
  void set_control_points(const std::vector<std::uint32_t> &vertices, const std::vector<double> &points) {
    detail::check_rows(points.size(), vertices.size(), planish_surface_dim(surface_));
    detail::checked(planish_d1rc_set_control_points(surface_, vertices.data(), vertices.size(), points.data()));
  }

  /// The sharp edges.
  std::vector<edge> sharp_edges() const {
    std::size_t count = 0;
    detail::checked(planish_d1rc_copy_sharp_edges(surface_, nullptr, 0, &count));
    std::vector<edge> edges(count);
    detail::checked(planish_d1rc_copy_sharp_edges(surface_, detail::flat(edges), count, &count));
    return edges;
  }

  /// Replaces the sharp edges and the corners.
  void set_sharp_edges(const std::vector<edge> &edges, const std::vector<std::uint32_t> &corners = {}) {
    detail::checked(planish_d1rc_set_sharp_edges(surface_, edges.empty() ? nullptr : edges.front().data(),
                                                 edges.size(), corners.data(), corners.size()));
  }

  /// How often the surface is differentiable across edges, for knots in general position.
  std::vector<std::uint32_t> edge_continuity(const std::vector<edge> &edges) const {
    std::vector<std::uint32_t> orders(edges.size());
    detail::checked(planish_d1rc_edge_continuity(surface_, edges.empty() ? nullptr : edges.front().data(),
                                                 edges.size(), orders.data()));
    return orders;
  }

  /// The faces of the control mesh whose surface moves with a control point.
  std::vector<std::uint32_t> influence(std::uint32_t vertex) const {
    std::size_t count = 0;
    detail::checked(planish_d1rc_copy_influence(surface_, vertex, nullptr, 0, &count));
    std::vector<std::uint32_t> faces(count);
    detail::checked(planish_d1rc_copy_influence(surface_, vertex, faces.data(), count, &count));
    return faces;
  }

  /// The share of one control point at points.
  std::vector<double> blending_values(std::uint32_t vertex, const rows<double, 2> &uv) const {
    std::vector<double> values(uv.count());
    detail::checked(planish_d1rc_blending_values(surface_, vertex, uv.data(), uv.count(), values.data()));
    return values;
  }

  /// The (u,v) of the knots, first those of the control mesh.
  std::vector<point2> knots() const {
    std::vector<point2> uv(knot_count());
    detail::checked(planish_d1rc_copy_knots(surface_, detail::flat(uv), uv.size()));
    return uv;
  }

  /// The knots X of a function, and the edges around them.
  std::pair<std::vector<std::uint32_t>, std::vector<edge>> configuration(std::size_t index) const {
    std::size_t count = 0;
    detail::checked(planish_d1rc_copy_configuration(surface_, index, nullptr, nullptr, 0, &count));
    std::pair<std::vector<std::uint32_t>, std::vector<edge>> made(degree(), count);
    detail::checked(planish_d1rc_copy_configuration(surface_, index, made.first.data(), detail::flat(made.second),
                                                    count, &count));
    return made;
  }

 private:
  planish_surface *surface_;
};

/// A PHT-spline, seen as one: cells, vertices and what can be done with them. It must not outlive its surface.
class pht {
 public:
  /// Throws if the surface is of another family.
  explicit pht(surface &of) : surface_(of.get()) {
    if (planish_surface_kind(surface_) != PLANISH_KIND_PHT) {
      throw error(PLANISH_STATUS_WRONG_KIND, "the surface is no PHT-spline", -1);
    }
  }

  /// Number of cells.
  std::size_t cell_count() const noexcept { return planish_pht_cell_count(surface_); }
  /// Number of basis vertices.
  std::size_t vertex_count() const noexcept { return planish_pht_vertex_count(surface_); }
  /// Number of T-vertices: inside an edge of a cell, their host.
  std::size_t hanging_count() const noexcept { return planish_pht_hanging_count(surface_); }
  /// Numbers of a row of data.
  std::size_t width() const noexcept { return planish_pht_width(surface_); }
  /// The cell that has u, v: on a line the one to the right or above, beyond the domain the nearest.
  std::size_t cell_at(double u, double v) const noexcept { return planish_pht_cell_at(surface_, u, v); }

  /// The addresses of the cells.
  std::vector<pht_cell> cells() const {
    std::vector<pht_cell> cells(cell_count());
    detail::checked(planish_pht_copy_cells(surface_, detail::flat(cells), cells.size()));
    return cells;
  }

  /// The parameters of the basis vertices.
  std::vector<point2> vertices() const {
    std::vector<point2> uv(vertex_count());
    detail::checked(planish_pht_copy_vertices(surface_, detail::flat(uv), uv.size()));
    return uv;
  }

  /// The parameters of the T-vertices.
  std::vector<point2> hanging() const {
    std::vector<point2> uv(hanging_count());
    detail::checked(planish_pht_copy_hanging(surface_, detail::flat(uv), nullptr, uv.size()));
    return uv;
  }

  /// The host of each T-vertex: the cell in whose edge it lies.
  std::vector<std::uint32_t> hosts() const {
    std::vector<std::uint32_t> hosts(hanging_count());
    detail::checked(planish_pht_copy_hanging(surface_, nullptr, hosts.data(), hosts.size()));
    return hosts;
  }

  /// The cells that share a part of an edge with a cell: at its least u, largest u, least v, largest v.
  std::vector<std::uint32_t> neighbours(std::size_t cell) const {
    std::size_t count = 0;
    detail::checked(planish_pht_copy_neighbours(surface_, cell, nullptr, 0, &count));
    std::vector<std::uint32_t> cells(count);
    detail::checked(planish_pht_copy_neighbours(surface_, cell, cells.data(), count, &count));
    return cells;
  }

  /// For each basis vertex the rows f, f_u, f_v, f_uv.
  std::vector<double> data() const {
    std::vector<double> data(4 * width() * vertex_count());
    detail::checked(planish_pht_copy_data(surface_, data.data(), vertex_count()));
    return data;
  }

  /// Replaces the data of some basis vertices.
  void set_data(const std::vector<std::uint32_t> &vertices, const std::vector<double> &data) {
    detail::check_rows(data.size(), vertices.size(), 4 * width());
    detail::checked(planish_pht_set_data(surface_, vertices.data(), vertices.size(), data.data()));
  }

  /// For each basis vertex the control points --, +-, -+, ++.
  std::vector<double> control_points(planish_pht_basis basis = PLANISH_PHT_BASIS_CANONICAL) const {
    std::vector<double> points(4 * width() * vertex_count());
    detail::checked(planish_pht_copy_control_points(surface_, basis, points.data(), vertex_count()));
    return points;
  }

  /// Replaces the control points of some basis vertices.
  void set_control_points(const std::vector<std::uint32_t> &vertices, const std::vector<double> &points,
                          planish_pht_basis basis = PLANISH_PHT_BASIS_CANONICAL) {
    detail::check_rows(points.size(), vertices.size(), 4 * width());
    detail::checked(
        planish_pht_set_control_points(surface_, vertices.data(), vertices.size(), basis, points.data()));
  }

  /// The operator that makes the Bezier ordinates of a cell from the control points of some basis vertices.
  struct extraction {
    /// The basis vertices that act on the cell, ascending.
    std::vector<std::uint32_t> vertices;
    /// 16 rows, v running fastest, of four numbers for each vertex.
    std::vector<double> matrix;
  };

  /// The operator of a cell.
  extraction extract(std::size_t cell, planish_pht_basis basis = PLANISH_PHT_BASIS_CANONICAL) const {
    std::size_t count = 0;
    detail::checked(planish_pht_copy_extraction(surface_, cell, basis, nullptr, nullptr, 0, &count));
    extraction made{std::vector<std::uint32_t>(count), std::vector<double>(64 * count)};
    detail::checked(planish_pht_copy_extraction(surface_, cell, basis, made.vertices.data(), made.matrix.data(), count,
                                                &count));
    return made;
  }

  /// Splits all cells that meet the inside of a rectangle (least u, largest u, least v, largest v) until they
  /// have at least some level; the surface stays the same.
  void refine_region(const std::array<double, 4> &region, std::uint32_t level, std::size_t max_cells = 200000) {
    detail::checked(planish_pht_refine_region(surface_, region.data(), level, max_cells));
  }

  /// Splits leaves; the surface stays the same.
  void split(const std::vector<pht_cell> &cells) {
    detail::checked(planish_pht_split(surface_, cells.empty() ? nullptr : cells.front().data(), cells.size()));
  }

  /// Merges the quarters of cells.
  void merge(const std::vector<pht_cell> &cells) {
    detail::checked(planish_pht_merge(surface_, cells.empty() ? nullptr : cells.front().data(), cells.size()));
  }

  /// Merges what it can while no point moves by more than `tolerance`; returns a bound of how far one has.
  double simplify(double tolerance,
                  const planish_pht_simplify_options &options = defaults<planish_pht_simplify_options>(),
                  const progress &hear = {}) {
    double deviation = 0;
    detail::heard(options, hear, [&](const planish_pht_simplify_options *given) {
      return planish_pht_simplify(surface_, tolerance, given, &deviation);
    });
    return deviation;
  }

  /// Exact tensor surfaces over cells whose levels differ by at most `level_spread`.
  std::vector<surface> tensor_patches(std::uint32_t level_spread) const {
    auto options = defaults<planish_pht_patches_options>();
    options.level_spread = level_spread;
    std::size_t count = 0;
    detail::checked(planish_pht_to_tensor_patches(surface_, &options, nullptr, 0, &count));
    std::vector<surface> patches;
    patches.reserve(count);
    std::vector<planish_surface *> handles(count);
    detail::checked(planish_pht_to_tensor_patches(surface_, &options, handles.data(), count, &count));
    for (planish_surface *handle : handles) patches.emplace_back(handle);
    return patches;
  }

 private:
  planish_surface *surface_;
};

/// Makes a tensor surface from its parts. Control points are rows of `dim` numbers, v running fastest; no
/// weights make it polynomial.
inline surface tensor_new(std::size_t dim, std::uint32_t degree_u, std::uint32_t degree_v,
                          const values<double> &knots_u, const values<double> &knots_v,
                          const values<double> &control_points, const std::vector<double> &weights = {}) {
  const auto count = [](const values<double> &knots, std::size_t degree) {
    return knots.count() > degree + 1 ? knots.count() - degree - 1 : 0;
  };
  const std::size_t expected = count(knots_u, degree_u) * count(knots_v, degree_v);
  if (control_points.count() != expected * dim || (!weights.empty() && weights.size() != expected)) {
    const std::string text = std::to_string(control_points.count()) + " numbers and " +
                             std::to_string(weights.size()) + " weights do not fit " + std::to_string(expected) +
                             " control points of dimension " + std::to_string(dim);
    throw error(PLANISH_STATUS_INVALID_ARGUMENT, text, -1);
  }
  planish_surface *made = nullptr;
  detail::checked(planish_tensor_new(dim, degree_u, degree_v, knots_u.data(), knots_u.count(), knots_v.data(),
                                     knots_v.count(), control_points.data(),
                                     weights.empty() ? nullptr : weights.data(), &made));
  return surface(made);
}

/// Fits fields on the nodes of one mesh, or at the same parameters, again and again.
///
/// Const members may run at once on any threads. It can be moved, not copied.
class field_fitter {
 public:
  /// For fields on the nodes of a mesh.
  explicit field_fitter(const mesh &mesh,
                        const planish_field_options &options = defaults<planish_field_options>()) {
    planish_field_fitter *made = nullptr;
    detail::checked(planish_field_fitter_new(mesh.get(), &options, &made));
    handle_.reset(made);
  }

  /// For fields at scattered parameters.
  explicit field_fitter(const rows<double, 2> &uv,
                        const planish_field_options &options = defaults<planish_field_options>()) {
    planish_field_fitter *made = nullptr;
    detail::checked(planish_field_fitter_new_points(uv.data(), uv.count(), &options, &made));
    handle_.reset(made);
  }

  /// For fields on the nodes of the mesh that a model of patches was fitted to; fit_model() fits them.
  field_fitter(const model &model, const mesh &mesh,
               const planish_field_options &options = defaults<planish_field_options>()) {
    planish_field_fitter *made = nullptr;
    detail::checked(planish_field_fitter_new_model(model.get(), mesh.get(), &options, &made));
    handle_.reset(made);
  }

  /// The handle, for calls of planish.h; it stays this object's.
  const planish_field_fitter *get() const noexcept { return handle_.get(); }

  /// Number of nodes.
  std::size_t point_count() const noexcept { return planish_field_fitter_point_count(get()); }

  /// Knots along u and v.
  std::array<std::size_t, 2> grid() const {
    std::array<std::size_t, 2> grid{};
    detail::checked(planish_field_fitter_grid(get(), grid.data()));
    return grid;
  }

  /// The (u,v) of the nodes.
  std::vector<point2> parameters() const {
    std::vector<point2> uv(point_count());
    detail::checked(planish_field_fitter_copy_parameters(get(), detail::flat(uv), uv.size()));
    return uv;
  }

  /// Fits rows of dim numbers, one a node, and measures the result.
  fitted fit(const values<double> &field, std::size_t dim) const {
    planish_surface *made = nullptr;
    auto report = detail::sized<planish_fit_report>();
    const planish_status status =
        detail::checked(planish_field_fitter_fit(get(), field.data(), rows_of(field, dim), dim, &made, &report));
    return {surface(made), report, status};
  }

  /// Fits rows of dim numbers, one a node, over the faces of a model, and measures the result.
  fitted_field fit_model(const values<double> &field, std::size_t dim) const {
    planish_model *made = nullptr;
    auto report = detail::sized<planish_fit_report>();
    const planish_status status = detail::checked(
        planish_field_fitter_fit_model(get(), field.data(), rows_of(field, dim), dim, &made, &report));
    return {model(made), report, status};
  }

  /// Turns a surface of fit() into that of other values, in its place, without measuring it.
  void update(surface &surface, const values<double> &field, std::size_t dim) const {
    detail::checked(planish_field_fitter_update(get(), surface.get(), field.data(), rows_of(field, dim), dim));
  }

 private:
  static std::size_t rows_of(const values<double> &field, std::size_t dim) {
    const std::size_t width = std::max<std::size_t>(dim, 1); // the call refuses 0
    if (field.count() % width != 0) {
      const std::string text = std::to_string(field.count()) + " numbers are not rows of " + std::to_string(width);
      throw error(PLANISH_STATUS_INVALID_ARGUMENT, text, -1);
    }
    return field.count() / width;
  }

  std::unique_ptr<planish_field_fitter, detail::destroy> handle_;
};

/// Carries values from the nodes of a source mesh to target points, and forces on these back to the nodes.
///
/// Const members may run at once on any threads. It can be moved, not copied.
class transfer {
 public:
  /// From the nodes of a mesh to points near it.
  transfer(const mesh &source, const rows<double, 3> &targets,
           const planish_transfer_options &options = defaults<planish_transfer_options>())
      : report_(detail::sized<planish_transfer_report>()) {
    planish_transfer *made = nullptr;
    detail::checked(
        planish_transfer_new(source.get(), targets.data(), targets.count(), &options, &made, &report_));
    handle_.reset(made);
  }

  /// From the nodes of the mesh that a model of patches was fitted to, to points near it.
  transfer(const model &model, const mesh &source, const rows<double, 3> &targets,
           const planish_transfer_options &options = defaults<planish_transfer_options>())
      : report_(detail::sized<planish_transfer_report>()) {
    planish_transfer *made = nullptr;
    detail::checked(planish_transfer_new_model(model.get(), source.get(), targets.data(), targets.count(), &options,
                                               &made, &report_));
    handle_.reset(made);
  }

  /// The handle, for calls of planish.h; it stays this object's.
  const planish_transfer *get() const noexcept { return handle_.get(); }
  /// How well source and targets lie on one another.
  const planish_transfer_report &report() const noexcept { return report_; }
  /// Number of nodes of the source.
  std::size_t source_count() const noexcept { return planish_transfer_source_count(get()); }
  /// Number of targets.
  std::size_t target_count() const noexcept { return planish_transfer_target_count(get()); }

  /// Where the targets lie on the source's surface.
  std::vector<point2> parameters() const {
    std::vector<point2> uv(target_count());
    detail::checked(planish_transfer_copy_parameters(get(), detail::flat(uv), uv.size()));
    return uv;
  }

  /// How far the targets are from it.
  std::vector<double> distances() const {
    std::vector<double> distances(target_count());
    detail::checked(planish_transfer_copy_distances(get(), distances.data(), distances.size()));
    return distances;
  }

  /// Values at the targets, from rows of dim numbers at the nodes of the source.
  std::vector<double> apply(const values<double> &field, std::size_t dim) const {
    detail::check_rows(field.count(), source_count(), dim);
    std::vector<double> out(target_count() * dim);
    detail::checked(planish_transfer_apply(get(), field.data(), source_count(), dim, out.data()));
    return out;
  }

  /// Forces at the nodes of the source, from rows of dim numbers on the targets: the transpose of apply().
  std::vector<double> apply_transpose(const values<double> &forces, std::size_t dim) const {
    detail::check_rows(forces.count(), target_count(), dim);
    std::vector<double> out(source_count() * dim);
    detail::checked(planish_transfer_apply_transpose(get(), forces.data(), target_count(), dim, out.data()));
    return out;
  }

  /// Sums of forces, moments about a point and work on both sides.
  planish_balance_report balance(const rows<double, 3> &displacements, const rows<double, 3> &forces,
                                 const point3 &about = {0, 0, 0}) const {
    auto report = detail::sized<planish_balance_report>();
    detail::checked(planish_transfer_balance(get(), displacements.data(), displacements.count(), forces.data(),
                                             forces.count(), about.data(), &report));
    return report;
  }

 private:
  std::unique_ptr<planish_transfer, detail::destroy> handle_;
  planish_transfer_report report_;
};

/// Quadrilateral patches and how they meet; made for a mesh, also the places of its nodes on them.
///
/// Const members may run at once on any threads. It can be moved, not copied.
class layout {
 public:
  /// Of quads with these corners, counter-clockwise seen from outside, whose sides meet.
  explicit layout(const rows<std::uint32_t, 4> &corners,
                  const planish_layout_options &options = defaults<planish_layout_options>()) {
    planish_layout *made = nullptr;
    detail::checked(planish_layout_new(corners.data(), corners.count(), &options, &made));
    handle_.reset(made);
  }

  /// Takes over a handle of C.
  explicit layout(planish_layout *handle) noexcept : handle_(handle) {}

  /// The six faces of a cube.
  static layout cube() {
    planish_layout *made = nullptr;
    detail::checked(planish_layout_cube(&made));
    return layout(made);
  }

  /// For a closed mesh of any genus, with the places of its nodes. The report is filled if it is given.
  static layout of_mesh(const mesh &mesh, planish_mesh_layout_options options = defaults<planish_mesh_layout_options>(),
                        const progress &hear = {}, planish_mesh_layout_report *report = nullptr) {
    detail::listener listener(hear);
    listener.attach(options);
    auto found = detail::sized<planish_mesh_layout_report>();
    planish_layout *made = nullptr;
    listener.checked(planish_layout_of_mesh(mesh.get(), &options, &made, &found));
    if (report) *report = found;
    return layout(made);
  }

  /// The handle, for calls of planish.h; it stays this object's.
  const planish_layout *get() const noexcept { return handle_.get(); }
  /// Number of quads.
  std::size_t quad_count() const noexcept { return planish_layout_quad_count(get()); }
  /// One more than the largest number of a vertex.
  std::size_t vertex_count() const noexcept { return planish_layout_vertex_count(get()); }
  /// Number of edges.
  std::size_t edge_count() const noexcept { return planish_layout_edge_count(get()); }
  /// Number of nodes with places; 0 if it was not made for a mesh.
  std::size_t node_count() const noexcept { return planish_layout_node_count(get()); }

  /// The corners of the quads, at (0,0), (1,0), (1,1), (0,1).
  std::vector<std::array<std::uint32_t, 4>> corners() const {
    std::vector<std::array<std::uint32_t, 4>> corners(quad_count());
    detail::checked(planish_layout_copy_corners(get(), detail::flat(corners), corners.size()));
    return corners;
  }

  /// The edges: two vertices, quad and side that run this way, quad and side that run the other way or all bits set.
  std::vector<std::array<std::uint32_t, 6>> edges() const {
    std::vector<std::array<std::uint32_t, 6>> edges(edge_count());
    detail::checked(planish_layout_copy_edges(get(), detail::flat(edges), edges.size()));
    return edges;
  }

  /// The number of quads around each vertex.
  std::vector<std::uint32_t> valences() const {
    std::vector<std::uint32_t> valences(vertex_count());
    detail::checked(planish_layout_copy_valences(get(), valences.data(), valences.size()));
    return valences;
  }

  /// The quad of each node of the mesh, and its parameters there.
  std::pair<std::vector<std::uint32_t>, std::vector<point2>> node_map() const {
    std::vector<std::uint32_t> quads(node_count());
    std::vector<point2> uv(quads.size());
    detail::checked(planish_layout_copy_node_map(get(), quads.data(), detail::flat(uv), quads.size()));
    return {std::move(quads), std::move(uv)};
  }

 private:
  std::unique_ptr<planish_layout, detail::destroy> handle_;
};

/// The sum of polynomial tensor surfaces over one domain, each times its factor.
inline surface combine(const std::vector<std::pair<double, const surface *>> &terms) {
  std::vector<const planish_surface *> surfaces;
  std::vector<double> factors;
  for (const auto &[factor, term] : terms) {
    factors.push_back(factor);
    surfaces.push_back(term->get());
  }
  planish_surface *made = nullptr;
  detail::checked(planish_tensor_combine(surfaces.data(), factors.data(), terms.size(), &made));
  return surface(made);
}

/// The gradients in space of a field over the parameters of a shape: for each point a row of three numbers for each
/// component of the field.
inline std::vector<double> field_gradient(
    const surface &shape, const surface &field, const rows<double, 2> &uv,
    const planish_gradient_options &options = defaults<planish_gradient_options>()) {
  std::vector<double> gradients(3 * field.dim() * uv.count());
  detail::checked(planish_surface_field_gradient(shape.get(), field.get(), uv.data(), uv.count(), &options,
                                                 gradients.data()));
  return gradients;
}

/// Makes a curve from its parts. Control points are rows of `dim` numbers.
inline curve curve_new(std::size_t dim, std::uint32_t degree, const values<double> &knots,
                       const values<double> &control_points) {
  detail::check_rows(control_points.count(), knots.count() > degree + 1 ? knots.count() - degree - 1 : 0, dim);
  planish_curve *made = nullptr;
  detail::checked(planish_curve_new(dim, degree, knots.data(), knots.count(), control_points.data(), &made));
  return curve(made);
}

/// The cubic curve through rows of `dim` numbers at rising parameters.
inline curve curve_interpolate(
    const values<double> &u, const values<double> &points, std::size_t dim,
    const planish_interpolate_options &options = defaults<planish_interpolate_options>()) {
  detail::check_rows(points.count(), u.count(), dim);
  planish_curve *made = nullptr;
  detail::checked(planish_curve_interpolate(u.data(), points.data(), u.count(), dim, &options, &made));
  return curve(made);
}

/// Skins rows of points of options.dim numbers: row after row, `row_counts` points each.
inline skinned tspline_skin(const values<double> &points, const std::vector<std::size_t> &row_counts,
                            const planish_skin_options &options = defaults<planish_skin_options>(),
                            const progress &hear = {}) {
  std::size_t count = 0;
  for (std::size_t row_count : row_counts) count += row_count;
  detail::check_rows(points.count(), count, options.dim);
  return detail::skin(options, hear, [&](const planish_skin_options *given, auto out, auto report) {
    return planish_tspline_skin(points.data(), row_counts.data(), row_counts.size(), given, out, report);
  });
}

/// Skins rows of points in space.
inline skinned tspline_skin(const std::vector<std::vector<point3>> &point_rows,
                            const planish_skin_options &options = defaults<planish_skin_options>(),
                            const progress &hear = {}) {
  std::vector<double> points;
  std::vector<std::size_t> row_counts;
  for (const auto &row : point_rows) {
    for (const point3 &point : row) points.insert(points.end(), point.begin(), point.end());
    row_counts.push_back(row.size());
  }
  return tspline_skin(points, row_counts, options, hear);
}

/// Rows of points of a mesh, level curves of a harmonic field between two loops or nodes; no first point is repeated.
inline std::vector<std::vector<point3>> sample_rows(
    const mesh &mesh, std::size_t row_count,
    const planish_sample_rows_options &options = defaults<planish_sample_rows_options>()) {
  std::vector<std::size_t> counts(row_count);
  std::size_t total = 0;
  detail::checked(
      planish_mesh_sample_rows(mesh.get(), &options, counts.data(), row_count, nullptr, 0, &total));
  std::vector<point3> points(total);
  detail::checked(planish_mesh_sample_rows(mesh.get(), &options, counts.data(), row_count, detail::flat(points),
                                           points.size(), &total));
  std::vector<std::vector<point3>> rows;
  auto next = points.begin();
  for (std::size_t count : counts) {
    rows.emplace_back(next, next + static_cast<std::ptrdiff_t>(count));
    next += static_cast<std::ptrdiff_t>(count);
  }
  return rows;
}

/// Skins section curves.
inline skinned tspline_skin_curves(const std::vector<curve> &curves,
                                   const planish_skin_options &options = defaults<planish_skin_options>(),
                                   const progress &hear = {}) {
  std::vector<const planish_curve *> handles;
  for (const curve &one : curves) handles.push_back(one.get());
  return detail::skin(options, hear, [&](const planish_skin_options *given, auto out, auto report) {
    return planish_tspline_skin_curves(handles.data(), handles.size(), given, out, report);
  });
}

/// Makes a T-spline from its knots along v and a cubic control curve for each of their basis functions.
inline surface tspline_new(const values<double> &knots, const std::vector<curve> &curves) {
  std::vector<const planish_curve *> handles;
  for (const curve &one : curves) handles.push_back(one.get());
  planish_surface *made = nullptr;
  detail::checked(planish_tspline_new(knots.data(), knots.count(), handles.data(), handles.size(), &made));
  return surface(made);
}

/// Copies of the control curves of a T-spline; none for other families.
inline std::vector<curve> tspline_curves(const surface &tspline) {
  std::vector<curve> curves;
  for (std::size_t k = 0; k < planish_tspline_curve_count(tspline.get()); ++k) {
    planish_curve *copy = nullptr;
    detail::checked(planish_tspline_clone_curve(tspline.get(), k, &copy));
    curves.emplace_back(copy);
  }
  return curves;
}

/// The knots of a T-spline along v.
inline std::vector<double> tspline_knots(const surface &tspline) {
  std::vector<double> knots(planish_tspline_knot_count(tspline.get()));
  detail::checked(planish_tspline_copy_knots(tspline.get(), knots.data(), knots.size()));
  return knots;
}

/// Inserts a knot into one control curve; the surface stays the same.
inline void tspline_insert_knot_u(surface &tspline, std::size_t curve, double u) {
  detail::checked(planish_tspline_insert_knot_u(tspline.get(), curve, u));
}

/// Inserts a knot along v; the surface stays the same.
inline void tspline_insert_knot_v(surface &tspline, double v) {
  detail::checked(planish_tspline_insert_knot_v(tspline.get(), v));
}

/// What became of a knot that was to be removed.
struct removal {
  /// A bound of the distance that the surface moves, or would have moved.
  double error;
  /// Whether the knot is gone.
  bool is_removed;
};

/// Removes a knot from one control curve if the surface then moves by no more than `tolerance`.
inline removal tspline_remove_knot_u(surface &tspline, std::size_t curve, std::size_t knot, double tolerance) {
  removal done{0, false};
  const auto status =
      detail::checked(planish_tspline_remove_knot_u(tspline.get(), curve, knot, tolerance, &done.error));
  done.is_removed = status == PLANISH_STATUS_OK;
  return done;
}

} // namespace planish

#endif // PLANISH_HPP
