// What tests compare of two summaries: everything that a record takes from one.
#pragma once

#include <tuple>

#include "harness/core/records/summary.hpp"

namespace ulpgate {

[[nodiscard]] inline auto recorded_figures(const Summary& s) {
  return std::tuple(s.samples, s.correctly_rounded, s.outcomes, s.first_index, s.max_error.value,
                    s.max_error.index, s.max_distance, s.max_error_over_condition, s.histogram.exact,
                    s.histogram.counts, s.sum.to_text());
}

}  // namespace ulpgate
