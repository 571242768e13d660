/* The header and the library are of one version. */
#include <planish.h>
#include <stdio.h>

int main(void) {
  printf("planish %s\n", planish_version());
  return planish_check_version(PLANISH_VERSION_MAJOR, PLANISH_VERSION_MINOR) != PLANISH_STATUS_OK;
}
