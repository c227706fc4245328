// PieceLog: the finished pieces of measurements kept under DIR/units, so that a run that was killed can go
// on.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/app/shell/append_file.hpp"
#include "harness/app/store/output_directory.hpp"

namespace ulpgate::app {

// A sibling of Checkpoint for results that are no Summary: the same place, header and lines with a checksum
// each, and its rules for what is refused.  log.txt has a line for every piece, in the order they were
// finished; a later piece of a measurement follows from those before it.
class PieceLog {
 public:
  struct Piece {
    std::size_t measurement = 0;
    double seconds = 0;
    std::string text;  // one line
  };

  // In a directory that this process owns.  Throws a Failure, bad_input, where pieces of another identity are
  // there.
  explicit PieceLog(const OutputDirectory& out);
  PieceLog(const PieceLog&) = delete;
  PieceLog& operator=(const PieceLog&) = delete;
  ~PieceLog();

  // Offers the pieces of earlier processes to `take`, keeps those that it takes, and opens the log.  Damaged
  // lines and pieces not taken are named on stderr, and done again.
  void restore(const std::function<bool(const Piece&)>& take);
  // A piece is finished.  The caller lets one thread in at a time.
  void append(const Piece& piece);
  // The run is complete and its records are written: DIR/units goes.
  void remove();

 private:
  void refuse_others(const RunIdentity& identity) const;

  std::filesystem::path directory_;
  std::string header_;
  AppendFile log_;
  std::chrono::steady_clock::time_point synced_;
};

}  // namespace ulpgate::app
