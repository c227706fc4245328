// Records of stiff and extreme cases.
#include "harness/app/gate/stress_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "harness/app/reading/line_kinds.hpp"
#include "harness/core/stress/stress_case.hpp"

namespace ulpgate::app {

namespace {

using namespace field;

bool is_what(const Json& j) {
  return j == "stress";
}
bool is_verdict(const Json& j) {
  return j.is_string() && stress_verdict_of(j.get<std::string>());
}
bool are_figures(const Json& j) {
  return j.is_object() && std::ranges::all_of(j, field::number.accepts);
}
constexpr FieldKind what_word = {"\"stress\"", is_what};
constexpr FieldKind verdict_word = {"a verdict", is_verdict};
constexpr FieldKind figures = {"an object of numbers", are_figures};

constexpr std::array<Field, 20> fields = {{{"what", what_word},
                                           {"kind", name},
                                           {"case", word},
                                           {"form", text},
                                           {"title", text},
                                           {"type", word},
                                           {"roundoff", number},
                                           {"verdict", verdict_word},
                                           {"expected", verdict_word},
                                           {"as_known", flag},
                                           {"cause", text},
                                           {"error", size},
                                           {"stepping_error", size},
                                           {"condition", size},
                                           {"correct_digits", number},
                                           {"first_wrong", text},
                                           {"why", text},
                                           {"figures", figures},
                                           {"reproducer", word},
                                           {"plan", hash}}};
constexpr std::array<std::string_view, 4> key = {"kind", "case", "form", "type"};

std::string contradiction(const Json& row) {
  const std::string verdict = row.at("verdict");
  const bool good = verdict == "stable" || verdict == "ill_conditioned";
  const std::string expected = row.at("expected");
  const bool as_known = verdict == expected || (good && expected == "stable");
  // The other way round a refusal may be for another reason than the known one.
  if (row.at("as_known").get<bool>() && !as_known)
    return fmt::format("'as_known', but the verdict is {} and {} is expected", verdict, expected);
  return "";
}

const LineKind stress_lines = {stress_records_file, fields, key, contradiction};

}  // namespace

std::vector<MeasuredRow> stress_rows(const std::filesystem::path& directory, const Json& context) {
  std::vector<MeasuredRow> rows;
  for (const PlacedRow& row : read_rows(directory, context, stress_lines)) {
    const Json& j = row.row;
    MeasuredRow& m = rows.emplace_back();
    const std::string form = j.at("form");
    m.of = RowKind::stress;
    m.name = j.at("kind");
    m.type = j.at("type");
    m.run = j.at("case").get<std::string>() + (form.empty() ? "" : "/" + form);
    m.outcome = j.at("verdict");
    // Only finite errors have a budget: the verdict says the rest.
    if (j.at("error").is_number()) m.figures["error"] = j.at("error").get<double>();
    m.reproduce = j.at("reproducer");
    if (j.at("as_known").get<bool>()) continue;
    const std::string first_wrong = j.at("first_wrong");
    const std::string why = j.at("why");
    m.got = m.outcome + (first_wrong.empty() ? "" : ", first wrong " + first_wrong) +
            (why.empty() ? "" : ": " + why);
    m.wanted = j.at("expected");
    m.breach =
        fmt::format("{}, known is {}: error {}, condition {}{}{}", m.outcome, m.wanted, j.at("error").dump(),
                    j.at("condition").dump(), first_wrong.empty() ? "" : ", first wrong " + first_wrong,
                    why.empty() ? "" : ": " + why);
  }
  return rows;
}

}  // namespace ulpgate::app
