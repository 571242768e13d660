/* A C99 program through the whole library: mesh, map, fit, evaluation, errors. It also runs under valgrind. */
#include <planish.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CHECK(condition)                                                             \
  do {                                                                               \
    if (!(condition)) {                                                              \
      char text[256];                                                                \
      planish_error_message(text, sizeof text);                                      \
      printf("%s:%d: not true: %s (%s)\n", __FILE__, __LINE__, #condition, text);    \
      exit(1);                                                                       \
    }                                                                                \
  } while (0)

enum { SIDE = 12, COUNT = SIDE * SIDE, TRIANGLES = 2 * (SIDE - 1) * (SIDE - 1) };

static double points[3 * COUNT];
static uint32_t triangles[3 * TRIANGLES];

static void make_arrays(void) {
  size_t t = 0;
  for (uint32_t i = 0; i < SIDE; ++i) {
    for (uint32_t j = 0; j < SIDE; ++j) {
      const uint32_t a = i * SIDE + j, b = a + SIDE;
      const double x = i / (SIDE - 1.0), y = j / (SIDE - 1.0);
      points[3 * a] = x;
      points[3 * a + 1] = y;
      points[3 * a + 2] = 0.2 * sin(3 * x) * cos(2 * y);
      if (i + 1 < SIDE && j + 1 < SIDE) {
        const uint32_t cell[6] = {a, b, b + 1, a, b + 1, a + 1};
        memcpy(triangles + t, cell, sizeof cell);
        t += 6;
      }
    }
  }
}

static int32_t count_calls(double fraction, double error, void *user) {
  (void)error;
  ++*(int *)user;
  return fraction < 0; /* never */
}

int main(void) {
  planish_mesh *mesh = NULL, *copy = NULL;
  planish_surface *surface = NULL, *twin = NULL;
  planish_parameterize_report map;
  planish_fit_report report;
  planish_tensor_options options;
  int calls = 0;

  CHECK(strcmp(planish_version(), PLANISH_VERSION) == 0);
  make_arrays();
  CHECK(planish_mesh_new(points, COUNT, triangles, TRIANGLES, NULL, &mesh) == PLANISH_STATUS_OK);
  CHECK(planish_mesh_loop_count(mesh) == 1);
  CHECK(planish_mesh_clone(mesh, &copy) == PLANISH_STATUS_OK);
  map.struct_size = sizeof map;
  CHECK(planish_mesh_parameterize(mesh, NULL, &map) == PLANISH_STATUS_OK);
  CHECK(map.flipped_count == 0 && map.stretch >= 1.0);

  CHECK(planish_tensor_options_init(&options, sizeof options) == PLANISH_STATUS_OK);
  options.tolerance = 1e-2;
  options.thread_count = 2;
  options.progress = count_calls;
  options.user = &calls;
  report.struct_size = sizeof report;
  CHECK(planish_tensor_fit(copy, &options, &surface, &report) == PLANISH_STATUS_OK);
  CHECK(report.max_error <= report.tolerance && calls > 0);
  CHECK(planish_surface_trim_count(surface) == 1);
  CHECK(planish_surface_clone(surface, &twin) == PLANISH_STATUS_OK);
  planish_surface_free(surface);

  {
    double box[4], uv[2], point[3], twice[3];
    CHECK(planish_surface_domain(twin, box) == PLANISH_STATUS_OK);
    uv[0] = 0.5 * (box[0] + box[1]);
    uv[1] = 0.5 * (box[2] + box[3]);
    CHECK(planish_surface_eval(twin, uv, 1, NULL, point) == PLANISH_STATUS_OK);
    CHECK(planish_surface_eval_grid(twin, uv, 1, uv + 1, 1, NULL, twice) == PLANISH_STATUS_OK);
    CHECK(memcmp(point, twice, sizeof point) == 0);
    uv[0] = 2 * box[1];
    CHECK(planish_surface_eval(twin, uv, 1, NULL, twice) == PLANISH_STATUS_OUTSIDE);
    CHECK(planish_error_index() == 0 && memcmp(point, twice, sizeof point) == 0);
  }
  planish_surface_free(twin);
  planish_surface_free(NULL);
  planish_mesh_free(mesh);
  planish_mesh_free(copy);
  planish_mesh_free(NULL);

  triangles[5] = COUNT; /* no such node */
  CHECK(planish_mesh_new(points, COUNT, triangles, TRIANGLES, NULL, &mesh) == PLANISH_STATUS_INDEX);
  CHECK(planish_error_index() == 1);
  printf("%d calls of progress, max error %.1e\n", calls, report.max_error);
  return 0;
}
