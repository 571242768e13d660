// Skins the sections of a hull, each with a count of its own, by one surface, and writes it for a CAD system in strips.
#include <planish.hpp>

#include <cmath>
#include <cstdio>
#include <vector>

// Half sections from keel to deck: more points where the hull bends more.
static std::vector<std::vector<planish::point3>> sections() {
  std::vector<std::vector<planish::point3>> rows;
  for (int j = 0; j < 12; ++j) {
    const double x = j / 11.0, beam = std::sqrt(std::sin(0.2 + 2.6 * x)), draft = 0.6 - 0.3 * x * x;
    const int count = 20 + (j * 13) % 17;
    rows.emplace_back();
    for (int k = 0; k < count; ++k) {
      const double angle = 1.57 * k / (count - 1);
      rows.back().push_back({10 * x, beam * std::pow(std::sin(angle), 0.7), draft * (1 - 1.5 * std::cos(angle))});
    }
  }
  return rows;
}

int main() try {
  auto options = planish::defaults<planish_skin_options>();
  options.tolerance = 1e-4; // of the bounding box's diagonal
  options.compare = 1;      // count what common knots would need
  const auto [surface, report, skin, status] = planish::tspline_skin(sections(), options);
  auto step = planish::defaults<planish_step_options>();
  step.form = PLANISH_STEP_FORM_STRIPS;
  const auto written = surface.write_step("hull.step", step);
  std::printf("%s the tolerance with %zu control points, common knots need %zu, %zu faces hold %zu\n",
              status == PLANISH_STATUS_OK ? "within" : "beyond", report.coefficient_count, skin.common_count,
              written.face_count, written.pole_count);
  return 0;
} catch (const planish::error &error) {
  std::fprintf(stderr, "%s: %s\n", error.status_name(), error.what());
  return 1;
}
// Output: within the tolerance with 106 control points, common knots need 126, 11 faces hold 780
