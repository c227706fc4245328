// OpenMetrics 1.0 text (https://github.com/prometheus/OpenMetrics, specification, "Text format").
#include <fmt/format.h>

#include <cmath>

#include "harness/app/gate_output/output_text.hpp"
#include "harness/app/gate_output/outputs.hpp"

namespace ulpgate::app {

namespace {

// A label's value: backslash, double quote and line feed are escaped, everything else stands as it is.
std::string escaped_label(const std::string& text) {
  std::string out;
  for (const char c : valid_utf8(text)) {
    if (c == '\n') {
      out += "\\n";
      continue;
    }
    if (c == '\\' || c == '"') out += '\\';
    out += c;
  }
  return out;
}

std::string number(double x) {
  if (std::isnan(x)) return "NaN";
  if (std::isinf(x)) return x > 0 ? "+Inf" : "-Inf";
  return fmt::format("{}", x);
}

std::string head(const char* name, const char* type, const char* help) {
  return fmt::format("# TYPE {} {}\n# HELP {} {}\n", name, type, name, help);
}

// The samples of a family stand together: a figure of all rows, then the next figure.
void add_family(std::string& text, const std::vector<GateResult>& results, const char* name, const char* help,
                std::optional<double> JudgedRow::*figure) {
  text += head(name, "gauge", help);
  for (const auto& r : results) {
    for (const auto& row : r.rows) {
      if (!(row.*figure)) continue;
      text += fmt::format(
          "{}{{records=\"{}\",kind=\"{}\",type=\"{}\",row=\"{}\",stratum=\"{}\",figure=\"{}\"}} {}\n", name,
          escaped_label(r.records_directory), to_string(row.of), escaped_label(row.type),
          escaped_label(row.row), escaped_label(row.stratum), escaped_label(row.what),
          number(*(row.*figure)));
    }
  }
}

}  // namespace

std::string openmetrics_report(const std::vector<GateResult>& results) {
  std::string text;
  add_family(text, results, "ulpgate_measured", "Largest error or figure that was measured of a row.",
             &JudgedRow::measured);
  add_family(text, results, "ulpgate_budget", "Budget of that figure.", &JudgedRow::budget);
  add_family(text, results, "ulpgate_budget_ratio",
             "Largest part of a limit that was measured of a row; above 1 beyond it.", &JudgedRow::ratio);
  text += head("ulpgate_gate_findings", "gauge", "Findings of the gate by kind.");
  for (const auto& r : results) {
    for (std::size_t k = 0; k < finding_kind_count; ++k) {
      const auto kind = static_cast<FindingKind>(k);
      const auto n = count_of({r}, kind);
      text += fmt::format("ulpgate_gate_findings{{records=\"{}\",kind=\"{}\"}} {}\n",
                          escaped_label(r.records_directory), to_string(kind), n);
    }
  }
  text += head("ulpgate_gate_records", "gauge", "Records that were held against budgets.");
  for (const auto& r : results)
    text += fmt::format("ulpgate_gate_records{{records=\"{}\"}} {}\n", escaped_label(r.records_directory),
                        r.records);
  text += head("ulpgate_gate_exit_code", "gauge",
               "0 pass, 1 beyond a budget, 2 bad input or another plan, 3 incomplete, 4 crash or I/O.");
  for (const auto& r : results)
    text += fmt::format("ulpgate_gate_exit_code{{records=\"{}\"}} {}\n", escaped_label(r.records_directory),
                        exit_code(r.verdict.standing()));
  text += head("ulpgate_gate_budgets", "info", "Which budgets were used.");
  for (const auto& r : results)
    text += fmt::format("ulpgate_gate_budgets_info{{records=\"{}\",budgets=\"{}\",platform=\"{}\"}} 1\n",
                        escaped_label(r.records_directory), escaped_label(r.budgets_directory),
                        escaped_label(r.platform));
  return text + "# EOF\n";
}

}  // namespace ulpgate::app
