// planish_curve from outside: what natural splines contain is reproduced, and the rules of surfaces hold.
#include "check.hpp"
#include "handles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

static const double nan_ = std::numeric_limits<double>::quiet_NaN();

// 21 data on the line (2 u, 1 - u), u from 0 to 1.
static Curve line(planish_fit_report *report = nullptr) {
  std::vector<double> u, values;
  for (int i = 0; i <= 20; ++i) {
    u.push_back(i / 20.0);
    values.insert(values.end(), {2 * u.back(), 1 - u.back()});
  }
  planish_curve *curve = nullptr;
  CHECK(planish_curve_fit(u.data(), values.data(), u.size(), 2, nullptr, &curve, report) == PLANISH_STATUS_OK);
  return Curve(curve);
}

TEST(Curve, ReproducesALine) {
  auto report = fresh<planish_fit_report>();
  const Curve curve = line(&report);
  CHECK(report.max_error < 1e-13);
  CHECK_EQUAL(report.grid_v, 1u);
  CHECK_EQUAL(planish_curve_dim(curve.get()), 2u);
  CHECK_EQUAL(planish_curve_degree(curve.get()), 3u);
  const double u[3] = {0.5, nan_, 0.25}; // every second one
  double out[11];
  std::fill_n(out, 11, -7.0);
  planish_eval_options options = eval_options();
  options.uv_stride = 2;
  options.out_stride = 7;
  CHECK(planish_curve_eval(curve.get(), u, 2, 1, &options, out) == PLANISH_STATUS_OK);
  const double expected[11] = {1, 0.5, 2, -1, -7, -7, -7, 0.5, 0.75, 2, -1};
  for (int k = 0; k < 11; ++k) CHECK_NEAR(out[k], expected[k], 1e-12);
}

TEST(Curve, KeepsTheTolerance) {
  std::vector<double> u, values;
  for (int i = 0; i < 500; ++i) {
    u.push_back(0.001 * ((i * 37) % 500)); // in any order
    values.push_back(std::sin(40 * u.back()));
  }
  for (double tolerance : {1e-2, 1e-4, 1e-6}) {
    planish_curve_options options = curve_options();
    options.tolerance = tolerance;
    std::vector<double> errors(u.size());
    options.out_errors = errors.data();
    auto report = fresh<planish_fit_report>();
    planish_curve *raw = nullptr;
    CHECK(planish_curve_fit(u.data(), values.data(), u.size(), 1, &options, &raw, &report) == PLANISH_STATUS_OK);
    const Curve curve(raw);
    CHECK(report.max_error <= report.tolerance);
    CHECK_EQUAL(*std::max_element(errors.begin(), errors.end()), report.max_error);
    std::vector<double> found(u.size());
    CHECK(planish_curve_eval(curve.get(), u.data(), u.size(), 0, nullptr, found.data()) == PLANISH_STATUS_OK);
    for (std::size_t i = 0; i < u.size(); ++i) CHECK_NEAR(std::fabs(found[i] - values[i]), errors[i], 1e-15);
  }
}

TEST(Curve, PartsComeOut) {
  const Curve curve = line();
  const std::size_t knot_count = planish_curve_knot_count(curve.get());
  const std::size_t point_count = planish_curve_control_point_count(curve.get());
  CHECK_EQUAL(knot_count, point_count + 4);
  std::vector<double> knots(knot_count), points(2 * point_count);
  double domain[2];
  CHECK(planish_curve_copy_knots(curve.get(), knots.data(), knot_count) == PLANISH_STATUS_OK);
  CHECK(planish_curve_copy_control_points(curve.get(), points.data(), point_count) == PLANISH_STATUS_OK);
  CHECK(planish_curve_domain(curve.get(), domain) == PLANISH_STATUS_OK);
  CHECK(knots[3] == domain[0] && knots[knot_count - 4] == domain[1]);
  CHECK_NEAR(points[0], 2 * domain[0], 1e-13);

  planish_curve *raw = nullptr;
  CHECK(planish_curve_clone(curve.get(), &raw) == PLANISH_STATUS_OK);
  const Curve copy(raw);
  CHECK_EQUAL(planish_curve_knot_count(copy.get()), knot_count);
}

TEST(CurveEval, FollowsTheRuleOutside) {
  const Curve curve = line();
  const double far[2] = {0.5, 3}, bad[2] = {nan_, 0.5};
  double out[4] = {-7, -7, -7, -7};
  std::uint8_t flags[2] = {9, 9};
  const check::untouched out_before(out), flags_before(flags);
  planish_eval_options options = eval_options();
  options.out_flags = flags;
  CHECK_FAILS(planish_curve_eval(curve.get(), far, 2, 0, &options, out), PLANISH_STATUS_OUTSIDE, 1, "point 1 at 3");
  CHECK_FAILS(planish_curve_eval(curve.get(), bad, 2, 0, &options, out), PLANISH_STATUS_NOT_FINITE, 0, "point 0");
  CHECK(out_before.holds() && flags_before.holds());
  options.outside = PLANISH_OUTSIDE_FLAG;
  CHECK(planish_curve_eval(curve.get(), far, 2, 0, &options, out) == PLANISH_STATUS_POINTS_OUTSIDE);
  CHECK(std::isnan(out[2]) && std::isnan(out[3]) && flags[0] == 0);
  CHECK_EQUAL(flags[1], PLANISH_FLAG_OUTSIDE_DOMAIN);
  options.outside = PLANISH_OUTSIDE_EXTRAPOLATE;
  CHECK(planish_curve_eval(curve.get(), far, 2, 0, &options, out) == PLANISH_STATUS_OK);
  CHECK_NEAR(out[2], 6.0, 1e-10);
}

TEST(Curve, RefusesByName) {
  const double u[3] = {0, 0.5, 1}, values[3] = {0, 1, 4}, bad[3] = {0, nan_, 1}, same[3] = {2, 2, 2};
  planish_curve *curve = sentinel<planish_curve>();
  auto report = fresh<planish_fit_report>();
  const check::untouched before(report);
  const auto fit = [&](const double *u, const double *values, std::size_t count, std::size_t dim,
                       const planish_curve_options *options = nullptr) {
    return planish_curve_fit(u, values, count, dim, options, &curve, &report);
  };
  const auto invalid = PLANISH_STATUS_INVALID_ARGUMENT, null = PLANISH_STATUS_NULL_POINTER;
  CHECK_FAILS(fit(nullptr, values, 3, 1), null, -1, "u is NULL");
  CHECK_FAILS(fit(u, nullptr, 3, 1), null, -1, "values is NULL");
  CHECK_FAILS(planish_curve_fit(u, values, 3, 1, nullptr, nullptr, &report), null, -1, "out_curve is NULL");
  CHECK_FAILS(fit(bad, values, 3, 1), PLANISH_STATUS_NOT_FINITE, 1, "parameters of datum 1");
  CHECK_FAILS(fit(u, bad, 3, 1), PLANISH_STATUS_NOT_FINITE, 1, "values of datum 1");
  CHECK_FAILS(fit(same, values, 3, 1), PLANISH_STATUS_DEGENERATE, -1, "u = 2");
  CHECK_FAILS(fit(nullptr, nullptr, 0, 1), invalid, -1, "0 data are too few");
  CHECK_FAILS(fit(u, values, 3, 0), invalid, -1, "dim is 0");
  CHECK_FAILS(fit(u, values, 3, SIZE_MAX / 2), PLANISH_STATUS_TOO_LARGE, -1, "memory");
  planish_curve_options options = curve_options();
  options.grid = 1;
  CHECK_FAILS(fit(u, values, 3, 1, &options), invalid, -1, "grid is 1");
  CHECK(curve == sentinel<planish_curve>());
  CHECK(before.holds());
}

TEST(CurveQueries, RefuseNullAndShortBuffers) {
  const Curve curve = line();
  CHECK_EQUAL(planish_curve_dim(nullptr), 0u);
  CHECK_EQUAL(planish_curve_degree(nullptr), 0u);
  CHECK_EQUAL(planish_curve_knot_count(nullptr), 0u);
  CHECK_EQUAL(planish_curve_control_point_count(nullptr), 0u);
  planish_curve_free(nullptr);
  std::vector<double> out(64, -7.0);
  const check::untouched before(out);
  const double u[1] = {0.5};
  const auto invalid = PLANISH_STATUS_INVALID_ARGUMENT, null = PLANISH_STATUS_NULL_POINTER;
  const auto small = PLANISH_STATUS_BUFFER_TOO_SMALL;
  CHECK_FAILS(planish_curve_eval(nullptr, u, 1, 0, nullptr, out.data()), null, -1, "curve is NULL");
  CHECK_FAILS(planish_curve_eval(curve.get(), nullptr, 1, 0, nullptr, out.data()), null, -1, "u is NULL");
  CHECK_FAILS(planish_curve_eval(curve.get(), u, 1, 0, nullptr, nullptr), null, -1, "out is NULL");
  CHECK_FAILS(planish_curve_eval(curve.get(), u, 1, 4, nullptr, out.data()), invalid, -1, "max_derivative is 4");
  CHECK(planish_curve_eval(curve.get(), nullptr, 0, 3, nullptr, nullptr) == PLANISH_STATUS_OK);
  planish_eval_options options = eval_options();
  options.out_stride = 1;
  CHECK_FAILS(planish_curve_eval(curve.get(), u, 1, 0, &options, out.data()), invalid, -1, "out_stride is 1");
  options = eval_options();
  options.outside = 3;
  CHECK_FAILS(planish_curve_eval(curve.get(), u, 1, 0, &options, out.data()), invalid, -1, "outside is 3");
  CHECK_FAILS(planish_curve_domain(nullptr, out.data()), null, -1, "curve is NULL");
  CHECK_FAILS(planish_curve_domain(curve.get(), nullptr), null, -1, "out_interval is NULL");
  CHECK_FAILS(planish_curve_copy_knots(nullptr, out.data(), 64), null, -1, "curve is NULL");
  CHECK_FAILS(planish_curve_copy_knots(curve.get(), nullptr, 64), null, -1, "out_knots is NULL");
  CHECK_FAILS(planish_curve_copy_knots(curve.get(), out.data(), 0), small, -1, "room for 0");
  CHECK_FAILS(planish_curve_copy_control_points(nullptr, out.data(), 32), null, -1, "curve is NULL");
  CHECK_FAILS(planish_curve_copy_control_points(curve.get(), nullptr, 32), null, -1, "out_control_points is NULL");
  CHECK_FAILS(planish_curve_copy_control_points(curve.get(), out.data(), 0), small, -1, "room for 0");
  CHECK(before.holds());
  planish_curve *copy = sentinel<planish_curve>();
  CHECK_FAILS(planish_curve_clone(nullptr, &copy), null, -1, "curve is NULL");
  CHECK_FAILS(planish_curve_clone(curve.get(), nullptr), null, -1, "out_curve is NULL");
  CHECK(copy == sentinel<planish_curve>());
}

int main() { return check::run(); }
