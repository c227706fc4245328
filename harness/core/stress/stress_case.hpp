// StressCase: a stiff or extreme problem with a truth, run in one type at a time; StressRow: what it came to.
//
// Condition belongs to the problem, stability to the algorithm (N. J. Higham, Accuracy and Stability of
// Numerical Algorithms, 2nd ed. 2002, 1.5 to 1.7): a row carries both, and the verdict compares them.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kernels/ode/stepper/stop_flag.hpp"

namespace ulpgate {

enum class StressVerdict {
  stable,           // E <= 16 kappa u
  ill_conditioned,  // E <= 16 kappa u, but kappa u > sqrt u: the problem loses more than half of the digits
  unstable,         // E > 16 kappa u: the algorithm loses more than the problem makes it lose
  wrong_outcome,    // another contact, stick for slip, sign, branch or count than the truth has
  diverged,         // not finite, or beyond a stated multiple of what is conserved
  refused,          // an error with a text: outside the domain, no convergence, a step above a proven limit
};
[[nodiscard]] std::string_view to_string(StressVerdict verdict);  // "ill_conditioned"
// The letter of a table's cell: S I U W D R.
[[nodiscard]] char letter_of(StressVerdict verdict);
[[nodiscard]] std::optional<StressVerdict> stress_verdict_of(std::string_view text);

// stable, ill_conditioned or unstable from the normwise relative error E of rounding, the condition number
// kappa of the problem (at least 1 is used: arguments are rounded) and the unit roundoff u; diverged where E
// is not finite.
[[nodiscard]] StressVerdict judge_stress(double error, double condition, double roundoff);

// 2^-p of a type with p significand bits: 0.5 ulp of 1.
[[nodiscard]] double unit_roundoff(int significand_bits);

// What is known of a case: where a verdict other than stable and ill_conditioned is a property of the method
// or of the type, and which.
struct KnownVerdict {
  std::string types;  // "all", or tokens separated by commas
  StressVerdict verdict;
  std::string cause;  // one sentence: why it is so, and of what it is a property
  // Of a refusal, part of its text that other refusals do not have: one with another text is not the known
  // one, and where this is empty none is.
  std::string says = {};
};

struct StressRow {
  StressVerdict verdict = StressVerdict::refused;
  std::optional<double> error;           // E of rounding alone, relative and normwise
  std::optional<double> stepping_error;  // of the method at this step, in exact arithmetic; relative
  std::optional<double> condition;       // kappa; of a trajectory that of every step's perturbations together
  std::optional<double>
      correct_digits;       // of the result against the truth, by both errors, at most the type's
  std::string first_wrong;  // the first step or argument at which it goes wrong; empty: nowhere
  std::string why;          // the error's text of a refusal, or what a wrong outcome consists of
  std::map<std::string, double> figures;  // further numbers of the case by name, finite
  std::string reproducer;  // a command that shows it alone; empty: the default, the case by its name
};

struct StressCase {
  std::string kind;  // "formula", "trajectory", "state", "scene", "metamorphic", "step_limit"
  std::string name;  // "rump_1988", "robertson", "far_from_the_origin"
  std::string form;  // what varies under one name: "naive", "stable", an integrator; empty where nothing does
  std::string title;  // what it is, in a few words with its source
  std::vector<KnownVerdict> known;
  double cost = 1;  // seconds in double, roughly: the longest begin first
  // In the type of a token; nothing where the case does not exist in this type.  Bytes depend on nothing but
  // the type.  Throws ode::Stopped when the flag is raised.
  std::function<std::optional<StressRow>(std::string_view token, const ode::StopFlag& stop)> run;

  // "formula/rump_1988/naive"
  [[nodiscard]] std::string key() const { return kind + "/" + name + (form.empty() ? "" : "/" + form); }
};

// How a row stands against what is known of its case.
struct StressStanding {
  bool as_known;         // stable or ill_conditioned with nothing else known, or the verdict that is known
  std::string cause;     // of the known verdict
  std::string expected;  // "stable", or the known verdict of this type
  std::string says;      // of a known refusal: the part of its text that is held to
};
[[nodiscard]] StressStanding standing_of(const StressCase& c, std::string_view token, const StressRow& row);

}  // namespace ulpgate
