// One simulation from its start to its end.
#include "harness/app/scenes/scene_run.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>

#include "harness/app/reading/json_fields.hpp"
#include "harness/app/scenes/scene_output.hpp"
#include "harness/app/scenes/watched_steps.hpp"
#include "harness/app/shell/files.hpp"
#include "harness/app/shell/interrupt.hpp"
#include "harness/app/shell/progress.hpp"
#include "harness/app/shell/selection.hpp"

namespace ulpgate::app {

namespace {

void write_picture(const RecordRequest& records, const std::string& stem, const dem::DemEngine& engine) {
  const std::filesystem::path& out = records.out;
  const std::string name = fmt::format("{}_{}", stem, engine.iteration());
  make_directory(out / "snapshots");
  write_file(out / "snapshots" / (name + ".csv"), snapshot_csv(engine));
  if (records.vtk) {
    make_directory(out / "vtk");
    write_file(out / "vtk" / (name + ".vtk"), vtk_text(engine, name));
  }
}

// What tells the runs of one plan apart.
Json collisions_of(const std::string& token, const SceneJob& job) {
  return {{"scene", job.loaded.scene.name},
          {"type", token},
          {"integrator", job.integrator},
          {"dt", job.loaded.scene.dt},
          {"variant", job.variant}};
}

RecordPlan record_plan(const RunRequest& request, const SceneJob& job, const RecordRequest& records) {
  const FloatFormat& format = type_or_fail(request.token).format;
  RecordPlan plan;
  plan.stem = request.stem;
  plan.plan = job.plan;
  plan.record_every = job.record_every;
  plan.chain = job.loaded.scene.records("angles");
  plan.velocities = velocities_of(job);
  plan.series = records.series;
  plan.trajectory = records.trajectory;
  plan.bits = static_cast<int>(format.precision) * static_cast<int>(request.level);
  // Decimal digits that tell any two numbers of that many bits apart: ceil(1 + bits log10(2)).
  plan.digits = 2 + plan.bits * 30103 / 100000;
  plan.checkpoint_s = records.checkpoint_s;
  if (job.collisions) plan.collisions_of = collisions_of(request.token, job);
  return plan;
}

}  // namespace

FiniteWatch finite_watch(const std::string& token, dem::Level level, const SceneJob& job) {
  return FiniteWatch([&job, token, level] { return engine_of(token, level, job); });
}

std::string diverged_text(const SceneJob& job, const std::string& type, const LostState& lost) {
  return fmt::format("{} in {}: diverged at {}", job.loaded.scene.name, type, lost.text());
}

std::string stem_of(const SceneJob& job, const std::string& token) {
  return fmt::format("{}_{}", job.loaded.scene.name, token);
}

FinishedRun run_to_end(const RunRequest& request, const SceneJob& job, const RecordRequest& records) {
  FinishedRun run;
  run.engine = engine_of(request.token, request.level, job);
  dem::DemEngine& engine = *run.engine;
  const auto reference_at_start = [&] {
    auto made = engine_of(request.token, dem::Level::reference, job);
    made->restore(engine_of(request.token, request.level, job)->save(), *request.compare);
    return made;
  };
  std::unique_ptr<dem::DemEngine> reference;
  if (request.compare) reference = reference_at_start();
  FiniteWatch watch = finite_watch(request.token, request.level, job);
  FiniteWatch reference_watch(reference_at_start);
  const std::string wide = "RealHP<4> of " + request.token;
  const auto look = [&] {
    if (const auto lost = watch.look(engine)) {
      const std::string type = request.level == dem::Level::own ? request.token : wide;
      run.diverged = diverged_text(job, type, *lost);
    } else if (!reference) {
      return;
    } else if (const auto lost_too = reference_watch.look(*reference)) {
      run.diverged = diverged_text(job, wide, *lost_too);
    }
  };
  const auto compare_at = request.compare ? comparison_steps(job.steps) : std::vector<std::uint64_t>();
  const bool pictures = !records.out.empty() && request.level == dem::Level::own;
  SceneRecorder recorder(records.out, record_plan(request, job, records), engine);
  const InterruptGuard guard;
  Progress progress(request.label);
  if (records.directory) records.directory->begin(records.context);
  if (!records.resume || !recorder.resume(engine)) {
    recorder.begin();
    recorder.add(engine);
  } else {
    watch.keep(engine);
  }
  // Steps between two looks at Ctrl-C.
  const std::uint64_t most = std::clamp<std::uint64_t>(job.steps / 200, 1, 65536);
  auto next_compare = compare_at.begin();
  while (engine.iteration() < job.steps && !interrupted()) {
    const std::uint64_t now = engine.iteration();
    if (pictures && std::ranges::count(job.snapshot_steps, now) != 0)
      write_picture(records, request.stem, engine);
    std::uint64_t until = std::min(job.steps, now + most);
    if (job.record_every != 0) until = std::min(until, (now / job.record_every + 1) * job.record_every);
    if (next_compare != compare_at.end()) until = std::min(until, *next_compare);
    for (const auto s : job.snapshot_steps) {
      if (s > now) until = std::min(until, s);
    }
    if (now == 0) until = 1;
    take_steps(engine, until - now, job);
    if (reference) take_steps(*reference, until - now, job);
    look();
    if (run.diverged) break;
    recorder.add_collisions(engine);
    if (until == 1 || until == job.steps || (job.record_every != 0 && until % job.record_every == 0))
      recorder.add(engine);
    if (next_compare != compare_at.end() && until == *next_compare) {
      run.divergence.push_back(compare_engines(engine, *reference, type_or_fail(request.token).format));
      ++next_compare;
    }
    // A comparison has no checkpoints: its reference would need them as well.
    if (!reference && recorder.checkpoint_is_due()) recorder.checkpoint(engine);
    progress.update(static_cast<double>(until), static_cast<double>(job.steps));
  }
  run.complete = engine.iteration() == job.steps && !run.diverged;
  if (pictures && run.complete && std::ranges::count(job.snapshot_steps, engine.iteration()) != 0)
    write_picture(records, request.stem, engine);
  // Also of a run that is complete: others of the same command may not be.
  if (!reference && !run.diverged) recorder.checkpoint(engine);
  if (run.complete) recorder.end_collisions(engine);
  recorder.close();
  run.statistics = recorder.statistics();
  run.collisions = recorder.collisions();
  return run;
}

Json scene_row(const FinishedRun& run, const std::string& token, const SceneJob& job) {
  const dem::DemEngine& engine = *run.engine;
  const SceneStatistics& s = run.statistics;
  Json left_out = Json::array();
  for (const auto& part : engine.explain().left_out)
    left_out.push_back({{"part", part.part}, {"why", part.why}});
  Json j;
  j["scene"] = job.loaded.scene.name;
  j["type"] = token;
  j["integrator"] = job.integrator;
  j["dt"] = job.loaded.scene.dt;
  j["variant"] = job.variant;
  j["steps"] = engine.iteration();
  j["t_end"] = engine.time_s();
  j["bodies"] = engine.bodies();
  j["contacts"] = engine.contacts().size();
  j["parts_left_out"] = left_out;
  j["kinetic_energy_" + name_of(velocities_of(job)) + "_J"] = engine.kinetic_energy();
  j["mean_position"] = mean_position(engine);
  j["energy"] = energy_json(engine);
  j["energy_start"] = s.energy_start;
  j["max_energy_error"] = s.averaged.largest();
  j["max_energy_error_raw"] = s.raw.largest();
  j["energy_slope"] = number_or_null(s.averaged.slope());
  j["energy_slope_raw"] = number_or_null(s.raw.slope());
  j["state_hash"] = fmt::format("{:016x}", state_hash(engine));
  // What somebody needs to run it again.
  if (!job.loaded.file.empty()) j["scene_file"] = job.loaded.file;
  j["plan"] = job.plan;
  return j;
}

// Threads that wait for each other's parts of a step must sleep where other programs share the cores:
// spinning costs ten times the step.  libgomp reads its policy before main, so the program starts itself
// again with it.
void let_waiting_threads_sleep(int threads) {
  if (threads < 2 || std::getenv("OMP_WAIT_POLICY") != nullptr) return;
  ::setenv("OMP_WAIT_POLICY", "passive", 1);
  std::ifstream in("/proc/self/cmdline", std::ios::binary);
  std::string words((std::istreambuf_iterator<char>(in)), {});
  std::vector<char*> argv;
  for (std::size_t at = 0; at < words.size(); at += std::strlen(&words[at]) + 1) argv.push_back(&words[at]);
  argv.push_back(nullptr);
  // Where that fails the run is slower and no less right.
  ::execv("/proc/self/exe", argv.data());
}

}  // namespace ulpgate::app
