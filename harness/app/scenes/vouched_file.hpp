// VouchedFile: a file of records that grows, with the checksum by which a checkpoint vouches for its content.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "harness/app/shell/append_file.hpp"
#include "harness/core/arguments/random_words.hpp"

namespace ulpgate::app {

// The bytes that were on disk, and their FNV-1a.
struct Vouched {
  std::uint64_t bytes = 0;
  std::uint64_t checksum = fnv1a("");
};

class VouchedFile {
 public:
  // A new file, over whatever was there.
  void begin(const std::filesystem::path& path);
  // Cuts the file to what is vouched for and goes on behind it.  Throws a Failure that names the file where
  // it is shorter, or its content is not what it was; the file is then as it was.
  void go_on(const std::filesystem::path& path, const Vouched& vouched);
  [[nodiscard]] bool is_open() const { return file_.is_open(); }
  // Without a file nothing is kept.
  void append(const std::string& text);
  // On disk; of no file the sum of nothing.
  Vouched sync();

 private:
  AppendFile file_;
  std::uint64_t checksum_ = fnv1a("");
};

}  // namespace ulpgate::app
