// ulpgate stress: stiff and extreme cases in every type, each with a verdict.
#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "harness/app/machine/machine_facts.hpp"
#include "harness/app/reading/run_context.hpp"
#include "harness/app/run/resume_options.hpp"
#include "harness/app/shell/selection.hpp"
#include "harness/app/store/context.hpp"
#include "harness/app/stress/stress_output.hpp"
#include "harness/app/stress/truth_table.hpp"
#include "harness/app/stress_commands/stress_commands.hpp"
#include "harness/app/terminal/help.hpp"
#include "harness/app/terminal/terminal.hpp"
#include "harness/core/trajectories/truth.hpp"

namespace ulpgate::app {

namespace {

// Before the table, which is long.
void say_summary(const StressFindings& findings) {
  const std::string line = fmt::format("ulpgate: stress: {} rows judged, {} not as known", findings.judged,
                                       findings.unexplained.size());
  const Paint paint = findings.unexplained.empty() ? Paint::good : Paint::bad;
  fmt::print(stderr, "{}\n", painted(paint, line, stderr));
}

// What a finished run comes to.
Verdict report(const StressFindings& findings, const StressOptions& o) {
  for (const auto& line : findings.unexplained) {
    if (o.json) {
      fmt::print(stderr, "FAIL {}\n", line);
    } else {
      show("{} {}\n", painted(Paint::bad, "FAIL"), line);
    }
  }
  if (!findings.unexplained.empty()) return Standing::regression;
  if (findings.judged > 0) return Standing::pass;
  throw Failure(Standing::nothing_measured, "nothing measured: none of the cases exists in one of the types");
}

Verdict look_again(const std::filesystem::path& out, const StressOptions& o) {
  const Json context = read_context(out);
  const std::string text = read_records_text(out, stress_file);
  check_records_text(context, out, stress_file, text);
  fmt::print(stderr, "ulpgate: {} is complete already\n", out.string());
  const auto findings = stress_findings_of(context.value("verdicts", Json()), (out / context_file).string());
  if (o.json) fmt::print("{}", text);
  return report(findings, o);
}

std::string records_of(const StressJob& job) {
  std::string text;
  for (const auto& m : job.measurements) {
    if (m->complete()) text += stress_line(dynamic_cast<const StressMeasurement&>(*m), job.plan);
  }
  return text;
}

Verdict list_cases(const StressOptions& o) {
  for (const StressCase* c : select_cases(o.cases, o.kinds)) show("{:<62} {}\n", c->key(), c->title);
  return Standing::pass;
}

Verdict run_stress(const StressOptions& o) {
  if (o.out.empty() && (o.resume || o.overwrite))
    throw Failure(Standing::bad_input, "--resume and --overwrite need --out DIR");
  const unsigned threads = o.threads != 0 ? o.threads : std::max(1U, std::thread::hardware_concurrency());
  if (o.truth) return print_truth(o.cases, o.digits, threads);
  if (o.list) return list_cases(o);
  const StressJob job = make_stress_job(o);
  std::optional<OutputDirectory> out;
  std::unique_ptr<PieceLog> log;
  Json context;
  if (!o.out.empty()) {
    out.emplace(o.out, RunIdentity{"stress", job.plan, {Shard().text()}, "", machine_facts()},
                partial_run(o.resume, o.overwrite));
    if (o.resume && out->is_finished()) return look_again(out->path(), o);
    context = make_scene_context(job.plan, job.plan_text, job.types, threads, false);
    log = std::make_unique<PieceLog>(*out);
    out->begin(context);
  }
  const bool complete =
      run_measurements({"stress", job.measurements, job.names, job.costs}, threads, log.get());
  const std::string text = records_of(job);
  const StressFindings findings = complete ? judge_stress_job(job) : StressFindings();
  if (log) {
    out->write(stress_file, text);
    context["complete"] = complete;
    context["verdicts"] = to_json(findings);
    out->finish(context, complete);
    if (complete) log->remove();
  }
  if (complete) say_summary(findings);
  if (o.json) {
    fmt::print("{}", text);
  } else {
    show_text(stress_table(job));
  }
  if (complete) return report(findings, o);
  throw Failure(Standing::incomplete,
                log ? fmt::format("interrupted; what was done is in {}; --resume goes on", o.out)
                    : "interrupted; without --out nothing is kept");
}

}  // namespace

void add_stress_command(CLI::App& app, Action& action) {
  auto* verb = app.add_subcommand("stress", "Run stiff and extreme cases in every type, each with a verdict");
  set_foot(*verb, {"ulpgate stress --kinds formula --types float,double", "ulpgate stress --list"});
  auto o = std::make_shared<StressOptions>();
  verb->add_option("--cases", o->cases, "all, or names (--list), also name/form and kind/name/form")
      ->capture_default_str();
  verb->add_option("--kinds", o->kinds,
                   "all, or of formula, trajectory, state, scene, metamorphic, step_limit")
      ->capture_default_str();
  verb->add_option("--types", o->types, "all or tokens, comma-separated")->capture_default_str();
  verb->add_option("--threads", o->threads, "threads, 0: one a core; any number gives the same bytes")
      ->capture_default_str()
      ->check(CLI::Range(0U, 4096U));
  auto* list = verb->add_flag("--list", o->list, "print the chosen cases and what they are");
  auto* out = verb->add_option("--out", o->out, "directory of stress.jsonl and context.json")->excludes(list);
  add_resume_options(*verb, o->resume, o->overwrite);
  auto* json = verb->add_flag("--json", o->json, "print the records");
  auto* truth = verb->add_flag("--truth", o->truth,
                               "print the true solutions of the initial value problems instead: case, t, "
                               "component, value, separated by tabs")
                    ->excludes(list)
                    ->excludes(out)
                    ->excludes(json);
  verb->add_option("--digits", o->digits, "with --truth: digits on which two integrations agree")
      ->capture_default_str()
      ->check(CLI::Range(1, most_truth_digits))
      ->needs(truth);
  verb->callback([=, &action] { action = [=] { return run_stress(*o); }; });
}

}  // namespace ulpgate::app
