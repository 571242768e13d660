// Moves a surface by its modes: the shape is fitted once, each mode once over the same (u,v), and any state is their
// exact sum as one spline.
#include <planish.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

static const double pi = 3.14159265358979323846;

// A square plate of 40 by 40 nodes; its modes lift each node, a half and a whole wave along x.
struct plate {
  std::vector<planish::point3> points;
  std::vector<planish::triangle> triangles;
  std::vector<planish::point2> uv;
  std::vector<double> modes[2];
};

static plate make_plate() {
  const std::uint32_t side = 40;
  plate made;
  for (std::uint32_t i = 0; i < side; ++i) {
    for (std::uint32_t j = 0; j < side; ++j) {
      const double x = i / (side - 1.0), y = j / (side - 1.0);
      made.points.push_back({x, y, 0.1 * x * y});
      made.uv.push_back({x, y});
      for (int k = 0; k < 2; ++k) {
        made.modes[k].insert(made.modes[k].end(), {0, 0, std::sin((k + 1) * pi * x) * std::sin(pi * y)});
      }
      if (i + 1 < side && j + 1 < side) {
        const std::uint32_t a = i * side + j, b = a + side;
        made.triangles.push_back({a, b, b + 1});
        made.triangles.push_back({a, b + 1, a + 1});
      }
    }
  }
  return made;
}

int main() try {
  const plate plate = make_plate();
  planish::mesh mesh(plate.points, plate.triangles);
  mesh.set_parameters(plate.uv);
  const planish::field_fitter fitter(mesh); // one factorization for the shape and all modes

  std::vector<double> places;
  for (const planish::point3 &p : plate.points) places.insert(places.end(), p.begin(), p.end());
  const planish::surface shape = fitter.fit(places, 3).surface;
  const planish::surface first = fitter.fit(plate.modes[0], 3).surface;
  const planish::surface second = fitter.fit(plate.modes[1], 3).surface;

  double highest = 0;
  for (int step = 0; step <= 20; ++step) {
    const double phase = step * pi / 10;
    const planish::surface moved =
        planish::combine({{1.0, &shape}, {0.2 * std::cos(phase), &first}, {0.1 * std::sin(phase), &second}});
    highest = std::max(highest, moved.point(0.5, 0.5)[2]);
  }
  std::printf("21 states of %zu control points, the middle rises to %.3f\n", shape.coefficient_count(), highest);
  return 0;
} catch (const planish::error &error) {
  std::fprintf(stderr, "%s: %s\n", error.status_name(), error.what());
  return 1;
}
// Output: 21 states of 361 control points, the middle rises to 0.225
