// Baseline.
#include "harness/app/run/baseline.hpp"

#include <chrono>

namespace ulpgate::app {

double baseline_sample_s(int operations) {
  const auto start = std::chrono::steady_clock::now();
  double x = 0.5;
  for (int i = 0; i < operations; ++i) x = 3.75 * x * (1 - x);
  // So that nobody finds out that the result is not needed.
  volatile double sink = x;
  static_cast<void>(sink);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace ulpgate::app
