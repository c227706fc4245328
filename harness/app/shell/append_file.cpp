// AppendFile.
#include "harness/app/shell/append_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "harness/app/shell/failure.hpp"

namespace ulpgate::app {

namespace {

constexpr std::size_t enough = std::size_t{1} << 20;

[[noreturn]] void fail(const std::filesystem::path& path, int error) {
  throw Failure(Standing::environment,
                fmt::format("cannot write {}: {}", path.string(), std::strerror(error)));
}

}  // namespace

AppendFile::~AppendFile() {
  if (file_ >= 0) ::close(file_);
}

void AppendFile::open(const std::filesystem::path& path, std::uint64_t length) {
  path_ = path;
  file_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  struct stat facts {};
  if (file_ < 0 || ::fstat(file_, &facts) != 0) fail(path, errno);
  if (static_cast<std::uint64_t>(facts.st_size) < length) {
    throw Failure(
        Standing::bad_input,
        fmt::format("{} has {} bytes, the checkpoint vouches for {}: it was changed; start again with "
                    "--overwrite",
                    path.string(), facts.st_size, length));
  }
  if (::ftruncate(file_, static_cast<off_t>(length)) != 0 ||
      ::lseek(file_, static_cast<off_t>(length), SEEK_SET) < 0)
    fail(path, errno);
  length_ = length;
}

void AppendFile::append(const std::string& text) {
  if (file_ < 0) return;
  waiting_ += text;
  if (waiting_.size() >= enough) flush();
}

void AppendFile::flush() {
  std::size_t done = 0;
  while (done < waiting_.size()) {
    const ssize_t n = ::write(file_, waiting_.data() + done, waiting_.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(path_, errno);
    done += static_cast<std::size_t>(n);
  }
  length_ += done;
  waiting_.clear();
}

std::uint64_t AppendFile::sync() {
  if (file_ < 0) return 0;
  flush();
  if (::fsync(file_) != 0 && errno != EINVAL) fail(path_, errno);
  return length_;
}

}  // namespace ulpgate::app
