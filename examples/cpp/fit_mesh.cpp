// Fits a smooth surface to a triangle mesh in C++, hearing of the progress: a file given, else a wavy sheet.
#include <planish.hpp>

#include <cmath>
#include <cstdio>

// A sheet of 60 by 60 nodes.
static planish::mesh make_sheet() {
  const std::uint32_t side = 60;
  std::vector<planish::point3> points;
  std::vector<planish::triangle> triangles;
  for (std::uint32_t i = 0; i < side; ++i) {
    for (std::uint32_t j = 0; j < side; ++j) {
      const double x = i / (side - 1.0), y = j / (side - 1.0);
      points.push_back({x, y, 0.1 * std::sin(6 * x) * std::cos(5 * y)});
      if (i + 1 < side && j + 1 < side) {
        const std::uint32_t a = i * side + j, b = a + side;
        triangles.push_back({a, b, b + 1});
        triangles.push_back({a, b + 1, a + 1});
      }
    }
  }
  return {points, triangles};
}

int main(int argc, char **argv) try {
  const planish::mesh mesh = argc > 1 ? planish::mesh::read(argv[1]) : make_sheet();
  auto options = planish::defaults<planish_tensor_options>();
  options.tolerance = 1e-4; // of the bounding box's diagonal

  double done = 0;
  const auto [surface, report, status] = planish::tensor_fit(mesh, options, [&](double fraction, double) {
    done = fraction;
    return true; // go on
  });
  const auto box = surface.data_box();
  const planish::point3 middle = surface.point(0.5 * (box[0] + box[1]), 0.5 * (box[2] + box[3]));
  std::printf("%s the tolerance, max error %.1e, middle (%.2f %.2f %.2f)\n",
              status == PLANISH_STATUS_OK ? "within" : "beyond", report.max_error, middle[0], middle[1], middle[2]);
  return done > 0 ? 0 : 1;
} catch (const planish::error &error) {
  std::fprintf(stderr, "%s: %s\n", error.status_name(), error.what());
  return 1;
}
// Output: within the tolerance, max error 5.8e-05, middle (0.50 0.50 -0.01)
