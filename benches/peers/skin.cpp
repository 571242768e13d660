// Skins of rows of points on one thread beside OpenCASCADE and SISL.
//
// The rows are sections of a head. Each contender gets them and a tolerance and makes a surface of its own: SISL
// fits a curve to each row (s1961) and lofts them (s1538); OpenCASCADE fits a curve to each row
// (GeomAPI_PointsToBSpline) and approximates a surface through them (GeomFill_AppSurf, BRepOffsetAPI_ThruSections).
// All of that is timed.
//
// Errors are those of the finished surface. Ours is the largest distance of any point at its (u,v), from the report
// and once more by evaluation. A peer's is the largest distance of some of the points to the nearest place
// anywhere, which is kinder: we look for the place, on the same surface handed to us, and the peer evaluates there.
#include "head.hpp"
#include "race.hpp"

#include <planish.hpp>
#include <sisl.h>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepOffsetAPI_ThruSections.hxx>
#include <BRep_Tool.hxx>
#include <GeomAPI_PointsToBSpline.hxx>
#include <GeomFill_AppSurf.hxx>
#include <GeomFill_Line.hxx>
#include <GeomFill_SectionGenerator.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Precision.hxx>
#include <Standard_Failure.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>

#include <csignal>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

using planish::point3;
using Knots = std::vector<double>;

constexpr double tolerance = 5e-4; // of the diagonal
constexpr std::uint32_t degree = 3;
// Points of which a peer's nearest places are looked for, at most.
constexpr std::size_t sample_count = 500;
// Steps of the grid on which a surface is looked at between the rows.
constexpr int grid_steps = 500;
// The report must agree with evaluation to this part of the diagonal.
constexpr double agreement = 1e-12;
constexpr rlim_t patience = 60; // seconds of processor time

struct Job {
  std::string name;
  head::Rows rows;
  double diagonal = rows.diagonal();
  double allowed = tolerance * diagonal;

  std::size_t point_count() const { return rows.points.size() / 3; }
  const double *point(std::size_t i) const { return &rows.points[3 * i]; }

  double distance(const point3 &place, std::size_t i) const {
    const double *p = point(i);
    return std::sqrt(head::square(place[0] - p[0]) + head::square(place[1] - p[1]) + head::square(place[2] - p[2]));
  }
};

using Evaluate = std::function<point3(double, double)>;

// What is measured once a surface is finished; lengths are relative to the diagonal.
struct Quality {
  std::size_t control_points;
  double error;
  double astray; // how far the surface leaves the box of the points
};

// Who makes a surface of a job: run() is timed, the rest is not.
class Contender {
 public:
  explicit Contender(const Job &job) : job_(job) {}
  virtual ~Contender() = default;
  virtual void run() = 0;
  virtual Quality quality() = 0;

 protected:
  // The largest distance of some points to the nearest place on `twin`, evaluated there by the surface's maker.
  double nearest_error(const planish::surface &twin, const Evaluate &at) const {
    const std::size_t step = (job_.point_count() + sample_count - 1) / sample_count;
    std::vector<double> points;
    for (std::size_t i = 0; i < job_.point_count(); i += step) {
      points.insert(points.end(), job_.point(i), job_.point(i) + 3);
    }
    auto options = planish::defaults<planish_project_options>();
    options.thread_count = 1;
    const planish::projected found = twin.project(planish::values<double>(points), options);
    double largest = 0;
    for (std::size_t n = 0; n < found.uv.size(); ++n) {
      largest = std::max(largest, job_.distance(at(found.uv[n][0], found.uv[n][1]), n * step));
    }
    return largest / job_.diagonal;
  }

  double astray(const planish::surface &twin, const Evaluate &at) const {
    std::array<double, 3> least, largest;
    for (std::size_t k = 0; k < 3; ++k) {
      least[k] = largest[k] = job_.rows.points[k];
      for (std::size_t i = 0; i < job_.point_count(); ++i) {
        least[k] = std::min(least[k], job_.point(i)[k]);
        largest[k] = std::max(largest[k], job_.point(i)[k]);
      }
    }
    const auto [u0, u1, v0, v1] = twin.domain();
    double farthest = 0;
    for (int i = 0; i <= grid_steps; ++i) {
      for (int j = 0; j <= grid_steps; ++j) {
        const point3 place = at(u0 + (u1 - u0) * i / grid_steps, v0 + (v1 - v0) * j / grid_steps);
        double sum = 0;
        for (std::size_t k = 0; k < 3; ++k) {
          sum += head::square(std::max({0.0, least[k] - place[k], place[k] - largest[k]}));
        }
        farthest = std::max(farthest, std::sqrt(sum));
      }
    }
    return farthest / job_.diagonal;
  }

  const Job &job_;
};

class Planish : public Contender {
 public:
  explicit Planish(const Job &job) : Contender(job) {
    options_.tolerance = tolerance;
    options_.ends = PLANISH_SECTION_ENDS_PARABOLIC;
    options_.extra_checks = 0;
    options_.certify = 0;
    options_.thread_count = 1;
  }

  void run() override { skin(); }

  Quality quality() override {
    std::vector<double> uv(2 * job_.point_count());
    options_.out_parameters = uv.data();
    const planish::skinned made = skin();
    options_.out_parameters = nullptr;
    const Evaluate at = [&](double u, double v) { return made.surface.point(u, v); };
    double largest = 0;
    for (std::size_t i = 0; i < job_.point_count(); ++i) {
      largest = std::max(largest, job_.distance(at(uv[2 * i], uv[2 * i + 1]), i));
    }
    if (!(std::abs(largest - made.report.max_error) <= agreement * job_.diagonal)) {
      throw std::runtime_error("the report and evaluation differ");
    }
    return {made.surface.coefficient_count(), made.report.max_error / job_.diagonal, astray(made.surface, at)};
  }

 private:
  planish::skinned skin() const { return planish::tspline_skin(job_.rows.points, job_.rows.counts, options_); }

  planish_skin_options options_ = planish::defaults<planish_skin_options>();
};

struct FreeSisl {
  void operator()(SISLSurf *surface) const { freeSurf(surface); }
  void operator()(SISLCurve *curve) const { freeCurve(curve); }
};

class Sisl : public Contender {
 public:
  using Contender::Contender;

  void run() override {
    std::vector<std::unique_ptr<SISLCurve, FreeSisl>> owners;
    std::vector<SISLCurve *> curves;
    std::size_t first = 0;
    for (std::size_t count : job_.rows.counts) {
      owners.emplace_back(row_curve(job_.point(first), count));
      curves.push_back(owners.back().get());
      first += count;
    }
    std::vector<int> ordinary(curves.size(), 1);
    SISLSurf *lofted = nullptr;
    double *places = nullptr;
    int status = 0;
    s1538(static_cast<int>(curves.size()), curves.data(), ordinary.data(), 0, 1, degree + 1, 0, &lofted, &places,
          &status);
    std::free(places);
    if (status < 0) throw std::runtime_error("s1538 failed");
    surface_.reset(lofted);
  }

  Quality quality() override {
    const SISLSurf &s = *surface_;
    std::vector<double> points;
    for (int i = 0; i < s.in1; ++i) {
      for (int j = 0; j < s.in2; ++j) {
        const double *p = s.ecoef + 3 * (j * s.in1 + i);
        points.insert(points.end(), p, p + 3);
      }
    }
    const planish::surface twin = planish::tensor_new(3, degree, degree, Knots(s.et1, s.et1 + s.in1 + s.ik1),
                                                      Knots(s.et2, s.et2 + s.in2 + s.ik2), points);
    const Evaluate at = [&](double u, double v) {
      double uv[] = {u, v};
      int left_u = 0, left_v = 0, status = 0;
      point3 place;
      s1424(surface_.get(), 0, 0, uv, &left_u, &left_v, place.data(), &status);
      return place;
    };
    return {points.size() / 3, nearest_error(twin, at), astray(twin, at)};
  }

 private:
  SISLCurve *row_curve(const double *points, std::size_t count) const {
    // A tolerance is that of a coordinate. Rows are level, so z does not err. None of it goes to thinning out the
    // polyline before: of the shares 0, 0.1, 0.3 and 0.5 this one needs the fewest control points.
    const double each = job_.allowed / std::sqrt(2.0);
    double allowed[] = {each, each, each}, reached[3];
    constexpr double thinning = 0;
    constexpr int fixed_derivatives = 1, open = 1, chord_length = 1, most_rounds = 10;
    SISLCurve *curve = nullptr;
    int status = 0;
    s1961(const_cast<double *>(points), static_cast<int>(count), 3, chord_length, nullptr, allowed,
          fixed_derivatives, fixed_derivatives, open, thinning, most_rounds, degree + 1, &curve, reached, &status);
    if (status < 0) throw std::runtime_error("s1961 failed");
    return curve;
  }

  std::unique_ptr<SISLSurf, FreeSisl> surface_;
};

// What both ways of OpenCASCADE share.
class Occt : public Contender {
 public:
  using Contender::Contender;

  Quality quality() override {
    const Geom_BSplineSurface &s = *surface_;
    if (s.IsUPeriodic() || s.IsVPeriodic()) throw std::runtime_error("a periodic surface was not expected");
    std::vector<double> points, weights;
    for (int i = 1; i <= s.NbUPoles(); ++i) {
      for (int j = 1; j <= s.NbVPoles(); ++j) {
        const gp_Pnt p = s.Pole(i, j);
        points.insert(points.end(), {p.X(), p.Y(), p.Z()});
        weights.push_back(s.Weight(i, j)); // all but 1
      }
    }
    const planish::surface twin =
        planish::tensor_new(3, static_cast<std::uint32_t>(s.UDegree()), static_cast<std::uint32_t>(s.VDegree()),
                            repeated(s.UKnots(), s.UMultiplicities()), repeated(s.VKnots(), s.VMultiplicities()),
                            points, weights);
    const Evaluate at = [&](double u, double v) {
      const gp_Pnt p = s.Value(u, v);
      return point3{p.X(), p.Y(), p.Z()};
    };
    return {weights.size(), nearest_error(twin, at), astray(twin, at)};
  }

 protected:
  std::vector<Handle(Geom_BSplineCurve)> row_curves() const {
    std::vector<Handle(Geom_BSplineCurve)> curves;
    std::size_t first = 0;
    for (std::size_t count : job_.rows.counts) {
      TColgp_Array1OfPnt points(1, static_cast<int>(count));
      for (std::size_t i = 0; i < count; ++i) {
        const double *p = job_.point(first + i);
        points(static_cast<int>(i) + 1) = gp_Pnt(p[0], p[1], p[2]);
      }
      curves.push_back(GeomAPI_PointsToBSpline(points, degree, degree, GeomAbs_C2, job_.allowed).Curve());
      first += count;
    }
    return curves;
  }

  Handle(Geom_BSplineSurface) surface_;

 private:
  static Knots repeated(const TColStd_Array1OfReal &breaks, const TColStd_Array1OfInteger &multiplicities) {
    Knots knots;
    for (int k = breaks.Lower(); k <= breaks.Upper(); ++k) {
      knots.insert(knots.end(), static_cast<std::size_t>(multiplicities(k)), breaks(k));
    }
    return knots;
  }
};

class AppSurf : public Occt {
 public:
  AppSurf(const Job &job, bool is_through_all) : Occt(job), is_through_all_(is_through_all) {}

  void run() override {
    const auto curves = row_curves();
    GeomFill_SectionGenerator sections;
    for (const auto &curve : curves) sections.AddCurve(curve);
    sections.Perform(Precision::PConfusion());
    constexpr int rounds = 0;
    GeomFill_AppSurf fit(degree, degree, job_.allowed, job_.allowed, rounds);
    fit.SetContinuity(GeomAbs_C2);
    fit.Perform(new GeomFill_Line(static_cast<int>(curves.size())), sections, is_through_all_);
    if (!fit.IsDone()) throw Standard_Failure("no surface");
    surface_ = new Geom_BSplineSurface(fit.SurfPoles(), fit.SurfWeights(), fit.SurfUKnots(), fit.SurfVKnots(),
                                       fit.SurfUMults(), fit.SurfVMults(), fit.UDegree(), fit.VDegree());
  }

 private:
  bool is_through_all_;
};

class ThruSections : public Occt {
 public:
  using Occt::Occt;

  void run() override {
    BRepOffsetAPI_ThruSections loft(false, false, job_.allowed);
    loft.CheckCompatibility(false); // rows begin beside one another and have one edge each
    for (const auto &curve : row_curves()) {
      loft.AddWire(BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(curve).Edge()).Wire());
    }
    loft.Build();
    if (!loft.IsDone()) throw Standard_Failure("no surface");
    TopExp_Explorer faces(loft.Shape(), TopAbs_FACE);
    surface_ = Handle(Geom_BSplineSurface)::DownCast(BRep_Tool::Surface(TopoDS::Face(faces.Current())));
    faces.Next();
    if (faces.More()) throw std::runtime_error("one face was expected");
  }
};

std::string grouped(std::size_t number) {
  std::string text = std::to_string(number);
  for (std::size_t end = text.size(); end > 3; end -= 3) text.insert(end - 3, ",");
  return text;
}

void print_row(const Job &job, const std::string &who, const std::string &seconds, const std::string &control_points,
               const std::string &error, const std::string &astray, const std::string &met) {
  std::printf("row\t%s\t%s\t%s\t%s\t%s\t%s\t%s\n", job.name.c_str(), who.c_str(), seconds.c_str(),
              control_points.c_str(), error.c_str(), astray.c_str(), met.c_str());
  std::fflush(stdout);
}

void compete(const Job &job, const std::string &who, Contender &contender) {
  try {
    const std::string seconds = race::seconds([&] { contender.run(); });
    const Quality made = contender.quality();
    char error[32], astray[32];
    std::snprintf(error, sizeof error, "%.2e", made.error);
    std::snprintf(astray, sizeof astray, "%.2g", made.astray);
    print_row(job, who, seconds, grouped(made.control_points), error, astray, made.error <= tolerance ? "yes" : "no");
  } catch (const Standard_Failure &) {
    print_row(job, who, "-", "no surface", "-", "-", "no");
  }
}

// The same in a process of its own that may be stopped.
void compete_for_a_while(const Job &job, const std::string &who, Contender &contender) {
  std::fflush(stdout);
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no process");
  if (child == 0) {
    const rlimit limit = {patience, patience};
    setrlimit(RLIMIT_CPU, &limit);
    compete(job, who, contender);
    _exit(EXIT_SUCCESS);
  }
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFSIGNALED(status)) {
    const bool is_late = WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL;
    print_row(job, who, is_late ? "over " + std::to_string(patience) : "-", is_late ? "-" : "crashes", "-", "-", "no");
  }
}

void compete_all(const Job &job) {
  Planish planish(job);
  compete(job, "planish", planish);
  Sisl sisl(job);
  compete(job, "SISL s1961, s1538", sisl);
  AppSurf near(job, false), through(job, true);
  compete(job, "OCCT AppSurf", near);
  compete(job, "OCCT AppSurf, SpApprox", through);
  // it gives no answer for all rows within minutes
  if (job.rows.counts.size() == head::row_count) return;
  ThruSections loft(job);
  compete_for_a_while(job, "OCCT ThruSections", loft);
}

} // namespace

int main() try {
  const head::Rows all = head::rows();
  std::puts("table\tSections of a head, tolerance 5e-4, seconds of processor time on one thread. Goal: planish under "
            "0.06 s for all rows");
  std::puts("row\trows\twho\tseconds\tcontrol points\terror\tastray\tmet");
  compete_all({"all 100", all});
  compete_all({"every fifth", all.chosen(2, 5, 20)});
  compete_all({"first 20", all.chosen(0, 1, 20)});
} catch (const std::exception &error) {
  std::fprintf(stderr, "skin: %s\n", error.what());
  return EXIT_FAILURE;
}
