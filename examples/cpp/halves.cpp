// Two halves of a shell are fitted one after the other: the second takes over the side of the first with its tangent planes.
#include <planish.hpp>

#include <cmath>
#include <cstdio>

static std::vector<double> half(double from, const std::vector<planish::point2> &uv) {
  std::vector<double> values;
  for (const auto &[u, v] : uv) {
    const double x = from + u;
    values.insert(values.end(), {x, v, 0.3 * std::sin(1.7 * x) * (1 + v)});
  }
  return values;
}

int main() try {
  std::vector<planish::point2> uv;
  for (int i = 0; i < 1600; ++i) uv.push_back({i / 40 / 39.0, i % 40 / 39.0});
  auto options = planish::defaults<planish_tensor_options>();
  options.tolerance = 1e-4;
  options.buffer = 0; // the side is where the data end
  const planish::fitted first = planish::tensor_fit_points(uv, half(0, uv), 3, options);
  options.neighbour_u_low = first.surface.get();
  const planish::fitted second = planish::tensor_fit_points(uv, half(1, uv), 3, options);
  std::printf("the halves meet to %.0e, their planes to %.0e\n", second.report.max_side_error, second.report.max_side_angle);
  return second.status == PLANISH_STATUS_OK ? 0 : 1;
} catch (const planish::error &error) {
  std::fprintf(stderr, "%s: %s\n", error.status_name(), error.what());
  return 1;
}
// Output: the halves meet to 4e-16, their planes to 7e-15
