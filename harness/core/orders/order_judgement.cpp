// Judgement of orders and drifts.
#include "harness/core/orders/order_judgement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ulpgate {

OrderJudgement judge_order(const OrderLadder& ladder, std::optional<int> order, double tolerance) {
  for (const auto& rung : ladder.rungs) {
    if (!std::isfinite(rung.error))
      return {OrderVerdict::not_finite, fmt::format("the error at {} steps is {}", rung.steps, rung.error)};
  }
  if (!order) return {OrderVerdict::not_judged, "the method chooses its order"};
  if (ladder.rungs.size() < least_judged_rungs) {
    return {OrderVerdict::not_judged,
            fmt::format("{} rungs, fewer than {}", ladder.rungs.size(), least_judged_rungs)};
  }
  if (!ladder.measured_order) return {OrderVerdict::not_judged, "at the floor of rounding at once"};
  const double allowed = std::max(tolerance, 0.05 * *order);
  // Written so that an order that is no number does not hold.
  if (*ladder.measured_order >= *order - allowed) return {OrderVerdict::holds, ""};
  return {OrderVerdict::too_low,
          fmt::format("order {:.3f} measured, {} expected", *ladder.measured_order, *order)};
}

OrderJudgement judge_drift(const EnergyDrift& drift) {
  if (std::isfinite(drift.largest())) return {OrderVerdict::holds, ""};
  return {OrderVerdict::not_finite, fmt::format("the largest energy error is {}", drift.largest())};
}

}  // namespace ulpgate
