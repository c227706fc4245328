// Findings of the gate.
#include "harness/core/gate/findings/gate_finding.hpp"

#include <mpfr.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "reference/types/mpfr_value.hpp"

namespace ulpgate {

std::string_view to_string(RowKind kind) {
  constexpr std::array<std::string_view, row_kind_count> names = {
      "function", "kernel", "scene", "order", "drift", "stress", "work_precision"};
  return names[static_cast<std::size_t>(kind)];
}

std::string_view to_string(FindingKind kind) {
  constexpr std::array<std::string_view, finding_kind_count> names = {
      "regression",     "other_results", "another_plan", "missing_budget",
      "missing_record", "incomplete",    "lost_cases",   "could_lower"};
  return names[static_cast<std::size_t>(kind)];
}

std::pair<FindingKind, double> finding_rank(const GateFinding& f) {
  // A severity that is no number is as bad as any: with NaN an order would be none.
  return {f.kind, std::isnan(f.severity) ? -HUGE_VAL : -f.severity};
}

void sort_findings(std::vector<GateFinding>& findings) {
  std::ranges::stable_sort(findings, {}, finding_rank);
}

double budget_ratio(double measured, double limit) {
  if (limit > 0) return measured / limit;
  return measured == 0 ? 0 : HUGE_VAL;
}

std::string with_decimal(const std::string& text) {
  if (text.find("0x") == std::string::npos) return text;
  // Twice the digits of any type, so that the decimal digits are those of the number.
  MpfrValue value(4096);
  char* end = nullptr;
  mpfr_strtofr(value.get(), text.c_str(), &end, 0, MPFR_RNDN);
  if (*end != '\0' || mpfr_number_p(value.get()) == 0) return text;
  std::array<char, 64> decimal{};
  mpfr_snprintf(decimal.data(), decimal.size(), "%.17Rg", value.get());
  return text + " (" + decimal.data() + ")";
}

}  // namespace ulpgate
