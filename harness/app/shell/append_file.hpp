// AppendFile: a file that grows, and that can be cut back to a length that was known to be on disk.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace ulpgate::app {

// Every failure throws a Failure that names the file; what was synced before stays.
class AppendFile {
 public:
  AppendFile() = default;
  AppendFile(const AppendFile&) = delete;
  AppendFile& operator=(const AppendFile&) = delete;
  ~AppendFile();

  // Cuts the file to `length` bytes and writes behind them.  Throws where it is shorter.
  void open(const std::filesystem::path& path, std::uint64_t length);
  [[nodiscard]] bool is_open() const { return file_ >= 0; }
  // Kept in memory until some of it has come together.
  void append(const std::string& text);
  // With the operating system: the end of this process loses nothing of it.
  void flush();
  // On disk; returns the length of the file.
  std::uint64_t sync();

 private:
  int file_ = -1;
  std::filesystem::path path_;
  std::string waiting_;
  std::uint64_t length_ = 0;
};

}  // namespace ulpgate::app
