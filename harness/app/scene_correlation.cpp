// How long each type stays true: correlation of a scene's angles with a run of more digits, and what limits
// it.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "harness/app/context.hpp"
#include "harness/app/files.hpp"
#include "harness/app/interrupt.hpp"
#include "harness/app/progress.hpp"
#include "harness/app/scene_job.hpp"
#include "harness/core/correlation.hpp"
#include "kernels/scenes/scene_reader.hpp"

namespace ulpgate::app {

namespace {

constexpr CorrelationRule rule;

std::vector<double> products(dem::DemEngine& engine, std::uint64_t steps, std::uint64_t every,
                             const std::string& name) {
  Progress progress(name);
  std::vector<double> signal = {angle_product(engine)};
  while (engine.iteration() + every <= steps && !interrupted()) {
    engine.step(every);
    signal.push_back(angle_product(engine));
    progress.update(static_cast<double>(engine.iteration()), static_cast<double>(steps));
  }
  return signal;
}

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

}  // namespace

ExitCode correlate_scene(const SceneJob& job, const SceneOptions& o, const std::vector<std::string>& types,
                         const std::filesystem::path& out) {
  if (job.record_every == 0)
    throw Failure(ExitCode::bad_input,
                  fmt::format("{}: --correlate needs run.record_every in the scene", o.name));
  const InterruptGuard guard;
  const auto signal_of = [&](const std::string& token, dem::Level level) {
    return products(*engine_of(token, level, job, o, o.all_parts), job.steps, job.record_every, token);
  };
  const auto reference_engine = engine_of(o.reference, dem::Level::own, job, o, o.all_parts);
  const auto reference = products(*reference_engine, job.steps, job.record_every, o.reference);
  const double record_s = reference_engine->time_s() /
                          static_cast<double>(std::max<std::uint64_t>(1, reference_engine->iteration())) *
                          static_cast<double>(job.record_every);

  // The reference is as good as these: four times its digits, and half its step.
  const Truth digits = truth_of(reference, signal_of(o.reference, dem::Level::reference), record_s);
  SceneJob half = job;
  const std::string half_dt = "(" + job.loaded.scene.dt + ")/2";
  if (const auto error = scenes::apply_override(half.loaded.scene, "dt=" + half_dt))
    throw Failure(ExitCode::bad_input, error->text());
  const auto finer_engine = engine_of(o.reference, dem::Level::own, half, o, o.all_parts);
  const Truth step = truth_of(
      reference, products(*finer_engine, 2 * job.steps, 2 * job.record_every, "half the step"), record_s);

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
  add(o.reference, "RealHP4", digits, "rounding");
  add(o.reference, "half_step", step, "time-stepping");
  for (const auto& token : types) {
    if (token == o.reference || interrupted()) continue;
    const Truth t = truth_of(signal_of(token, dem::Level::own), reference, record_s);
    const std::string limit = t.to_the_end       ? "the end of the run"
                              : t.t_s < step.t_s ? "rounding"
                                                 : "time-stepping";
    fmt::print("{:<18} {:>10} s  limited by {}\n", token, shown(t), limit);
    add(token, o.reference, t, limit);
  }
  if (!out.empty()) {
    write_file(out / "correlation.jsonl", text);
    const Json context =
        make_scene_context(job.plan, job.plan_text, types, static_cast<unsigned>(o.threads), !interrupted());
    write_file(out / "context.json", context.dump(2) + "\n");
  }
  if (o.json) fmt::print("{}", text);
  if (interrupted()) throw Failure(ExitCode::incomplete, "interrupted");
  return ExitCode::pass;
}

}  // namespace ulpgate::app
