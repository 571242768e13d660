// Seeded meshes as plain arrays; the same seed gives the same bits everywhere.
#ifndef PLANISH_SHAPES_HPP
#define PLANISH_SHAPES_HPP

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
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

// The unit sphere: n by n cells on each face of the cube around it, evenly spread; (u,v) are zeros.
inline arrays ball(std::uint32_t n) {
  arrays all;
  std::map<std::array<int, 3>, std::uint32_t> numbers;
  const auto node = [&](int face, std::uint32_t i, std::uint32_t j) {
    const int axis = face / 2, sign = face % 2 == 0 ? -1 : 1, size = static_cast<int>(n);
    std::array<int, 3> at{};
    at[axis] = sign * size;
    // counter-clockwise as seen from outside
    at[(axis + 1) % 3] = sign * (2 * static_cast<int>(i) - size);
    at[(axis + 2) % 3] = 2 * static_cast<int>(j) - size;
    const auto known = numbers.emplace(at, static_cast<std::uint32_t>(all.point_count()));
    if (known.second) {
      double point[3], length = 0;
      for (int c = 0; c < 3; ++c) {
        point[c] = std::tan(std::atan(1.0) * at[c] / size);
        length += point[c] * point[c];
      }
      for (const double x : point) all.points.push_back(x / std::sqrt(length));
      all.uv.insert(all.uv.end(), {0, 0});
    }
    return known.first->second;
  };
  for (int face = 0; face < 6; ++face) {
    for (std::uint32_t i = 0; i < n; ++i) {
      for (std::uint32_t j = 0; j < n; ++j) {
        const std::uint32_t a = node(face, i, j), b = node(face, i + 1, j), c = node(face, i + 1, j + 1),
                            d = node(face, i, j + 1);
        all.triangles.insert(all.triangles.end(), {a, b, c, a, c, d});
      }
    }
  }
  return all;
}

} // namespace shapes

#endif
