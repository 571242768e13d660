// A fit with local cells to points at given (u,v), as a program: reads them, times the fit, and prints its line.
#ifndef PLANISH_PEERS_CELLS_HPP
#define PLANISH_PEERS_CELLS_HPP

#include "race.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace cells {

// u, v, x, y, z
using Row = std::array<double, 5>;

constexpr int degree = 3;
// Rounds of refinement, at most.
constexpr int rounds = 30;

struct Data {
  std::vector<Row> rows, held_out;
  double tolerance;
};

inline std::vector<Row> read(const char *path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  std::vector<Row> rows(static_cast<std::size_t>(file.tellg()) / sizeof(Row));
  file.seekg(0);
  if (!file.read(reinterpret_cast<char *>(rows.data()), static_cast<std::streamsize>(rows.size() * sizeof(Row))))
    throw std::runtime_error(std::string("cannot read ") + path);
  return rows;
}

// TOLERANCE POINTS HELD_OUT: the tolerance in model units, and files of little-endian doubles.
inline Data given(int count, char **arguments) {
  if (count != 4) throw std::runtime_error("usage: TOLERANCE POINTS HELD_OUT");
  return {read(arguments[2]), read(arguments[3]), std::strtod(arguments[1], nullptr)};
}

// The largest distance of a surface at given (u,v), over the tolerance.
template <class Eval> double largest(const std::vector<Row> &rows, double tolerance, Eval eval) {
  double sq = 0;
  for (const auto &[u, v, x, y, z] : rows) {
    const std::array<double, 3> point = eval(u, v);
    sq = std::max(sq, std::pow(point[0] - x, 2) + std::pow(point[1] - y, 2) + std::pow(point[2] - z, 2));
  }
  return std::sqrt(sq) / tolerance;
}

// Prints coefficients, cells, both errors as shares of the tolerance, processor seconds, and whether it is met.
template <class Eval>
void print(const Data &data, std::size_t coefficients, std::size_t cell_count, double seconds, Eval eval) {
  const double max = largest(data.rows, data.tolerance, eval);
  std::printf("%zu\t%zu\t%.2f\t%.2f\t%.2g\t%s\n", coefficients, cell_count, max,
              largest(data.held_out, data.tolerance, eval), seconds, max <= 1 ? "tolerance met" : "stagnated");
}

} // namespace cells

#endif
