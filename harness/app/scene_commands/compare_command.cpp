// ulpgate scene compare: a scene beside RealHP<4> of the same state, and how far they come apart.
#include "harness/app/scene_commands/scene_batch.hpp"
#include "harness/app/scene_commands/scene_commands.hpp"

namespace ulpgate::app {

void add_scene_compare_command(CLI::App& scene, Action& action) {
  auto o = std::make_shared<SceneOptions>();
  auto own_constants = std::make_shared<bool>(false);
  add_scene_verb(
      scene, action, "compare", "Run a scene beside RealHP<4> from the same state and report the divergence",
      {"ulpgate scene compare collision --types float,double",
       "ulpgate scene compare deposition --steps 1000 --types float --record --out S"},
      o,
      [o, own_constants](CLI::App& verb) {
        add_model_options(verb, *o);
        add_integrator_option(verb, *o);
        add_length_options(verb, *o);
        add_threads_option(verb, *o);
        add_all_parts_option(verb, *o);
        verb.add_flag("--own-constants", *own_constants,
                      "RealHP<4> makes constants from the scene's text instead of widening them");
        auto* out = add_out_option(verb, *o);
        add_record_options(verb, *o, out, "write the series alone");
        // No --resume: the reference would need checkpoints as well.
        add_overwrite_option(verb, *o, out);
        add_json_option(verb, *o);
      },
      [o, own_constants] {
        const auto constants = *own_constants ? dem::Constants::own : dem::Constants::from_text;
        return run_batch(make_task(*o, "scene compare", *own_constants ? " own constants" : ""),
                         {constants, o->json});
      });
}

}  // namespace ulpgate::app
