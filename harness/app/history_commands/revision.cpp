// Revision.
#include "harness/app/history_commands/revision.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "harness/app/machine/child_process.hpp"
#include "harness/app/shell/failure.hpp"

namespace ulpgate::app {

namespace {

// What git printed, without the end of its line; nothing where it failed.
std::optional<std::string> output_of_git(std::vector<std::string> words) {
  words.insert(words.begin(), "git");
  ChildOutput output = output_of(words, ChildErrors::dropped);
  if (output.exit_code != 0) return std::nullopt;
  while (output.text.ends_with('\n')) output.text.pop_back();
  return output.text;
}

bool is_revision(const std::string& text) {
  const auto allowed = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
           std::string_view("._/+-").find(c) != std::string_view::npos;
  };
  return !text.empty() && text.size() <= 100 && std::ranges::all_of(text, allowed);
}

}  // namespace

std::string revision_of(const std::string& named) {
  if (!named.empty()) {
    if (is_revision(named)) return named;
    throw Failure(
        Standing::bad_input,
        fmt::format("--commit {}: a commit has letters, digits and ._/+-, 100 of them at most", named));
  }
  auto commit = output_of_git({"rev-parse", "--verify", "HEAD"});
  if (!commit || !is_revision(*commit))
    throw Failure(Standing::bad_input, "no commit is checked out here: name the run's with --commit REV");
  const auto changed = output_of_git({"status", "--porcelain", "--untracked-files=no"});
  return changed && changed->empty() ? *commit : *commit + "-dirty";
}

}  // namespace ulpgate::app
