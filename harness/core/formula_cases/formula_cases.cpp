// formula_cases(): the forms of every problem as stress cases.
#include "harness/core/formula_cases/formula_cases.hpp"

#include "harness/core/formula_cases/formula_judgement.hpp"

namespace ulpgate {

std::vector<StressCase> formula_cases() {
  std::vector<StressCase> cases;
  for (const FormulaProblem& problem : formula_problems()) {
    for (const FormulaForm& form : problem.forms) {
      cases.push_back(
          {"formula", problem.name, form.name, problem.title, form.known, problem.cost,
           [&problem, &form](std::string_view token, const ode::StopFlag& stop) -> std::optional<StressRow> {
             const FormulaEngine* engine = find_formula_engine(token);
             if (engine == nullptr || !exists_in(problem, token)) return std::nullopt;
             return judge_formula(problem, form, *engine, stop);
           }});
    }
  }
  return cases;
}

}  // namespace ulpgate
