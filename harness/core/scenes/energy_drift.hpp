// How the energy error of a run grows: its largest value, and the slope of its logarithm against that of
// time.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace ulpgate {

// Unbiased rounding makes a conserved quantity walk at random: the error grows as t^(1/2) (D. Brouwer,
// Astron. J. 46 (1937) 149). A slope near 1 means rounding that always errs to one side, one near 0 an error
// that the step bounds.
class EnergyDrift {
 public:
  // Times (s) must not fall; errors in J, of either sign.  A NaN stays the largest for good.
  void add(double time_s, double error_j);

  [[nodiscard]] double largest() const { return largest_; }  // |error|, J
  // Least squares over the last six octaves of time, of the logarithm of the root mean square error in each
  // half octave.  Empty where fewer than six half octaves have eight records each, and where an error is 0
  // throughout one or left the numbers.
  [[nodiscard]] std::optional<double> slope() const;

 private:
  struct Record {
    double time_s;
    double error_j;
  };
  std::vector<Record> records_;
  double largest_ = 0;
};

}  // namespace ulpgate
