// NativeStage<Real, W, S>: the C library's function in the wider native type W bounds the errors of a batch.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "harness/core/records/stage.hpp"
#include "harness/core/stages/exact_results.hpp"
#include "harness/core/stages/finding.hpp"
#include "harness/core/stages/native_bits.hpp"
#include "harness/core/stages/ordinary_scan.hpp"
#include "reference/lanes/widening.hpp"

namespace ulpgate {

template <NativeReal Real, NativeBits W, Stage S>
class NativeStage {
 public:
  static constexpr Stage id = S;

  NativeStage(FunctionId f, BoundedFunction<W> function)
      : id_(f),
        parts_(static_cast<std::size_t>(info_of(f).parts)),
        is_real_(info_of(f).function_class == FunctionClass::real),
        unsigned_zeros_(info_of(f).function_class == FunctionClass::special),
        function_(function) {}
  [[nodiscard]] bool exists() const { return function_ != nullptr; }

  // Evaluates the points of `args`, count * arity values.
  void load(std::span<const Real> args, std::size_t count) {
    args_.resize(args.size());
    results_.resize(count * parts_);
    bounds_.resize(count * parts_);
    widen(args);
    function_(args_.data(), results_.data(), bounds_.data(), count, std::numeric_limits<Real>::digits);
  }

  // The loaded points, of one argument each, for scan_ordinary.
  [[nodiscard]] ScanInput scan_input(std::span<const float> args, std::span<const float> results,
                                     std::uint64_t first_index, const ScanLimits& limits) const
      requires(std::same_as<Real, float>&& std::same_as<W, double>) {
    return {args.data(), results.data(), results_.data(), bounds_.data(),
            args.size(), first_index,    limits,          inexact_results(id_)};
  }

  // The same of any number of arguments.
  [[nodiscard]] WideScanInput scan_input(std::span<const double> args, std::span<const double> results,
                                         std::uint64_t first_index, const ScanLimits& limits) const
      requires(std::same_as<Real, double>&& std::same_as<W, DoubleDouble>) {
    const double* single = args.size() == results.size() ? args.data() : nullptr;
    return {single,         results.data(), results_.data(), bounds_.data(),
            results.size(), first_index,    limits,          inexact_results(id_)};
  }

  [[nodiscard]] long double value(std::size_t i, std::size_t part) const {
    return static_cast<long double>(results_[i * parts_ + part]);
  }

  // What is known of `got`, a part of the result at point i of the loaded ones, whose arguments are `args`;
  // false where the stage has no say: special results, results at the ends of the range, refused arguments.
  [[nodiscard]] bool find(std::size_t i, std::size_t part, const Real* args, Real got,
                          Finding& finding) const {
    using L = std::numeric_limits<Real>;
    constexpr int p = L::digits;
    constexpr int least_grid = L::min_exponent - 1;
    constexpr int least_exponent = gradual                         ? least_grid - 200
                                   : far                           ? -16200
                                   : std::same_as<W, DoubleDouble> ? double_double_least
                                                                   : -900;
    constexpr int greatest_exponent = std::min(L::max_exponent - 1, far ? 16200 : 900);
    const W value = results_[i * parts_ + part];
    const NumberBits bits = bits_of(value);
    const NumberBits got_bits = bits_of(got);
    const double bound = bounds_[i * parts_ + part];
    if (bound >= 0 && (got == 0 || !std::isfinite(got))) {
      // A zero without error; the series of a special function define a value, not the sign of its zeros.
      finding = finding_of({});
      if (bound == 0 && got == 0 && value == 0 && (unsigned_zeros_ || std::signbit(got) == signbit_of(value)))
        return true;
      return find_special(args, bits, value, bound, got, finding);
    }
    const int grid = gradual ? std::max(bits.exponent, least_grid) : bits.exponent;
    const int got_grid = gradual ? std::max(got_bits.exponent, least_grid) : got_bits.exponent;
    if (!(bound >= 0) || !bits.normal || !(got_bits.normal || gradual) || bits.exponent < least_exponent ||
        bits.exponent > greatest_exponent || may_overflow(bits, value) || std::abs(got_grid - grid) > 50 ||
        (got < 0) != (value < 0)) {
      return false;
    }
    const W difference = static_cast<W>(got) - value;
    // Of a far exponent too small for a double, and then exact only where it is 0.
    const auto rounded = static_cast<double>(difference);
    // Of two neighbouring numbers the difference is exact (Sterbenz), and it may be a double.
    const bool neighbours =
        got_bits.normal && bits.exponent >= least_grid && std::abs(got_bits.exponent - bits.exponent) <= 1;
    const bool exact = bound == 0 && static_cast<W>(rounded) == difference && (neighbours || difference == 0);
    const double error = std::fabs(scaled(difference, p - 1 - grid));
    const double own_slack = bound * unit + error * 0x1p-48;
    // A known error may be one that RealHP<4> has no bits for.
    const bool inexact = exact ? difference != 0 : error > own_slack;
    const bool known = exact && (difference == 0 || error >= unseen_error);
    // Of a pair next to a number of Real a bound may say more than RealHP<4> has bits for.
    const double slack = known ? 0 : std::same_as<W, DoubleDouble> ? own_slack + full_slack<Real> : own_slack;
    double least = error - slack;
    double greatest = error + slack;
    // Next to a power of two the exact value may lie in the other binade, where the spacing is half or
    // double.
    const bool next_to_power = !exact && may_cross_power(bits, value, slack);
    if (next_to_power) {
      if (bits.fraction == 0) {
        greatest = 2 * (error + 2 * slack);
        least = error - 2 * slack;
      } else {
        least = (error - 2 * slack) / 2;
        greatest = error + 2 * slack;
      }
    }
    if (inexact && std::same_as<W, DoubleDouble> && greatest < unseen_error) {
      least = smallest_error;
    } else if (least <= 0 && !exact) {
      // Too close to tell: exact or not is known by other means.
      const Exactness exactness = bound == 0 ? Exactness::unknown : exactness_of(id_, args, got);
      if (exactness == Exactness::unknown) return false;
      least = smallest_error;
      if (exactness == Exactness::exact) least = greatest = 0;
    }
    finding = {Outcome::finite, least, greatest, 0, true, true};
    if (greatest < 0.5) return true;
    if (least > 0.5) {
      finding.correctly_rounded = false;
    } else if (exact && least == 0.5) {
      finding.correctly_rounded = !got_bits.odd;
    } else {
      return false;
    }
    set_distance(finding, got_grid == grid && !next_to_power);
    return true;
  }

 private:
  void widen(std::span<const Real> args) {
    if constexpr (std::same_as<Real, float> && std::same_as<W, double>) {
      widen_floats(args.data(), args_.data(), args.size());
    } else {
      // A loop that the compiler turns into vectors only when it is told the number of steps.
      constexpr std::size_t step = 8;
      std::size_t i = 0;
      for (; i + step <= args.size(); i += step)
        for (std::size_t j = 0; j < step; ++j) args_[i + j] = args[i + j];
      for (; i < args.size(); ++i) args_[i] = args[i];
    }
  }

  // Whether W has exponents that double has not, and results or errors may have them.
  static constexpr bool far =
      !std::same_as<W, double> && !std::same_as<W, DoubleDouble> && !std::same_as<Real, float>;
  // Below its least normal number a type has one spacing, which W can tell.
  static constexpr bool gradual = std::same_as<Real, float> || (std::same_as<Real, double> && far);
  static constexpr int most_double_exponent = 900;

  // 2^e.
  [[nodiscard]] static W wide_power(int e) {
    if constexpr (far && std::same_as<W, long double>) {
      return std::ldexp(W(1), e);
    } else if constexpr (far) {
      return std::bit_cast<W>(static_cast<unsigned __int128>(e + 16383) << 112U);
    } else {
      return static_cast<W>(power_of_two(e));
    }
  }
  // x 2^e, rounded to double.
  [[nodiscard]] static double scaled(W x, int e) {
    if constexpr (far) {
      // Where x is as far as e, their product is no exponent of double's either way round.
      if (e > most_double_exponent || e < -most_double_exponent)
        return static_cast<double>(x * wide_power(e));
    }
    return static_cast<double>(x) * power_of_two(e);
  }

  // Where the exponent of a value says that it overflows: half an ulp lies between the largest number and
  // this power of two, to which a small bound is little.
  [[nodiscard]] static int least_overflow(double bound) {
    return std::numeric_limits<Real>::max_exponent + (bound * unit <= 0.125 ? 0 : 1);
  }

  // Whether the value is so close to the end of the range, or beyond, that it may be rounded to infinity.
  [[nodiscard]] static bool may_overflow(const NumberBits& bits, W value) {
    using L = std::numeric_limits<Real>;
    if (bits.exponent < L::max_exponent - 1) return false;
    const W size = value < 0 ? -value : value;
    return !(size < static_cast<W>(L::max()));
  }

  // Whether there is a power of two within twice `slack`, in ULP of Real, of the value.
  [[nodiscard]] static bool may_cross_power(const NumberBits& bits, W value, double slack) {
    // 32 bits say whether to look closer: bounds are below 2^20 ulp of W, which has 52 bits behind the first.
    const bool above = bits.fraction == 0;
    if (!above && bits.fraction != 0xffffffffU) return false;
    const W size = value < 0 ? -value : value;
    const W power = wide_power(above ? bits.exponent : bits.exponent + 1);
    const W gap = above ? size - power : power - size;
    return scaled(gap, std::numeric_limits<Real>::digits - 1 - bits.exponent) <= 2 * slack;
  }

  [[nodiscard]] static bool signbit_of(W value) { return std::signbit(static_cast<double>(value)); }

  [[nodiscard]] Finding zero_of_other_sign() const {
    return finding_of(unsigned_zeros_ ? Judgement{} : Judgement{Outcome::zero_sign, {}, 0, false});
  }

  // Results of 0, infinity and NaN: the two agree, or the exact value lies beyond what Real has, for float up
  // to the last rounding.  Where they differ, and closer to the ends, the stage has no say.
  [[nodiscard]] bool find_special(const Real* args, const NumberBits& bits, W value, double bound, Real got,
                                  Finding& finding) const {
    using L = std::numeric_limits<Real>;
    if (std::isnan(got)) {
      finding = finding_of(value == value ? Judgement{Outcome::nan, {}, 0, false} : Judgement{});
      return true;
    }
    if (value != value) return false;
    // A zero of the other sign is one for all numbers that round to zero; it is no rare find, a library that
    // knows no signs of zeros gives it for millions of floats.
    const bool other_sign = std::signbit(got) != signbit_of(value);
    if (other_sign && got != 0) return false;
    if (got != 0) {
      // A pole, or beyond the range by more than the bound.  Where W has the exponents of Real its infinity
      // says too little.
      const bool infinite = value - value != 0;
      if (infinite ? std::same_as<Real, long double> && bound != 2
                   : !bits.normal || bits.exponent < least_overflow(bound))
        return false;
      finding = finding_of({});
      return true;
    }
    // |value| < 2^(exponent + 1), in units of the least subnormal.
    constexpr int least = L::min_exponent - L::digits;
    // A zero that has a bound is none: all functions but real ones tell such (complex_parts.inc).
    const bool told_small = !is_real_ && value == 0 && bound > 0;
    const int zero = bound == 2 ? -20000 : double_double_zero;
    const bool told_size = told_small || std::same_as<W, DoubleDouble>;
    const int exponent = told_size && value == 0 ? zero : bits.exponent;
    const int size = exponent + 1 - least;
    if (size > (gradual ? 0 : -20)) return false;
    if (gradual && size > -20) {
      const double error = std::fabs(scaled(value, -least));
      const double slack = error * (bound * power_of_two(1 - significand_bits<W>) + 0x1p-48);
      finding = {Outcome::finite, error - slack, error + slack, 0, true, true};
      if (!(finding.greatest < 0.5)) return false;
      if (other_sign) finding = zero_of_other_sign();
      return true;
    }
    // Another zero of W may be an exact one.
    if (!bits.normal && !told_small && !(is_never_zero(id_) && std::isfinite(args[0]))) return false;
    // Nor is a zero for numbers of W's own range that the stage does not give (double_lanes.hpp).
    const double greatest = power_of_two(std::max(size, bits.normal || told_size ? -900 : -700) + 1);
    finding = {Outcome::finite, smallest_error, greatest, 0, true, true};
    if (other_sign) finding = zero_of_other_sign();
    return true;
  }

  // One ulp of W in ulp of Real, with a margin.
  static constexpr double unit =
      power_of_two(std::numeric_limits<Real>::digits - significand_bits<W>) * (1 + 0x1p-20);

  FunctionId id_;
  std::size_t parts_;
  bool is_real_;
  bool unsigned_zeros_;
  BoundedFunction<W> function_;
  std::vector<W> args_;
  std::vector<W> results_;
  std::vector<double> bounds_;
};

}  // namespace ulpgate
