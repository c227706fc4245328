// Checkpoint.
#include "harness/app/store/checkpoint.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <map>

#include "harness/app/shell/failure.hpp"
#include "harness/app/shell/files.hpp"
#include "harness/app/store/checkpoint_text.hpp"

namespace ulpgate::app {

namespace {

// The log is merged into done.txt when it has grown to this.
constexpr std::size_t greatest_log = std::size_t{32} << 20U;

std::string header_line(const RunIdentity& identity) {
  return with_checksum("h " + identity_text(identity));
}

}  // namespace

void UnitProgress::Row::add(const std::vector<Summary>& summaries, double unit_seconds,
                            std::uint64_t unit_points) {
  parts.resize(summaries.size());
  for (std::size_t part = 0; part < summaries.size(); ++part) parts[part].merge(summaries[part]);
  seconds += unit_seconds;
  points += unit_points;
}

Checkpoint::Checkpoint(const OutputDirectory& out)
    : directory_(out.units()), identity_(out.identity()), synced_(std::chrono::steady_clock::now()) {
  make_directory(directory_);
  // Another run's units must be refused before anything is done.
  for (const auto* name : {done_file, log_file}) {
    const auto file = directory_ / name;
    if (!std::filesystem::exists(file)) continue;
    const auto lines = checked_lines(read_file(file));
    if (!lines.empty() && lines.front().payload) check_header(file, *lines.front().payload);
  }
}

Checkpoint::~Checkpoint() {
  if (log_ >= 0) {
    ::fsync(log_);
    ::close(log_);
  }
  // A run that failed before its first unit leaves nothing behind.
  std::error_code code;
  std::filesystem::remove(directory_, code);
}

void Checkpoint::check_header(const std::filesystem::path& file, std::string_view payload) const {
  const bool is_header = payload.starts_with("h ");
  const auto other = identity_difference(std::string(is_header ? payload.substr(2) : ""), identity_);
  if (!other) return;
  throw Failure(Standing::bad_input,
                fmt::format("{}: a partial run with another {}: {}; give the options of that run, another "
                            "--out, or --overwrite",
                            file.string(), other->starts_with("plan ") ? "plan" : "setting", *other));
}

void Checkpoint::restore(const ShardUnits& units, UnitProgress& progress) {
  for (const auto* name : {done_file, log_file}) {
    if (std::filesystem::exists(directory_ / name)) restore_file(directory_ / name, units, progress);
  }
  compact(units, progress);
}

void Checkpoint::restore_file(const std::filesystem::path& file, const ShardUnits& units,
                              UnitProgress& progress) const {
  const auto lines = checked_lines(read_file(file));
  std::size_t damaged = 0;
  std::size_t first_damaged = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    bool good = lines[i].payload.has_value();
    // Without its header the file may be another run's: none of it is taken.
    if (i == 0 && !good) {
      fmt::print(stderr, "ulpgate: note: {}:1: the header is damaged; all units of the file are done again\n",
                 file.string());
      return;
    }
    if (i > 0 && good) good = take_line(*lines[i].payload, units, progress);
    if (good) continue;
    if (damaged++ == 0) first_damaged = i + 1;
  }
  if (damaged > 0) {
    fmt::print(stderr,
               "ulpgate: note: {}:{}: {} damaged or torn line{}; the units of such lines are done again\n",
               file.string(), first_damaged, damaged, damaged == 1 ? "" : "s");
  }
}

void Checkpoint::compact(const ShardUnits& units, const UnitProgress& progress) {
  std::map<std::size_t, std::vector<std::size_t>> positions;
  for (std::size_t p = 0; p < progress.done.size(); ++p) {
    if (progress.done[p]) positions[units[p].row].push_back(p);
  }
  std::string text = header_line(identity_);
  for (const auto& [row, done] : positions) text += with_checksum(row_payload(row, progress.rows[row], done));
  write_file(directory_ / done_file, text);
  // The units of the old log are all in done.txt now.
  if (log_ >= 0) ::close(log_);
  write_file(directory_ / log_file, header_line(identity_));
  log_ = ::open((directory_ / log_file).c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (log_ < 0) {
    throw Failure(Standing::environment,
                  fmt::format("cannot open {}: {}", (directory_ / log_file).string(), std::strerror(errno)));
  }
  log_size_ = 0;
}

void Checkpoint::append(std::size_t position, double seconds, const std::vector<Summary>& summaries,
                        const ShardUnits& units, const UnitProgress& progress) {
  write_log(with_checksum(unit_payload(position, seconds, summaries)));
  if (log_size_ > greatest_log) compact(units, progress);
}

void Checkpoint::write_log(const std::string& text) {
  const auto fail = [&] {
    throw Failure(Standing::environment,
                  fmt::format("cannot write {}: {}; the units finished before are kept: go on with --resume",
                              (directory_ / log_file).string(), std::strerror(errno)));
  };
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t n = ::write(log_, text.data() + done, text.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail();
    done += static_cast<std::size_t>(n);
  }
  log_size_ += text.size();
  const auto now = std::chrono::steady_clock::now();
  if (now - synced_ < sync_interval) return;
  synced_ = now;
  if (::fsync(log_) != 0 && errno != EINVAL) fail();
}

void Checkpoint::remove() {
  if (log_ >= 0) ::close(log_);
  log_ = -1;
  remove_directory(directory_);
}

}  // namespace ulpgate::app
