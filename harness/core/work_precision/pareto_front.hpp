// The settings that no other beats in both error and time.
#pragma once

#include <cstddef>
#include <vector>

namespace ulpgate {

struct WorkPoint {
  double error;    // relative; NaN or infinite where the setting failed
  double seconds;  // of a run
};

// Indices of the points for which no other is as good in both and better in one, fastest first; of points
// that are equal the first.  What is no number, or an error of 1 and more, is on no front.
[[nodiscard]] std::vector<std::size_t> pareto_front(const std::vector<WorkPoint>& points);

}  // namespace ulpgate
