// Records of work and precision read back.
#include "harness/app/advice/work_precision_records.hpp"

#include <fmt/format.h>

#include <array>

#include "harness/app/advice/work_precision_output.hpp"
#include "harness/app/machine/machine_facts.hpp"
#include "harness/app/shell/failure.hpp"

namespace ulpgate::app {

namespace {

using namespace field;

bool is_what(const Json& j) {
  return j == "work_precision";
}
bool is_subject(const Json& j) {
  return j.is_string() && work_subject_of(j.get<std::string>());
}
bool is_failure(const Json& j) {
  return j.is_null() ||
         (j.is_string() && !j.get<std::string>().empty() && work_failure_of(j.get<std::string>()));
}
bool is_time(const Json& j) {
  return j.is_number() && j.get<double>() >= 0;
}

constexpr FieldKind what_word = {"\"work_precision\"", is_what};
constexpr FieldKind subject_word = {"a kind of subject", is_subject};
constexpr FieldKind failure_word = {"a failure, or null", is_failure};
constexpr FieldKind time_kind = {"a number from 0 on", is_time};

constexpr std::array<Field, 25> fields = {{{"what", what_word},
                                           {"subject", subject_word},
                                           {"name", name},
                                           {"type", word},
                                           {"integrator", word, optional},
                                           {"end", word, optional},
                                           {"planned", flag, optional},
                                           {"steps", steps, optional},
                                           {"dt", positive, optional},
                                           {"dt_text", word, optional},
                                           {"failure", failure_word},
                                           {"why", text, optional},
                                           {"steps_taken", count, optional},
                                           {"evaluations", count},
                                           {"final_error", size},
                                           {"largest_error", size},
                                           {"largest_error_ulp", size, optional},
                                           {"energy_error", size},
                                           {"reference_error", size},
                                           {"instants", steps, optional},
                                           {"t_s", time_kind, optional},
                                           {"t_s_to_the_end", flag, optional},
                                           {"growth_rate", number, optional},
                                           {"correct_digits", size},
                                           {"regime", word, optional}}};
// And the plan, which read_rows holds to the context.
constexpr auto all_fields = [] {
  std::array<Field, fields.size() + 1> all{};
  for (std::size_t i = 0; i < fields.size(); ++i) all[i] = fields[i];
  all.back() = {"plan", hash};
  return all;
}();
constexpr std::array<std::string_view, 7> key = {"subject", "name",  "type",   "integrator",
                                                 "end",     "steps", "dt_text"};

std::string contradiction_of(const Json& row) {
  const bool curve = row.contains("integrator");
  for (const auto* field : {"end", "steps", "dt", "steps_taken"})
    if (row.contains(field) != curve) return fmt::format("'integrator' and '{}' go together", field);
  if (row.value("planned", false) != row.value("dt_text", "").starts_with(plan_mark))
    return "'planned' and a dt_text of a plan go together";
  const bool failed = !row.at("failure").is_null();
  const bool error = !row.at("final_error").is_null() || !row.at("largest_error").is_null();
  if (failed && error) return "a setting that failed has no error";
  if (!failed && !error) return "a setting that did not fail has an error";
  return "";
}

std::optional<double> optional_number(const Json& row, const char* field) {
  const auto it = row.find(field);
  if (it == row.end() || !it->is_number()) return std::nullopt;
  return it->get<double>();
}

WorkPrecisionRow row_of(const Json& j) {
  WorkPrecisionRow row;
  WorkSetting& s = row.setting;
  s.subject = *work_subject_of(j.at("subject").get<std::string>());
  s.name = j.at("name");
  s.type = j.at("type");
  s.integrator = j.value("integrator", "");
  s.end = j.value("end", "");
  s.dt = j.value("dt_text", "");
  s.steps = j.value("steps", std::uint64_t{0});
  s.dt_value = optional_number(j, "dt").value_or(0);
  WorkOutcome& o = row.outcome;
  if (j.at("failure").is_string()) o.failure = *work_failure_of(j.at("failure").get<std::string>());
  o.why = j.value("why", "");
  o.steps = j.value("steps_taken", std::uint64_t{0});
  o.evaluations = j.at("evaluations");
  o.final_error = optional_number(j, "final_error");
  o.largest_error = optional_number(j, "largest_error");
  o.largest_error_ulp = optional_number(j, "largest_error_ulp");
  o.energy_error = optional_number(j, "energy_error");
  o.reference_error = optional_number(j, "reference_error");
  if (j.contains("instants")) o.instants = j.at("instants").get<std::uint64_t>();
  o.t_s = optional_number(j, "t_s");
  o.t_s_to_the_end = j.value("t_s_to_the_end", false);
  o.growth_rate = optional_number(j, "growth_rate");
  o.correct_digits = optional_number(j, "correct_digits");
  return row;
}

}  // namespace

const LineKind work_precision_lines = {work_precision_file, all_fields, key, contradiction_of};

std::map<std::string, KnownSetting> read_work_precision(const std::filesystem::path& directory) {
  const Json context = read_context(directory);
  const SettingTimes times = read_times(directory / times_file, context.at("plan"));
  if (!times.samples_s.empty()) {
    const auto differences = machine_differences(context, machine_facts());
    if (!differences.empty()) {
      throw Failure(Standing::another_machine,
                    fmt::format("{}: its times are of another machine or program: {}", directory.string(),
                                differences.front()));
    }
  }
  std::map<std::string, KnownSetting> known;
  for (const auto& placed : read_rows(directory, context, work_precision_lines)) {
    KnownSetting setting{placed.place, row_of(placed.row), std::nullopt};
    const std::string key_text = setting.row.setting.key();
    if (const auto time = times.summary(key_text)) setting.seconds = time->minimum_s;
    known.emplace(key_text, std::move(setting));
  }
  return known;
}

}  // namespace ulpgate::app
