// Fits from outside: tolerances are kept or their loss is said, outputs are all or nothing.
#include "check.hpp"
#include "handles.hpp"
#include "shapes.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

using shapes::arrays;

static const double nan_ = std::numeric_limits<double>::quiet_NaN();

static Mesh make(const arrays &all, bool with_parameters) {
  planish_mesh *mesh = nullptr;
  CHECK(planish_mesh_new(all.points.data(), all.point_count(), all.triangles.data(), all.triangle_count(), nullptr,
                         &mesh) == PLANISH_STATUS_OK);
  if (with_parameters) {
    CHECK(planish_mesh_set_parameters(mesh, all.uv.data(), all.point_count()) == PLANISH_STATUS_OK);
  }
  return Mesh(mesh);
}

struct Fit {
  Surface surface;
  planish_fit_report report = fresh<planish_fit_report>();
  planish_status status = PLANISH_STATUS_INTERNAL;
};

static Fit fit(const planish_mesh *mesh, const planish_tensor_options &options) {
  Fit fit;
  planish_surface *surface = nullptr;
  fit.status = planish_tensor_fit(mesh, &options, &surface, &fit.report);
  CHECK(fit.status >= 0);
  fit.surface.reset(surface);
  return fit;
}

TEST(TensorFit, KeepsTheTolerance) {
  const arrays all = shapes::graph(40, 40, 0.2, 11);
  const Mesh mesh = make(all, true);
  for (double tolerance : {1e-2, 1e-3, 1e-4}) {
    planish_tensor_options options = tensor_options();
    options.tolerance = tolerance;
    std::vector<double> uv(2 * all.point_count()), errors(all.point_count());
    options.out_parameters = uv.data();
    options.out_errors = errors.data();
    const Fit found = fit(mesh.get(), options);
    CHECK(found.status == PLANISH_STATUS_OK);
    CHECK_EQUAL(found.report.stop_reason, static_cast<std::uint32_t>(PLANISH_STOP_REASON_TOLERANCE_MET));
    CHECK_NEAR(found.report.tolerance, tolerance * found.report.diagonal, 1e-12);
    CHECK(found.report.max_error <= found.report.tolerance);
    CHECK(found.report.rms_error <= found.report.max_error);
    CHECK(found.report.mean_error <= found.report.rms_error);
    CHECK(found.report.coefficient_count > 0 && found.report.pass_count > 0);
    CHECK(found.report.seconds >= 0);

    // the errors are what the public evaluation gives at the parameters handed out
    std::vector<double> points(3 * all.point_count());
    CHECK(planish_surface_eval(found.surface.get(), uv.data(), all.point_count(), nullptr, points.data()) ==
          PLANISH_STATUS_OK);
    double largest = 0;
    for (std::size_t n = 0; n < all.point_count(); ++n) {
      const double *s = &points[3 * n], *p = &all.points[3 * n];
      const double error = std::sqrt((s[0] - p[0]) * (s[0] - p[0]) + (s[1] - p[1]) * (s[1] - p[1]) +
                                     (s[2] - p[2]) * (s[2] - p[2]));
      CHECK_NEAR(errors[n], error, 1e-15);
      largest = std::max(largest, error);
    }
    CHECK_NEAR(found.report.max_error, largest, 1e-15);
    CHECK_EQUAL(errors[found.report.worst_index], found.report.max_error);
  }
}

TEST(TensorFit, ParameterizesFirstAndKeepsTheBoundaryAsTrims) {
  const arrays all = shapes::graph(25, 25, 0.2, 12, true);
  const Mesh mesh = make(all, false);
  planish_tensor_options options = tensor_options();
  options.tolerance = 1e-2;
  const Fit found = fit(mesh.get(), options);
  CHECK(found.status == PLANISH_STATUS_OK);
  CHECK((found.report.remarks & PLANISH_REMARK_PARAMETERIZED) != 0);
  CHECK_EQUAL(found.report.flipped_count, 0u);
  CHECK_EQUAL(planish_mesh_has_parameters(mesh.get()), 0u); // the mesh stays as it was
  CHECK_EQUAL(planish_surface_trim_count(found.surface.get()), 2u);
  for (std::size_t loop = 0; loop < 2; ++loop) {
    CHECK_EQUAL(planish_surface_trim_point_count(found.surface.get(), loop),
                planish_mesh_loop_point_count(mesh.get(), loop));
  }
  // the buffer and the holes are flagged
  double box[4], domain[4];
  CHECK(planish_surface_data_box(found.surface.get(), box) == PLANISH_STATUS_OK);
  CHECK(planish_surface_domain(found.surface.get(), domain) == PLANISH_STATUS_OK);
  CHECK(domain[0] < box[0] && domain[1] > box[1] && domain[2] < box[2] && domain[3] > box[3]);
  const double uv[2] = {domain[0], domain[2]};
  double point[3];
  std::uint8_t flag = 0;
  planish_eval_options eval = eval_options();
  eval.out_flags = &flag;
  CHECK(planish_surface_eval(found.surface.get(), uv, 1, &eval, point) == PLANISH_STATUS_OK);
  CHECK_EQUAL(flag, PLANISH_FLAG_IN_BUFFER | PLANISH_FLAG_OUTSIDE_TRIMS);
}

TEST(TensorFit, SaysWhenTheToleranceIsMissed) {
  const Mesh mesh = make(shapes::graph(30, 30, 0.2, 13), true);
  planish_tensor_options options = tensor_options();
  options.tolerance = 1e-9;
  options.tolerance_scale = PLANISH_TOLERANCE_SCALE_ABSOLUTE;
  options.max_grid = 3;
  const Fit found = fit(mesh.get(), options);
  CHECK(found.status == PLANISH_STATUS_TOLERANCE_NOT_MET);
  CHECK(found.surface != nullptr);
  CHECK(found.report.max_error > found.report.tolerance);
  CHECK_EQUAL(found.report.tolerance, 1e-9);
  CHECK((found.report.remarks & PLANISH_REMARK_TOLERANCE_NOT_MET) != 0);
  CHECK_EQUAL(found.report.stop_reason, static_cast<std::uint32_t>(PLANISH_STOP_REASON_LIMIT));
  CHECK(found.report.grid_u <= 3 && found.report.grid_v <= 3);
}

TEST(TensorFit, TakesAFixedGrid) {
  const Mesh mesh = make(shapes::graph(30, 30, 0.2, 14), true);
  planish_tensor_options options = tensor_options();
  options.grid_u = 6;
  options.grid_v = 4;
  options.ends = PLANISH_ENDS_FREE;
  options.tolerance = 1e-9;
  const Fit found = fit(mesh.get(), options);
  CHECK_EQUAL(found.report.grid_u, 6u);
  CHECK_EQUAL(found.report.grid_v, 4u);
  CHECK(found.status == PLANISH_STATUS_TOLERANCE_NOT_MET);
  CHECK_EQUAL(found.report.stop_reason, static_cast<std::uint32_t>(PLANISH_STOP_REASON_FIXED_GRID));
}

TEST(TensorFit, CountsFolds) {
  arrays all = shapes::graph(12, 12, 0.0, 15);
  for (std::size_t n = 0; n < all.point_count(); ++n) { // folded over at u = 0.5
    all.uv[2 * n] = std::fabs(all.uv[2 * n] - 0.45);
  }
  const Mesh mesh = make(all, true);
  planish_tensor_options options = tensor_options();
  options.regularize = PLANISH_REGULARIZE_NEVER;
  options.max_grid = 5;
  const Fit found = fit(mesh.get(), options);
  CHECK(found.status == PLANISH_STATUS_FOLDED_PARAMETERS);
  CHECK(found.report.flipped_count > 0);
  CHECK((found.report.remarks & PLANISH_REMARK_FOLDED_PARAMETERS) != 0);
}

TEST(TensorFit, ReportsWithoutAReportAndShorterOnes) {
  const Mesh mesh = make(shapes::graph(10, 10, 0.1, 16), true);
  planish_surface *raw = nullptr;
  CHECK(planish_tensor_fit(mesh.get(), nullptr, &raw, nullptr) >= 0);
  Surface surface(raw);
  auto report = fresh<planish_fit_report>();
  report.struct_size = offsetof(planish_fit_report, rms_error);
  const double beyond = report.rms_error;
  raw = nullptr;
  CHECK(planish_tensor_fit(mesh.get(), nullptr, &raw, &report) >= 0);
  surface.reset(raw);
  CHECK(report.max_error >= 0);
  CHECK(std::memcmp(&report.rms_error, &beyond, sizeof beyond) == 0);
}

TEST(TensorFit, RefusesByName) {
  const arrays all = shapes::graph(10, 10, 0.1, 17);
  const Mesh mesh = make(all, true);
  std::vector<double> uv(2 * all.point_count(), -7), errors(all.point_count(), -7);
  planish_surface *surface = sentinel<planish_surface>();
  auto report = fresh<planish_fit_report>();
  const check::untouched uv_before(uv), errors_before(errors), report_before(report);
  const auto defaults = [&] {
    planish_tensor_options options = tensor_options();
    options.out_parameters = uv.data();
    options.out_errors = errors.data();
    return options;
  };
  const auto refuse = [&](const planish_tensor_options &options, planish_status status, long long index,
                          const char *words) {
    CHECK_FAILS(planish_tensor_fit(mesh.get(), &options, &surface, &report), status, index, words);
    CHECK(surface == sentinel<planish_surface>());
    CHECK(uv_before.holds() && errors_before.holds() && report_before.holds());
  };
  const auto invalid = PLANISH_STATUS_INVALID_ARGUMENT, null = PLANISH_STATUS_NULL_POINTER;
  planish_tensor_options options = defaults();
  for (double tolerance : {0.0, -1.0, nan_, HUGE_VAL}) {
    options.tolerance = tolerance;
    refuse(options, invalid, -1, "tolerance is");
  }
  options = defaults();
  options.smoothing = -0.5;
  refuse(options, invalid, -1, "smoothing is -0.5");
  options = defaults();
  options.buffer = 11;
  refuse(options, invalid, -1, "buffer is 11");
  options = defaults();
  options.max_grid = 1;
  refuse(options, invalid, -1, "max_grid is 1");
  options = defaults();
  options.max_coefficients = 3;
  refuse(options, invalid, -1, "max_coefficients is 3");
  options = defaults();
  options.grid_u = 5; // without grid_v
  refuse(options, invalid, -1, "grid");
  options = defaults();
  options.grid_u = options.grid_v = 10000;
  refuse(options, invalid, -1, "grid is 10000");
  options = defaults();
  options.tolerance_scale = 2;
  refuse(options, invalid, -1, "tolerance_scale is 2");
  options = defaults();
  options.method = 2;
  refuse(options, invalid, -1, "method is 2");
  options = defaults();
  options.ends = 2;
  refuse(options, invalid, -1, "ends is 2");
  options = defaults();
  options.energy = 2;
  refuse(options, invalid, -1, "energy is 2");
  options = defaults();
  options.regularize = 3;
  refuse(options, invalid, -1, "regularize is 3");
  options = defaults();
  options.measure_distance = 2;
  refuse(options, invalid, -1, "measure_distance is 2");
  options = defaults();
  options.thread_count = 1025;
  refuse(options, invalid, -1, "thread_count is 1025");
  const std::uint32_t missing[] = {3, static_cast<std::uint32_t>(all.point_count())};
  options = defaults();
  options.fixed = missing;
  options.fixed_count = 2;
  refuse(options, PLANISH_STATUS_INDEX, static_cast<long long>(all.point_count()), "is to be fixed");
  options.fixed = nullptr;
  refuse(options, null, -1, "fixed");
  options = defaults();
  options.outlier_share = 0.5;
  refuse(options, invalid, -1, "outlier_share is 0.5");
  options.outlier_share = 0.1;
  options.outlier_scale = 0.1;
  refuse(options, invalid, -1, "outlier_scale");
  std::vector<double> tolerances(all.point_count(), 1e-3);
  tolerances[9] = 0;
  options = defaults();
  options.tolerances = tolerances.data();
  refuse(options, invalid, 9, "tolerance 9 is 0");
  tolerances[9] = nan_;
  refuse(options, PLANISH_STATUS_NOT_FINITE, 9, "tolerance 9");
  std::vector<double> weights(all.point_count(), 1.0);
  options = defaults();
  options.weights = weights.data();
  weights[5] = 0;
  refuse(options, invalid, 5, "weight 5 is 0");
  weights[5] = nan_;
  refuse(options, PLANISH_STATUS_NOT_FINITE, 5, "weight 5");
  planish_parameterize_options map = parameterize_options();
  map.node_weights = weights.data();
  options = defaults();
  options.parameterize = &map;
  refuse(options, invalid, -1, "node_weights must be NULL");
  struct {
    planish_tensor_options known;
    double later;
  } newer = {defaults(), 1.0};
  newer.known.struct_size = sizeof newer;
  refuse(newer.known, PLANISH_STATUS_VERSION, -1, "planish_tensor_options");

  CHECK_FAILS(planish_tensor_fit(nullptr, nullptr, &surface, &report), null, -1, "mesh is NULL");
  CHECK_FAILS(planish_tensor_fit(mesh.get(), nullptr, nullptr, &report), null, -1, "out_surface is NULL");
  CHECK_FAILS(planish_tensor_options_init(nullptr, sizeof options), null, -1, "options is NULL");
  report.struct_size = 0; // never set
  CHECK_FAILS(planish_tensor_fit(mesh.get(), nullptr, &surface, &report), invalid, -1, "struct_size");
  CHECK(surface == sentinel<planish_surface>());
}

TEST(TensorFit, RefusesDegenerateParameters) {
  const arrays all = shapes::graph(10, 10, 0.0, 18);
  const Mesh mesh = make(all, true);
  std::vector<double> flat = all.uv, line = all.uv;
  for (std::size_t n = 0; n < all.point_count(); ++n) {
    flat[2 * n + 1] = 0.5;
    line[2 * n + 1] = line[2 * n];
  }
  planish_surface *surface = sentinel<planish_surface>();
  planish_tensor_options options = tensor_options();
  options.regularize = PLANISH_REGULARIZE_NEVER;
  CHECK(planish_mesh_set_parameters(mesh.get(), flat.data(), all.point_count()) == PLANISH_STATUS_OK);
  CHECK_FAILS(planish_tensor_fit(mesh.get(), &options, &surface, nullptr), PLANISH_STATUS_DEGENERATE, -1, "v = 0.5");
  CHECK(planish_mesh_set_parameters(mesh.get(), line.data(), all.point_count()) == PLANISH_STATUS_OK);
  CHECK_FAILS(planish_tensor_fit(mesh.get(), &options, &surface, nullptr), PLANISH_STATUS_SINGULAR, -1, "one line");
  CHECK(surface == sentinel<planish_surface>());
}

TEST(TensorFitPoints, ReproducesAPlane) {
  const arrays all = shapes::graph(9, 8, 0.3, 19);
  std::vector<double> values;
  for (std::size_t n = 0; n < all.point_count(); ++n) {
    const double u = all.uv[2 * n], v = all.uv[2 * n + 1];
    values.insert(values.end(), {1 + 2 * u - v, 3 * v});
  }
  planish_surface *raw = nullptr;
  auto report = fresh<planish_fit_report>();
  CHECK(planish_tensor_fit_points(all.uv.data(), values.data(), all.point_count(), 2, nullptr, &raw, &report) ==
        PLANISH_STATUS_OK);
  const Surface surface(raw);
  CHECK_EQUAL(planish_surface_dim(surface.get()), 2u);
  CHECK_EQUAL(planish_surface_trim_count(surface.get()), 0u);
  CHECK(report.max_error <= 1e-12);
  CHECK(report.max_interior_error <= 1e-12);
}

TEST(TensorFitPoints, RefusesByName) {
  const double uv[8] = {0, 0, 1, 0, 0, 1, 1, 1}, values[4] = {0, 1, 2, 3};
  planish_surface *surface = sentinel<planish_surface>();
  auto report = fresh<planish_fit_report>();
  const check::untouched before(report);
  const auto call = [&](const double *uv, const double *values, std::size_t count, std::size_t dim) {
    return planish_tensor_fit_points(uv, values, count, dim, nullptr, &surface, &report);
  };
  const auto invalid = PLANISH_STATUS_INVALID_ARGUMENT, null = PLANISH_STATUS_NULL_POINTER;
  const double bad[8] = {0, 0, 1, 0, nan_, 1, 1, 1};
  CHECK_FAILS(call(bad, values, 4, 1), PLANISH_STATUS_NOT_FINITE, 2, "parameters of datum 2");
  CHECK_FAILS(call(uv, bad, 4, 2), PLANISH_STATUS_NOT_FINITE, 2, "values of datum 2");
  CHECK_FAILS(call(uv, values, 2, 1), invalid, -1, "2 data are too few");
  CHECK_FAILS(call(nullptr, nullptr, 0, 1), invalid, -1, "0 data are too few");
  CHECK_FAILS(call(uv, values, 4, 0), invalid, -1, "dim is 0");
  CHECK_FAILS(call(nullptr, values, 4, 1), null, -1, "uv is NULL");
  CHECK_FAILS(call(uv, nullptr, 4, 1), null, -1, "values is NULL");
  CHECK_FAILS(call(uv, values, 4, SIZE_MAX / 2), PLANISH_STATUS_TOO_LARGE, -1, "more than memory can address");
  CHECK_FAILS(planish_tensor_fit_points(uv, values, 4, 1, nullptr, nullptr, &report), null, -1, "out_surface");
  CHECK(surface == sentinel<planish_surface>());
  CHECK(before.holds());
}

TEST(TensorFitField, FitsValuesOnNodes) {
  const arrays all = shapes::graph(30, 30, 0.2, 20);
  const Mesh mesh = make(all, true);
  std::vector<double> values;
  for (std::size_t n = 0; n < all.point_count(); ++n) values.push_back(300 + 5 * std::sin(all.uv[2 * n]));
  planish_surface *raw = nullptr;
  auto report = fresh<planish_fit_report>();
  const planish_status status =
      planish_tensor_fit_field(mesh.get(), values.data(), values.size(), 1, nullptr, &raw, &report);
  CHECK(status == PLANISH_STATUS_OK);
  const Surface surface(raw);
  CHECK_EQUAL(planish_surface_dim(surface.get()), 1u);
  CHECK(report.max_error <= report.tolerance);

  planish_surface *none = sentinel<planish_surface>();
  const auto invalid = PLANISH_STATUS_INVALID_ARGUMENT, null = PLANISH_STATUS_NULL_POINTER;
  const auto call = [&](const planish_mesh *mesh, const double *values, std::size_t count, std::size_t dim) {
    return planish_tensor_fit_field(mesh, values, count, dim, nullptr, &none, nullptr);
  };
  const std::size_t count = values.size();
  CHECK_FAILS(call(mesh.get(), values.data(), count - 1, 1), invalid, -1, "are needed");
  CHECK_FAILS(call(mesh.get(), values.data(), 0, 1), invalid, -1, "are needed");
  CHECK_FAILS(call(mesh.get(), values.data(), count, 0), invalid, -1, "dim is 0");
  CHECK_FAILS(call(nullptr, values.data(), count, 1), null, -1, "mesh is NULL");
  CHECK_FAILS(call(mesh.get(), nullptr, count, 1), null, -1, "values is NULL");
  CHECK_FAILS(call(mesh.get(), values.data(), count, SIZE_MAX / 2), PLANISH_STATUS_TOO_LARGE, -1, "memory");
  values[3] = nan_;
  CHECK_FAILS(call(mesh.get(), values.data(), count, 1), PLANISH_STATUS_NOT_FINITE, 3, "datum 3");
  CHECK(none == sentinel<planish_surface>());
  CHECK_FAILS(planish_tensor_fit_field(mesh.get(), values.data(), count, 1, nullptr, nullptr, nullptr), null, -1,
              "out_surface");
}

// Values may be missing, and may stand for triangles.
TEST(TensorFitField, PassesOverWhatIsMissing) {
  const arrays all = shapes::graph(30, 30, 0.2, 20);
  const Mesh mesh = make(all, true);
  const std::size_t count = all.point_count();
  std::vector<double> values, errors(count), uv(2 * count);
  for (std::size_t n = 0; n < count; ++n) values.push_back(n % 5 == 2 ? nan_ : std::sin(all.uv[2 * n]));
  planish_tensor_options options = tensor_options();
  options.missing = PLANISH_MISSING_SKIPPED;
  options.out_errors = errors.data();
  options.out_parameters = uv.data();
  planish_surface *raw = nullptr;
  CHECK_EQUAL(planish_tensor_fit_field(mesh.get(), values.data(), count, 1, &options, &raw, nullptr),
              PLANISH_STATUS_OK);
  const Surface surface(raw);
  CHECK_EQUAL(planish_surface_trim_count(surface.get()), planish_mesh_loop_count(mesh.get()));
  for (std::size_t n = 0; n < count; ++n) CHECK_EQUAL(std::isnan(errors[n]), n % 5 == 2);
  options.missing = 7;
  CHECK_FAILS(planish_tensor_fit_field(mesh.get(), values.data(), count, 1, &options, &raw, nullptr),
              PLANISH_STATUS_INVALID_ARGUMENT, -1, "missing");
  options = tensor_options();
  options.missing = PLANISH_MISSING_SKIPPED;
  CHECK_FAILS(planish_tensor_fit(mesh.get(), &options, &raw, nullptr), PLANISH_STATUS_INVALID_ARGUMENT, -1, "missing");

  const std::vector<double> constant(all.triangle_count(), 3.0);
  planish_surface *on_triangles = nullptr;
  CHECK_EQUAL(planish_tensor_fit_field(mesh.get(), constant.data(), constant.size(), 1, nullptr, &on_triangles, nullptr),
              PLANISH_STATUS_OK);
  const Surface flat(on_triangles);
  double value = 0;
  const double place[2] = {0.5, 0.5};
  CHECK_EQUAL(planish_surface_eval(flat.get(), place, 1, nullptr, &value), PLANISH_STATUS_OK);
  CHECK_NEAR(value, 3.0, 1e-9);
}

namespace {
struct Listener {
  double stop_at = 2.0; // cancels once so much is done: never
  int calls = 0, calls_after = 0;
  double fraction = 0;
  bool fell_back = false, has_cancelled = false;
  std::chrono::steady_clock::time_point cancelled;

  static std::int32_t hear(double fraction, double, void *user) {
    Listener &self = *static_cast<Listener *>(user);
    self.fell_back = self.fell_back || fraction < self.fraction;
    self.fraction = fraction;
    self.calls_after += self.has_cancelled;
    ++self.calls;
    if (fraction < self.stop_at) return 0;
    self.has_cancelled = true;
    self.cancelled = std::chrono::steady_clock::now();
    return 1;
  }
};
} // namespace

TEST(Progress, IsHeardAndCancels) {
  const arrays all = shapes::graph(60, 60, 0.2, 21);
  const Mesh mesh = make(all, false);
  planish_tensor_options options = tensor_options();
  options.tolerance = 1e-5;
  options.progress = &Listener::hear;
  Listener listener;
  options.user = &listener;
  const Fit whole = fit(mesh.get(), options);
  CHECK(listener.calls > 3);
  CHECK(!listener.fell_back);
  CHECK(listener.fraction <= 1.0);

  for (const double share : {0.0, 0.5, 1.0}) {
    Listener canceller;
    canceller.stop_at = share * listener.fraction;
    options.user = &canceller;
    std::vector<double> errors(all.point_count(), -7);
    options.out_errors = errors.data();
    planish_surface *surface = sentinel<planish_surface>();
    auto report = fresh<planish_fit_report>();
    const check::untouched report_before(report), errors_before(errors);
    const planish_status status = planish_tensor_fit(mesh.get(), &options, &surface, &report);
    const std::chrono::duration<double> after = std::chrono::steady_clock::now() - canceller.cancelled;
    CHECK_FAILS(status, PLANISH_STATUS_CANCELLED, -1, "cancelled");
    CHECK_EQUAL(canceller.calls_after, 0); // it is not asked again
    CHECK(surface == sentinel<planish_surface>());
    CHECK(report_before.holds() && errors_before.holds());
    // 50 milliseconds are promised; a busy machine gets ten times as long
    CHECK(after.count() < 0.5);
  }
}

TEST(Demands, AreMetBySingleNodes) {
  arrays all = shapes::graph(30, 30, 0.2, 7);
  const std::size_t count = all.point_count(), spike = 400;
  all.points[3 * spike + 2] += 0.5;
  const Mesh mesh = make(all, true);
  const std::uint32_t fixed[] = {0, 77, 451};
  std::vector<double> tolerances(count, 1e-2), errors(count);
  for (std::size_t k = 0; k < count / 2; ++k) tolerances[k] = 1e-3;
  std::vector<std::uint8_t> left_out(count, 9);
  planish_tensor_options options = tensor_options();
  options.fixed = fixed;
  options.fixed_count = 3;
  options.tolerances = tolerances.data();
  options.out_errors = errors.data();
  options.out_left_out = left_out.data();
  options.outlier_share = 0.01;
  const Fit found = fit(mesh.get(), options);
  CHECK(found.status == PLANISH_STATUS_OK);
  const double diagonal = found.report.diagonal;
  CHECK(found.report.max_fixed_error <= 1e-12 * diagonal);
  CHECK(found.report.max_tolerance_share <= 1);
  CHECK_EQUAL(found.report.left_out_count, std::size_t{1});
  for (std::size_t k = 0; k < count; ++k) {
    CHECK_EQUAL(int(left_out[k]), int(k == spike));
    CHECK(k == spike ? errors[k] > 0.1 : errors[k] <= tolerances[k] * diagonal);
  }
  for (std::uint32_t node : fixed) CHECK(errors[node] <= found.report.max_fixed_error);

  // two at one place cannot both be fixed
  const double uv[] = {0, 0, 1, 0, 0, 1, 1, 1, 0.5, 0.5, 0.5, 0.5}, values[] = {0, 0, 0, 0, 1, 2};
  const std::uint32_t both[] = {5, 4};
  planish_pht_options pht = fresh<planish_pht_options>();
  CHECK(planish_pht_options_init(&pht, sizeof pht) == PLANISH_STATUS_OK);
  pht.fixed = both;
  pht.fixed_count = 2;
  planish_surface *surface = sentinel<planish_surface>();
  CHECK_FAILS(planish_pht_fit_points(uv, values, 6, 1, &pht, &surface, nullptr), PLANISH_STATUS_INVALID_ARGUMENT, 5,
              "4 and 5");
  CHECK(surface == sentinel<planish_surface>());
}

TEST(Symmetry, MakesASurfaceItsOwnImage) {
  arrays all = shapes::graph(31, 24, 0.2, 3);
  for (std::size_t k = 0; k < all.point_count(); ++k) {
    double *p = &all.points[3 * k];
    p[0] = 2 * all.uv[2 * k] - 1;
    p[1] = all.uv[2 * k + 1];
    p[2] = 0.3 * std::cos(2.5 * p[0]) * (1 + p[1]);
  }
  const Mesh mesh = make(all, false);
  const double plane[] = {0, 0, 0, 1, 0, 0};
  double found_plane[6] = {9, 9, 9, 9, 9, 9};
  planish_tensor_options options = tensor_options();
  options.tolerance = 3e-3;
  options.symmetry = PLANISH_SYMMETRY_ABOUT;
  options.plane = plane;
  options.out_plane = found_plane;
  const Fit found = fit(mesh.get(), options);
  CHECK(found.status == PLANISH_STATUS_OK);
  CHECK(std::memcmp(plane, found_plane, sizeof plane) == 0);
  CHECK(found.report.mirror_distance <= found.report.tolerance);
  const double uv[] = {-0.3, 0.6, 0.3, 0.6};
  double values[6];
  CHECK(planish_surface_eval(found.surface.get(), uv, 2, nullptr, values) == PLANISH_STATUS_OK);
  CHECK_NEAR(values[0], -values[3], 1e-14);
  CHECK_NEAR(values[1], values[4], 1e-14);
  CHECK_NEAR(values[2], values[5], 1e-14);

  planish_surface *surface = sentinel<planish_surface>();
  const double tilted[] = {0, 0, 0, 1, 0.2, 0};
  options.plane = tilted;
  CHECK_FAILS(planish_tensor_fit(mesh.get(), &options, &surface, nullptr), PLANISH_STATUS_INVALID_ARGUMENT, -1,
              "not symmetric");
  options.plane = nullptr;
  CHECK_FAILS(planish_tensor_fit(mesh.get(), &options, &surface, nullptr), PLANISH_STATUS_NULL_POINTER, -1, "plane");
  options.symmetry = 3;
  CHECK_FAILS(planish_tensor_fit(mesh.get(), &options, &surface, nullptr), PLANISH_STATUS_INVALID_ARGUMENT, -1,
              "symmetry is 3");
  CHECK(surface == sentinel<planish_surface>());
}

TEST(Sides, AreTakenOverFromANeighbour) {
  const std::size_t side = 40;
  std::vector<double> uv, low, high;
  for (std::size_t i = 0; i < side; ++i) {
    for (std::size_t j = 0; j < side; ++j) {
      const double u = double(i) / (side - 1), v = double(j) / (side - 1);
      uv.insert(uv.end(), {u, v});
      const auto add = [&](std::vector<double> &to, double x) {
        to.insert(to.end(), {x, v, 0.3 * std::sin(1.7 * x) * (1 + v)});
      };
      add(low, u);
      add(high, 1 + u);
    }
  }
  planish_tensor_options options = tensor_options();
  options.tolerance = 1e-4;
  options.buffer = 0;
  planish_surface *handle = nullptr;
  CHECK(planish_tensor_fit_points(uv.data(), low.data(), side * side, 3, &options, &handle, nullptr) ==
        PLANISH_STATUS_OK);
  const Surface first(handle);
  options.neighbour_u_low = first.get();
  planish_fit_report report = fresh<planish_fit_report>();
  CHECK(planish_tensor_fit_points(uv.data(), high.data(), side * side, 3, &options, &handle, &report) ==
        PLANISH_STATUS_OK);
  const Surface second(handle);
  CHECK(report.max_side_error <= 1e-12 * report.diagonal && report.max_side_angle <= 1e-10);
  const double here[] = {1, 0.37}, there[] = {0, 0.37};
  double a[9], b[9];
  CHECK(planish_surface_eval_derivatives(first.get(), here, 1, 1, nullptr, a) == PLANISH_STATUS_OK);
  CHECK(planish_surface_eval_derivatives(second.get(), there, 1, 1, nullptr, b) == PLANISH_STATUS_OK);
  for (int k = 0; k < 3; ++k) CHECK_NEAR(a[k], b[k], 1e-12);
  // the slopes across are parallel
  CHECK_NEAR(a[3] * b[4] - a[4] * b[3], 0, 1e-10);
  CHECK_NEAR(a[3] * b[5] - a[5] * b[3], 0, 1e-10);

  // a PHT-spline takes the side over too
  planish_pht_options cells;
  CHECK(planish_pht_options_init(&cells, sizeof cells) == PLANISH_STATUS_OK);
  cells.tolerance = 1e-4;
  cells.neighbour_u_low = first.get();
  CHECK(planish_pht_fit_points(uv.data(), high.data(), side * side, 3, &cells, &handle, &report) == PLANISH_STATUS_OK);
  const Surface third(handle);
  CHECK(report.max_side_error <= 1e-12 * report.diagonal && report.max_side_angle <= 1e-10);
  // and is a neighbour for another, but not for a tensor surface, whose curvature is continuous
  cells.neighbour_u_low = nullptr;
  cells.neighbour_u_high = third.get();
  CHECK(planish_pht_fit_points(uv.data(), low.data(), side * side, 3, &cells, &handle, &report) == PLANISH_STATUS_OK);
  const Surface fourth(handle);
  CHECK(report.max_side_error <= 1e-12 * report.diagonal && report.max_side_angle <= 1e-10);

  planish_surface *surface = sentinel<planish_surface>();
  options.neighbour_u_low = third.get();
  CHECK_FAILS(planish_tensor_fit_points(uv.data(), high.data(), side * side, 3, &options, &surface, nullptr),
              PLANISH_STATUS_INVALID_ARGUMENT, -1, "this smooth");
  options.neighbour_u_low = first.get();
  options.neighbour_u_high = first.get(); // it lies at the other end
  CHECK_FAILS(planish_tensor_fit_points(uv.data(), high.data(), side * side, 3, &options, &surface, nullptr),
              PLANISH_STATUS_INVALID_ARGUMENT, 1599, "the largest u");
  CHECK(surface == sentinel<planish_surface>());
}

TEST(Periods, CloseASurface) {
  const std::size_t count = 2000;
  const double tau = 8 * std::atan(1);
  std::vector<double> uv, values;
  for (std::size_t k = 0; k < count; ++k) {
    const double u = tau * std::fmod(0.754877666 * double(k), 1), v = std::fmod(0.569840291 * double(k), 1);
    uv.insert(uv.end(), {u, v});
    values.insert(values.end(), {(2 + v) * std::cos(u), (2 + v) * std::sin(u), 3 * v});
  }
  planish_tensor_options options = tensor_options();
  options.tolerance = 1e-4;
  options.period_u = tau;
  planish_surface *handle = nullptr;
  planish_fit_report report = fresh<planish_fit_report>();
  CHECK(planish_tensor_fit_points(uv.data(), values.data(), count, 3, &options, &handle, &report) == PLANISH_STATUS_OK);
  const Surface tube(handle);
  CHECK(planish_surface_is_closed(tube.get(), PLANISH_AXIS_U) == 1);
  double domain[4];
  CHECK(planish_surface_domain(tube.get(), domain) == PLANISH_STATUS_OK);
  const double begin[] = {domain[0], 0.37}, end[] = {domain[1], 0.37};
  double a[18], b[18];
  CHECK(planish_surface_eval_derivatives(tube.get(), begin, 1, 2, nullptr, a) == PLANISH_STATUS_OK);
  CHECK(planish_surface_eval_derivatives(tube.get(), end, 1, 2, nullptr, b) == PLANISH_STATUS_OK);
  for (int k = 0; k < 18; ++k) CHECK_NEAR(a[k], b[k], k < 3 ? 1e-12 * report.diagonal : 1e-8 * report.diagonal);
  planish_surface *surface = sentinel<planish_surface>();
  options.period_u = 3;
  CHECK_FAILS(planish_tensor_fit_points(uv.data(), values.data(), count, 3, &options, &surface, nullptr),
              PLANISH_STATUS_INVALID_ARGUMENT, -1, "period_u is 3");
  options.period_u = std::nan("");
  CHECK_FAILS(planish_tensor_fit_points(uv.data(), values.data(), count, 3, &options, &surface, nullptr),
              PLANISH_STATUS_INVALID_ARGUMENT, -1, "period_u");
  CHECK(surface == sentinel<planish_surface>());
}

TEST(Fairness, LowersTheEnergyWithinTheTolerance) {
  const arrays all = shapes::graph(30, 30, 0.2, 4);
  const Mesh mesh = make(all, true);
  planish_tensor_options fitting = tensor_options();
  fitting.grid_u = fitting.grid_v = 20;
  fitting.tolerance = 1e-2;
  const Fit before = fit(mesh.get(), fitting);
  planish_fair_options options = fresh<planish_fair_options>();
  CHECK(planish_fair_options_init(&options, sizeof options) == PLANISH_STATUS_OK);
  options.tolerance = 1e-2;
  options.limit = PLANISH_FAIR_LIMIT_TOLERANCE;
  for (const bool has_data : {false, true}) {
    const std::size_t count = has_data ? all.point_count() : 0;
    planish_surface *handle = nullptr;
    planish_fair_report report = fresh<planish_fair_report>();
    CHECK(planish_surface_fair(before.surface.get(), all.uv.data(), all.points.data(), count, &options, &handle, &report) ==
          PLANISH_STATUS_OK);
    const Surface after(handle);
    CHECK(report.energy_after < report.energy_before && report.energy_after >= 0);
    CHECK(report.max_deviation <= report.tolerance && report.rms_deviation <= report.max_deviation);
    CHECK(report.pass_count > 0 && report.smoothing > 0 && report.max_movement > 0);
    std::vector<double> a(all.points.size()), b(all.points.size());
    CHECK(planish_surface_eval(before.surface.get(), all.uv.data(), all.point_count(), nullptr, a.data()) ==
          PLANISH_STATUS_OK);
    CHECK(planish_surface_eval(after.get(), all.uv.data(), all.point_count(), nullptr, b.data()) == PLANISH_STATUS_OK);
    for (std::size_t k = 0; k < a.size(); k += 3) {
      const double moved = std::hypot(a[k] - b[k], a[k + 1] - b[k + 1], a[k + 2] - b[k + 2]);
      CHECK(moved <= report.max_movement * (1 + 1e-9));
    }
  }
  planish_surface *surface = sentinel<planish_surface>();
  const auto refuse = [&](planish_status status, long long index, const char *words) {
    CHECK_FAILS(planish_surface_fair(before.surface.get(), all.uv.data(), all.points.data(), all.point_count(), &options,
                                     &surface, nullptr),
                status, index, words);
    CHECK(surface == sentinel<planish_surface>());
  };
  options.tolerance = 0;
  refuse(PLANISH_STATUS_INVALID_ARGUMENT, -1, "tolerance is 0");
  options.tolerance = 1e-12;
  refuse(PLANISH_STATUS_INVALID_ARGUMENT, static_cast<long long>(before.report.worst_index), "more than the tolerance");
  options.tolerance = 1e-2;
  options.energy = 2;
  refuse(PLANISH_STATUS_INVALID_ARGUMENT, -1, "energy is 2");
  options.energy = PLANISH_FAIRNESS_CURVATURE_VARIATION;
  options.border = 3;
  refuse(PLANISH_STATUS_INVALID_ARGUMENT, -1, "border is 3");
  options.border = PLANISH_KEPT_BORDER_TANGENT;
  options.limit = 2;
  refuse(PLANISH_STATUS_INVALID_ARGUMENT, -1, "limit is 2");
  options.limit = PLANISH_FAIR_LIMIT_NOISE;
  const double outside[] = {7, 0};
  CHECK_FAILS(planish_surface_fair(before.surface.get(), outside, all.points.data(), 1, &options, &surface, nullptr),
              PLANISH_STATUS_OUTSIDE, 0, "outside");
  CHECK_FAILS(planish_surface_fair(nullptr, nullptr, nullptr, 0, nullptr, &surface, nullptr), PLANISH_STATUS_NULL_POINTER,
              -1, "surface");
  CHECK_FAILS(planish_surface_fair(before.surface.get(), nullptr, nullptr, 0, nullptr, nullptr, nullptr),
              PLANISH_STATUS_NULL_POINTER, -1, "out_surface");
}

// Everything that a fit hands out but its seconds.
static std::vector<double> all_numbers(const Fit &fit, const std::vector<double> &errors) {
  const planish_surface *surface = fit.surface.get();
  const std::size_t count = planish_surface_coefficient_count(surface);
  std::vector<double> points(3 * count);
  CHECK(planish_tensor_copy_control_points(surface, points.data(), count) == PLANISH_STATUS_OK);
  for (std::uint32_t axis : {PLANISH_AXIS_U, PLANISH_AXIS_V}) {
    std::vector<double> knots(planish_tensor_knot_count(surface, axis));
    CHECK(planish_tensor_copy_knots(surface, axis, knots.data(), knots.size()) == PLANISH_STATUS_OK);
    points.insert(points.end(), knots.begin(), knots.end());
  }
  points.insert(points.end(), errors.begin(), errors.end());
  return points;
}

TEST(Threads, DoNotChangeABit) {
  const arrays all = shapes::graph(240, 240, 0.2, 22); // 57,600 nodes: 57 pieces of 1024
  const Mesh mesh = make(all, true);
  std::vector<std::vector<double>> numbers;
  std::vector<planish_fit_report> reports;
  for (std::uint32_t threads : {1u, 2u, 5u}) {
    planish_tensor_options options = tensor_options();
    std::vector<double> errors(all.point_count());
    options.tolerance = 1e-5;
    options.out_errors = errors.data();
    options.thread_count = threads;
    Fit found = fit(mesh.get(), options);
    found.report.seconds = found.report.parameterize_seconds = 0;
    numbers.push_back(all_numbers(found, errors));
    reports.push_back(found.report);
  }
  for (std::size_t k : {1u, 2u}) {
    CHECK_EQUAL(numbers[k].size(), numbers[0].size());
    CHECK(std::memcmp(numbers[k].data(), numbers[0].data(), numbers[0].size() * sizeof(double)) == 0);
    CHECK(std::memcmp(&reports[k], &reports[0], sizeof reports[0]) == 0);
  }
}

int main() { return check::run(); }
