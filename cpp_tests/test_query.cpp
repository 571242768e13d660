// Questions to a surface from outside: projection, deviation, tessellation.
#include "check.hpp"
#include "handles.hpp"
#include "shapes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>
#include <vector>

static const double nan_ = std::numeric_limits<double>::quiet_NaN();
static const double ends[4] = {0, 0, 1, 1};

// The unit square in the plane z = 0, with a square hole from 0.25 to 0.75 if asked for.
static Surface sheet(bool has_hole) {
  const double points[12] = {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0};
  planish_surface *surface = nullptr;
  CHECK(planish_tensor_new(3, 1, 1, ends, 4, ends, 4, points, nullptr, &surface) == PLANISH_STATUS_OK);
  if (has_hole) {
    const double uv[16] = {0, 0, 1, 0, 1, 1, 0, 1, 0.25, 0.25, 0.25, 0.75, 0.75, 0.75, 0.75, 0.25};
    const std::size_t counts[2] = {4, 4};
    CHECK(planish_surface_set_trims(surface, uv, counts, 2) == PLANISH_STATUS_OK);
  }
  return Surface(surface);
}

static Surface scalar() {
  const double values[4] = {0, 1, 1, 2};
  planish_surface *surface = nullptr;
  CHECK(planish_tensor_new(1, 1, 1, ends, 4, ends, 4, values, nullptr, &surface) == PLANISH_STATUS_OK);
  return Surface(surface);
}

static Mesh raised(double height) {
  shapes::arrays all = shapes::graph(9, 9, 0.2, 51, false, [](double, double) { return 0.0; });
  for (std::size_t n = 0; n < all.point_count(); ++n) all.points[3 * n + 2] = height;
  planish_mesh *mesh = nullptr;
  CHECK(planish_mesh_new(all.points.data(), all.point_count(), all.triangles.data(), all.triangle_count(), nullptr,
                         &mesh) == PLANISH_STATUS_OK);
  return Mesh(mesh);
}

static planish_project_options project_options() {
  planish_project_options options;
  CHECK(planish_project_options_init(&options, sizeof options) == PLANISH_STATUS_OK);
  return options;
}

static planish_deviation_options deviation_options() {
  planish_deviation_options options;
  CHECK(planish_deviation_options_init(&options, sizeof options) == PLANISH_STATUS_OK);
  return options;
}

static planish_tessellate_options tessellate_options() {
  planish_tessellate_options options;
  CHECK(planish_tessellate_options_init(&options, sizeof options) == PLANISH_STATUS_OK);
  return options;
}

TEST(Project, FindsTheNearestPlace) {
  const Surface surface = sheet(true);
  const double points[9] = {0.1, 0.2, 3, 0.5, 0.7, 0, -1, 0.5, 0}; // above, in the hole, beside
  double uv[6], distances[3];
  CHECK(planish_surface_project(surface.get(), points, 3, nullptr, uv, distances) == PLANISH_STATUS_OK);
  const double expected[6] = {0.1, 0.2, 0.5, 0.75, 0, 0.5};
  for (int k = 0; k < 6; ++k) CHECK_NEAR(uv[k], expected[k], 1e-12);
  CHECK_NEAR(distances[0], 3.0, 1e-12);
  CHECK_NEAR(distances[1], 0.05, 1e-12);
  CHECK_NEAR(distances[2], 1.0, 1e-12);

  planish_project_options options = project_options();
  options.keep_trims = 0;
  CHECK(planish_surface_project(surface.get(), points, 3, &options, nullptr, distances) == PLANISH_STATUS_OK);
  CHECK_NEAR(distances[1], 0.0, 1e-12);

  options = project_options();
  options.max_distance = 2;
  CHECK(planish_surface_project(surface.get(), points, 3, &options, uv, distances) == PLANISH_STATUS_POINTS_OUTSIDE);
  CHECK(std::isnan(uv[0]) && std::isnan(uv[1]) && std::isnan(distances[0]) && distances[2] == distances[2]);

  const double guesses[6] = {0.9, 0.9, 0.5, 0.8, 0, 0};
  options = project_options();
  options.guesses = guesses;
  CHECK(planish_surface_project(surface.get(), points, 3, &options, uv, nullptr) == PLANISH_STATUS_OK);
  CHECK_NEAR(uv[0], 0.1, 1e-12); // the nearest place, whatever the guess

  std::uint8_t flags[3] = {7, 7, 7};
  options = project_options();
  options.out_flags = flags;
  CHECK(planish_surface_project(surface.get(), points, 3, &options, nullptr, nullptr) == PLANISH_STATUS_OK);
  CHECK(flags[0] == 0 && flags[1] == 0 && flags[2] == 0); // each is proved to be the nearest
}

TEST(Project, SeesTheSurfaceAsItIs) {
  const Surface surface = sheet(false);
  const double point[3] = {0.5, 0.5, 2};
  double distance = -1;
  CHECK(planish_surface_project(surface.get(), point, 1, nullptr, nullptr, &distance) == PLANISH_STATUS_OK);
  CHECK_NEAR(distance, 2.0, 1e-12);
  // what the first call kept does not outlive a change
  const double corner[6] = {0, 0, 0.25, 0, 0, 0.25};
  const std::size_t count = 3;
  CHECK(planish_surface_set_trims(surface.get(), corner, &count, 1) == PLANISH_STATUS_OK);
  CHECK(planish_surface_project(surface.get(), point, 1, nullptr, nullptr, &distance) == PLANISH_STATUS_OK);
  CHECK_NEAR(distance, std::sqrt(4 + 2 * 0.375 * 0.375), 1e-12);
}

TEST(Project, RefusesByName) {
  const Surface surface = sheet(false);
  const double points[6] = {0, 0, 0, 0, nan_, 0};
  double uv[4] = {-7, -7, -7, -7}, distances[2] = {-7, -7};
  const check::untouched uv_before(uv), distances_before(distances);
  const auto invalid = PLANISH_STATUS_INVALID_ARGUMENT, null = PLANISH_STATUS_NULL_POINTER;
  const auto project = [&](const planish_surface *surface, const double *points, std::size_t count,
                           const planish_project_options *options) {
    return planish_surface_project(surface, points, count, options, uv, distances);
  };
  CHECK_FAILS(project(surface.get(), points, 2, nullptr), PLANISH_STATUS_NOT_FINITE, 1, "point 1");
  CHECK_FAILS(project(nullptr, points, 1, nullptr), null, -1, "surface is NULL");
  CHECK_FAILS(project(surface.get(), nullptr, 1, nullptr), null, -1, "points is NULL");
  CHECK_FAILS(project(surface.get(), points, SIZE_MAX / 4, nullptr), PLANISH_STATUS_TOO_LARGE, -1, "memory");
  planish_project_options options = project_options();
  options.max_distance = -1;
  CHECK_FAILS(project(surface.get(), points, 1, &options), invalid, -1, "largest distance is -1");
  options = project_options();
  options.keep_trims = 2;
  CHECK_FAILS(project(surface.get(), points, 1, &options), invalid, -1, "keep_trims is 2");
  options = project_options();
  options.thread_count = 1025;
  CHECK_FAILS(project(surface.get(), points, 1, &options), invalid, -1, "thread_count is 1025");
  options = project_options();
  options.guesses = points + 3; // a NaN
  CHECK_FAILS(project(surface.get(), points, 1, &options), PLANISH_STATUS_NOT_FINITE, 0, "guess");
  CHECK_FAILS(planish_project_options_init(nullptr, sizeof options), null, -1, "options is NULL");
  CHECK(uv_before.holds() && distances_before.holds());
  CHECK(planish_surface_project(surface.get(), nullptr, 0, nullptr, nullptr, nullptr) == PLANISH_STATUS_OK);
}

TEST(Deviation, IsTheHeight) {
  const Surface surface = sheet(false);
  const Mesh mesh = raised(0.125);
  const std::size_t count = planish_mesh_point_count(mesh.get());
  std::vector<double> distances(count);
  auto report = fresh<planish_deviation_report>();
  CHECK(planish_surface_deviation(surface.get(), mesh.get(), nullptr, distances.data(), count, &report) ==
        PLANISH_STATUS_OK);
  for (double distance : distances) CHECK_NEAR(distance, 0.125, 1e-14);
  CHECK_NEAR(report.max_distance, 0.125, 1e-14);
  CHECK_NEAR(report.rms_distance, 0.125, 1e-14);
  CHECK_NEAR(report.mean_distance, 0.125, 1e-14);
  CHECK(std::isnan(report.max_back_distance));
  CHECK_EQUAL(report.back_count, 0u);
  CHECK_NEAR(report.median_distance, 0.125, 1e-14);
  CHECK_NEAR(report.distance_99, 0.125, 1e-14);

  planish_deviation_options options = deviation_options();
  std::vector<double> heights(count), places(2 * count);
  options.out_signed = heights.data();
  options.out_uv = places.data();
  CHECK(planish_surface_deviation(surface.get(), mesh.get(), &options, nullptr, 0, nullptr) == PLANISH_STATUS_OK);
  // the mesh is above, where the normal points
  for (double height : heights) CHECK_NEAR(height, 0.125, 1e-14);
  const Mesh below = raised(-0.125);
  CHECK(planish_surface_deviation(surface.get(), below.get(), &options, nullptr, 0, nullptr) == PLANISH_STATUS_OK);
  for (double height : heights) CHECK_NEAR(height, -0.125, 1e-14);
  std::uint32_t face = 7;
  options.out_faces = &face;
  CHECK_FAILS(planish_surface_deviation(surface.get(), mesh.get(), &options, nullptr, 0, nullptr),
              PLANISH_STATUS_INVALID_ARGUMENT, -1, "out_faces is not used");

  options = deviation_options();
  options.measure_back = 1;
  CHECK(planish_surface_deviation(surface.get(), mesh.get(), &options, nullptr, 0, &report) == PLANISH_STATUS_OK);
  CHECK_NEAR(report.max_back_distance, 0.125, 1e-14);
  CHECK(report.back_count > 0);
}

TEST(Deviation, RefusesByName) {
  const Surface surface = sheet(false);
  const Mesh mesh = raised(0.125);
  const std::size_t count = planish_mesh_point_count(mesh.get());
  std::vector<double> distances(count, -7);
  auto report = fresh<planish_deviation_report>();
  const check::untouched before(distances), report_before(report);
  const auto invalid = PLANISH_STATUS_INVALID_ARGUMENT, null = PLANISH_STATUS_NULL_POINTER;
  const auto measure = [&](const planish_surface *surface, const planish_mesh *mesh,
                           const planish_deviation_options *options, std::size_t room) {
    return planish_surface_deviation(surface, mesh, options, distances.data(), room, &report);
  };
  CHECK_FAILS(measure(nullptr, mesh.get(), nullptr, count), null, -1, "surface is NULL");
  CHECK_FAILS(measure(surface.get(), nullptr, nullptr, count), null, -1, "mesh is NULL");
  CHECK_FAILS(measure(surface.get(), mesh.get(), nullptr, 0), PLANISH_STATUS_BUFFER_TOO_SMALL, -1, "room for 0");
  CHECK_FAILS(measure(scalar().get(), mesh.get(), nullptr, count), invalid, -1, "dimension 1");
  planish_deviation_options options = deviation_options();
  options.keep_trims = 2;
  CHECK_FAILS(measure(surface.get(), mesh.get(), &options, count), invalid, -1, "keep_trims is 2");
  options = deviation_options();
  options.use_parameters = 2;
  CHECK_FAILS(measure(surface.get(), mesh.get(), &options, count), invalid, -1, "use_parameters is 2");
  options = deviation_options();
  options.measure_back = 2;
  CHECK_FAILS(measure(surface.get(), mesh.get(), &options, count), invalid, -1, "measure_back is 2");
  options = deviation_options();
  options.measure_back = 1;
  options.chord_tolerance = -1;
  CHECK_FAILS(measure(surface.get(), mesh.get(), &options, count), invalid, -1, "chord_tolerance is -1");
  options = deviation_options();
  options.thread_count = 1025;
  CHECK_FAILS(measure(surface.get(), mesh.get(), &options, count), invalid, -1, "thread_count is 1025");
  CHECK_FAILS(planish_deviation_options_init(nullptr, sizeof options), null, -1, "options is NULL");
  CHECK(before.holds() && report_before.holds());
}

TEST(Tessellate, HonoursTheTrims) {
  const Surface surface = sheet(true);
  planish_mesh *raw = nullptr;
  CHECK(planish_surface_tessellate(surface.get(), nullptr, &raw) == PLANISH_STATUS_OK);
  Mesh mesh(raw);
  CHECK_EQUAL(planish_mesh_loop_count(mesh.get()), 2u);
  CHECK_EQUAL(planish_mesh_has_parameters(mesh.get()), 1u);
  // nodes lie on the surface at their parameters, none in the hole
  const std::size_t count = planish_mesh_point_count(mesh.get());
  std::vector<double> uv(2 * count), points(3 * count), found(3 * count);
  CHECK(planish_mesh_copy_parameters(mesh.get(), uv.data(), count) == PLANISH_STATUS_OK);
  CHECK(planish_mesh_copy_points(mesh.get(), points.data(), count) == PLANISH_STATUS_OK);
  CHECK(planish_surface_eval(surface.get(), uv.data(), count, nullptr, found.data()) == PLANISH_STATUS_OK);
  CHECK(points == found);
  for (std::size_t n = 0; n < count; ++n) {
    const double off = std::max(std::fabs(uv[2 * n] - 0.5), std::fabs(uv[2 * n + 1] - 0.5));
    CHECK(off >= 0.25 - 1e-12);
  }

  planish_tessellate_options options = tessellate_options();
  options.keep_trims = 0;
  options.max_edge_length = 0.05;
  raw = nullptr;
  CHECK(planish_surface_tessellate(surface.get(), &options, &raw) == PLANISH_STATUS_OK);
  mesh.reset(raw);
  CHECK_EQUAL(planish_mesh_loop_count(mesh.get()), 1u);
  CHECK(planish_mesh_triangle_count(mesh.get()) > 800);
}

TEST(Tessellate, RefusesByName) {
  const Surface surface = sheet(false);
  planish_mesh *mesh = sentinel<planish_mesh>();
  const auto invalid = PLANISH_STATUS_INVALID_ARGUMENT, null = PLANISH_STATUS_NULL_POINTER;
  CHECK_FAILS(planish_surface_tessellate(nullptr, nullptr, &mesh), null, -1, "surface is NULL");
  CHECK_FAILS(planish_surface_tessellate(surface.get(), nullptr, nullptr), null, -1, "out_mesh is NULL");
  CHECK_FAILS(planish_surface_tessellate(scalar().get(), nullptr, &mesh), invalid, -1, "dimension 1");
  planish_tessellate_options options = tessellate_options();
  options.chord_tolerance = -1;
  CHECK_FAILS(planish_surface_tessellate(surface.get(), &options, &mesh), invalid, -1, "chord_tolerance is -1");
  options = tessellate_options();
  options.max_edge_length = nan_;
  CHECK_FAILS(planish_surface_tessellate(surface.get(), &options, &mesh), invalid, -1, "max_edge_length");
  options = tessellate_options();
  options.keep_trims = 2;
  CHECK_FAILS(planish_surface_tessellate(surface.get(), &options, &mesh), invalid, -1, "keep_trims is 2");
  options = tessellate_options();
  options.thread_count = 1025;
  CHECK_FAILS(planish_surface_tessellate(surface.get(), &options, &mesh), invalid, -1, "thread_count is 1025");
  options = tessellate_options();
  options.max_edge_length = 1e-3;
  options.max_point_count = 100;
  CHECK_FAILS(planish_surface_tessellate(surface.get(), &options, &mesh), PLANISH_STATUS_TOO_LARGE, -1,
              "more than 100 nodes");
  // a trim that crosses itself, and one without area
  const std::size_t four = 4, three = 3;
  const double bow[8] = {0, 0, 1, 1, 1, 0, 0, 1}, line[6] = {0.1, 0.1, 0.5, 0.1, 0.9, 0.1};
  CHECK(planish_surface_set_trims(surface.get(), bow, &four, 1) == PLANISH_STATUS_OK);
  CHECK_FAILS(planish_surface_tessellate(surface.get(), nullptr, &mesh), PLANISH_STATUS_TOPOLOGY, -1, "cross");
  CHECK(planish_surface_set_trims(surface.get(), line, &three, 1) == PLANISH_STATUS_OK);
  CHECK_FAILS(planish_surface_tessellate(surface.get(), nullptr, &mesh), PLANISH_STATUS_DEGENERATE, -1, "no area");
  CHECK_FAILS(planish_tessellate_options_init(nullptr, sizeof options), null, -1, "options is NULL");
  CHECK(mesh == sentinel<planish_mesh>());
}

// What threads of the caller's get of one surface at once, each in its first calls.
TEST(Query, ServesManyThreadsAtOnce) {
  const Surface square = sheet(true);
  planish_pht_convert_options convert;
  CHECK(planish_pht_convert_options_init(&convert, sizeof convert) == PLANISH_STATUS_OK);
  planish_surface *made = nullptr;
  CHECK(planish_pht_from_surface(square.get(), &convert, &made) == PLANISH_STATUS_OK);
  const Surface pht(made);
  const Mesh mesh = raised(0.25);
  planish_project_options project = project_options();
  planish_deviation_options deviate = deviation_options();
  planish_tessellate_options tessellate = tessellate_options();
  project.thread_count = deviate.thread_count = tessellate.thread_count = 1;
  for (const Surface *surface : {&square, &pht}) {
    std::vector<int> wrong(4, 0);
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < wrong.size(); ++t) {
      threads.emplace_back([&, t] {
        const double uv[2] = {0.1, 0.9}, point[3] = {0.1, 0.9, 0.25};
        double place[3], foot[2], distance = -1;
        planish_mesh *triangles = nullptr;
        planish_deviation_report report = {};
        report.struct_size = sizeof report;
        wrong[t] += planish_surface_eval(surface->get(), uv, 1, nullptr, place) != PLANISH_STATUS_OK;
        wrong[t] += planish_surface_project(surface->get(), point, 1, &project, foot, &distance) != PLANISH_STATUS_OK;
        wrong[t] += std::fabs(distance - 0.25) > 1e-12;
        wrong[t] += planish_surface_tessellate(surface->get(), &tessellate, &triangles) < 0;
        planish_mesh_free(triangles);
        wrong[t] += planish_surface_deviation(surface->get(), mesh.get(), &deviate, nullptr, 0, &report) < 0;
      });
    }
    for (std::thread &thread : threads) thread.join();
    for (int count : wrong) CHECK_EQUAL(count, 0);
  }
}

int main() { return check::run(); }
