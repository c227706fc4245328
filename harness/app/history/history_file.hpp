// History: the summaries of many runs in one SQLite file.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "harness/app/history/database.hpp"
#include "harness/app/history/run_summary.hpp"

namespace ulpgate::app {

struct HistoryRun {
  std::int64_t id = 0;
  std::string commit;
  std::int64_t time_s = 0;
  std::map<std::string, std::string> platform;
  std::string verb;
};

// A row that is another from some run on.
struct HistoryStep {
  RowKey key;
  std::size_t run = 0;     // the first with the new figures, a position in HistoryFile::runs()
  std::size_t before = 0;  // the last with those before
  Change change = Change::none;
  std::string text;      // of accuracy: the figures; of speed: times and how sure it is
  std::string platform;  // what changed in it between the two runs; may be empty
  bool is_speed = false;
};

// What a row came to in one run; `result` is the number of its figures, the same where they are the same.
struct RowPoint {
  std::size_t run = 0;  // position in HistoryFile::runs()
  std::int64_t result = 0;
  std::string implementation;
};

struct TimePoint {
  std::size_t run = 0;
  TimedRow times;
};

// One name in one type, or all where both are empty.
struct RowChoice {
  std::string name, type;
};

class HistoryFile {
 public:
  // Reading refuses a file of a newer program, and one that is no history, as bad_input.
  HistoryFile(const std::filesystem::path& file, Database::Access access);

  // Within it runs are added, and all of them are there once it is committed, or none.
  [[nodiscard]] Transaction begin() { return Transaction(database_); }
  // Within begin(): false where the same run of this commit is there already.
  [[nodiscard]] bool add(const RunSummary& run, const std::string& commit, std::int64_t time_s);

  // By time; of the same second in the order they were added.
  [[nodiscard]] const std::vector<HistoryRun>& runs() const { return runs_; }
  // In the order of runs().
  [[nodiscard]] std::map<RowKey, std::vector<RowPoint>> rows(const RowChoice& choice = {});
  [[nodiscard]] std::map<RowKey, std::vector<TimePoint>> times(const RowChoice& choice = {});
  [[nodiscard]] RowResult result(std::int64_t id);
  // Within begin(), after add(): puts the steps in place of those that are there, for programs that read the
  // file.
  void keep_steps(const std::vector<HistoryStep>& steps);
  // Names that are there, for a word about a misspelt one.
  [[nodiscard]] std::vector<std::string> names();

 private:
  void check_or_make();
  void read_runs();
  std::int64_t number_of(const char* select, const char* insert, const std::vector<std::string>& texts);
  void add_rows(std::int64_t id, const RunSummary& run);
  void add_times(std::int64_t id, const RunSummary& run);

  Database database_;
  Database::Access access_;
  std::vector<HistoryRun> runs_;
  std::map<std::int64_t, std::size_t> positions_;  // of runs by id
};

}  // namespace ulpgate::app
