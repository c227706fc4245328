// How long each type stays true: correlation of a scene's angles with a run of more digits, and what limits
// it.
#include "harness/app/scenes/scene_correlation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "harness/app/shell/files.hpp"
#include "harness/app/shell/interrupt.hpp"
#include "harness/app/store/context.hpp"
#include "harness/app/terminal/terminal.hpp"
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
    throw Failure(Standing::bad_input, error->text());
  half.steps *= 2;
  half.record_every *= 2;
  half.snapshot_steps.clear();
  half.plan = fmt::format("{:016x}", fnv1a(job.plan_text + "half the step\n"));
  return half;
}

// How long the reference itself stays true: beside four times its digits, and beside half its step.
struct Worth {
  Truth digits, step;
};

std::string limit_of(const Truth& t, const std::optional<Worth>& worth) {
  if (t.to_the_end) return "the end of the run";
  if (!worth) return "not told";
  if (!worth->digits.to_the_end && t.t_s >= worth->digits.t_s) return "the reference";
  return t.t_s < worth->step.t_s ? "rounding" : "time-stepping";
}

void print_reference(const SceneJob& job, const std::string& reference, double record_s,
                     const std::optional<Worth>& worth) {
  show(
      "{}: t_s, the time for which angles correlate over {} with the {} run, chunks of {} records of {:g} "
      "s\n",
      job.loaded.scene.name, rule.limit, reference, rule.chunk, record_s);
  if (!worth) return;
  show("{:<18} {:>10} s  against its own RealHP<4>\n", reference, shown(worth->digits));
  show("{:<18} {:>10} s  against half its step: beyond it, time-stepping is the limit\n", reference,
       shown(worth->step));
}

void print_truth(const std::string& token, const Truth& t, const std::string& limit, const FinishedRun& run) {
  show("{:<18} {:>10} s  limited by {}{}\n", token, shown(t), limit,
       run.engine->energy_names().empty()
           ? ""
           : fmt::format("; largest energy error {:.3e} J, with half-step velocities {:.3e} J",
                         run.statistics.averaged.largest(), run.statistics.raw.largest()));
}

}  // namespace

Verdict correlate_scene(const SceneJob& job, const CorrelationRequest& c, const RecordRequest& records) {
  const std::filesystem::path& out = records.out;
  if (job.record_every == 0)
    throw Failure(Standing::bad_input, fmt::format("{}: a correlation needs run.record_every in the scene",
                                                   job.loaded.scene.name));
  if (!job.loaded.scene.records("angles"))
    throw Failure(Standing::bad_input,
                  fmt::format("{}: a correlation needs a chain of bodies whose angles are recorded: record = "
                              "[\"angles\"]",
                              job.loaded.scene.name));
  const std::uint64_t planned = job.steps / job.record_every + 1;
  if (planned < rule.chunk)
    throw Failure(
        Standing::nothing_measured,
        fmt::format("{}: {} records are fewer than the {} that are correlated at a time: nothing to "
                    "measure; take more steps",
                    job.loaded.scene.name, planned, rule.chunk));
  if (c.trust && std::ranges::all_of(c.types, [&](const auto& token) { return token == c.reference; }))
    throw Failure(Standing::nothing_measured,
                  fmt::format("{}: {} is trusted, and no other type is asked for: nothing to correlate",
                              job.loaded.scene.name, c.reference));
  const auto stop_if_interrupted = [&] {
    if (interrupted())
      throw Failure(Standing::incomplete, out.empty() ? "interrupted" : "interrupted; go on with --resume");
  };
  const InterruptGuard guard;
  std::string scene_rows;
  const auto add_scene_row = [&](const FinishedRun& run, const std::string& token) {
    scene_rows += scene_row(run, token, job).dump() + "\n";
  };
  const auto run_of = [&](const std::string& token, dem::Level level, const SceneJob& what,
                          const std::string& suffix) {
    RunRequest request;
    request.token = token;
    request.level = level;
    request.stem = stem_of(job, token) + suffix;
    request.label = request.stem;
    RecordRequest wanted = records;
    wanted.trajectory = records.trajectory && suffix.empty();
    FinishedRun run = run_to_end(request, what, wanted);
    if (run.diverged) throw Failure(Standing::not_finite, *run.diverged);
    stop_if_interrupted();
    return run;
  };
  const FinishedRun reference_run = run_of(c.reference, dem::Level::own, job, "");
  const std::vector<double>& reference = reference_run.statistics.products;
  const double record_s = reference_run.engine->time_s() /
                          static_cast<double>(std::max<std::uint64_t>(1, reference_run.engine->iteration())) *
                          static_cast<double>(job.record_every);

  std::optional<Worth> worth;
  if (!c.trust) {
    const auto beside = [&](dem::Level level, const SceneJob& what, const std::string& suffix) {
      return truth_of(reference, run_of(c.reference, level, what, suffix).statistics.products, record_s);
    };
    worth = {beside(dem::Level::reference, job, "_RealHP4"),
             beside(dem::Level::own, halved(job), "_half_step")};
  }

  if (!c.json) print_reference(job, c.reference, record_s, worth);
  std::string text;
  const auto add = [&](const std::string& type, const std::string& against, const Truth& t,
                       const std::string& limit) {
    const Json j = {{"what", "correlation"},
                    {"scene", job.loaded.scene.name},
                    {"type", type},
                    {"against", against},
                    {"integrator", job.integrator},
                    {"dt", job.loaded.scene.dt},
                    {"variant", job.variant},
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
  if (worth) {
    add(c.reference, "RealHP4", worth->digits, worth->digits.to_the_end ? "the end of the run" : "rounding");
    add(c.reference, "half_step", worth->step,
        worth->step.to_the_end ? "the end of the run" : "time-stepping");
  }
  for (const auto& token : c.types) {
    if (token == c.reference) {
      add_scene_row(reference_run, token);
      continue;
    }
    const FinishedRun run = run_of(token, dem::Level::own, job, "");
    add_scene_row(run, token);
    const Truth t = truth_of(run.statistics.products, reference, record_s);
    const std::string limit = limit_of(t, worth);
    if (!c.json) print_truth(token, t, limit, run);
    add(token, c.reference, t, limit);
  }
  if (!out.empty()) {
    records.directory->write("correlation.jsonl", text);
    records.directory->write(scene_records_file, scene_rows);
    Json context = records.context;
    context["complete"] = true;
    records.directory->finish(std::move(context), true);
    remove_checkpoints(out);
  }
  if (c.json) fmt::print("{}", text);
  return Standing::pass;
}

}  // namespace ulpgate::app
