// StressJob: what `ulpgate stress` is to run, from its options.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "harness/app/orders/measurement_run.hpp"
#include "harness/core/stress/stress_case.hpp"

namespace ulpgate::app {

struct StressOptions {
  std::string cases = "all";
  std::string kinds = "all";
  std::string types = "all";
  unsigned threads = 0;
  std::string out;
  bool resume = false;
  bool overwrite = false;
  bool json = false;
  bool truth = false;
  int digits = 25;
  bool list = false;
};

// One case in one type: one piece.
class StressMeasurement final : public Measurement {
 public:
  StressMeasurement(const StressCase& c, std::string token) : case_(c), token_(std::move(token)) {}

  [[nodiscard]] const StressCase& stress_case() const { return case_; }
  [[nodiscard]] const std::string& token() const { return token_; }
  // Nothing where the case does not exist in the type, or is not complete.
  [[nodiscard]] const std::optional<StressRow>& row() const { return row_; }

  [[nodiscard]] bool complete() const override { return complete_; }
  [[nodiscard]] std::uint64_t steps_done() const override { return complete_ ? 1 : 0; }
  [[nodiscard]] std::uint64_t expected_steps_left() const override { return complete_ ? 0 : 1; }

 protected:
  [[nodiscard]] std::string measure_piece(long steps, const ode::StopFlag& stop) override;
  [[nodiscard]] bool take_piece(std::string_view piece) override;

 private:
  const StressCase& case_;
  std::string token_;
  bool complete_ = false;
  std::optional<StressRow> row_;
};

struct StressJob {
  std::vector<std::string> types;
  std::vector<const StressCase*> cases;
  // By case, then by type.
  std::vector<std::unique_ptr<Measurement>> measurements;
  std::vector<std::string> names;
  std::vector<CostModel::Row> costs;
  std::string plan_text;
  std::string plan;
};

// Throws a Failure that names the option where a case, a kind or a type is none, and where nothing is chosen.
[[nodiscard]] std::vector<const StressCase*> select_cases(const std::string& cases, const std::string& kinds);
[[nodiscard]] StressJob make_stress_job(const StressOptions& options);

}  // namespace ulpgate::app
