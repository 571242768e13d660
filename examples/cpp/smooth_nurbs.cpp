// Refits a wrinkled tensor surface smooth: a PHT-spline within a tolerance above the wrinkles, finer only at its ridge.
#include <planish.hpp>

#include <cmath>
#include <cstdio>

// A cylinder of 60 by 60 control points with a ridge, every point off by up to 0.004.
static planish::surface wrinkled() {
  const std::size_t side = 60, degree = 3;
  std::vector<double> knots(degree, 0.0), points;
  for (std::size_t k = 0; k + degree <= side; ++k) knots.push_back(k / double(side - degree));
  knots.insert(knots.end(), degree, 1.0);
  for (std::size_t i = 0; i < side; ++i) {
    for (std::size_t j = 0; j < side; ++j) {
      const double u = i / (side - 1.0), v = j / (side - 1.0);
      const double ridge = 0.08 * std::exp(-std::pow((u + 0.4 * v - 0.7) / 0.05, 2));
      const double wrinkle = 0.004 * std::sin(12.9 * double(i * i % 17) + 7.3 * double(j * j % 13));
      const double r = 1.0 + ridge + wrinkle, angle = 1.5 * v;
      points.insert(points.end(), {2.0 * u, r * std::sin(angle), r * std::cos(angle)});
    }
  }
  return planish::tensor_new(3, degree, degree, knots, knots, points);
}

int main() try {
  const planish::surface before = wrinkled();
  std::vector<planish::point2> uv;
  for (int i = 0; i <= 200; ++i) {
    for (int j = 0; j <= 200; ++j) uv.push_back({i / 200.0, j / 200.0});
  }
  auto options = planish::defaults<planish_pht_options>();
  options.tolerance = 0.006;
  options.tolerance_scale = PLANISH_TOLERANCE_SCALE_ABSOLUTE;
  auto [after, report, status] = planish::pht_fit_points(uv, before.eval(uv), 3, options);

  // how often the surface bends to and fro along its middle line
  const auto turns = [](const planish::surface &surface) {
    int count = 0;
    double last = 0;
    for (int i = 1; i < 1000; ++i) {
      const double curvature = surface.eval_derivatives(planish::point2{i / 1000.0, 0.5}, 2)[11];
      count += curvature * last < 0;
      last = curvature;
    }
    return count;
  };
  std::printf("%zu control points with %d turns became %zu with %d, within %.4f\n", before.coefficient_count(),
              turns(before), after.coefficient_count(), turns(after), report.max_error);
  return status == PLANISH_STATUS_OK ? 0 : 1;
} catch (const planish::error &error) {
  std::fprintf(stderr, "%s: %s\n", error.status_name(), error.what());
  return 1;
}
// Output: 3600 control points with 84 turns became 400 with 4, within 0.0059
