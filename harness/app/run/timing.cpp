// Timing.
#include "harness/app/run/timing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "harness/app/machine/child_process.hpp"
#include "harness/app/run/baseline.hpp"
#include "harness/app/shell/failure.hpp"
#include "harness/app/shell/progress.hpp"
#include "harness/app/store/records.hpp"
#include "harness/core/subject/registry.hpp"
#include "harness/core/trend/interleaved_order.hpp"
#include "harness/core/watch/heartbeat.hpp"

namespace ulpgate::app {

namespace {

constexpr std::size_t batch_size = 512;

constexpr std::string_view phase = "timing";

// A row under the clock; its batch holds batch_size points.
class TimedRow {
 public:
  // The warm-up finds how much one repeat must hold: a part of the batch for slow types, many rounds for fast
  // ones.
  TimedRow(const std::string& what, const std::string& token)
      : record_{what, token, 0, 0, batch_size}, batch_(find_subject(what, token)->timed_batch(batch_size)) {
    constexpr double enough_s = 5e-4;
    const WorkPlace place(what, token, phase);
    if (batch_(32, 1) > 2e-3) record_.batch = 32;
    while (batch_(record_.batch, rounds_) < enough_s) rounds_ *= 2;
  }

  // Nanoseconds per evaluation of one more repeat.
  double repeat() {
    const WorkPlace place(record_.what, record_.type, phase);
    const double evaluations = static_cast<double>(record_.batch) * rounds_;
    const double ns = 1e9 * batch_(record_.batch, rounds_) / evaluations;
    record_.ns_per_eval = record_.repeats++ == 0 ? ns : std::min(record_.ns_per_eval, ns);
    return ns;
  }

  [[nodiscard]] const TimingRecord& record() const { return record_; }

 private:
  TimingRecord record_;
  TimedBatch batch_;
  int rounds_ = 1;
};

template <class Visit>
void for_each_row(const PlanRequest& request, const Visit& visit) {
  for (const auto& token : request.types)
    for (const auto& name : request.subjects) visit(name, token);
}

}  // namespace

std::vector<TimingRecord> measure_times(const PlanRequest& request) {
  constexpr int repeats = 7;
  std::vector<TimingRecord> records;
  Progress progress("timing");
  for_each_row(request, [&](const std::string& name, const std::string& token) {
    TimedRow row(name, token);
    for (int i = 0; i < repeats; ++i) row.repeat();
    records.push_back(row.record());
    progress.update(static_cast<double>(records.size()),
                    static_cast<double>(request.types.size() * request.subjects.size()));
  });
  return records;
}

std::vector<RepeatedTimes> time_in_rounds(const PlanRequest& request, unsigned rounds) {
  // About as long as a repeat of a row.
  constexpr int baseline_operations = 100'000;
  std::vector<TimedRow> rows;
  for_each_row(request,
               [&](const std::string& name, const std::string& token) { rows.emplace_back(name, token); });
  std::vector<RepeatedTimes> times(rows.size(), {{}, {{}}, {{}}});
  Progress progress("timing");
  for (unsigned round = 0; round < rounds; ++round) {
    for (const auto i : interleaved_order(rows.size(), round)) {
      times[i].baseline_ns[0].push_back(1e9 * baseline_sample_s(baseline_operations));
      times[i].ns[0].push_back(rows[i].repeat());
    }
    progress.update(round + 1.0, rounds);
  }
  for (std::size_t i = 0; i < rows.size(); ++i) times[i].record = rows[i].record();
  return times;
}

namespace {

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ",") + name;
  return text;
}

// A row of what a process printed, which is this very program: a line that is none is an internal error.
RepeatedTimes row_of(const std::string& line) {
  const Json j = Json::parse(line);
  RepeatedTimes row{{j.at("what"), j.at("type"), 0, 0, j.at("batch")}, j.at("ns"), j.at("baseline_ns")};
  row.record.ns_per_eval = *std::ranges::min_element(row.ns.at(0));
  row.record.repeats = static_cast<int>(row.ns[0].size());
  return row;
}

void take(RepeatedTimes& into, RepeatedTimes&& row) {
  if (into.ns.empty()) {
    into = std::move(row);
    return;
  }
  into.record.ns_per_eval = std::min(into.record.ns_per_eval, row.record.ns_per_eval);
  into.record.repeats += row.record.repeats;
  into.ns.push_back(std::move(row.ns.at(0)));
  into.baseline_ns.push_back(std::move(row.baseline_ns.at(0)));
}

}  // namespace

std::vector<RepeatedTimes> time_in_processes(const PlanRequest& request, unsigned processes,
                                             unsigned rounds) {
  const bool functions = request.kind == SubjectKind::function;
  std::vector<std::string> words = {own_program(), functions ? "math" : "kernels"};
  words.insert(words.end(), {functions ? "--functions" : "--kernels", joined(request.subjects), "--types",
                             joined(request.types), "--time-rounds", std::to_string(rounds), "--samples", "1",
                             "--out", "-"});  // where nothing is written
  std::vector<RepeatedTimes> rows(request.types.size() * request.subjects.size());
  for (unsigned process = 0; process < processes; ++process) {
    const ChildOutput output = output_of(words, ChildErrors::shown);
    if (output.exit_code != 0)
      throw Failure(standing_of(output.exit_code),
                    fmt::format("timing: a process ended with {}", output.exit_code));
    std::istringstream lines(output.text);
    std::string line;
    for (auto& row : rows) {
      std::getline(lines, line);
      take(row, row_of(line));
    }
  }
  return rows;
}

std::string timing_text(const std::vector<TimingRecord>& records) {
  std::string text;
  for (const auto& r : records) {
    const Json j = {{"what", r.what},
                    {"type", r.type},
                    {"ns_per_eval", r.ns_per_eval},
                    {"repeats", r.repeats},
                    {"batch", r.batch}};
    text += j.dump() + "\n";
  }
  return text;
}

std::string repeats_text(const std::vector<RepeatedTimes>& rows) {
  std::string text;
  for (const auto& row : rows) {
    const Json j = {{"what", row.record.what},
                    {"type", row.record.type},
                    {"batch", row.record.batch},
                    {"ns", row.ns},
                    {"baseline_ns", row.baseline_ns}};
    text += j.dump() + "\n";
  }
  return text;
}

}  // namespace ulpgate::app
