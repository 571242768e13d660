// PHT-splines from outside: what is split stays the same surface, what is refused changes nothing.
#include "check.hpp"
#include "handles.hpp"
#include "shapes.hpp"

#include <planish.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

using planish::pht_cell;

static const double nan_ = std::numeric_limits<double>::quiet_NaN();
static const std::vector<double> unit = {0.0, 1.0};

// A field over seven cells, one at the middle vertex, else zero.
static planish::surface hat() {
  planish::surface surface = planish::pht_new(1, false, unit, unit, {{0, 0, 0}, {1, 0, 0}});
  planish::pht view(surface);
  const auto vertices = view.vertices();
  for (std::uint32_t i = 0; i < vertices.size(); ++i) {
    if (vertices[i] == planish::point2{0.5, 0.5}) view.set_data({i}, {1, 0, 0, 0});
  }
  return surface;
}

static double value(const planish::surface &surface, double u, double v) {
  return surface.eval(planish::point2{u, v})[0];
}

// The status of the error that a call throws.
template <class Call>
static planish_status thrown(const Call &call) {
  try {
    call();
  } catch (const planish::error &error) {
    return error.status();
  }
  return PLANISH_STATUS_OK;
}

TEST(Pht, WorkedExample) {
  planish::surface surface = hat();
  const planish::pht view(surface);
  CHECK_EQUAL(surface.kind(), static_cast<std::uint32_t>(PLANISH_KIND_PHT));
  CHECK_EQUAL(view.cell_count(), 7u);
  CHECK_EQUAL(view.vertex_count(), 12u);
  CHECK_EQUAL(surface.coefficient_count(), 48u);
  CHECK_NEAR(value(surface, 0.375, 0.375), 19.0 / 32.0, 1e-15);
  CHECK_NEAR(value(surface, 0.25, 0.25), 0.0, 1e-15);
  const auto points = view.control_points();
  CHECK_NEAR(std::accumulate(points.begin(), points.end(), 0.0), 4.0, 1e-14);
}

TEST(Pht, SplitsAndMergesBackToTheBit) {
  planish::surface surface = hat();
  planish::pht view(surface);
  const auto data = view.data();
  const double before = value(surface, 0.3, 0.8);
  const std::vector<pht_cell> cells = {{1, 0, 1}, {2, 1, 2}, {3, 2, 5}};
  view.split(cells);
  CHECK_EQUAL(view.cell_count(), 16u);
  CHECK_NEAR(value(surface, 0.3, 0.8), before, 1e-15);
  view.merge({cells.rbegin(), cells.rend()});
  CHECK(view.data() == data);
  CHECK(value(surface, 0.3, 0.8) == before);
}

TEST(Pht, SimplifiesWithinTheTolerance) {
  planish::surface surface = hat();
  planish::pht view(surface);
  view.split({{1, 1, 1}, {2, 2, 2}});
  const planish::surface original = surface;
  for (double tolerance : {1e-12, 0.05, 2.0}) {
    const double deviation = view.simplify(tolerance);
    CHECK(deviation <= tolerance);
    for (double u = 0; u <= 1; u += 0.05) {
      for (double v = 0; v <= 1; v += 0.05) {
        CHECK(std::abs(value(surface, u, v) - value(original, u, v)) <= tolerance + 1e-14);
      }
    }
  }
  CHECK_EQUAL(view.cell_count(), 1u);
}

TEST(Pht, TensorPatchesAreTheSurface) {
  planish::surface surface = hat();
  const planish::pht view(surface);
  for (std::uint32_t sigma : {0u, 1u, 20u}) {
    const auto patches = view.tensor_patches(sigma);
    CHECK(!patches.empty() && (sigma < 20 || patches.size() == 1));
    for (const auto &patch : patches) {
      const auto box = patch.domain();
      const double u = 0.3 * box[0] + 0.7 * box[1], v = 0.6 * box[2] + 0.4 * box[3];
      CHECK_NEAR(value(patch, u, v), value(surface, u, v), 1e-15);
    }
  }
}

TEST(Pht, ConvertsATensorSurfaceAndStitches) {
  const std::vector<double> knots = {0, 0, 0, 1, 1, 1};
  const auto tensor = planish::tensor_new(1, 2, 2, knots, knots, std::vector<double>{0, 1, 0, 2, 3, 1, 0, 0, 1});
  planish::surface a = planish::pht_from_surface(tensor), b = hat();
  CHECK_NEAR(value(a, 0.3, 0.9), value(tensor, 0.3, 0.9), 1e-14);
  planish::pht_stitch(a, PLANISH_BORDER_SIDE_HIGH_U, b, PLANISH_BORDER_SIDE_LOW_V, true);
  for (double t : {0.0, 0.2, 0.5, 0.9, 1.0}) CHECK_NEAR(value(a, 1.0, t), value(b, 1.0 - t, 0.0), 1e-14);
}

// +-------+-------+
// |       |       |    T marks the T-vertices: each lies in an edge of its host, the cell beside the four small ones,
// |       |       |    whose neighbours are these two and the cell in the corner.
// +---T---+-------+
// +---+---T       |
// +---+---+-------+
TEST(Pht, KnowsHostsAndNeighbours) {
  planish::surface surface = hat();
  const planish::pht view(surface);
  CHECK_EQUAL(view.hanging_count(), 2u);
  const auto hanging = view.hanging();
  const auto hosts = view.hosts();
  CHECK(hanging.size() == 2 && hosts.size() == 2);
  for (std::size_t i = 0; i < hanging.size(); ++i) {
    const bool right = hanging[i] == planish::point2{0.5, 0.25};
    CHECK(right || (hanging[i] == planish::point2{0.25, 0.5}));
    CHECK_EQUAL(hosts[i], view.cell_at(right ? 0.6 : 0.1, right ? 0.1 : 0.6));
    const auto neighbours = view.neighbours(hosts[i]);
    CHECK_EQUAL(neighbours.size(), 3u);
    CHECK(std::count(neighbours.begin(), neighbours.end(), view.cell_at(0.8, 0.8)) == 1);
  }
  CHECK(thrown([&] { view.neighbours(7); }) == PLANISH_STATUS_INDEX);
}

TEST(Pht, ExtractionSumsToOne) {
  planish::surface surface = hat();
  const planish::pht view(surface);
  for (std::size_t cell = 0; cell < view.cell_count(); ++cell) {
    const auto made = view.extract(cell);
    const std::size_t width = 4 * made.vertices.size();
    CHECK(std::is_sorted(made.vertices.begin(), made.vertices.end()) && made.matrix.size() == 16 * width);
    for (std::size_t row = 0; row < 16; ++row) {
      const auto begin = made.matrix.begin() + static_cast<std::ptrdiff_t>(row * width);
      CHECK_NEAR(std::accumulate(begin, begin + static_cast<std::ptrdiff_t>(width), 0.0), 1.0, 1e-14);
    }
  }
}

TEST(Pht, ControlPointsAreReplacedAndRegionsRefined) {
  planish::surface surface = hat();
  planish::pht view(surface);
  view.set_control_points({0}, {4, 3, 2, 1});
  const auto points = view.control_points();
  for (std::size_t i = 0; i < 4; ++i) CHECK_NEAR(points[i], 4.0 - static_cast<double>(i), 1e-14);
  const double before = value(surface, 0.7, 0.8);
  view.refine_region({0.6, 0.9, 0.6, 0.9}, 3);
  CHECK(view.cell_count() > 7);
  CHECK_NEAR(value(surface, 0.7, 0.8), before, 1e-14);
  CHECK(thrown([&] { view.refine_region({0, 1, 0, 1}, 8, 100); }) == PLANISH_STATUS_TOO_LARGE);
}

TEST(PhtFit, KeepsTheTolerance) {
  const shapes::arrays all = shapes::graph(40, 40, 0.2, 11);
  planish_mesh *made = nullptr;
  CHECK(planish_mesh_new(all.points.data(), all.point_count(), all.triangles.data(), all.triangle_count(), nullptr,
                         &made) == PLANISH_STATUS_OK);
  const Mesh mesh(made);
  for (double tolerance : {1e-2, 1e-3, 1e-4}) {
    planish_pht_options options = pht_options();
    options.tolerance = tolerance;
    std::vector<double> uv(2 * all.point_count()), errors(all.point_count());
    options.out_parameters = uv.data();
    options.out_errors = errors.data();
    auto report = fresh<planish_fit_report>();
    planish_surface *surface = nullptr;
    CHECK(planish_pht_fit(mesh.get(), &options, &surface, &report) == PLANISH_STATUS_OK);
    const Surface owner(surface);
    CHECK(report.max_error <= report.tolerance);
    CHECK_EQUAL(report.cell_count, planish_pht_cell_count(surface));
    CHECK_EQUAL(report.rough_cell_count, 0u);
    CHECK_EQUAL(report.flipped_count, 0u);
    std::vector<double> values(3 * all.point_count());
    CHECK(planish_surface_eval(surface, uv.data(), all.point_count(), nullptr, values.data()) == PLANISH_STATUS_OK);
    double largest = 0;
    for (std::size_t i = 0; i < all.point_count(); ++i) {
      double square = 0;
      for (std::size_t k = 0; k < 3; ++k) square += std::pow(values[3 * i + k] - all.points[3 * i + k], 2);
      CHECK_NEAR(std::sqrt(square), errors[i], 1e-14);
      largest = std::max(largest, errors[i]);
    }
    CHECK(largest == report.max_error);
  }
}

TEST(PhtFit, TwoContinuousDerivativesTakeFewerCoefficients) {
  const shapes::arrays all = shapes::graph(60, 60, 0.2, 21);
  std::vector<double> heights;
  for (std::size_t i = 0; i < all.point_count(); ++i) heights.push_back(all.points[3 * i + 2]);
  auto options = planish::defaults<planish_pht_options>();
  options.tolerance = 1e-4;
  const auto once = planish::pht_fit_points(all.uv, heights, 1, options);
  options.continuity = 2;
  const auto twice = planish::pht_fit_points(all.uv, heights, 1, options);
  CHECK(twice.status == PLANISH_STATUS_OK && twice.report.max_error <= twice.report.tolerance);
  CHECK(twice.report.coefficient_count < once.report.coefficient_count);
  CHECK(twice.report.coefficient_count <= twice.report.refined_coefficient_count);
  CHECK_EQUAL(twice.surface.coefficient_count(), twice.report.coefficient_count);
  CHECK_EQUAL(twice.surface.kind(), static_cast<std::uint32_t>(PLANISH_KIND_PHT));
  // it comes back to the bit, with as many coefficients
  const auto bytes = twice.surface.save();
  const planish::surface loaded = planish::surface::load(bytes);
  CHECK(loaded.save() == bytes);
  CHECK_EQUAL(loaded.coefficient_count(), twice.surface.coefficient_count());
  CHECK_EQUAL(value(loaded, 0.3, 0.6), value(twice.surface, 0.3, 0.6));
  options.continuity = 3;
  CHECK(thrown([&] { planish::pht_fit_points(all.uv, heights, 1, options); }) == PLANISH_STATUS_INVALID_ARGUMENT);
  options.continuity = 1;
  options.coarsening = PLANISH_COARSENING_ON;
  const auto coarse = planish::pht_fit_points(all.uv, heights, 1, options);
  CHECK(coarse.status == PLANISH_STATUS_OK && coarse.report.max_error <= coarse.report.tolerance);
  CHECK(coarse.report.coefficient_count <= coarse.report.refined_coefficient_count);
  CHECK_EQUAL(coarse.report.refined_coefficient_count, once.report.coefficient_count);
}

TEST(PhtFit, SaysWhenTheLimitIsReached) {
  const shapes::arrays all = shapes::graph(40, 40, 0.2, 12);
  std::vector<double> heights;
  for (std::size_t i = 0; i < all.point_count(); ++i) heights.push_back(all.points[3 * i + 2]);
  auto options = planish::defaults<planish_pht_options>();
  options.tolerance = 1e-6;
  options.max_level = 1;
  const auto fit = planish::pht_fit_points(all.uv, heights, 1, options);
  CHECK(fit.status == PLANISH_STATUS_TOLERANCE_NOT_MET);
  CHECK_EQUAL(fit.report.stop_reason, static_cast<std::uint32_t>(PLANISH_STOP_REASON_LIMIT));
  CHECK_EQUAL(fit.report.deepest_level, 1u);
}

TEST(PhtFit, CanBeCancelled) {
  const shapes::arrays all = shapes::graph(30, 30, 0.2, 13);
  std::vector<double> heights(all.point_count(), 1.0);
  planish_status status = PLANISH_STATUS_OK;
  try {
    planish::pht_fit_points(all.uv, heights, 1, planish::defaults<planish_pht_options>(),
                            [](double, double) { return false; });
  } catch (const planish::error &error) {
    status = error.status();
  }
  CHECK(status == PLANISH_STATUS_CANCELLED);
}

TEST(Pht, RefusalsChangeNothing) {
  planish::surface surface = hat();
  planish_surface *s = surface.get();
  planish_surface *out = sentinel<planish_surface>();
  const std::uint32_t gone[] = {1, 0, 0};
  const double bad[] = {nan_, 0, 0, 0};
  const std::uint32_t vertex = 0, far = 12;
  CHECK(planish_pht_split(s, gone, 1) == PLANISH_STATUS_INDEX);
  CHECK_EQUAL(planish_error_index(), 0);
  CHECK(planish_pht_split(nullptr, gone, 1) == PLANISH_STATUS_NULL_POINTER);
  CHECK(planish_pht_split(s, nullptr, 1) == PLANISH_STATUS_NULL_POINTER);
  CHECK(planish_pht_split(s, nullptr, 0) == PLANISH_STATUS_OK);
  const std::uint32_t corner[] = {2, 0, 0};
  CHECK(planish_pht_merge(s, corner, 1) == PLANISH_STATUS_INDEX);
  CHECK(planish_pht_set_data(s, &vertex, 1, bad) == PLANISH_STATUS_NOT_FINITE);
  CHECK(planish_pht_set_data(s, &far, 1, unit.data()) == PLANISH_STATUS_INDEX);
  CHECK(planish_pht_simplify(s, nan_, nullptr, nullptr) == PLANISH_STATUS_INVALID_ARGUMENT);
  CHECK(planish_pht_from_surface(s, nullptr, &out) == PLANISH_STATUS_WRONG_KIND);
  const double falling[] = {1, 0};
  CHECK(planish_pht_new(1, 0, falling, 2, falling, 2, nullptr, 0, nullptr, 0, &out) == PLANISH_STATUS_INVALID_ARGUMENT);
  CHECK(planish_pht_new(1, 0, unit.data(), 2, unit.data(), 2, nullptr, 0, nullptr, 0, nullptr) ==
        PLANISH_STATUS_NULL_POINTER);
  CHECK(out == sentinel<planish_surface>());
  CHECK_EQUAL(planish_pht_cell_count(s), 7u);
  CHECK_NEAR(value(surface, 0.375, 0.375), 19.0 / 32.0, 1e-15);
}

int main() { return check::run(); }
