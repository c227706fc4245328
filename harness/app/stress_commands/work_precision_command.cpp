// ulpgate work-precision: error against run time of functions, kernels, trajectories and scenes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "harness/app/advice/work_precision_job.hpp"
#include "harness/app/advice/work_precision_output.hpp"
#include "harness/app/advice/work_precision_records.hpp"
#include "harness/app/machine/machine_facts.hpp"
#include "harness/app/run/resume_options.hpp"
#include "harness/app/shell/files.hpp"
#include "harness/app/shell/selection.hpp"
#include "harness/app/store/context.hpp"
#include "harness/app/stress_commands/stress_commands.hpp"
#include "harness/app/terminal/help.hpp"
#include "harness/app/terminal/terminal.hpp"
#include "harness/core/trajectories/truth.hpp"

namespace ulpgate::app {

namespace {

std::vector<WorkPrecisionRow> rows_of(const WorkPrecisionJob& job) {
  std::vector<WorkPrecisionRow> rows;
  for (const auto* m : job.settings)
    if (m->complete()) rows.push_back(m->row());
  return rows;
}

void show_rows(const std::vector<WorkPrecisionRow>& rows, const SettingTimes& times, const std::string& plan,
               bool json) {
  if (json) {
    fmt::print("{}{}{}", row_lines(rows, plan), fit_lines(rows, plan), timing_lines(rows, times, plan));
  } else {
    print_work_precision(rows, times);
  }
}

// Failed settings are findings; a run of nothing else has measured nothing.
Verdict verdict_of(const std::vector<WorkPrecisionRow>& rows) {
  if (std::ranges::any_of(rows, [](const auto& r) { return r.outcome.failure == WorkFailure::none; }))
    return Standing::pass;
  throw Failure(Standing::nothing_measured,
                fmt::format("nothing measured: every setting was refused or diverged; the first: {}",
                            rows.empty() ? "none" : rows.front().outcome.why));
}

Verdict look_again(const std::filesystem::path& out, bool json) {
  std::vector<WorkPrecisionRow> rows;
  const Json context = read_context(out);
  // In the order of the file, which is that of the plan.
  std::map<std::size_t, WorkPrecisionRow> by_line;
  for (auto& [key, known] : read_work_precision(out))
    by_line.emplace(std::stoull(known.place.substr(known.place.rfind(':') + 1)), known.row);
  for (auto& [line, row] : by_line) rows.push_back(std::move(row));
  fmt::print(stderr, "ulpgate: {} is complete already\n", out.string());
  show_rows(rows, read_times(out / times_file, context.at("plan")), context.at("plan"), json);
  return verdict_of(rows);
}

Verdict run_work_precision(const WorkPrecisionOptions& o) {
  if (o.out.empty() && (o.resume || o.overwrite))
    throw Failure(Standing::bad_input, "--resume and --overwrite need --out DIR");
  const WorkPrecisionJob job = make_work_precision_job(o);
  const unsigned threads = o.threads != 0 ? o.threads : std::max(1U, std::thread::hardware_concurrency());
  std::optional<OutputDirectory> out;
  std::unique_ptr<PieceLog> log;
  SettingTimes times;
  Json context;
  if (!o.out.empty()) {
    out.emplace(o.out, RunIdentity{"work-precision", job.plan, {Shard().text()}, "", machine_facts()},
                partial_run(o.resume, o.overwrite));
    if (o.resume && out->is_finished()) return look_again(out->path(), o.json);
    if (o.resume) times = read_times(out->path() / times_file, job.plan);
    context = make_scene_context(job.plan, job.plan_text, job.types, threads, false);
    log = std::make_unique<PieceLog>(*out);
    job.kept->emplace(*out);
    out->begin(context);
  }
  std::vector<std::string> names;
  for (const auto* m : job.settings) names.push_back(m->setting().key());
  bool complete =
      run_measurements({"work-precision", job.measurements, names, job.costs}, threads, log.get());
  const auto rows = rows_of(job);
  const auto keep_times = [&] {
    if (out) out->write(times_file, timing_lines(rows, times, job.plan));
  };
  if (complete && o.repeats > 0) complete = time_settings(job.settings, o.repeats, times, keep_times);
  if (out) {
    out->write(work_precision_file, row_lines(rows, job.plan));
    out->write(fits_file, fit_lines(rows, job.plan));
    keep_times();
    context["complete"] = complete;
    out->finish(context, complete);
    if (complete) log->remove();
  }
  show_rows(rows, times, job.plan, o.json);
  if (complete) return verdict_of(rows);
  throw Failure(Standing::incomplete,
                out ? fmt::format("interrupted; what was done is in {}; --resume goes on", o.out)
                    : "interrupted; without --out nothing is kept");
}

}  // namespace

void add_work_precision_command(CLI::App& app, Action& action) {
  auto* verb = app.add_subcommand("work-precision",
                                  "Measure error against run time: functions, kernels, trajectories, scenes");
  set_foot(
      *verb,
      {"ulpgate work-precision --cases kepler --integrators leapfrog,yoshida8,gauss4 --types double,float128",
       "ulpgate work-precision --cases pendulum3 --until 0.1 --types float,double --out W",
       "ulpgate work-precision --cases robertson --until 1e11 --dt plan:1e-3..1e-12 --integrators "
       "radau5,rodas3",
       "ulpgate work-precision --subjects sin,exp,kernel --types float,double"},
      "Errors are relative: of a stiff problem's state component by component, of another's to its largest "
      "component, of a scene to its size.");
  auto o = std::make_shared<WorkPrecisionOptions>();
  verb->add_option(
      "--subjects", o->subjects,
      "function, kernel, trajectory or scene for all of a kind, or names of functions and kernels");
  verb->add_option(
      "--cases", o->cases,
      "initial value problems, scenes built in, files of scenes; without either: kepler,robertson");
  verb->add_option("--types", o->types, "all or tokens, comma-separated")->capture_default_str();
  verb->add_option("--integrators", o->integrators,
                   "all or names (`ulpgate list integrators`); those that do not apply are left out")
      ->capture_default_str();
  auto* steps = verb->add_option("--steps", o->steps,
                                 "numbers of equal steps of trajectories: 64,128 or 64..4096, which doubles; "
                                 "without: 128..65536, and planned steps for stiff problems");
  verb->add_option("--dt", o->dt,
                   "steps of scenes, s: 1e-5,1e-5/2; without: its own times 2 to its own over 16. Of "
                   "trajectories plan:1e-6 or plan:1e-3..1e-12: steps found once in double for a tolerance, "
                   "the same in every type")
      ->excludes(steps);
  verb->add_option(
      "--until", o->until,
      "end: one of the problem's, or of a scene in s (without: at most 1 s and 2e6 steps of a body)");
  verb->add_option("--set", o->overrides, "key=value of scenes, again for another")->allow_extra_args(false);
  verb->add_option("--samples", o->samples, "arguments of a function, states of a kernel")
      ->capture_default_str()
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 32U));
  verb->add_option("--digits", o->digits,
                   "of true solutions; without: 2 or more beyond the widest type, 15 to 34")
      ->check(CLI::Range(5, most_truth_digits));
  verb->add_option("--budget", o->budget, "evaluations of a trajectory; more are refused")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  verb->add_option("--repeats", o->repeats, "rounds of timing; 0: none. What lasts over 2 s is timed once")
      ->capture_default_str()
      ->check(CLI::Range(0U, 1000000U));
  verb->add_option(
          "--threads", o->threads,
          "threads that measure errors, 0: one a core; any number gives the same bytes. One alone times")
      ->capture_default_str()
      ->check(CLI::Range(0U, 4096U));
  verb->add_option("--out", o->out, "directory of work_precision*.jsonl and context.json");
  add_resume_options(*verb, o->resume, o->overwrite);
  verb->add_flag("--json", o->json, "print the records");
  verb->callback([=, &action] { action = [=] { return run_work_precision(*o); }; });
}

}  // namespace ulpgate::app
