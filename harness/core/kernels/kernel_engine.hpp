// KernelEngine: everything the harness does with the DEM kernels of one Real type, behind one narrow
// interface.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "harness/core/kernels/kernel_strata.hpp"
#include "harness/core/records/summary.hpp"
#include "harness/core/subject/type_engine.hpp"
#include "kernels/dem/table/kernel_info.hpp"

namespace ulpgate {

// Where the states of one row come from.
struct StateSource {
  StateStratum stratum = StateStratum::typical;
  std::uint64_t seed = 1;
  std::uint64_t count = 0;
};

// One output quantity in one state.
struct QuantityPoint {
  std::vector<std::string> got_hex;        // by component
  std::vector<std::string> exact_decimal;  // 30 significant digits
  Judgement judgement;                     // of the worst component
  double normwise_error = 0;               // |got - exact| / |exact| in units of 2^-p
  double condition = 0;                    // see KernelEngine::condition
};
struct KernelPoint {
  std::vector<std::string> inputs_hex;
  std::vector<QuantityPoint> quantities;
};

// Normwise condition number of a quantity f with respect to componentwise perturbations of its inputs
// (Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed., 1.6 and 3.1): sum over the inputs x of
// max |f(x (1 +- h)) - f(x)| / (h |f(x)|), h = 32 units of roundoff.  A finite h on purpose: where a branch
// lies within a few roundings of the state, the jump across it belongs to the condition of the problem, not
// to the kernel.

class KernelEngine {
 public:
  KernelEngine() = default;
  KernelEngine(const KernelEngine&) = delete;
  KernelEngine& operator=(const KernelEngine&) = delete;
  virtual ~KernelEngine() = default;

  [[nodiscard]] virtual const RealDescriptor& descriptor() const = 0;

  // Judges states first..last-1 of a row; one summary per output quantity.
  [[nodiscard]] virtual std::vector<Summary> evaluate(const dem::KernelInfo& kernel,
                                                      const StateSource& source, std::uint64_t first,
                                                      std::uint64_t last, RowHint& hint) const = 0;
  // State k of a row, and the state with these inputs (exact values of the type).
  [[nodiscard]] virtual KernelPoint point(const dem::KernelInfo& kernel, const StateSource& source,
                                          std::uint64_t k) const = 0;
  [[nodiscard]] virtual KernelPoint point(const dem::KernelInfo& kernel,
                                          const std::vector<MpfrValue>& inputs) const = 0;

  // `count` typical states, evaluated again and again.
  [[nodiscard]] virtual std::unique_ptr<TimedBatch> timed_batch(const dem::KernelInfo& kernel,
                                                                std::size_t count) const = 0;
};

// The engines of the types built in, in the order of the type list.
[[nodiscard]] const std::vector<std::unique_ptr<KernelEngine>>& all_kernel_engines();
[[nodiscard]] const KernelEngine* find_kernel_engine(std::string_view token);  // nullptr where not built

}  // namespace ulpgate
