// Records.
#include "harness/app/store/records.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "harness/app/reading/planned_rows.hpp"
#include "harness/app/shell/failure.hpp"
#include "harness/app/shell/files.hpp"

namespace ulpgate::app {

namespace {

// Of functions of libraries, so that whoever is told of a row can see it again.
void give_selections(RecordSet& set) {
  const auto foreign = set.context.find("foreign");
  if (foreign == set.context.end() || !foreign->is_array()) return;
  for (const auto& code : *foreign) {
    if (!code.is_object() || !code.contains("selection") || !code["selection"].is_string()) continue;
    for (auto& r : set.records) {
      if (code.value("function", Json()) == r.subject && code.value("type", Json()) == r.type)
        r.selection = " " + code["selection"].get<std::string>();
    }
  }
}

}  // namespace

RecordSet read_records(const std::filesystem::path& directory) {
  if (!std::filesystem::is_directory(directory)) {
    throw Failure(Standing::bad_input, fmt::format("{}: no such directory", directory.string()));
  }
  const auto holds = [&](const char* file) { return std::filesystem::exists(directory / file); };
  if (!holds(context_file) && !holds(math_records_file) && !holds(kernel_records_file)) {
    throw Failure(Standing::incomplete,
                  fmt::format("{}: nothing measured there: no {} or {}", directory.string(),
                              math_records_file, kernel_records_file));
  }
  RecordSet set;
  set.context = read_context(directory);
  const std::string context = (directory / context_file).string();
  const bool functions = set.context.contains("functions");
  for (const auto* key : {"planned", "shards", "seed", "samples", functions ? "functions" : "kernels"}) {
    if (!set.context.contains(key))
      throw Failure(Standing::bad_input, fmt::format("{}: '{}' is missing", context, key));
  }
  set.file = functions ? math_records_file : kernel_records_file;
  const char* other = functions ? kernel_records_file : math_records_file;
  if (holds(other)) {
    throw Failure(Standing::bad_input,
                  fmt::format("{}: records of another run than {}", (directory / other).string(), context));
  }
  const std::string text = read_records_text(directory, set.file);
  std::vector<std::string> places;
  for (auto& line : placed_lines(directory / set.file, text)) {
    set.records.push_back(from_json_line(line.text, line.place));
    const RowRecord& r = set.records.back();
    if (r.plan != set.context.at("plan").get<std::string>()) {
      throw Failure(Standing::bad_input,
                    fmt::format("{}: plan {} is not that of {}", line.place, r.plan, context_file));
    }
    places.push_back(std::move(line.place));
  }
  give_selections(set);
  set.absent = absent_rows(set.context, context, set.records, places);
  if (!set.absent.empty() && set.context.at("finished").get<bool>()) {
    throw Failure(Standing::incomplete,
                  fmt::format("{}: absent, though {} says that the run is finished: {}",
                              (directory / set.file).string(), context_file, some_of(set.absent)));
  }
  check_records_text(set.context, directory, set.file, text);
  return set;
}

RecordSet read_finished_records(const std::filesystem::path& out, const Plan& plan) {
  RecordSet set = read_records(out);
  if (set.context.at("planned") == planned_rows(plan)) return set;
  throw Failure(Standing::another_plan,
                fmt::format("{}: the rows that were planned are not those of this run, though plan {} is",
                            (out / context_file).string(), plan.hash()));
}

std::string records_text(std::vector<RowRecord> records) {
  std::ranges::sort(records, {}, [](const RowRecord& r) { return r.key(); });
  std::string text;
  for (const auto& r : records) text += to_json_line(r) + "\n";
  return text;
}

}  // namespace ulpgate::app
