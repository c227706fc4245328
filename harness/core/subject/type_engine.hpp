// TypeEngine: everything the harness does with one Real type, behind one narrow interface; an instance per
// type built.
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "harness/core/arguments/argument_lists.hpp"
#include "harness/core/arguments/sampling.hpp"
#include "harness/core/records/summary.hpp"
#include "reference/functions/function_info.hpp"
#include "reference/types/descriptor.hpp"

namespace ulpgate {

// Everything known about one result at one point.
struct PointPart {
  std::string got_hex;
  std::string got_decimal;
  std::string exact_decimal;  // 30 significant digits, or more where the type has more
  Judgement judgement;
  double condition = 0;
};
struct Point {
  std::vector<std::string> args_hex;
  std::vector<std::string> args_decimal;
  std::vector<PointPart> parts;
};

// References in the order of their cost.  A sample is decided by the first at which no statistic can depend
// on what the reference leaves open.
enum class Stage { binary64, x87_extended, binary128, mpfr, full };
inline constexpr std::array<std::string_view, 5> stage_names = {"binary64", "x87_extended", "binary128",
                                                                "mpfr", "full"};
inline constexpr std::size_t stage_count = stage_names.size();
[[nodiscard]] inline std::string_view name_of(Stage s) {
  return stage_names[static_cast<std::size_t>(s)];
}

// Shared by the units of one row: the largest figures that finished units have found, which let a unit skip
// what cannot raise them, and counts of the samples that each stage decided.  They change how much is
// computed, never the row's record.
class RowHint {
 public:
  std::vector<std::atomic<double>> error_over_condition;
  std::array<std::atomic<std::uint64_t>, stage_count> decided{};

  explicit RowHint(int parts)
      : error_over_condition(static_cast<std::size_t>(parts)), max_error_(static_cast<std::size_t>(parts)) {}
  [[nodiscard]] Maximum max_error(std::size_t part) const {
    const std::lock_guard lock(mutex_);
    return max_error_[part];
  }
  void raise_max_error(std::size_t part, const Maximum& found) {
    const std::lock_guard lock(mutex_);
    max_error_[part].merge(found);
  }

 private:
  mutable std::mutex mutex_;
  std::vector<Maximum> max_error_;
};

// A prepared batch of arguments of one function, evaluated again and again by a benchmark.
class TimedBatch {
 public:
  TimedBatch() = default;
  TimedBatch(const TimedBatch&) = delete;
  TimedBatch& operator=(const TimedBatch&) = delete;
  virtual ~TimedBatch() = default;
  // Evaluates the first `count` points.
  virtual void run(std::size_t count) = 0;
};

// What results are held against; the records are the same for both.
enum class ReferenceMode {
  screened,  // cheap stages decide what they can, the rest climbs
  full,      // MPFR at the precision of RealHP<4> for every sample
};

class TypeEngine {
 public:
  TypeEngine() = default;
  TypeEngine(const TypeEngine&) = delete;
  TypeEngine& operator=(const TypeEngine&) = delete;
  virtual ~TypeEngine() = default;

  [[nodiscard]] virtual const RealDescriptor& descriptor() const = 0;

  // Judges points first..last-1 of a row; one summary per part.  Throws ReferenceDisagreement.  A maximum
  // that `hint` shows to be below that of the row's other units may be missing from the summary.
  [[nodiscard]] virtual std::vector<Summary> evaluate(const FunctionInfo& f, const StratumSource& source,
                                                      std::uint64_t first, std::uint64_t last,
                                                      ReferenceMode mode, RowHint& hint) const = 0;

  // The point with index k of a row, and the point at arguments given as exact values of the type.
  [[nodiscard]] virtual Point point(const FunctionInfo& f, const StratumSource& source,
                                    std::uint64_t k) const = 0;
  [[nodiscard]] virtual Point point(const FunctionInfo& f, const std::vector<MpfrValue>& args) const = 0;

  [[nodiscard]] virtual std::unique_ptr<TimedBatch> timed_batch(const FunctionInfo& f,
                                                                std::size_t count) const = 0;
};

// The engines of the types built in, in the order of the type list.
[[nodiscard]] const std::vector<std::unique_ptr<TypeEngine>>& all_engines();
// nullptr where no such type was built.
[[nodiscard]] const TypeEngine* find_engine(std::string_view token);

}  // namespace ulpgate
