// TripleStage<Real>: functions in triple-double bound the errors of a batch of results, of binary128 and of
// what is narrower.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>
#include <vector>

#include "harness/core/records/stage.hpp"
#include "harness/core/stages/exact_results.hpp"
#include "harness/core/stages/finding.hpp"
#include "harness/core/stages/native_bits.hpp"
#include "reference/triple_double/large_angles.hpp"
#include "reference/triple_double/triple_double_functions.hpp"
#include "reference/types/real_types.hpp"

namespace ulpgate {

#ifdef ULPGATE_HAVE_FLOAT128

template <class Real>
concept UpToBinary128 = NativeReal<Real> || Float128Backed<Real>;

template <UpToBinary128 Real>
class TripleStage {
 public:
  static constexpr Stage id = Stage::triple_double;

  TripleStage(FunctionId f, TripleDoubleFunction function)
      : id_(f),
        function_(function),
        prepared_(prepared_triple_double_function(prepared_id(f))),
        inexact_(inexact_results(f)) {}
  [[nodiscard]] bool exists() const { return function_ != nullptr; }

  // Evaluates the points of `args`, count * arity values.
  void load(std::span<const Real> args, std::size_t count) {
    args_.resize(args.size());
    results_.resize(count);
    bounds_.resize(count);
    scales_.assign(count, 0);
    const std::size_t arity = args.size() / count;
    for (std::size_t i = 0; i < count; ++i) load_point(&args[arity * i], &args_[arity * i], scales_[i]);
    more_scales_.resize(count);
    function_(args_.data(), results_.data(), more_scales_.data(), bounds_.data(), count);
    for (std::size_t i = 0; i < count; ++i)
      if (bounds_[i] >= 0) scales_[i] += static_cast<int>(more_scales_[i]);
    if (prepared_ != nullptr) load_prepared(args);
  }

  [[nodiscard]] long double value(std::size_t i, std::size_t /*part*/) const {
    return std::ldexp(static_cast<long double>(results_[i].hi) + static_cast<long double>(results_[i].mid),
                      scales_[i]);
  }

  // As NativeStage::find.  No say is had of zeros, infinities and what is far from double's exponents, and,
  // of binary128, of most results that are too close to the value to tell; of narrower types, which this only
  // checks, their error is at least 0, exact or not.
  [[nodiscard]] bool find(std::size_t i, std::size_t /*part*/, const Real* args, const Real& result,
                          Finding& finding) const {
    if constexpr (digits == 113) {
      if (id_ == FunctionId::add || id_ == FunctionId::sub) return find_sum(args, result, finding);
    }
    if (find_next_to_limit(number(args[0]), number(result), finding)) return true;
    const TripleDouble value = results_[i];
    const TripleDouble got = triple_of(number(result), scales_[i]);
    const double bound = bounds_[i];
    const Binade binade = binade_of(value);
    const Binade got_binade = binade_of(got);
    if (!(bound >= 0) || !binade.known || !got_binade.known || (got.hi < 0) != (value.hi < 0) ||
        std::abs(got_binade.exponent - binade.exponent) > 1 ||
        binade.exponent + scales_[i] < std::numeric_limits<Real>::min_exponent + 1 ||
        binade.exponent + scales_[i] > std::numeric_limits<Real>::max_exponent - 3) {
      return false;
    }
    const double ulps = power_of_two(digits - 1 - binade.exponent);
    const double error = std::fabs(difference(got, value)) * ulps;
    const double slack = bound * unit + least_slack + error * 0x1p-48;
    double least = error - slack;
    double greatest = error + slack;
    // Next to a power of two the exact value may lie in the other binade, where the spacing is half or
    // double.
    const bool next_to_power = binade.is_power && std::fabs(value.mid + value.lo) * ulps <= 2 * slack;
    if (next_to_power) {
      least = (error - 2 * slack) / 2;
      greatest = 2 * (error + 2 * slack);
    }
    if (least <= 0) {
      const bool inexact = is_inexact(i, got);
      if (digits == 113 && !inexact) return false;
      least = inexact ? smallest_error : 0;
    }
    if (greatest < unseen_error) least = std::min(least, smallest_error);
    finding = {Outcome::finite, least, greatest, 0, true, true};
    if (greatest < 0.5) return true;
    if (!(least > 0.5)) return false;
    finding.correctly_rounded = false;
    set_distance(finding, got_binade.exponent == binade.exponent && !next_to_power);
    return true;
  }

 private:
  static constexpr int digits = std::numeric_limits<Real>::digits;
  static constexpr int most_exponent = 850;
  // One ulp of a triple in ulp of Real, with a margin, and what the difference of two of them is off by, and
  // RealHP<4> beside it.
  static constexpr double unit = power_of_two(digits - triple_double_bits) * (1 + 0x1p-20);
  static constexpr double least_slack = power_of_two(digits - 157) + full_slack<Real>;

  static constexpr int greatest_exponent = 16383;
  static constexpr int no_exponent = -100000;
  // Of a normal number.
  static int exponent_of(Binary128 x) {
    const NumberBits bits = bits_of(x);
    return bits.normal ? bits.exponent : no_exponent;
  }
  static Binary128 number(const Real& x) {
    if constexpr (NativeReal<Real>) {
      return x;
    } else {
      return x.backend().value();
    }
  }

  static TripleDouble signed_power(Binary128 sign, int e) {
    return {sign < 0 ? -power_of_two(e) : power_of_two(e), 0, 0};
  }

  // The arguments, and the exponent that the result has beside what is evaluated: those which products,
  // quotients and roots are scaled by.
  void load_point(const Real* from, TripleDouble* to, int& scale) const {
    const Binary128 x = number(from[0]);
    const int e = exponent_of(x);
    switch (id_) {
      case FunctionId::mul:
      case FunctionId::div: {
        const Binary128 y = number(from[1]);
        const int f = exponent_of(y);
        to[0] = triple_of(x, e);
        to[1] = triple_of(y, f);
        scale = id_ == FunctionId::mul ? e + f : e - f;
        return;
      }
      case FunctionId::sqrt:
        scale = e >> 1;
        to[0] = triple_of(x, 2 * scale);
        return;
      case FunctionId::cbrt:
        scale = (e + 30000) / 3 - 10000;
        to[0] = triple_of(x, 3 * scale);
        return;
      case FunctionId::hypot:
      case FunctionId::atan2: {
        const Binary128 y = number(from[1]);
        const int both = std::max(e, exponent_of(y));
        to[0] = triple_of(x, both);
        to[1] = triple_of(y, both);
        scale = id_ == FunctionId::hypot ? both : 0;
        return;
      }
      case FunctionId::atan:
        // pi/2 and pi/2 - 2^-300 are the same here.
        to[0] = e > 300 ? signed_power(x, 300) : triple_of(x);
        return;
      case FunctionId::acos:
        to[0] = e < -300 && e != no_exponent ? signed_power(x, -300) : triple_of(x);
        return;
      case FunctionId::erf:
        // Next to 0 it is a line.
        scale = e < -300 && e != no_exponent ? e + 300 : 0;
        to[0] = triple_of(x, scale);
        return;
      default:
        to[0] = triple_of(x);
        for (std::size_t k = 1;
             k < (id_ == FunctionId::add || id_ == FunctionId::sub || id_ == FunctionId::pow ? 2 : 1); ++k)
          to[k] = triple_of(number(from[k]));
        return;
    }
  }

  // Which prepared function has the numbers that this one leaves to it.
  static FunctionId prepared_id(FunctionId f) {
    const bool far_logarithm = f == FunctionId::log1p || f == FunctionId::asinh || f == FunctionId::acosh;
    return far_logarithm ? FunctionId::log : f;
  }
  // Sines and their like beyond 2^30, logarithms of what has exponents that double has not.
  void load_prepared(std::span<const Real> args) {
    prepared_args_.clear();
    prepared_points_.clear();
    for (std::size_t i = 0; i < args.size(); ++i) {
      const Binary128 x = number(args[i]);
      const int e = exponent_of(x);
      if (e == no_exponent) continue;
      switch (id_) {
        case FunctionId::sin:
        case FunctionId::cos:
        case FunctionId::tan:
          if (e >= 30) prepare_angle(x, e, i);
          break;
        case FunctionId::log:
        case FunctionId::log2:
        case FunctionId::log10:
          if (std::abs(e) > most_exponent && x > 0) prepare_logarithm(x, e, e, i);
          break;
        case FunctionId::log1p:
          if (e > most_exponent && x > 0) prepare_logarithm(x, e, e, i);
          break;
        default:
          // asinh x = log 2x, acosh x = log 2x.
          if (e > most_exponent) prepare_logarithm(x < 0 ? -x : x, e, e + 1, i);
          break;
      }
    }
    prepared_results_.resize(prepared_points_.size());
    prepared_bounds_.resize(prepared_points_.size());
    more_scales_.resize(prepared_points_.size());
    prepared_(prepared_args_.data(), prepared_results_.data(), more_scales_.data(), prepared_bounds_.data(),
              prepared_points_.size());
    for (std::size_t j = 0; j < prepared_points_.size(); ++j) {
      const std::size_t i = prepared_points_[j];
      const TripleDouble& r = prepared_results_[j];
      const bool negative = id_ == FunctionId::asinh && number(args[i]) < 0;
      results_[i] = negative ? TripleDouble{-r.hi, -r.mid, -r.lo} : r;
      bounds_[i] = prepared_bounds_[j];
    }
  }
  void prepare_angle(Binary128 x, int e, std::size_t i) {
    const auto bits = std::bit_cast<unsigned __int128>(x);
    const auto high = static_cast<std::uint64_t>(bits >> 64U);
    QuarterTurns t =
        quarter_turns((high & 0xffffffffffffU) | 0x1000000000000U, static_cast<std::uint64_t>(bits), e);
    if (x < 0) t = {{-t.fraction.hi, -t.fraction.mid, -t.fraction.lo}, (4 - t.quadrant) & 3};
    prepared_args_.push_back(t.fraction);
    prepared_args_.push_back({static_cast<double>(t.quadrant), 0, 0});
    prepared_points_.push_back(i);
  }
  void prepare_logarithm(Binary128 x, int e, int shift, std::size_t i) {
    prepared_args_.push_back(triple_of(x, e));
    prepared_args_.push_back({static_cast<double>(shift), 0, 0});
    prepared_points_.push_back(i);
  }

  // x 2^-scale, exactly; NaN for what has exponents that double has not, or none.
  static TripleDouble triple_of(Binary128 x, int scale = 0) {
    const auto bits = std::bit_cast<unsigned __int128>(x);
    const auto high = static_cast<std::uint64_t>(bits >> 64U);
    const auto low = static_cast<std::uint64_t>(bits);
    const int biased = static_cast<int>((high >> 48U) & 0x7fffU);
    const int e = biased - greatest_exponent - scale;
    if (biased == 0 || biased == 0x7fff || e < -most_exponent || e > most_exponent)
      return {std::nan(""), 0, 0};
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

  // The error of a rounded sum is a number, too (Knuth's two-sum), ties and exact sums included.
  [[nodiscard]] bool find_sum(const Real* args, const Real& result, Finding& finding) const {
    const Binary128 x = number(args[0]);
    const Binary128 y = id_ == FunctionId::sub ? -number(args[1]) : number(args[1]);
    const Binary128 got = number(result);
    const NumberBits bits = bits_of(got);
    if (x + y != got || !bits.normal || bits.exponent > 16000 || bits.exponent < -16000) return false;
    const Binary128 back = got - x;
    const Binary128 rest = (x - (got - back)) + (y - back);
    // A power of two has its spacing above; below it is half of that.
    const auto significand = std::bit_cast<unsigned __int128>(got) << 16U;
    const bool below = significand == 0 && rest != 0 && (rest < 0) != (got < 0);
    const int grid = bits.exponent - (below ? 1 : 0);
    const auto power =
        std::bit_cast<Binary128>(static_cast<unsigned __int128>(digits - 1 - grid + 16383) << 112U);
    const Binary128 exact = rest < 0 ? -rest * power : rest * power;
    const auto error = static_cast<double>(exact);
    // The sum has more bits than the full reference where the terms are that far apart: what it rounds is
    // more than what a double does of so small an error.
    constexpr double seen_whole = 0x1p-150;
    constexpr double rounded = power_of_two(digits + 2 - std::numeric_limits<RealHP<4, Real>>::digits);
    static_assert(2 * digits + 150 < std::numeric_limits<RealHP<4, Real>>::digits);
    const double slack = (static_cast<Binary128>(error) == exact ? 0 : error * 0x1p-52) +
                         (rest != 0 && error < seen_whole ? rounded : 0);
    finding = {Outcome::finite, error - slack, error + slack, 0, true, true};
    // Too small for a double, or for the full reference to see.
    constexpr double tiny = 0x1p-300;
    if (rest != 0 && error < tiny) {
      finding.least = smallest_error;
      finding.greatest = tiny;
    }
    return true;
  }

  // Next to 0 these are their argument or 1, and far from it -1 or 1, but for a part of 2^-180 of it and
  // less, which they never are exactly.
  [[nodiscard]] bool find_next_to_limit(Binary128 x, Binary128 got, Finding& finding) const {
    constexpr Binary128 small = 0x1p-180;
    constexpr Binary128 far = 0x1p10;
    const bool is_far = (x > far || x < -far) && x - x == 0;
    if (is_far ? got != (x < 0 ? -1 : 1) : x == 0 || !(x < small && x > -small)) return false;
    if (is_far && id_ != FunctionId::tanh && id_ != FunctionId::erf) return false;
    if (!is_far && !is_limit_at_0(x, got)) return false;
    finding = {Outcome::finite, smallest_error, 0x1p-60, 0, true, true};
    return true;
  }
  [[nodiscard]] bool is_limit_at_0(Binary128 x, Binary128 got) const {
    switch (id_) {
      case FunctionId::sin:
      case FunctionId::tan:
      case FunctionId::asin:
      case FunctionId::atan:
      case FunctionId::sinh:
      case FunctionId::tanh:
      case FunctionId::asinh:
      case FunctionId::atanh:
      case FunctionId::expm1:
      case FunctionId::log1p:
        return got == x;
      case FunctionId::cos:
      case FunctionId::cosh:
      case FunctionId::exp:
      case FunctionId::exp2:
      case FunctionId::erfc:
        return got == 1;
      default:
        return false;
    }
  }

  // Of neighbours, within 2^-157 of them: the first difference is exact.
  static double difference(const TripleDouble& x, const TripleDouble& y) {
    const double first = x.hi - y.hi;
    const double middle = x.mid - y.mid;
    const double back = middle - x.mid;
    const double middle_rest = (x.mid - (middle - back)) + (-y.mid - back);
    const double sum = first + middle;
    const double sum_back = sum - first;
    const double sum_rest = (first - (sum - sum_back)) + (middle - sum_back);
    return sum + (sum_rest + (middle_rest + (x.lo - y.lo)));
  }

  // The binade of a number: where hi is a power of two and what follows is of the other sign, the one below.
  struct Binade {
    int exponent;
    bool is_power;
    bool known;
  };
  static Binade binade_of(const TripleDouble& x) {
    const auto bits = std::bit_cast<std::uint64_t>(x.hi);
    const int e = static_cast<int>((bits >> 52U) & 0x7ffU) - 1023;
    const bool is_power = (bits & 0xfffffffffffffU) == 0;
    const bool below = is_power && x.mid != 0 && (x.mid < 0) != (x.hi < 0);
    return {below ? e - 1 : e, is_power, e >= -most_exponent && e <= most_exponent};
  }

  // Whether a result of a function of one argument is surely not the exact value.
  [[nodiscard]] bool is_inexact(std::size_t i, const TripleDouble& got) const {
    if (args_.size() != results_.size()) return false;
    const TripleDouble& x = args_[i];
    const double size = std::fabs(x.hi);
    const bool is_one = x.hi == 1 && x.mid == 0;
    const bool is_double = got.mid == 0;
    const double result = std::fabs(got.hi);
    return size > 0 && ((!is_one && size < inexact_.arguments_below) ||
                        (is_double && (result == inexact_.result_a || result == inexact_.result_b)));
  }

  FunctionId id_;
  TripleDoubleFunction function_;
  TripleDoubleFunction prepared_;
  InexactResults inexact_;
  std::vector<TripleDouble> args_;
  std::vector<TripleDouble> results_;
  std::vector<double> bounds_;
  std::vector<int> scales_;
  std::vector<double> more_scales_;
  std::vector<std::size_t>
      prepared_points_;  // the points of prepared functions, what they are made of and what comes out
  std::vector<TripleDouble> prepared_args_;
  std::vector<TripleDouble> prepared_results_;
  std::vector<double> prepared_bounds_;
};

#endif

}  // namespace ulpgate
