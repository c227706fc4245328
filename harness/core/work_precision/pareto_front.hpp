// The settings that no other beats in both error and time.
#pragma once

#include <cstddef>
#include <vector>

namespace ulpgate {

struct WorkPoint {
  double error;    // relative; NaN or infinite where the setting failed
  double seconds;  // of a run
};

// Types share the error of a step in all but its last digits: a dearer setting that lowers the error by this
// part or less is no better.  `GAIN` of reports/ulpgate_report/work_precision/settings.py is the same number,
// and a test holds both fronts to each other.
inline constexpr double least_gain = 0.02;

// Indices of the points on the front, fastest first: each has a smaller error than 1 - least_gain times that
// of the one before, and all that are as fast have a greater error, or the same and stand later.  What is no
// number, or an error of 1 and more, is on no front.
[[nodiscard]] std::vector<std::size_t> pareto_front(const std::vector<WorkPoint>& points);

}  // namespace ulpgate
