// A fit of a bicubic THB-spline surface by G+Smo: cells with points beyond the tolerance are split, as its own example
// does, with that example's first grid, extension and smoothing.
#include "cells.hpp"

#include <gsCore/gsLinearAlgebra.h>

#include <gsHSplines/gsHFitting.h>
#include <gsHSplines/gsTHBSpline.h>
#include <gsHSplines/gsTHBSplineBasis.h>

int main(int count, char **arguments) {
  using namespace gismo;
  const cells::Data data = cells::given(count, arguments);
  const auto columns = static_cast<index_t>(data.rows.size());
  gsMatrix<> uv(2, columns), xyz(3, columns);
  for (index_t k = 0; k < columns; ++k) {
    const auto &[u, v, x, y, z] = data.rows[static_cast<std::size_t>(k)];
    uv.col(k) << u, v;
    xyz.col(k) << x, y, z;
  }

  const double start = race::cpu_seconds();
  gsKnotVector<> u_knots(uv.row(0).minCoeff(), uv.row(0).maxCoeff(), 7, cells::degree + 1);
  gsKnotVector<> v_knots(uv.row(1).minCoeff(), uv.row(1).maxCoeff(), 7, cells::degree + 1);
  gsTHBSplineBasis<2> basis(gsTensorBSplineBasis<2>(u_knots, v_knots));
  gsHFitting<2, real_t> fit(uv, xyz, basis, 0, {2, 2}, 1e-7);
  fit.iterativeRefine(cells::rounds, data.tolerance, data.tolerance);
  const double seconds = race::cpu_seconds() - start;

  const auto &box = basis.support();
  const auto eval = [&](double u, double v) {
    gsVector<> place(2);
    place << std::clamp(u, box(0, 0), box(0, 1)), std::clamp(v, box(1, 0), box(1, 1));
    const gsMatrix<> point = fit.result()->eval(place);
    return std::array{point(0), point(1), point(2)};
  };
  cells::print(data, basis.size(), basis.numElements(), seconds, eval);
}
