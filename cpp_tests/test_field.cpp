// planish_field_fitter and planish_transfer from outside: fields fitted again and again, sums of surfaces, gradients,
// values and forces between meshes.
#include "planish.hpp"

#include "check.hpp"
#include "shapes.hpp"

#include <cmath>
#include <vector>

#ifndef _WIN32
#include <sys/wait.h>
#include <unistd.h>
#endif

namespace {

planish::mesh sheet() {
  const shapes::arrays all = shapes::graph(25, 25, 0.2, 3);
  planish::mesh mesh(all.points, all.triangles);
  mesh.set_parameters(all.uv);
  return mesh;
}

std::vector<double> waves(const std::vector<planish::point2> &uv, double phase) {
  std::vector<double> field;
  for (const auto &p : uv) field.insert(field.end(), {std::sin(3 * p[0] + phase), p[0] * p[1]});
  return field;
}

template <class Call>
planish_status status_of(const Call &call) {
  try {
    call();
  } catch (const planish::error &error) {
    return error.status();
  }
  return PLANISH_STATUS_OK;
}

} // namespace

TEST(FieldFitter, FitsAndUpdates) {
  const planish::mesh mesh = sheet();
  auto options = planish::defaults<planish_field_options>();
  options.grid_u = options.grid_v = 9;
  const planish::field_fitter fitter(mesh, options);
  CHECK_EQUAL(fitter.point_count(), mesh.point_count());
  CHECK(fitter.grid() == (std::array<std::size_t, 2>{9, 9}));
  CHECK(fitter.parameters() == mesh.parameters());
  const std::vector<double> first = waves(mesh.parameters(), 0), second = waves(mesh.parameters(), 1);
  planish::fitted fit = fitter.fit(first, 2);
  CHECK(fit.status == PLANISH_STATUS_OK && fit.report.max_error <= fit.report.tolerance);
  const planish::fitted other = fitter.fit(second, 2);
  fitter.update(fit.surface, second, 2);
  CHECK(fit.surface.control_points() == other.surface.control_points());
}

TEST(FieldFitter, RefusesByName) {
  const planish::mesh mesh = sheet();
  const planish::field_fitter fitter(mesh);
  std::vector<double> field = waves(mesh.parameters(), 0);
  CHECK(status_of([&] { fitter.fit(field, 0); }) == PLANISH_STATUS_INVALID_ARGUMENT);
  CHECK(status_of([&] { fitter.fit(field, 7); }) == PLANISH_STATUS_INVALID_ARGUMENT);
  field[11] = std::nan("");
  CHECK(status_of([&] { fitter.fit(field, 2); }) == PLANISH_STATUS_NOT_FINITE);
  CHECK_EQUAL(planish_error_index(), 5);
  auto options = planish::defaults<planish_field_options>();
  options.smoothing = -1;
  CHECK(status_of([&] { planish::field_fitter(mesh, options); }) == PLANISH_STATUS_INVALID_ARGUMENT);
  const shapes::arrays octahedron{{1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1},
                                  {},
                                  {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 1, 0, 5, 2, 1, 5, 3, 2, 5, 0, 3, 5}};
  const planish::mesh closed(octahedron.points, octahedron.triangles);
  CHECK(status_of([&] { planish::field_fitter{closed}; }) == PLANISH_STATUS_TOPOLOGY);
}

TEST(Combine, AddsAShapeAndItsDisplacement) {
  const planish::mesh mesh = sheet();
  const planish::surface shape = planish::tensor_fit(mesh).surface;
  const std::vector<std::pair<double, const planish::surface *>> terms{{1.0, &shape}, {0.5, &shape}};
  const planish::surface sum = planish::combine(terms);
  for (double u : {0.2, 0.7}) {
    for (int k = 0; k < 3; ++k) CHECK_NEAR(sum.point(u, 0.4)[k], 1.5 * shape.point(u, 0.4)[k], 1e-14);
  }
  CHECK(status_of([&] { planish::combine({}); }) == PLANISH_STATUS_INVALID_ARGUMENT);
}

TEST(FieldGradient, OfThePlaceIsTheProjection) {
  const planish::surface shape = planish::tensor_fit(sheet()).surface;
  const std::vector<planish::point2> uv{{0.3, 0.4}, {0.6, 0.5}};
  const std::vector<double> gradients = planish::field_gradient(shape, shape, uv);
  const std::vector<planish::point3> normals = shape.normals(uv);
  for (std::size_t point = 0; point < uv.size(); ++point) {
    for (int k = 0; k < 3; ++k) {
      for (int i = 0; i < 3; ++i) {
        const double exact = (i == k ? 1 : 0) - normals[point][i] * normals[point][k];
        CHECK_NEAR(gradients[9 * point + 3 * k + i], exact, 1e-12);
      }
    }
  }
  CHECK(status_of([&] { planish::field_gradient(shape, shape, std::vector<planish::point2>{{9, 9}}); }) ==
        PLANISH_STATUS_OUTSIDE);
}

#ifndef _WIN32
// What a process forked after the fitter's first use gets of a fit with so many threads; -1 if it does not end well.
int status_after_fork(std::uint32_t threads) {
  const planish::mesh mesh = sheet();
  auto options = planish::defaults<planish_field_options>();
  options.grid_u = options.grid_v = 9;
  options.thread_count = threads;
  planish_field_fitter *fitter = nullptr;
  CHECK(planish_field_fitter_new(mesh.get(), &options, &fitter) == PLANISH_STATUS_OK);
  const std::vector<double> values(mesh.point_count(), 2.0);
  planish_surface *surface = nullptr;
  CHECK(planish_field_fitter_fit(fitter, values.data(), values.size(), 1, &surface, nullptr) == PLANISH_STATUS_OK);
  planish_surface_free(surface);
  const pid_t child = fork();
  if (child == 0) {
    alarm(20);  // ends it if a call waits for threads that are not there
    planish_surface *another = nullptr;
    const planish_status status =
        planish_field_fitter_fit(fitter, values.data(), values.size(), 1, &another, nullptr);
    planish_surface_free(another);
    planish_field_fitter_free(fitter);
    _exit(-status);
  }
  int ended = 0;
  CHECK(waitpid(child, &ended, 0) == child);
  planish_field_fitter_free(fitter);
  return WIFEXITED(ended) ? WEXITSTATUS(ended) : -1;
}

TEST(FieldFitter, SaysThatItsThreadsAreNotInTheForkedProcess) {
  CHECK_EQUAL(status_after_fork(2), -PLANISH_STATUS_INVALID_ARGUMENT);
  CHECK_EQUAL(status_after_fork(1), -PLANISH_STATUS_OK);
}
#endif

TEST(Transfer, CarriesValuesThereAndForcesBack) {
  const shapes::arrays fine = shapes::graph(37, 31, 0.2, 4);
  const planish::mesh source = sheet(), target(fine.points, fine.triangles);
  auto field = planish::defaults<planish_field_options>();
  field.grid_u = field.grid_v = 13;
  auto options = planish::defaults<planish_transfer_options>();
  options.field = &field;
  const planish::transfer transfer(source, target.points(), options);
  CHECK_EQUAL(transfer.source_count(), source.point_count());
  CHECK_EQUAL(transfer.target_count(), target.point_count());
  CHECK_EQUAL(transfer.distances()[transfer.report().farthest_index], transfer.report().max_distance);
  CHECK_EQUAL(transfer.parameters().size(), target.point_count());
  const std::vector<double> constants(source.point_count(), 3.0);
  for (double x : transfer.apply(constants, 1)) CHECK_NEAR(x, 3.0, 1e-14);
  std::vector<double> forces;
  for (const auto &p : target.points()) forces.insert(forces.end(), {p[0] - 2, p[1], 1});
  const std::vector<double> back = transfer.apply_transpose(forces, 3);
  for (int k = 0; k < 3; ++k) {
    double given = 0, arrived = 0;
    for (std::size_t i = k; i < forces.size(); i += 3) given += forces[i];
    for (std::size_t i = k; i < back.size(); i += 3) arrived += back[i];
    CHECK_NEAR(arrived, given, 1e-12 * 3 * static_cast<double>(target.point_count()));
  }
  const planish_balance_report balance = transfer.balance(source.points(), forces, {1, 2, 3});
  CHECK(balance.force_error <= 1e-12 && balance.work_error <= 1e-12);
  CHECK(balance.moment_error <= balance.moment_bound + 1e-9);
}

TEST(Transfer, RefusesByName) {
  const planish::mesh source = sheet();
  std::vector<planish::point3> targets = source.points();
  const planish::transfer transfer(source, targets);
  CHECK(status_of([&] { transfer.apply(std::vector<double>(7), 1); }) == PLANISH_STATUS_INVALID_ARGUMENT);
  targets[9][2] += 5;
  CHECK(status_of([&] { planish::transfer(source, targets); }) == PLANISH_STATUS_OUTSIDE);
  CHECK_EQUAL(planish_error_index(), 9);
  auto options = planish::defaults<planish_transfer_options>();
  options.far_rule = PLANISH_FAR_RULE_KEEP;
  CHECK_EQUAL(planish::transfer(source, targets, options).report().far_count, 1u);
  targets[3][0] = std::nan("");
  CHECK(status_of([&] { planish::transfer(source, targets, options); }) == PLANISH_STATUS_NOT_FINITE);
  CHECK_EQUAL(planish_error_index(), 3);
}

int main() { return check::run(); }
