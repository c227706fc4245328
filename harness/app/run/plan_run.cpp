// PlanRun.
#include "harness/app/run/plan_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "harness/app/run/timing.hpp"
#include "harness/app/shell/files.hpp"
#include "harness/app/shell/selection.hpp"
#include "harness/app/store/checkpoint.hpp"
#include "harness/app/store/context.hpp"

namespace ulpgate::app {

namespace {

unsigned threads_of(const PlanOptions& o, const Ranks* ranks) {
  if (ranks == nullptr) return o.threads != 0 ? o.threads : std::max(1U, std::thread::hardware_concurrency());
  if (o.threads > 1) throw Failure(ExitCode::bad_input, "--threads: a rank is one thread; start more ranks");
  return 1;
}

}  // namespace

void add_plan_options(CLI::App& verb, PlanOptions& o, const std::string& samples) {
  verb.add_option("--types", o.types, "all or tokens, comma-separated")->capture_default_str();
  verb.add_option("--strata", o.strata, "all or names, comma-separated (`ulpgate list strata`)")
      ->capture_default_str();
  verb.add_option("--samples", o.samples, samples)
      ->capture_default_str()
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 48U));
  verb.add_option("--seed", o.seed, "seed of what is drawn")->capture_default_str();
  verb.add_option("--threads", o.threads, "threads, 0: one a core")
      ->capture_default_str()
      ->check(CLI::Range(0U, 4096U));
  verb.add_option("--shard", o.shard, "i/n: the i-th of n parts, 0 <= i < n; `ulpgate merge` joins them")
      ->capture_default_str();
  verb.add_option("--out", o.out, "directory of the records");
  verb.add_option("--timing", o.timing, "write timing.jsonl: auto (unless a shard), on, off")
      ->capture_default_str()
      ->check(CLI::IsMember({"auto", "on", "off"}));
  auto* resume = verb.add_flag("--resume", o.resume,
                               "go on with a run that was interrupted or killed; a new one starts");
  verb.add_flag("--overwrite", o.overwrite, "write over the records of another plan, or a partial run")
      ->excludes(resume);
  verb.add_flag("--json", o.json, "print the records as well");
}

PlanRequest request_of(const PlanOptions& o) {
  PlanRequest request;
  request.kind = o.kind;
  request.subjects = select_subjects(o.kind, o.subjects);
  request.types = select_types(o.types);
  request.strata = select_strata(o.kind, o.strata);
  request.samples = o.samples;
  request.seed = o.seed;
  return request;
}

ExitCode run_and_write(const Plan& plan, const PlanOptions& o, Ranks* ranks, const PlanVerdict& verdict) {
  if (plan.rows().empty())
    throw Failure(ExitCode::incomplete, "the selection holds no samples: nothing to measure");
  if (o.out.empty()) throw Failure(ExitCode::bad_input, "--out DIR is required");
  const bool functions = o.kind == SubjectKind::function;
  const char* file = functions ? math_records_file : kernel_records_file;
  const Shard shard = parse_shard(o.shard);
  const unsigned threads = threads_of(o, ranks);
  const auto mode = o.reference == "full" ? ReferenceMode::full : ReferenceMode::screened;
  const RunIdentity identity{functions ? "math" : "kernels", plan.hash(), shard.text(), machine_facts()};
  if (ranks != nullptr && !ranks->writes()) {
    help_plan(plan, shard, mode, identity, *ranks);
    return ExitCode::pass;
  }
  const std::filesystem::path out = o.out;
  make_directory(out);
  if (o.resume && is_finished(out, plan.hash(), shard.text())) {
    fmt::print(stderr, "ulpgate: {} is complete already\n", out.string());
    return verdict({read_records(out).records, true, {}});
  }
  guard_output(out, plan.hash(), o.overwrite);
  Checkpoint checkpoint(out, identity, partial_run(o.resume, o.overwrite));
  const RunResult result = run_plan(plan, shard, threads, mode, checkpoint, ranks);
  const std::string text = records_text(result.records);
  write_file(out / file, text);
  Json context =
      make_context(plan, {shard.text()}, ranks != nullptr ? static_cast<unsigned>(ranks->count()) : threads,
                   result.complete && shard.count == 1);
  if (functions) context["reference"] = o.reference;
  const bool timed = o.timing == "on" || (o.timing == "auto" && shard.count == 1);
  if (timed && result.complete) write_file(out / "timing.jsonl", timing_text(measure_times(plan.request())));
  write_context(out, context, result.complete);
  if (result.complete) checkpoint.remove();
  if (o.json) fmt::print("{}", text);
  if (!result.complete) {
    throw Failure(ExitCode::incomplete,
                  fmt::format("interrupted; what was done is in {}; --resume goes on", out.string()));
  }
  fmt::print(stderr, "ulpgate: {} records in {}, plan {}\n", result.records.size(), (out / file).string(),
             plan.hash());
  return verdict(result);
}

}  // namespace ulpgate::app
