// What a form of a problem came to in one type: one StressRow.
#pragma once

#include "harness/core/formula_cases/formula_problem.hpp"

namespace ulpgate {

// Relative distance of a value from the truth by the problem's norm, at most 1e300; infinity where a
// component is not finite, of signs the share that differs.  0/0 is 0.
[[nodiscard]] double formula_error(const FormulaNumbers& value, const FormulaNumbers& truth,
                                   FormulaNorm norm);

// Relative condition number of the problem at an input: sum over arguments of |x df/dx| / |f| by differences
// of the truth at steps of 2^-700, in the problem's norm; 0 of signs.
[[nodiscard]] double formula_condition(const FormulaProblem& problem, const FormulaInput& input);

// Throws std::invalid_argument for a form that the engine does not know; nothing where an argument of the
// problem is no number of the type.
[[nodiscard]] std::optional<StressRow> judge_formula(const FormulaProblem& problem, const FormulaForm& form,
                                                     const FormulaEngine& engine, const ode::StopFlag& stop);

}  // namespace ulpgate
