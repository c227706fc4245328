// JUnit XML, as GitLab and the readers on GitHub take it (the schema junit-10.xsd of Jenkins' xunit plugin).
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "harness/app/gate_output/output_text.hpp"
#include "harness/app/gate_output/outputs.hpp"

namespace ulpgate::app {

namespace {

// In text and in attributes.  XML 1.0 has no other control characters than tab, line feed and carriage
// return, and attributes would turn these into blanks.
std::string escaped_xml(const std::string& text) {
  std::string out;
  for (const char c : valid_utf8(text)) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\n':
        out += "&#10;";
        break;
      case '\t':
        out += "&#9;";
        break;
      default:
        out += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
    }
  }
  return out;
}

struct TestCase {
  std::string of;  // class
  std::string name;
  std::vector<const GateFinding*> failing;  // the worst first
  std::vector<const GateFinding*> notes;
  std::vector<std::string> remarks;
};

bool is_failure(const TestCase& t) {
  return !t.failing.empty() && standing_of(t.failing.front()->kind) == Standing::regression;
}
bool is_error(const TestCase& t) {
  return !is_failure(t) && (!t.failing.empty() || !t.remarks.empty());
}

// One for the whole directory, then one a row of a type, in the order of the records.
std::vector<TestCase> cases_of(const GateResult& r) {
  std::vector<TestCase> cases = {{"ulpgate.gate", r.records_directory, {}, {}, r.remarks}};
  std::map<std::pair<std::string, std::string>, std::size_t> known;
  const auto at = [&](RowKind of, const std::string& type, const std::string& row) -> TestCase& {
    const auto [place, fresh] = known.try_emplace({type, row}, cases.size());
    if (fresh) cases.push_back({fmt::format("ulpgate.{}.{}", to_string(of), type), row, {}, {}, {}});
    return cases[place->second];
  };
  for (const JudgedRow& row : r.rows) at(row.of, row.type, row.row);
  for (const GateFinding& f : r.findings) {
    TestCase& t = at(f.of, f.type, f.row);
    (f.kind == FindingKind::could_lower ? t.notes : t.failing).push_back(&f);
  }
  // Whatever makes the directory red or incomplete without a row is its own.
  const bool told =
      std::ranges::any_of(cases, [](const TestCase& t) { return is_failure(t) || is_error(t); });
  if (!told && !r.verdict.passes()) cases.front().remarks.emplace_back("there is no verdict");
  return cases;
}

std::string body_of(const TestCase& t) {
  std::string text;
  for (const auto& remark : t.remarks) text += remark + "\n";
  for (const auto* f : t.failing) {
    text += fmt::format("{} {}\n", label_of(f->kind), f->message);
    for (const auto& [name, value] : details_of(*f)) text += fmt::format("  {}: {}\n", name, value);
  }
  return text;
}

std::string case_text(const TestCase& t) {
  std::string text = fmt::format("    <testcase classname=\"{}\" name=\"{}\" time=\"0\"", escaped_xml(t.of),
                                 escaped_xml(t.name));
  if (!is_failure(t) && !is_error(t) && t.notes.empty()) return text + "/>\n";
  text += ">\n";
  if (is_failure(t) || is_error(t)) {
    const char* element = is_failure(t) ? "failure" : "error";
    const std::string message = t.failing.empty() ? t.remarks.front() : t.failing.front()->message;
    const std::string type =
        t.failing.empty() ? "no_verdict" : std::string(to_string(t.failing.front()->kind));
    text += fmt::format("      <{} message=\"{}\" type=\"{}\">{}</{}>\n", element, escaped_xml(message), type,
                        escaped_xml(body_of(t)), element);
  }
  if (!t.notes.empty()) {
    std::string notes;
    for (const auto* f : t.notes) notes += "note: " + f->message + "\n";
    text += fmt::format("      <system-out>{}</system-out>\n", escaped_xml(notes));
  }
  return text + "    </testcase>\n";
}

}  // namespace

std::string junit_report(const std::vector<GateResult>& results) {
  std::string suites;
  std::size_t tests = 0;
  std::size_t failures = 0;
  std::size_t errors = 0;
  for (const GateResult& r : results) {
    const auto cases = cases_of(r);
    const auto failed = static_cast<std::size_t>(std::ranges::count_if(cases, is_failure));
    const auto wrong = static_cast<std::size_t>(std::ranges::count_if(cases, is_error));
    suites += fmt::format(
        "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"0\" time=\"0\">\n",
        escaped_xml(r.records_directory), cases.size(), failed, wrong);
    suites += fmt::format(
        "    <properties>\n      <property name=\"budgets\" value=\"{}\"/>\n      <property "
        "name=\"platform\" "
        "value=\"{}\"/>\n    </properties>\n",
        escaped_xml(r.budgets_directory), escaped_xml(r.platform));
    for (const auto& t : cases) suites += case_text(t);
    suites += "  </testsuite>\n";
    tests += cases.size();
    failures += failed;
    errors += wrong;
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"ulpgate gate\" tests=\"{}\" "
      "failures=\"{}\" "
      "errors=\"{}\" time=\"0\">\n{}</testsuites>\n",
      tests, failures, errors, suites);
}

}  // namespace ulpgate::app
