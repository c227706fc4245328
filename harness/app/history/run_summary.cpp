// Run summary.
#include "harness/app/history/run_summary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>
#include <span>

#include "harness/app/machine/machine_facts.hpp"
#include "harness/app/reading/line_kinds.hpp"
#include "harness/app/shell/failure.hpp"
#include "harness/app/shell/files.hpp"
#include "harness/app/store/records.hpp"
#include "harness/core/arguments/random_words.hpp"
#include "harness/core/trend/time_noise.hpp"

namespace ulpgate::app {

namespace {

constexpr const char* setting_times_file = "work_precision_timing.jsonl";

// Lines that have a strict reader go through it; of the others the checksum is held to the context's.
void check_lines(const std::filesystem::path& directory, const Json& context, const RowKind& kind) {
  if (kind.file == math_records_file || kind.file == kernel_records_file) {
    const RecordSet set = read_records(directory);
    if (!set.absent.empty())
      throw Failure(Standing::incomplete,
                    fmt::format("{}: rows are absent: {}", directory.string(), set.absent.front()));
    return;
  }
  for (const auto* lines : {&scene_lines, &correlation_lines, &order_lines, &drift_lines}) {
    if (lines->file != kind.file) continue;
    static_cast<void>(read_rows(directory, context, *lines));
    return;
  }
}

void add_rows(RunSummary& run, const Json& context, const RowKind& kind) {
  const std::string file(kind.file);
  check_lines(run.directory, context, kind);
  const std::string text = read_records_text(run.directory, file);
  for (const auto& line : placed_lines(run.directory / file, text)) {
    const Json row = parse_object(line.text, line.place);
    const auto name = row.find(std::string(kind.name));
    if (name == row.end() || !name->is_string() || !row.contains("type"))
      throw Failure(Standing::bad_input, fmt::format("{}: no '{}' or no 'type'", line.place, kind.name));
    const auto implementation = row.find("implementation");
    const bool named = implementation != row.end() && implementation->is_string();
    const auto [at, fresh] = run.rows.emplace(
        key_of(kind, row),
        SummaryRow{named ? implementation->get<std::string>() : "", result_of(&kind, figures_of(kind, row))});
    if (!fresh)
      throw Failure(Standing::bad_input,
                    fmt::format("{}: a second record of {}", line.place, at->first.text()));
  }
  check_records_text(context, run.directory, file, text);
}

std::vector<double> positive_numbers(const Json& line, const char* key, double scale,
                                     const std::string& place) {
  std::vector<double> numbers;
  const auto it = line.find(key);
  if (it == line.end()) return numbers;
  const bool good = it->is_array() && std::ranges::all_of(*it, field::is_positive);
  if (!good) throw Failure(Standing::bad_input, fmt::format("{}: '{}' is no list of times", place, key));
  for (const auto& x : *it) numbers.push_back(scale * x.get<double>());
  return numbers;
}

std::vector<PlacedLine> lines_if_there(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) return {};
  return placed_lines(file, read_file(file));
}

std::string word(const Json& line, const char* key, const std::string& place) {
  const auto it = line.find(key);
  if (it == line.end() || !it->is_string())
    throw Failure(Standing::bad_input, fmt::format("{}: '{}' is not a text", place, key));
  return it->get<std::string>();
}

// Lists of lists of times, one for each process, one after the other.
std::vector<double> of_processes(const Json& row, const char* key, const std::string& place,
                                 std::size_t& processes) {
  const auto it = row.find(key);
  if (it == row.end() || !it->is_array() || it->empty())
    throw Failure(Standing::bad_input, fmt::format("{}: '{}' is no list of processes", place, key));
  std::vector<double> all;
  for (const auto& process : *it) {
    const auto times = positive_numbers({{key, process}}, key, 1e-9, place);
    if (times.empty() || process.size() != it->front().size())
      throw Failure(Standing::bad_input,
                    fmt::format("{}: '{}': the processes have not as many times each", place, key));
    all.insert(all.end(), times.begin(), times.end());
  }
  processes = it->size();
  return all;
}

void add_repeated_times(RunSummary& run) {
  for (const auto& line : lines_if_there(run.directory / timing_repeats_file)) {
    const Json row = parse_object(line.text, line.place);
    TimedRow times;
    times.seconds = of_processes(row, "ns", line.place, times.processes);
    std::size_t processes = 0;
    times.baseline_s = of_processes(row, "baseline_ns", line.place, processes);
    if (processes != times.processes || times.seconds.size() != times.baseline_s.size())
      throw Failure(Standing::bad_input,
                    fmt::format("{}: 'ns' and 'baseline_ns' must be as long as each other", line.place));
    run.times[{"time", word(row, "what", line.place), "", word(row, "type", line.place), ""}] =
        std::move(times);
  }
}

// One time a row, where no repeats were kept; scenes have theirs in the same file.
void add_single_times(RunSummary& run) {
  for (const auto& line : lines_if_there(run.directory / timing_file)) {
    const Json row = parse_object(line.text, line.place);
    const std::string what = word(row, "what", line.place);
    const std::string type = word(row, "type", line.place);
    if (what != "scene") {
      const auto ns = row.find("ns_per_eval");
      if (ns == row.end() || !field::is_positive(*ns))
        throw Failure(Standing::bad_input, fmt::format("{}: 'ns_per_eval' is no time", line.place));
      run.times.try_emplace({"time", what, "", type, ""}, TimedRow{{1e-9 * ns->get<double>()}, {}, 1});
      continue;
    }
    TimedRow times{positive_numbers(row, "step_s", 1, line.place), {}, 1};
    const auto rate = row.find("iterations_per_s");
    if (times.seconds.empty() && rate != row.end() && field::is_positive(*rate))
      times.seconds.push_back(1 / rate->get<double>());
    if (times.seconds.empty()) continue;
    const std::string setting =
        fmt::format("{} steps, {} threads", row.value("steps", 0), row.value("threads", 1));
    run.times.try_emplace({"scene time", word(row, "scene", line.place), "", type, setting},
                          std::move(times));
  }
}

void add_setting_times(RunSummary& run) {
  for (const auto& line : lines_if_there(run.directory / setting_times_file)) {
    const Json row = parse_object(line.text, line.place);
    TimedRow times{positive_numbers(row, "samples_s", 1, line.place), {}, 1};
    if (!times.seconds.empty())
      run.times.try_emplace({"setting time", word(row, "name", line.place), "", word(row, "type", line.place),
                             word(row, "key", line.place)},
                            std::move(times));
  }
}

std::int64_t written_at(const std::filesystem::path& file) {
  const auto since =
      std::chrono::file_clock::to_sys(std::filesystem::last_write_time(file)).time_since_epoch();
  return std::chrono::duration_cast<std::chrono::seconds>(since).count();
}

std::uint64_t add_to_digest(std::uint64_t digest, const std::filesystem::path& file) {
  return std::filesystem::exists(file) ? fnv1a(read_file(file), digest) : digest;
}

}  // namespace

std::vector<double> TimedRow::relative() const {
  const std::size_t part = seconds.size() / processes;
  std::vector<double> logs;
  for (std::size_t i = 0; i < processes * part; ++i) {
    // A disturbance of the fixed work itself must not pass for a fast repeat.
    const double baseline =
        baseline_s.empty() ? 1 : typical_time(std::span(baseline_s).subspan(i / part * part, part));
    logs.push_back(std::log(seconds[i] / baseline));
  }
  return logs;
}

std::vector<double> TimedRow::process_levels() const {
  const std::vector<double> logs = relative();
  const std::size_t part = logs.size() / processes;
  std::vector<double> levels;
  for (std::size_t p = 0; p < processes; ++p)
    levels.push_back(typical_time(std::span(logs).subspan(p * part, part)));
  return levels;
}

double RunSummary::time_noise() const {
  std::vector<std::vector<double>> groups;
  for (const auto& [key, times_of_row] : times)
    if (!times_of_row.baseline_s.empty()) groups.push_back(times_of_row.baseline_s);
  return baseline_noise(groups);
}

RunSummary read_run_summary(const std::filesystem::path& directory) {
  const Json context = read_context(directory);
  if (!context.at("complete").get<bool>()) {
    throw Failure(Standing::incomplete,
                  fmt::format("{}: the run is not complete: a part of a run is no run (--resume, merge)",
                              directory.string()));
  }
  RunSummary run;
  run.directory = directory;
  run.verb = context.value("verb", "");
  run.plan = context.at("plan").get<std::string>();
  run.version = context.at("tool").value("version", "");
  run.platform = deciding_facts(context);
  for (const auto* key : {"compiler", "flags", "build_type"})
    if (context.contains(key))
      run.platform[key] = context[key].is_string() ? context[key].get<std::string>() : context[key].dump();
  for (const auto& kind : row_kinds())
    if (context.at("records_checksum").contains(std::string(kind.file))) add_rows(run, context, kind);
  add_repeated_times(run);
  add_single_times(run);
  add_setting_times(run);
  if (run.rows.empty() && run.times.empty())
    throw Failure(Standing::nothing_measured,
                  fmt::format("{}: no records that a history could hold", directory.string()));
  std::uint64_t digest = fnv1a("");
  for (const auto* name : {context_file, timing_file, timing_repeats_file, setting_times_file})
    digest = add_to_digest(digest, directory / name);
  run.digest = fmt::format("{:016x}", digest);
  run.time_s = written_at(directory / context_file);
  return run;
}

std::string platform_change(const std::map<std::string, std::string>& before,
                            const std::map<std::string, std::string>& after) {
  std::set<std::string> names;
  for (const auto* facts : {&before, &after})
    for (const auto& [name, value] : *facts) names.insert(name);
  std::vector<std::string> texts;
  for (const auto& name : names) {
    const auto value = [&](const auto& facts) {
      const auto it = facts.find(name);
      return it == facts.end() ? std::string("none") : it->second;
    };
    if (value(before) != value(after))
      texts.push_back(fmt::format("{} {} -> {}", name, value(before), value(after)));
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

}  // namespace ulpgate::app
