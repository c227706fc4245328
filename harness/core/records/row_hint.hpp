// RowHint: what the units of one row tell each other while they run.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <utility>
#include <vector>

#include "harness/core/records/stage.hpp"
#include "harness/core/records/summary.hpp"

namespace ulpgate {

// Shared by the units of one row: the largest figures that finished units have found, which let a unit skip
// what cannot raise them, and counts of the samples that each stage decided.  They change how much is
// computed, never the row's record.
class RowHint {
 public:
  // Samples of the row, `last` not among them.
  struct Range {
    std::uint64_t first;
    std::uint64_t last;
  };
  std::vector<std::atomic<double>> error_over_condition;
  std::array<std::atomic<std::uint64_t>, stage_count> decided{};
  // Those of all units of this run, done or to be done; empty where a unit is evaluated alone.
  const std::vector<Range> ranges;

  explicit RowHint(std::size_t parts, std::vector<Range> of_run = {})
      : error_over_condition(parts), ranges(std::move(of_run)), max_error_(parts) {}
  [[nodiscard]] Maximum max_error(std::size_t part) const {
    const std::lock_guard lock(mutex_);
    return max_error_[part];
  }
  void raise_max_error(std::size_t part, const Maximum& found) {
    const std::lock_guard lock(mutex_);
    max_error_[part].merge(found);
  }
  // The largest finite quotient of error and condition number; `ratio` counts if it is larger.
  void raise_error_over_condition(std::size_t part, double ratio) {
    double seen = error_over_condition[part].load(std::memory_order_relaxed);
    while (ratio > seen &&
           !error_over_condition[part].compare_exchange_weak(seen, ratio, std::memory_order_relaxed)) {
    }
  }

 private:
  mutable std::mutex mutex_;
  std::vector<Maximum> max_error_;
};

}  // namespace ulpgate
