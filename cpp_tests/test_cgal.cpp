// CGAL and planish agree: on mean value coordinates, on the distance of a mesh to its surface, and on models of closed meshes.
#include "check.hpp"
#include "shapes.hpp"

#include <planish.hpp>

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Eigen_solver_traits.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_parameterization/Circular_border_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Error_code.h>
#include <CGAL/Surface_mesh_parameterization/Mean_value_coordinates_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>
#include <Eigen/SparseLU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

using Kernel = CGAL::Simple_cartesian<double>;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace smp = CGAL::Surface_mesh_parameterization;

static SurfaceMesh to_cgal(const shapes::arrays &all) {
  SurfaceMesh mesh;
  for (std::size_t n = 0; n < all.point_count(); ++n) {
    mesh.add_vertex(Kernel::Point_3(all.points[3 * n], all.points[3 * n + 1], all.points[3 * n + 2]));
  }
  for (std::size_t t = 0; t < all.triangle_count(); ++t) {
    const auto node = [&](std::size_t k) { return SurfaceMesh::Vertex_index(all.triangles[3 * t + k]); };
    mesh.add_face(node(0), node(1), node(2));
  }
  return mesh;
}

static planish::mesh from_cgal(const SurfaceMesh &mesh) {
  std::vector<double> points;
  std::vector<std::uint32_t> triangles;
  for (const auto vertex : mesh.vertices()) {
    const Kernel::Point_3 &p = mesh.point(vertex);
    points.insert(points.end(), {p.x(), p.y(), p.z()});
  }
  for (const auto face : mesh.faces()) {
    for (const auto vertex : CGAL::vertices_around_face(mesh.halfedge(face), mesh)) {
      triangles.push_back(static_cast<std::uint32_t>(vertex.idx()));
    }
  }
  return planish::mesh(points, triangles);
}

TEST(Cgal, MeanValueMapsAreEqual) {
  using Border = smp::Circular_border_arc_length_parameterizer_3<SurfaceMesh>;
  using Solver = CGAL::Eigen_solver_traits<Eigen::SparseLU<CGAL::Eigen_sparse_matrix<double>::EigenType>>;
  using Parameterizer = smp::Mean_value_coordinates_parameterizer_3<SurfaceMesh, Border, Solver>;
  SurfaceMesh theirs = to_cgal(shapes::graph(40, 35, 0.3, 41));
  const auto map = theirs.add_property_map<SurfaceMesh::Vertex_index, Kernel::Point_2>("v:uv").first;
  const auto border = CGAL::Polygon_mesh_processing::longest_border(theirs).first;
  CHECK(smp::parameterize(theirs, Parameterizer(), border, map) == smp::OK);

  planish::mesh ours = from_cgal(theirs);
  std::vector<planish::point2> start(ours.point_count(), {0, 0});
  for (const std::uint32_t node : ours.loop(0)) {
    const Kernel::Point_2 &at = map[SurfaceMesh::Vertex_index(node)];
    start[node] = {at.x(), at.y()};
  }
  ours.set_parameters(start);
  auto options = planish::defaults<planish_parameterize_options>();
  options.border = PLANISH_BORDER_KEPT;
  options.stretch_steps = 0;
  CHECK(ours.parameterize(options).status == PLANISH_STATUS_OK);
  const std::vector<planish::point2> found = ours.parameters();
  double largest = 0;
  for (const auto vertex : theirs.vertices()) {
    const planish::point2 &uv = found[vertex.idx()];
    largest = std::max({largest, std::fabs(uv[0] - map[vertex].x()), std::fabs(uv[1] - map[vertex].y())});
  }
  CHECK_NEAR(largest, 0.0, 1e-9);
  std::printf("mean value map of %zu nodes: largest difference %.1e\n", found.size(), largest);
}

// A bumpy ellipsoid of CGAL's goes in, a solid comes out: the triangles of the model enclose what the model says, and CGAL
// finds none that meet where they should not.
TEST(Cgal, ModelsEncloseTheirVolumeAndDoNotMeetThemselves) {
  using Exact = CGAL::Exact_predicates_inexact_constructions_kernel;
  using ExactMesh = CGAL::Surface_mesh<Exact::Point_3>;
  namespace pmp = CGAL::Polygon_mesh_processing;
  shapes::arrays all = shapes::ball(14);
  for (std::size_t n = 0; n < all.point_count(); ++n) {
    double *p = &all.points[3 * n];
    const double radius = 1 + 0.1 * std::sin(4 * p[2]);
    p[0] *= 2 * radius;
    p[1] *= radius;
    p[2] *= radius;
  }
  const SurfaceMesh theirs = to_cgal(all);
  const planish::mesh mesh = from_cgal(theirs);
  const planish::fitted_model fit = planish::model_fit(mesh);
  CHECK(fit.status == PLANISH_STATUS_OK);
  CHECK_EQUAL(fit.report.crossing_count, 0u);
  const planish_measure_report measure = fit.model.measure();
  CHECK_EQUAL(measure.free_edge_count, 0u);
  auto options = planish::defaults<planish_tessellate_options>();
  options.chord_tolerance = 1e-4 * measure.diagonal;
  const planish::mesh triangles = fit.model.tessellate(options);
  ExactMesh exact;
  for (const planish::point3 &p : triangles.points()) exact.add_vertex(Exact::Point_3(p[0], p[1], p[2]));
  for (const planish::triangle &t : triangles.triangles()) {
    const auto node = [&](std::size_t k) { return ExactMesh::Vertex_index(t[k]); };
    CHECK(exact.add_face(node(0), node(1), node(2)) != ExactMesh::null_face());
  }
  CHECK(CGAL::is_closed(exact));
  CHECK(!pmp::does_self_intersect(exact));
  // a layer as thick as the chords are off
  const double volume = CGAL::to_double(pmp::volume(exact));
  CHECK_NEAR(volume, measure.volume, 2 * options.chord_tolerance * measure.area);
  CHECK_NEAR(CGAL::to_double(pmp::volume(theirs)), measure.volume, 2e-2 * volume);
  std::printf("model of %zu triangles: volume %.6f, by CGAL %.6f\n", std::size_t{theirs.number_of_faces()}, measure.volume,
              volume);
}

// A bar of radius 1 between z = -1 and 1, 4 n nodes around: the cube, its squares across z drawn round.
static SurfaceMesh bar(std::uint32_t n) {
  shapes::arrays all = shapes::ball(n);
  for (std::size_t k = 0; k < all.point_count(); ++k) {
    double *p = &all.points[3 * k];
    const double most = std::max({std::fabs(p[0]), std::fabs(p[1]), std::fabs(p[2])});
    const double across = std::max(std::fabs(p[0]), std::fabs(p[1])), length = std::hypot(p[0], p[1]);
    const double stretch = length > 0 ? across / (length * most) : 0;
    p[0] *= stretch;
    p[1] *= stretch;
    p[2] /= most;
  }
  return to_cgal(all);
}

// Sharp edges are those of CGAL at the same angle, and the faces between them enclose the part's volume without meeting
// themselves, as exact faces and as patches.
TEST(Cgal, FeaturesAreItsSharpEdgesAndModelsKeepThem) {
  namespace pmp = CGAL::Polygon_mesh_processing;
  using Exact = CGAL::Exact_predicates_inexact_constructions_kernel;
  using ExactMesh = CGAL::Surface_mesh<Exact::Point_3>;
  const std::uint32_t n = 15;
  SurfaceMesh theirs = bar(n);
  const planish::mesh mesh = from_cgal(theirs);
  const auto is_sharp = theirs.add_property_map<SurfaceMesh::Edge_index, bool>("e:sharp", false).first;
  pmp::detect_sharp_edges(theirs, 40, is_sharp);
  std::vector<std::array<std::uint32_t, 2>> expected;
  for (const auto edge : theirs.edges()) {
    if (!is_sharp[edge]) continue;
    const std::uint32_t a = theirs.vertex(edge, 0).idx(), b = theirs.vertex(edge, 1).idx();
    expected.push_back({std::min(a, b), std::max(a, b)});
  }
  std::sort(expected.begin(), expected.end());
  CHECK_EQUAL(expected.size(), 8u * n);
  CHECK(mesh.find_features() == expected);

  const double pi = 3.14159265358979323846;
  for (const std::uint32_t exact : {1u, 0u}) {
    auto options = planish::defaults<planish_model_options>();
    options.exact = exact;
    const planish::fitted_model fit = planish::model_fit(mesh, options);
    CHECK(fit.status == PLANISH_STATUS_OK);
    const planish_measure_report measure = fit.model.measure();
    CHECK_EQUAL(measure.free_edge_count, 0u);
    CHECK_NEAR(measure.volume, 2 * pi, 5e-4 * 2 * pi);
    auto fine = planish::defaults<planish_tessellate_options>();
    fine.chord_tolerance = 1e-4 * measure.diagonal;
    const planish::mesh triangles = fit.model.tessellate(fine);
    ExactMesh solid;
    for (const planish::point3 &p : triangles.points()) solid.add_vertex(Exact::Point_3(p[0], p[1], p[2]));
    for (const planish::triangle &t : triangles.triangles()) {
      const auto node = [&](std::size_t k) { return ExactMesh::Vertex_index(t[k]); };
      CHECK(solid.add_face(node(0), node(1), node(2)) != ExactMesh::null_face());
    }
    CHECK(CGAL::is_closed(solid));
    CHECK(!pmp::does_self_intersect(solid));
    // a layer as thick as the chords are off
    const double volume = CGAL::to_double(pmp::volume(solid));
    CHECK_NEAR(volume, measure.volume, 2 * fine.chord_tolerance * measure.area);
    std::printf("bar of %zu faces: volume %.6f, by CGAL %.6f\n", fit.model.face_count(), measure.volume, volume);
  }
}

#ifdef HAS_DISTANCE
// The largest distance from a node to a tessellation of the surface, by CGAL's tree.
static double largest_distance(const planish::mesh &nodes, const SurfaceMesh &tessellation) {
  using Primitive = CGAL::AABB_face_graph_triangle_primitive<SurfaceMesh>;
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree(faces(tessellation).begin(), faces(tessellation).end(),
                                                             tessellation);
  double largest_sq = 0;
  for (const planish::point3 &p : nodes.points()) {
    largest_sq = std::max(largest_sq, tree.squared_distance(Kernel::Point_3(p[0], p[1], p[2])));
  }
  return std::sqrt(largest_sq);
}

TEST(Cgal, DistancesAreEqual) {
  const shapes::arrays all = shapes::graph(30, 30, 0.2, 42);
  planish::mesh mesh(all.points, all.triangles);
  auto options = planish::defaults<planish_tensor_options>();
  options.tolerance = 1e-2;
  options.measure_distance = 1;
  const planish::fitted fit = planish::tensor_fit(mesh, options);
  CHECK(fit.report.max_distance > 0);
  CHECK(fit.report.max_distance <= fit.report.max_error);

  // so fine that its own error, quadratic in the spacing, is far below the distances measured
  const auto box = fit.surface.domain();
  const std::size_t lines = 601;
  std::vector<double> u, v;
  for (std::size_t k = 0; k < lines; ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(lines - 1);
    u.push_back(std::min(box[1], box[0] + share * (box[1] - box[0])));
    v.push_back(std::min(box[3], box[2] + share * (box[3] - box[2])));
  }
  const std::vector<double> points = fit.surface.eval_grid(u, v);
  shapes::arrays fine;
  fine.points = points;
  fine.uv.resize(2 * lines * lines);
  for (std::size_t i = 0; i + 1 < lines; ++i) {
    for (std::size_t j = 0; j + 1 < lines; ++j) {
      const auto node = [&](std::size_t a, std::size_t b) { return static_cast<std::uint32_t>((i + a) * lines + j + b); };
      fine.triangles.insert(fine.triangles.end(),
                            {node(0, 0), node(1, 0), node(1, 1), node(0, 0), node(1, 1), node(0, 1)});
    }
  }
  const double theirs = largest_distance(mesh, to_cgal(fine));
  CHECK_NEAR(fit.report.max_distance, theirs, 0.02 * theirs);
  std::printf("largest distance: %.6e, by CGAL %.6e\n", fit.report.max_distance, theirs);
}
#endif

int main() { return check::run(); }
