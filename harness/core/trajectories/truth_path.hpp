// The true solutions of the initial value problems at several times on the way to their ends.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "kernels/ode/stepper/stop_flag.hpp"

namespace ulpgate {

// The times at which runs of one problem to one end are compared; the last is the end.
struct ComparedTimes {
  std::uint64_t equal_parts = 1;  // k/equal_parts of the end, k = 1, 2, ...
  std::vector<double> graded;     // instead, where not empty: these exact numbers, and the end behind them
};

enum class ErrorNorm {
  componentwise,  // each component relative to itself
  normwise,       // relative to the largest component
};

struct TruePath {
  std::vector<std::vector<std::string>> states;  // by time: components, decimal
  ErrorNorm norm = ErrorNorm::normwise;          // stiff problems: componentwise
  double error = 0;                              // of all of it, in that norm
};

// Two integrations of different order and tolerance agree on `digits` digits at every time, in the norm of
// the problem; both are made sharper until they do.  Throws as true_solution().
[[nodiscard]] TruePath true_path(std::string_view problem, std::string_view end, const ComparedTimes& times,
                                 int digits, const ode::StopFlag& stop);

}  // namespace ulpgate
