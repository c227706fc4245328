// Properties of functions.
#include "harness/foreign/properties.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "harness/core/arguments/random_words.hpp"
#include "reference/text/text.hpp"

namespace ulpgate {

namespace {

enum class Symmetry { none, odd, even };
enum class Trend { none, rising, falling };

struct Shape {
  Symmetry symmetry = Symmetry::none;
  Trend trend = Trend::none;
  double least = -HUGE_VAL;  // of its values, rounded to the type
  double greatest = HUGE_VAL;
};

Shape shape_of(FunctionId id) {
  using enum FunctionId;
  constexpr double half_pi = 1.5707963267948966;
  switch (id) {
    case sin:
      return {Symmetry::odd, Trend::none, -1, 1};
    case cos:
      return {Symmetry::even, Trend::none, -1, 1};
    case tan:
      return {Symmetry::odd};
    case sinh:
    case asinh:
    case cbrt:
    case atanh:
      return {Symmetry::odd, Trend::rising};
    case cosh:
      return {Symmetry::even, Trend::none, 1};
    case tanh:
    case erf:
      return {Symmetry::odd, Trend::rising, -1, 1};
    case asin:
    case atan:
      return {Symmetry::odd, Trend::rising, -half_pi, half_pi};
    case acos:
      return {Symmetry::none, Trend::falling, 0, 2 * half_pi};
    case erfc:
      return {Symmetry::none, Trend::falling, 0, 2};
    case exp:
    case exp2:
      return {Symmetry::none, Trend::rising, 0};
    case expm1:
      return {Symmetry::none, Trend::rising, -1};
    case sqrt:
    case acosh:
      return {Symmetry::none, Trend::rising, 0};
    case log:
    case log2:
    case log10:
    case log1p:
      return {Symmetry::none, Trend::rising};
    default:
      return {};
  }
}

template <class Real>
class Properties {
 public:
  using L = std::numeric_limits<Real>;

  Properties(const BatchCode& code, const FunctionInfo& f, const ClaimBounds& claim, std::uint64_t seed)
      : code_(code), function_(f), claim_(claim), words_(seed) {}

  std::vector<PropertyFinding> broken() {
    if (function_.arity == 1) {
      const std::vector<Real> x = arguments(1);
      look_at_symmetry(x);
      look_at_range(x);
      look_at_trend(x);
    }
    look_at_exact_values();
    return std::move(found_);
  }

  SampledResults sample() {
    const auto arity = static_cast<std::size_t>(function_.arity);
    const std::vector<Real> x = arguments(arity);
    const std::vector<Real> y = values(x, arity);
    SampledResults out;
    for (std::size_t i = 0; i < y.size(); ++i) {
      std::string args;
      for (std::size_t j = 0; j < arity; ++j) args += (j == 0 ? "" : " ") + to_hexfloat(x[i * arity + j]);
      out.args.push_back(args);
      out.results.push_back(to_hexfloat(y[i]));
    }
    return out;
  }

 private:
  static constexpr std::size_t points = 4096;

  [[nodiscard]] std::pair<double, double> interval(std::size_t slot) const {
    double low = -HUGE_VAL;
    double high = HUGE_VAL;
    switch (function_.domain[slot]) {
      case DomainMap::PM1:
        low = -1;
        high = 1;
        break;
      case DomainMap::GTM1:
        low = -1;
        break;
      case DomainMap::GT1:
        low = 1;
        break;
      case DomainMap::GT0:
        low = 0;
        break;
      default:
        break;
    }
    if (!claim_.domain.empty()) {
      low = std::max(low, claim_.domain[slot].first);
      high = std::min(high, claim_.domain[slot].second);
    }
    return {low, high};
  }

  // Signs, exponents of the range that matters (2^-30 to 2^30, as far as the interval has them) and
  // significands at random, and the ends of a claim's domain.
  [[nodiscard]] std::vector<Real> arguments(std::size_t arity) {
    std::vector<Real> x;
    for (const bool upper : {false, true}) {
      if (claim_.domain.empty()) break;
      for (std::size_t j = 0; j < arity; ++j) {
        const auto [low, high] = interval(j);
        x.push_back(std::isfinite(upper ? high : low) ? static_cast<Real>(upper ? high : low)
                                                      : between(low, high));
      }
    }
    while (x.size() < points * arity) {
      const auto [low, high] = interval(x.size() % arity);
      x.push_back(between(low, high));
    }
    return x;
  }

  // Where neither sign lies in the interval, anywhere between its ends.
  [[nodiscard]] Real between(double low, double high) {
    const std::uint64_t word = words_.word();
    const int most =
        std::isfinite(high) ? std::max(-20, std::min(30, std::ilogb(std::max(high, 1e-30)))) : 30;
    const int exponent = -30 + static_cast<int>(words_.word() % static_cast<std::uint64_t>(most + 31));
    const double fraction = static_cast<double>(word >> 12U) * 0x1p-52;
    const Real value = std::ldexp(Real(1) + static_cast<Real>(fraction), exponent);
    const auto least = static_cast<Real>(low);
    const auto greatest = static_cast<Real>(high);
    const Real one = (word & 1U) != 0 ? -value : value;
    for (const Real either : {one, -one})
      if (either >= least && either <= greatest) return either;
    if (std::isfinite(low) && std::isfinite(high))
      return std::clamp(static_cast<Real>(low + (high - low) * fraction), least, greatest);
    return std::isfinite(low) ? least + value : greatest - value;
  }

  [[nodiscard]] bool inside(Real x) const {
    const auto [low, high] = interval(0);
    return x >= static_cast<Real>(low) && x <= static_cast<Real>(high);
  }

  [[nodiscard]] std::vector<Real> values(const std::vector<Real>& x, std::size_t arity = 1) const {
    std::vector<Real> y(x.size() / arity);
    std::vector<std::uint8_t> threw(y.size());
    code_.evaluate(x.data(), y.data(), threw.data(), y.size());
    for (std::size_t i = 0; i < y.size(); ++i)
      if (threw[i] != 0) y[i] = L::quiet_NaN();
    return y;
  }

  struct Broken {
    std::vector<Real> args;
    std::string says;
  };
  // One finding of a property; `breaks` tells of each point whether it does.
  template <class Breaks>
  void look(const std::string& property, std::size_t count, Breaks breaks) {
    PropertyFinding finding{property, 0, count, {}, ""};
    for (std::size_t i = 0; i < count; ++i) {
      const std::optional<Broken> b = breaks(i);
      if (!b) continue;
      if (finding.broken++ != 0) continue;
      for (const Real& a : b->args) finding.args.push_back(to_hexfloat(a));
      finding.says = b->says;
    }
    if (finding.broken > 0) found_.push_back(std::move(finding));
  }

  void look_at_symmetry(const std::vector<Real>& x) {
    const Symmetry symmetry = shape_of(function_.id).symmetry;
    if (symmetry == Symmetry::none) return;
    std::vector<Real> kept;
    std::vector<Real> negative;
    for (const Real& a : x) {
      if (!inside(-a)) continue;
      kept.push_back(a);
      negative.push_back(-a);
    }
    const std::vector<Real> y = values(kept);
    const std::vector<Real> z = values(negative);
    look(symmetry == Symmetry::odd ? "odd" : "even", kept.size(),
         [&](std::size_t i) -> std::optional<Broken> {
           const Real wanted = symmetry == Symmetry::odd ? -z[i] : z[i];
           if (y[i] == wanted || (std::isnan(y[i]) && std::isnan(wanted))) return std::nullopt;
           return Broken{{kept[i]},
                         fmt::format("gives {}, and {} at {}", to_hexfloat(y[i]), to_hexfloat(z[i]),
                                     to_hexfloat(negative[i]))};
         });
  }

  void look_at_range(const std::vector<Real>& x) {
    const Shape shape = shape_of(function_.id);
    // An end that the type does not have is rounded away from the range.
    const auto wide = [](double end, double towards) {
      return std::abs(end) == std::round(std::abs(end))
                 ? static_cast<Real>(end)
                 : std::nextafter(static_cast<Real>(end), static_cast<Real>(towards));
    };
    const Real least = std::isinf(shape.least) ? -L::infinity() : wide(shape.least, -HUGE_VAL);
    const Real greatest = std::isinf(shape.greatest) ? L::infinity() : wide(shape.greatest, HUGE_VAL);
    const std::vector<Real> y = values(x);
    look("range", x.size(), [&](std::size_t i) -> std::optional<Broken> {
      if (std::isnan(y[i]) || (y[i] >= least && y[i] <= greatest)) return std::nullopt;
      return Broken{{x[i]}, fmt::format("gives {}", to_hexfloat(y[i]))};
    });
  }

  // Neighbours in the type, and neighbours of the sample.
  void look_at_trend(const std::vector<Real>& x) {
    const Trend trend = shape_of(function_.id).trend;
    if (trend == Trend::none) return;
    std::vector<Real> low;
    std::vector<Real> high;
    const auto add = [&](Real a, Real b) {
      if (!(a < b) || !inside(a) || !inside(b)) return;
      low.push_back(a);
      high.push_back(b);
    };
    for (const Real& a : x) add(a, std::nextafter(a, L::infinity()));
    std::vector<Real> sorted = x;
    std::ranges::sort(sorted);
    for (std::size_t i = 1; i < sorted.size(); ++i) add(sorted[i - 1], sorted[i]);
    const std::vector<Real> y = values(low);
    const std::vector<Real> z = values(high);
    look("monotone", low.size(), [&](std::size_t i) -> std::optional<Broken> {
      const bool good = trend == Trend::rising ? y[i] <= z[i] : y[i] >= z[i];
      if (good || std::isnan(y[i]) || std::isnan(z[i])) return std::nullopt;
      return Broken{
          {low[i]},
          fmt::format("gives {}, and {} at {}", to_hexfloat(y[i]), to_hexfloat(z[i]), to_hexfloat(high[i]))};
    });
  }

  // Arguments whose value is a number of the type.
  void look_at_exact_values() {
    std::vector<Real> x;
    std::vector<Real> wanted;
    const auto hold = [&](std::initializer_list<double> args, double value) {
      for (const double a : args) x.push_back(static_cast<Real>(a));
      wanted.push_back(static_cast<Real>(value));
    };
    using enum FunctionId;
    switch (function_.id) {
      case exp:
      case cosh:
      case cos:
      case erfc:
        hold({0.0}, 1);
        break;
      case log:
      case acos:
      case acosh:
        hold({1.0}, 0);
        break;
      case sin:
      case tan:
      case sinh:
      case tanh:
      case asin:
      case atan:
      case asinh:
      case atanh:
      case expm1:
      case log1p:
      case erf:
        hold({0.0}, 0);
        break;
      case exp2:
        for (int n = -100; n <= 100; ++n) hold({double(n)}, std::ldexp(1.0, n));
        break;
      case log2:
        for (int n = -100; n <= 100; ++n) hold({std::ldexp(1.0, n)}, n);
        break;
      case log10:
        for (int n = 0; n <= 10; ++n) hold({std::pow(10.0, n)}, n);
        break;
      case sqrt:
        for (int n = 0; n <= 4000; ++n) hold({double(n) * n}, n);
        break;
      case cbrt:
        for (int n = -200; n <= 200; ++n) hold({double(n) * n * n}, n);
        break;
      case hypot:
        for (int n = 1; n <= 1000; ++n) hold({3.0 * n, 4.0 * n}, 5.0 * n);
        break;
      case pow:
        for (int n = 1; n <= 1000; ++n) {
          hold({double(n), 2}, double(n) * n);
          hold({double(n), 1}, n);
          hold({double(n), 0}, 1);
        }
        break;
      case tgamma: {
        double factorial = 1;
        for (int n = 1; n <= 10; ++n) {
          hold({double(n)}, factorial);
          factorial *= n;
        }
        break;
      }
      default:
        return;
    }
    const auto arity = static_cast<std::size_t>(function_.arity);
    const std::vector<Real> y = values(x, arity);
    look("exact", y.size(), [&](std::size_t i) -> std::optional<Broken> {
      if (y[i] == wanted[i]) return std::nullopt;
      return Broken{
          {x.begin() + static_cast<long>(i * arity), x.begin() + static_cast<long>((i + 1) * arity)},
          fmt::format("gives {}, not {}", to_hexfloat(y[i]), to_hexfloat(wanted[i]))};
    });
  }

  const BatchCode& code_;
  const FunctionInfo& function_;
  const ClaimBounds& claim_;
  SplitMix64 words_;
  std::vector<PropertyFinding> found_;
};

}  // namespace

std::vector<PropertyFinding> broken_properties(const BatchCode& code, const FunctionInfo& f, char element,
                                               const ClaimBounds& claim, std::uint64_t seed) {
  if (element == 'f') return Properties<float>(code, f, claim, seed).broken();
  if (element == 'd') return Properties<double>(code, f, claim, seed).broken();
  if (element == 'l') return Properties<long double>(code, f, claim, seed).broken();
  return {};
}

SampledResults sampled_results(const BatchCode& code, const FunctionInfo& f, char element,
                               const ClaimBounds& claim, std::uint64_t seed) {
  if (element == 'f') return Properties<float>(code, f, claim, seed).sample();
  if (element == 'd') return Properties<double>(code, f, claim, seed).sample();
  if (element == 'l') return Properties<long double>(code, f, claim, seed).sample();
  return {};
}

}  // namespace ulpgate
