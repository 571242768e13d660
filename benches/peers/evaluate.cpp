// Evaluation of bicubic surfaces on one thread beside OpenCASCADE and SISL.
//
// The nets and points are those of benches/evaluate.rs: control points are random, knots uniform or with steps
// between 0.1 and 1.1. Every contender is in its fastest form and writes the same numbers to the same places;
// they must agree to 1e-12 before anything is timed.
#include "race.hpp"

#include <planish.hpp>
#include <sisl.h>

#include <GeomAdaptor_Surface.hxx>
#include <Geom_BSplineSurface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>

#include <cstdlib>
#include <memory>
#include <random>
#include <stdexcept>

namespace {

constexpr int degree = 3;
constexpr std::size_t side = 1000;
constexpr std::size_t point_count = side * side;
// Relative to the largest number of the result. Round-off of a parameter as large as the number of spans, 1000,
// moves a point by about 1e-13.
constexpr double agreement = 1e-12;

struct Net {
  std::array<int, 2> counts;
  std::array<std::vector<double>, 2> knots;
  std::vector<double> points; // v runs fastest

  Net(std::array<int, 2> counts, bool is_uniform) : counts(counts) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> unit(0, 1), coordinate(-1, 1);
    for (std::size_t axis = 0; axis < 2; ++axis) {
      double t = 0;
      for (int k = 0; k < counts[axis] - degree + 1; ++k) {
        const bool is_end = k == 0 || k == counts[axis] - degree;
        knots[axis].insert(knots[axis].end(), is_end ? degree + 1 : 1, t);
        t += is_uniform ? 1.0 : 0.1 + unit(random);
      }
    }
    points.resize(3 * static_cast<std::size_t>(counts[0] * counts[1]));
    for (double &number : points) number = coordinate(random);
  }

  double at(std::size_t axis, double share) const { return share * knots[axis].back(); }

  const double *point(int i, int j) const { return &points[3 * static_cast<std::size_t>(i * counts[1] + j)]; }
};

struct FreeSisl {
  void operator()(SISLSurf *surface) const { freeSurf(surface); }
};
using Sisl = std::unique_ptr<SISLSurf, FreeSisl>;

// SISL: u runs fastest.
Sisl sisl_surface(const Net &net) {
  std::vector<double> points;
  for (int j = 0; j < net.counts[1]; ++j) {
    for (int i = 0; i < net.counts[0]; ++i) points.insert(points.end(), net.point(i, j), net.point(i, j) + 3);
  }
  auto knots = net.knots;
  constexpr int polynomial = 1, copies = 1;
  return Sisl(newSurf(net.counts[0], net.counts[1], degree + 1, degree + 1, knots[0].data(), knots[1].data(),
                      points.data(), polynomial, 3, copies));
}

// OpenCASCADE: different knots and how often each occurs, counted from 1.
Handle(Geom_BSplineSurface) occt_surface(const Net &net) {
  TColgp_Array2OfPnt points(1, net.counts[0], 1, net.counts[1]);
  for (int i = 0; i < net.counts[0]; ++i) {
    for (int j = 0; j < net.counts[1]; ++j) {
      const double *p = net.point(i, j);
      points.SetValue(i + 1, j + 1, gp_Pnt(p[0], p[1], p[2]));
    }
  }
  const auto breaks = [&](std::size_t axis) {
    const std::vector<double> &all = net.knots[axis];
    TColStd_Array1OfReal some(1, net.counts[axis] - degree + 1);
    for (int k = some.Lower(); k <= some.Upper(); ++k) some(k) = all[static_cast<std::size_t>(k - 1 + degree)];
    return some;
  };
  const auto multiplicities = [&](std::size_t axis) {
    TColStd_Array1OfInteger some(1, net.counts[axis] - degree + 1);
    some.Init(1);
    some(some.Lower()) = some(some.Upper()) = degree + 1;
    return some;
  };
  return new Geom_BSplineSurface(points, breaks(0), breaks(1), multiplicities(0), multiplicities(1), degree,
                                 degree);
}

planish::surface planish_surface_of(const Net &net) {
  planish_surface *made = nullptr;
  if (planish_tensor_new(3, degree, degree, net.knots[0].data(), net.knots[0].size(), net.knots[1].data(),
                         net.knots[1].size(), net.points.data(), nullptr, &made) != PLANISH_STATUS_OK) {
    throw std::runtime_error("the net is no surface");
  }
  return planish::surface(made);
}

void succeed(int status) {
  if (status < 0) throw std::runtime_error("an evaluation failed");
}

void store(const gp_XYZ &xyz, double *out) {
  out[0] = xyz.X();
  out[1] = xyz.Y();
  out[2] = xyz.Z();
}

// Runs each contender once into its own numbers, compares them with the first one's and then times them all.
class Job {
 public:
  Job(std::string what, std::size_t width) : what_(std::move(what)), width_(width) {}

  // `run` fills what it is given.
  template <class Run>
  void add(const char *name, Run run) {
    outs_.push_back(std::make_unique<std::vector<double>>(width_ * point_count));
    std::vector<double> &out = *outs_.back();
    contenders_.push_back({name, point_count, [run, &out] { run(out.data()); }});
  }

  void finish() {
    for (const race::Contender &contender : contenders_) contender.run();
    for (std::size_t i = 1; i < contenders_.size(); ++i) {
      const double apart = race::difference(*outs_[0], *outs_[i]);
      std::printf("agree\t%s\t%s\t%.1e\n", what_.c_str(), contenders_[i].name.c_str(), apart);
      if (!(apart <= agreement)) throw std::runtime_error(what_ + ": " + contenders_[i].name + " differs");
    }
    race::print(what_, contenders_);
  }

 private:
  std::string what_;
  std::size_t width_;
  std::vector<std::unique_ptr<std::vector<double>>> outs_;
  std::vector<race::Contender> contenders_;
};

class Arena {
 public:
  Arena(const Net &net, const std::string &name)
      : net_(net), name_(name), ours_(planish_surface_of(net)), sisl_(sisl_surface(net)), occt_(occt_surface(net)) {
    options_.thread_count = 1;
  }

  void scattered(const std::string &order, const std::vector<double> &uv) {
    Job values(name_ + "\tS " + order, 3);
    values.add("planish", [&](double *out) {
      succeed(planish_surface_eval(ours_.get(), uv.data(), point_count, &options_, out));
    });
    values.add("SISL s1424", [&](double *out) {
      int left_u = 0, left_v = 0, status = 0;
      for (std::size_t i = 0; i < point_count; ++i) {
        double at[] = {uv[2 * i], uv[2 * i + 1]};
        s1424(sisl_.get(), 0, 0, at, &left_u, &left_v, out + 3 * i, &status);
      }
      succeed(status);
    });
    values.add("OCCT D0", [&](double *out) { occt_values(*occt_, uv, out); });
    values.add("OCCT D0 cached", [&](double *out) { occt_values(GeomAdaptor_Surface(occt_), uv, out); });
    values.finish();

    Job derivatives(name_ + "\tS, Su, Sv " + order, 9);
    derivatives.add("planish", [&](double *out) {
      succeed(planish_surface_eval_derivatives(ours_.get(), uv.data(), point_count, 1, &options_, out));
    });
    derivatives.add("SISL s1421", [&](double *out) {
      int left_u = 0, left_v = 0, status = 0;
      double normal[3];
      for (std::size_t i = 0; i < point_count; ++i) {
        double at[] = {uv[2 * i], uv[2 * i + 1]};
        s1421(sisl_.get(), 1, at, &left_u, &left_v, out + 9 * i, normal, &status);
      }
      succeed(status);
    });
    derivatives.add("SISL s1424", [&](double *out) {
      int left_u = 0, left_v = 0, status = 0;
      double der[12]; // S, Su, Sv, Suv
      for (std::size_t i = 0; i < point_count; ++i) {
        double at[] = {uv[2 * i], uv[2 * i + 1]};
        s1424(sisl_.get(), 1, 1, at, &left_u, &left_v, der, &status);
        std::copy(der, der + 9, out + 9 * i);
      }
      succeed(status);
    });
    derivatives.add("OCCT D1", [&](double *out) { occt_derivatives(*occt_, uv, out); });
    derivatives.add("OCCT D1 cached",
                    [&](double *out) { occt_derivatives(GeomAdaptor_Surface(occt_), uv, out); });
    derivatives.finish();
  }

  // All pairs of `side` values of u and of v.
  void grid(std::vector<double> u, std::vector<double> v) {
    Job job(name_ + "\tgrid", 3);
    job.add("planish", [&](double *out) {
      succeed(planish_surface_eval_grid(ours_.get(), u.data(), side, v.data(), side, &options_, out));
    });
    // u runs fastest there: with u and v exchanged beforehand the numbers come in our order
    const Sisl turned = transposed();
    std::vector<double> normals(3 * point_count);
    job.add("SISL s1506", [&](double *out) {
      int status = 0;
      s1506(turned.get(), 0, side, v.data(), side, u.data(), out, normals.data(), &status);
      succeed(status);
    });
    job.finish();
  }

 private:
  template <class Surface>
  static void occt_values(const Surface &surface, const std::vector<double> &uv, double *out) {
    gp_Pnt point;
    for (std::size_t i = 0; i < point_count; ++i) {
      surface.D0(uv[2 * i], uv[2 * i + 1], point);
      store(point.XYZ(), out + 3 * i);
    }
  }

  template <class Surface>
  static void occt_derivatives(const Surface &surface, const std::vector<double> &uv, double *out) {
    gp_Pnt point;
    gp_Vec along_u, along_v;
    for (std::size_t i = 0; i < point_count; ++i) {
      surface.D1(uv[2 * i], uv[2 * i + 1], point, along_u, along_v);
      store(point.XYZ(), out + 9 * i);
      store(along_u.XYZ(), out + 9 * i + 3);
      store(along_v.XYZ(), out + 9 * i + 6);
    }
  }

  // The same surface with u and v exchanged.
  Sisl transposed() const {
    auto knots = net_.knots;
    auto points = net_.points;
    return Sisl(newSurf(net_.counts[1], net_.counts[0], degree + 1, degree + 1, knots[1].data(),
                        knots[0].data(), points.data(), 1, 3, 1));
  }

  const Net &net_;
  std::string name_;
  planish::surface ours_;
  Sisl sisl_;
  Handle(Geom_BSplineSurface) occt_;
  planish_eval_options options_ = planish::defaults<planish_eval_options>();
};

void compete(std::array<int, 2> counts, bool is_uniform) {
  const Net net(counts, is_uniform);
  Arena arena(net, std::to_string(counts[0]) + "x" + std::to_string(counts[1]) + "\t" +
                       (is_uniform ? "uniform" : "arbitrary"));
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<double> scattered, ordered;
  std::array<std::vector<double>, 2> lines;
  for (std::size_t i = 0; i < side; ++i) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      lines[axis].push_back(net.at(axis, static_cast<double>(i) / static_cast<double>(side)));
    }
  }
  for (std::size_t i = 0; i < side; ++i) {
    for (std::size_t j = 0; j < side; ++j) {
      ordered.insert(ordered.end(), {lines[0][i], lines[1][j]});
      const double u = net.at(0, unit(random)), v = net.at(1, unit(random));
      scattered.insert(scattered.end(), {u, v});
    }
  }
  arena.scattered("random", scattered);
  arena.scattered("ordered", ordered);
  arena.grid(lines[0], lines[1]);
}

} // namespace

int main() try {
  for (const std::array<int, 2> counts : {std::array{65, 17}, std::array{200, 200}, std::array{1000, 1000}}) {
    for (const bool is_uniform : {true, false}) compete(counts, is_uniform);
  }
} catch (const std::exception &error) {
  std::fprintf(stderr, "evaluate: %s\n", error.what());
  return EXIT_FAILURE;
}
