// How long each type stays true: correlation of a scene's angles with a run of more digits, and what limits
// it.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "harness/app/scenes/scene_run.hpp"
#include "harness/app/shell/files.hpp"
#include "harness/app/shell/interrupt.hpp"
#include "harness/app/store/context.hpp"
#include "harness/core/arguments/random_words.hpp"
#include "harness/core/scenes/correlation.hpp"
#include "kernels/scenes/reader/scene_reader.hpp"

namespace ulpgate::app {

namespace {

constexpr CorrelationRule rule;

struct Truth {
  std::vector<double> correlations;
  double t_s = 0;
  bool to_the_end = false;
};

Truth truth_of(const std::vector<double>& signal, const std::vector<double>& reference, double record_s) {
  Truth t;
  t.correlations = chunk_correlations(signal, reference, rule);
  const std::size_t records = true_records(t.correlations, rule);
  t.t_s = static_cast<double>(records) * record_s;
  t.to_the_end = records == t.correlations.size() * rule.chunk;
  return t;
}

std::string shown(const Truth& t) {
  return fmt::format("{}{:.2f}", t.to_the_end ? ">= " : "", t.t_s);
}

std::string csv(const Truth& t, double record_s) {
  std::string text = "time_s,correlation\n";
  for (std::size_t i = 0; i < t.correlations.size(); ++i)
    text += fmt::format("{},{}\n", static_cast<double>(i * rule.chunk) * record_s, t.correlations[i]);
  return text;
}

// The same scene with half the step, recorded at the same times.
SceneJob halved(const SceneJob& job) {
  SceneJob half = job;
  const std::string half_dt = "(" + job.loaded.scene.dt + ")/2";
  if (const auto error = scenes::apply_override(half.loaded.scene, "dt=" + half_dt))
    throw Failure(ExitCode::bad_input, error->text());
  half.steps *= 2;
  half.record_every *= 2;
  half.snapshot_steps.clear();
  half.plan = fmt::format("{:016x}", fnv1a(job.plan_text + "half the step\n"));
  return half;
}

std::string limit_of(const Truth& t, const Truth& digits, const Truth& step) {
  if (t.to_the_end) return "the end of the run";
  if (!digits.to_the_end && t.t_s >= digits.t_s) return "the reference";
  return t.t_s < step.t_s ? "rounding" : "time-stepping";
}

}  // namespace

ExitCode correlate_scene(const SceneJob& job, const SceneOptions& o, const std::vector<std::string>& types,
                         const std::filesystem::path& out) {
  if (job.record_every == 0)
    throw Failure(ExitCode::bad_input,
                  fmt::format("{}: --correlate needs run.record_every in the scene", o.name));
  if (!job.loaded.scene.records("angles"))
    throw Failure(ExitCode::bad_input,
                  fmt::format("{}: --correlate needs a chain of bodies whose angles are recorded: record = "
                              "[\"angles\"]",
                              o.name));
  const auto stop_if_interrupted = [&] {
    if (interrupted())
      throw Failure(ExitCode::incomplete, out.empty() ? "interrupted" : "interrupted; go on with --resume");
  };
  const InterruptGuard guard;
  std::string scene_rows;
  const auto add_scene_row = [&](const FinishedRun& run, const std::string& token) {
    scene_rows += scene_row(run, token, job, o).dump() + "\n";
  };
  const auto run_of = [&](const std::string& token, dem::Level level, const SceneJob& what,
                          const std::string& suffix) {
    const bool plain = suffix.empty();
    RunRequest request;
    request.token = token;
    request.level = level;
    request.stem = stem_of(job, token) + suffix;
    request.label = request.stem;
    request.trajectory = o.record && plain && !out.empty();
    FinishedRun run = run_to_end(request, what, o, out);
    stop_if_interrupted();
    return run;
  };
  const FinishedRun reference_run = run_of(o.reference, dem::Level::own, job, "");
  const std::vector<double>& reference = reference_run.statistics.products;
  const double record_s = reference_run.engine->time_s() /
                          static_cast<double>(std::max<std::uint64_t>(1, reference_run.engine->iteration())) *
                          static_cast<double>(job.record_every);

  // The reference is as good as these: four times its digits, and half its step.
  const Truth digits = truth_of(
      reference, run_of(o.reference, dem::Level::reference, job, "_RealHP4").statistics.products, record_s);
  const Truth step =
      truth_of(reference, run_of(o.reference, dem::Level::own, halved(job), "_half_step").statistics.products,
               record_s);

  fmt::print(
      "{}: t_s, the time for which angles correlate over {} with the {} run, chunks of {} records of {:g} "
      "s\n",
      job.loaded.scene.name, rule.limit, o.reference, rule.chunk, record_s);
  fmt::print("{:<18} {:>10} s  against its own RealHP<4>\n", o.reference, shown(digits));
  fmt::print("{:<18} {:>10} s  against half its step: beyond it, time-stepping is the limit\n", o.reference,
             shown(step));
  std::string text;
  const auto add = [&](const std::string& type, const std::string& against, const Truth& t,
                       const std::string& limit) {
    const Json j = {{"what", "correlation"},
                    {"scene", job.loaded.scene.name},
                    {"type", type},
                    {"against", against},
                    {"integrator", o.integrator},
                    {"dt", job.loaded.scene.dt},
                    {"variant", fmt::format("{}", fmt::join(o.overrides, ","))},
                    {"t_s", t.t_s},
                    {"to_the_end", t.to_the_end},
                    {"limited_by", limit},
                    {"plan", job.plan}};
    text += j.dump() + "\n";
    if (out.empty()) return;
    make_directory(out / "correlation");
    write_file(out / "correlation" / fmt::format("{}_{}_{}.csv", job.loaded.scene.name, type, against),
               csv(t, record_s));
  };
  add(o.reference, "RealHP4", digits, digits.to_the_end ? "the end of the run" : "rounding");
  add(o.reference, "half_step", step, step.to_the_end ? "the end of the run" : "time-stepping");
  for (const auto& token : types) {
    if (token == o.reference) {
      add_scene_row(reference_run, token);
      continue;
    }
    const FinishedRun run = run_of(token, dem::Level::own, job, "");
    add_scene_row(run, token);
    const Truth t = truth_of(run.statistics.products, reference, record_s);
    const std::string limit = limit_of(t, digits, step);
    fmt::print("{:<18} {:>10} s  limited by {}{}\n", token, shown(t), limit,
               run.engine->energy_names().empty()
                   ? ""
                   : fmt::format("; largest energy error {:.3e} J, with half-step velocities {:.3e} J",
                                 run.statistics.averaged.largest(), run.statistics.raw.largest()));
    add(token, o.reference, t, limit);
  }
  if (!out.empty()) {
    write_file(out / "correlation.jsonl", text);
    write_file(out / scene_records_file, scene_rows);
    const Json context =
        make_scene_context(job.plan, job.plan_text, types, static_cast<unsigned>(o.threads), true);
    write_file(out / "context.json", context.dump(2) + "\n");
    remove_checkpoints(out);
  }
  if (o.json) fmt::print("{}", text);
  return ExitCode::pass;
}

}  // namespace ulpgate::app
