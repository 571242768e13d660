// Turns a coarse roof of triangles into a smooth surface, and into one that keeps the ridge as a crease.
#include <planish.hpp>

#include <cmath>
#include <cstdio>

static const std::uint32_t side = 13, ridge = side / 2;

// A roof whose halves meet at 45 degrees and wave a little, over uneven parameters.
static planish::mesh roof() {
  const double fall = std::tan(22.5 * std::acos(-1.0) / 180.0);
  std::vector<double> points, uv;
  std::vector<std::uint32_t> triangles;
  for (std::uint32_t i = 0; i < side; ++i) {
    for (std::uint32_t j = 0; j < side; ++j) {
      const bool is_inner = i > 0 && i < side - 1 && j > 0 && j < side - 1 && i != ridge;
      const double shift = is_inner ? 0.02 * std::sin(5.0 * i + 11.0 * j) : 0.0;
      const double u = 2.0 * i / (side - 1.0) - 1.0 + shift, v = 2.0 * j / (side - 1.0) - 1.0 - shift;
      uv.insert(uv.end(), {u, v});
      points.insert(points.end(), {u, v, -fall * std::fabs(u) + 0.1 * u * u * std::sin(4.0 * v)});
      if (i + 1 < side && j + 1 < side) {
        const std::uint32_t a = i * side + j, b = a + side;
        triangles.insert(triangles.end(), {a, b, a + 1, b, b + 1, a + 1});
      }
    }
  }
  planish::mesh mesh(points, triangles);
  mesh.set_parameters(uv);
  return mesh;
}

// The angle between the normals on both sides of the ridge, in degrees.
static double angle(const planish::surface &surface) {
  const auto normals = surface.normals(std::vector<double>{-1e-9, 0.1, 1e-9, 0.1});
  double cosine = 0;
  for (int k = 0; k < 3; ++k) cosine += normals[0][k] * normals[1][k];
  return std::acos(std::fmin(cosine, 1.0)) * 180.0 / std::acos(-1.0);
}

int main() try {
  planish::surface surface = planish::d1rc_new(roof());
  const double smooth = angle(surface);

  std::vector<planish::edge> crease;
  for (std::uint32_t j = 0; j + 1 < side; ++j) crease.push_back({ridge * side + j, ridge * side + j + 1});
  planish::d1rc view(surface);
  view.set_sharp_edges(crease);
  std::printf("the ridge of %zu control points: %.2f degrees smooth, %.2f sharp\n", surface.coefficient_count(), smooth,
              angle(surface));
  surface.save_file("creased.planish");
  return 0;
} catch (const planish::error &error) {
  std::fprintf(stderr, "%s: %s\n", error.status_name(), error.what());
  return 1;
}
// Output: the ridge of 169 control points: 0.00 degrees smooth, 45.00 sharp
