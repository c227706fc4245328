// ulpgate scene correlate: how long each type stays true to a run of more digits.
#include "harness/app/scene_commands/scene_commands.hpp"
#include "harness/app/scene_commands/scene_options.hpp"
#include "harness/app/scenes/scene_correlation.hpp"
#include "harness/app/shell/selection.hpp"

namespace ulpgate::app {

void add_scene_correlate_command(CLI::App& scene, Action& action) {
  auto o = std::make_shared<SceneOptions>();
  auto reference = std::make_shared<std::string>("mpfr150");
  auto trust = std::make_shared<bool>(false);
  add_scene_verb(
      scene, action, "correlate",
      "Tell how long the angles of each type stay true to those of a run of more digits, and what limits it",
      {"ulpgate scene correlate pendulum3 --types all --reference mpfr150",
       "ulpgate scene correlate pendulum3 --integrator yoshida8 --series --out Y"},
      o,
      [o, reference, trust](CLI::App& verb) {
        add_model_options(verb, *o);
        verb.add_option("--reference", *reference, "the type of the reference run")->capture_default_str();
        verb.add_flag(
            "--trust-reference", *trust,
            "leave out its runs at RealHP<4> and at half the step, which take longest; what limits a "
            "type is then not told");
        add_integrator_option(verb, *o);
        add_length_options(verb, *o);
        add_threads_option(verb, *o);
        add_all_parts_option(verb, *o);
        auto* out = add_out_option(verb, *o);
        add_record_options(verb, *o, out, "keep the energy account in the series, which are always written");
        add_checkpoint_options(verb, *o, out);
        add_json_option(verb, *o);
      },
      [o, reference, trust] {
        (void)type_or_fail(*reference);
        SceneTask task =
            make_task(*o, "scene correlate", " against " + *reference + (*trust ? ", which is trusted" : ""));
        task.records.series = true;
        return correlate_scene(task.job, {task.types, *reference, o->json, *trust}, task.records);
      });
}

}  // namespace ulpgate::app
