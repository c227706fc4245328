// Digests: what tells other results apart where no error grew.
//
// The arithmetic of kernels and scenes is the project's or the user's own: every rounding of it is fixed by
// the source.  An order of a sum that was swapped or a constant that is off by little may leave every error
// within its limit, but not the results as they were.
#pragma once

#include <string>
#include <string_view>

#include "harness/core/records/row_record.hpp"

namespace ulpgate {

// Whether a type has the same results on every processor with the same libraries.  Not where x87 instructions
// compute functions (glibc's for long double, and what Boost starts from for cpp_bin_float of that size):
// their last digits are their maker's.
[[nodiscard]] bool has_portable_results(std::string_view type);

// Eight hexadecimal digits of everything that is counted of a record's errors.  Two records of the same
// points whose results differ have other ones, but for a change that keeps the sum and the histogram of all
// errors.
[[nodiscard]] std::string results_digest(const RowRecord& record);

}  // namespace ulpgate
