// TOML files of budgets, DIR/<name>.toml each: read all, and written only where they can be read again.
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <string>

#include "harness/app/budgets/toml_text.hpp"
#include "harness/app/shell/failure.hpp"
#include "harness/app/shell/files.hpp"

namespace ulpgate::app {

// What one file holds, from its text; errors name file and line.
template <class Content>
using ParseToml = Content (*)(const std::string& text, const std::string& file);

// By name.  Throws a Failure where the directory is none.
template <class Content>
[[nodiscard]] std::map<std::string, Content> read_toml_files(const std::filesystem::path& directory,
                                                             ParseToml<Content> parse) {
  if (!std::filesystem::is_directory(directory))
    throw Failure(Standing::bad_input, fmt::format("{}: no such directory of budgets", directory.string()));
  std::map<std::string, Content> contents;
  for (const auto& entry : std::filesystem::directory_iterator(directory)) {
    if (entry.path().extension() != ".toml") continue;
    contents.emplace(entry.path().stem().string(), parse(read_file(entry.path()), entry.path().string()));
  }
  return contents;
}

// Every file is read back before any old one is replaced: what cannot be read must not take the place of what
// can.
template <class Content>
void write_toml_files(const std::filesystem::path& directory, const std::map<std::string, Content>& contents,
                      std::string (*text_of)(const std::string& name, const Content& content),
                      ParseToml<Content> parse) {
  std::map<std::filesystem::path, std::string> files;
  for (const auto& [name, content] : contents) {
    const auto file = toml_file(directory, name);
    std::string text = text_of(name, content);
    if (!(parse(text, file.string()) == content))
      throw Failure(Standing::bad_input,
                    fmt::format("{}: these budgets do not survive being written", file.string()));
    files[file] = std::move(text);
  }
  make_directory(directory);
  for (const auto& [file, text] : files) write_file(file, text);
}

}  // namespace ulpgate::app
