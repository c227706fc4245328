// ulpgate scene: runs a DEM scene, explains what it leaves out, compares it with RealHP<4>, measures its
// speed.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "harness/app/commands/commands.hpp"
#include "harness/app/scenes/scene_job.hpp"
#include "harness/app/scenes/scene_output.hpp"
#include "harness/app/scenes/scene_run.hpp"
#include "harness/app/shell/files.hpp"
#include "harness/app/shell/selection.hpp"
#include "harness/app/store/context.hpp"
#include "harness/core/kernels/kernel_audit.hpp"

namespace ulpgate::app {

namespace {

ExitCode ladder(const std::string& token, const SceneJob& job, const SceneOptions& o) {
  const RealDescriptor& type = type_or_fail(token);
  if (type.format.precision <= 64) {
    fmt::print("{} in {}: the ladder needs a type of more digits than double\n", job.loaded.scene.name,
               token);
    return ExitCode::pass;
  }
  const auto engine = engine_of(token, dem::Level::own, job, o, false);
  const auto found = short_constants(*engine);
  for (const auto& constant : found) {
    fmt::print("{} in {}: {} = {} is good to 16 digits only: a double on the way\n", job.loaded.scene.name,
               token, constant.what, constant.value);
  }
  const auto doubles = audit_scene(job.loaded.scene);
  for (const double x : doubles) {
    fmt::print("{} in {}: the double {} becomes a constant of the start state: good to 16 digits only\n",
               job.loaded.scene.name, token, x);
  }
  if (!found.empty() || !doubles.empty()) return ExitCode::regression;
  fmt::print("{} in {}: every constant fills its precision\n", job.loaded.scene.name, token);
  return ExitCode::pass;
}

struct Written {
  Json record;
  bool complete = true;
};

void print_row(const Json& j, const dem::DemEngine& engine) {
  fmt::print(
      "{:<12} {:<16} steps {:>8}  t {:<10.6g} contacts {:>6}  kinetic {:.10g} J  mean y {:.10g} m  state "
      "{}\n",
      j["scene"].get<std::string>(), j["type"].get<std::string>(), engine.iteration(), engine.time_s(),
      engine.contacts().size(), engine.kinetic_energy(), mean_position(engine)[1],
      j["state_hash"].get<std::string>());
}

void print_energy(const SceneStatistics& s) {
  const auto slope = [](const std::optional<double>& x) { return x ? fmt::format("{:.2f}", *x) : "-"; };
  fmt::print(
      "  energy {:.10g} J at the start, largest error {:.3e} J (slope {}), with half-step velocities {:.3e} "
      "J "
      "(slope {})\n",
      s.energy_start, s.averaged.largest(), slope(s.averaged.slope()), s.raw.largest(), slope(s.raw.slope()));
}

void print_divergence(const std::vector<Divergence>& divergence) {
  for (const auto& d : divergence) {
    fmt::print("  step {:>8}: position {:.3e} m = {:.4g} ULP, velocity {:.3e} m/s = {:.4g} ULP{}\n", d.step,
               d.position_error_m, d.position_error_ulp, d.velocity_error_m_per_s, d.velocity_error_ulp,
               d.only_tested.size() + d.only_reference.size() == 0
                   ? ""
                   : fmt::format(", contacts only here{}, only in RealHP<4>{}", pair_names(d.only_tested),
                                 pair_names(d.only_reference)));
  }
}

Written run_one(const std::string& token, const SceneJob& job, const SceneOptions& o,
                const std::filesystem::path& out) {
  RunRequest request;
  request.token = token;
  request.stem = stem_of(job, token);
  request.label = fmt::format("{} {}", job.loaded.scene.name, token);
  request.compare = o.compare;
  request.trajectory = o.record && job.loaded.scene.records("angles");
  const FinishedRun run = run_to_end(request, job, o, out);
  if (!out.empty() && o.compare) {
    make_directory(out / "series");
    write_file(out / "series" / ("divergence_" + request.stem + ".csv"), divergence_csv(run.divergence));
    make_directory(out / "contacts");
    write_file(out / "contacts" / (request.stem + ".csv"), contact_differences_csv(run.divergence));
  }
  const Json row = scene_row(run, token, job, o);
  if (!o.json) {
    print_row(row, *run.engine);
    if (!run.engine->energy_names().empty()) print_energy(run.statistics);
    print_divergence(run.divergence);
  }
  return {row, run.complete};
}

ExitCode run_scene(const SceneOptions& o) {
  let_waiting_threads_sleep(o.threads);
  const SceneJob job = make_job(o);
  const auto types = select_types(o.types);
  const std::filesystem::path out = o.out;
  if (!o.out.empty()) make_directory(out);
  if (o.explain) {
    for (const auto& token : types) explain_scene(token, job, o);
    return ExitCode::pass;
  }
  if (o.ladder) {
    ExitCode code = ExitCode::pass;
    for (const auto& token : types) code = std::max(code, ladder(token, job, o));
    return code;
  }
  if (o.out.empty() && (o.record || o.series || o.resume || o.vtk || !o.snapshots.empty()))
    throw Failure(ExitCode::bad_input, "--record, --series, --resume, --snapshots and --vtk need --out DIR");
  if (o.resume && o.compare)
    throw Failure(ExitCode::bad_input, "--resume: a comparison keeps no checkpoints, run it again");
  guard_checkpoints(out, o.resume, o.overwrite);
  if (o.correlate) {
    (void)type_or_fail(o.reference);
    return correlate_scene(job, o, types, out);
  }
  if (o.repeats != 0) return measure_scene(job, o, types, out);
  std::string text;
  bool complete = true;
  for (const auto& token : types) {
    const Written written = run_one(token, job, o, out);
    complete = complete && written.complete;
    text += written.record.dump() + "\n";
    if (!complete) break;
  }
  if (o.json) fmt::print("{}", text);
  if (!o.out.empty()) {
    write_file(out / scene_records_file, text);
    const Json context =
        make_scene_context(job.plan, job.plan_text, types, static_cast<unsigned>(o.threads), complete);
    write_file(out / "context.json", context.dump(2) + "\n");
  }
  if (!complete)
    throw Failure(ExitCode::incomplete,
                  o.out.empty() ? "interrupted"
                  : o.compare   ? "interrupted; what was done is in " + o.out
                                : "interrupted; go on with --resume, what was done is in " + o.out);
  remove_checkpoints(out);
  return ExitCode::pass;
}

}  // namespace

void add_scene_command(CLI::App& app, Action& action) {
  auto* scene =
      app.add_subcommand("scene", "Run a DEM scene, explain it, compare it with RealHP<4>, time it");
  auto o = std::make_shared<SceneOptions>();
  scene->add_option("SCENE", o->name, "a scene built in (`ulpgate list scenes`) or a TOML file")->required();
  scene->add_option("--type,--types", o->types, "all or tokens, comma-separated")->capture_default_str();
  scene->add_option("--set,--variant", o->overrides,
                    "key=value: dt, damping, mass=yade, a constant of the scene ...");
  scene->add_option("--integrator", o->integrator, "a splitting method of `ulpgate list integrators`")
      ->capture_default_str();
  scene->add_option("--dt", o->dt, "time step, s");
  scene->add_option("--until", o->until, "end, s");
  scene->add_option("--steps", o->steps, "number of steps, instead of --until");
  scene->add_option("--threads", o->threads, "threads; any number gives the same bytes")
      ->capture_default_str()
      ->check(CLI::Range(1, 1024));
  scene->add_flag("--all-parts", o->all_parts, "leave nothing out; the same bytes, slower");
  scene->add_flag("--explain", o->explain,
                  "print what the scene leaves out and the step time with and without");
  scene->add_flag("--compare", o->compare,
                  "run RealHP<4> from the same state beside it and report the divergence");
  scene->add_flag("--own-constants", o->own_constants,
                  "with --compare: RealHP<4> makes constants from the scene's text instead of widening them");
  scene->add_flag("--ladder", o->ladder, "name constants that are good to the digits of a double only");
  scene->add_flag(
      "--correlate", o->correlate,
      "how long each type stays true to the run in --reference, and whether rounding or the step limits it");
  scene->add_option("--reference", o->reference, "with --correlate: the type of the reference run")
      ->capture_default_str();
  scene->add_flag("--record", o->record,
                  "write series/<scene>_<type>.csv with the energy account and, of a chain, "
                  "trajectory/<scene>_<type>.csv at full precision");
  scene->add_flag("--series", o->series, "write the series alone");
  scene->add_flag("--resume", o->resume, "go on from the checkpoints in --out to the same bytes");
  scene->add_flag("--overwrite", o->overwrite, "start again where --out holds checkpoints");
  scene->add_option("--checkpoint-seconds", o->checkpoint_seconds, "time between checkpoints in --out")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber);
  scene->add_option("--snapshots", o->snapshots, "times in s, comma-separated: write snapshots/*.csv");
  scene->add_flag("--vtk", o->vtk, "with --snapshots: write vtk/*.vtk for ParaView as well");
  scene->add_option("--repeats", o->repeats, "measure the speed: repeats of --steps from the start");
  scene->add_option("--out", o->out, "directory of the records");
  scene->add_flag("--json", o->json, "print the records");
  scene->callback([=, &action] { action = [=] { return run_scene(*o); }; });
}

}  // namespace ulpgate::app
