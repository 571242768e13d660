// A fit of a bicubic LR B-spline surface by GoTools. Refinement is that of its own program for clouds of points,
// with least squares to the end: with local sums from the fifth round, as that program has them, places not given were
// twice as far away. Distances are taken at the given (u,v).
#include "cells.hpp"

#include <GoTools/lrsplines2D/LRSplineSurface.h>
#include <GoTools/lrsplines2D/LRSurfApprox.h>

int main(int count, char **arguments) {
  const cells::Data data = cells::given(count, arguments);
  std::vector<double> points; // it orders them anew
  for (const cells::Row &row : data.rows) points.insert(points.end(), row.begin(), row.end());

  constexpr int coefficients = 14, dim = 3, order = cells::degree + 1;
  const double start = race::cpu_seconds();
  Go::LRSurfApprox approx(coefficients, order, coefficients, order, points, dim, data.tolerance, false, 0.0, false);
  approx.setSmoothingWeight(0); // with a little, distances in space stay large
  approx.setSmoothBoundary(true);
  approx.setSwitchToMBA(cells::rounds);
  approx.setRefinementStrategy(1, 1, 2, -100.0, 0, -1); // full spans, one direction after the other
  double max, mean, mean_outside;
  int outside;
  const auto surface = approx.getApproxSurf(max, mean, mean_outside, outside, cells::rounds);
  const double seconds = race::cpu_seconds() - start;

  const auto eval = [&](double u, double v) {
    Go::Point point;
    surface->point(point, u, v);
    return std::array{point[0], point[1], point[2]};
  };
  cells::print(data, surface->numBasisFunctions(), surface->numElements(), seconds, eval);
}
