// ulpgate math: runs functions over strata of arguments and writes records.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "harness/app/foreign/foreign_options.hpp"
#include "harness/app/function_commands/function_commands.hpp"
#include "harness/app/run/plan_run.hpp"
#include "harness/app/run/record_verdicts.hpp"
#include "harness/app/store/worst_cases.hpp"
#include "harness/app/terminal/help.hpp"

namespace ulpgate::app {

namespace {

struct MathOptions : PlanOptions {
  std::string worst_cases;
  ForeignOptions foreign;
};

// Puts the functions of libraries in place of this program's.
void bind(MathOptions& o) {
  if (!o.foreign.any()) return;
  if (o.foreign.one() && !o.foreign.list.empty())
    throw Failure(Standing::bad_input, "--implementations names libraries and symbols itself");
  bind_list(o.foreign, o.subjects, o.types);
  if (!o.foreign.one()) return;
  const auto functions = select_subjects(SubjectKind::function, o.subjects);
  const auto types = select_types(o.types);
  if (functions.size() != 1 || types.size() != 1) {
    throw Failure(Standing::bad_input,
                  "--symbol is one function of one type: name them (--functions sin --types double), or give "
                  "a list (--implementations)");
  }
  bind_foreign(o.foreign, functions.front(), types.front());
}

Plan make_plan(const MathOptions& o) {
  PlanRequest request = request_of(o);
  keep_rows_of_named_strata(o.subjects, o.types, request);
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

Verdict run_math(MathOptions o, Ranks* ranks) {
  bind(o);
  return run_and_write(make_plan(o), o, ranks, [](const RunResult& result) {
    report_stages(result);
    report_proofs(result.records);
    Verdict verdict = oracle_verdict(result.records);
    verdict |= claim_verdict(result.records);
    verdict |= foreign_verdict(result.records);
    return verdict;
  });
}

}  // namespace

void add_math_command(CLI::App& app, Action& action, const RanksOfJob& ranks) {
  auto* math = app.add_subcommand("math", "Evaluate math functions and judge them against the reference");
  set_foot(*math,
           {"ulpgate math --functions sin,exp --types float,double --samples 2000 --out out/sin",
            "ulpgate math --functions exp --types double --library libm.so.6 --symbol exp --out out/libm",
            "ulpgate math --functions exp --types double --samples 2000 --shard 0/2 --out out/half0"});
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
  add_foreign_options(*math, o->foreign, true);
  math->callback([=, &action] { action = [=] { return run_math(*o, ranks ? ranks() : nullptr); }; });
}

}  // namespace ulpgate::app
