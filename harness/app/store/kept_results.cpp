// KeptResults.
#include "harness/app/store/kept_results.hpp"

#include <fmt/format.h>

#include "harness/app/shell/files.hpp"
#include "harness/app/store/checkpoint_text.hpp"
#include "harness/core/arguments/random_words.hpp"

namespace ulpgate::app {

KeptResults::KeptResults(const OutputDirectory& out)
    : directory_(out.units() / "results"), identity_(identity_text(out.identity())) {}

std::filesystem::path KeptResults::file_of(const std::string& key) const {
  return directory_ / fmt::format("{:016x}.txt", fnv1a(key));
}

std::optional<std::vector<std::string>> KeptResults::find(const std::string& key) const {
  const auto file = file_of(key);
  if (!std::filesystem::exists(file)) return std::nullopt;
  const auto lines = checked_lines(read_file(file));
  // The first line says whose it is, the second how many follow.
  const bool whole = lines.size() >= 2 &&
                     lines[0].payload == fmt::format("{} {:016x}", identity_, fnv1a(key)) &&
                     lines[1].payload == std::to_string(lines.size() - 2);
  std::vector<std::string> found;
  for (std::size_t i = 2; whole && i < lines.size() && lines[i].payload; ++i)
    found.push_back(*lines[i].payload);
  if (whole && found.size() == lines.size() - 2) return found;
  fmt::print(stderr, "ulpgate: note: {}: damaged, torn or of another run; it is computed again\n",
             file.string());
  return std::nullopt;
}

void KeptResults::keep(const std::string& key, const std::vector<std::string>& lines) const {
  std::string text = with_checksum(fmt::format("{} {:016x}", identity_, fnv1a(key)));
  text += with_checksum(std::to_string(lines.size()));
  for (const auto& line : lines) text += with_checksum(line);
  make_directory(directory_);
  write_file(file_of(key), text);
}

}  // namespace ulpgate::app
