// Single points are obeyed: one is met exactly, some more closely than the rest, and gross errors are found and left out.
#include <planish.hpp>

#include <cmath>
#include <cstdio>

int main() try {
  // a roof with a rounded ridge, measured at 2,500 places; about every hundredth measurement is wrong
  std::vector<planish::point2> uv;
  std::vector<double> heights, tolerances;
  std::size_t wrong = 0;
  for (int i = 0; i < 50; ++i) {
    for (int j = 0; j < 50; ++j) {
      const double u = i / 49.0, v = j / 49.0, across = u + 0.3 * v - 0.65;
      const bool is_wrong = (50 * i + j) % 101 == 37;
      wrong += is_wrong;
      uv.push_back({u, v});
      heights.push_back(0.4 * v - std::sqrt(across * across + 1e-2) + (is_wrong ? 0.2 : 0.0));
      tolerances.push_back(v < 0.2 ? 5e-4 : 2e-3); // one end has to fit to another part
    }
  }
  const std::vector<std::uint32_t> fixed = {0, 49, 1224}; // two corners and a place on the ridge
  std::vector<std::uint8_t> left_out(uv.size());
  auto options = planish::defaults<planish_tensor_options>();
  options.tolerance = 2e-3;
  options.tolerance_scale = PLANISH_TOLERANCE_SCALE_ABSOLUTE;
  options.tolerances = tolerances.data();
  options.fixed = fixed.data();
  options.fixed_count = fixed.size();
  options.outlier_share = 0.02;
  options.out_left_out = left_out.data();
  const auto [surface, report, status] = planish::tensor_fit_points(uv, heights, 1, options);
  std::printf("fixed points met to %.0e, all others within %.2f of their tolerances; %zu of %zu wrong ones left out\n",
              report.max_fixed_error, report.max_tolerance_share, report.left_out_count, wrong);
  return status == PLANISH_STATUS_OK ? 0 : 1;
} catch (const planish::error &error) {
  std::fprintf(stderr, "%s: %s\n", error.status_name(), error.what());
  return 1;
}
// Output: fixed points met to 1e-16, all others within 0.37 of their tolerances; 25 of 25 wrong ones left out
