// ulpgate scene ladder: names the constants of a scene that are good to the digits of a double only.
#include <fmt/format.h>

#include <algorithm>

#include "harness/app/scene_commands/scene_commands.hpp"
#include "harness/app/scene_commands/scene_options.hpp"
#include "harness/app/shell/selection.hpp"
#include "harness/app/terminal/terminal.hpp"
#include "harness/core/kernels/kernel_audit.hpp"
#include "harness/core/scenes/scene_compare.hpp"

namespace ulpgate::app {

namespace {

// Double's digits and those that only guard them tell nothing.
bool has_ladder(const std::string& token) {
  return type_or_fail(token).format.precision > 64;
}

Verdict ladder(const std::string& token, const SceneJob& job) {
  const std::string& name = job.loaded.scene.name;
  const auto engine = engine_of(token, dem::Level::own, job);
  const auto found = short_constants(*engine);
  for (const auto& constant : found) {
    show("{} in {}: {} = {} is good to 16 digits only: a double on the way\n", name, token, constant.what,
         constant.value);
  }
  const auto doubles = audit_scene(job.loaded.scene);
  for (const double x : doubles) {
    show("{} in {}: the double {} becomes a constant of the start state: good to 16 digits only\n", name,
         token, x);
  }
  if (!found.empty() || !doubles.empty()) return Standing::regression;
  show("{} in {}: every constant fills its precision\n", name, token);
  return Standing::pass;
}

}  // namespace

void add_scene_ladder_command(CLI::App& scene, Action& action) {
  auto o = std::make_shared<SceneOptions>();
  add_scene_verb(
      scene, action, "ladder", "Name constants of a scene that are good to the digits of a double only",
      {"ulpgate scene ladder pendulum3 --types mpfr62",
       "ulpgate scene ladder pendulum3 --types mpfr62 --set mass=yade    # exit 1"},
      o, [o](CLI::App& verb) { add_model_options(verb, *o); },
      [o] {
        const SceneTask task = make_task(*o, "scene ladder");
        Verdict verdict;
        std::size_t judged = 0;
        for (const auto& token : task.types) {
          if (!has_ladder(token)) {
            show("{} in {}: the ladder needs a type of more digits than double\n", task.job.loaded.scene.name,
                 token);
            continue;
          }
          verdict |= ladder(token, task.job);
          ++judged;
        }
        if (judged == 0) verdict |= Standing::nothing_measured;
        return verdict;
      });
}

}  // namespace ulpgate::app
