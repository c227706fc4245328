// What was probably meant: verbs that were flags, options that had another name.
#include "harness/app/scene_commands/old_spellings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "harness/app/scenes/scene_files.hpp"
#include "harness/app/shell/failure.hpp"

namespace ulpgate::app {

namespace {

struct Renamed {
  std::string_view from, to;
};
// Flags that are verbs, and options that only one verb has; of several the first in this order was meant.
constexpr std::array<Renamed, 7> verbs{{{"--explain", "explain"},
                                        {"--ladder", "ladder"},
                                        {"--correlate", "correlate"},
                                        {"--reference", "correlate"},
                                        {"--repeats", "speed"},
                                        {"--compare", "compare"},
                                        {"--own-constants", "compare"}}};
constexpr std::array<Renamed, 2> options{{{"--type", "--types"}, {"--variant", "--set"}}};

std::string name_of_option(const std::string& word) {
  return word.substr(0, word.find('='));
}

template <std::size_t N>
std::optional<std::string> renamed(const std::array<Renamed, N>& table, const std::string& word) {
  const std::string name = name_of_option(word);
  for (const auto& row : table) {
    if (row.from == name) return std::string(row.to);
  }
  return std::nullopt;
}

// The verb that the words ask for; `run` where none of them is a flag that became one.
std::string verb_in(const std::vector<std::string>& words) {
  for (const auto& row : verbs) {
    if (std::ranges::any_of(words, [&](const auto& word) { return name_of_option(word) == row.from; }))
      return std::string(row.to);
  }
  return "run";
}

// The scene among the words: a known name or a file, else the first word that is no option.
std::string scene_in(const std::vector<std::string>& words) {
  for (const auto& word : words) {
    if (word.ends_with(".toml") ||
        std::ranges::any_of(builtin_scenes(), [&](const auto& scene) { return word == scene.name; }))
      return word;
  }
  const auto plain = std::ranges::find_if(words, [](const auto& word) { return !word.starts_with("-"); });
  return plain == words.end() ? "SCENE" : *plain;
}

[[noreturn]] void refuse(const std::string& message) {
  throw Failure(Standing::bad_input, message);
}

}  // namespace

void refuse_words_before_verb(const std::vector<std::string>& words, const std::string& verb) {
  constexpr const char* all = "run, explain, compare, ladder, correlate or speed";
  if (words.empty()) refuse(fmt::format("ulpgate scene: name a verb, {} (ulpgate scene --help)", all));
  if (!verb.empty()) {
    refuse(fmt::format("ulpgate scene: '{}' stands before the verb; behind it: ulpgate scene {} SCENE {}",
                       words.front(), verb, words.front()));
  }
  refuse(fmt::format("ulpgate scene: '{}' is no verb of {}; this is `ulpgate scene {} {}`", words.front(),
                     all, verb_in(words), scene_in(words)));
}

void refuse_unknown_words(const std::string& verb, const std::string& scene,
                          const std::vector<std::string>& words) {
  if (words.empty()) return;
  const auto option = std::ranges::find_if(words, [](const auto& word) { return word.starts_with("-"); });
  if (option == words.end())
    refuse(
        fmt::format("ulpgate scene {}: one scene at a time, {} and '{}' are given", verb, scene, words[0]));
  const std::string name = name_of_option(*option);
  if (const auto spelling = renamed(options, name))
    refuse(fmt::format("ulpgate scene {}: {} is spelt {}", verb, name, *spelling));
  if (const auto other = renamed(verbs, name); other && *other != verb)
    refuse(fmt::format("ulpgate scene {}: takes no {}; that is `ulpgate scene {} {}`", verb, name, *other,
                       scene));
  refuse(fmt::format("ulpgate scene {}: takes no {} (ulpgate scene {} --help)", verb, name, verb));
}

}  // namespace ulpgate::app
