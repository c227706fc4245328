// Whether what was measured of an integrator is what its theory says.
#pragma once

#include <optional>
#include <string>

#include "harness/core/orders/order_engine.hpp"

namespace ulpgate {

enum class OrderVerdict { holds, too_low, not_finite, not_judged };

struct OrderJudgement {
  OrderVerdict verdict = OrderVerdict::not_judged;
  std::string why;  // empty where the order holds
};

// With fewer rungs the order is not yet asymptotic.
inline constexpr std::size_t least_judged_rungs = 6;

// Only an order that is too low is wrong: symmetry may give more.  It may be lower by `tolerance`, and by 5
// %. `order` is empty for a method that chooses it: of such a one only errors that are no numbers are wrong.
[[nodiscard]] OrderJudgement judge_order(const OrderLadder& ladder, std::optional<int> order,
                                         double tolerance);

// A drift has no right value, but it must have one.
[[nodiscard]] OrderJudgement judge_drift(const EnergyDrift& drift);

}  // namespace ulpgate
