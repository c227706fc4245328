// FormulaEngineOf<Real>: FormulaEngine over the formulas; included only by the one translation unit of each
// type.
#pragma once

#include <exception>
#include <memory>

#include "harness/core/formula_cases/formula_engine.hpp"
#include "kernels/formulas/forms.hpp"
#include "reference/types/exchange.hpp"

namespace ulpgate {

template <RealType Real>
class FormulaEngineOf final : public FormulaEngine {
 public:
  using Reference = RealHP<4, Real>;
  // Of a wider type FormulaNumber is no truth: it has no cases.
  static constexpr bool has_truth =
      std::numeric_limits<Reference>::digits <= std::numeric_limits<FormulaNumber>::digits;

  [[nodiscard]] FloatFormat format() const override { return float_format<Real>(); }
  [[nodiscard]] int reference_bits() const override { return std::numeric_limits<Reference>::digits; }

  [[nodiscard]] std::optional<FormulaInput> rounded(const FormulaInput& input) const override {
    if constexpr (!has_truth) return std::nullopt;
    FormulaInput result{{}, input.n};
    for (const FormulaNumber& x : input.x) {
      result.x.push_back(exported(from_mpfr<Real>(x.backend().data())));
      const FormulaNumber& r = result.x.back();
      if (mpfr_number_p(r.backend().data()) == 0 || (r == 0 && x != 0)) return std::nullopt;
    }
    return result;
  }

  [[nodiscard]] FormulaValue evaluate(std::string_view problem, std::string_view form,
                                      const FormulaInput& input) const override {
    return evaluated<Real>(problem, form, input);
  }

  [[nodiscard]] FormulaValue evaluate_reference(std::string_view problem, std::string_view form,
                                                const FormulaInput& input) const override {
    return evaluated<Reference>(problem, form, input);
  }

 private:
  template <RealType R>
  static FormulaNumber exported(const R& x) {
    const WideExponentRange wide;
    FormulaNumber result;
    if constexpr (!has_truth) throw std::invalid_argument("no truth of twice the digits of this type");
    if constexpr (has_truth) to_mpfr(result.backend().data(), x);
    return result;
  }

  // The form runs in the exponent range that its type has by default.
  template <RealType R>
  static FormulaValue evaluated(std::string_view problem, std::string_view form, const FormulaInput& input) {
    const auto evaluate = formulas::find_form<R>(problem, form);
    std::vector<R> x;
    FormulaValue result;
    for (const FormulaNumber& v : input.x) {
      x.push_back(from_mpfr<R>(v.backend().data()));
      // cpp_bin_float takes its guard bits from the range of exponents: more digits reach less far.
      const FormulaNumber held = exported(x.back());
      if (mpfr_number_p(held.backend().data()) == 0 || (held == 0 && v != 0)) {
        result.refusal = "an argument is out of the type's range";
        return result;
      }
    }
    try {
      for (const R& v : evaluate(x, input.n)) result.value.push_back(exported(v));
    } catch (const std::exception& e) {
      result.refusal = e.what();
    }
    return result;
  }
};

}  // namespace ulpgate
