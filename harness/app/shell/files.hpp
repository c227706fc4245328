// Files: whole-file reads and writes that either succeed or name what failed; a write is aside, then renamed.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace ulpgate::app {

[[nodiscard]] std::string read_file(const std::filesystem::path& path);
[[nodiscard]] std::vector<std::string> read_lines(const std::filesystem::path& path);
// The old content stays until the new one is complete on disk.
void write_file(const std::filesystem::path& path, const std::string& content);
void make_directory(const std::filesystem::path& path);
// With all that is in it, or nothing where there is none.
void remove_directory(const std::filesystem::path& path);

}  // namespace ulpgate::app
