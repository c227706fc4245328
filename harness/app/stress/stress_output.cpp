// Records, table and verdicts of stiff and extreme cases.
#include "harness/app/stress/stress_output.hpp"

#include <fmt/format.h>

#include <cmath>

#include "harness/app/shell/failure.hpp"
#include "harness/app/terminal/terminal.hpp"
#include "harness/core/subject/registry.hpp"

namespace ulpgate::app {

namespace {

// A number, a word for what is none, or null.
Json number_or_word(const std::optional<double>& x) {
  if (!x) return nullptr;
  if (std::isnan(*x)) return "nan";
  if (std::isinf(*x)) return "inf";
  return *x;
}

std::optional<double> number_of(const Json& j) {
  if (j.is_null()) return std::nullopt;
  if (j == "nan") return std::nan("");
  if (j == "inf") return HUGE_VAL;
  return j.get<double>();
}

std::string reproducer_of(const StressMeasurement& m) {
  if (!m.row()->reproducer.empty()) return m.row()->reproducer;
  return fmt::format("ulpgate stress --cases {} --types {}", m.stress_case().key(), m.token());
}

StressStanding standing_of(const StressMeasurement& m) {
  return ulpgate::standing_of(m.stress_case(), m.token(), *m.row());
}

const StressMeasurement& of(const std::unique_ptr<Measurement>& m) {
  return dynamic_cast<const StressMeasurement&>(*m);
}

std::string number_text(const std::optional<double>& x) {
  return x ? fmt::format("{:.3g}", *x) : "-";
}

}  // namespace

Json stress_json(const StressRow& row) {
  Json figures = Json::object();
  for (const auto& [name, value] : row.figures) {
    if (std::isfinite(value)) figures[name] = value;
  }
  return {{"verdict", std::string(to_string(row.verdict))},
          {"error", number_or_word(row.error)},
          {"stepping_error", number_or_word(row.stepping_error)},
          {"condition", number_or_word(row.condition)},
          {"correct_digits", number_or_word(row.correct_digits)},
          {"first_wrong", row.first_wrong},
          {"why", row.why},
          {"figures", figures},
          {"reproducer", row.reproducer}};
}

StressRow stress_row_of(const Json& j) {
  try {
    StressRow row;
    const auto verdict = stress_verdict_of(j.at("verdict").get<std::string>());
    if (!verdict) throw std::invalid_argument("no verdict: " + j.at("verdict").dump());
    row.verdict = *verdict;
    row.error = number_of(j.at("error"));
    row.stepping_error = number_of(j.at("stepping_error"));
    row.condition = number_of(j.at("condition"));
    row.correct_digits = number_of(j.at("correct_digits"));
    row.first_wrong = j.at("first_wrong").get<std::string>();
    row.why = j.at("why").get<std::string>();
    for (const auto& [name, value] : j.at("figures").items()) row.figures[name] = value.get<double>();
    row.reproducer = j.at("reproducer").get<std::string>();
    return row;
  } catch (const Json::exception& e) {
    throw std::invalid_argument(std::string("no row of a stress case: ") + e.what());
  }
}

std::string stress_line(const StressMeasurement& m, const std::string& plan) {
  if (!m.row()) return "";
  const StressStanding standing = standing_of(m);
  const StressCase& c = m.stress_case();
  Json j = stress_json(*m.row());
  j["what"] = "stress";
  j["kind"] = c.kind;
  j["case"] = c.name;
  j["form"] = c.form;
  j["title"] = c.title;
  j["type"] = m.token();
  j["roundoff"] = unit_roundoff(find_type(m.token())->significand_bits);
  j["expected"] = standing.expected;
  j["as_known"] = standing.as_known;
  j["cause"] = standing.cause;
  j["reproducer"] = reproducer_of(m);
  j["plan"] = plan;
  return j.dump() + "\n";
}

std::string stress_table(const StressJob& job) {
  std::vector<std::vector<std::string>> rows(1, {"case"});
  for (const auto& token : job.types) rows.front().push_back(token);
  for (std::size_t i = 0; i < job.cases.size(); ++i) {
    std::vector<std::string> row(1, job.cases[i]->key());
    bool any = false;
    for (std::size_t t = 0; t < job.types.size(); ++t) {
      const StressMeasurement& m = of(job.measurements[i * job.types.size() + t]);
      if (!m.row()) {
        row.emplace_back(m.complete() ? "." : "");
        continue;
      }
      any = true;
      const bool as_known = standing_of(m).as_known;
      row.push_back(fmt::format("{}{}{}", as_known ? "" : "!", letter_of(m.row()->verdict),
                                m.row()->error ? fmt::format(" {:.1e}", *m.row()->error) : ""));
    }
    if (any) rows.push_back(std::move(row));
  }
  return "S stable, I ill-conditioned, U unstable, W wrong, D diverged, R refused\n" +
         aligned(rows, "l" + std::string(job.types.size(), 'r'));
}

StressFindings judge_stress_job(const StressJob& job) {
  StressFindings findings;
  for (const auto& one : job.measurements) {
    const StressMeasurement& m = of(one);
    if (!m.row()) continue;
    ++findings.judged;
    const StressStanding standing = standing_of(m);
    if (standing.as_known) continue;
    const StressRow& row = *m.row();
    findings.unexplained.push_back(fmt::format(
        "{} {}: {}, known is {}{}: error {}, condition {}{}{}\n  {}", m.stress_case().key(), m.token(),
        to_string(row.verdict), standing.expected,
        standing.says.empty() ? "" : fmt::format(" with \"{}\"", standing.says), number_text(row.error),
        number_text(row.condition), row.first_wrong.empty() ? "" : ", first wrong " + row.first_wrong,
        row.why.empty() ? "" : ": " + row.why, reproducer_of(m)));
  }
  return findings;
}

Json to_json(const StressFindings& findings) {
  return {{"judged", findings.judged}, {"unexplained", findings.unexplained}};
}

StressFindings stress_findings_of(const Json& j, const std::string& place) {
  try {
    return {j.at("judged").get<std::size_t>(), j.at("unexplained").get<std::vector<std::string>>()};
  } catch (const Json::exception& e) {
    throw Failure(Standing::bad_input, fmt::format("{}: no verdicts: {}", place, e.what()));
  }
}

}  // namespace ulpgate::app
