// Both headers alone, as C++17 and without warnings.
#include "planish.hpp"

int planish_header_is_cxx17();
int planish_header_is_cxx17() { return PLANISH_VERSION_MAJOR; }
