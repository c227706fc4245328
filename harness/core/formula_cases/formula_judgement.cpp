// What a form of a problem comes to in one type, against the truth of the problem.
#include "harness/core/formula_cases/formula_judgement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reference/types/mpfr_value.hpp"

namespace ulpgate {

namespace {

constexpr long kDifferenceExponent = -700;

bool finite(const FormulaNumbers& v) {
  return std::all_of(v.begin(), v.end(),
                     [](const FormulaNumber& x) { return mpfr_number_p(x.backend().data()) != 0; });
}

FormulaNumber largest_magnitude(const FormulaNumbers& v) {
  FormulaNumber largest(0);
  for (const auto& x : v) largest = std::max(largest, FormulaNumber(abs(x)));
  return largest;
}

// A quotient of magnitudes as a double that is finite.
double ratio(const FormulaNumber& a, const FormulaNumber& b) {
  if (a == 0) return 0;
  if (b == 0) return 1e300;
  const FormulaNumber q(a / b);
  return std::min(mpfr_get_d(q.backend().data(), MPFR_RNDN), 1e300);
}

struct Judged {
  double error;
  double condition;
  StressVerdict verdict;
  FormulaNumbers truth;
};

// The verdict on a value at arguments as the type holds them.
Judged judge(const FormulaProblem& problem, const FormulaEngine& engine, const FormulaInput& stated,
             const FormulaInput& rounded, const FormulaNumbers& value) {
  const WideExponentRange wide;
  const FormulaInput& meant = problem.meant == Meant::as_stated ? stated : rounded;
  Judged j{0, 0, StressVerdict::stable, problem.truth(meant)};
  j.error = formula_error(value, j.truth, problem.norm);
  if (problem.norm == FormulaNorm::signs) {
    j.verdict = j.error == 0 ? StressVerdict::stable : StressVerdict::wrong_outcome;
    return j;
  }
  j.condition = std::max(formula_condition(problem, meant), 1.0);
  j.verdict = judge_stress(j.error, j.condition, unit_roundoff(static_cast<int>(engine.format().precision)));
  return j;
}

bool good(StressVerdict v) {
  return v == StressVerdict::stable || v == StressVerdict::ill_conditioned;
}

// What a person is told of a result that is wrong: its worst component beside the true one.
std::string wrong_result(const FormulaNumbers& value, const FormulaNumbers& truth) {
  if (value.size() != truth.size())
    return std::to_string(value.size()) + " results, true are " + std::to_string(truth.size());
  const WideExponentRange wide;
  std::size_t worst = 0;
  double largest = -1;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double off = formula_error({value[i]}, {truth[i]}, FormulaNorm::each);
    if (!(off <= largest)) {
      largest = off;
      worst = i;
    }
  }
  const auto text = [](const FormulaNumber& x) { return x.str(8); };
  return (truth.size() > 1 ? "component " + std::to_string(worst + 1) + " is " : "the result is ") +
         text(value[worst]) + ", true is " + text(truth[worst]);
}

// The first point of the scan at which the form is neither stable nor ill-conditioned; empty: none.
std::string first_wrong_of(const FormulaProblem& problem, std::string_view form, const FormulaEngine& engine,
                           const ode::StopFlag& stop) {
  if (!problem.scan) return "";
  for (const auto& point : problem.scan(engine.format())) {
    stop.check();
    const auto input = engine.rounded(point.input);
    if (!input) continue;
    const auto v = engine.evaluate(problem.name, form, *input);
    if (!v.refusal.empty() || !good(judge(problem, engine, point.input, *input, v.value).verdict))
      return point.label;
  }
  return "";
}

// Argument i of an input times 1 + (i + 1) 2^exponent.
FormulaInput perturbed(FormulaInput input, long exponent) {
  long factor = 0;
  for (auto& x : input.x) x += x * ++factor * power_of_two(exponent);
  return input;
}

// Whether the same code in RealHP<4> would have been a truth: what the type and RealHP<4> agree on is held
// against the truth, and against RealHP<4> at arguments that are 2^13 of its roundoffs away.
void compare_with_reference(const FormulaProblem& problem, std::string_view form, const FormulaEngine& engine,
                            const FormulaInput& stated, const FormulaInput& rounded,
                            const FormulaNumbers& value, const Judged& judged, StressRow& row) {
  const FormulaInput& input = problem.meant == Meant::as_stated ? stated : rounded;
  const auto reference = engine.evaluate_reference(problem.name, form, input);
  FormulaInput moved_input;
  {
    const WideExponentRange wide;
    moved_input = perturbed(input, 13 - engine.reference_bits());
  }
  const auto moved = engine.evaluate_reference(problem.name, form, moved_input);
  if (!reference.refusal.empty() || !moved.refusal.empty() || !finite(reference.value)) return;
  const WideExponentRange wide;
  const double half = std::sqrt(unit_roundoff(static_cast<int>(engine.format().precision)));
  const double reference_error = formula_error(reference.value, judged.truth, problem.norm);
  const bool agrees = formula_error(value, reference.value, problem.norm) <= half;
  const bool misleads = agrees && !(reference_error <= half);
  const bool moves = agrees && !(formula_error(moved.value, reference.value, problem.norm) <= half);
  row.figures["reference_error"] = reference_error;
  row.figures["agreement_misleads"] = misleads ? 1 : 0;
  row.figures["perturbed_evaluation_differs"] = moves ? 1 : 0;
  if (!misleads && !moves) return;
  row.why += row.why.empty() ? "" : "; ";
  row.why += "the type and RealHP<4> agree on half of the digits";
  if (misleads) row.why += ", and both are wrong";
  if (moves) row.why += "; arguments moved by 2^13 roundoffs of RealHP<4> give another value";
}

// A number as a figure, if double has it.
void note(StressRow& row, const std::string& name, const FormulaNumbers& v) {
  if (v.empty()) return;
  const double d = mpfr_get_d(v.front().backend().data(), MPFR_RNDN);
  if (std::isfinite(d) && (d != 0 || v.front() == 0)) row.figures[name] = d;
}

double digits_of(double error, const FloatFormat& format) {
  const double most = static_cast<double>(format.precision) * std::log10(2.0);
  if (error == 0) return most;
  if (!(error < 1)) return 0;
  return std::clamp(-std::log10(error), 0.0, most);
}

}  // namespace

double formula_error(const FormulaNumbers& value, const FormulaNumbers& truth, FormulaNorm norm) {
  if (value.size() != truth.size() || !finite(value)) return std::numeric_limits<double>::infinity();
  FormulaNumber largest_difference(0);
  double worst = 0;
  long differing = 0;
  for (std::size_t i = 0; i < value.size(); ++i) {
    const FormulaNumber difference(abs(FormulaNumber(value[i] - truth[i])));
    largest_difference = std::max(largest_difference, difference);
    worst = std::max(worst, ratio(difference, FormulaNumber(abs(truth[i]))));
    if (difference != 0) ++differing;
  }
  if (norm == FormulaNorm::signs) return static_cast<double>(differing) / static_cast<double>(value.size());
  return norm == FormulaNorm::each ? worst : ratio(largest_difference, largest_magnitude(truth));
}

double formula_condition(const FormulaProblem& problem, const FormulaInput& input) {
  if (problem.norm == FormulaNorm::signs) return 0;
  const FormulaNumbers f = problem.truth(input);
  const FormulaNumber step = power_of_two(kDifferenceExponent);
  std::vector<double> of_each(f.size(), 0);
  double of_largest = 0;
  for (std::size_t i = 0; i < input.x.size(); ++i) {
    if (input.x[i] == 0) continue;
    FormulaInput moved = input;
    moved.x[i] += moved.x[i] * step;
    FormulaNumbers difference = problem.truth(moved);
    for (std::size_t k = 0; k < f.size(); ++k) {
      difference[k] = abs(FormulaNumber(difference[k] - f[k])) / step;
      of_each[k] += ratio(difference[k], FormulaNumber(abs(f[k])));
    }
    of_largest += ratio(largest_magnitude(difference), largest_magnitude(f));
  }
  if (problem.norm == FormulaNorm::largest) return of_largest;
  return of_each.empty() ? 0 : *std::max_element(of_each.begin(), of_each.end());
}

std::optional<StressRow> judge_formula(const FormulaProblem& problem, const FormulaForm& form,
                                       const FormulaEngine& engine, const ode::StopFlag& stop) {
  stop.check();
  const FloatFormat format = engine.format();
  FormulaInput stated;
  {
    const WideExponentRange wide;
    stated = problem.input(format);
  }
  const auto rounded = engine.rounded(stated);
  if (!rounded) return std::nullopt;
  const auto result = engine.evaluate(problem.name, form.name, *rounded);
  StressRow row;
  if (!result.refusal.empty()) {
    row.why = result.refusal;
    row.first_wrong = problem.at;
    return row;
  }
  stop.check();
  const Judged judged = judge(problem, engine, stated, *rounded, result.value);
  row.verdict = judged.verdict;
  if (problem.norm != FormulaNorm::signs) {
    if (std::isfinite(judged.error)) row.error = judged.error;
    row.condition = judged.condition;
    row.correct_digits = digits_of(judged.error, format);
    note(row, "result", result.value);
    note(row, "truth", judged.truth);
    if (!good(row.verdict)) row.why = wrong_result(result.value, judged.truth);
  }
  row.first_wrong = first_wrong_of(problem, form.name, engine, stop);
  if (row.first_wrong.empty() && !good(row.verdict)) row.first_wrong = problem.at;
  if (!form.stall_form.empty()) {
    const auto stall = engine.evaluate(problem.name, form.stall_form, *rounded);
    if (stall.refusal.empty() && stall.value.front() != 0) {
      const long step = mpfr_get_si(stall.value.front().backend().data(), MPFR_RNDN);
      row.first_wrong = "n = " + std::to_string(step) + ", where it stalls";
      row.figures["stalls_at"] = static_cast<double>(step);
    }
  }
  if (problem.norm == FormulaNorm::signs && judged.error > 0) {
    const auto wrong = std::lround(judged.error * static_cast<double>(result.value.size()));
    row.figures["wrong_signs"] = static_cast<double>(wrong);
    const auto first = std::mismatch(result.value.begin(), result.value.end(), judged.truth.begin()).first;
    row.first_wrong = "sign " + std::to_string(first - result.value.begin() + 1) + " of " +
                      std::to_string(result.value.size());
    row.why = std::to_string(wrong) + " of " + std::to_string(result.value.size()) + " signs are wrong";
  }
  if (problem.referenced && problem.norm != FormulaNorm::signs) {
    stop.check();
    compare_with_reference(problem, form.name, engine, stated, *rounded, result.value, judged, row);
  }
  return row;
}

}  // namespace ulpgate
