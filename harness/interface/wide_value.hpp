// What a handle of the C interface is.
#pragma once

#include <mpfr.h>

#include "harness/interface/include/ulpgate/ulpgate.h"

struct ulpgate_wide {
  mpfr_t value;
};
