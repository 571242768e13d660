// Closest points on a bicubic surface on one thread beside OpenCASCADE and SISL.
//
// The surface has 65 x 65 knots, waves and ripples. Points lie 1e-3 of the diagonal off it, over the inner 96% of
// either direction: OpenCASCADE looks for feet of perpendiculars only, so the border is left out. The nearest
// place anywhere is one contest, the one beside a start is the other. The start is the place the point was made
// from, moved by up to half a span along u and along v.
#include "race.hpp"

#include <planish.hpp>
#include <sisl.h>

#include <Extrema_ExtPS.hxx>
#include <Extrema_GenLocateExtPS.hxx>
#include <Extrema_POnSurf.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <Geom_BSplineSurface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>

#include <cstdlib>
#include <limits>
#include <random>
#include <stdexcept>

namespace {

constexpr int degree = 3;
constexpr int cells = 64;
constexpr int count = cells + degree;
constexpr std::size_t point_count = 100000;
// Who looks everywhere takes milliseconds a point, or tens of them: this many are enough to know the rate.
constexpr std::size_t slow_count = 1000;
constexpr std::size_t slowest_count = 100;
constexpr double off = 1e-3;
// Distances are asked for to this part of the diagonal; they count as equal within ten times of it. A distance
// errs by the square of the place's error over twice the radius of curvature, so this is no hard demand.
constexpr double tolerance = 1e-10;
constexpr double equal = 1e-9;

struct Net {
  std::vector<double> knots, points;

  Net() {
    for (int k = 0; k <= cells; ++k) {
      knots.insert(knots.end(), k == 0 || k == cells ? degree + 1 : 1, static_cast<double>(k) / cells);
    }
    for (int i = 0; i < count; ++i) {
      for (int j = 0; j < count; ++j) {
        const double u = greville(i), v = greville(j);
        const double z = 0.15 * std::sin(6 * u) * std::cos(5 * v) + 0.01 * std::sin(40 * u + 25 * v);
        points.insert(points.end(), {u + 0.1 * std::sin(4 * v), v, z});
      }
    }
  }

  double greville(int i) const {
    const double *first = &knots[static_cast<std::size_t>(i)];
    return (first[1] + first[2] + first[3]) / 3;
  }

  // Of the control points' box.
  double diagonal() const {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      double least = points[k], largest = points[k];
      for (std::size_t i = k; i < points.size(); i += 3) {
        least = std::min(least, points[i]);
        largest = std::max(largest, points[i]);
      }
      sum += (largest - least) * (largest - least);
    }
    return std::sqrt(sum);
  }
};

planish::surface planish_surface_of(const Net &net) {
  planish_surface *made = nullptr;
  if (planish_tensor_new(3, degree, degree, net.knots.data(), net.knots.size(), net.knots.data(),
                         net.knots.size(), net.points.data(), nullptr, &made) != PLANISH_STATUS_OK) {
    throw std::runtime_error("the net is no surface");
  }
  return planish::surface(made);
}

SISLSurf *sisl_surface(const Net &net) {
  std::vector<double> points, knots = net.knots;
  for (int j = 0; j < count; ++j) {
    for (int i = 0; i < count; ++i) {
      const double *p = &net.points[3 * static_cast<std::size_t>(i * count + j)];
      points.insert(points.end(), p, p + 3);
    }
  }
  return newSurf(count, count, degree + 1, degree + 1, knots.data(), knots.data(), points.data(), 1, 3, 1);
}

Handle(Geom_BSplineSurface) occt_surface(const Net &net) {
  TColgp_Array2OfPnt points(1, count, 1, count);
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < count; ++j) {
      const double *p = &net.points[3 * static_cast<std::size_t>(i * count + j)];
      points.SetValue(i + 1, j + 1, gp_Pnt(p[0], p[1], p[2]));
    }
  }
  TColStd_Array1OfReal breaks(1, cells + 1);
  TColStd_Array1OfInteger multiplicities(1, cells + 1);
  multiplicities.Init(1);
  multiplicities(1) = multiplicities(cells + 1) = degree + 1;
  for (int k = 0; k <= cells; ++k) breaks(k + 1) = net.knots[static_cast<std::size_t>(k + degree)];
  return new Geom_BSplineSurface(points, breaks, breaks, multiplicities, multiplicities, degree, degree);
}

class Arena {
 public:
  Arena() : ours_(planish_surface_of(net_)), sisl_(sisl_surface(net_)), occt_(occt_surface(net_)) {
    options_.thread_count = 1;
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> inside(0.02, 0.98), half_span(-0.5 / cells, 0.5 / cells);
    std::normal_distribution<double> normal;
    for (std::size_t i = 0; i < point_count; ++i) {
      const planish::point2 at{inside(random), inside(random)};
      const planish::point3 foot = ours_.point(at[0], at[1]);
      const double x = normal(random), y = normal(random), z = normal(random);
      const double step = off * diagonal_ / std::sqrt(x * x + y * y + z * z);
      points_.insert(points_.end(), {foot[0] + step * x, foot[1] + step * y, foot[2] + step * z});
      const double start_u = at[0] + half_span(random), start_v = at[1] + half_span(random);
      starts_.insert(starts_.end(), {start_u, start_v});
    }
  }
  Arena(const Arena &) = delete;
  ~Arena() { freeSurf(sisl_); }

  void everywhere() {
    std::vector<double> ours(point_count), extrema(slow_count), one(slow_count), all(slowest_count);
    const GeomAdaptor_Surface adaptor(occt_);
    finish("nearest anywhere",
           {{"planish", point_count, [&] { project(nullptr, ours); }},
            {"OCCT ExtPS, least only", slow_count,
             [&] {
               Extrema_ExtPS search;
               search.Initialize(adaptor, 0, 1, 0, 1, tolerance, tolerance);
               search.SetFlag(Extrema_ExtFlag_MIN);
               for (std::size_t i = 0; i < slow_count; ++i) {
                 search.Perform(point(i));
                 extrema[i] = std::numeric_limits<double>::infinity();
                 if (!search.IsDone()) continue;
                 for (int n = 1; n <= search.NbExt(); ++n) {
                   extrema[i] = std::min(extrema[i], std::sqrt(search.SquareDistance(n)));
                 }
               }
             }},
            {"SISL s1958", slow_count,
             [&] {
               for (std::size_t i = 0; i < slow_count; ++i) {
                 double at[2];
                 int status = 0;
                 s1958(sisl_, &points_[3 * i], 3, tolerance, tolerance, at, &one[i], &status);
                 if (status < 0) one[i] = std::numeric_limits<double>::infinity();
               }
             }},
            {"SISL s1954", slowest_count,
             [&] {
               for (std::size_t i = 0; i < slowest_count; ++i) all[i] = nearest_of_all(i);
             }}},
           {&ours, &extrema, &one, &all});
  }

  void near_start() {
    std::vector<double> ours(point_count), located(point_count), newton(point_count);
    const GeomAdaptor_Surface adaptor(occt_);
    finish("nearest, start given",
           {{"planish", point_count, [&] { project(starts_.data(), ours); }},
            {"OCCT GenLocateExtPS", point_count,
             [&] {
               Extrema_GenLocateExtPS search(adaptor, tolerance, tolerance);
               for (std::size_t i = 0; i < point_count; ++i) {
                 search.Perform(point(i), starts_[2 * i], starts_[2 * i + 1]);
                 located[i] = search.IsDone() ? std::sqrt(search.SquareDistance())
                                              : std::numeric_limits<double>::infinity();
               }
             }},
            {"SISL s1775", point_count,
             [&] {
               for (std::size_t i = 0; i < point_count; ++i) {
                 double least[] = {0, 0}, largest[] = {1, 1}, at[2];
                 int status = 0;
                 s1775(sisl_, &points_[3 * i], 3, tolerance, least, largest, &starts_[2 * i], at, &status);
                 newton[i] = status < 0 ? std::numeric_limits<double>::infinity() : distance(i, at);
               }
             }}},
           {&ours, &located, &newton});
  }

 private:
  // Compares distances, then times. A peer may find a farther place, and the count says so; none may find a
  // nearer one.
  void finish(const std::string &what, const std::vector<race::Contender> &contenders,
              const std::vector<const std::vector<double> *> &distances) {
    for (const race::Contender &contender : contenders) contender.run();
    for (std::size_t n = 1; n < contenders.size(); ++n) {
      std::size_t same = 0, farther = 0, nearer = 0;
      for (std::size_t i = 0; i < contenders[n].points; ++i) {
        const double more = ((*distances[n])[i] - (*distances[0])[i]) / diagonal_;
        ++(more > equal ? farther : more < -equal ? nearer : same);
      }
      std::printf("found\t%s\t%s\t%zu same\t%zu farther or none\t%zu nearer\n", what.c_str(),
                  contenders[n].name.c_str(), same, farther, nearer);
      if (nearer > 0) throw std::runtime_error(contenders[n].name + " knows a nearer place");
    }
    race::print("65x65 knots\t-\t" + what, contenders);
  }

  gp_Pnt point(std::size_t i) const { return gp_Pnt(points_[3 * i], points_[3 * i + 1], points_[3 * i + 2]); }

  void project(const double *starts, std::vector<double> &distances) {
    options_.guesses = starts;
    std::vector<double> uv(2 * point_count);
    const planish_status status =
        planish_surface_project(ours_.get(), points_.data(), point_count, &options_, uv.data(), distances.data());
    if (status != PLANISH_STATUS_OK) throw std::runtime_error("projecting failed");
  }

  // s1775 returns the place only.
  double distance(std::size_t i, double *at) const {
    double foot[3];
    int left_u = 0, left_v = 0, status = 0;
    s1424(sisl_, 0, 0, at, &left_u, &left_v, foot, &status);
    return std::hypot(foot[0] - points_[3 * i], foot[1] - points_[3 * i + 1], foot[2] - points_[3 * i + 2]);
  }

  double nearest_of_all(std::size_t i) {
    int places = 0, curves = 0, status = 0;
    double *at = nullptr;
    SISLIntcurve **lines = nullptr;
    s1954(sisl_, &points_[3 * i], 3, tolerance, tolerance, &places, &at, &curves, &lines, &status);
    double least = std::numeric_limits<double>::infinity();
    for (int n = 0; n < places; ++n) least = std::min(least, distance(i, at + 2 * n));
    std::free(at);
    if (curves > 0) freeIntcrvlist(lines, curves);
    return least;
  }

  Net net_;
  double diagonal_ = net_.diagonal();
  planish::surface ours_;
  SISLSurf *sisl_;
  Handle(Geom_BSplineSurface) occt_;
  planish_project_options options_ = planish::defaults<planish_project_options>();
  std::vector<double> points_, starts_;
};

} // namespace

int main() try {
  Arena arena;
  arena.near_start();
  arena.everywhere();
} catch (const std::exception &error) {
  std::fprintf(stderr, "project: %s\n", error.what());
  return EXIT_FAILURE;
}
