// ulpgate scene run: a scene in any types, with what is to be recorded of it.
#include "harness/app/scene_commands/scene_batch.hpp"
#include "harness/app/scene_commands/scene_commands.hpp"

namespace ulpgate::app {

void add_scene_run_command(CLI::App& scene, Action& action) {
  auto o = std::make_shared<SceneOptions>();
  add_scene_verb(
      scene, action, "run", "Run a scene to its end and record it",
      {"ulpgate scene run collision --types all",
       "ulpgate scene run pendulum3 --types mpfr62 --dt 1e-7 --record --out P --resume"},
      o,
      [o](CLI::App& verb) {
        add_model_options(verb, *o);
        add_integrator_option(verb, *o);
        add_length_options(verb, *o);
        add_threads_option(verb, *o);
        add_all_parts_option(verb, *o);
        auto* out = add_out_option(verb, *o);
        add_record_options(verb, *o, out, "write the series alone");
        add_checkpoint_options(verb, *o, out);
        add_collisions_option(verb, *o);
        add_json_option(verb, *o);
      },
      [o] {
        return run_batch(make_task(*o, "scene run", o->scene.collisions ? " with collisions" : ""),
                         {std::nullopt, o->json});
      });
}

}  // namespace ulpgate::app
