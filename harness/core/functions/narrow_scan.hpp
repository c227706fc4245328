// NarrowScan<Real>: looks at a block of many arguments through a cheap reference, and names the one where the
// function is furthest from it.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "harness/core/arguments/narrow_arguments.hpp"
#include "harness/core/arguments/sampling.hpp"
#include "harness/core/functions/calls_in_hand.hpp"
#include "harness/core/stages/native_bits.hpp"
#include "kernels/math/function_table.hpp"
#include "reference/types/real_types.hpp"

namespace ulpgate {

// Arguments that stand behind one sample of the stratum `narrow`: a power of two from a fixed table of costs,
// so that a run of any function takes about as long; 0 where the function has no cheap reference.
[[nodiscard]] std::size_t narrow_block(const FunctionInfo& f, bool binary32);

// The type whose functions are the cheap reference (native_functions.hpp); void where there is none.
template <class Real>
struct NarrowReference {
  using type = void;
};
template <>
struct NarrowReference<float> {
  using type = double;
};
template <>
struct NarrowReference<double> {
  using type = std::conditional_t<std::numeric_limits<long double>::digits == 64, long double, void>;
};
template <class Real>
inline constexpr bool has_narrow_scan = !std::is_void_v<typename NarrowReference<Real>::type>;

// Whatever the cheap reference says is a suspicion, by which arguments are ranked; the sample is judged like
// any other.  One object per thread.
template <class Real>
class NarrowScan {
 public:
  using Wide = typename NarrowReference<Real>::type;

  NarrowScan(const FunctionInfo& f, BatchFunction<Real> call, std::uint64_t seed)
      : function_(f),
        arity_(static_cast<std::size_t>(f.arity)),
        block_(narrow_block(f, std::same_as<Real, float>)),
        arguments_(f, seed),
        call_(call),
        reference_(bounded_function<Wide>(f.id)),
        args_(some * arity_),
        results_(some),
        threw_(some),
        wide_args_(some * arity_),
        wide_(some),
        bounds_(some) {}

  // Writes the most suspicious argument of block k to out, the first of those that are equally so.
  void choose(std::uint64_t k, Real* out) {
    double worst = -std::numeric_limits<double>::infinity();
    const CallsInHand<Real> calls(function_, call_, args_);
    const HandScope hand(calls);
    Heartbeat& heart = Heartbeat::mine();
    for (std::size_t done = 0; done < block_; done += some) {
      arguments_.fill(k * block_ + done, some, args_.data());
      // A block of which nothing is known has a sample too: one of its own arguments.
      if (done == 0) std::copy_n(args_.begin(), arity_, out);
      std::fill(threw_.begin(), threw_.end(), std::uint8_t{0});
      heart.beat(WorkPhase::calls, some);
      call_(args_.data(), results_.data(), threw_.data(), some);
      std::copy(args_.begin(), args_.end(), wide_args_.begin());
      heart.beat(WorkPhase::references, some);
      reference_(wide_args_.data(), wide_.data(), bounds_.data(), some, std::numeric_limits<Real>::digits);
      for (std::size_t i = 0; i < some; ++i) {
        const double s = threw_[i] != 0 ? HUGE_VAL : suspicion(results_[i], wide_[i], bounds_[i]);
        if (!(s > worst)) continue;
        worst = s;
        std::copy_n(&args_[i * arity_], arity_, out);
      }
    }
  }

  // The error in ULP of Real that `got` surely has if |value - exact| is at most `bound` ulp of Wide,
  // negative where it may have none; infinity where one is a NaN, an infinity or a signed zero and the other
  // is not.
  [[nodiscard]] static double suspicion(Real got, Wide value, double bound) {
    using L = std::numeric_limits<Real>;
    if (!(bound >= 0)) return -HUGE_VAL;
    if (got != got || value != value) return got != got && value != value ? 0 : HUGE_VAL;
    const bool same_sign = std::signbit(got) == std::signbit(value);
    const Wide size = value < 0 ? -value : value;
    constexpr Wide overflow = static_cast<Wide>(L::max()) * (1 + static_cast<Wide>(L::epsilon()) / 4);
    if (got - got != 0 || size - size != 0)
      return got - got != 0 && same_sign && size >= overflow ? 0 : HUGE_VAL;
    if (value == 0) return got == 0 && same_sign ? 0 : HUGE_VAL;
    const int grid = std::max(bits_of(value).exponent, L::min_exponent - 1);
    const Wide difference = static_cast<Wide>(got) - value;
    // In two steps, since one may be beyond the range of the powers.
    const int half = grid / 2;
    const auto error = static_cast<double>((difference < 0 ? -difference : difference) * power_of_two(-half) *
                                           power_of_two(L::digits - 1 - (grid - half)));
    return error - bound * power_of_two(L::digits - std::numeric_limits<Wide>::digits);
  }

 private:
  static constexpr std::size_t some = 256;

  const FunctionInfo& function_;
  std::size_t arity_;
  std::size_t block_;
  NarrowArguments<Real> arguments_;
  BatchFunction<Real> call_;
  BoundedFunction<Wide> reference_;
  std::vector<Real> args_;
  std::vector<Real> results_;
  std::vector<std::uint8_t> threw_;
  std::vector<Wide> wide_args_;
  std::vector<Wide> wide_;
  std::vector<double> bounds_;
};

// The points of any stratum of a function: those of `narrow` are chosen by a scan of their blocks.
template <RealType Real>
class ScannedArguments {
 public:
  ScannedArguments(const FunctionInfo& f, const StratumSource& source, BatchFunction<Real> call)
      : arguments_(f, source), arity_(static_cast<std::size_t>(f.arity)) {
    if constexpr (has_narrow_scan<Real>) {
      if (source.stratum == Stratum::narrow) scan_.emplace(f, call, source.seed);
    }
  }
  void make_all(std::uint64_t k, std::size_t count, Real* out) {
    if constexpr (has_narrow_scan<Real>) {
      if (scan_) {
        for (std::size_t i = 0; i < count; ++i) scan_->choose(k + i, out + i * arity_);
        return;
      }
    }
    arguments_.make_all(k, count, out);
  }

 private:
  struct NoScan {};
  Arguments<Real> arguments_;
  std::size_t arity_;
  std::conditional_t<has_narrow_scan<Real>, std::optional<NarrowScan<Real>>, NoScan> scan_;
};

}  // namespace ulpgate
