// D1RC-splines from outside: planes are kept, creases are the control polyline, what is refused changes nothing.
#include "check.hpp"
#include "handles.hpp"
#include "shapes.hpp"

#include <planish.hpp>

#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

static const std::uint32_t side = 9;

// A wavy sheet over the unit square with its parameters.
static planish::mesh sheet() {
  std::vector<double> points, uv;
  std::vector<std::uint32_t> triangles;
  for (std::uint32_t i = 0; i < side; ++i) {
    for (std::uint32_t j = 0; j < side; ++j) {
      const double u = i / (side - 1.0), v = j / (side - 1.0);
      uv.insert(uv.end(), {u, v});
      points.insert(points.end(), {u, v, 0.2 * std::sin(5 * u + 1) * std::cos(4 * v)});
      if (i + 1 < side && j + 1 < side) {
        const std::uint32_t a = i * side + j, b = a + side;
        triangles.insert(triangles.end(), {a, b, a + 1, b, b + 1, a + 1});
      }
    }
  }
  planish::mesh mesh(points, triangles);
  mesh.set_parameters(uv);
  return mesh;
}

TEST(D1rc, KeepsThePlaneForAllDegreesAndBoundaries) {
  const planish::mesh mesh = sheet();
  for (std::uint32_t degree = 1; degree <= 3; ++degree) {
    for (std::uint32_t boundary : {PLANISH_D1RC_BOUNDARY_PHANTOM, PLANISH_D1RC_BOUNDARY_CLAMPED}) {
      auto options = planish::defaults<planish_d1rc_options>();
      options.degree = degree;
      options.boundary = boundary;
      planish::surface surface = planish::d1rc_new(mesh, options);
      CHECK_EQUAL(surface.kind(), static_cast<std::uint32_t>(PLANISH_KIND_D1RC));
      CHECK_EQUAL(planish::d1rc(surface).degree(), degree);
      for (double u : {0.0, 0.3, 0.77, 1.0}) {
        const auto point = surface.eval(planish::point2{u, 0.4});
        CHECK_NEAR(point[0], u, 1e-14);
        CHECK_NEAR(point[1], 0.4, 1e-14);
      }
    }
  }
}

TEST(D1rc, ControlPointsActByTheirShares) {
  planish::surface surface = planish::d1rc_new(sheet());
  planish::d1rc view(surface);
  const std::vector<double> uv = {0.5, 0.45};
  const double before = surface.eval(planish::point2{0.5, 0.45})[2];
  const std::uint32_t vertex = 4 * side + 4;
  auto points = view.control_points();
  const std::vector<double> raised = {points[3 * vertex], points[3 * vertex + 1], points[3 * vertex + 2] + 1};
  view.set_control_points({vertex}, raised);
  const double share = view.blending_values(vertex, uv)[0];
  CHECK_NEAR(surface.eval(planish::point2{0.5, 0.45})[2] - before, share, 1e-14);
  double sum = 0;
  for (std::uint32_t k = 0; k < side * side; ++k) sum += view.blending_values(k, uv)[0];
  CHECK_NEAR(sum, 1.0, 1e-13);
  CHECK(view.influence(vertex).size() < 128u);
}

TEST(D1rc, CreasesAreTheControlPolyline) {
  planish::surface surface = planish::d1rc_new(sheet());
  planish::d1rc view(surface);
  std::vector<planish::edge> crease;
  for (std::uint32_t j = 2; j < 6; ++j) crease.push_back({4 * side + j, 4 * side + j + 1});
  view.set_sharp_edges(crease, {2 * side + 2});
  CHECK(view.sharp_edges() == crease);
  const auto points = view.control_points();
  for (std::uint32_t j = 2; j <= 6; ++j) {
    const auto point = surface.eval(planish::point2{0.5, j / (side - 1.0)});
    CHECK_NEAR(point[2], points[3 * (4 * side + j) + 2], 1e-14);
  }
  const auto orders = view.edge_continuity({crease[0], {4 * side + 3, 5 * side + 3}, {7, 8}});
  CHECK((orders == std::vector<std::uint32_t>{0, 0, 2}));
}

TEST(D1rc, ConfigurationsCloseAroundTheirKnots) {
  planish::surface surface = planish::d1rc_new(sheet());
  const planish::d1rc view(surface);
  CHECK(view.knots().size() > side * side);
  for (std::size_t index = 0; index < view.configuration_count(); ++index) {
    const auto made = view.configuration(index);
    CHECK_EQUAL(made.first.size(), 3u);
    std::uint64_t from = 0, to = 0;
    for (const planish::edge &edge : made.second) from += edge[0], to += edge[1];
    CHECK(made.second.size() >= 3 && from == to);
  }
}

TEST(D1rc, RefusalsNameTheOffender) {
  const planish::mesh mesh = sheet();
  planish_surface *out = nullptr;
  auto options = planish::defaults<planish_d1rc_options>();
  const std::uint32_t edges[] = {0, 1, 0, 40};
  options.sharp_edges = edges;
  options.sharp_edge_count = 2;
  CHECK(planish_d1rc_new(mesh.get(), &options, &out) == PLANISH_STATUS_TOPOLOGY);
  CHECK_EQUAL(planish_error_index(), 1);
  options = planish::defaults<planish_d1rc_options>();
  options.degree = 4;
  CHECK(planish_d1rc_new(mesh.get(), &options, &out) == PLANISH_STATUS_INVALID_ARGUMENT);
  CHECK(planish_d1rc_new(nullptr, nullptr, &out) == PLANISH_STATUS_NULL_POINTER);
  CHECK(planish_d1rc_new(mesh.get(), nullptr, nullptr) == PLANISH_STATUS_NULL_POINTER);
  CHECK(out == nullptr);

  planish::surface surface = planish::d1rc_new(mesh);
  double value = -1;
  const double outside[] = {1.5, 0.5};
  CHECK(planish_d1rc_blending_values(surface.get(), 3, outside, 1, &value) == PLANISH_STATUS_OUTSIDE);
  CHECK(planish_d1rc_blending_values(surface.get(), side * side, outside, 0, &value) == PLANISH_STATUS_INDEX);
  CHECK(planish_d1rc_set_control_points(surface.get(), nullptr, 0, nullptr) == PLANISH_STATUS_OK);
  CHECK(value == -1);
}

int main() { return check::run(); }
