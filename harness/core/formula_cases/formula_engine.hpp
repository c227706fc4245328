// FormulaEngine: the formulas of kernels/formulas in one type, behind an interface that knows no type under
// test.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reference/types/format.hpp"

namespace ulpgate {

// Truths, and values of every type on their way to them: 2326 bits, which hold a RealHP<4> of 150 digits
// exactly, and twice 150 digits and the cancellation of every problem.  Arithmetic on it wants a
// WideExponentRange, because types under test reach further than MPFR's default exponents.
using FormulaNumber = MpfrReal<700>;
using FormulaNumbers = std::vector<FormulaNumber>;

// What a formula is evaluated at: real arguments and a number of steps, terms or points.
struct FormulaInput {
  FormulaNumbers x;
  long n = 0;
};

// What a form came to in one type.
struct FormulaValue {
  FormulaNumbers value;  // exact; NaN and infinities as they came
  std::string refusal;   // an exception's text; empty: none, and there is a value
};

class FormulaEngine {
 public:
  FormulaEngine() = default;
  FormulaEngine(const FormulaEngine&) = delete;
  FormulaEngine& operator=(const FormulaEngine&) = delete;
  virtual ~FormulaEngine() = default;

  [[nodiscard]] virtual FloatFormat format() const = 0;
  // Significand bits of RealHP<4>.
  [[nodiscard]] virtual int reference_bits() const = 0;
  // Arguments rounded once to the type; nothing where one of them overflows or becomes 0 there,
  // or where FormulaNumber is too narrow for the type.
  [[nodiscard]] virtual std::optional<FormulaInput> rounded(const FormulaInput& input) const = 0;

  // A form at arguments that are rounded to the type first.  Throws std::invalid_argument for an unknown
  // form.
  [[nodiscard]] virtual FormulaValue evaluate(std::string_view problem, std::string_view form,
                                              const FormulaInput& input) const = 0;
  // The same code in RealHP<4>, with arguments rounded to that; refused where they are out of its range.
  [[nodiscard]] virtual FormulaValue evaluate_reference(std::string_view problem, std::string_view form,
                                                        const FormulaInput& input) const = 0;
};

// Null where `token` was not built in.
[[nodiscard]] const FormulaEngine* find_formula_engine(std::string_view token);

}  // namespace ulpgate
