/* Fits a smooth surface to a triangle mesh and prints how close it came: a file given, else a wavy sheet. */
#include <planish.h>

#include <math.h>
#include <stdio.h>

enum { SIDE = 60 };

/* A sheet of SIDE by SIDE nodes. */
static planish_status make_sheet(planish_mesh **mesh) {
  static double points[SIDE * SIDE][3];
  static uint32_t triangles[2 * (SIDE - 1) * (SIDE - 1)][3];
  uint32_t i, j, t = 0;
  for (i = 0; i < SIDE; ++i) {
    for (j = 0; j < SIDE; ++j) {
      const uint32_t a = i * SIDE + j, b = a + SIDE;
      const double x = i / (SIDE - 1.0), y = j / (SIDE - 1.0);
      points[a][0] = x;
      points[a][1] = y;
      points[a][2] = 0.1 * sin(6 * x) * cos(5 * y);
      if (i + 1 < SIDE && j + 1 < SIDE) {
        triangles[t][0] = a, triangles[t][1] = b, triangles[t++][2] = b + 1;
        triangles[t][0] = a, triangles[t][1] = b + 1, triangles[t++][2] = a + 1;
      }
    }
  }
  return planish_mesh_new(points[0], SIDE * SIDE, triangles[0], t, NULL, mesh);
}

static int fail(void) {
  char text[256];
  planish_error_message(text, sizeof text);
  fprintf(stderr, "%s\n", text);
  return 1;
}

int main(int argc, char **argv) {
  planish_mesh *mesh = NULL;
  planish_surface *surface = NULL;
  planish_fit_report report;
  planish_tensor_options options;
  planish_status status = argc > 1 ? planish_mesh_read(argv[1], NULL, &mesh) : make_sheet(&mesh);
  if (status < 0) return fail();

  planish_tensor_options_init(&options, sizeof options);
  options.tolerance = 1e-4; /* of the bounding box's diagonal */
  report.struct_size = sizeof report;
  status = planish_tensor_fit(mesh, &options, &surface, &report);
  if (status < 0) {
    planish_mesh_free(mesh);
    return fail();
  }
  printf("%u passes, %zu coefficients, max error %.1e%s\n", (unsigned)report.pass_count, report.coefficient_count,
         report.max_error, status == PLANISH_STATUS_TOLERANCE_NOT_MET ? ", tolerance not met" : "");

  planish_surface_free(surface);
  planish_mesh_free(mesh);
  return 0;
}
/* Output: 7 passes, 289 coefficients, max error 5.8e-05 */
