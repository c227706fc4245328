// FunctionTarget<Real, Wide>: a function of a type as the target of a search, ranked by a wider type where
// there is one.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "harness/core/arguments/argument_lists.hpp"
#include "harness/core/functions/calls_in_hand.hpp"
#include "harness/core/judging/judging.hpp"
#include "harness/core/search/local_polynomial.hpp"
#include "harness/core/search/search.hpp"
#include "harness/core/search/search_positions.hpp"
#include "kernels/math/function_table.hpp"
#include "reference/types/widen.hpp"

namespace ulpgate {

// Stands for "no wider type": points are then ranked by MPFR with a few more bits.
struct NoWideType {};

// The error of `got` against `wide`, the same function in a type with at least 11 more bits, in ULP of Real.
// An estimate to rank by: nothing is reported on its word.  Infinity where one of them is no ordinary number
// and the other does not say the same.
template <RealType Real, RealType Wide>
[[nodiscard]] double estimated_error(const Real& got, const Wide& wide) {
  using std::abs;
  using std::ilogb;
  using std::isfinite;
  using std::isinf;
  using std::isnan;
  using std::ldexp;
  constexpr FloatFormat format = float_format<Real>();
  constexpr double suspect = std::numeric_limits<double>::infinity();
  if (isnan(got) || isnan(wide)) return isnan(got) && isnan(wide) ? 0 : suspect;
  const Wide w = static_cast<Wide>(got);
  const bool beyond = isinf(wide) || (wide != Wide(0) && ilogb(wide) > format.exponent_max);
  if (isinf(got) || beyond) return isinf(got) && beyond && (w > 0) == (wide > 0) ? 0 : suspect;
  if (wide == Wide(0)) return w == Wide(0) ? 0 : suspect;
  const long binade = std::max(static_cast<long>(ilogb(wide)), format.exponent_min);
  const auto error =
      static_cast<double>(ldexp(Wide(abs(Wide(w - wide))), static_cast<int>(format.precision - 1 - binade)));
  return w == Wide(0) && error > 1 ? suspect : error;
}

template <RealType Real, class Wide>
class FunctionTarget final : public SearchTarget<PositionOf<Real>> {
 public:
  using Position = PositionOf<Real>;
  using Point = SearchPoint<Position>;

  FunctionTarget(const FunctionInfo& f, BatchFunction<Real> call)
      : function_(f),
        exponents_(sampled_exponents(f, float_format<Real>())),
        positions_(exponents_.least),
        call_(call) {
    if constexpr (has_wide) wide_ = function_table<Wide>()[static_cast<std::size_t>(f.id)];
  }

  [[nodiscard]] std::size_t arity() const override { return static_cast<std::size_t>(function_.arity); }

  [[nodiscard]] SearchBox<Position> domain() const override {
    SearchBox<Position> box;
    for (std::size_t i = 0; i < arity(); ++i) {
      box.low[i] = positions_.of(domain_low(i));
      box.high[i] = function_.domain[i] == DomainMap::PM1 ? positions_.of(Real(1)) : positions_.of(largest());
    }
    return box;
  }

  // The products of [2^-10, 2^10] and its negative, as far as the domain has them.
  [[nodiscard]] std::vector<SearchBox<Position>> ordinary_boxes() const {
    const SearchBox<Position> whole = domain();
    std::vector<SearchBox<Position>> boxes;
    for (unsigned signs = 0; signs < (1U << arity()); ++signs) {
      SearchBox<Position> box = whole;
      bool inside = true;
      for (std::size_t i = 0; i < arity(); ++i) {
        const bool negative = ((signs >> i) & 1U) != 0;
        box.low[i] = std::max(whole.low[i], positions_.of(negative ? Real(-1024) : Real(1) / Real(1024)));
        box.high[i] = std::min(whole.high[i], positions_.of(negative ? Real(-1) / Real(1024) : Real(1024)));
        inside = inside && box.low[i] < box.high[i];
      }
      if (inside) boxes.push_back(std::move(box));
    }
    return boxes;
  }

  // Those of the list that lie in the domain.
  [[nodiscard]] std::vector<Point> seeds(const ArgumentList& list) const {
    const SearchBox<Position> whole = domain();
    std::vector<Point> points;
    for (const auto& values : list) {
      Point x{};
      bool good = true;
      for (std::size_t i = 0; i < values.size() && good; ++i) {
        good = mpfr_number_p(values[i].get()) != 0;
        if (good) x[i] = positions_.of(from_mpfr<Real>(values[i]));
      }
      if (good && whole.contains(x, arity())) points.push_back(x);
    }
    return points;
  }

  // Takes what lies next to these points as known.
  void pass_over(const ArgumentList& known) {
    known_ = seeds(known);
    std::ranges::sort(known_);
  }
  // Within 2^(p/2) positions in every argument: as near as that, errors are those of the point itself or of
  // the same cancellation.
  [[nodiscard]] bool is_known(const Point& x) const override {
    const auto reach = Width<Position>(1) << (std::numeric_limits<Real>::digits / 2);
    const auto near = [&](const Position& a, const Position& b) {
      return Width<Position>(a < b ? width_of(a, b) : width_of(b, a)) <= reach;
    };
    auto it = std::ranges::partition_point(known_,
                                           [&](const Point& k) { return k[0] < x[0] && !near(k[0], x[0]); });
    for (; it != known_.end() && near((*it)[0], x[0]); ++it) {
      bool all = true;
      for (std::size_t i = 1; i < arity(); ++i) all = all && near((*it)[i], x[i]);
      if (all) return true;
    }
    return false;
  }

  [[nodiscard]] std::vector<MpfrValue> values(const Point& x) const {
    std::vector<MpfrValue> out;
    for (std::size_t i = 0; i < arity(); ++i) {
      out.emplace_back(std::numeric_limits<Real>::digits);
      to_mpfr(out.back().get(), positions_.at(x[i]));
    }
    return out;
  }

  void rank(std::span<const Point> points, std::span<double> errors) const override {
    thread_local Buffers b;
    const CallsInHand<Real> calls(function_, call_, b.args);
    const HandScope hand(calls);
    evaluate(points, b);
    if (!distrusted_ && rank_by_polynomial(points.size(), b, errors)) return;
    if constexpr (has_wide) {
      if (!distrusted_) return rank_by_wide(points.size(), b, errors);
    }
    FullJudging<Real> judging(function_, ranking_bits);
    for (std::size_t i = 0; i < points.size(); ++i) errors[i] = ranked(judged(judging, b, i));
  }

  [[nodiscard]] Judgement confirm(const Point& x) const override {
    Buffers b;
    const CallsInHand<Real> calls(function_, call_, b.args);
    const HandScope hand(calls);
    evaluate({&x, 1}, b);
    FullJudging<Real> judging(function_);
    return judged(judging, b, 0);
  }

  // Over 2^-10 of a binade a polynomial of low degree is good enough for most functions.
  [[nodiscard]] int cheap_scale() const override { return std::numeric_limits<Real>::digits - 1 - 14; }
  [[nodiscard]] int significand_bits() const override { return std::numeric_limits<Real>::digits; }
  void distrust_estimates() override { distrusted_ = true; }

 private:
  static constexpr bool has_wide = !std::same_as<Wide, NoWideType>;
  using WideReal = std::conditional_t<has_wide, Wide, Real>;
  static constexpr long ranking_bits = std::numeric_limits<Real>::digits + 32;

  struct Buffers {
    std::vector<Real> args;
    std::vector<Real> results;
    std::vector<std::uint8_t> threw;
    std::vector<WideReal> wide_args;
    std::vector<WideReal> wide_results;
    std::vector<std::uint8_t> wide_threw;
  };

  [[nodiscard]] std::size_t parts() const { return static_cast<std::size_t>(function_.parts); }

  // Of point i: a mismatch of any part, else the part with the largest error.
  [[nodiscard]] Judgement judged(FullJudging<Real>& judging, const Buffers& b, std::size_t i) const {
    const Batch<Real> batch{function_, b.args, b.results, b.threw};
    judging.load(batch, i);
    Judgement worst = judging.judgement(batch, i, 0);
    for (std::size_t part = 1; part < parts() && worst.outcome == Outcome::finite; ++part) {
      const Judgement j = judging.judgement(batch, i, part);
      if (j.outcome != Outcome::finite || j.error > worst.error) worst = j;
    }
    return worst;
  }
  static double ranked(const Judgement& j) {
    return j.outcome == Outcome::finite ? j.error.value : std::numeric_limits<double>::infinity();
  }

  [[nodiscard]] Real largest() const {
    MpfrValue v(std::numeric_limits<Real>::digits);
    mpfr_set_si_2exp(v, 1, exponents_.greatest + 1, MPFR_RNDN);
    mpfr_nextbelow(v);
    return from_mpfr<Real>(v);
  }
  // The least argument of the mathematical domain.  The table's maps keep random arguments where they say
  // most; lgamma and pow are defined beyond.
  [[nodiscard]] Real domain_low(std::size_t slot) const {
    if (function_.id == FunctionId::lgamma || function_.id == FunctionId::pow) return Real(-largest());
    switch (function_.domain[slot]) {
      case DomainMap::PM1:
      case DomainMap::GTM1:
        return Real(-1);
      case DomainMap::GT1:
        return Real(1);
      case DomainMap::GT0:
        return Real(0);
      default:
        return Real(-largest());
    }
  }

  void evaluate(std::span<const Point> points, Buffers& b) const {
    b.args.resize(points.size() * arity());
    b.results.resize(points.size() * parts());
    b.threw.assign(points.size(), 0);
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t j = 0; j < arity(); ++j) b.args[i * arity() + j] = positions_.at(points[i][j]);
    }
    Heartbeat::mine().beat(WorkPhase::calls, points.size());
    call_(b.args.data(), b.results.data(), b.threw.data(), points.size());
    Heartbeat::mine().beat(WorkPhase::references, points.size());
  }

  void rank_by_wide(std::size_t count, Buffers& b, std::span<double> errors) const {
    if constexpr (has_wide) {
      b.wide_args.resize(count * arity());
      b.wide_results.resize(count * parts());
      b.wide_threw.assign(count, 0);
      for (std::size_t i = 0; i < b.wide_args.size(); ++i) b.wide_args[i] = widen<Wide>(b.args[i]);
      (*wide_)(b.wide_args.data(), b.wide_results.data(), b.wide_threw.data(), count);
      for (std::size_t i = 0; i < count; ++i) {
        double error = b.threw[i] != 0 ? std::numeric_limits<double>::infinity() : 0;
        for (std::size_t j = i * parts(); j < (i + 1) * parts() && b.threw[i] == 0; ++j)
          error = std::max(error, estimated_error<Real>(b.results[j], b.wide_results[j]));
        errors[i] = error;
      }
    }
  }

  // Where all points lie close together, a few precise values stand for one at each, which is five times
  // faster and more.  False where that would not be good enough.
  bool rank_by_polynomial(std::size_t count, Buffers& b, std::span<double> errors) const {
    constexpr std::size_t worthwhile = 48;
    if (arity() != 1 || parts() != 1 || count < worthwhile) return false;
    using std::abs;
    using std::isfinite;
    const auto [least, greatest] = std::ranges::minmax_element(b.args);
    const Real reach = std::min(Real(abs(*least)), Real(abs(*greatest))) / Real(64);
    if (!(*least < *greatest) || !(*greatest - *least < reach)) return false;
    LocalPolynomial<Real> polynomial;
    std::array<TwoPart<Real>, LocalPolynomial<Real>::nodes + LocalPolynomial<Real>::checks> values;
    precise_values(polynomial.choose(*least, *greatest), b, values);
    // All in one binade or two neighbouring ones, far from the ends of the range.
    const auto [low, high] =
        std::ranges::minmax_element(values, {}, [](const TwoPart<Real>& v) { return Real(abs(v.high)); });
    const Real first = abs(low->high);
    if (!isfinite(high->high) || !(first > 0) || (low->high > 0) != (high->high > 0)) return false;
    using std::ilogb;
    using std::ldexp;
    const auto binade = static_cast<long>(ilogb(first));
    if (std::labs(binade) > float_format<Real>().exponent_max / 2) return false;
    if (!(Real(abs(high->high)) - first <= first / Real(16))) return false;
    const auto p = static_cast<long>(std::numeric_limits<Real>::digits);
    // 1/64 ULP: the ranking is rough, what leads is confirmed.
    if (!polynomial.fit(values, ldexp(Real(1), static_cast<int>(binade - p + 1 - 6)))) return false;
    const Real scale = ldexp(Real(1), static_cast<int>(p - 1 - binade));
    const Real next = ldexp(Real(1), static_cast<int>(binade + 1));
    for (std::size_t i = 0; i < count; ++i) {
      const Real got = b.results[i];
      const auto error = static_cast<double>(abs(Real(polynomial.difference(b.args[i], got) * scale)));
      const bool sound = b.threw[i] == 0 && isfinite(got);
      // Beyond the power of two the spacing is twice that.
      errors[i] = !sound ? std::numeric_limits<double>::infinity() : abs(got) >= next ? error / 2 : error;
    }
    return true;
  }

  // From the wider type, or else from MPFR with as many bits again.
  void precise_values(std::span<const Real> args, Buffers& b, std::span<TwoPart<Real>> values) const {
    if constexpr (has_wide) {
      b.wide_args.clear();
      for (const Real& x : args) b.wide_args.push_back(widen<Wide>(x));
      b.wide_results.resize(args.size());
      b.wide_threw.assign(args.size(), 0);
      (*wide_)(b.wide_args.data(), b.wide_results.data(), b.wide_threw.data(), args.size());
      for (std::size_t i = 0; i < args.size(); ++i) {
        const Wide& w = b.wide_results[i];
        values[i].high = static_cast<Real>(w);
        values[i].low = static_cast<Real>(Wide(w - static_cast<Wide>(values[i].high)));
      }
    } else {
      constexpr long bits = 2 * std::numeric_limits<Real>::digits;
      std::vector<MpfrValue> x;
      x.emplace_back(std::numeric_limits<Real>::digits);
      std::vector<MpfrValue> y;
      y.emplace_back(bits);
      MpfrValue rest(bits);
      for (std::size_t i = 0; i < args.size(); ++i) {
        to_mpfr(x[0].get(), args[i]);
        exact_value(function_, x, y);
        values[i].high = from_mpfr<Real>(y[0]);
        to_mpfr(rest.get(), values[i].high);
        mpfr_sub(rest, y[0], rest, MPFR_RNDN);
        values[i].low = from_mpfr<Real>(rest);
      }
    }
  }

  FunctionInfo function_;
  ExponentRange exponents_;
  Positions<Real> positions_;
  BatchFunction<Real> call_;
  std::optional<BatchFunction<WideReal>> wide_;
  bool distrusted_ = false;
  std::vector<Point> known_;  // sorted
};

}  // namespace ulpgate
