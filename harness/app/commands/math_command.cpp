// ulpgate math: runs functions over strata of arguments and writes records.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <thread>

#include "harness/app/commands/commands.hpp"
#include "harness/app/run/runner.hpp"
#include "harness/app/run/timing.hpp"
#include "harness/app/shell/files.hpp"
#include "harness/app/store/checkpoint.hpp"
#include "harness/app/store/context.hpp"
#include "harness/app/store/worst_cases.hpp"
#include "harness/core/functions/oracle_defects.hpp"

namespace ulpgate::app {

namespace {

struct MathOptions {
  std::string functions = "all";
  std::string types = "all";
  std::string strata = "all";
  std::uint64_t samples = 20000;
  std::uint64_t seed = 1;
  unsigned threads = 0;
  std::string shard = "0/1";
  std::string out;
  std::string reference = "screened";
  std::string worst_cases;
  std::string timing = "auto";
  bool resume = false;
  bool overwrite = false;
  bool json = false;
};

Plan make_plan(const MathOptions& o) {
  PlanRequest request;
  request.functions = select_functions(o.functions);
  request.types = select_types(o.types);
  request.strata = select_strata(o.strata);
  narrow_to_exhaustible(o.functions, o.types, request);
  request.samples = o.samples;
  request.seed = o.seed;
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
  Plan plan(std::move(request), worst);
  if (plan.rows().empty())
    throw Failure(ExitCode::incomplete, "the selection holds no samples: nothing to measure");
  return plan;
}

// The two oracles must agree wherever no known defect of the family explains the difference.
ExitCode report_oracles(const std::vector<RowRecord>& records) {
  std::uint64_t compared = 0;
  std::uint64_t explained = 0;
  ExitCode code = ExitCode::pass;
  for (const auto& r : records) {
    compared += r.summary.oracle.compared;
    if (r.summary.oracle.disagreed == 0) continue;
    if (known_oracle_defect(*find_function(r.function), r.type)) {
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
               r.function, r.part, r.type, r.stratum, r.summary.oracle.difference.value,
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
               r.function, r.summary.max_error.value, fmt::join(r.points.argmax, " "),
               r.summary.mismatches());
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

unsigned threads_of(const MathOptions& o, const Ranks* ranks) {
  if (ranks == nullptr) return o.threads != 0 ? o.threads : std::max(1U, std::thread::hardware_concurrency());
  if (o.threads > 1) throw Failure(ExitCode::bad_input, "--threads: a rank is one thread; start more ranks");
  return 1;
}

ExitCode run_math(const MathOptions& o, Ranks* ranks) {
  const Shard shard = parse_shard(o.shard);
  const Plan plan = make_plan(o);
  const unsigned threads = threads_of(o, ranks);
  const auto mode = o.reference == "full" ? ReferenceMode::full : ReferenceMode::screened;
  const RunIdentity identity{"math", plan.hash(), shard.text(), machine_facts()};
  if (ranks != nullptr && !ranks->writes()) {
    help_plan(plan, shard, mode, identity, *ranks);
    return ExitCode::pass;
  }
  const std::filesystem::path out = o.out;
  make_directory(out);
  if (o.resume && is_finished(out, plan.hash(), shard.text())) {
    fmt::print(stderr, "ulpgate: {} is complete already\n", out.string());
    return report_oracles(read_records(out).records);
  }
  guard_output(out, plan.hash(), o.overwrite);
  Checkpoint checkpoint(out, identity, partial_run(o.resume, o.overwrite));
  RunResult result = run_plan(plan, shard, threads, mode, checkpoint, ranks);
  const std::string text = records_text(result.records);
  write_file(out / math_records_file, text);
  Json context =
      make_context(plan, {shard.text()}, ranks != nullptr ? static_cast<unsigned>(ranks->count()) : threads,
                   result.complete && shard.count == 1);
  context["reference"] = o.reference;
  const bool timed = o.timing == "on" || (o.timing == "auto" && shard.count == 1);
  if (timed && result.complete) write_file(out / "timing.jsonl", timing_text(measure_times(plan.request())));
  write_context(out, context, result.complete);
  if (result.complete) checkpoint.remove();
  if (o.json) fmt::print("{}", text);
  if (!result.complete) {
    throw Failure(ExitCode::incomplete,
                  fmt::format("interrupted; what was done is in {}; --resume goes on", out.string()));
  }
  fmt::print(stderr, "ulpgate: {} records in {}, plan {}\n", result.records.size(),
             (out / math_records_file).string(), plan.hash());
  report_stages(result);
  report_proofs(result.records);
  return report_oracles(result.records);
}

}  // namespace

void add_math_command(CLI::App& app, Action& action, const RanksOfJob& ranks) {
  auto* math = app.add_subcommand("math", "Evaluate math functions and judge them against the reference");
  auto o = std::make_shared<MathOptions>();
  math->add_option("--functions", o->functions, "all, real, complex, special or names, comma-separated")
      ->capture_default_str();
  math->add_option("--types", o->types, "all or tokens, comma-separated")->capture_default_str();
  math->add_option("--strata", o->strata, "all or names, comma-separated")->capture_default_str();
  math->add_option("--samples", o->samples,
                   "samples of uniform and stratified together (halves); binades gets a half more")
      ->capture_default_str()
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 48U));
  math->add_option("--seed", o->seed, "seed of the arguments")->capture_default_str();
  math->add_option("--threads", o->threads, "threads, 0: one a core")
      ->capture_default_str()
      ->check(CLI::Range(0U, 4096U));
  math->add_option("--shard", o->shard, "i/n: the i-th of n parts, 0 <= i < n; `ulpgate merge` joins them")
      ->capture_default_str();
  math->add_option("--out", o->out, "directory of the records")->required();
  math->add_option(
          "--reference", o->reference,
          "full: MPFR at the precision of RealHP<4> for every sample; screened: cheaper stages first, "
          "the same records")
      ->capture_default_str()
      ->check(CLI::IsMember({"screened", "full"}));
  math->add_option("--worst-cases", o->worst_cases,
                   "directory of worst cases (default ci/worst_cases, if it exists)");
  math->add_option("--timing", o->timing, "write timing.jsonl: auto (unless a shard), on, off")
      ->capture_default_str()
      ->check(CLI::IsMember({"auto", "on", "off"}));
  auto* resume = math->add_flag("--resume", o->resume,
                                "go on with a run that was interrupted or killed; a new one starts");
  math->add_flag("--overwrite", o->overwrite, "write over the records of another plan, or a partial run")
      ->excludes(resume);
  math->add_flag("--json", o->json, "print the records as well");
  math->callback([=, &action] { action = [=] { return run_math(*o, ranks ? ranks() : nullptr); }; });
}

}  // namespace ulpgate::app
