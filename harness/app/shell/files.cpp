// Files.
#include "harness/app/shell/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "harness/app/shell/failure.hpp"

namespace ulpgate::app {

namespace {
[[noreturn]] void io_failure(const std::string& what, const std::filesystem::path& path, int error) {
  throw Failure(Standing::environment, fmt::format("{} {}: {}", what, path.string(), std::strerror(error)));
}
}  // namespace

std::string read_file(const std::filesystem::path& path) {
  // A directory reads as nothing and a device without end; a pipe is somebody's text.
  std::error_code code;
  const auto status = std::filesystem::status(path, code);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
      !std::filesystem::is_fifo(status)) {
    throw Failure(Standing::bad_input,
                  fmt::format("cannot read {}: {}", path.string(),
                              std::filesystem::is_directory(status) ? "a directory" : "no regular file"));
  }
  std::ifstream in(path, std::ios::binary);
  if (!in) {
    const auto standing = errno == ENOENT ? Standing::bad_input : Standing::environment;
    throw Failure(standing, fmt::format("cannot read {}: {}", path.string(), std::strerror(errno)));
  }
  std::ostringstream text;
  text << in.rdbuf();
  if (in.bad()) io_failure("cannot read", path, errno);
  return text.str();
}

std::vector<std::string> read_lines(const std::filesystem::path& path) {
  std::istringstream in(read_file(path));
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

void write_file(const std::filesystem::path& path, const std::string& content) {
  // A name of this process and thread alone: neither a link that somebody put there nor what a killed run
  // left is written through, nor can two runs write into one file.
  const std::filesystem::path aside =
      fmt::format("{}.{}-{}.part", path.string(), ::getpid(), static_cast<long>(::gettid()));
  ::unlink(aside.c_str());
  const int file = ::open(aside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (file < 0) io_failure("cannot write", path, errno);
  std::size_t done = 0;
  while (done < content.size()) {
    const ssize_t n = ::write(file, content.data() + done, content.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      const int error = errno;
      ::close(file);
      ::unlink(aside.c_str());
      io_failure("cannot write", path, error);
    }
    done += static_cast<std::size_t>(n);
  }
  const bool synced = ::fsync(file) == 0 || errno == EINVAL;
  const int error = errno;
  if (::close(file) != 0 || !synced) {
    ::unlink(aside.c_str());
    io_failure("cannot write", path, error);
  }
  std::error_code code;
  std::filesystem::rename(aside, path, code);
  if (code) ::unlink(aside.c_str());
  if (code) io_failure("cannot rename to", path, code.value());
}

void make_directory(const std::filesystem::path& path) {
  std::error_code code;
  std::filesystem::create_directories(path, code);
  if (code) io_failure("cannot make directory", path, code.value());
  if (!std::filesystem::is_directory(path)) io_failure("cannot make directory", path, ENOTDIR);
}

void remove_directory(const std::filesystem::path& path) {
  std::error_code code;
  std::filesystem::remove_all(path, code);
  if (code) io_failure("cannot remove", path, code.value());
}

}  // namespace ulpgate::app
