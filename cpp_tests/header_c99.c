/* The header alone, as C99 and without warnings. */
#include "planish.h"

int planish_header_is_c99(void);
int planish_header_is_c99(void) { return PLANISH_VERSION_MAJOR; }
