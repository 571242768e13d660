// OpenMesh and planish agree: on a map, computed here with Eigen, and on texture coordinates, both ways.
#include "check.hpp"
#include "shapes.hpp"

#include <planish.hpp>

#include <Eigen/Sparse>
#include <Eigen/SparseLU>
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <cmath>
#include <cstdio>
#include <vector>

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
  using TexCoord2D = OpenMesh::Vec2d;
};
using TriMesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;

static TriMesh to_openmesh(const planish::mesh &mesh) {
  TriMesh result;
  for (const planish::point3 &p : mesh.points()) result.add_vertex(TriMesh::Point(p[0], p[1], p[2]));
  for (const planish::triangle &t : mesh.triangles()) {
    const auto node = [&](std::size_t k) { return result.vertex_handle(t[k]); };
    result.add_face(node(0), node(1), node(2));
  }
  return result;
}

static planish::mesh from_openmesh(const TriMesh &mesh) {
  std::vector<double> points;
  std::vector<std::uint32_t> triangles;
  for (const auto vertex : mesh.vertices()) {
    const TriMesh::Point p = mesh.point(vertex);
    points.insert(points.end(), {p[0], p[1], p[2]});
  }
  for (const auto face : mesh.faces()) {
    for (const auto vertex : face.vertices()) triangles.push_back(static_cast<std::uint32_t>(vertex.idx()));
  }
  return planish::mesh(points, triangles);
}

// A dome of unit radius with its rim lifted here and there; with a hole if asked for.
static shapes::arrays dome(bool has_hole, std::uint64_t seed) {
  return shapes::graph(25, 21, 0.3, seed, has_hole,
                       [](double u, double v) { return 0.6 * std::sin(3.0 * u) * std::sin(2.5 * v + 0.3); });
}

// Boundary nodes where their shadows lie, inner ones at the mean value combination of their neighbours
// (M. Floater, "Mean value coordinates", 2003), solved by Eigen.
static std::vector<planish::point2> mean_value_map(const TriMesh &mesh) {
  std::vector<int> unknown(mesh.n_vertices(), -1);
  int count = 0;
  for (const auto vertex : mesh.vertices()) {
    if (!vertex.is_boundary()) unknown[static_cast<std::size_t>(vertex.idx())] = count++;
  }
  const auto tangent_of_half = [&](const TriMesh::Point &a, const TriMesh::Point &b) {
    return (a % b).norm() / (a.norm() * b.norm() + (a | b));
  };
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(count, 2);
  for (const auto vertex : mesh.vertices()) {
    const int row = unknown[static_cast<std::size_t>(vertex.idx())];
    if (row < 0) continue;
    double sum = 0;
    for (const auto spoke : vertex.outgoing_halfedges()) {
      // the neighbours before and after this one
      const TriMesh::Point at = mesh.point(vertex), to = mesh.point(spoke.to()) - at;
      const TriMesh::Point left = mesh.point(spoke.next().to()) - at;
      const TriMesh::Point other = mesh.point(spoke.opp().next().to()) - at;
      const double weight = (tangent_of_half(to, left) + tangent_of_half(to, other)) / to.norm();
      const int column = unknown[static_cast<std::size_t>(spoke.to().idx())];
      if (column >= 0) {
        entries.emplace_back(row, column, -weight);
      } else {
        const TriMesh::Point fixed = mesh.point(spoke.to());
        right(row, 0) += weight * fixed[0];
        right(row, 1) += weight * fixed[1];
      }
      sum += weight;
    }
    entries.emplace_back(row, row, sum);
  }
  Eigen::SparseMatrix<double> matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::SparseLU<Eigen::SparseMatrix<double>> solver(matrix);
  CHECK(solver.info() == Eigen::Success);
  const Eigen::MatrixXd solution = solver.solve(right);
  std::vector<planish::point2> uv;
  for (const auto vertex : mesh.vertices()) {
    const int row = unknown[static_cast<std::size_t>(vertex.idx())];
    const TriMesh::Point p = mesh.point(vertex);
    uv.push_back(row < 0 ? planish::point2{p[0], p[1]} : planish::point2{solution(row, 0), solution(row, 1)});
  }
  return uv;
}

TEST(OpenMesh, MeanValueMapsAreEqual) {
  for (const bool has_hole : {false, true}) {
    const shapes::arrays all = dome(has_hole, 31);
    planish::mesh mesh(all.points, all.triangles);
    const std::vector<planish::point2> expected = mean_value_map(to_openmesh(mesh));
    std::vector<planish::point2> start = expected;
    std::vector<bool> is_boundary(start.size(), false);
    for (std::size_t k = 0; k < mesh.loop_count(); ++k) {
      for (const std::uint32_t node : mesh.loop(k)) is_boundary[node] = true;
    }
    for (std::size_t n = 0; n < start.size(); ++n) {
      if (!is_boundary[n]) start[n] = {0, 0};
    }
    mesh.set_parameters(start);
    auto options = planish::defaults<planish_parameterize_options>();
    options.border = PLANISH_BORDER_KEPT;
    options.stretch_steps = 0;
    mesh.parameterize(options);
    const std::vector<planish::point2> found = mesh.parameters();
    double largest = 0;
    for (std::size_t n = 0; n < found.size(); ++n) {
      for (std::size_t k : {0u, 1u}) largest = std::max(largest, std::fabs(found[n][k] - expected[n][k]));
    }
    // two direct solvers of a few hundred unknowns, values of size one
    CHECK_NEAR(largest, 0.0, 1e-12);
    std::printf("mean value map of %zu nodes%s: largest difference %.1e\n", found.size(), has_hole ? ", one hole" : "",
                largest);
  }
}

TEST(OpenMesh, TextureCoordinatesTravelBothWays) {
  const shapes::arrays all = dome(true, 32);
  planish::mesh mesh(all.points, all.triangles);
  mesh.parameterize();
  const std::vector<planish::point2> uv = mesh.parameters();

  // in memory nothing is lost
  TriMesh other = to_openmesh(mesh);
  other.request_vertex_texcoords2D();
  for (const auto vertex : other.vertices()) {
    const planish::point2 &at = uv[static_cast<std::size_t>(vertex.idx())];
    other.set_texcoord2D(vertex, TriMesh::TexCoord2D(at[0], at[1]));
  }
  planish::mesh back = from_openmesh(other);
  std::vector<planish::point2> texture;
  for (const auto vertex : other.vertices()) {
    texture.push_back({other.texcoord2D(vertex)[0], other.texcoord2D(vertex)[1]});
  }
  back.set_parameters(texture);
  CHECK(back.points() == mesh.points());
  CHECK(back.parameters() == uv);

  // OpenMesh writes texture coordinates in single precision
  const char *path = "test_openmesh.obj";
  CHECK(OpenMesh::IO::write_mesh(other, path, OpenMesh::IO::Options::VertexTexCoord, 17));
  const planish::mesh read = planish::mesh::read(path);
  CHECK_EQUAL(read.point_count(), mesh.point_count());
  CHECK(read.has_parameters());
  if (read.has_parameters()) {
    const std::vector<planish::point2> found = read.parameters();
    for (std::size_t n = 0; n < uv.size(); ++n) {
      for (std::size_t k : {0u, 1u}) CHECK_NEAR(found[n][k], uv[n][k], 1e-7);
    }
  }

  // and reads them
  TriMesh again;
  again.request_vertex_texcoords2D();
  OpenMesh::IO::Options asked = OpenMesh::IO::Options::VertexTexCoord;
  CHECK(OpenMesh::IO::read_mesh(again, path, asked));
  CHECK_EQUAL(again.n_vertices(), mesh.point_count());
  for (const auto vertex : again.vertices()) {
    const planish::point2 &at = uv[static_cast<std::size_t>(vertex.idx())];
    CHECK_NEAR(again.texcoord2D(vertex)[0], at[0], 1e-7);
    CHECK_NEAR(again.texcoord2D(vertex)[1], at[1], 1e-7);
  }
  std::remove(path);
}

// Normals at the nodes of a fine tessellation are those of the model: a node lies no farther than a side from where the
// facets around it touch the model, and there the normal has turned by that side over the radius of curvature.
TEST(OpenMesh, NormalsOfModelsAreThoseOfTheirTriangles) {
  const shapes::arrays ball = shapes::ball(10);
  const planish::model model = planish::model_fit(planish::mesh(ball.points, ball.triangles)).model;
  auto options = planish::defaults<planish_tessellate_options>();
  options.chord_tolerance = 1e-4;
  const planish::mesh triangles = model.tessellate(options);
  TriMesh theirs = to_openmesh(triangles);
  theirs.request_face_normals();
  theirs.request_vertex_normals();
  theirs.update_normals();
  const planish::model::feet feet = model.project(triangles.points());
  const std::vector<planish::point3> normals = model.normals(feet.faces, feet.uv);
  double largest = 0, longest = 0;
  for (const auto edge : theirs.edges()) longest = std::max(longest, theirs.calc_edge_length(edge));
  for (const auto vertex : theirs.vertices()) {
    const TriMesh::Normal n = theirs.normal(vertex);
    const planish::point3 &m = normals[static_cast<std::size_t>(vertex.idx())];
    largest = std::max(largest, (n - TriMesh::Normal(m[0], m[1], m[2])).norm());
  }
  CHECK(largest <= longest);
  std::printf("normals of %zu nodes: largest difference %.1e, longest side %.1e\n", normals.size(), largest, longest);
}

int main() { return check::run(); }
