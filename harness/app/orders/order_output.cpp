// Records, table and verdicts of integrators.
#include "harness/app/orders/order_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/app/reading/json_fields.hpp"
#include "harness/app/shell/failure.hpp"
#include "harness/core/orders/order_judgement.hpp"

namespace ulpgate::app {

namespace {

// A number, or a word for what is none.
Json error_or_word(double x) {
  if (std::isnan(x)) return "nan";
  return std::isinf(x) ? Json("inf") : Json(x);
}

std::string order_line(const OrderRow& row) {
  const OrderLadder& ladder = row.ladder->ladder();
  if (ladder.rungs.empty()) {
    return fmt::format("{:<20} {:<16} {:<12} {}\n", row.integrator.name, row.type, row.problem,
                       row.ladder->refusal().value_or("not measured"));
  }
  double least = HUGE_VAL;
  for (const auto& rung : ladder.rungs) least = std::min(least, rung.error);
  const std::string measured =
      ladder.measured_order ? fmt::format("{:.3f}", *ladder.measured_order) : "at the floor at once";
  return fmt::format(
      "{:<20} {:<16} {:<12} order {:>5}  measured {:<20}  least error {:.2e} at {} steps on t = {:.2g}\n",
      row.integrator.name, row.type, row.problem,
      row.integrator.order ? std::to_string(*row.integrator.order) : "free", measured, least,
      ladder.rungs.back().steps, ladder.t_end);
}

std::string drift_line(const OrderRow& row, const OrderOptions& o) {
  if (row.drift->refusal()) {
    return fmt::format("{:<20} {:<16} {:<12} {}\n", row.integrator.name, row.type, row.problem,
                       *row.drift->refusal());
  }
  const EnergyDrift& drift = row.drift->drift();
  return fmt::format("{:<20} {:<16} {:<12} largest energy error {:.3e} over {} units of {} steps, slope {}\n",
                     row.integrator.name, row.type, row.problem, drift.largest(), o.drift_units,
                     o.steps_per_unit, drift.slope() ? fmt::format("{:.2f}", *drift.slope()) : "-");
}

}  // namespace

std::string record_lines(const OrderRow& row, const OrderOptions& o) {
  if (row.drift != nullptr) {
    // A drift that was not followed to its end has no record.
    if (row.drift->refusal()) return "";
    const EnergyDrift& drift = row.drift->drift();
    const Json j = {{"what", "drift"},
                    {"integrator", row.integrator.name},
                    {"type", row.type},
                    {"problem", row.problem},
                    {"dt", 1.0 / static_cast<double>(o.steps_per_unit)},
                    {"t_end", o.drift_units},
                    {"max_energy_error", error_or_word(drift.largest())},
                    {"energy_slope", number_or_null(drift.slope())}};
    return j.dump() + "\n";
  }
  // A method that chooses its order has none to be held against.
  if (!row.integrator.order) return "";
  const OrderLadder& ladder = row.ladder->ladder();
  std::string text;
  for (const auto& rung : ladder.rungs) {
    const Json j = {{"what", "order"},
                    {"integrator", row.integrator.name},
                    {"order", *row.integrator.order},
                    {"type", row.type},
                    {"problem", row.problem},
                    {"t_end", ladder.t_end},
                    {"dt", rung.dt},
                    {"steps", rung.steps},
                    {"error", error_or_word(rung.error)},
                    {"measured_order", number_or_null(rung.order)}};
    text += j.dump() + "\n";
  }
  return text;
}

std::string table_line(const OrderRow& row, const OrderOptions& o) {
  return row.drift != nullptr ? drift_line(row, o) : order_line(row);
}

OrderVerdicts judge_rows(const OrderJob& job, const OrderOptions& o) {
  OrderVerdicts verdicts;
  for (std::size_t i = 0; i < job.rows.size(); ++i) {
    const OrderRow& row = job.rows[i];
    const std::string name = fmt::format("{} {} {}", row.integrator.name, row.type, row.problem);
    if (const auto& refusal = job.measurements[i]->refusal())
      verdicts.refused.push_back(name + ": " + *refusal);
    const OrderJudgement judgement =
        row.drift != nullptr ? judge_drift(row.drift->drift())
                             : judge_order(row.ladder->ladder(), row.integrator.order, o.tolerance);
    const bool good = judgement.verdict == OrderVerdict::holds;
    if (!good && judgement.verdict != OrderVerdict::not_judged)
      verdicts.wrong.push_back(name + ": " + judgement.why);
    if (judgement.verdict != OrderVerdict::not_judged && !job.measurements[i]->refusal()) ++verdicts.judged;
  }
  return verdicts;
}

Json to_json(const OrderVerdicts& verdicts) {
  return {{"judged", verdicts.judged}, {"wrong", verdicts.wrong}, {"refused", verdicts.refused}};
}

OrderVerdicts verdicts_from_json(const Json& j, const std::string& place) {
  try {
    return {j.at("judged").get<std::size_t>(), j.at("wrong").get<std::vector<std::string>>(),
            j.at("refused").get<std::vector<std::string>>()};
  } catch (const Json::exception& e) {
    throw Failure(Standing::bad_input, fmt::format("{}: no verdicts: {}", place, e.what()));
  }
}

}  // namespace ulpgate::app
