// Functions in lanes of binary64, for processors with and without fused multiply-add.
#include "reference/double_lanes/double_lanes.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <numbers>

#include "reference/double_lanes/large_angles.hpp"
#include "reference/lanes/levels.hpp"

namespace ulpgate {

namespace {

constexpr double ln2 = std::numbers::ln2;
constexpr double ln2_high = 0x1.62e42fefap-1;
constexpr double ln2_low = 0x1.cf79abc9e3b3ap-40;
constexpr double inverse_ln2 = std::numbers::log2e;
constexpr double inverse_ln10 = std::numbers::log10e;
constexpr double half_pi = std::numbers::pi / 2;
constexpr double half_pi_1 = 0x1.921fb54p0;
constexpr double half_pi_2 = 0x1.10b4610p-30;
constexpr double half_pi_3 = 0x1.a62633145c06ep-58;
constexpr double two_over_pi = 2 * std::numbers::inv_pi;
constexpr double inverse_pi = std::numbers::inv_pi;
constexpr double half_log_two_pi = 0x1.d67f1c864beb5p-1;
// The upper half of the bits of 1, four thirds of its exponent, less a bias that halves the largest error.
constexpr double cbrt_guess = 0x3ff00000 * (4.0 / 3) - 0x12000;

constexpr double factorial(std::size_t n) {
  double product = 1;
  for (std::size_t i = 2; i <= n; ++i) product *= static_cast<double>(i);
  return product;
}
template <std::size_t n, class F>
constexpr std::array<double, n> listed(F f) {
  std::array<double, n> list{};
  for (std::size_t i = 0; i < n; ++i) list[i] = f(i);
  return list;
}
constexpr double sign_of(std::size_t i) {
  return i % 2 == 0 ? 1 : -1;
}

constexpr auto exp_terms = listed<11>([](std::size_t n) { return 1 / factorial(n + 2); });
constexpr auto sine_terms = listed<7>([](std::size_t n) { return -sign_of(n) / factorial(2 * n + 3); });
constexpr auto cosine_terms = listed<7>([](std::size_t n) { return sign_of(n) / factorial(2 * n + 4); });
constexpr auto atanh_terms = listed<8>([](std::size_t n) { return 1.0 / static_cast<double>(2 * n + 3); });
constexpr auto atan_terms =
    listed<18>([](std::size_t n) { return -sign_of(n) / static_cast<double>(2 * n + 3); });
// (2m)! / (4^m m!^2 (2m + 1)), m = n + 1
constexpr auto asin_terms = listed<20>([](std::size_t n) {
  double c = 1;
  for (std::size_t m = 1; m <= n + 1; ++m) c *= static_cast<double>(2 * m - 1) / static_cast<double>(2 * m);
  return c / static_cast<double>(2 * n + 3);
});
constexpr std::array<double, 3> cbrt_terms = {1.0 / 3, 2.0 / 9, 14.0 / 81};
constexpr auto erf_terms = listed<18>([](std::size_t n) {
  return 2 * std::numbers::inv_sqrtpi * sign_of(n) / (factorial(n) * static_cast<double>(2 * n + 1));
});
constexpr std::array<double, 6> stirling_terms = {1.0 / 12,    -1.0 / 360, 1.0 / 1260,
                                                  -1.0 / 1680, 1.0 / 1188, -691.0 / 360360};
// e^(-k^2/4), k = n + 1
constexpr auto trapezoid_terms = listed<12>([](std::size_t n) {
  double e = 1;
  for (std::size_t i = 0; i < (n + 1) * (n + 1); ++i) e *= 0.7788007830714049;
  return e;
});

#define ULPGATE_LEVEL_FILE "reference/double_lanes/instruction_set.inc"
#include "reference/lanes/each_level.inc"

}  // namespace

BoundedFunction<double> double_lanes_function(FunctionId id, [[maybe_unused]] std::size_t level) {
#ifdef ULPGATE_LEVELS
  if (level == 2) return avx512::function_of(id);
  if (level == 1) return avx2::function_of(id);
#endif
  return baseline::function_of(id);
}

BoundedFunction<double> double_lanes_function(FunctionId id) {
  static const std::size_t best = instruction_levels() - 1;
  return double_lanes_function(id, best);
}

}  // namespace ulpgate
