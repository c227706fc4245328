// Checkpoint: finished work units kept under DIR/units, so that a run that was killed can go on.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "harness/app/store/output_directory.hpp"
#include "harness/core/plan/plan.hpp"

namespace ulpgate::app {

// The units of one shard by position: position p is unit index + p * count of the plan.
struct ShardUnits {
  const std::vector<WorkUnit>& units;
  std::uint64_t index;
  std::uint64_t count;

  [[nodiscard]] std::size_t size() const {
    return index < units.size() ? (units.size() - index + count - 1) / count : 0;
  }
  [[nodiscard]] const WorkUnit& operator[](std::size_t position) const {
    return units[index + position * count];
  }
  [[nodiscard]] std::uint64_t points(std::size_t position) const {
    return (*this)[position].last - (*this)[position].first;
  }
};

// What is done of a shard: exact sums by row, so that no unit is kept twice.
struct UnitProgress {
  struct Row {
    std::vector<Summary> parts;  // empty where no unit of the row is done
    double seconds = 0;          // of one thread
    std::uint64_t points = 0;
    void add(const std::vector<Summary>& summaries, double unit_seconds, std::uint64_t unit_points);
  };
  UnitProgress(std::size_t units, std::size_t row_count) : done(units), rows(row_count) {}
  std::vector<bool> done;  // by position
  std::vector<Row> rows;
};

// Two files, of lines that carry a checksum each.  log.txt: a line for every unit, written when the unit is
// finished, so that a killed process loses unfinished units alone.  done.txt: the log's units merged row by
// row, written aside and renamed when the log has grown; a unit in both counts once.
class Checkpoint {
 public:
  // In a directory that this process owns.  Throws a Failure, bad_input, where units of another identity are
  // there.
  explicit Checkpoint(const OutputDirectory& out);
  Checkpoint(const Checkpoint&) = delete;
  Checkpoint& operator=(const Checkpoint&) = delete;
  ~Checkpoint();

  // Reads the units of earlier processes into `progress` and opens the log.  Damaged lines are named on
  // stderr; their units are simply not done.
  void restore(const ShardUnits& units, UnitProgress& progress);
  // A unit is finished; `progress` has it already.  The caller lets one thread in at a time.
  void append(std::size_t position, double seconds, const std::vector<Summary>& summaries,
              const ShardUnits& units, const UnitProgress& progress);
  [[nodiscard]] const RunIdentity& identity() const { return identity_; }
  // The run is complete and its records are written: DIR/units goes.
  void remove();

 private:
  void check_header(const std::filesystem::path& file, std::string_view payload) const;
  void restore_file(const std::filesystem::path& file, const ShardUnits& units, UnitProgress& progress) const;
  void compact(const ShardUnits& units, const UnitProgress& progress);
  void write_log(const std::string& text);

  std::filesystem::path directory_;
  RunIdentity identity_;
  int log_ = -1;
  std::size_t log_size_ = 0;
  std::chrono::steady_clock::time_point synced_;
};

}  // namespace ulpgate::app
