// OutputDirectory: the one owner of a run's directory: its lock, whose records it holds, what may be written
// over, and the final write.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/app/store/records.hpp"

namespace ulpgate::app {

// What must be the same for two processes to work on one run.
struct RunIdentity {
  std::string verb;                 // "math", "scene run"
  std::string plan;                 // hash
  std::vector<std::string> shards;  // "0/3"; those of a merge are several
  std::string selection;            // what the plan does not say: the types of a scene's run
  Json machine;                     // of machine_facts(): program, compiler, libraries, processor
};

// The identity as one line of text.
[[nodiscard]] std::string identity_text(const RunIdentity& identity);
// Names what is not as in `here`, with both values; nothing where `there`, a text of identity_text, says the
// same.
[[nodiscard]] std::optional<std::string> identity_difference(const std::string& there,
                                                             const RunIdentity& here);

// What to do with what an earlier process left.
enum class PartialRun { refuse, resume, discard };
[[nodiscard]] inline PartialRun partial_run(bool resume, bool overwrite) {
  if (resume) return PartialRun::resume;
  return overwrite ? PartialRun::discard : PartialRun::refuse;
}

class OutputDirectory {
 public:
  // Makes the directory, and locks it before anything in it is looked at or removed.  Throws a Failure:
  // bad_input where another process works in it or where it holds a partial run and the policy is to refuse
  // it; another_plan where it holds records that this run would lose (of another verb, plan, selection or
  // shard) and the policy is not to discard them.  Where it is, everything that ulpgate writes into such a
  // directory is removed; files that it does not know stay.
  OutputDirectory(std::filesystem::path path, RunIdentity identity, PartialRun policy);
  OutputDirectory(const OutputDirectory&) = delete;
  OutputDirectory& operator=(const OutputDirectory&) = delete;
  ~OutputDirectory();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] const RunIdentity& identity() const { return identity_; }
  [[nodiscard]] PartialRun policy() const { return policy_; }
  // Where units or checkpoints of runs that are not finished lie.
  [[nodiscard]] std::filesystem::path units() const { return path_ / "units"; }
  // Whether its context says that it holds all records of this very run.
  [[nodiscard]] bool is_finished() const;

  // The run begins: from now on context.json says whose files these are, and that they are not finished.
  void begin(Json context) const;
  // One of the files of a run, whole.
  void write(const std::string& name, const std::string& content) const;
  // The last write: after it the directory holds the run.
  void finish(Json context, bool finished) const;

 private:
  void lock();
  void guard() const;
  // A killed process may have been about to replace a file: what it wrote aside is nobody's now.
  void remove_remnants() const;
  void clear() const;
  void write_context_of(Json context, bool finished, bool sealed) const;

  std::filesystem::path path_;
  RunIdentity identity_;
  PartialRun policy_;
  int lock_ = -1;
};

}  // namespace ulpgate::app
