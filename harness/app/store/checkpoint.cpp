// Checkpoint.
#include "harness/app/store/checkpoint.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <map>

#include "harness/app/shell/failure.hpp"
#include "harness/app/shell/files.hpp"
#include "harness/app/store/checkpoint_text.hpp"

namespace ulpgate::app {

namespace {

constexpr const char* done_file = "done.txt";
constexpr const char* log_file = "log.txt";
// The log is merged into done.txt when it has grown to this.
constexpr std::size_t greatest_log = std::size_t{32} << 20U;
// What a power failure may lose, beyond what a killed process may.
constexpr auto sync_interval = std::chrono::seconds(5);

Json header_of(const RunIdentity& identity) {
  return {{"format", 1},
          {"verb", identity.verb},
          {"plan", identity.plan},
          {"shard", identity.shard},
          {"machine", identity.machine}};
}

std::string header_line(const RunIdentity& identity) {
  return with_checksum("h " + header_of(identity).dump());
}

// Names the first of the entries that differ, with both values.
std::string difference(const Json& there, const Json& here) {
  for (const auto& [key, value] : here.items()) {
    const Json other = there.contains(key) ? there.at(key) : Json(nullptr);
    if (other == value) continue;
    if (value.is_object() && other.is_object()) return key + " " + difference(other, value);
    return fmt::format("{} {}, not {}", key, other.dump(), value.dump());
  }
  return "entries that this program does not know";
}

}  // namespace

std::string identity_text(const RunIdentity& identity) {
  return header_of(identity).dump();
}

std::optional<std::string> identity_difference(const std::string& there, const RunIdentity& here) {
  const Json other = Json::parse(there, nullptr, false);
  if (other == header_of(here)) return std::nullopt;
  return other.is_object() ? difference(other, header_of(here)) : "no identity";
}

void UnitProgress::Row::add(const std::vector<Summary>& summaries, double unit_seconds,
                            std::uint64_t unit_points) {
  parts.resize(summaries.size());
  for (std::size_t part = 0; part < summaries.size(); ++part) parts[part].merge(summaries[part]);
  seconds += unit_seconds;
  points += unit_points;
}

Checkpoint::Checkpoint(const std::filesystem::path& out, RunIdentity identity, PartialRun policy)
    : directory_(out / "units"), identity_(std::move(identity)), synced_(std::chrono::steady_clock::now()) {
  const bool partial =
      std::filesystem::exists(directory_ / done_file) || std::filesystem::exists(directory_ / log_file);
  if (partial && policy == PartialRun::refuse) {
    throw Failure(ExitCode::bad_input,
                  fmt::format("{} holds a partial run: go on with --resume, or start anew with --overwrite",
                              out.string()));
  }
  make_directory(directory_);
  lock_ = ::open(directory_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ >= 0 && ::flock(lock_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    ::close(lock_);
    throw Failure(ExitCode::bad_input, fmt::format("another process works in {}", out.string()));
  }
  if (policy == PartialRun::resume) {
    // Another run's units must be refused before anything is done.
    for (const auto* name : {done_file, log_file}) {
      const auto file = directory_ / name;
      if (!std::filesystem::exists(file)) continue;
      const auto lines = checked_lines(read_file(file));
      if (!lines.empty() && lines.front().payload) check_header(file, *lines.front().payload);
    }
  } else {
    for (const auto* name : {done_file, log_file}) std::filesystem::remove(directory_ / name);
  }
}

Checkpoint::~Checkpoint() {
  if (log_ >= 0) {
    ::fsync(log_);
    ::close(log_);
  }
  if (lock_ >= 0) ::close(lock_);
  // A run that failed before its first unit leaves nothing behind.
  std::error_code code;
  std::filesystem::remove(directory_, code);
}

void Checkpoint::check_header(const std::filesystem::path& file, std::string_view payload) const {
  Json there;
  if (payload.starts_with("h ")) there = Json::parse(payload.substr(2), nullptr, false);
  if (!there.is_object()) {
    throw Failure(ExitCode::bad_input, fmt::format("{}:1: not a checkpoint's header", file.string()));
  }
  const Json here = header_of(identity_);
  if (there == here) return;
  const bool other_plan = there.value("plan", "") != identity_.plan;
  throw Failure(ExitCode::bad_input,
                fmt::format("{}: a partial run with another {}: {}; give the options of that run, another "
                            "--out, or --overwrite",
                            file.string(), other_plan ? "plan" : "setting", difference(there, here)));
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
    throw Failure(ExitCode::environment,
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
    throw Failure(ExitCode::environment,
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
  std::error_code code;
  std::filesystem::remove_all(directory_, code);
  if (code) {
    throw Failure(ExitCode::environment,
                  fmt::format("cannot remove {}: {}", directory_.string(), code.message()));
  }
}

}  // namespace ulpgate::app
