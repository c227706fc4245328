// Reads a Scene from TOML text and applies overrides; every error names file, line and key.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kernels/scenes/reader/scene.hpp"

namespace ulpgate::scenes {

struct SceneError {
  std::string file;
  int line = 0;     // 0 where there is no line, as for an override
  std::string key;  // "material[0].density"; empty for the file as a whole
  std::string message;

  // "deposition.toml:12: material[0].density: must be positive"
  [[nodiscard]] std::string text() const;
};

struct ReadResult {
  std::optional<Scene> scene;  // none where there are errors
  std::vector<SceneError> errors;
};

// `text` is the file's content, `file` the name for messages.  Numbers are integers, strings that hold an
// expression, or TOML floats; the digits of a float are taken from the text, so none are lost.
[[nodiscard]] ReadResult read_scene(std::string_view text, std::string_view file);

// "dt=1e-6", "damping=5e-3", "mass=yade", "shared_edges=each", "gravity.y=-1.62",
// "material.grain.friction_angle=20", or the name of one of the scene's constants.  Returns the error, or
// none.
[[nodiscard]] std::optional<SceneError> apply_override(Scene& scene, std::string_view key_value);

}  // namespace ulpgate::scenes
