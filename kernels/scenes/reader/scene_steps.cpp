// Times of a scene as numbers of steps.
#include "kernels/scenes/reader/scene_steps.hpp"

#include "kernels/scenes/reader/expression.hpp"

namespace ulpgate::scenes {

std::uint64_t steps_for(const Scene& scene, std::string_view seconds) {
  using Real = MpfrReal<60>;
  Evaluator<Real> evaluate;
  for (const auto& [name, text] : scene.constants) evaluate.define(name, evaluate(text));
  const Real steps = floor(evaluate(seconds) / evaluate(scene.dt) + Real(1) / 2);
  return steps > 0 ? static_cast<std::uint64_t>(steps) : 0;
}

std::uint64_t steps_until_end(const Scene& scene) {
  return steps_for(scene, scene.until);
}

std::uint64_t steps_between_records(const Scene& scene) {
  return scene.record_every.empty() ? 0 : steps_for(scene, scene.record_every);
}

}  // namespace ulpgate::scenes
