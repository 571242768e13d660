// planish_surface from outside: known surfaces evaluate to known values, and rules for points hold.
#include "check.hpp"
#include "handles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

static const double nan_ = std::numeric_limits<double>::quiet_NaN();
static const double ends[4] = {0, 0, 1, 1};

// S(u,v) = (u, v, u v) on the unit square.
static Surface saddle() {
  const double points[12] = {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 1};
  planish_surface *surface = nullptr;
  CHECK(planish_tensor_new(3, 1, 1, ends, 4, ends, 4, points, nullptr, &surface) == PLANISH_STATUS_OK);
  return Surface(surface);
}

// A quarter of a cylinder of radius 2 around the z axis, u along the circle.
static Surface cylinder() {
  const double knots[6] = {0, 0, 0, 1, 1, 1};
  const double points[18] = {2, 0, 0, 2, 0, 3, 2, 2, 0, 2, 2, 3, 0, 2, 0, 0, 2, 3};
  const double weights[6] = {1, 1, std::sqrt(0.5), std::sqrt(0.5), 1, 1};
  planish_surface *surface = nullptr;
  CHECK(planish_tensor_new(3, 2, 1, knots, 6, ends, 4, points, weights, &surface) == PLANISH_STATUS_OK);
  return Surface(surface);
}

// A scalar u + 10 v.
static Surface scalar() {
  const double values[4] = {0, 10, 1, 11};
  planish_surface *surface = nullptr;
  CHECK(planish_tensor_new(1, 1, 1, ends, 4, ends, 4, values, nullptr, &surface) == PLANISH_STATUS_OK);
  return Surface(surface);
}

TEST(Surface, KnowsItself) {
  const Surface surface = saddle();
  CHECK_EQUAL(planish_surface_kind(surface.get()), static_cast<std::uint32_t>(PLANISH_KIND_TENSOR));
  CHECK_EQUAL(planish_surface_dim(surface.get()), 3u);
  CHECK_EQUAL(planish_surface_coefficient_count(surface.get()), 4u);
  double box[4], data[4];
  CHECK(planish_surface_domain(surface.get(), box) == PLANISH_STATUS_OK);
  CHECK(planish_surface_data_box(surface.get(), data) == PLANISH_STATUS_OK);
  CHECK(box[0] == 0 && box[1] == 1 && box[2] == 0 && box[3] == 1);
  CHECK(std::equal(box, box + 4, data));
  CHECK_EQUAL(planish_surface_dim(scalar().get()), 1u);
}

TEST(Surface, AnswersNull) {
  CHECK_EQUAL(planish_surface_kind(nullptr), static_cast<std::uint32_t>(PLANISH_KIND_NONE));
  CHECK_EQUAL(planish_surface_dim(nullptr), 0u);
  CHECK_EQUAL(planish_surface_coefficient_count(nullptr), 0u);
  CHECK_EQUAL(planish_surface_trim_count(nullptr), 0u);
  CHECK_EQUAL(planish_surface_trim_point_count(nullptr, 0), 0u);
  CHECK_EQUAL(planish_tensor_degree(nullptr, PLANISH_AXIS_U), 0u);
  CHECK_EQUAL(planish_tensor_knot_count(nullptr, PLANISH_AXIS_U), 0u);
  CHECK_EQUAL(planish_tensor_control_point_count(nullptr, PLANISH_AXIS_U), 0u);
  CHECK_EQUAL(planish_tensor_has_weights(nullptr), 0u);
  planish_surface_free(nullptr);
  double box[4] = {7, 7, 7, 7};
  const check::untouched before(box);
  CHECK_FAILS(planish_surface_domain(nullptr, box), PLANISH_STATUS_NULL_POINTER, -1, "surface is NULL");
  CHECK_FAILS(planish_surface_data_box(nullptr, box), PLANISH_STATUS_NULL_POINTER, -1, "surface is NULL");
  const Surface surface = saddle();
  CHECK_FAILS(planish_surface_domain(surface.get(), nullptr), PLANISH_STATUS_NULL_POINTER, -1, "out_box is NULL");
  CHECK_FAILS(planish_surface_data_box(surface.get(), nullptr), PLANISH_STATUS_NULL_POINTER, -1, "out_box is NULL");
  CHECK(before.holds());
}

TEST(SurfaceClone, IsDeep) {
  Surface surface = saddle();
  planish_surface *raw = nullptr;
  CHECK(planish_surface_clone(surface.get(), &raw) == PLANISH_STATUS_OK);
  const Surface copy(raw);
  surface.reset();
  const double uv[2] = {0.5, 0.25};
  double point[3];
  CHECK(planish_surface_eval(copy.get(), uv, 1, nullptr, point) == PLANISH_STATUS_OK);
  CHECK_NEAR(point[2], 0.125, 1e-16);
  raw = sentinel<planish_surface>();
  CHECK_FAILS(planish_surface_clone(nullptr, &raw), PLANISH_STATUS_NULL_POINTER, -1, "surface is NULL");
  CHECK(raw == sentinel<planish_surface>());
  CHECK_FAILS(planish_surface_clone(copy.get(), nullptr), PLANISH_STATUS_NULL_POINTER, -1, "out_surface is NULL");
}

TEST(SurfaceEval, IsWhatWasMade) {
  const Surface surface = saddle();
  const double uv[6] = {0.25, 0.5, 1, 1, 0, 0.75};
  double points[9];
  CHECK(planish_surface_eval(surface.get(), uv, 3, nullptr, points) == PLANISH_STATUS_OK);
  for (int i = 0; i < 3; ++i) {
    const double u = uv[2 * i], v = uv[2 * i + 1];
    CHECK_NEAR(points[3 * i], u, 1e-16);
    CHECK_NEAR(points[3 * i + 1], v, 1e-16);
    CHECK_NEAR(points[3 * i + 2], u * v, 1e-16);
  }
}

TEST(SurfaceEval, TakesStridesAndLeavesGapsAlone) {
  const Surface surface = saddle();
  const double uv[5] = {0.5, 0.5, 9, 1, 0.5}; // the last row ends with its v
  double points[8];
  std::fill_n(points, 8, -7.0);
  planish_eval_options options = eval_options();
  options.uv_stride = 3;
  options.out_stride = 5;
  CHECK(planish_surface_eval(surface.get(), uv, 2, &options, points) == PLANISH_STATUS_OK);
  CHECK_NEAR(points[2], 0.25, 1e-16);
  CHECK(points[3] == -7 && points[4] == -7);
  CHECK_NEAR(points[7], 0.5, 1e-16);
}

TEST(SurfaceEval, NothingIsFine) {
  const Surface surface = saddle();
  CHECK(planish_surface_eval(surface.get(), nullptr, 0, nullptr, nullptr) == PLANISH_STATUS_OK);
  CHECK(planish_surface_eval_derivatives(surface.get(), nullptr, 0, 2, nullptr, nullptr) == PLANISH_STATUS_OK);
  CHECK(planish_surface_eval_grid(surface.get(), nullptr, 0, ends, 4, nullptr, nullptr) == PLANISH_STATUS_OK);
  CHECK(planish_surface_eval_grid(surface.get(), ends, 4, nullptr, 0, nullptr, nullptr) == PLANISH_STATUS_OK);
  CHECK(planish_surface_normals(surface.get(), nullptr, 0, nullptr, nullptr) == PLANISH_STATUS_OK);
  CHECK(planish_surface_curvatures(surface.get(), nullptr, 0, nullptr, nullptr) == PLANISH_STATUS_OK);
}

TEST(SurfaceEval, LeavesOutputsUntouchedOutsideTheDomain) {
  const Surface surface = saddle();
  const double uv[4] = {0.5, 0.5, 1.5, 0.25};
  std::vector<double> out(2 * 18, -7.0);
  std::uint8_t flags[2] = {0xa5, 0xa5};
  const check::untouched before(out), flags_before(flags);
  planish_eval_options options = eval_options();
  options.out_flags = flags;
  const auto outside = PLANISH_STATUS_OUTSIDE;
  const char *words = "point 1 at (1.5, 0.25)";
  CHECK_FAILS(planish_surface_eval(surface.get(), uv, 2, &options, out.data()), outside, 1, words);
  CHECK_FAILS(planish_surface_eval_derivatives(surface.get(), uv, 2, 2, &options, out.data()), outside, 1, words);
  CHECK_FAILS(planish_surface_normals(surface.get(), uv, 2, &options, out.data()), outside, 1, words);
  CHECK_FAILS(planish_surface_curvatures(surface.get(), uv, 2, &options, out.data()), outside, 1, words);
  const double u[2] = {0.5, -0.5}, v[2] = {0.25, 0.5};
  CHECK_FAILS(planish_surface_eval_grid(surface.get(), u, 2, v, 2, nullptr, out.data()), outside, 2, "(-0.5, 0.25)");
  const double bad[4] = {0.5, 0.5, 0.5, nan_};
  CHECK_FAILS(planish_surface_eval(surface.get(), bad, 2, &options, out.data()), PLANISH_STATUS_NOT_FINITE, 1,
              "point 1");
  options.outside = PLANISH_OUTSIDE_EXTRAPOLATE;
  CHECK_FAILS(planish_surface_eval(surface.get(), bad, 2, &options, out.data()), PLANISH_STATUS_NOT_FINITE, 1,
              "point 1");
  CHECK(before.holds());
  CHECK(flags_before.holds());
}

TEST(SurfaceEval, FlagsOrExtrapolates) {
  const Surface surface = saddle();
  const double uv[6] = {0.5, 0.5, 2, 0.5, nan_, 0};
  double points[9];
  std::uint8_t flags[3];
  planish_eval_options options = eval_options();
  options.out_flags = flags;
  options.outside = PLANISH_OUTSIDE_FLAG;
  CHECK(planish_surface_eval(surface.get(), uv, 3, &options, points) == PLANISH_STATUS_POINTS_OUTSIDE);
  CHECK_NEAR(points[2], 0.25, 1e-16);
  for (int k = 3; k < 9; ++k) CHECK(std::isnan(points[k]));
  CHECK_EQUAL(flags[0], 0);
  CHECK((flags[1] & PLANISH_FLAG_OUTSIDE_DOMAIN) != 0);
  CHECK((flags[2] & PLANISH_FLAG_OUTSIDE_DOMAIN) != 0);

  options.outside = PLANISH_OUTSIDE_EXTRAPOLATE;
  CHECK(planish_surface_eval(surface.get(), uv, 2, &options, points) == PLANISH_STATUS_OK);
  CHECK_NEAR(points[5], 1.0, 1e-15);
  CHECK((flags[1] & PLANISH_FLAG_OUTSIDE_DOMAIN) != 0);
}

TEST(SurfaceEval, RefusesOptionsAndNull) {
  const Surface surface = saddle();
  const double uv[2] = {0.5, 0.5};
  std::vector<double> out(18, -7.0);
  const check::untouched before(out);
  const auto refuse = [&](const planish_eval_options &options, planish_status status, const char *words) {
    CHECK_FAILS(planish_surface_eval(surface.get(), uv, 1, &options, out.data()), status, -1, words);
  };
  const auto invalid = PLANISH_STATUS_INVALID_ARGUMENT, null = PLANISH_STATUS_NULL_POINTER;
  planish_eval_options options = eval_options();
  options.uv_stride = 1;
  refuse(options, invalid, "uv_stride is 1");
  options = eval_options();
  options.out_stride = 2;
  refuse(options, invalid, "out_stride is 2, it must be 0 or at least 3");
  options = eval_options();
  options.outside = 3;
  refuse(options, invalid, "outside is 3");
  options = eval_options();
  options.thread_count = 1025;
  refuse(options, invalid, "thread_count is 1025");
  options = eval_options();
  options.struct_size = 3;
  refuse(options, invalid, "struct_size");
  options = eval_options();
  options.uv_stride = 2;
  CHECK_FAILS(planish_surface_eval_grid(surface.get(), uv, 1, uv, 1, &options, out.data()), invalid, -1, "uv_stride");
  CHECK_FAILS(planish_surface_eval_derivatives(surface.get(), uv, 1, 3, nullptr, out.data()), invalid, -1,
              "max_derivative is 3");
  CHECK_FAILS(planish_surface_normals(scalar().get(), uv, 1, nullptr, out.data()), invalid, -1, "dimension 1");
  CHECK_FAILS(planish_surface_curvatures(scalar().get(), uv, 1, nullptr, out.data()), invalid, -1, "dimension 1");

  CHECK_FAILS(planish_surface_eval(nullptr, uv, 1, nullptr, out.data()), null, -1, "surface is NULL");
  CHECK_FAILS(planish_surface_eval(surface.get(), nullptr, 1, nullptr, out.data()), null, -1, "uv is NULL");
  CHECK_FAILS(planish_surface_eval(surface.get(), uv, 1, nullptr, nullptr), null, -1, "out_values is NULL");
  CHECK_FAILS(planish_surface_eval_derivatives(nullptr, uv, 1, 1, nullptr, out.data()), null, -1, "surface");
  CHECK_FAILS(planish_surface_eval_derivatives(surface.get(), nullptr, 1, 1, nullptr, out.data()), null, -1, "uv");
  CHECK_FAILS(planish_surface_eval_derivatives(surface.get(), uv, 1, 1, nullptr, nullptr), null, -1, "out is NULL");
  CHECK_FAILS(planish_surface_eval_grid(nullptr, uv, 2, uv, 2, nullptr, out.data()), null, -1, "surface");
  CHECK_FAILS(planish_surface_eval_grid(surface.get(), nullptr, 2, uv, 2, nullptr, out.data()), null, -1, "u is NULL");
  CHECK_FAILS(planish_surface_eval_grid(surface.get(), uv, 2, nullptr, 2, nullptr, out.data()), null, -1, "v is NULL");
  CHECK_FAILS(planish_surface_eval_grid(surface.get(), uv, 2, uv, 2, nullptr, nullptr), null, -1, "out_values");
  CHECK_FAILS(planish_surface_normals(nullptr, uv, 1, nullptr, out.data()), null, -1, "surface");
  CHECK_FAILS(planish_surface_normals(surface.get(), nullptr, 1, nullptr, out.data()), null, -1, "uv");
  CHECK_FAILS(planish_surface_normals(surface.get(), uv, 1, nullptr, nullptr), null, -1, "out_normals");
  CHECK_FAILS(planish_surface_curvatures(nullptr, uv, 1, nullptr, out.data()), null, -1, "surface");
  CHECK_FAILS(planish_surface_curvatures(surface.get(), nullptr, 1, nullptr, out.data()), null, -1, "uv");
  CHECK_FAILS(planish_surface_curvatures(surface.get(), uv, 1, nullptr, nullptr), null, -1, "out is NULL");
  CHECK_FAILS(planish_surface_eval(surface.get(), uv, SIZE_MAX / 4, nullptr, out.data()), PLANISH_STATUS_TOO_LARGE, -1,
              "more than memory can address");
  CHECK_FAILS(planish_eval_options_init(nullptr, sizeof options), null, -1, "options is NULL");
  CHECK(before.holds());

  struct {
    planish_eval_options known;
    double later;
  } newer = {eval_options(), 1.0};
  newer.known.struct_size = sizeof newer;
  CHECK_FAILS(planish_surface_eval(surface.get(), uv, 1, &newer.known, out.data()), PLANISH_STATUS_VERSION, -1,
              "planish_eval_options");
  CHECK(before.holds());
}

TEST(SurfaceDerivatives, OfASaddle) {
  const Surface surface = saddle();
  const double uv[2] = {0.25, 0.75};
  double out[18];
  CHECK(planish_surface_eval_derivatives(surface.get(), uv, 1, 2, nullptr, out) == PLANISH_STATUS_OK);
  const double expected[18] = {0.25, 0.75, 0.1875, 1, 0, 0.75, 0, 1, 0.25, 0, 0, 0, 0, 0, 1, 0, 0, 0};
  for (int k = 0; k < 18; ++k) CHECK_NEAR(out[k], expected[k], 1e-15);
  double first[9];
  CHECK(planish_surface_eval_derivatives(surface.get(), uv, 1, 1, nullptr, first) == PLANISH_STATUS_OK);
  CHECK(std::equal(first, first + 9, out));
}

TEST(SurfaceGrid, EqualsPoints) {
  const Surface surface = cylinder();
  const double u[3] = {0, 0.3, 1}, v[2] = {0.1, 0.9};
  std::vector<double> uv, grid(18), points(18);
  for (double s : u) {
    for (double t : v) uv.insert(uv.end(), {s, t});
  }
  CHECK(planish_surface_eval_grid(surface.get(), u, 3, v, 2, nullptr, grid.data()) == PLANISH_STATUS_OK);
  CHECK(planish_surface_eval(surface.get(), uv.data(), 6, nullptr, points.data()) == PLANISH_STATUS_OK);
  CHECK(grid == points);
}

TEST(SurfaceCurvature, OfACylinder) {
  const Surface surface = cylinder();
  const double uv[4] = {0.2, 0.5, 0.9, 0.1};
  double points[6], normals[6], out[16];
  CHECK(planish_surface_eval(surface.get(), uv, 2, nullptr, points) == PLANISH_STATUS_OK);
  CHECK(planish_surface_normals(surface.get(), uv, 2, nullptr, normals) == PLANISH_STATUS_OK);
  CHECK(planish_surface_curvatures(surface.get(), uv, 2, nullptr, out) == PLANISH_STATUS_OK);
  for (int i = 0; i < 2; ++i) {
    const double *p = points + 3 * i, *n = normals + 3 * i, *c = out + 8 * i;
    CHECK_NEAR(std::hypot(p[0], p[1]), 2.0, 1e-15);
    CHECK_NEAR(n[0], p[0] / 2, 1e-14); // outwards: u runs counter-clockwise, v upwards
    CHECK_NEAR(n[1], p[1] / 2, 1e-14);
    CHECK_NEAR(c[0], 0.0, 1e-13); // straight along z
    CHECK_NEAR(c[1], -0.5, 1e-13); // bends away from the normal
    CHECK_NEAR(std::fabs(c[4]), 1.0, 1e-13);
    CHECK_NEAR(c[5] * p[0] + c[6] * p[1], 0.0, 1e-13);
  }
}

TEST(SurfaceCurvature, IsNanWithoutANormal) {
  // one edge of the patch is a single point
  const double points[12] = {0, 0, 0, 0, 0, 0, 1, 0, 0, 1, 1, 0};
  planish_surface *raw = nullptr;
  CHECK(planish_tensor_new(3, 1, 1, ends, 4, ends, 4, points, nullptr, &raw) == PLANISH_STATUS_OK);
  const Surface surface(raw);
  const double uv[2] = {0, 0.5};
  double normal[3];
  std::uint8_t flag = 0;
  planish_eval_options options = eval_options();
  options.out_flags = &flag;
  CHECK(planish_surface_normals(surface.get(), uv, 1, &options, normal) == PLANISH_STATUS_OK);
  CHECK(std::isnan(normal[0]) && std::isnan(normal[1]) && std::isnan(normal[2]));
  CHECK((flag & PLANISH_FLAG_NO_NORMAL) != 0);
}

TEST(SurfaceEval, DoesNotDependOnThreads) {
  const Surface surface = cylinder();
  const std::size_t count = 60000; // 59 pieces of 1024 points
  std::vector<double> uv;
  for (std::size_t k = 0; k < count; ++k) {
    uv.push_back(static_cast<double>(k) / static_cast<double>(count));
    uv.push_back(static_cast<double>((k * 7919) % count) / static_cast<double>(count));
  }
  std::vector<std::vector<double>> found;
  for (std::uint32_t threads : {1u, 2u, 5u}) {
    planish_eval_options options = eval_options();
    options.thread_count = threads;
    std::vector<double> out(8 * count);
    CHECK(planish_surface_curvatures(surface.get(), uv.data(), count, &options, out.data()) == PLANISH_STATUS_OK);
    found.push_back(out);
  }
  CHECK(std::memcmp(found[0].data(), found[1].data(), found[0].size() * sizeof(double)) == 0);
  CHECK(std::memcmp(found[0].data(), found[2].data(), found[0].size() * sizeof(double)) == 0);
}

TEST(SurfaceTrims, GoInAndOut) {
  const Surface surface = saddle();
  CHECK_EQUAL(planish_surface_trim_count(surface.get()), 0u);
  const double uv[14] = {0, 0, 1, 0, 1, 1, 0, 1, 0.25, 0.25, 0.5, 0.25, 0.25, 0.5};
  const std::size_t counts[2] = {4, 3};
  CHECK(planish_surface_set_trims(surface.get(), uv, counts, 2) == PLANISH_STATUS_OK);
  CHECK_EQUAL(planish_surface_trim_count(surface.get()), 2u);
  CHECK_EQUAL(planish_surface_trim_point_count(surface.get(), 0), 4u);
  CHECK_EQUAL(planish_surface_trim_point_count(surface.get(), 1), 3u);
  CHECK_EQUAL(planish_surface_trim_point_count(surface.get(), 2), 0u);
  double hole[6] = {0};
  CHECK(planish_surface_copy_trim(surface.get(), 1, hole, 3) == PLANISH_STATUS_OK);
  CHECK(std::equal(hole, hole + 6, uv + 8));

  // evaluation ignores trims but flags the points
  const double places[4] = {0.3, 0.3, 0.75, 0.75};
  double points[6];
  std::uint8_t flags[2];
  planish_eval_options options = eval_options();
  options.out_flags = flags;
  CHECK(planish_surface_eval(surface.get(), places, 2, &options, points) == PLANISH_STATUS_OK);
  CHECK_NEAR(points[2], 0.09, 1e-16);
  CHECK_EQUAL(flags[0], PLANISH_FLAG_OUTSIDE_TRIMS);
  CHECK_EQUAL(flags[1], 0);

  const check::untouched before(hole);
  const auto null = PLANISH_STATUS_NULL_POINTER;
  CHECK_FAILS(planish_surface_copy_trim(surface.get(), 2, hole, 3), PLANISH_STATUS_INDEX, 2, "trim 2");
  CHECK_FAILS(planish_surface_copy_trim(surface.get(), 1, hole, 2), PLANISH_STATUS_BUFFER_TOO_SMALL, -1, "3 are needed");
  CHECK_FAILS(planish_surface_copy_trim(nullptr, 1, hole, 3), null, -1, "surface is NULL");
  CHECK_FAILS(planish_surface_copy_trim(surface.get(), 1, nullptr, 3), null, -1, "out_uv is NULL");
  CHECK(before.holds());

  const double bad[6] = {0, 0, 1, 0, nan_, 1}, far[6] = {0, 0, 1, 0, 1, 2};
  const std::size_t three = 3, two = 2;
  CHECK_FAILS(planish_surface_set_trims(surface.get(), bad, &three, 1), PLANISH_STATUS_NOT_FINITE, 0, "trim 0");
  CHECK_FAILS(planish_surface_set_trims(surface.get(), far, &three, 1), PLANISH_STATUS_OUTSIDE, 0, "outside");
  CHECK_FAILS(planish_surface_set_trims(surface.get(), uv, &two, 1), PLANISH_STATUS_INVALID_ARGUMENT, 0, "2 points");
  CHECK_FAILS(planish_surface_set_trims(nullptr, uv, counts, 2), null, -1, "surface is NULL");
  CHECK_FAILS(planish_surface_set_trims(surface.get(), nullptr, counts, 2), null, -1, "uv is NULL");
  CHECK_FAILS(planish_surface_set_trims(surface.get(), uv, nullptr, 2), null, -1, "point_counts is NULL");
  CHECK_EQUAL(planish_surface_trim_count(surface.get()), 2u);
  CHECK(planish_surface_set_trims(surface.get(), nullptr, nullptr, 0) == PLANISH_STATUS_OK);
  CHECK_EQUAL(planish_surface_trim_count(surface.get()), 0u);
}

// A polyline in space as a curve of degree 1 over 0, 1, ...
static Curve polyline(const std::vector<double> &points) {
  std::vector<double> knots{0};
  for (std::size_t k = 0; k < points.size() / 3; ++k) knots.push_back(static_cast<double>(k));
  knots.push_back(knots.back());
  planish_curve *curve = nullptr;
  CHECK(planish_curve_new(3, 1, knots.data(), knots.size(), points.data(), &curve) == PLANISH_STATUS_OK);
  return Curve(curve);
}

TEST(SurfaceTrims, FollowCurves) {
  const Surface surface = cylinder();
  // a square on the cylinder of radius 2: two lines along it, and arcs as chords of a hundredth of a right angle and of half
  // that
  std::vector<double> arc_low, arc_high;
  const double right = std::acos(0.0);
  for (int k = 40; k <= 160; ++k) {
    const double x = 2 * std::cos(0.005 * k * right), y = 2 * std::sin(0.005 * k * right);
    if (k % 2 == 0) arc_low.insert(arc_low.end(), {x, y, 1});
    arc_high.insert(arc_high.end(), {x, y, 2});
  }
  const double *low = arc_low.data(), *end = low + arc_low.size() - 3;
  const Curve sides[4] = {polyline(arc_low), polyline({end[0], end[1], 1, end[0], end[1], 2}), polyline(arc_high),
                          polyline({low[0], low[1], 1, low[0], low[1], 2})};
  const planish_curve *curves[4] = {sides[0].get(), sides[1].get(), sides[2].get(), sides[3].get()};
  const std::size_t four = 4;
  planish_trim_options options;
  CHECK(planish_trim_options_init(&options, sizeof options) == PLANISH_STATUS_OK);
  options.tolerance_scale = PLANISH_TOLERANCE_SCALE_ABSOLUTE;
  auto report = fresh<planish_trim_report>();
  CHECK(planish_surface_trim_by_curves(surface.get(), curves, &four, 1, &options, &report) == PLANISH_STATUS_OK);
  CHECK_EQUAL(planish_surface_trim_count(surface.get()), 1u);
  CHECK_EQUAL(planish_surface_trim_point_count(surface.get(), 0), report.vertex_count);
  CHECK_EQUAL(report.unproven_count, 0u);
  CHECK_EQUAL(report.tolerance, 1e-3);
  // corners lie on the cylinder, and chords inside it: by 2 (1 - cos(right / 200))
  CHECK(report.max_vertex_distance < 1e-12);
  CHECK_NEAR(report.max_distance_between, 2 * (1 - std::cos(right / 200)), 1e-6);
  CHECK(report.rms_distance_between < report.max_distance_between);
  std::vector<double> uv(2 * report.vertex_count);
  CHECK(planish_surface_copy_trim(surface.get(), 0, uv.data(), report.vertex_count) == PLANISH_STATUS_OK);

  const check::untouched before(uv), told(report);
  const auto refuse = [&](planish_status status, long long index, const char *words) {
    CHECK_FAILS(planish_surface_trim_by_curves(surface.get(), curves, &four, 1, &options, &report), status, index, words);
    CHECK_EQUAL(planish_surface_trim_point_count(surface.get(), 0), uv.size() / 2);
    CHECK(told.holds());
  };
  const auto invalid = PLANISH_STATUS_INVALID_ARGUMENT;
  options.tolerance = 1e-5;
  refuse(invalid, 0, "from the surface");
  options.tolerance = 0;
  refuse(invalid, -1, "tolerance is 0");
  options.tolerance = 1e-3;
  const Curve away = polyline({low[0], low[1], 1.25, low[0], low[1], 2});
  curves[3] = away.get();
  refuse(invalid, 3, "not closed: curve 3 ends 2.5e-1 from where curve 0 begins");
  curves[3] = nullptr;
  refuse(PLANISH_STATUS_NULL_POINTER, -1, "a curve is NULL");
  curves[3] = sides[3].get();
  options.add = 1;
  refuse(PLANISH_STATUS_TOPOLOGY, 1, "trim 1 meets trim 0");
  options.add = 2;
  refuse(invalid, -1, "add is 2");
  options.add = 0;
  const auto null = PLANISH_STATUS_NULL_POINTER;
  CHECK_FAILS(planish_surface_trim_by_curves(nullptr, curves, &four, 1, nullptr, nullptr), null, -1, "surface is NULL");
  CHECK_FAILS(planish_surface_trim_by_curves(surface.get(), nullptr, &four, 1, nullptr, nullptr), null, -1, "curves is NULL");
  CHECK_FAILS(planish_surface_trim_by_curves(surface.get(), curves, nullptr, 0, nullptr, nullptr), invalid, -1, "no loops");
  const std::size_t zero = 0;
  CHECK_FAILS(planish_surface_trim_by_curves(surface.get(), curves, &zero, 1, nullptr, nullptr), invalid, 0, "loop 0");
  // without numbers each curve is a loop, which a line is not
  CHECK_FAILS(planish_surface_trim_by_curves(surface.get(), curves + 1, nullptr, 1, &options, nullptr), invalid, 0,
              "not closed");
  CHECK(planish_surface_copy_trim(surface.get(), 0, uv.data(), uv.size() / 2) == PLANISH_STATUS_OK);
  CHECK(before.holds());
}

TEST(TensorNew, PartsComeBack) {
  const Surface surface = cylinder();
  CHECK_EQUAL(planish_tensor_degree(surface.get(), PLANISH_AXIS_U), 2u);
  CHECK_EQUAL(planish_tensor_degree(surface.get(), PLANISH_AXIS_V), 1u);
  CHECK_EQUAL(planish_tensor_knot_count(surface.get(), PLANISH_AXIS_U), 6u);
  CHECK_EQUAL(planish_tensor_control_point_count(surface.get(), PLANISH_AXIS_U), 3u);
  CHECK_EQUAL(planish_tensor_control_point_count(surface.get(), PLANISH_AXIS_V), 2u);
  CHECK_EQUAL(planish_tensor_has_weights(surface.get()), 1u);
  CHECK_EQUAL(planish_tensor_has_weights(saddle().get()), 0u);
  double knots[6], points[18], weights[6], ones[4];
  CHECK(planish_tensor_copy_knots(surface.get(), PLANISH_AXIS_U, knots, 6) == PLANISH_STATUS_OK);
  CHECK(planish_tensor_copy_control_points(surface.get(), points, 6) == PLANISH_STATUS_OK);
  CHECK(planish_tensor_copy_weights(surface.get(), weights, 6) == PLANISH_STATUS_OK);
  CHECK(planish_tensor_copy_weights(saddle().get(), ones, 4) == PLANISH_STATUS_OK);
  CHECK(knots[2] == 0 && knots[3] == 1);
  CHECK(points[6] == 2 && points[7] == 2 && points[8] == 0); // not multiplied by weights
  CHECK(weights[2] == std::sqrt(0.5));
  CHECK(std::all_of(ones, ones + 4, [](double weight) { return weight == 1; }));

  CHECK_EQUAL(planish_tensor_degree(surface.get(), 2), 0u);
  CHECK_EQUAL(planish_tensor_knot_count(surface.get(), 2), 0u);
  CHECK_EQUAL(planish_tensor_control_point_count(surface.get(), 2), 0u);
  const check::untouched knots_before(knots), points_before(points), weights_before(weights);
  const auto small = PLANISH_STATUS_BUFFER_TOO_SMALL, null = PLANISH_STATUS_NULL_POINTER;
  CHECK_FAILS(planish_tensor_copy_knots(surface.get(), PLANISH_AXIS_U, knots, 5), small, -1, "6 are needed");
  CHECK_FAILS(planish_tensor_copy_knots(surface.get(), 2, knots, 6), PLANISH_STATUS_INVALID_ARGUMENT, -1, "axis is 2");
  CHECK_FAILS(planish_tensor_copy_knots(nullptr, PLANISH_AXIS_U, knots, 6), null, -1, "surface");
  CHECK_FAILS(planish_tensor_copy_knots(surface.get(), PLANISH_AXIS_U, nullptr, 6), null, -1, "out_knots");
  CHECK_FAILS(planish_tensor_copy_control_points(surface.get(), points, 5), small, -1, "6 are needed");
  CHECK_FAILS(planish_tensor_copy_control_points(nullptr, points, 6), null, -1, "surface");
  CHECK_FAILS(planish_tensor_copy_control_points(surface.get(), nullptr, 6), null, -1, "out_control_points");
  CHECK_FAILS(planish_tensor_copy_weights(surface.get(), weights, 0), small, -1, "6 are needed");
  CHECK_FAILS(planish_tensor_copy_weights(nullptr, weights, 6), null, -1, "surface");
  CHECK_FAILS(planish_tensor_copy_weights(surface.get(), nullptr, 6), null, -1, "out_weights");
  CHECK(knots_before.holds() && points_before.holds() && weights_before.holds());
}

TEST(TensorNew, RefusesByName) {
  const double points[12] = {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 1};
  planish_surface *surface = sentinel<planish_surface>();
  const auto invalid = PLANISH_STATUS_INVALID_ARGUMENT, null = PLANISH_STATUS_NULL_POINTER;
  const auto make = [&](std::size_t dim, std::uint32_t degree_u, const double *knots_u, std::size_t count,
                        const double *knots_v, const double *control_points, const double *weights) {
    return planish_tensor_new(dim, degree_u, 1, knots_u, count, knots_v, 4, control_points, weights, &surface);
  };
  CHECK_FAILS(make(0, 1, ends, 4, ends, points, nullptr), invalid, -1, "dimension is 0");
  CHECK_FAILS(make(3, 0, ends, 4, ends, points, nullptr), invalid, -1, "degree 0");
  CHECK_FAILS(make(3, 10, ends, 4, ends, points, nullptr), invalid, -1, "degree 10");
  CHECK_FAILS(make(3, 1, ends, 3, ends, points, nullptr), invalid, -1, "3 knots are too few");
  CHECK_FAILS(make(3, 1, nullptr, 0, ends, points, nullptr), invalid, -1, "0 knots are too few");
  const double falling[4] = {0, 0, 1, 0.5}, infinite[4] = {0, 0, 1, HUGE_VAL}, thrice[5] = {0, 0, 0, 1, 1};
  const double empty[4] = {1, 1, 1, 1};
  CHECK_FAILS(make(3, 1, falling, 4, ends, points, nullptr), invalid, 3, "knot 3");
  CHECK_FAILS(make(3, 1, ends, 4, falling, points, nullptr), invalid, 3, "knot 3");
  CHECK_FAILS(make(3, 1, infinite, 4, ends, points, nullptr), PLANISH_STATUS_NOT_FINITE, 3, "knot 3");
  CHECK(make(3, 1, thrice, 5, ends, points, nullptr) == invalid);
  CHECK(make(3, 1, empty, 4, ends, points, nullptr) < 0);
  const double bad[12] = {0, 0, 0, 0, 1, 0, 1, nan_, 0, 1, 1, 1};
  CHECK_FAILS(make(3, 1, ends, 4, ends, bad, nullptr), PLANISH_STATUS_NOT_FINITE, 2, "control point 2");
  const double zero[4] = {1, 0, 1, 1}, infinite_weight[4] = {1, 1, 1, HUGE_VAL};
  CHECK_FAILS(make(3, 1, ends, 4, ends, points, zero), invalid, 1, "weight 1 is 0");
  CHECK_FAILS(make(3, 1, ends, 4, ends, points, infinite_weight), PLANISH_STATUS_NOT_FINITE, 3, "weight 3");
  CHECK_FAILS(make(3, 1, nullptr, 4, ends, points, nullptr), null, -1, "knots_u is NULL");
  CHECK_FAILS(make(3, 1, ends, 4, nullptr, points, nullptr), null, -1, "knots_v is NULL");
  CHECK_FAILS(make(3, 1, ends, 4, ends, nullptr, nullptr), null, -1, "control_points is NULL");
  CHECK_FAILS(make(SIZE_MAX / 8, 1, ends, 4, ends, points, nullptr), PLANISH_STATUS_TOO_LARGE, -1, "memory");
  CHECK(surface == sentinel<planish_surface>());
  CHECK_FAILS(planish_tensor_new(3, 1, 1, ends, 4, ends, 4, points, nullptr, nullptr), null, -1, "out_surface is NULL");
}

TEST(Tensor, ChangesItsNetAndNotItsShape) {
  Surface surface = saddle();
  const double uv[2] = {0.3, 0.6}, knots[2] = {0.5, 0.25}, twice[2] = {0.75, 0.75}, bad = nan_, far = 2;
  double before[3], after[3];
  CHECK(planish_surface_eval(surface.get(), uv, 1, nullptr, before) == PLANISH_STATUS_OK);
  CHECK(planish_tensor_insert_knots(surface.get(), PLANISH_AXIS_U, knots, 2) == PLANISH_STATUS_OK);
  CHECK(planish_tensor_insert_knots(surface.get(), PLANISH_AXIS_U, nullptr, 0) == PLANISH_STATUS_OK);
  CHECK(planish_tensor_elevate_degree(surface.get(), PLANISH_AXIS_V, 3) == PLANISH_STATUS_OK);
  CHECK_EQUAL(planish_surface_coefficient_count(surface.get()), 4u * 4u);
  CHECK(planish_surface_eval(surface.get(), uv, 1, nullptr, after) == PLANISH_STATUS_OK);
  for (int k = 0; k < 3; ++k) CHECK_NEAR(after[k], before[k], 1e-15);
  CHECK(planish_tensor_insert_knots(surface.get(), PLANISH_AXIS_U, twice, 2) == PLANISH_STATUS_INVALID_ARGUMENT);
  CHECK(planish_tensor_insert_knots(surface.get(), PLANISH_AXIS_U, &bad, 1) == PLANISH_STATUS_NOT_FINITE);
  CHECK_EQUAL(planish_error_index(), 0);
  CHECK(planish_tensor_insert_knots(surface.get(), PLANISH_AXIS_U, &far, 1) == PLANISH_STATUS_OUTSIDE);
  CHECK(planish_tensor_insert_knots(surface.get(), 2, knots, 1) == PLANISH_STATUS_INVALID_ARGUMENT);
  CHECK(planish_tensor_insert_knots(surface.get(), PLANISH_AXIS_U, nullptr, 1) == PLANISH_STATUS_NULL_POINTER);
  CHECK(planish_tensor_insert_knots(nullptr, PLANISH_AXIS_U, knots, 1) == PLANISH_STATUS_NULL_POINTER);
  CHECK(planish_tensor_elevate_degree(nullptr, PLANISH_AXIS_U, 3) == PLANISH_STATUS_NULL_POINTER);
  CHECK(planish_tensor_elevate_degree(surface.get(), PLANISH_AXIS_V, 2) == PLANISH_STATUS_INVALID_ARGUMENT);
  CHECK(planish_tensor_elevate_degree(surface.get(), PLANISH_AXIS_V, 10) == PLANISH_STATUS_INVALID_ARGUMENT);
  CHECK_EQUAL(planish_surface_coefficient_count(surface.get()), 4u * 4u);
  CHECK(planish_tensor_reverse(nullptr, PLANISH_AXIS_U) == PLANISH_STATUS_NULL_POINTER);
  CHECK(planish_tensor_reverse(surface.get(), 2) == PLANISH_STATUS_INVALID_ARGUMENT);
  CHECK(planish_tensor_reverse(surface.get(), PLANISH_AXIS_U) == PLANISH_STATUS_OK);
  const double mirrored[2] = {0.7, 0.6};
  CHECK(planish_surface_eval(surface.get(), mirrored, 1, nullptr, after) == PLANISH_STATUS_OK);
  for (int k = 0; k < 3; ++k) CHECK_NEAR(after[k], before[k], 1e-15);
}

TEST(Tensor, SplitsInTwo) {
  const Surface surface = cylinder();
  planish_surface *const none = nullptr;
  planish_surface *lower = none, *upper = none;
  CHECK(planish_tensor_split(nullptr, PLANISH_AXIS_U, 0.5, &lower, &upper) == PLANISH_STATUS_NULL_POINTER);
  CHECK(planish_tensor_split(surface.get(), PLANISH_AXIS_U, 0.5, nullptr, &upper) == PLANISH_STATUS_NULL_POINTER);
  CHECK(planish_tensor_split(surface.get(), PLANISH_AXIS_U, 0.5, &lower, nullptr) == PLANISH_STATUS_NULL_POINTER);
  CHECK(planish_tensor_split(surface.get(), PLANISH_AXIS_U, 1.0, &lower, &upper) == PLANISH_STATUS_OUTSIDE);
  CHECK(planish_tensor_split(surface.get(), 2, 0.5, &lower, &upper) == PLANISH_STATUS_INVALID_ARGUMENT);
  CHECK(lower == none && upper == none);
  CHECK(planish_tensor_split(surface.get(), PLANISH_AXIS_U, 0.5, &lower, &upper) == PLANISH_STATUS_OK);
  const Surface parts[2] = {Surface(lower), Surface(upper)};
  for (int side = 0; side < 2; ++side) {
    const double uv[2] = {side == 0 ? 0.2 : 0.8, 0.5};
    double whole[3], part[3];
    CHECK(planish_surface_eval(surface.get(), uv, 1, nullptr, whole) == PLANISH_STATUS_OK);
    CHECK(planish_surface_eval(parts[side].get(), uv, 1, nullptr, part) == PLANISH_STATUS_OK);
    for (int k = 0; k < 3; ++k) CHECK_NEAR(part[k], whole[k], 1e-14);
    CHECK_NEAR(std::hypot(part[0], part[1]), 2.0, 1e-14);
  }
}

TEST(Patches, AreTheSurface) {
  const Surface surface = cylinder();
  CHECK_EQUAL(planish_surface_patch_count(surface.get()), 1u);
  CHECK_EQUAL(planish_surface_patch_count(nullptr), 0u);
  CHECK_EQUAL(planish_surface_patch_at(surface.get(), 0.5, 0.5), 0u);
  planish_patch patch{};
  patch.struct_size = sizeof patch;
  CHECK(planish_surface_copy_patch(surface.get(), 0, &patch, nullptr, 0) == PLANISH_STATUS_OK);
  CHECK(patch.degree_u == 2 && patch.degree_v == 1 && patch.is_rational == 1);
  CHECK(patch.ordinate_count == 6 && patch.ordinate_width == 4 && patch.u_max == 1);
  std::vector<double> ordinates(6 * 4);
  CHECK(planish_surface_copy_patch(surface.get(), 0, nullptr, ordinates.data(), 6) == PLANISH_STATUS_OK);
  CHECK_NEAR(ordinates[2 * 4 + 3], std::sqrt(0.5), 1e-15);
  CHECK_NEAR(ordinates[2 * 4], 2 * std::sqrt(0.5), 1e-15);
  CHECK(planish_surface_copy_patch(surface.get(), 1, &patch, nullptr, 0) == PLANISH_STATUS_INDEX);
  CHECK(planish_surface_copy_patch(surface.get(), 0, &patch, ordinates.data(), 5) == PLANISH_STATUS_BUFFER_TOO_SMALL);
  CHECK(planish_surface_copy_patch(nullptr, 0, &patch, nullptr, 0) == PLANISH_STATUS_NULL_POINTER);
  patch.struct_size = 0;
  CHECK(planish_surface_copy_patch(surface.get(), 0, &patch, nullptr, 0) == PLANISH_STATUS_INVALID_ARGUMENT);
}

TEST(ToTensor, KeepsToItsLimit) {
  const Surface surface = saddle();
  planish_convert_options options;
  CHECK(planish_convert_options_init(&options, sizeof options) == PLANISH_STATUS_OK);
  CHECK(planish_convert_options_init(nullptr, sizeof options) == PLANISH_STATUS_NULL_POINTER);
  planish_surface *made = nullptr;
  options.max_coefficients = 3;
  CHECK(planish_surface_to_tensor(surface.get(), &options, &made) == PLANISH_STATUS_TOO_LARGE);
  CHECK(planish_surface_to_tensor(nullptr, nullptr, &made) == PLANISH_STATUS_NULL_POINTER);
  CHECK(made == nullptr);
  CHECK(planish_surface_to_tensor(surface.get(), nullptr, nullptr) == PLANISH_STATUS_NULL_POINTER);
  CHECK(planish_surface_to_tensor(surface.get(), nullptr, &made) == PLANISH_STATUS_OK);
  const Surface tensor(made);
  CHECK_EQUAL(planish_surface_coefficient_count(tensor.get()), 4u);
}

int main() { return check::run(); }
