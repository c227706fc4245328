// ulpgate math: runs functions over strata of arguments and writes records.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "harness/app/commands/commands.hpp"
#include "harness/app/run/plan_run.hpp"
#include "harness/app/store/worst_cases.hpp"
#include "harness/core/functions/oracle_defects.hpp"

namespace ulpgate::app {

namespace {

struct MathOptions : PlanOptions {
  std::string worst_cases;
};

Plan make_plan(const MathOptions& o) {
  PlanRequest request = request_of(o);
  narrow_to_exhaustible(o.subjects, o.types, request);
  WorstCases worst;
  const bool wants_worst = std::ranges::find(request.strata, Stratum::worst) != request.strata.end();
  const std::filesystem::path directory = o.worst_cases.empty() ? "ci/worst_cases" : o.worst_cases;
  if (wants_worst && (!o.worst_cases.empty() || std::filesystem::is_directory(directory))) {
    WorstCaseFile file = read_worst_cases(directory, request);
    request.worst_cases_text = std::move(file.text);
    worst = std::move(file.cases);
  } else if (wants_worst) {
    fmt::print(stderr, "ulpgate: note: no directory {}: no worst cases are replayed\n", directory.string());
  }
  return {std::move(request), worst};
}

// The two oracles must agree wherever no known defect of the family explains the difference.
ExitCode report_oracles(const std::vector<RowRecord>& records) {
  std::uint64_t compared = 0;
  std::uint64_t explained = 0;
  ExitCode code = ExitCode::pass;
  for (const auto& r : records) {
    compared += r.summary.oracle.compared;
    if (r.summary.oracle.disagreed == 0) continue;
    if (known_oracle_defect(*find_function(r.subject), r.type)) {
      explained += r.summary.oracle.disagreed;
      continue;
    }
    code = ExitCode::regression;
    std::string args;
    for (const auto& a : r.points.oracle_argmax) args += " " + a;
    fmt::print(stderr,
               "ulpgate: the oracles disagree: {} {} {} {}: RealHP<4> and MPFR differ by up to {:.3g} ULP of "
               "the type in {} "
               "of {} samples, most at{}\n",
               r.subject, r.part, r.type, r.stratum, r.summary.oracle.difference.value,
               r.summary.oracle.disagreed, r.summary.oracle.compared, args);
  }
  fmt::print(stderr, "ulpgate: oracles compared on {} results; {} differ by known defects of a RealHP<4>\n",
             compared, explained);
  return code;
}

// The largest errors of all floats: no other argument exists.
void report_proofs(const std::vector<RowRecord>& records) {
  for (const auto& r : records) {
    if (!is_proof(r)) continue;
    fmt::print(stderr,
               "ulpgate: proof for this libm: over all 2^32 floats {} is off by at most {} ULP, at {}; {} "
               "mismatches\n",
               r.subject, r.summary.max_error.value, fmt::join(r.points.argmax, " "), r.summary.mismatches());
  }
}

void report_stages(const RunResult& result) {
  std::uint64_t all = 0;
  for (const auto n : result.decided) all += n;
  if (all == 0) return;
  std::string text;
  for (std::size_t s = 0; s < stage_count; ++s) {
    if (result.decided[s] == 0) continue;
    text += fmt::format("{}{} {:.3g} %", text.empty() ? "" : ", ", stage_names[s],
                        100.0 * static_cast<double>(result.decided[s]) / static_cast<double>(all));
  }
  fmt::print(stderr, "ulpgate: decided by the stages of the reference: {} of {} samples\n", text, all);
}

// What its authors promise of a code is broken by any larger error: no budget allows for that.
ExitCode report_claims(const std::vector<RowRecord>& records) {
  ExitCode code = ExitCode::pass;
  for (const auto& r : records) {
    const auto claim = find_subject(r.subject, r.type)->info().claimed_ulp;
    if (!claim || r.summary.judged() == 0 || r.summary.max_error.value <= *claim) continue;
    code = ExitCode::regression;
    fmt::print(
        stderr,
        "ulpgate: {} {} of {} is claimed to be off by at most {} ULP and is off by {}: ulpgate at {} {} "
        "{}\n",
        r.subject, r.type, r.implementation, *claim, r.summary.max_error.value, r.subject, r.type,
        fmt::join(r.points.argmax, " "));
  }
  return code;
}

ExitCode run_math(const MathOptions& o, Ranks* ranks) {
  return run_and_write(make_plan(o), o, ranks, [](const RunResult& result) {
    report_stages(result);
    report_proofs(result.records);
    return std::max(report_oracles(result.records), report_claims(result.records));
  });
}

}  // namespace

void add_math_command(CLI::App& app, Action& action, const RanksOfJob& ranks) {
  auto* math = app.add_subcommand("math", "Evaluate math functions and judge them against the reference");
  auto o = std::make_shared<MathOptions>();
  o->timing = "auto";
  math->add_option("--functions", o->subjects, "all, real, complex, special or names, comma-separated")
      ->capture_default_str();
  add_plan_options(
      *math, *o,
      "samples of uniform and stratified together (halves where both are chosen); binades gets a "
      "half more");
  math->get_option("--out")->required();
  math->add_option(
          "--reference", o->reference,
          "full: MPFR at the precision of RealHP<4> for every sample; screened: cheaper stages first, "
          "the same records")
      ->capture_default_str()
      ->check(CLI::IsMember({"screened", "full"}));
  math->add_option("--worst-cases", o->worst_cases,
                   "directory of worst cases (default ci/worst_cases, if it exists)");
  math->callback([=, &action] { action = [=] { return run_math(*o, ranks ? ranks() : nullptr); }; });
}

}  // namespace ulpgate::app
