// Scenes by name or file.
#include "harness/app/scenes/scene_files.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "harness/app/shell/failure.hpp"
#include "harness/app/shell/files.hpp"
#include "harness/app/shell/selection.hpp"
#include "kernels/scenes/reader/scene_reader.hpp"

namespace ulpgate::app {

namespace {

constexpr std::uintmax_t most_scene_bytes = std::uintmax_t{64} << 20U;

// A device may never end, and a directory reads as nothing.
std::string scene_file(const std::string& name) {
  const auto refuse = [&](const std::string& why) { throw Failure(Standing::bad_input, name + ": " + why); };
  std::error_code error;
  const auto status = std::filesystem::status(name, error);
  if (std::filesystem::is_directory(status)) refuse("is a directory, not the TOML file of a scene");
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    refuse("is no regular file, as the TOML file of a scene must be");
  const std::uintmax_t size = std::filesystem::file_size(name, error);
  if (!error && size > most_scene_bytes)
    refuse(fmt::format("has {} bytes; a scene has {} at most", size, most_scene_bytes));
  return read_file(name);
}

// `file`: what errors call it.
std::string text_of(const std::string& name, std::string& file, bool& built_in) {
  for (const auto& scene : builtin_scenes()) {
    if (name == scene.name) {
      file = name + ".toml";
      built_in = true;
      return scene.text;
    }
  }
  file = name;
  if (name.ends_with(".toml") || std::filesystem::exists(name)) return scene_file(name);
  std::vector<std::string> known;
  for (const auto& scene : builtin_scenes()) known.emplace_back(scene.name);
  unknown_name("scene", name, known);
}

}  // namespace

LoadedScene load_scene(const std::string& name, const std::vector<std::string>& overrides) {
  std::string file;
  LoadedScene loaded;
  bool built_in = false;
  loaded.text = text_of(name, file, built_in);
  if (!built_in) loaded.file = file;
  auto result = scenes::read_scene(loaded.text, file);
  if (!result.errors.empty()) {
    std::string message;
    for (const auto& e : result.errors) message += (message.empty() ? "" : "\nulpgate: ") + e.text();
    throw Failure(Standing::bad_input, message);
  }
  loaded.scene = std::move(*result.scene);
  for (const auto& text : overrides) {
    if (const auto error = scenes::apply_override(loaded.scene, text))
      throw Failure(Standing::bad_input, fmt::format("--set {}: {}", text, error->text()));
    loaded.text += "\n# " + text;
  }
  return loaded;
}

}  // namespace ulpgate::app
