// The true solutions of the initial value problems at their ends, by our own integration at two orders.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "kernels/ode/stepper/stop_flag.hpp"

namespace ulpgate {

struct TrueValue {
  std::string value;  // decimal, rounded to as many digits as were asked for
  double digits;      // on which both integrations agree, relative to the component; at most those asked for
};

// The most digits that are computed.
inline constexpr int most_truth_digits = 60;

// The components at one end time, each to `digits` digits, on which two integrations of different order and
// tolerance agree; both are made sharper until they do.  Kepler's is the closed form.  Throws
// std::invalid_argument for a case or an end that is none, std::runtime_error where no agreement is reached,
// and ode::Stopped.
[[nodiscard]] std::vector<TrueValue> true_solution(std::string_view problem, std::string_view end, int digits,
                                                   const ode::StopFlag& stop);

}  // namespace ulpgate
