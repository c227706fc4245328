// Names of verdicts, the rule that gives them, and what is known of a case.
#include "harness/core/stress/stress_case.hpp"

#include <array>
#include <cmath>
#include <utility>

namespace ulpgate {

namespace {

struct VerdictName {
  StressVerdict verdict;
  std::string_view name;
  char letter;
};
constexpr std::array<VerdictName, 6> verdict_names{{
    {StressVerdict::stable, "stable", 'S'},
    {StressVerdict::ill_conditioned, "ill_conditioned", 'I'},
    {StressVerdict::unstable, "unstable", 'U'},
    {StressVerdict::wrong_outcome, "wrong_outcome", 'W'},
    {StressVerdict::diverged, "diverged", 'D'},
    {StressVerdict::refused, "refused", 'R'},
}};

bool names_type(std::string_view types, std::string_view token) {
  if (types == "all") return true;
  while (!types.empty()) {
    const std::size_t end = std::min(types.find(','), types.size());
    if (types.substr(0, end) == token) return true;
    types.remove_prefix(std::min(end + 1, types.size()));
  }
  return false;
}

}  // namespace

std::string_view to_string(StressVerdict verdict) {
  return verdict_names[static_cast<std::size_t>(verdict)].name;
}

char letter_of(StressVerdict verdict) {
  return verdict_names[static_cast<std::size_t>(verdict)].letter;
}

std::optional<StressVerdict> stress_verdict_of(std::string_view text) {
  for (const auto& v : verdict_names) {
    if (v.name == text) return v.verdict;
  }
  return std::nullopt;
}

StressVerdict judge_stress(double error, double condition, double roundoff) {
  if (!std::isfinite(error)) return StressVerdict::diverged;
  // A condition that is no number excuses nothing.
  const double kappa = condition > 1 ? condition : 1;
  if (!(error <= 16 * kappa * roundoff)) return StressVerdict::unstable;
  return kappa * roundoff > std::sqrt(roundoff) ? StressVerdict::ill_conditioned : StressVerdict::stable;
}

double unit_roundoff(int significand_bits) {
  return std::ldexp(1.0, -significand_bits);
}

StressStanding standing_of(const StressCase& c, std::string_view token, const StressRow& row) {
  for (const auto& known : c.known) {
    if (!names_type(known.types, token)) continue;
    const bool text_holds = known.verdict != StressVerdict::refused ||
                            (!known.says.empty() && row.why.find(known.says) != std::string::npos);
    return {row.verdict == known.verdict && text_holds, known.cause, std::string(to_string(known.verdict)),
            known.says};
  }
  const bool good = row.verdict == StressVerdict::stable || row.verdict == StressVerdict::ill_conditioned;
  return {good, "", "stable", ""};
}

}  // namespace ulpgate
