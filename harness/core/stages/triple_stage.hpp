// TripleStage: functions in triple-double bound the errors of a batch of binary128 results.
#pragma once

#include <bit>
#include <cmath>
#include <span>
#include <vector>

#include "harness/core/records/stage.hpp"
#include "harness/core/stages/finding.hpp"
#include "harness/core/stages/native_bits.hpp"
#include "reference/triple_double/triple_double_functions.hpp"
#include "reference/types/real_types.hpp"

namespace ulpgate {

#ifdef ULPGATE_HAVE_FLOAT128

class TripleStage {
 public:
  static constexpr Stage id = Stage::triple_double;

  explicit TripleStage(TripleDoubleFunction function) : function_(function) {}
  [[nodiscard]] bool exists() const { return function_ != nullptr; }

  // Evaluates the points of `args`, count * arity values.
  void load(std::span<const Float128Real> args, std::size_t count) {
    args_.resize(args.size());
    results_.resize(count);
    bounds_.resize(count);
    for (std::size_t i = 0; i < args.size(); ++i) args_[i] = triple_of(args[i].backend().value());
    function_(args_.data(), results_.data(), bounds_.data(), count);
  }

  [[nodiscard]] long double value(std::size_t i) const {
    return static_cast<long double>(results_[i].hi) + static_cast<long double>(results_[i].mid);
  }

  // As NativeStage::find.  No say is had of zeros, infinities and what is far from double's exponents, of results that
  // are too close to the value to tell and of what lies next to a power of two.
  [[nodiscard]] bool find(std::size_t i, const Float128Real* /*args*/, const Float128Real& result,
                          Finding& finding) const {
    const TripleDouble value = results_[i];
    const TripleDouble got = triple_of(result.backend().value());
    const double bound = bounds_[i];
    const Binade binade = binade_of(value);
    const Binade got_binade = binade_of(got);
    if (!(bound >= 0) || !binade.known || !got_binade.known || (got.hi < 0) != (value.hi < 0) ||
        std::abs(got_binade.exponent - binade.exponent) > 1) {
      return false;
    }
    // Of neighbours the first difference is exact, and what the others leave out is 2^-157 of the value.
    const double first = got.hi - value.hi;
    const double middle = got.mid - value.mid;
    const double back = middle - got.mid;
    const double middle_rest = (got.mid - (middle - back)) + (-value.mid - back);
    const double sum = first + middle;
    const double sum_back = sum - first;
    const double sum_rest = (first - (sum - sum_back)) + (middle - sum_back);
    const double difference = sum + (sum_rest + (middle_rest + (got.lo - value.lo)));
    const double error = std::fabs(difference) * power_of_two(digits - 1 - binade.exponent);
    const double slack = bound * unit + 0x1p-44 + error * 0x1p-48;
    finding = {Outcome::finite, error - slack, error + slack, 0, true, true};
    if (finding.least <= 0) return false;
    if (finding.greatest < 0.5) return true;
    if (!(finding.least > 0.5)) return false;
    finding.correctly_rounded = false;
    set_distance(finding, got_binade.exponent == binade.exponent);
    return true;
  }

 private:
  static constexpr int digits = 113;
  static constexpr int most_exponent = 850;
  // One ulp of a triple in ulp of binary128, with a margin.
  static constexpr double unit = power_of_two(digits - triple_double_bits) * (1 + 0x1p-20);

  // Exactly; NaN for what has exponents that double has not, or none.
  static TripleDouble triple_of(Binary128 x) {
    const auto bits = std::bit_cast<unsigned __int128>(x);
    const auto high = static_cast<std::uint64_t>(bits >> 64U);
    const auto low = static_cast<std::uint64_t>(bits);
    const int e = static_cast<int>((high >> 48U) & 0x7fffU) - 16383;
    if (e < -most_exponent || e > most_exponent) return {std::nan(""), 0, 0};
    // 53, 53 and 7 bits of one sign, and in the order of floating-point numbers.
    const double sign = (high >> 63U) != 0 ? -1 : 1;
    const std::uint64_t significand = (high & 0xffffffffffffU) | 0x1000000000000U;  // 49 bits
    const double power = sign * power_of_two(e);
    const double a = static_cast<double>((significand << 4U) | (low >> 60U)) * 0x1p-52 * power;
    const double b = static_cast<double>((low >> 7U) & 0x1fffffffffffffU) * 0x1p-105 * power;
    const double c = static_cast<double>(low & 0x7fU) * 0x1p-112 * power;
    const double bc = b + c;
    const double hi = a + bc;
    const double rest = bc - (hi - a);
    const double mid = rest + (c - (bc - b));
    return {hi, mid, (c - (bc - b)) - (mid - rest)};
  }

  // The binade of a number; below a power of two, where its other parts are of the other sign, lies another.
  struct Binade {
    int exponent;
    bool known;
  };
  static Binade binade_of(const TripleDouble& x) {
    const auto bits = std::bit_cast<std::uint64_t>(x.hi);
    const int e = static_cast<int>((bits >> 52U) & 0x7ffU) - 1023;
    const bool is_power = (bits & 0xfffffffffffffU) == 0;
    return {e, e >= -most_exponent && e <= most_exponent && !is_power};
  }

  TripleDoubleFunction function_;
  std::vector<TripleDouble> args_;
  std::vector<TripleDouble> results_;
  std::vector<double> bounds_;
};

#endif

}  // namespace ulpgate
