// Options of the sub-verbs of `ulpgate scene`.
#include "harness/app/scene_commands/scene_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/app/machine/machine_facts.hpp"
#include "harness/app/scene_commands/old_spellings.hpp"
#include "harness/app/shell/selection.hpp"
#include "harness/app/store/context.hpp"
#include "harness/app/terminal/help.hpp"

namespace ulpgate::app {

namespace {

// Present, though perhaps empty, where it was given: what is empty is refused by whoever reads it.
CLI::Option* add_text(CLI::App& verb, const std::string& name, std::optional<std::string>& into,
                      const std::string& help) {
  return verb.add_option_function<std::string>(
      name, [&into](const std::string& text) { into = text; }, help);
}

}  // namespace

void add_scene_verb(CLI::App& scene, Action& action, const std::string& name, const std::string& purpose,
                    const std::vector<std::string>& examples, const std::shared_ptr<SceneOptions>& o,
                    const std::function<void(CLI::App&)>& add_options, const std::function<Verdict()>& run) {
  auto* verb = scene.add_subcommand(name, purpose);
  set_foot(*verb, examples);
  verb->allow_extras();
  verb->add_option("SCENE", o->scene.name, "a scene built in (`ulpgate list scenes`) or a TOML file")
      ->required();
  add_options(*verb);
  verb->callback([verb, name, o, run, &action] {
    const auto words = verb->remaining();
    action = [words, name, o, run] {
      refuse_unknown_words(name, o->scene.name, words);
      try {
        return run();
      } catch (const scenes::SceneFault& fault) {
        // Pairs that come to be while it runs.
        throw scene_failure(o->scene.name, fault);
      }
    };
  });
}

void add_model_options(CLI::App& verb, SceneOptions& o) {
  verb.add_option("--types", o.types, "all or tokens, comma-separated")->capture_default_str();
  verb.add_option("--set", o.scene.overrides,
                  "key=value, again for another: damping=5e-3, mass=yade, a constant of the scene ...")
      ->allow_extra_args(false);
  add_text(verb, "--dt", o.scene.dt, "time step, s");
  verb.add_flag("--allow-large", o.scene.allow_large,
                "take a scene of more memory, steps or records than a run takes without being asked");
}

void add_integrator_option(CLI::App& verb, SceneOptions& o) {
  verb.add_option("--integrator", o.scene.integrator, "a splitting method of `ulpgate list integrators`")
      ->capture_default_str();
}

void add_length_options(CLI::App& verb, SceneOptions& o) {
  auto* until = add_text(verb, "--until", o.scene.until, "end, s");
  add_text(verb, "--steps", o.scene.steps, "number of steps, instead of --until")->excludes(until);
}

void add_threads_option(CLI::App& verb, SceneOptions& o) {
  verb.add_option("--threads", o.scene.threads, "threads; any number gives the same bytes")
      ->capture_default_str()
      ->check(CLI::Range(1, 1024));
}

void add_all_parts_option(CLI::App& verb, SceneOptions& o) {
  verb.add_flag("--all-parts", o.scene.all_parts, "leave nothing out; the same bytes, slower");
}

CLI::Option* add_out_option(CLI::App& verb, SceneOptions& o) {
  const CLI::Validator some(
      [](const std::string& text) { return text.empty() ? std::string("'' names no directory") : ""; }, "");
  return verb.add_option("--out", o.out, "directory of the records")->check(some);
}

void add_record_options(CLI::App& verb, SceneOptions& o, CLI::Option* out, const std::string& series) {
  auto* record = verb.add_flag("--record", o.record,
                               "write series/<scene>_<type>.csv with the energy account and, of a chain, "
                               "trajectory/<scene>_<type>.csv at full precision")
                     ->needs(out);
  verb.add_flag("--series", o.series, series)->needs(out)->excludes(record);
  auto* snapshots =
      add_text(verb, "--snapshots", o.scene.snapshots, "times in s, comma-separated: write snapshots/*.csv")
          ->needs(out);
  verb.add_flag("--vtk", o.records.vtk, "with --snapshots: write vtk/*.vtk for ParaView as well")
      ->needs(snapshots);
}

CLI::Option* add_overwrite_option(CLI::App& verb, SceneOptions& o, CLI::Option* out) {
  return verb.add_flag("--overwrite", o.records.overwrite, "start again where --out holds checkpoints")
      ->needs(out);
}

void add_checkpoint_options(CLI::App& verb, SceneOptions& o, CLI::Option* out) {
  auto* overwrite = add_overwrite_option(verb, o, out);
  verb.add_flag("--resume", o.records.resume, "go on from the checkpoints in --out to the same bytes")
      ->needs(out)
      ->excludes(overwrite);
  verb.add_option("--checkpoint-seconds", o.records.checkpoint_s, "time between checkpoints in --out")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber)
      ->needs(out);
}

void add_collisions_option(CLI::App& verb, SceneOptions& o) {
  verb.add_flag("--collisions", o.scene.collisions,
                "keep a ledger of every collision: restitution, duration, energy made; with --out "
                "collisions.jsonl");
}

void add_json_option(CLI::App& verb, SceneOptions& o) {
  verb.add_flag("--json", o.json, "print the records instead of text");
}

SceneTask make_task(SceneOptions o, const std::string& verb, const std::string& beside) {
  let_waiting_threads_sleep(o.scene.threads);
  o.scene.energy = o.record || o.series;
  o.records.series = o.record || o.series;
  o.records.out = o.out;
  SceneTask task{make_job(o.scene), o.records, select_types(o.types)};
  task.records.trajectory = o.record && task.job.loaded.scene.records("angles");
  check_job(task.job, task.types);
  if (o.out.empty()) return task;
  RunIdentity identity{verb, task.job.plan, {Shard().text()}, "", machine_facts()};
  // Whoever asks for no verb adds to what is there.
  if (!verb.empty()) identity.selection = fmt::format("{}{}", fmt::join(task.types, ","), beside);
  task.records.directory = std::make_shared<OutputDirectory>(
      o.records.out, std::move(identity), partial_run(o.records.resume, o.records.overwrite));
  task.records.context = make_scene_context(task.job.plan, task.job.plan_text, task.types,
                                            static_cast<unsigned>(task.job.threads), false);
  return task;
}

}  // namespace ulpgate::app
