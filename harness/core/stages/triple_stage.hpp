// TripleStage: functions in triple-double bound the errors of a batch of binary128 results.
#pragma once

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

class TripleStage {
 public:
  static constexpr Stage id = Stage::triple_double;

  TripleStage(FunctionId f, TripleDoubleFunction function)
      : id_(f),
        function_(function),
        of_turns_(triple_double_function_of_turns(f)),
        inexact_(inexact_results(f)) {}
  [[nodiscard]] bool exists() const { return function_ != nullptr; }

  // Evaluates the points of `args`, count * arity values.
  void load(std::span<const Float128Real> args, std::size_t count) {
    args_.resize(args.size());
    results_.resize(count);
    bounds_.resize(count);
    for (std::size_t i = 0; i < args.size(); ++i) args_[i] = triple_of(args[i].backend().value());
    function_(args_.data(), results_.data(), bounds_.data(), count);
    if (of_turns_ != nullptr) load_large_angles(args);
  }

  [[nodiscard]] long double value(std::size_t i) const {
    return static_cast<long double>(results_[i].hi) + static_cast<long double>(results_[i].mid);
  }

  // As NativeStage::find.  No say is had of zeros, infinities and what is far from double's exponents, and of most results
  // that are too close to the value to tell.
  [[nodiscard]] bool find(std::size_t i, const Float128Real* args, const Float128Real& result,
                          Finding& finding) const {
    if (id_ == FunctionId::add || id_ == FunctionId::sub) return find_sum(args, result, finding);
    if (find_next_to_0(args[0].backend().value(), result.backend().value(), finding)) return true;
    const TripleDouble value = results_[i];
    const TripleDouble got = triple_of(result.backend().value());
    const double bound = bounds_[i];
    const Binade binade = binade_of(value);
    const Binade got_binade = binade_of(got);
    if (!(bound >= 0) || !binade.known || !got_binade.known || (got.hi < 0) != (value.hi < 0) ||
        std::abs(got_binade.exponent - binade.exponent) > 1) {
      return false;
    }
    const double ulps = power_of_two(digits - 1 - binade.exponent);
    const double error = std::fabs(difference(got, value)) * ulps;
    const double slack = bound * unit + 0x1p-44 + error * 0x1p-48;
    double least = error - slack;
    double greatest = error + slack;
    // Next to a power of two the exact value may lie in the other binade, where the spacing is half or double.
    const bool next_to_power = binade.is_power && std::fabs(value.mid + value.lo) * ulps <= 2 * slack;
    if (next_to_power) {
      least = (error - 2 * slack) / 2;
      greatest = 2 * (error + 2 * slack);
    }
    if (least <= 0) {
      if (!is_inexact(i, got)) return false;
      least = smallest_error;
    }
    finding = {Outcome::finite, least, greatest, 0, true, true};
    if (greatest < 0.5) return true;
    if (!(least > 0.5)) return false;
    finding.correctly_rounded = false;
    set_distance(finding, got_binade.exponent == binade.exponent && !next_to_power);
    return true;
  }

 private:
  static constexpr int digits = 113;
  static constexpr int most_exponent = 850;
  // One ulp of a triple in ulp of binary128, with a margin.
  static constexpr double unit = power_of_two(digits - triple_double_bits) * (1 + 0x1p-20);

  // Sines and their like beyond 2^30.
  void load_large_angles(std::span<const Float128Real> args) {
    turns_.clear();
    large_.clear();
    for (std::size_t i = 0; i < args.size(); ++i) {
      const auto bits = std::bit_cast<unsigned __int128>(args[i].backend().value());
      const auto high = static_cast<std::uint64_t>(bits >> 64U);
      const int e = static_cast<int>((high >> 48U) & 0x7fffU) - 16383;
      if (e < 30 || e > 16383) continue;
      QuarterTurns t = quarter_turns((high & 0xffffffffffffU) | 0x1000000000000U, static_cast<std::uint64_t>(bits), e);
      if ((high >> 63U) != 0) t = {{-t.fraction.hi, -t.fraction.mid, -t.fraction.lo}, (4 - t.quadrant) & 3};
      turns_.push_back(t.fraction);
      turns_.push_back({static_cast<double>(t.quadrant), 0, 0});
      large_.push_back(i);
    }
    large_results_.resize(large_.size());
    large_bounds_.resize(large_.size());
    of_turns_(turns_.data(), large_results_.data(), large_bounds_.data(), large_.size());
    for (std::size_t j = 0; j < large_.size(); ++j) {
      results_[large_[j]] = large_results_[j];
      bounds_[large_[j]] = large_bounds_[j];
    }
  }

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

  // The error of a rounded sum is a number, too (Knuth's two-sum), ties and exact sums included.
  [[nodiscard]] bool find_sum(const Float128Real* args, const Float128Real& result, Finding& finding) const {
    const Binary128 x = args[0].backend().value();
    const Binary128 y = id_ == FunctionId::sub ? -args[1].backend().value() : args[1].backend().value();
    const Binary128 got = result.backend().value();
    const NumberBits bits = bits_of(got);
    if (x + y != got || !bits.normal || bits.exponent > 16000 || bits.exponent < -16000) return false;
    const Binary128 back = got - x;
    const Binary128 rest = (x - (got - back)) + (y - back);
    // A power of two has its spacing above; below it is half of that.
    const auto significand = std::bit_cast<unsigned __int128>(got) << 16U;
    const bool below = significand == 0 && rest != 0 && (rest < 0) != (got < 0);
    const int grid = bits.exponent - (below ? 1 : 0);
    const auto power = std::bit_cast<Binary128>(static_cast<unsigned __int128>(digits - 1 - grid + 16383) << 112U);
    const Binary128 exact = rest < 0 ? -rest * power : rest * power;
    const auto error = static_cast<double>(exact);
    const double slack = static_cast<Binary128>(error) == exact ? 0 : error * 0x1p-52;
    finding = {Outcome::finite, error - slack, error + slack, 0, true, true};
    // Too small for a double, or for the full reference to see.
    constexpr double tiny = 0x1p-300;
    if (rest != 0 && error < tiny) {
      finding.least = smallest_error;
      finding.greatest = tiny;
    }
    return true;
  }

  // Next to 0 these are their argument or 1, but for a part of 2^-180 of it and less, which they never are exactly.
  [[nodiscard]] bool find_next_to_0(Binary128 x, Binary128 got, Finding& finding) const {
    constexpr Binary128 small = 0x1p-180;
    if (!(x < small && x > -small) || x == 0) return false;
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
        if (got != x) return false;
        break;
      case FunctionId::cos:
      case FunctionId::cosh:
      case FunctionId::exp:
      case FunctionId::exp2:
      case FunctionId::erfc:
        if (got != 1) return false;
        break;
      default:
        return false;
    }
    finding = {Outcome::finite, smallest_error, 0x1p-60, 0, true, true};
    return true;
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
  TripleDoubleFunction of_turns_;
  InexactResults inexact_;
  std::vector<TripleDouble> args_;
  std::vector<TripleDouble> results_;
  std::vector<double> bounds_;
  std::vector<std::size_t> large_;  // the points with large angles, what they are made of and what comes out
  std::vector<TripleDouble> turns_;
  std::vector<TripleDouble> large_results_;
  std::vector<double> large_bounds_;
};

#endif

}  // namespace ulpgate
