/* Makes and evaluates a surface, with whatever library was found. */
#include <planish.h>

#include <stdio.h>
#include <string.h>

int main(void) {
  const double knots[4] = {0, 0, 1, 1}, values[4] = {0, 1, 1, 2}, uv[2] = {0.25, 0.5};
  double value = 0;
  planish_surface *surface = NULL;
  if (planish_tensor_new(1, 1, 1, knots, 4, knots, 4, values, NULL, &surface) < 0) return 1;
  if (planish_surface_eval(surface, uv, 1, NULL, &value) < 0) return 1;
  planish_surface_free(surface);
  printf("planish %s: %g\n", planish_version(), value);
  return !(value == 0.75 && strcmp(planish_version(), PLANISH_VERSION) == 0);
}
