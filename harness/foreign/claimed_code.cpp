// ClaimedCode.
#include "harness/foreign/claimed_code.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "reference/native/native_functions.hpp"
#include "reference/oracle/oracle.hpp"
#include "reference/types/exchange.hpp"

namespace ulpgate {

namespace {

// A type with many more bits than Real, whose functions rounded to Real are right but next to ties.
template <class Real>
struct WiderOf {
  using type = void;
};
template <>
struct WiderOf<float> {
  using type = double;
};
template <>
struct WiderOf<double> {
  using type = std::conditional_t<std::numeric_limits<long double>::digits == 64, long double, void>;
};

template <RealType Real>
class ClaimedCode final : public BatchCode {
 public:
  using Wide = typename WiderOf<Real>::type;

  ClaimedCode(const BatchCode& code, const FunctionInfo& f, ClaimBounds bounds)
      : code_(code), function_(f), bounds_(std::move(bounds)) {}

  void evaluate(const void* args, void* results, std::uint8_t* threw, std::size_t count) const override {
    const auto* x = static_cast<const Real*>(args);
    auto* y = static_cast<Real*>(results);
    const auto arity = static_cast<std::size_t>(function_.arity);
    std::size_t covered = 0;
    for (std::size_t i = 0; i < count; ++i) covered += inside(x + i * arity) ? 1U : 0U;
    if (covered == count) {
      code_.evaluate(args, results, threw, count);
    } else {
      // Kept between batches: to allocate them costs as much as a fast function.
      static thread_local std::vector<std::size_t> within;
      static thread_local std::vector<std::size_t> beyond;
      within.clear();
      beyond.clear();
      for (std::size_t i = 0; i < count; ++i) (inside(x + i * arity) ? within : beyond).push_back(i);
      evaluate_some(x, y, threw, within);
      for (const auto i : beyond) threw[i] = 0;
      replace(x, y, beyond);
    }
    if (!(bounds_.floor > 0)) return;
    static thread_local std::vector<std::size_t> small;
    small.clear();
    for (std::size_t i = 0; i < count; ++i)
      if (threw[i] == 0 && !(magnitude(y[i]) >= reach()) && inside(x + i * arity)) small.push_back(i);
    replace_within_floor(x, y, small);
  }
  double call(const void* args, void* results, std::size_t count, int rounds) const override {
    return code_.call(args, results, count, rounds);
  }
  [[nodiscard]] std::size_t batch() const override { return code_.batch(); }

 private:
  [[nodiscard]] bool inside(const Real* x) const {
    for (std::size_t j = 0; j < bounds_.domain.size(); ++j) {
      const auto& [low, high] = bounds_.domain[j];
      if (!(x[j] >= Real(low) && x[j] <= Real(high))) return false;
    }
    return true;
  }
  // Calls the code for these points alone.
  void evaluate_some(const Real* x, Real* y, std::uint8_t* threw,
                     const std::vector<std::size_t>& points) const {
    if (points.empty()) return;
    const auto arity = static_cast<std::size_t>(function_.arity);
    static thread_local std::vector<Real> args;
    static thread_local std::vector<Real> results;
    static thread_local std::vector<std::uint8_t> failed;
    args.clear();
    for (const auto i : points) args.insert(args.end(), x + i * arity, x + (i + 1) * arity);
    results.resize(points.size());
    failed.resize(points.size());
    code_.evaluate(args.data(), results.data(), failed.data(), points.size());
    for (std::size_t p = 0; p < points.size(); ++p) {
      y[points[p]] = results[p];
      threw[points[p]] = failed[p];
    }
  }
  [[nodiscard]] static double magnitude(const Real& y) { return std::fabs(static_cast<double>(y)); }
  // Beyond it half a unit in the last place is more than the floor.
  [[nodiscard]] double reach() const {
    return std::ldexp(bounds_.floor, std::numeric_limits<Real>::digits + 1);
  }

  // At 64 bits more than Real has.
  [[nodiscard]] MpfrValue exact(const Real* x) const {
    std::vector<MpfrValue> args;
    for (int j = 0; j < function_.arity; ++j) {
      args.emplace_back(std::numeric_limits<Real>::digits);
      to_mpfr(args.back().get(), x[j]);
    }
    std::vector<MpfrValue> value;
    value.emplace_back(std::numeric_limits<Real>::digits + 64);
    exact_value(function_, args, value);
    return std::move(value.front());
  }

  // Of an erfc that is half of all floats: those whose error is clearly within the floor, or clearly not,
  // need no MPFR.
  void replace_within_floor(const Real* x, Real* y, const std::vector<std::size_t>& points) const {
    if (points.empty()) return;
    const auto arity = static_cast<std::size_t>(function_.arity);
    if constexpr (!std::is_void_v<Wide>) {
      if (const auto function = bounded_function<Wide>(function_.id); function != nullptr) {
        const auto& [values, bounds] = wide_values(function, x, points);
        for (std::size_t p = 0; p < points.size(); ++p) {
          const std::size_t i = points[p];
          if (!settle_within_floor(y[i], values[p], bounds[p])) replace_within_floor(x + i * arity, y[i]);
        }
        return;
      }
    }
    for (const auto i : points) replace_within_floor(x + i * arity, y[i]);
  }

  // Whether all numbers within `bound` ulp of W from `value` are one in Real.  A zero may be a small number.
  template <class W>
  [[nodiscard]] static bool rounds_to_one(W value, double bound) {
    if (!(bound >= 0) || value == 0) return false;
    if (value - value != 0) return true;
    const W slack = slack_of(value, bound);
    return static_cast<Real>(value - slack) == static_cast<Real>(value + slack);
  }
  // The error of `value`, with two ulp more for what is computed with it here.
  template <class W>
  [[nodiscard]] static W slack_of(W value, double bound) {
    using L = std::numeric_limits<W>;
    return (static_cast<W>(bound) + 2) * (std::fabs(value) * L::epsilon() + L::denorm_min());
  }

  // False where `value` and its bound in ulp of its type do not tell.
  template <class W>
  [[nodiscard]] bool settle_within_floor(Real& y, W value, double bound) const {
    if (!(bound >= 0) || value - value != 0 || !std::isfinite(y)) return false;
    const W slack = slack_of(value, bound);
    const W error = std::fabs(static_cast<W>(y) - value);
    const auto floor = static_cast<W>(bounds_.floor);
    const W margin = slack + floor * static_cast<W>(0x1p-40);
    if (error + margin <= floor) {
      y = static_cast<Real>(value);
      return true;
    }
    return error - margin > floor;
  }

  template <class Function>
  [[nodiscard]] const auto& wide_values(Function function, const Real* x,
                                        const std::vector<std::size_t>& points) const {
    const auto arity = static_cast<std::size_t>(function_.arity);
    static thread_local std::vector<Wide> args;
    static thread_local std::pair<std::vector<Wide>, std::vector<double>> found;
    args.clear();
    for (const auto i : points)
      for (std::size_t j = 0; j < arity; ++j) args.push_back(x[i * arity + j]);
    found.first.resize(points.size());
    found.second.resize(points.size());
    function(args.data(), found.first.data(), found.second.data(), points.size(),
             std::numeric_limits<Real>::digits);
    return found;
  }

  void replace_within_floor(const Real* x, Real& y) const {
    const MpfrValue value = exact(x);
    if (mpfr_number_p(value.get()) == 0 || !(magnitude(y) <= std::numeric_limits<double>::max())) return;
    const WideExponentRange wide;
    MpfrValue error(std::numeric_limits<Real>::digits + 128);
    to_mpfr(error.get(), y);
    mpfr_sub(error, error, value, MPFR_RNDA);
    if (mpfr_cmpabs(error, as_mpfr(bounds_.floor).get()) <= 0) y = from_mpfr<Real>(value.get());
  }
  [[nodiscard]] static MpfrValue as_mpfr(double x) {
    MpfrValue v(53);
    mpfr_set_d(v, x, MPFR_RNDN);
    return v;
  }

  void replace(const Real* x, Real* y, const std::vector<std::size_t>& points) const {
    if (points.empty()) return;
    const auto arity = static_cast<std::size_t>(function_.arity);
    if constexpr (!std::is_void_v<Wide>) {
      if (const auto function = bounded_function<Wide>(function_.id); function != nullptr) {
        const auto& [values, error] = wide_values(function, x, points);
        for (std::size_t p = 0; p < points.size(); ++p) {
          y[points[p]] = rounds_to_one(values[p], error[p])
                             ? static_cast<Real>(values[p])
                             : from_mpfr<Real>(exact(x + points[p] * arity).get());
        }
        return;
      }
    }
    for (const auto i : points) y[i] = from_mpfr<Real>(exact(x + i * arity).get());
  }

  const BatchCode& code_;
  const FunctionInfo& function_;
  ClaimBounds bounds_;
};

}  // namespace

std::unique_ptr<BatchCode> make_claimed_code(const BatchCode& code, const FunctionInfo& f, char element,
                                             ClaimBounds bounds) {
  if (element == 'f') return std::make_unique<ClaimedCode<float>>(code, f, std::move(bounds));
  if (element == 'd') return std::make_unique<ClaimedCode<double>>(code, f, std::move(bounds));
#ifdef ULPGATE_HAVE_FLOAT128
  if (element == 'q') return std::make_unique<ClaimedCode<Float128Real>>(code, f, std::move(bounds));
#endif
  return std::make_unique<ClaimedCode<long double>>(code, f, std::move(bounds));
}

}  // namespace ulpgate
