// The runs of a history at which a level stepped, found in spite of noise.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace ulpgate {

// What is asked of a step.  level_steps_test.cpp measures how often the defaults see one that is not there.
struct StepRule {
  std::size_t least_side = 3;   // runs before and after it, up to the next step
  double least_shift = 0.0488;  // of logarithms: 5 %
  double standard_errors = 5;   // of the difference of the two levels
  double most_p_value = 0.1;    // of the test of Mann and Whitney: three against three runs reach it
};

struct LevelStep {
  std::size_t at = 0;  // the first value of the new level
  double before = 0;   // the levels on both sides: typical_time of each
  double after = 0;
  double p_value = 1;
};

// How far one value of a row scatters about its level, as a standard deviation: from the differences of
// neighbours, of which a step spoils one.  0 of fewer than two values.
[[nodiscard]] double scatter(std::span<const double> values);
// Of many rows: the scatter that three of four do not exceed.  A single row of ten runs does not know its own
// well enough to be believed where that is smaller.  Rows of fewer than four values do not count.
[[nodiscard]] double common_scatter(const std::vector<std::vector<double>>& rows);

// Whether the level of `after` is another than that of `before`: the difference of their lower quartiles (a
// disturbance adds time) exceeds what StepRule asks for, and Mann and Whitney's test agrees.  `noise` is the
// common scatter; that of the values about their own median counts where it is larger.
[[nodiscard]] bool is_step(std::span<const double> before, std::span<const double> after, double noise,
                           const StepRule& rule, LevelStep& found);

// Steps of a row of logarithms of times, in order.  In intervals of all lengths (seeded as by S. Kovacs, P.
// Buehlmann, H. Li, A. Munk: Seeded binary segmentation, Biometrika 110, 2023) the split that leaves the
// least sum of distances to the medians of its two sides; those that are steps are taken, the shortest
// intervals first (R. Baranowski, Y. Chen, P. Fryzlewicz: Narrowest-over-threshold detection, J. R. Stat.
// Soc. B 81, 2019), and each must be one again between the steps beside it.
[[nodiscard]] std::vector<LevelStep> level_steps(std::span<const double> values, double noise,
                                                 const StepRule& rule = {});

}  // namespace ulpgate
