// VouchedFile.
#include "harness/app/scenes/vouched_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <string_view>
#include <vector>

#include "harness/app/shell/failure.hpp"

namespace ulpgate::app {

namespace {

// Of the first `bytes`, or of all where the file has fewer: a trajectory may be larger than memory.
std::uint64_t checksum_of(const std::filesystem::path& path, std::uint64_t bytes) {
  std::ifstream in(path, std::ios::binary);
  std::vector<char> part(std::size_t{1} << 20U);
  std::uint64_t checksum = fnv1a("");
  while (bytes > 0 && in) {
    in.read(part.data(), static_cast<std::streamsize>(std::min<std::uint64_t>(bytes, part.size())));
    const auto got = static_cast<std::size_t>(in.gcount());
    checksum = fnv1a(std::string_view(part.data(), got), checksum);
    bytes -= got;
  }
  return checksum;
}

}  // namespace

void VouchedFile::begin(const std::filesystem::path& path) {
  file_.open(path, 0);
  checksum_ = fnv1a("");
}

void VouchedFile::go_on(const std::filesystem::path& path, const Vouched& vouched) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  // A file that is shorter is refused as such when it is opened.
  if (!error && size >= vouched.bytes && checksum_of(path, vouched.bytes) != vouched.checksum) {
    throw Failure(Standing::bad_input,
                  fmt::format("{}: its first {} bytes are not those that the checkpoint vouches for: it was "
                              "changed; start again with --overwrite",
                              path.string(), vouched.bytes));
  }
  file_.open(path, vouched.bytes);
  checksum_ = vouched.checksum;
}

void VouchedFile::append(const std::string& text) {
  if (!file_.is_open()) return;
  checksum_ = fnv1a(text, checksum_);
  file_.append(text);
}

Vouched VouchedFile::sync() {
  return {file_.sync(), checksum_};
}

}  // namespace ulpgate::app
