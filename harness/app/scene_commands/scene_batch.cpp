// One scene in every type: printed, compared, recorded.
#include "harness/app/scene_commands/scene_batch.hpp"

#include <fmt/format.h>

#include "harness/app/scenes/scene_output.hpp"
#include "harness/app/shell/files.hpp"
#include "harness/app/store/context.hpp"
#include "harness/app/terminal/terminal.hpp"

namespace ulpgate::app {

namespace {

void print_row(const Json& j, const SceneJob& job, const dem::DemEngine& engine) {
  show(
      "{:<12} {:<16} steps {:>8}  t {:<10.6g} contacts {:>6}  kinetic_{} {:.10g} J  mean y {:.10g} m  state "
      "{}\n",
      j["scene"].get<std::string>(), j["type"].get<std::string>(), engine.iteration(), engine.time_s(),
      engine.contacts().size(), name_of(velocities_of(job)), engine.kinetic_energy(),
      mean_position(engine)[1], j["state_hash"].get<std::string>());
}

void print_energy(const SceneStatistics& s) {
  const auto slope = [](const std::optional<double>& x) { return x ? fmt::format("{:.2f}", *x) : "-"; };
  show(
      "  energy {:.10g} J at the start, largest error {:.3e} J (slope {}), with half-step velocities {:.3e} "
      "J "
      "(slope {})\n",
      s.energy_start, s.averaged.largest(), slope(s.averaged.slope()), s.raw.largest(), slope(s.raw.slope()));
}

void print_divergence(const std::vector<Divergence>& divergence) {
  for (const auto& d : divergence) {
    show("  step {:>8}: position {:.3e} m = {:.4g} ULP, velocity {:.3e} m/s = {:.4g} ULP{}\n", d.step,
         d.position_error_m, d.position_error_ulp, d.velocity_error_m_per_s, d.velocity_error_ulp,
         d.only_tested.size() + d.only_reference.size() == 0
             ? ""
             : fmt::format(", contacts only here{}, only in RealHP<4>{}", pair_names(d.only_tested),
                           pair_names(d.only_reference)));
  }
}

void write_divergence(const std::filesystem::path& out, const std::string& stem,
                      const std::vector<Divergence>& divergence) {
  make_directory(out / "series");
  write_file(out / "series" / ("divergence_" + stem + ".csv"), divergence_csv(divergence));
  make_directory(out / "contacts");
  write_file(out / "contacts" / (stem + ".csv"), contact_differences_csv(divergence));
}

FinishedRun run_one(const std::string& token, const SceneTask& task, const BatchRequest& batch) {
  RunRequest request;
  request.token = token;
  request.stem = stem_of(task.job, token);
  request.label = fmt::format("{} {}", task.job.loaded.scene.name, token);
  request.compare = batch.compare;
  FinishedRun run = run_to_end(request, task.job, task.records);
  if (batch.compare && !task.records.out.empty())
    write_divergence(task.records.out, request.stem, run.divergence);
  return run;
}

void write_records(const SceneTask& task, const std::string& text, const std::string& collisions,
                   bool complete) {
  const OutputDirectory& out = *task.records.directory;
  out.write(scene_records_file, text);
  if (task.job.collisions) out.write(collision_records_file, collisions);
  Json context = task.records.context;
  context["complete"] = complete;
  out.finish(std::move(context), complete);
}

}  // namespace

Verdict run_batch(const SceneTask& task, const BatchRequest& batch) {
  const std::filesystem::path& out = task.records.out;
  std::string text;
  std::string collisions;
  bool complete = true;
  Verdict verdict;
  for (const auto& token : task.types) {
    const FinishedRun run = run_one(token, task, batch);
    if (run.diverged) {
      // Told, and no row of the records: the other types go on.
      if (!batch.json) print_divergence(run.divergence);
      fmt::print(stderr, "ulpgate: {}\n", *run.diverged);
      verdict |= Standing::not_finite;
      continue;
    }
    const Json row = scene_row(run, token, task.job);
    if (!batch.json) {
      print_row(row, task.job, *run.engine);
      if (!run.engine->energy_names().empty()) print_energy(run.statistics);
      if (task.job.collisions) show("{}", summary_text(run.collisions));
      print_divergence(run.divergence);
    }
    text += row.dump() + "\n";
    complete = run.complete;
    if (!complete) break;
    if (task.job.collisions && !out.empty()) collisions += collision_lines_of(out, stem_of(task.job, token));
  }
  if (batch.json) fmt::print("{}", text);
  if (!out.empty()) write_records(task, text, collisions, complete && verdict.passes());
  if (!complete) {
    throw Failure(Standing::incomplete,
                  out.empty()     ? "interrupted"
                  : batch.compare ? "interrupted; what was done is in " + out.string()
                                  : "interrupted; go on with --resume, what was done is in " + out.string());
  }
  remove_checkpoints(out);
  return verdict;
}

}  // namespace ulpgate::app
