// T-splines from outside: skins keep their tolerance, knots come and go, files and conversions keep the surface.
#include "check.hpp"
#include "handles.hpp"

#include <planish.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

// Sections of a hull, of unlike counts.
static std::vector<std::vector<planish::point3>> hull() {
  std::vector<std::vector<planish::point3>> rows;
  const std::size_t counts[6] = {31, 18, 44, 25, 12, 37};
  for (std::size_t j = 0; j < 6; ++j) {
    rows.emplace_back();
    const double x = 0.5 * static_cast<double>(j), beam = 1 + 0.4 * std::sin(0.9 * x);
    for (std::size_t k = 0; k < counts[j]; ++k) {
      const double angle = -1.5 + 3.0 * static_cast<double>(k) / static_cast<double>(counts[j] - 1);
      rows.back().push_back({x, beam * std::sin(angle), -std::cos(angle) * (1 + 0.1 * std::cos(4 * angle))});
    }
  }
  return rows;
}

static double distance(const double *a, const double *b) {
  return std::hypot(a[0] - b[0], std::hypot(a[1] - b[1], a[2] - b[2]));
}

// The largest distance of two surfaces over a grid.
static double distance(const planish::surface &a, const planish::surface &b) {
  double most = 0;
  for (int i = 0; i <= 40; ++i) {
    for (int j = 0; j <= 40; ++j) {
      most = std::max(most, distance(a.point(i / 40.0, j / 40.0).data(), b.point(i / 40.0, j / 40.0).data()));
    }
  }
  return most;
}

TEST(TSpline, KeepsTheToleranceAtEveryPoint) {
  const auto rows = hull();
  for (double tolerance : {1e-2, 1e-4, 1e-6}) {
    auto options = skin_options();
    options.tolerance = tolerance;
    std::vector<double> uv(2 * 167), errors(167);
    options.out_parameters = uv.data();
    options.out_errors = errors.data();
    const auto [surface, report, skin, status] = planish::tspline_skin(rows, options);
    CHECK(status == PLANISH_STATUS_OK);
    CHECK(report.max_error <= tolerance * report.diagonal);
    std::size_t k = 0;
    for (const auto &row : rows) {
      for (const auto &point : row) {
        const auto found = surface.point(uv[2 * k], uv[2 * k + 1]);
        CHECK_NEAR(distance(found.data(), point.data()), errors[k], 1e-14);
        ++k;
      }
    }
    CHECK(*std::max_element(errors.begin(), errors.end()) == report.max_error);
    CHECK(skin.largest_count * skin.curve_count <= skin.tensor_count);
  }
}

TEST(TSpline, IsAFullMemberOfTheFamily) {
  auto skinned = planish::tspline_skin(hull());
  const planish::surface &surface = skinned.surface;
  CHECK(surface.kind() == PLANISH_KIND_TSPLINE);
  CHECK(surface.coefficient_count() == skinned.report.coefficient_count);
  const planish::point3 place = surface.point(0.3, 0.6);
  const auto projected = surface.project(std::vector<planish::point3>{place});
  CHECK(projected.distances[0] < 1e-9);
  CHECK(surface.tessellate().triangle_count() > 100);
  CHECK(distance(planish::surface::load(surface.save()), surface) == 0);

  planish_surface *tensor = nullptr;
  CHECK(planish_surface_to_tensor(surface.get(), nullptr, &tensor) == PLANISH_STATUS_OK);
  const planish::surface owner(tensor);
  CHECK(owner.coefficient_count() == skinned.skin.tensor_count);
  CHECK(distance(owner, surface) < 1e-12);

  auto options = planish::defaults<planish_step_options>();
  for (std::uint32_t form : {PLANISH_STEP_FORM_TENSOR, PLANISH_STEP_FORM_STRIPS}) {
    options.form = form;
    const auto report = surface.write_step("tspline.step", options);
    CHECK(report.pole_count == (form ? skinned.skin.strip_count : skinned.skin.tensor_count));
    CHECK(report.face_count == (form ? 5u : 1u));
  }
  std::remove("tspline.step");
}

TEST(TSpline, IsRebuiltFromItsParts) {
  const auto skinned = planish::tspline_skin(hull());
  const auto curves = planish::tspline_curves(skinned.surface);
  const auto again = planish::tspline_new(planish::tspline_knots(skinned.surface), curves);
  CHECK(distance(again, skinned.surface) == 0);
  const planish::curve &first = curves.front();
  const auto copy = planish::curve_new(first.dim(), first.degree(), first.knots(), first.control_points());
  CHECK(copy.control_points() == first.control_points());
  const auto of_curves = planish::tspline_skin_curves(curves);
  CHECK(of_curves.skin.curve_count == curves.size() + 2);
}

TEST(TSpline, TakesKnotsInAndGivesThemBack) {
  const auto skinned = planish::tspline_skin(hull());
  planish::surface surface = skinned.surface;
  planish::tspline_insert_knot_u(surface, 2, 0.437);
  planish::tspline_insert_knot_v(surface, 0.5);
  CHECK(distance(surface, skinned.surface) < 1e-12);
  planish::surface other = skinned.surface;
  planish::tspline_insert_knot_u(other, 2, 0.437);
  const auto knots = planish::tspline_curves(other)[2].knots();
  const auto knot = static_cast<std::size_t>(std::find(knots.begin(), knots.end(), 0.437) - knots.begin());
  CHECK(!planish::tspline_remove_knot_u(other, 2, knot, -1).is_removed);
  const auto removal = planish::tspline_remove_knot_u(other, 2, knot, 1e-9);
  CHECK(removal.is_removed && removal.error < 1e-12);
  CHECK(other.coefficient_count() == skinned.surface.coefficient_count());
}

TEST(TSpline, RefusesBadRowsByName) {
  auto rows = hull();
  const auto refused = [&](planish_status status, std::int64_t index, const planish_skin_options &options) {
    try {
      planish::tspline_skin(rows, options);
      CHECK(false);
    } catch (const planish::error &error) {
      CHECK(error.status() == status);
      CHECK_EQUAL(error.index(), index);
    }
  };
  auto options = skin_options();
  options.tolerance = 0;
  refused(PLANISH_STATUS_INVALID_ARGUMENT, -1, options);
  rows[1] = rows[0];
  refused(PLANISH_STATUS_DEGENERATE, 1, skin_options());
  rows[1].clear();
  refused(PLANISH_STATUS_INVALID_ARGUMENT, 1, skin_options());
  rows[1] = {{0, 0, std::numeric_limits<double>::quiet_NaN()}};
  refused(PLANISH_STATUS_NOT_FINITE, 31, skin_options());
  rows.resize(1);
  refused(PLANISH_STATUS_INVALID_ARGUMENT, -1, skin_options());
}

TEST(TSpline, SkinsRowsOfAMesh) {
  // a tube with a waist
  std::vector<planish::point3> points;
  std::vector<planish::triangle> triangles;
  const std::uint32_t around = 48, along = 30;
  for (std::uint32_t j = 0; j <= along; ++j) {
    for (std::uint32_t k = 0; k < around; ++k) {
      const double angle = 2 * 3.14159265358979323846 * k / around, z = 0.1 * j, radius = 1 + 0.3 * std::cos(2 * z);
      points.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
      if (j == along) continue;
      const std::uint32_t a = j * around + k, b = j * around + (k + 1) % around;
      triangles.push_back({a, b, b + around});
      triangles.push_back({a, b + around, a + around});
    }
  }
  const planish::mesh mesh(points, triangles);
  const auto rows = planish::sample_rows(mesh, 14);
  CHECK_EQUAL(rows.size(), 14u);
  auto options = skin_options();
  options.closed = 1;
  const auto skinned = planish::tspline_skin(rows, options);
  CHECK(skinned.status == PLANISH_STATUS_OK);
  CHECK(skinned.report.max_error <= skinned.report.tolerance);
}

TEST(TSpline, StopsWhenAsked) {
  try {
    planish::tspline_skin(hull(), skin_options(), [](double, double) { return false; });
    CHECK(false);
  } catch (const planish::error &error) {
    CHECK(error.status() == PLANISH_STATUS_CANCELLED);
  }
}

int main() { return check::run(); }
