// PieceLog.
#include "harness/app/store/piece_log.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <bit>
#include <cerrno>
#include <charconv>

#include "harness/app/shell/failure.hpp"
#include "harness/app/shell/files.hpp"
#include "harness/app/store/checkpoint_text.hpp"

namespace ulpgate::app {

namespace {

std::string line_of(const PieceLog::Piece& piece) {
  return with_checksum(fmt::format("p {} {:x} {}", piece.measurement,
                                   std::bit_cast<std::uint64_t>(piece.seconds), piece.text));
}

std::optional<PieceLog::Piece> piece_of(const std::string& payload) {
  PieceLog::Piece piece;
  std::uint64_t bits = 0;
  const char* at = payload.data();
  const char* const end = at + payload.size();
  if (!payload.starts_with("p ")) return std::nullopt;
  const auto number = std::from_chars(at + 2, end, piece.measurement);
  if (number.ec != std::errc() || number.ptr == end || *number.ptr != ' ') return std::nullopt;
  const auto seconds = std::from_chars(number.ptr + 1, end, bits, 16);
  if (seconds.ec != std::errc() || seconds.ptr == end || *seconds.ptr != ' ') return std::nullopt;
  piece.seconds = std::bit_cast<double>(bits);
  piece.text.assign(seconds.ptr + 1, end);
  return piece;
}

}  // namespace

PieceLog::PieceLog(const OutputDirectory& out)
    : directory_(out.units()),
      header_(with_checksum("h " + identity_text(out.identity()))),
      synced_(std::chrono::steady_clock::now()) {
  make_directory(directory_);
  refuse_others(out.identity());
}

PieceLog::~PieceLog() {
  // A run that failed before its first piece leaves nothing behind.
  std::error_code code;
  std::filesystem::remove(directory_, code);
}

void PieceLog::refuse_others(const RunIdentity& identity) const {
  for (const auto* name : {done_file, log_file}) {
    const auto file = directory_ / name;
    if (!std::filesystem::exists(file)) continue;
    const auto lines = checked_lines(read_file(file));
    // Without its header none of the file is taken.
    if (lines.empty() || !lines.front().payload) continue;
    const std::string& there = *lines.front().payload;
    const auto other = identity_difference(there.starts_with("h ") ? there.substr(2) : "", identity);
    if (!other) continue;
    throw Failure(Standing::bad_input,
                  fmt::format("{}: a partial run with another {}: {}; give the options of that run, another "
                              "--out, or --overwrite",
                              file.string(), other->starts_with("plan ") ? "plan" : "setting", *other));
  }
}

void PieceLog::restore(const std::function<bool(const Piece&)>& take) {
  const auto file = directory_ / log_file;
  std::string text = header_;
  if (std::filesystem::exists(file)) {
    const auto lines = checked_lines(read_file(file));
    const bool has_header = !lines.empty() && lines.front().payload;
    std::size_t lost = has_header || lines.empty() ? 0 : lines.size();
    std::size_t first_lost = 1;
    for (std::size_t i = 1; has_header && i < lines.size(); ++i) {
      const auto piece = lines[i].payload ? piece_of(*lines[i].payload) : std::nullopt;
      if (piece && take(*piece)) {
        text += line_of(*piece);
      } else if (lost++ == 0) {
        first_lost = i + 1;
      }
    }
    if (lost > 0) {
      fmt::print(stderr, "ulpgate: note: {}:{}: {} damaged or torn line{}; what they held is done again\n",
                 file.string(), first_lost, lost, lost == 1 ? "" : "s");
    }
  }
  write_file(file, text);
  log_.open(file, text.size());
}

void PieceLog::append(const Piece& piece) {
  try {
    log_.append(line_of(piece));
    log_.flush();
    const auto now = std::chrono::steady_clock::now();
    if (now - synced_ < sync_interval) return;
    synced_ = now;
    log_.sync();
  } catch (const Failure& e) {
    throw Failure(e.standing(),
                  fmt::format("{}; what was finished before is kept: go on with --resume", e.what()));
  }
}

void PieceLog::remove() {
  remove_directory(directory_);
}

}  // namespace ulpgate::app
