// StableSet: the steps at which a linear problem does not grow, found by scanning, with gaps and re-entries.
#pragma once

#include <functional>
#include <optional>
#include <vector>

namespace ulpgate {

// An interval of z = omega dt, and the largest excess met in it.
struct StepInterval {
  double from = 0;
  double to = 0;
  double largest_excess = 0;
  double largest_at = 0;
};

struct StableSet {
  // The unstable intervals in rising order; the last ends at the end of the scan where it is unstable there.
  std::vector<StepInterval> unstable;
  double scanned_to = 0;

  // Where the first unstable interval begins that is wider than 1 % of its place; nothing where none does.
  // The narrower ones before it are gaps.
  [[nodiscard]] std::optional<double> limit() const;
  [[nodiscard]] std::vector<StepInterval> gaps() const;
  // Stable intervals behind the limit.
  [[nodiscard]] std::vector<StepInterval> reentries() const;
};

// The excess of a step over stability at z; NaN or infinity where there is none, which counts as unstable.
using ExcessOfStep = std::function<double(double z)>;
// What of an excess at z may be rounding.
using RoundingOfStep = std::function<double(double z)>;

// Looks at every z in (0, z_max] on a grid of `spacing` and at 2 sin(pi m/n) of small n, never by bisection
// alone.  Where the excess has a local maximum between points of the grid it is searched, so that gaps are
// found that are far narrower than the grid; edges are then bisected to 1e-9 of their place.  Unstable is an
// excess above rounding(z).
[[nodiscard]] StableSet find_stable_set(const ExcessOfStep& excess, const RoundingOfStep& rounding,
                                        double z_max, double spacing);

}  // namespace ulpgate
