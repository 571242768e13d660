// planish_layout from outside: quads go in and come out, and meshes get layouts with the places of their nodes.
#include "check.hpp"
#include "handles.hpp"
#include "shapes.hpp"

#include <planish.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

// A torus of n by n quads as triangles.
static Mesh torus(std::uint32_t n) {
  std::vector<double> points;
  std::vector<std::uint32_t> triangles;
  const double pi = std::acos(-1.0);
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      const double a = 2 * pi * i / n, b = 2 * pi * j / n;
      points.insert(points.end(), {(1 + 0.4 * std::cos(b)) * std::cos(a), (1 + 0.4 * std::cos(b)) * std::sin(a),
                                   0.4 * std::sin(b)});
      const auto node = [&](std::uint32_t k, std::uint32_t l) { return (k % n) * n + l % n; };
      triangles.insert(triangles.end(), {node(i, j), node(i + 1, j), node(i + 1, j + 1)});
      triangles.insert(triangles.end(), {node(i, j), node(i + 1, j + 1), node(i, j + 1)});
    }
  }
  planish_mesh *raw = nullptr;
  CHECK(planish_mesh_new(points.data(), points.size() / 3, triangles.data(), triangles.size() / 3, nullptr, &raw) ==
        PLANISH_STATUS_OK);
  return Mesh(raw);
}

TEST(Layout, OfATorusHasItsEulerCharacteristic) {
  const Mesh mesh = torus(30);
  planish_mesh_layout_options options;
  CHECK(planish_mesh_layout_options_init(&options, sizeof options) == PLANISH_STATUS_OK);
  options.patches = 24;
  planish_layout *raw = nullptr;
  auto report = fresh<planish_mesh_layout_report>();
  CHECK(planish_layout_of_mesh(mesh.get(), &options, &raw, &report) == PLANISH_STATUS_OK);
  const Layout layout(raw);
  const std::size_t quads = planish_layout_quad_count(layout.get()), edges = planish_layout_edge_count(layout.get());
  const std::size_t vertices = planish_layout_vertex_count(layout.get());
  CHECK_EQUAL(quads + report.doublet_count, 24u);
  CHECK_EQUAL(vertices + quads, edges);
  CHECK_EQUAL(planish_layout_node_count(layout.get()), 900u);
  CHECK_EQUAL(report.kind, static_cast<std::uint32_t>(PLANISH_LAYOUT_KIND_COMPLEX));
  CHECK_EQUAL(report.folded_node_count + report.spread_node_count, 0u);
  CHECK(report.energy >= 4 && report.energy <= report.first_energy);
  std::vector<std::uint32_t> valences(vertices), of_nodes(900), corners(4 * quads), sides(6 * edges);
  std::vector<double> uv(1800);
  CHECK(planish_layout_copy_valences(layout.get(), valences.data(), vertices) == PLANISH_STATUS_OK);
  CHECK(planish_layout_copy_corners(layout.get(), corners.data(), quads) == PLANISH_STATUS_OK);
  CHECK(planish_layout_copy_edges(layout.get(), sides.data(), edges) == PLANISH_STATUS_OK);
  CHECK(planish_layout_copy_node_map(layout.get(), of_nodes.data(), uv.data(), 900) == PLANISH_STATUS_OK);
  std::size_t sum = 0;
  for (const std::uint32_t valence : valences) {
    CHECK(valence >= 3);
    sum += valence;
  }
  CHECK_EQUAL(sum, 4 * quads);
  for (const std::uint32_t vertex : corners) CHECK(vertex < vertices);
  for (const std::uint32_t quad : of_nodes) CHECK(quad < quads);
  for (const double x : uv) CHECK(x >= 0 && x <= 1);
  // the same quads and edges make the same layout
  std::vector<std::uint32_t> numbers(4 * quads);
  for (std::uint32_t e = 0; e < edges; ++e) {
    for (const int k : {2, 4}) numbers[4 * sides[6 * e + k] + sides[6 * e + k + 1]] = e;
  }
  planish_layout_options by_edge;
  CHECK(planish_layout_options_init(&by_edge, sizeof by_edge) == PLANISH_STATUS_OK);
  by_edge.edges = numbers.data();
  CHECK(planish_layout_new(corners.data(), quads, &by_edge, &raw) == PLANISH_STATUS_OK);
  const Layout again(raw);
  CHECK_EQUAL(planish_layout_edge_count(again.get()), edges);
  CHECK_EQUAL(planish_layout_node_count(again.get()), 0u);
}

TEST(Layout, RefusesWhatIsNone) {
  planish_layout *raw = sentinel<planish_layout>();
  const std::uint32_t twice[4] = {0, 1, 2, 1}, pair[8] = {0, 1, 2, 3, 0, 1, 4, 5};
  const auto null = PLANISH_STATUS_NULL_POINTER, topology = PLANISH_STATUS_TOPOLOGY;
  CHECK_FAILS(planish_layout_new(nullptr, 1, nullptr, &raw), null, -1, "corners is NULL");
  CHECK_FAILS(planish_layout_new(twice, 1, nullptr, nullptr), null, -1, "out_layout is NULL");
  CHECK_FAILS(planish_layout_new(twice, 0, nullptr, &raw), PLANISH_STATUS_INVALID_ARGUMENT, -1, "at least one quad");
  CHECK_FAILS(planish_layout_new(twice, 1, nullptr, &raw), topology, 0, "twice");
  CHECK_FAILS(planish_layout_new(pair, 2, nullptr, &raw), topology, 1, "same way");
  CHECK_FAILS(planish_layout_cube(nullptr), null, -1, "out_layout is NULL");
  const Mesh mesh = torus(8);
  CHECK_FAILS(planish_layout_of_mesh(nullptr, nullptr, &raw, nullptr), null, -1, "mesh is NULL");
  CHECK_FAILS(planish_layout_of_mesh(mesh.get(), nullptr, nullptr, nullptr), null, -1, "out_layout is NULL");
  planish_mesh_layout_options options;
  CHECK(planish_mesh_layout_options_init(&options, sizeof options) == PLANISH_STATUS_OK);
  options.kind = PLANISH_LAYOUT_KIND_CUBE;
  CHECK_FAILS(planish_layout_of_mesh(mesh.get(), &options, &raw, nullptr), topology, -1, "genus 1");
  CHECK(raw == sentinel<planish_layout>());
  CHECK_EQUAL(planish_layout_quad_count(nullptr) + planish_layout_vertex_count(nullptr), 0u);
  CHECK_EQUAL(planish_layout_edge_count(nullptr) + planish_layout_node_count(nullptr), 0u);
  planish_layout_free(nullptr);
}

TEST(Layout, IsWrapped) {
  const planish::layout cube = planish::layout::cube();
  CHECK_EQUAL(cube.quad_count(), 6u);
  CHECK(cube.valences() == std::vector<std::uint32_t>(8, 3));
  std::vector<std::uint32_t> corners;
  for (const auto &quad : cube.corners()) corners.insert(corners.end(), quad.begin(), quad.end());
  CHECK(planish::layout(corners).edges() == cube.edges());
  const planish::mesh ball(std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1},
                           std::vector<std::uint32_t>{0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2});
  const auto made = planish::layout::of_mesh(ball);
  CHECK_EQUAL(made.node_map().first.size(), 4u);
  CHECK_EQUAL(ball.find_features().size(), 6u);
}

TEST(Features, OfAMeshAreItsSharpEdges) {
  const Mesh mesh = torus(40);
  std::size_t count = 77;
  CHECK(planish_mesh_find_features(mesh.get(), nullptr, nullptr, 0, &count) == PLANISH_STATUS_OK);
  CHECK_EQUAL(count, 0u);
  // two halves by labels: two closed chains
  std::vector<std::uint32_t> labels(planish_mesh_triangle_count(mesh.get()));
  std::fill_n(labels.begin(), labels.size() / 2, 5u);
  planish_feature_options options;
  CHECK(planish_feature_options_init(&options, sizeof options) == PLANISH_STATUS_OK);
  auto report = fresh<planish_feature_report>();
  options.labels = labels.data();
  options.out_report = &report;
  std::vector<std::uint32_t> edges(160);
  CHECK(planish_mesh_find_features(mesh.get(), &options, edges.data(), 80, &count) == PLANISH_STATUS_OK);
  CHECK_EQUAL(count, 80u);
  CHECK_EQUAL(report.closed_chain_count, 2u);
  CHECK_EQUAL(report.corner_count, 0u);
  count = 77;
  CHECK_FAILS(planish_mesh_find_features(mesh.get(), &options, edges.data(), 79, &count),
              PLANISH_STATUS_BUFFER_TOO_SMALL, -1, "80 are needed");
  CHECK_FAILS(planish_mesh_find_features(nullptr, &options, edges.data(), 80, &count), PLANISH_STATUS_NULL_POINTER, -1,
              "mesh is NULL");
  options.sharp_angle = 7;
  CHECK_FAILS(planish_mesh_find_features(mesh.get(), &options, edges.data(), 80, &count),
              PLANISH_STATUS_INVALID_ARGUMENT, -1, "sharp_angle is 7");
  CHECK_EQUAL(count, 77u);
}

TEST(Labels, TellTheirPiecesAndHandles) {
  const planish::mesh mesh(torus(40).release());
  const std::size_t count = mesh.triangle_count();
  // the whole has a handle, and keeps it without two patches
  std::vector<std::uint32_t> labels(count, 7);
  auto parts = mesh.label_parts(labels);
  CHECK_EQUAL(parts.size(), 1u);
  CHECK(parts[0].label == 7 && parts[0].triangle_count == count && parts[0].piece_count == 1);
  CHECK_EQUAL(parts[0].handle_count, 1u);
  std::fill_n(labels.begin(), 20, 3u);
  std::fill_n(labels.begin() + 30, 20, 3u);
  parts = mesh.label_parts(labels);
  CHECK_EQUAL(parts.size(), 2u);
  CHECK(parts[0].label == 3 && parts[0].triangle_count == 40 && parts[1].triangle_count == count - 40);
  CHECK(parts[0].piece_count == 2 && parts[0].handle_count == 0);
  CHECK(parts[1].piece_count == 1 && parts[1].handle_count == 1);
  // two tubes have none
  std::fill_n(labels.begin(), count / 2, 3u);
  std::fill_n(labels.begin() + static_cast<std::ptrdiff_t>(count / 2), count / 2, 7u);
  for (const auto &part : mesh.label_parts(labels)) CHECK(part.piece_count == 1 && part.handle_count == 0);

  std::uint32_t found[2] = {9, 9};
  std::size_t told = 77;
  const auto parts_of = [&](const planish_mesh *of, const std::uint32_t *given, std::size_t room, std::size_t *out) {
    return planish_mesh_label_parts(of, given, count, found, nullptr, nullptr, nullptr, room, out);
  };
  CHECK_FAILS(parts_of(nullptr, labels.data(), 2, &told), PLANISH_STATUS_NULL_POINTER, -1, "mesh is NULL");
  CHECK_FAILS(parts_of(mesh.get(), nullptr, 2, &told), PLANISH_STATUS_NULL_POINTER, -1, "labels is NULL");
  CHECK_FAILS(parts_of(mesh.get(), labels.data(), 2, nullptr), PLANISH_STATUS_NULL_POINTER, -1, "out_count is NULL");
  CHECK_FAILS(parts_of(mesh.get(), labels.data(), 1, &told), PLANISH_STATUS_BUFFER_TOO_SMALL, -1, "2 are needed");
  CHECK_FAILS(planish_mesh_label_parts(mesh.get(), labels.data(), 9, found, nullptr, nullptr, nullptr, 2, &told),
              PLANISH_STATUS_INVALID_ARGUMENT, -1, "9 labels do not fit 3200 triangles");
  CHECK(found[0] == 9 && found[1] == 9 && told == 77);
  CHECK(parts_of(mesh.get(), labels.data(), 2, &told) == PLANISH_STATUS_OK);
  CHECK(found[0] == 3 && found[1] == 7 && told == 2);
  CHECK(planish_mesh_label_parts(mesh.get(), nullptr, 0, nullptr, nullptr, nullptr, nullptr, 0, &told) ==
        PLANISH_STATUS_OK);
  CHECK_EQUAL(told, 0u);
}

int main() { return check::run(); }
