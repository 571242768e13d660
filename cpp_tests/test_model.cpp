// Models from outside: counts, parts, shells, measure, files; refusals leave outputs alone.
#include "check.hpp"
#include "handles.hpp"
#include "shapes.hpp"

#include <planish.hpp>

#include <cmath>
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

int main() { return check::run(); }
