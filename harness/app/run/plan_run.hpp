// PlanRun: a plan from its options to its records on disk, the same for every kind of subject.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "harness/app/run/ranks.hpp"
#include "harness/app/run/runner.hpp"
#include "harness/app/shell/failure.hpp"

namespace ulpgate::app {

// What `ulpgate math` and `ulpgate kernels` share on the command line.
struct PlanOptions {
  SubjectKind kind = SubjectKind::function;
  std::string subjects = "all";
  std::string types = "all";
  std::string strata = "all";
  std::uint64_t samples = 20000;
  std::uint64_t seed = 1;
  unsigned threads = 0;
  std::string shard = "0/1";
  std::string out;
  std::string reference = "screened";
  std::string timing = "off";
  unsigned timing_processes = 5;
  unsigned timing_rounds = 5;
  unsigned time_rounds = 0;  // of a process that does nothing but time
  bool resume = false;
  bool overwrite = false;
  bool json = false;
  bool dry_run = false;  // say what would be done
  bool allow_large = false;
};

// Adds the options; `samples` says what --samples counts.
void add_plan_options(CLI::App& verb, PlanOptions& o, const std::string& samples);

// Subjects, types, strata, samples and seed.
[[nodiscard]] PlanRequest request_of(const PlanOptions& o);

// What the records say: told people on stderr, and the exit code.
using PlanVerdict = std::function<Verdict(const RunResult& result)>;

// Runs the plan, or goes on with it, writes records, times and context; a Failure with exit code 3 after an
// interrupt.  The verdict is asked once, about what a directory that is complete already holds as well.
[[nodiscard]] Verdict run_and_write(const Plan& plan, const PlanOptions& o, Ranks* ranks,
                                    const PlanVerdict& verdict);

}  // namespace ulpgate::app
