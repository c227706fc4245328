// FormulaProblem: what a formula is to compute, at which arguments, with a truth that owes nothing to it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "harness/core/formula_cases/formula_engine.hpp"
#include "harness/core/stress/stress_case.hpp"

namespace ulpgate {

struct FormulaForm {
  std::string name;  // as in kernels/formulas/forms.def
  std::vector<KnownVerdict> known = {};
  // A further form whose value, where it is not 0, is the step from which on nothing changes.
  std::string stall_form = {};
};

// An argument on the way to the one that a problem is stated at.
struct FormulaScanPoint {
  std::string label;  // "x = 2^-14"
  FormulaInput input;
};

// Which arguments the truth belongs to.
enum class Meant {
  as_rounded,  // those that the type holds
  as_stated,   // the exact ones: what their rounding costs is the problem's condition
};

// How a result is held against the truth.
enum class FormulaNorm {
  largest,  // largest difference over largest component
  each,     // the largest of the components' relative differences
  signs,    // components are signs: another one is a wrong outcome
};

struct FormulaProblem {
  std::string name;
  std::string title;  // formula, source and published outcome
  std::string at;     // the argument in words: "x = 1.2e-8"
  std::function<FormulaInput(const FloatFormat&)> input;
  // In FormulaNumber, within a WideExponentRange; smooth in x around the input, because the condition is
  // taken from its differences.
  std::function<FormulaNumbers(const FormulaInput&)> truth;
  std::vector<FormulaForm> forms;
  Meant meant = Meant::as_rounded;
  FormulaNorm norm = FormulaNorm::largest;
  // From harmless arguments to the stated one and beyond; the first at which a form is unstable is reported.
  std::function<std::vector<FormulaScanPoint>(const FloatFormat&)> scan = nullptr;
  std::string types = "all";  // tokens, separated by commas
  // Whether the code is short enough to be run in RealHP<4> as well, twice.
  bool referenced = true;
  double cost = 0.01;  // seconds in double
};

// Whether the problem is one of the type's, by its token.
[[nodiscard]] bool exists_in(const FormulaProblem& problem, std::string_view token);

// The rows, by theme; all of them, in the order of forms.def.
[[nodiscard]] const std::vector<FormulaProblem>& formula_problems();
[[nodiscard]] std::vector<FormulaProblem> polynomial_problems();
[[nodiscard]] std::vector<FormulaProblem> recurrence_problems();
[[nodiscard]] std::vector<FormulaProblem> sum_problems();
[[nodiscard]] std::vector<FormulaProblem> cancellation_problems();
[[nodiscard]] std::vector<FormulaProblem> geometry_problems();
[[nodiscard]] std::vector<FormulaProblem> complex_problems();
[[nodiscard]] std::vector<FormulaProblem> range_problems();

// Texts of decimal numbers as arguments, the same in every type.
[[nodiscard]] std::function<FormulaInput(const FloatFormat&)> stated(std::vector<std::string> x, long n = 0);
[[nodiscard]] FormulaNumber number(const std::string& text);
// The exact sum of the arguments, as far as FormulaNumber holds it.
[[nodiscard]] FormulaNumbers sum_truth(const FormulaInput& in);
// 2^exponent, for exponents of every format.
[[nodiscard]] FormulaNumber power_of_two(long exponent);
[[nodiscard]] FormulaNumber largest_of(const FloatFormat& format);
[[nodiscard]] FormulaNumber least_normal_of(const FloatFormat& format);
[[nodiscard]] FormulaNumber least_of(const FloatFormat& format);
// x = 2^0, 2^-1 ... 2^-last, each made into arguments by `make`; the same in every type.
[[nodiscard]] std::function<std::vector<FormulaScanPoint>(const FloatFormat&)> scan_binades(
    std::string variable, int first, int last, std::function<FormulaNumbers(const FormulaNumber&)> make);
// n = first ... last at these arguments.
[[nodiscard]] std::function<std::vector<FormulaScanPoint>(const FloatFormat&)> scan_steps(
    std::vector<std::string> x, long first, long last);

}  // namespace ulpgate
