// The search for the cheapest setting that meets an error, by measuring: nothing is assumed smooth.
#pragma once

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "harness/core/work_precision/work_precision_row.hpp"

namespace ulpgate {

// A quarter of a level is the finest difference that the search looks at.
inline constexpr int quarters_of_level = 4;

// A type, an integrator and a kind of steps.
struct AdviceCurve {
  int levels = 1;
  // Seconds of level 0, roughly: what is cheap is looked at first, and what would begin at over four times
  // the best is not looked at.
  double guess_s = 0;
  double growth = 2;  // by which a level costs more than the one before, roughly
};

struct AdvicePoint {
  std::size_t curve = 0;
  int quarter = 0;  // of levels: level k is quarter 4 k
  WorkOutcome outcome;
  double seconds = 0;  // of one run
  bool cut = false;    // ended when it had taken longer than it might: nothing is known of its error
  // What is wanted to be small: the final error, or the larger of it and the one on the way.
  enum class Wanted { final, on_the_way };
  Wanted wanted = Wanted::final;

  // The error wanted, with what the truth itself may be wrong by; infinite where it failed.
  [[nodiscard]] double certain_error() const;
};

struct AdviceLimits {
  double error = 0;         // wanted
  double most_seconds = 0;  // a run may take
  double search_s = 0;      // all runs together may take
};

// Why a curve was followed no further.
enum class CurveEnd {
  met,        // a level meets the error: finer ones cost more
  too_dear,   // its next level would take longer than the best that was found
  too_slow,   // ... than a run may take
  floor,      // three levels that brought nothing: rounding, or something else that stays
  finest,     // no level is left
  untouched,  // its first level would be far dearer than the best
  stopped,    // the search was over before its next level
};
[[nodiscard]] std::string_view to_string(CurveEnd end);

struct AdviceSearch {
  std::vector<AdvicePoint> points;     // in the order they were measured
  std::vector<CurveEnd> ends;          // of the curves
  std::optional<std::size_t> best;     // of the points: the fastest that meets the error
  std::optional<std::size_t> nearest;  // the one of least error
};

// A run that takes over `most_s` may be cut: it cannot be the best.
using MeasureQuarter = std::function<AdvicePoint(std::size_t curve, int quarter, double most_s)>;

// Measures levels, always the one that is expected to take least (by the growth of its curve from the level
// before, which is what steps cost and no order of convergence), until every curve's next level would take
// longer than the best found.  Then the quarters between the last level that fails and the next, halving, on
// each curve where one of them may be the cheapest.  What is recommended has been measured.
[[nodiscard]] AdviceSearch search_advice(const std::vector<AdviceCurve>& curves, const AdviceLimits& limits,
                                         const MeasureQuarter& measure);

}  // namespace ulpgate
