// What `ulpgate integrators` writes: records, a table for people, verdicts.
#pragma once

#include "harness/app/orders/order_job.hpp"
#include "harness/app/store/records.hpp"

namespace ulpgate::app {

// Lines of orders.jsonl or drift.jsonl, one a rung or one a drift.
[[nodiscard]] std::string record_lines(const OrderRow& row, const OrderOptions& o);
// One line.
[[nodiscard]] std::string table_line(const OrderRow& row, const OrderOptions& o);

// Of a finished run; kept in its context, so that a second look says the same.
struct OrderVerdicts {
  std::size_t judged = 0;
  std::vector<std::string> wrong;
  std::vector<std::string> refused;  // by the method itself
};
[[nodiscard]] OrderVerdicts judge_rows(const OrderJob& job, const OrderOptions& o);
[[nodiscard]] Json to_json(const OrderVerdicts& verdicts);
// Throws a Failure where `j` is none; `place` stands in its message.
[[nodiscard]] OrderVerdicts verdicts_from_json(const Json& j, const std::string& place);

}  // namespace ulpgate::app
