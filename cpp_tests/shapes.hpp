// Seeded meshes as plain arrays; the same seed gives the same bits everywhere.
#ifndef PLANISH_SHAPES_HPP
#define PLANISH_SHAPES_HPP

#include <cmath>
#include <cstdint>
#include <vector>

namespace shapes {

// SplitMix64 (G. Steele, D. Lea, C. Flood, "Fast splittable pseudorandom number generators", 2014).
class random {
 public:
  explicit random(std::uint64_t seed) : state_(seed) {}

  // The next number in [0, 1).
  double unit() {
    state_ += 0x9e3779b97f4a7c15u;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return static_cast<double>((z ^ (z >> 31)) >> 11) / 9007199254740992.0;
  }

 private:
  std::uint64_t state_;
};

struct arrays {
  std::vector<double> points;           // x, y, z
  std::vector<double> uv;               // u, v
  std::vector<std::uint32_t> triangles; // counted from 0, counter-clockwise in (u,v)

  std::size_t point_count() const { return uv.size() / 2; }
  std::size_t triangle_count() const { return triangles.size() / 3; }
};

// Height of the test surface over the unit square.
inline double wave(double u, double v) { return 0.2 * std::sin(3.0 * u + 0.5) * std::cos(2.0 * v) + 0.1 * u * v; }

// A graph over the unit square: count_u by count_v nodes, inner ones moved by up to `jitter` cells. With a hole,
// the cells in the middle ninth are left out.
inline arrays graph(std::size_t count_u, std::size_t count_v, double jitter, std::uint64_t seed,
                    bool has_hole = false, double (*height)(double, double) = wave) {
  random next(seed);
  const double cells_u = static_cast<double>(count_u - 1), cells_v = static_cast<double>(count_v - 1);
  arrays all;
  for (std::size_t i = 0; i < count_u; ++i) {
    for (std::size_t j = 0; j < count_v; ++j) {
      const double du = jitter * (2.0 * next.unit() - 1.0), dv = jitter * (2.0 * next.unit() - 1.0);
      const bool inner = i > 0 && i + 1 < count_u && j > 0 && j + 1 < count_v;
      all.uv.push_back((static_cast<double>(i) + (inner ? du : 0.0)) / cells_u);
      all.uv.push_back((static_cast<double>(j) + (inner ? dv : 0.0)) / cells_v);
    }
  }
  const auto in_hole = [](std::size_t cell, std::size_t cells) { return 3 * cell >= cells && 3 * cell < 2 * cells; };
  for (std::size_t i = 0; i + 1 < count_u; ++i) {
    for (std::size_t j = 0; j + 1 < count_v; ++j) {
      if (has_hole && in_hole(i, count_u - 1) && in_hole(j, count_v - 1)) continue;
      const auto node = [&](std::size_t a, std::size_t b) {
        return static_cast<std::uint32_t>((i + a) * count_v + j + b);
      };
      const std::uint32_t corners[4] = {node(0, 0), node(1, 0), node(1, 1), node(0, 1)};
      const int first = next.unit() < 0.5 ? 0 : 1; // which diagonal
      for (int k : {1, 2}) {
        all.triangles.push_back(corners[first]);
        all.triangles.push_back(corners[(first + k) % 4]);
        all.triangles.push_back(corners[(first + k + 1) % 4]);
      }
    }
  }
  // nodes inside the hole have no triangles: leave them out
  std::vector<std::uint32_t> number(count_u * count_v, UINT32_MAX);
  std::vector<double> uv;
  for (std::uint32_t &node : all.triangles) {
    if (number[node] == UINT32_MAX) {
      number[node] = static_cast<std::uint32_t>(uv.size() / 2);
      uv.push_back(all.uv[2 * node]);
      uv.push_back(all.uv[2 * node + 1]);
    }
    node = number[node];
  }
  all.uv = uv;
  for (std::size_t n = 0; n < all.point_count(); ++n) {
    const double u = uv[2 * n], v = uv[2 * n + 1];
    all.points.insert(all.points.end(), {u, v, height(u, v)});
  }
  return all;
}

} // namespace shapes

#endif
