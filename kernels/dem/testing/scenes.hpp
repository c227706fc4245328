// Scenes for tests: those of kernels/scenes, as they are or changed, and one of everything they have not
// together.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "kernels/scenes/reader/scene_reader.hpp"

namespace ulpgate::dem::testing {

// All of them, sorted.
inline std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(ULPGATE_SCENES)) {
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem());
  }
  std::sort(names.begin(), names.end());
  EXPECT_GE(names.size(), 8U);
  return names;
}

inline scenes::Scene read(const std::string& text, const std::string& name = "scene of a test") {
  auto result = scenes::read_scene(text, name);
  for (const auto& e : result.errors) ADD_FAILURE() << e.text();
  return result.scene.value_or(scenes::Scene{});
}

inline scenes::Scene load(const std::string& name) {
  const std::string path = std::string(ULPGATE_SCENES) + "/" + name + ".toml";
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return read(text.str(), path);
}

inline scenes::Scene changed(scenes::Scene scene, const std::vector<std::string>& overrides) {
  for (const std::string& o : overrides) {
    const auto error = apply_override(scene, o);
    EXPECT_FALSE(error) << o << ": " << (error ? error->text() : "");
  }
  return scene;
}

// A scene that is brought quickly to where bodies touch.
inline scenes::Scene busy(const std::string& name) {
  if (name == "packing") return changed(load(name), {"speed=20"});
  // Fewer and larger spheres, thrown down, so that they lie in each other's way within a few hundred steps.
  if (name == "deposition") return changed(load(name), {"radius=0.04", "gravity.y=-2000"});
  return load(name);
}

// Spheres of many sizes and one of three moments above a turned box and a facet: a law's shapes and bodies
// that no scene file has together.
inline scenes::Scene everything(const std::string& law) {
  return read(R"(name = "everything"
[[material]]
name = "m"
density = 2500
young = 1e7
poisson = 0.3
friction_angle = 20
[[generator]]
kind = "grid"
radius = 0.01
radius_spread = 0.2
counts = [3, 3, 3]
spacing = [0.023, 0.023, 0.023]
corner = [-0.02, 0.02, -0.02]
jitter = 0.001
[[sphere]]
position = [0.001, 0.1, 0.002]
radius = 0.012
inertia = [1e-6, 2e-6, 3e-6]
angular_velocity = [1, 20, 3]
[[box]]
centre = [0, -0.02, 0]
half_size = [0.03, 0.02, 0.03]
axis = [0, 0, 1]
angle = 10
[[facet]]
vertices = [[-1, -0.05, -1], [1, -0.05, -1], [0, -0.05, 1]]
[contacts]
law = ")" + law +
              R"("
[run]
dt = 1e-5
until = 1
gravity = [0, -9.81, 0]
record = ["energy"]
)");
}

}  // namespace ulpgate::dem::testing
