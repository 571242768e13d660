// The rows of samples::rows::head(), computed anew: sections of a head with nose, ears, eyes, mouth, chin and some
// hair.
#ifndef PLANISH_PEERS_HEAD_HPP
#define PLANISH_PEERS_HEAD_HPP

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace head {

constexpr std::size_t row_count = 100;
constexpr std::size_t point_count = 18368;
// Steps of the polyline that stands for a section before it is sampled.
constexpr std::size_t steps = 6000;
constexpr double pi = 3.14159265358979323846;

struct Feature {
  double angle, height, depth, width, reach;
};
constexpr Feature features[] = {
    {0, 0.48, 0.16, 0.10, 0.05},      {pi / 2, 0.5, 0.10, 0.10, 0.06}, {-pi / 2, 0.5, 0.10, 0.10, 0.06},
    {0.33, 0.6, -0.04, 0.10, 0.03},   {-0.33, 0.6, -0.04, 0.10, 0.03}, {0, 0.33, 0.05, 0.25, 0.025},
    {0, 0.25, 0.07, 0.30, 0.05},
};

inline double square(double x) { return x * x; }

// The same angle, from -pi to pi.
inline double turned(double angle) {
  const double rest = std::fmod(angle + pi, 2 * pi);
  return (rest < 0 ? rest + 2 * pi : rest) - pi;
}

inline double girth(double height) { return std::pow(std::sin(pi * (0.08 + 0.86 * height)), 0.8); }

inline double radius(double angle, double height) {
  const double seen = turned(angle);
  double r = (0.32 + 0.55 * girth(height)) * (1 + 0.12 * square(std::cos(seen)));
  for (const Feature &f : features) {
    r += f.depth * std::exp(-square(turned(seen - f.angle) / f.width) - square((height - f.height) / f.reach));
  }
  const double hair = std::sin(26 * seen + 9 * height) * std::exp(-square(std::abs(seen) - pi));
  return r + 0.010 * hair * std::exp(-square((height - 0.7) / 0.25));
}

struct Rows {
  std::vector<double> points; // x, y, z, row after row; a row's last point is its first one again
  std::vector<std::size_t> counts;

  // `count` rows: row `first` and each `step`th after it.
  Rows chosen(std::size_t first, std::size_t step, std::size_t count) const {
    Rows part;
    std::size_t begin = 0;
    for (std::size_t row = 0; row < counts.size() && part.counts.size() < count; ++row) {
      if (row >= first && (row - first) % step == 0) {
        part.counts.push_back(counts[row]);
        part.points.insert(part.points.end(), &points[begin], &points[begin] + 3 * counts[row]);
      }
      begin += 3 * counts[row];
    }
    return part;
  }

  double diagonal() const {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      double least = points[k], largest = points[k];
      for (std::size_t i = k; i < points.size(); i += 3) {
        least = std::min(least, points[i]);
        largest = std::max(largest, points[i]);
      }
      sum += square(largest - least);
    }
    return std::sqrt(sum);
  }
};

inline double row_height(std::size_t row) { return (static_cast<double>(row) + 0.5) / row_count; }

// Points of each row: about as many as its girth asks for.
inline std::vector<std::size_t> row_counts() {
  double sum = 0;
  std::vector<double> weights;
  for (std::size_t row = 0; row < row_count; ++row) {
    weights.push_back(0.45 + 0.55 * girth(row_height(row)));
    sum += weights.back();
  }
  std::vector<std::size_t> counts;
  std::size_t left = point_count;
  for (double weight : weights) {
    counts.push_back(static_cast<std::size_t>(weight / sum * point_count));
    left -= counts.back();
  }
  counts[row_count / 2] += left;
  return counts;
}

// `count` points at equal distances along the section at a height.
inline void append_row(double height, std::size_t count, std::vector<double> &points) {
  std::vector<double> x, y, along;
  for (std::size_t k = 0; k <= steps; ++k) {
    const double angle = 2 * pi * (static_cast<double>(k) / steps); // the seam is at the back
    const double r = radius(angle, height);
    x.push_back(r * std::cos(angle));
    y.push_back(r * std::sin(angle));
    along.push_back(k == 0 ? 0 : along[k - 1] + std::sqrt(square(x[k] - x[k - 1]) + square(y[k] - y[k - 1])));
  }
  for (std::size_t i = 0; i < count; ++i) {
    const double s = static_cast<double>(i) / static_cast<double>(count - 1) * along.back();
    const auto next = std::upper_bound(along.begin() + 1, along.end() - 1, s);
    const auto k = static_cast<std::size_t>(next - along.begin());
    const double share = (s - along[k - 1]) / (along[k] - along[k - 1]);
    points.insert(points.end(),
                  {x[k - 1] + share * (x[k] - x[k - 1]), y[k - 1] + share * (y[k] - y[k - 1]), 2.4 * height});
  }
}

inline Rows rows() {
  Rows set{{}, row_counts()};
  for (std::size_t row = 0; row < row_count; ++row) append_row(row_height(row), set.counts[row], set.points);
  // what the set must begin with, whatever the compiler does to the last digits
  const double begin[] = {0.56921024442661072, 0, 0.012};
  bool is_known = set.points.size() == 3 * point_count && set.counts[0] == 134;
  for (std::size_t k = 0; k < 3; ++k) is_known = is_known && std::abs(set.points[k] - begin[k]) < 1e-15;
  if (!is_known) throw std::runtime_error("these are not the rows of the head");
  return set;
}

} // namespace head

#endif
