// Writing scenes as TOML.
#include "harness/core/scene_cases/scene_text.hpp"

namespace ulpgate::scene_text {

namespace {

std::string value_text(std::string_view value) {
  if (value == "true" || value == "false" || value.starts_with('[')) return std::string(value);
  constexpr std::string_view comma = ", ";
  std::string text = "\"";
  std::size_t parts = 1;
  for (std::size_t at = value.find(comma); at != value.npos; at = value.find(comma), ++parts) {
    text += std::string(value.substr(0, at)) + "\", \"";
    value.remove_prefix(at + comma.size());
  }
  text += std::string(value) + "\"";
  return parts == 1 ? text : "[" + text + "]";
}

// Of the keys that a section always has and of the others.
Keys joined(Keys first, const Keys& others) {
  first.insert(first.end(), others.begin(), others.end());
  return first;
}

}  // namespace

std::string section(std::string_view header, const Keys& keys) {
  std::string text = std::string(header) + "\n";
  for (const auto& [key, value] : keys) text += std::string(key) + " = " + value_text(value) + "\n";
  return text;
}

std::string begin(const std::string& scene, const std::string& material, const Keys& keys) {
  return "name = \"" + scene + "\"\n" + section("[[material]]", joined({{"name", material}}, keys));
}

std::string sphere(const std::string& position, const std::string& radius, const Keys& keys) {
  return section("[[sphere]]", joined({{"position", position}, {"radius", radius}}, keys));
}

std::string wall(const std::string& y) {
  return section("[[wall]]", {{"axis", "y"}, {"position", y}});
}

std::string contacts(const std::string& law, const Keys& keys) {
  return section("[contacts]", joined({{"law", law}}, keys));
}

std::string run(const std::string& dt, const std::string& until, const Keys& keys) {
  return section("[run]", joined({{"dt", dt}, {"until", until}}, keys));
}

std::string head_on_balls(const std::string& restitution, const std::string& x1, const std::string& x2) {
  return begin("head_on", "ball",
               {{"density", "2500"}, {"collision_time", "1e-3"}, {"restitution_normal", restitution}}) +
         sphere(x1 + ", 0, 0", "0.01", {{"velocity", "1, 0, 0"}}) +
         sphere(x2 + ", 0, 0", "0.01", {{"velocity", "-1, 0, 0"}}) + contacts("viscoelastic");
}

std::string text_of(const SpinningBalls& balls, const std::string& name) {
  return begin(name, "ball",
               {{"density", "2500"},
                {"young", balls.young},
                {"poisson", "0.3"},
                {"friction_angle", balls.friction_angle},
                {"collision_time", "1e-4"},
                {"restitution_normal", "0.7"},
                {"restitution_tangential", "0.8"}}) +
         sphere("-0.0101, 0.001, -0.002", "0.01",
                {{"velocity", "1, 0.3, 0.2"}, {"angular_velocity", "5, -70, 30"}}) +
         sphere(balls.x2 + ", 0.007, 0.003", "0.012",
                {{"velocity", "-1.2, 0.1, -0.3"}, {"angular_velocity", "11, 20, -60"}}) +
         contacts(balls.law) + run("4e-7", "1", {{"record", energy}});
}

}  // namespace ulpgate::scene_text
