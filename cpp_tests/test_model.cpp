// Models from outside: counts, parts, shells, measure, files; refusals leave outputs alone.
#include "check.hpp"
#include "handles.hpp"
#include "shapes.hpp"

#include <planish.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

namespace {

// A wave of degree 3 over the unit square, with a square hole if asked for.
Surface wave(bool has_hole) {
  const double knots[9] = {0, 0, 0, 0, 0.5, 1, 1, 1, 1}, greville[5] = {0, 1 / 6.0, 0.5, 5 / 6.0, 1};
  std::vector<double> points;
  for (const double u : greville) {
    for (const double v : greville) points.insert(points.end(), {u, v, shapes::wave(u, v)});
  }
  planish_surface *out = nullptr;
  CHECK_EQUAL(planish_tensor_new(3, 3, 3, knots, 9, knots, 9, points.data(), nullptr, &out), PLANISH_STATUS_OK);
  const double trims[16] = {0.1, 0.1, 0.9, 0.1, 0.9, 0.9, 0.1, 0.9, 0.4, 0.4, 0.6, 0.4, 0.6, 0.7, 0.4, 0.7};
  const std::size_t counts[2] = {4, 4};
  if (has_hole) CHECK_EQUAL(planish_surface_set_trims(out, trims, counts, 2), PLANISH_STATUS_OK);
  return Surface(out);
}

Model model_of(const Surface &surface) {
  planish_model *out = nullptr;
  CHECK_EQUAL(planish_model_from_surface(surface.get(), &out), PLANISH_STATUS_OK);
  return Model(out);
}

} // namespace

TEST(Model, PartsFitEulersFormula) {
  for (const bool has_hole : {false, true}) {
    const planish::model model(model_of(wave(has_hole)).release());
    const planish_measure_report report = model.measure();
    CHECK_EQUAL(model.face_count(), 1u);
    CHECK_EQUAL(model.edge_count(), has_hole ? 8u : 4u);
    CHECK_EQUAL(model.vertex_count(), model.edge_count());
    CHECK_EQUAL(model.shell_count(), 1u);
    CHECK_EQUAL(report.free_edge_count, model.edge_count());
    CHECK_EQUAL(report.euler_characteristic, has_hole ? 0 : 1);
    CHECK_EQUAL(report.euler_characteristic,
                static_cast<std::int64_t>(model.vertex_count()) - static_cast<std::int64_t>(model.edge_count()) + 2 -
                    static_cast<std::int64_t>(report.loop_count));
    CHECK(report.curve_deviation <= 1e-7 * report.diagonal);
    const std::vector<planish::point3> vertices = model.vertices();
    std::size_t place = 0;
    for (const auto &loop : model.loops(0)) {
      for (std::size_t k = 0; k < loop.size(); ++k, ++place) {
        const planish_edge_info info = model.edge_info(loop[k].edge), next = model.edge_info(loop[(k + 1) % loop.size()].edge);
        CHECK_EQUAL(info.vertex_end, next.vertex_start);
        CHECK_EQUAL(info.face_along, 0u);
        CHECK_EQUAL(info.face_against, PLANISH_NONE);
        const planish::curve edge = model.edge(loop[k].edge), pcurve = model.pcurve(0, place);
        CHECK(edge.domain() == pcurve.domain());
        const std::vector<double> start = edge.value(edge.domain()[0]);
        for (int c = 0; c < 3; ++c) CHECK_NEAR(start[c], vertices[info.vertex_start][c], 1e-12);
      }
    }
    const planish::surface face = model.face(0);
    CHECK_EQUAL(planish_surface_trim_count(face.get()), report.loop_count);
  }
}

TEST(Model, IsSavedAndWritten) {
  const planish::model model(model_of(wave(true)).release());
  const planish::model copy = model;
  const std::vector<std::uint8_t> bytes = copy.save();
  CHECK(planish::model::load(bytes).save() == bytes);
  model.save_file("test_model.planish");
  CHECK(planish::model::load_file("test_model.planish").save() == bytes);
  std::remove("test_model.planish");
  CHECK(planish::model::load(bytes).step() == model.step());
  const planish_step_report report = model.write_step("test_model.step");
  CHECK_EQUAL(report.edge_count, 8u);
  std::remove("test_model.step");
}

TEST(Model, AnswersAsItsSurfaceDoes) {
  const planish::model model(model_of(wave(true)).release());
  const planish::surface face = model.face(0);
  const std::vector<planish::point2> uv = {{0.2, 0.3}, {0.8, 0.75}};
  const std::vector<std::uint32_t> faces(2, 0);
  CHECK(model.eval(faces, uv, 2) == face.eval_derivatives(uv, 2));
  CHECK(model.normals(faces, uv) == face.normals(uv));
  const auto bent = model.curvatures(faces, uv), own_bent = face.curvatures(uv);
  for (std::size_t k = 0; k < uv.size(); ++k) CHECK(bent[k].k1 == own_bent[k].k1 && bent[k].k2 == own_bent[k].k2);
  const std::vector<planish::point3> points = {{0.5, 0.5, 1}, {0.3, 0.2, 0}};
  const planish::model::feet feet = model.project(points);
  const auto own = face.project(points);
  for (std::size_t k = 0; k < points.size(); ++k) {
    CHECK_EQUAL(feet.faces[k], 0u);
    CHECK_NEAR(feet.distances[k], own.distances[k], 1e-12);
  }
  auto options = planish::defaults<planish_tessellate_options>();
  options.chord_tolerance = 1e-4;
  const planish::mesh mesh = model.tessellate(options);
  CHECK_EQUAL(mesh.loop_count(), 2u);
  CHECK(model.deviation(mesh).report.max_distance < 1e-12);
  model.write_vtk("test_model.vtu");
  std::remove("test_model.vtu");
}

TEST(Model, KnowsWhereNodesWent) {
  const shapes::arrays ball = shapes::ball(8);
  const planish::mesh mesh(ball.points, ball.triangles);
  const planish::model model = planish::model_fit(mesh).model;
  const auto places = model.locate_nodes();
  CHECK_EQUAL(places.faces.size(), mesh.point_count());
  const std::vector<double> on_model = model.eval(places.faces, places.uv);
  const auto points = mesh.points();
  double largest = 0, told = 0;
  std::size_t count = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    double sum = 0;
    for (int c = 0; c < 3; ++c) sum += std::pow(on_model[3 * k + c] - points[k][c], 2);
    largest = std::max(largest, std::sqrt(sum));
  }
  for (std::size_t face = 0; face < model.face_count(); ++face) {
    const planish_face_info info = model.face_info(face);
    count += info.node_count;
    if (info.node_count > 0) told = std::max(told, info.max_error);
  }
  CHECK_EQUAL(count, points.size());
  CHECK_NEAR(told, largest, 1e-14);
}

TEST(Model, RefusesByName) {
  const Model model = model_of(wave(false));
  std::uint32_t of_node = 7;
  CHECK_FAILS(planish_model_locate_nodes(model.get(), &of_node, nullptr, 1), PLANISH_STATUS_WRONG_KIND, -1, "no fit");
  CHECK_EQUAL(of_node, 7u);
  CHECK_EQUAL(planish_model_node_count(nullptr), 0u);
  planish_surface *surface = sentinel<planish_surface>();
  CHECK_FAILS(planish_model_copy_face(model.get(), 1, &surface), PLANISH_STATUS_INDEX, 1, "face 1");
  CHECK(surface == sentinel<planish_surface>());
  planish_curve *curve = sentinel<planish_curve>();
  CHECK_FAILS(planish_model_copy_edge(model.get(), 4, &curve, nullptr), PLANISH_STATUS_INDEX, 4, "edge 4");
  CHECK_FAILS(planish_model_copy_pcurve(model.get(), 0, 4, &curve), PLANISH_STATUS_INDEX, 4, "coedge 4");
  CHECK(curve == sentinel<planish_curve>());
  double points[3] = {7, 7, 7};
  CHECK_FAILS(planish_model_copy_vertices(model.get(), points, 1), PLANISH_STATUS_BUFFER_TOO_SMALL, -1, "out_points");
  CHECK_EQUAL(points[0], 7.0);
  planish_model *out = sentinel<planish_model>();
  CHECK_FAILS(planish_model_from_surface(nullptr, &out), PLANISH_STATUS_NULL_POINTER, -1, "surface");
  CHECK_FAILS(planish_model_load("PLANISH", 7, &out), PLANISH_STATUS_FORMAT, 0, "mark");
  CHECK(out == sentinel<planish_model>());
  const Surface crossing = wave(false);
  const double bow[8] = {0.1, 0.1, 0.9, 0.9, 0.9, 0.1, 0.1, 0.9};
  const std::size_t four = 4;
  CHECK_EQUAL(planish_surface_set_trims(crossing.get(), bow, &four, 1), PLANISH_STATUS_OK);
  CHECK_FAILS(planish_model_from_surface(crossing.get(), &out), PLANISH_STATUS_TOPOLOGY, 0, "crosses");
  CHECK_EQUAL(planish_model_face_count(nullptr), 0u);
  planish_model_free(nullptr);
}

// A body between two skins over a rectangle, which meet in sharp edges at x = 0 and 1, and two planes at y = 0 and 4.
// Strips across the span have the labels 0 to 7 on the upper skin, 8 to 15 on the lower one; the planes have 16 and 17.
struct strips {
  static constexpr std::uint32_t cells = 16, rows = 32, of_skin = 8;
  std::vector<double> points;
  std::vector<std::uint32_t> triangles, labels;

  strips() {
    const double heights[2] = {0.2, -0.1};
    std::uint32_t nodes[2][cells + 1][rows + 1];
    for (int side = 0; side < 2; ++side) {
      for (std::uint32_t i = 0; i <= cells; ++i) {
        for (std::uint32_t j = 0; j <= rows; ++j) {
          const double x = static_cast<double>(i) / cells, y = 4.0 * j / rows;
          const bool is_shared = side == 1 && (i == 0 || i == cells);
          nodes[side][i][j] = is_shared ? nodes[0][i][j] : static_cast<std::uint32_t>(points.size() / 3);
          if (!is_shared) points.insert(points.end(), {x, y, 4 * heights[side] * x * (1 - x) + 0.02 * y * y});
        }
      }
    }
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t label) {
      if (a == b || b == c || c == a) return;
      triangles.insert(triangles.end(), {a, b, c});
      labels.push_back(label);
    };
    for (std::uint32_t i = 0; i < cells; ++i) {
      for (std::uint32_t j = 0; j < rows; ++j) {
        const auto &up = nodes[0], &low = nodes[1];
        const std::uint32_t strip = j / (rows / of_skin);
        add(up[i][j], up[i + 1][j], up[i + 1][j + 1], strip);
        add(up[i][j], up[i + 1][j + 1], up[i][j + 1], strip);
        add(low[i][j], low[i + 1][j + 1], low[i + 1][j], of_skin + strip);
        add(low[i][j], low[i][j + 1], low[i + 1][j + 1], of_skin + strip);
      }
      for (const std::uint32_t j : {0u, rows}) {
        const std::uint32_t a = nodes[1][i][j], b = nodes[1][i + 1][j], c = nodes[0][i + 1][j], d = nodes[0][i][j];
        const std::uint32_t label = 2 * of_skin + (j == 0 ? 0 : 1);
        add(a, j == 0 ? b : c, j == 0 ? c : b, label);
        add(a, j == 0 ? c : d, j == 0 ? d : c, label);
      }
    }
  }
};

TEST(Labels, AreFoundAgainFromPlacesOfAFaceOfMany) {
  const strips wing;
  const planish::mesh mesh(wing.points, wing.triangles);
  for (const auto &part : mesh.label_parts(wing.labels)) CHECK(part.piece_count == 1 && part.handle_count == 0);
  auto options = planish::defaults<planish_model_options>();
  options.labels = wing.labels.data();
  options.label_count = wing.labels.size();
  options.label_angle = 0.09;
  const planish::fitted_model fit = planish::model_fit(mesh, options);
  CHECK_EQUAL(fit.model.face_count(), 4u);
  CHECK_EQUAL(fit.model.measure().free_edge_count, 0u);
  std::size_t asked = 0;
  for (std::uint32_t face = 0; face < fit.model.face_count(); ++face) {
    const std::uint32_t first = fit.model.face_info(face).label;
    if (first >= 2 * strips::of_skin) continue;
    const std::uint32_t skin = first / strips::of_skin * strips::of_skin;
    const auto domain = fit.model.face(face).domain();
    std::vector<double> uv;
    shapes::random next(5);
    for (int k = 0; k < 500; ++k) {
      uv.push_back(domain[0] + (domain[1] - domain[0]) * next.unit());
      uv.push_back(domain[2] + (domain[3] - domain[2]) * next.unit());
    }
    const std::vector<std::uint32_t> faces(500, face);
    std::vector<double> places(1500);
    CHECK(planish_model_eval(fit.model.get(), faces.data(), uv.data(), 500, 0, nullptr, places.data()) ==
          PLANISH_STATUS_OK);
    const auto feet = mesh.project(places);
    for (std::size_t k = 0; k < 500; ++k) {
      CHECK(feet.distances[k] <= 2 * fit.report.tolerance);
      const double y = places[3 * k + 1], across = y * strips::of_skin / 4;
      // so near to a line between strips, to a skin's end or to the other skin either may be nearest
      const double x = places[3 * k];
      const double off = std::abs(across - std::round(across)) * 4 / strips::of_skin;
      if (off <= feet.distances[k] || std::min(x, 1 - x) < 0.05) continue;
      ++asked;
      const auto strip = static_cast<std::uint32_t>(across);
      CHECK_EQUAL(wing.labels[feet.triangles[k]], skin + strip);
    }
  }
  CHECK(asked > 700);
}

TEST(Labels, PointsThatCannotBeProjectedOntoAMeshLeaveOutputsAlone) {
  const shapes::arrays ball = shapes::ball(4);
  const planish::mesh mesh(ball.points, ball.triangles);
  double points[6] = {2, 0.1, 0.2, 0, NAN, 0}, places[6] = {-1, -1, -1, -1, -1, -1}, distances[2] = {-1, -1};
  std::uint32_t triangles[2] = {77, 77};
  const auto project = [&](const planish_mesh *of, const double *at, const planish_project_options *options) {
    return planish_mesh_project(of, at, 2, options, triangles, places, distances);
  };
  auto options = planish::defaults<planish_project_options>();
  CHECK_FAILS(project(nullptr, points, nullptr), PLANISH_STATUS_NULL_POINTER, -1, "mesh is NULL");
  CHECK_FAILS(project(mesh.get(), nullptr, nullptr), PLANISH_STATUS_NULL_POINTER, -1, "points is NULL");
  CHECK_FAILS(project(mesh.get(), points, nullptr), PLANISH_STATUS_NOT_FINITE, 1, "point 1");
  points[4] = 9;
  options.keep_trims = 0;
  CHECK_FAILS(project(mesh.get(), points, &options), PLANISH_STATUS_INVALID_ARGUMENT, -1, "keep_trims is not used");
  options.keep_trims = 1;
  const std::int32_t stop = 1;
  options.cancel = &stop;
  CHECK_FAILS(project(mesh.get(), points, &options), PLANISH_STATUS_CANCELLED, -1, "");
  CHECK(triangles[0] == 77 && triangles[1] == 77 && distances[0] == -1 && distances[1] == -1);
  for (const double x : places) CHECK_EQUAL(x, -1.0);
  options.cancel = nullptr;
  options.max_distance = 2;
  CHECK(project(mesh.get(), points, &options) == PLANISH_STATUS_POINTS_OUTSIDE);
  CHECK(triangles[0] < mesh.triangle_count() && triangles[1] == PLANISH_NONE);
  CHECK(distances[0] > 1 && distances[0] < 1.1 && std::isnan(distances[1]) && std::isnan(places[3]));
  CHECK(planish_mesh_project(mesh.get(), points, 2, nullptr, nullptr, nullptr, nullptr) == PLANISH_STATUS_OK);
  CHECK(planish_mesh_project(mesh.get(), nullptr, 0, nullptr, nullptr, nullptr, nullptr) == PLANISH_STATUS_OK);
}

int main() { return check::run(); }
