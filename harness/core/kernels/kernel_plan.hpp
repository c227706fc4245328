// KernelPlan: everything that fixes the numbers of a run of the DEM kernels, its rows, units and records.
#pragma once

#include <string>
#include <vector>

#include "harness/core/kernels/kernel_engine.hpp"
#include "harness/core/records/row_record.hpp"

namespace ulpgate {

struct KernelPlanRequest {
  std::vector<dem::KernelId> kernels;
  std::vector<std::string> types;  // tokens of built types
  std::vector<StateStratum> strata;
  std::uint64_t samples = 1000;  // states of each stratum
  std::uint64_t seed = 1;
};

struct KernelRow {
  const KernelEngine* engine;
  const dem::KernelInfo* kernel;
  StateSource source;
};

class KernelPlan {
 public:
  explicit KernelPlan(KernelPlanRequest request);

  [[nodiscard]] const KernelPlanRequest& request() const { return request_; }
  [[nodiscard]] const std::vector<KernelRow>& rows() const { return rows_; }
  [[nodiscard]] const std::vector<WorkUnit>& units() const { return units_; }
  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] const std::string& hash() const { return hash_; }

 private:
  KernelPlanRequest request_;
  std::vector<KernelRow> rows_;
  std::vector<WorkUnit> units_;
  std::string text_;
  std::string hash_;
};

// One record per output quantity.
[[nodiscard]] std::vector<RowRecord> finish_kernel_row(const KernelPlan& plan, const KernelRow& row,
                                                       const std::vector<Summary>& summaries);

}  // namespace ulpgate
