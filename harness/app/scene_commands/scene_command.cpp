// ulpgate scene: the verb above run, explain, compare, ladder, correlate and speed.
#include "harness/app/scene_commands/old_spellings.hpp"
#include "harness/app/scene_commands/scene_commands.hpp"
#include "harness/app/terminal/help.hpp"

namespace ulpgate::app {

void add_scene_command(CLI::App& app, Action& action) {
  auto* scene = app.add_subcommand(
      "scene", "Run a DEM scene, explain it, compare it with RealHP<4>, correlate its types, time it");
  set_foot(*scene, {"ulpgate scene run collision --types all", "ulpgate scene explain pendulum3"},
           "SCENE is a scene built in (`ulpgate list scenes`) or a TOML file.\n"
           "Each verb has a --help of its own: ulpgate scene run --help");
  // What is not known is refused by hand, with the spelling that is.
  scene->allow_extras();
  add_scene_run_command(*scene, action);
  add_scene_explain_command(*scene, action);
  add_scene_compare_command(*scene, action);
  add_scene_ladder_command(*scene, action);
  add_scene_correlate_command(*scene, action);
  add_scene_speed_command(*scene, action);
  // Called after the callback of the sub-verb.
  scene->callback([scene, &action] {
    const auto words = scene->remaining();
    const auto chosen = scene->get_subcommands();
    if (!chosen.empty() && words.empty()) return;
    const std::string verb = chosen.empty() ? "" : chosen.front()->get_name();
    action = [words, verb]() -> Verdict { refuse_words_before_verb(words, verb); };
  });
}

}  // namespace ulpgate::app
