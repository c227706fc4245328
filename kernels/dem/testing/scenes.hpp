// The scenes of kernels/scenes for tests.
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

inline scenes::Scene load(const std::string& name) {
  const std::string path = std::string(ULPGATE_SCENES) + "/" + name + ".toml";
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  auto result = scenes::read_scene(text.str(), path);
  for (const auto& e : result.errors) ADD_FAILURE() << e.text();
  return result.scene.value_or(scenes::Scene{});
}

}  // namespace ulpgate::dem::testing
