// Changing single values of a scene by key=value.
#include "kernels/scenes/reader/scene_reader.hpp"
#include "kernels/scenes/reader/toml_fields.hpp"

namespace ulpgate::scenes {

namespace {

struct Target {
  Expression* value = nullptr;
  Range range = Range::any;
};

Target material_target(Material& m, std::string_view key) {
  if (key == "density") return {&m.density, Range::positive};
  if (key == "young") return {&m.young, Range::positive};
  if (key == "stiffness") return {&m.stiffness.emplace(), Range::positive};
  if (key == "poisson") return {&m.poisson, Range::below_one};
  if (key == "friction_angle") return {&m.friction_angle, Range::acute};
  if (key == "collision_time") return {&m.collision_time, Range::positive};
  if (key == "restitution_normal") return {&m.restitution_normal, Range::unit_open_closed};
  if (key == "restitution_tangential") return {&m.restitution_tangential, Range::unit_open_closed};
  if (key == "adhesion") return {&m.adhesion, Range::not_negative};
  if (key == "cohesion") return {&m.cohesion.emplace(), Range::not_negative};
  if (key == "moment_stiffness") return {&m.moment_stiffness.emplace(), Range::positive};
  return {};
}

Target target_of(Scene& scene, std::string_view key) {
  if (key == "dt") return {&scene.dt, Range::positive};
  if (key == "until") return {&scene.until, Range::positive};
  if (key == "damping") return {&scene.damping, Range::below_one};
  if (key == "sweep") return {&scene.sweep.emplace(), Range::positive};
  if (key == "record_every") return {&scene.record_every, Range::positive};
  if (key == "gravity.x") return {&scene.gravity[0], Range::any};
  if (key == "gravity.y") return {&scene.gravity[1], Range::any};
  if (key == "gravity.z") return {&scene.gravity[2], Range::any};
  constexpr std::string_view prefix = "material.";
  if (key.starts_with(prefix)) {
    const std::string_view rest = key.substr(prefix.size());
    for (Material& m : scene.materials) {
      if (rest.starts_with(m.name + ".")) return material_target(m, rest.substr(m.name.size() + 1));
    }
    return {};
  }
  for (auto& [name, value] : scene.constants) {
    if (name == key) return {&value, Range::any};
  }
  return {};
}

}  // namespace

std::optional<SceneError> apply_override(Scene& scene, std::string_view key_value) {
  const auto error = [&](std::string key, std::string message) {
    return SceneError{"override", 0, std::move(key), std::move(message)};
  };
  const std::size_t equals = key_value.find('=');
  if (equals == std::string_view::npos) return error(std::string(key_value), "must be key=value");
  const std::string key(key_value.substr(0, equals));
  const std::string value(key_value.substr(equals + 1));
  if (key == "mass") {
    if (value != "full" && value != "yade") return error(key, "'" + value + "' is none of full, yade");
    scene.mass_rule = value == "yade" ? MassRule::yade : MassRule::full;
    return std::nullopt;
  }
  if (key == "constants") {
    if (value != "rounded_once" && value != "stepwise")
      return error(key, "'" + value + "' is none of rounded_once, stepwise");
    scene.constants_rule = value == "stepwise" ? ConstantsRule::stepwise : ConstantsRule::rounded_once;
    return std::nullopt;
  }
  if (key == "shared_edges") {
    if (value != "once" && value != "each") return error(key, "'" + value + "' is none of once, each");
    scene.shared_edges = value == "each" ? SharedEdges::each : SharedEdges::once;
    return std::nullopt;
  }
  Scene changed = scene;
  const Target target = target_of(changed, key);
  if (target.value == nullptr) return error(key, "nothing of this name can be changed");
  Evaluator<double> constants;
  *target.value = value;
  for (const auto& [name, text] : changed.constants) {
    if (const std::string fault = number_fault(constants, text, Range::any); !fault.empty())
      return error(key, fault);
    constants.define(name, constants(text));
  }
  if (const std::string fault = number_fault(constants, value, target.range); !fault.empty()) {
    return error(key, fault);
  }
  scene = std::move(changed);
  return std::nullopt;
}

}  // namespace ulpgate::scenes
