// planish.hpp: owners, vectors in and out, errors and exceptions that cross the border and come back whole.
#include "check.hpp"
#include "shapes.hpp"

#include <planish.hpp>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

using planish::point2;
using planish::point3;

static planish::mesh make(const shapes::arrays &all, bool with_parameters = true) {
  planish::mesh mesh(all.points, all.triangles);
  if (with_parameters) mesh.set_parameters(all.uv);
  return mesh;
}

// The error that `call` throws.
template <class Call>
static planish::error thrown_by(const Call &call) {
  try {
    call();
  } catch (const planish::error &error) {
    return error;
  }
  CHECK(!"nothing was thrown");
  return planish::error(PLANISH_STATUS_OK, "", -1);
}

TEST(Wrapper, OwnersMoveWithoutThrowing) {
  CHECK(std::is_nothrow_move_constructible<planish::mesh>::value);
  CHECK(std::is_nothrow_move_assignable<planish::surface>::value);
  CHECK(std::is_copy_constructible<planish::surface>::value);
}

TEST(Wrapper, DefaultsAreThoseOfC) {
  planish_tensor_options options;
  CHECK(planish_tensor_options_init(&options, sizeof options) == PLANISH_STATUS_OK);
  const auto ours = planish::defaults<planish_tensor_options>();
  CHECK_EQUAL(ours.struct_size, sizeof ours);
  CHECK_EQUAL(ours.tolerance, options.tolerance);
  CHECK_EQUAL(ours.max_grid, options.max_grid);
  CHECK(planish::version() == PLANISH_VERSION);
}

TEST(WrapperMesh, TakesVectorsAndPointers) {
  const std::vector<point3> points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const std::vector<planish::triangle> triangles = {{0, 1, 2}, {0, 2, 3}};
  const planish::mesh mesh(points, triangles);
  CHECK(mesh.points() == points);
  CHECK(mesh.triangles() == triangles);
  CHECK_EQUAL(mesh.point_count(), 4u);
  CHECK_EQUAL(mesh.triangle_count(), 2u);
  CHECK_EQUAL(mesh.edge_count(), 5u);
  CHECK_EQUAL(mesh.component_count(), 1u);
  CHECK_EQUAL(mesh.genus(), 0u);
  CHECK_EQUAL(mesh.loop_count(), 1u);
  CHECK_EQUAL(mesh.euler_characteristic(), 1);
  CHECK_EQUAL(mesh.loop(0).size(), 4u);
  CHECK_EQUAL(mesh.repairs().welded_node_count, 0u);

  const double flat[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::array<planish::triangle, 1> one = {{{0, 1, 2}}};
  const planish::mesh triangle({flat, 3}, one);
  CHECK_EQUAL(triangle.triangle_count(), 1u);
}

TEST(WrapperMesh, CopiesAreDeep) {
  planish::mesh mesh = make(shapes::graph(4, 4, 0.0, 1), false);
  const planish::mesh copy = mesh;
  mesh.set_parameters(std::vector<double>(2 * mesh.point_count(), 0.5));
  CHECK(mesh.has_parameters() && !copy.has_parameters());
  planish::mesh moved = std::move(mesh);
  CHECK(moved.has_parameters());
  moved = copy;
  CHECK(!moved.has_parameters());
  planish_mesh *handle = moved.release();
  CHECK_EQUAL(planish_mesh_point_count(handle), copy.point_count());
  planish_mesh_free(handle);
}

TEST(WrapperMesh, SaysWhatWasRepaired) {
  const std::vector<double> points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  const std::vector<std::uint32_t> turned = {0, 1, 2, 0, 3, 2};
  auto options = planish::defaults<planish_mesh_options>();
  options.orient = 1;
  CHECK_EQUAL(planish::mesh(points, turned, options).repairs().flipped_triangle_count, 1u);
  planish_mesh_repairs repairs{};
  repairs.struct_size = sizeof repairs;
  options.out_repairs = &repairs;
  CHECK_EQUAL(planish::mesh(points, turned, options).repairs().flipped_triangle_count, 1u);
  CHECK_EQUAL(repairs.flipped_triangle_count, 1u);
}

TEST(WrapperMesh, FieldsPathsAndPieces) {
  const shapes::arrays all = shapes::graph(4, 4, 0.0, 1);
  planish::mesh mesh = make(all);
  mesh.set_field("height", std::vector<double>(16, 2.5));
  CHECK(mesh.field_names() == std::vector<std::string>{"height"});
  CHECK(mesh.field("height") == std::vector<double>(16, 2.5));
  CHECK_EQUAL(mesh.parameters()[5][0], all.uv[10]);
  CHECK_EQUAL(mesh.remove_triangles(std::vector<std::uint32_t>{0}).triangle_count(), all.triangle_count() - 1);
  const auto loop = mesh.loop(0);
  const auto path = mesh.shortest_path(loop[0], loop[6]);
  CHECK(path.front() == loop[0] && path.back() == loop[6]);
  const auto pieces = mesh.cut_along(mesh.shortest_path(loop[1], loop[7])).split_components();
  CHECK_EQUAL(pieces.size(), 2u);
}

TEST(WrapperMesh, IsMappedToTheSphere) {
  const planish::mesh mesh(std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1},
                           std::vector<std::uint32_t>{0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2});
  const planish::sphere_map map = mesh.map_to_sphere();
  CHECK(map.status == PLANISH_STATUS_OK);
  CHECK_EQUAL(map.points.size(), 4u);
  CHECK_EQUAL(map.report.folded_triangles, 0u);
  const auto error = thrown_by([&] {
    mesh.map_to_sphere(planish::defaults<planish_sphere_options>(), [](double, double) { return false; });
  });
  CHECK(error.status() == PLANISH_STATUS_CANCELLED);
}

TEST(WrapperMesh, BecomesCoarser) {
  const planish::mesh mesh = make(shapes::graph(20, 20, 0.2, 1));
  auto options = planish::defaults<planish_decimate_options>();
  options.target_count = 60;
  options.sharp_angle = 0.2;
  const auto found = mesh.decimate(options);
  CHECK(found.status == PLANISH_STATUS_OK);
  CHECK_EQUAL(found.coarse.point_count() + found.report.collapse_count, 400u);
  CHECK_EQUAL(found.sharp_edges.size(), found.report.sharp_edge_count);
  for (const auto &edge : found.sharp_edges) CHECK(edge[0] < edge[1] && edge[1] < found.coarse.point_count());
  const auto error = thrown_by([&] { mesh.decimate(options, [](double, double) { return false; }); });
  CHECK(error.status() == PLANISH_STATUS_CANCELLED);
}

TEST(WrapperD1rc, FitsAMesh) {
  const planish::mesh mesh = make(shapes::graph(20, 20, 0.2, 1));
  auto options = planish::defaults<planish_d1rc_options>();
  options.tolerance = 5e-2;
  const auto found = planish::d1rc_fit(mesh, options);
  CHECK(found.status == PLANISH_STATUS_OK);
  CHECK(found.report.max_error <= found.report.tolerance);
  CHECK(found.surface.kind() == PLANISH_KIND_D1RC);
  const planish::mesh coarse = mesh.decimate().coarse;
  options.control_mesh = coarse.get();
  CHECK_EQUAL(planish::d1rc_fit(mesh, options).report.coefficient_count, coarse.point_count());
}

TEST(WrapperMesh, ReadsFiles) {
  const char *path = "test_wrapper.off";
  std::ofstream(path) << "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  CHECK_EQUAL(planish::mesh::read(path).triangle_count(), 1u);
  std::remove(path);
  const auto error = thrown_by([&] { planish::mesh::read(path); });
  CHECK_EQUAL(static_cast<int>(error.status()), static_cast<int>(PLANISH_STATUS_FILE));
  CHECK(std::string(error.what()).find(path) != std::string::npos);
}

TEST(WrapperSurface, KeepsNameAndUnit) {
  const std::vector<double> knots = {0, 0, 1, 1};
  planish::surface square =
      planish::tensor_new(3, 1, 1, knots, knots, std::vector<double>{0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0});
  CHECK(square.name().empty() && square.unit() == PLANISH_UNIT_MILLIMETRE);
  square.set_name("a square");
  square.set_unit(PLANISH_UNIT_INCH);
  square.save_file("test_wrapper_named.planish");
  const planish::surface loaded = planish::surface::load_file("test_wrapper_named.planish"), copy = loaded;
  CHECK(copy.name() == "a square" && copy.unit() == PLANISH_UNIT_INCH);
  char text[4] = "xyz";
  CHECK_EQUAL(planish_surface_name(copy.get(), text, sizeof text), 8u);
  CHECK(std::string(text) == "a s");
  CHECK(planish_surface_set_name(square.get(), nullptr) == PLANISH_STATUS_NULL_POINTER);
  CHECK(planish_surface_set_name(nullptr, "") == PLANISH_STATUS_NULL_POINTER);
  CHECK(planish_surface_set_unit(square.get(), 3) == PLANISH_STATUS_INVALID_ARGUMENT);
  CHECK(planish_surface_set_unit(nullptr, 0) == PLANISH_STATUS_NULL_POINTER);
  CHECK_EQUAL(planish_surface_name(nullptr, nullptr, 0), 0u);
  CHECK_EQUAL(planish_surface_unit(nullptr), 0u);
}

TEST(WrapperSurface, SaysHowLargeItIs) {
  planish::check_version();
  CHECK(planish_check_version(PLANISH_VERSION_MAJOR + 1, 0) == PLANISH_STATUS_VERSION);
  // a tube of a square's outline: four planes of 1 by 3
  const std::vector<double> u = {0, 0, 1, 2, 3, 4, 4}, v = {0, 0, 1, 1};
  const std::vector<double> points = {0, 0, 0, 0, 0, 3, 1, 0, 0, 1, 0, 3, 1, 1, 0, 1, 1, 3, 0, 1, 0, 0, 1, 3, 0, 0, 0, 0, 0, 3};
  const planish::surface tube = planish::tensor_new(3, 1, 1, u, v, points);
  CHECK((tube.box() == std::vector<double>{0, 0, 0, 1, 1, 3}));
  CHECK_NEAR(tube.area(), 12.0, 1e-12);
  CHECK(tube.is_closed(PLANISH_AXIS_U) && !tube.is_closed(PLANISH_AXIS_V));
  CHECK_EQUAL(planish_surface_is_closed(tube.get(), 2), 0u);
  CHECK_EQUAL(planish_surface_is_closed(nullptr, PLANISH_AXIS_U), 0u);
  double number = -7;
  CHECK(planish_surface_box(nullptr, &number) == PLANISH_STATUS_NULL_POINTER && number == -7);
  CHECK(planish_surface_area(nullptr, nullptr, &number) == PLANISH_STATUS_NULL_POINTER && number == -7);
  CHECK(planish_surface_area(tube.get(), nullptr, nullptr) == PLANISH_STATUS_NULL_POINTER);
}

TEST(WrapperError, CarriesStatusTextAndIndex) {
  const std::vector<double> points = {0, 0, 0, 1, 0, 0, 1, NAN, 0};
  const auto error = thrown_by([&] { planish::mesh(points, std::vector<std::uint32_t>{0, 1, 2}); });
  CHECK(error.status() == PLANISH_STATUS_NOT_FINITE);
  CHECK(std::string(error.status_name()) == "PLANISH_STATUS_NOT_FINITE");
  CHECK_EQUAL(error.index(), 2);
  CHECK(std::string(error.what()) == "a coordinate of node 2 is not finite");
  const auto ours = thrown_by([&] { planish::mesh(std::vector<double>(4), std::vector<std::uint32_t>{0, 1, 2}); });
  CHECK(ours.status() == PLANISH_STATUS_INVALID_ARGUMENT);
}

TEST(WrapperSurface, EvaluatesAndTakesParts) {
  const std::vector<double> knots = {0, 0, 1, 1};
  const std::vector<double> points = {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 1};
  planish::surface surface = planish::tensor_new(3, 1, 1, knots, knots, points);
  CHECK_EQUAL(surface.kind(), static_cast<std::uint32_t>(PLANISH_KIND_TENSOR));
  CHECK_EQUAL(surface.dim(), 3u);
  CHECK_EQUAL(surface.coefficient_count(), 4u);
  CHECK(surface.domain() == (std::array<double, 4>{0, 1, 0, 1}));
  CHECK(surface.data_box() == surface.domain());
  CHECK(surface.knots(PLANISH_AXIS_U) == knots);
  CHECK_EQUAL(surface.degree(PLANISH_AXIS_V), 1u);
  CHECK_EQUAL(surface.control_point_count(PLANISH_AXIS_V), 2u);
  CHECK(surface.control_points() == points);
  CHECK(!surface.has_weights());
  CHECK(surface.weights() == std::vector<double>(4, 1.0));

  const std::vector<point2> uv = {{0.25, 0.5}, {1, 1}};
  CHECK(surface.eval(uv) == (std::vector<double>{0.25, 0.5, 0.125, 1, 1, 1}));
  CHECK(surface.point(0.25, 0.5) == (point3{0.25, 0.5, 0.125}));
  CHECK(surface.value(1, 1) == (std::vector<double>{1, 1, 1}));
  CHECK_EQUAL(surface.eval_derivatives(uv, 2).size(), 36u);
  CHECK_EQUAL(surface.eval_derivatives(uv, 1)[3], 1.0);
  CHECK_EQUAL(surface.eval_grid(knots, knots).size(), 48u);
  CHECK_NEAR(surface.normals(point2{0, 0})[0][2], 1.0, 1e-15);
  const auto bent = surface.curvatures(point2{0, 0})[0]; // z = x y: curvatures 1 and -1 along the diagonals
  CHECK_NEAR(bent.k1, 1.0, 1e-14);
  CHECK_NEAR(bent.k2, -1.0, 1e-14);
  CHECK_NEAR(std::fabs(bent.d1[0]), std::sqrt(0.5), 1e-14);
  CHECK(surface.eval(std::vector<double>{}).empty());

  auto options = planish::defaults<planish_eval_options>();
  options.out_stride = 4;
  CHECK_EQUAL(surface.eval(uv, options).size(), 7u);
  std::vector<std::uint8_t> flags(2);
  options = planish::defaults<planish_eval_options>();
  options.outside = PLANISH_OUTSIDE_FLAG;
  options.out_flags = flags.data();
  CHECK(std::isnan(surface.eval(std::vector<double>{0.5, 0.5, 3, 3}, options)[3]));
  CHECK_EQUAL(flags[1] & PLANISH_FLAG_OUTSIDE_DOMAIN, PLANISH_FLAG_OUTSIDE_DOMAIN);
  const auto error = thrown_by([&] { surface.point(3, 3); });
  CHECK(error.status() == PLANISH_STATUS_OUTSIDE);
  CHECK_EQUAL(error.index(), 0);

  const std::vector<std::vector<point2>> trims = {{{0, 0}, {1, 0}, {0, 1}}};
  surface.set_trims(trims);
  CHECK(surface.trims() == trims);
  const planish::surface copy = surface;
  surface.set_trims({});
  CHECK(copy.trims() == trims && surface.trims().empty());

  const auto wrong = thrown_by([&] { planish::tensor_new(3, 1, 1, knots, knots, std::vector<double>(11)); });
  CHECK(wrong.status() == PLANISH_STATUS_INVALID_ARGUMENT);
  const auto degree = thrown_by([&] { planish::tensor_new(1, 0, 1, knots, knots, std::vector<double>(6)); });
  CHECK(degree.status() == PLANISH_STATUS_INVALID_ARGUMENT);
}

TEST(WrapperSurface, TakesOtherForms) {
  const double ends[4] = {0, 0, 1, 1}, points[12] = {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 1};
  planish_surface *handle = nullptr;
  CHECK(planish_tensor_new(3, 1, 1, ends, 4, ends, 4, points, nullptr, &handle) == PLANISH_STATUS_OK);
  planish::surface surface(handle);
  surface.insert_knots(PLANISH_AXIS_U, std::array<double, 2>{0.25, 0.5});
  surface.elevate_degree(PLANISH_AXIS_V, 2);
  CHECK_EQUAL(surface.patch_count(), 3u);
  CHECK_EQUAL(surface.patch_at(0.3, 0.5), 1u);
  const planish::patch patch = surface.patch(2);
  CHECK(patch.record.u_min == 0.5 && patch.record.degree_v == 2);
  CHECK_EQUAL(patch.ordinates.size(), 2u * 3u * 3u);
  const auto [lower, upper] = surface.split(PLANISH_AXIS_V, 0.5);
  CHECK_NEAR(lower.point(0.4, 0.5)[2], 0.2, 1e-15);
  CHECK_NEAR(upper.point(0.4, 0.5)[2], 0.2, 1e-15);
  surface.reverse(PLANISH_AXIS_U);
  CHECK_NEAR(surface.point(0.6, 0.5)[2], 0.2, 1e-15);
  CHECK_EQUAL(surface.to_tensor().coefficient_count(), surface.coefficient_count());
  CHECK(thrown_by([&] { surface.patch(3); }).status() == PLANISH_STATUS_INDEX);
  CHECK(thrown_by([&] { surface.reverse(2); }).status() == PLANISH_STATUS_INVALID_ARGUMENT);
}

TEST(WrapperSurface, ProjectsMeasuresAndTravels) {
  const planish::mesh mesh = make(shapes::graph(20, 20, 0.2, 8));
  const planish::surface surface = planish::tensor_fit(mesh).surface;
  const planish::deviated deviation = surface.deviation(mesh);
  CHECK_EQUAL(deviation.distances.size(), mesh.point_count());
  CHECK_EQUAL(deviation.distances[deviation.report.worst_index], deviation.report.max_distance);

  const std::vector<point3> points = mesh.points();
  const planish::projected near = surface.project(points);
  CHECK(near.status == PLANISH_STATUS_OK);
  CHECK_EQUAL(near.uv.size(), points.size());
  CHECK_NEAR(near.distances[7], deviation.distances[7], 1e-12);
  auto options = planish::defaults<planish_project_options>();
  options.max_distance = 0.5;
  const planish::projected far = surface.project(std::vector<double>{0.5, 0.5, 9}, options);
  CHECK(far.status == PLANISH_STATUS_POINTS_OUTSIDE);
  CHECK(std::isnan(far.uv[0][0]));
  CHECK(thrown_by([&] { surface.project(std::vector<double>(4)); }).status() == PLANISH_STATUS_INVALID_ARGUMENT);

  const planish::mesh tessellation = surface.tessellate();
  CHECK(tessellation.has_parameters());
  CHECK_EQUAL(tessellation.loop_count(), 1u);

  const std::vector<std::uint8_t> bytes = surface.save();
  CHECK(planish::surface::load(bytes).save() == bytes);
  surface.save_file("test_wrapper.planish");
  CHECK(planish::surface::load_file("test_wrapper.planish").save() == bytes);
  surface.write_vtk("test_wrapper.vtu");
  CHECK_EQUAL(surface.write_step("test_wrapper.step").loop_count, 1u);
  for (const char *path : {"test_wrapper.planish", "test_wrapper.vtu", "test_wrapper.step"}) {
    CHECK(std::remove(path) == 0);
  }
  const std::vector<std::uint8_t> cut(bytes.begin(), bytes.end() - 1);
  CHECK(thrown_by([&] { planish::surface::load(cut); }).status() == PLANISH_STATUS_FORMAT);
}

TEST(WrapperFit, RemarksAreReturnedAndNotThrown) {
  const planish::mesh mesh = make(shapes::graph(20, 20, 0.2, 2));
  auto options = planish::defaults<planish_tensor_options>();
  const auto [surface, report, status] = planish::tensor_fit(mesh, options);
  CHECK(status == PLANISH_STATUS_OK);
  CHECK(report.max_error <= report.tolerance);
  CHECK_EQUAL(surface.dim(), 3u);
  options.tolerance = 1e-9;
  options.max_grid = 3;
  const planish::fitted missed = planish::tensor_fit(mesh, options);
  CHECK(missed.status == PLANISH_STATUS_TOLERANCE_NOT_MET);
  CHECK(missed.report.max_error > missed.report.tolerance);
  CHECK(missed.surface.coefficient_count() > 0);
  options.tolerance = -1;
  CHECK(thrown_by([&] { planish::tensor_fit(mesh, options); }).status() == PLANISH_STATUS_INVALID_ARGUMENT);
}

TEST(WrapperFit, TakesPointsAndFields) {
  const shapes::arrays all = shapes::graph(12, 12, 0.2, 3);
  std::vector<double> values;
  for (std::size_t n = 0; n < all.point_count(); ++n) values.push_back(all.uv[2 * n] - all.uv[2 * n + 1]);
  CHECK(planish::tensor_fit_points(all.uv, values, 1).report.max_error < 1e-12);
  CHECK(planish::tensor_fit_field(make(all), values, 1).report.max_error < 1e-12);
  values.pop_back();
  CHECK(thrown_by([&] { planish::tensor_fit_points(all.uv, values, 1); }).status() == PLANISH_STATUS_INVALID_ARGUMENT);
  CHECK(thrown_by([&] { planish::tensor_fit_field(make(all), values, 1); }).status() ==
        PLANISH_STATUS_INVALID_ARGUMENT);
}

TEST(WrapperCurve, FitsAndEvaluates) {
  std::vector<double> u, values;
  for (int i = 0; i <= 20; ++i) {
    u.push_back(i / 20.0);
    values.insert(values.end(), {2 * u.back(), 1 - u.back()});
  }
  const auto [curve, report, status] = planish::curve_fit(u, values, 2);
  CHECK(status == PLANISH_STATUS_OK);
  CHECK(report.max_error < 1e-13);
  const planish::curve copy = curve;
  CHECK_EQUAL(copy.dim(), 2u);
  CHECK_EQUAL(copy.degree(), 3u);
  CHECK_EQUAL(copy.knots().size(), copy.control_point_count() + 4);
  CHECK_EQUAL(copy.control_points().size(), 2 * copy.control_point_count());
  CHECK(copy.domain()[0] < 0 && copy.domain()[1] > 1);
  CHECK_NEAR(copy.value(0.25)[1], 0.75, 1e-13);
  CHECK_NEAR(copy.eval(u, 1)[2], 2.0, 1e-12);
  CHECK(thrown_by([&] { copy.value(5); }).status() == PLANISH_STATUS_OUTSIDE);
  CHECK(thrown_by([&] { copy.eval(u, 4); }).status() == PLANISH_STATUS_INVALID_ARGUMENT);
  values.pop_back();
  CHECK(thrown_by([&] { planish::curve_fit(u, values, 2); }).status() == PLANISH_STATUS_INVALID_ARGUMENT);
}

TEST(WrapperMap, ReportsAndParameterizes) {
  planish::mesh mesh = make(shapes::graph(15, 15, 0.2, 4), false);
  const planish::parameterized map = mesh.parameterize();
  CHECK(map.status == PLANISH_STATUS_OK);
  CHECK(map.report.stretch >= 1.0);
  CHECK(mesh.has_parameters());
}

namespace {
// Something that is no std::exception, to see it come back unchanged.
struct surprise {
  int number;
};
} // namespace

TEST(WrapperProgress, HearsAndCancels) {
  const planish::mesh mesh = make(shapes::graph(30, 30, 0.2, 5), false);
  int calls = 0;
  planish::tensor_fit(mesh, planish::defaults<planish_tensor_options>(), [&](double fraction, double) {
    ++calls;
    return fraction >= 0.0;
  });
  CHECK(calls > 1);
  const auto error = thrown_by([&] {
    planish::tensor_fit(mesh, planish::defaults<planish_tensor_options>(), [](double, double) { return false; });
  });
  CHECK(error.status() == PLANISH_STATUS_CANCELLED);
}

TEST(WrapperProgress, ReachesProjectionAndTessellation) {
  const std::vector<double> knots = {0, 0, 0, 1, 1, 1};
  const planish::surface saddle = planish::tensor_new(
      3, 2, 2, knots, knots,
      std::vector<double>{0, 0, 0, 0, 1, 1, 0, 2, 0, 1, 0, 1, 1, 1, 3, 1, 2, 1, 2, 0, 0, 2, 1, 1, 2, 2, 0});
  auto fine = planish::defaults<planish_tessellate_options>();
  fine.chord_tolerance = 1e-6;
  std::uint32_t stage = 99;
  fine.out_stage = &stage;
  CHECK(thrown_by([&] { saddle.tessellate(fine, [](double, double) { return false; }); }).status() ==
        PLANISH_STATUS_CANCELLED);
  CHECK_EQUAL(stage, static_cast<std::uint32_t>(PLANISH_STAGE_TESSELLATE));
  std::int32_t flag = 1;
  auto many = planish::defaults<planish_project_options>();
  many.cancel = &flag;
  const std::vector<double> points(3000000, 0.25);
  CHECK(thrown_by([&] { saddle.project(planish::values<double>(points), many); }).status() == PLANISH_STATUS_CANCELLED);
}

TEST(WrapperProgress, ExceptionsComeBackUnchanged) {
  planish::mesh mesh = make(shapes::graph(30, 30, 0.2, 6), false);
  for (int last : {1, 2, 5}) {
    int calls = 0, caught = 0;
    try {
      planish::tensor_fit(mesh, planish::defaults<planish_tensor_options>(), [&](double, double) -> bool {
        if (++calls == last) throw surprise{100 + last};
        return true;
      });
    } catch (const surprise &thrown) {
      caught = thrown.number;
    }
    CHECK_EQUAL(caught, 100 + last);
    CHECK_EQUAL(calls, last);
  }
  try {
    mesh.parameterize(planish::defaults<planish_parameterize_options>(),
                      [](double, double) -> bool { throw std::out_of_range("mine"); });
    CHECK(!"nothing was thrown");
  } catch (const std::out_of_range &thrown) {
    CHECK(std::string(thrown.what()) == "mine");
  }
  CHECK(!mesh.has_parameters());
  CHECK(mesh.parameterize().status == PLANISH_STATUS_OK); // the mesh is as good as before
}

TEST(WrapperProgress, LeavesACCallbackInTheOptions) {
  const planish::mesh mesh = make(shapes::graph(30, 30, 0.2, 7), false);
  auto options = planish::defaults<planish_tensor_options>();
  int calls = 0;
  options.user = &calls;
  options.progress = [](double, double, void *user) -> std::int32_t {
    ++*static_cast<int *>(user);
    return 0;
  };
  planish::tensor_fit(mesh, options);
  CHECK(calls > 0);
}

TEST(Curve, IsInterpolatedMeasuredAndSaved) {
  std::vector<double> angles, points;
  for (int k = 0; k <= 16; ++k) {
    angles.push_back(k / 16.0);
    points.insert(points.end(), {std::cos(angles.back()), std::sin(angles.back())});
  }
  const planish::curve arc = planish::curve_interpolate(angles, points, 2);
  CHECK_NEAR(arc.length(), 1, 1e-4);
  const std::vector<double> lengths = arc.arc_lengths(std::vector<double>{0, 0.25, 1});
  CHECK_EQUAL(lengths[0], 0.0);
  CHECK_NEAR(lengths[1], 0.25, 1e-4);
  CHECK_EQUAL(lengths[2], arc.length());
  const planish::curve::feet feet = arc.project(std::vector<double>{2 * std::cos(0.3), 2 * std::sin(0.3), 9, 0});
  CHECK_NEAR(feet.u[0], 0.3, 1e-4);
  CHECK_NEAR(feet.distances[0], 1, 1e-4);
  CHECK_NEAR(feet.distances[1], 8, 1e-12);
  CHECK(planish::curve::load(arc.save()).control_points() == arc.control_points());
  const std::string path = "curve.planish";
  arc.save_file(path);
  CHECK(planish::curve::load_file(path).knots() == arc.knots());
  std::remove(path.c_str());
}

int main() { return check::run(); }
