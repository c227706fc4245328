// Times of a scene as numbers of steps.
#include "kernels/scenes/reader/scene_steps.hpp"

#include "kernels/scenes/reader/expression.hpp"
#include "kernels/scenes/reader/scene_fault.hpp"

namespace ulpgate::scenes {

std::uint64_t steps_for(const Scene& scene, std::string_view seconds) {
  using Real = MpfrReal<60>;
  Evaluator<Real> evaluate;
  for (const auto& [name, text] : scene.constants) evaluate.define(name, evaluate(text));
  const auto judged = [&](const std::string& what, std::string_view text, Range range) {
    const Real value = evaluate(text);
    const std::string fault = range_fault(value, range);
    if (!fault.empty()) throw SceneFault(what + fault + ", is '" + std::string(text) + "'");
    return value;
  };
  const Real dt = judged("run.dt: ", scene.dt, Range::positive);
  const Real steps = floor(judged("", seconds, Range::any) / dt + Real(1) / 2);
  if (!(steps < Real(countless_steps))) return countless_steps;
  return steps > 0 ? static_cast<std::uint64_t>(steps) : 0;
}

std::uint64_t steps_until_end(const Scene& scene) {
  return steps_for(scene, scene.until);
}

std::uint64_t steps_between_records(const Scene& scene) {
  if (scene.record_every.empty()) return 0;
  const std::uint64_t steps = steps_for(scene, scene.record_every);
  if (steps == 0)
    throw SceneFault("run.record_every: '" + scene.record_every + "' s is less than half a step of '" +
                     scene.dt + "' s");
  return steps;
}

}  // namespace ulpgate::scenes
