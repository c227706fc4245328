// Scenes by name or file, with overrides; errors name file, line and key.
#pragma once

#include <string>
#include <vector>

#include "kernels/scenes/reader/scene.hpp"

namespace ulpgate::app {

struct BuiltinScene {
  const char* name;
  const char* text;
};
// The scenes built in, sorted by name.
[[nodiscard]] const std::vector<BuiltinScene>& builtin_scenes();

struct LoadedScene {
  scenes::Scene scene;
  std::string text;  // of the file, and the overrides: the scene's identity in a plan
  std::string file;  // its path as it was given; empty: built in
};
// `name` is a scene built in, or the path of a TOML file.  Overrides are "key=value".
[[nodiscard]] LoadedScene load_scene(const std::string& name, const std::vector<std::string>& overrides);

}  // namespace ulpgate::app
