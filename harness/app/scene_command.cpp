// ulpgate scene: runs a DEM scene, explains what it leaves out, compares it with RealHP<4>, measures its
// speed.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "harness/app/commands.hpp"
#include "harness/app/context.hpp"
#include "harness/app/files.hpp"
#include "harness/app/interrupt.hpp"
#include "harness/app/progress.hpp"
#include "harness/app/scene_job.hpp"
#include "harness/app/scene_output.hpp"
#include "harness/app/selection.hpp"
#include "harness/core/kernel_audit.hpp"

namespace ulpgate::app {

namespace {

ExitCode ladder(const std::string& token, const SceneJob& job, const SceneOptions& o) {
  const RealDescriptor& type = type_or_fail(token).descriptor();
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

void write_picture(const SceneOptions& o, const std::filesystem::path& out, const SceneJob& job,
                   const std::string& token, const dem::DemEngine& engine) {
  const std::string stem = fmt::format("{}_{}_{}", job.loaded.scene.name, token, engine.iteration());
  make_directory(out / "snapshots");
  write_file(out / "snapshots" / (stem + ".csv"), snapshot_csv(engine));
  if (o.vtk) {
    make_directory(out / "vtk");
    write_file(out / "vtk" / (stem + ".vtk"), vtk_text(engine, stem));
  }
}

Written run_one(const std::string& token, const SceneJob& job, const SceneOptions& o,
                const std::filesystem::path& out) {
  auto engine = engine_of(token, dem::Level::own, job, o, o.all_parts);
  std::unique_ptr<dem::DemEngine> reference;
  if (o.compare) {
    reference = engine_of(token, dem::Level::reference, job, o, o.all_parts);
    reference->restore(engine->save(), o.own_constants ? dem::Constants::own : dem::Constants::from_text);
  }
  const auto compare_at = o.compare ? comparison_steps(job.steps) : std::vector<std::uint64_t>();
  std::vector<Divergence> divergence;
  Series series(*engine);
  series.add(*engine);
  const InterruptGuard guard;
  Progress progress(fmt::format("{} {}", job.loaded.scene.name, token));
  // Steps between two looks at Ctrl-C.
  const std::uint64_t most = std::clamp<std::uint64_t>(job.steps / 200, 1, 65536);
  auto next_compare = compare_at.begin();
  while (engine->iteration() < job.steps && !interrupted()) {
    const std::uint64_t now = engine->iteration();
    if (!out.empty() && std::ranges::count(job.snapshot_steps, now) != 0)
      write_picture(o, out, job, token, *engine);
    std::uint64_t until = std::min(job.steps, now + most);
    if (job.record_every != 0) until = std::min(until, (now / job.record_every + 1) * job.record_every);
    if (next_compare != compare_at.end()) until = std::min(until, *next_compare);
    for (const auto s : job.snapshot_steps) {
      if (s > now) until = std::min(until, s);
    }
    if (now == 0) until = 1;
    engine->step(until - now);
    if (reference) reference->step(until - now);
    if (until == 1 || until == job.steps || (job.record_every != 0 && until % job.record_every == 0))
      series.add(*engine);
    if (next_compare != compare_at.end() && until == *next_compare) {
      divergence.push_back(compare_engines(*engine, *reference, type_or_fail(token).descriptor().format));
      ++next_compare;
    }
    progress.update(static_cast<double>(until), static_cast<double>(job.steps));
  }
  const bool complete = engine->iteration() == job.steps;
  const std::string stem = fmt::format("{}_{}", job.loaded.scene.name, token);
  if (!out.empty()) {
    if (std::ranges::count(job.snapshot_steps, engine->iteration()) != 0)
      write_picture(o, out, job, token, *engine);
    make_directory(out / "series");
    if (o.record) write_file(out / "series" / (stem + ".csv"), series.csv());
    if (o.compare) {
      write_file(out / "series" / ("divergence_" + stem + ".csv"), divergence_csv(divergence));
      make_directory(out / "contacts");
      write_file(out / "contacts" / (stem + ".csv"), contact_differences_csv(divergence));
    }
  }
  Json left_out = Json::array();
  for (const auto& part : engine->explain().left_out)
    left_out.push_back({{"part", part.part}, {"why", part.why}});
  Json j;
  j["scene"] = job.loaded.scene.name;
  j["type"] = token;
  j["integrator"] = "leapfrog";
  j["dt"] = job.loaded.scene.dt;
  j["variant"] = fmt::format("{}", fmt::join(o.overrides, ","));
  j["steps"] = engine->iteration();
  j["t_end"] = engine->time_s();
  j["bodies"] = engine->bodies();
  j["contacts"] = engine->contacts().size();
  j["threads"] = o.threads;
  j["parts_left_out"] = left_out;
  j["kinetic_energy"] = engine->kinetic_energy();
  j["mean_position"] = mean_position(*engine);
  j["energy"] = energy_json(*engine);
  j["energy_start"] = series.energy_start();
  j["max_energy_error"] = series.max_energy_error();
  j["state_hash"] = fmt::format("{:016x}", state_hash(*engine));
  j["memory_bytes"] = engine->memory_bytes();
  j["plan"] = job.plan;
  if (!o.json) {
    fmt::print(
        "{:<12} {:<16} steps {:>8}  t {:<10.6g} contacts {:>6}  kinetic {:.10g} J  mean y {:.10g} m  state "
        "{}\n",
        job.loaded.scene.name, token, engine->iteration(), engine->time_s(), engine->contacts().size(),
        engine->kinetic_energy(), mean_position(*engine)[1], j["state_hash"].get<std::string>());
    for (const auto& d : divergence) {
      fmt::print("  step {:>8}: position {:.3e} m = {:.4g} ULP, velocity {:.3e} m/s = {:.4g} ULP{}\n", d.step,
                 d.position_error_m, d.position_error_ulp, d.velocity_error_m_per_s, d.velocity_error_ulp,
                 d.only_tested.size() + d.only_reference.size() == 0
                     ? ""
                     : fmt::format(", contacts only here{}, only in RealHP<4>{}", pair_names(d.only_tested),
                                   pair_names(d.only_reference)));
    }
  }
  return {j, complete};
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
  if (o.out.empty() && (o.record || o.vtk || !o.snapshots.empty()))
    throw Failure(ExitCode::bad_input, "--record, --snapshots and --vtk need --out DIR");
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
                  o.out.empty() ? "interrupted" : "interrupted; what was done is in " + o.out);
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
  scene->add_flag("--record", o->record, "write series/<scene>_<type>.csv with the energy account");
  scene->add_option("--snapshots", o->snapshots, "times in s, comma-separated: write snapshots/*.csv");
  scene->add_flag("--vtk", o->vtk, "with --snapshots: write vtk/*.vtk for ParaView as well");
  scene->add_option("--repeats", o->repeats, "measure the speed: repeats of --steps from the start");
  scene->add_option("--out", o->out, "directory of the records");
  scene->add_flag("--json", o->json, "print the records");
  scene->callback([=, &action] { action = [=] { return run_scene(*o); }; });
}

}  // namespace ulpgate::app
