// ulpgate kernels: runs the DEM kernels over strata of states and writes records.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "harness/app/commands/commands.hpp"
#include "harness/app/run/runner.hpp"
#include "harness/app/run/timing.hpp"
#include "harness/app/shell/crash_report.hpp"
#include "harness/app/shell/files.hpp"
#include "harness/app/store/checkpoint.hpp"
#include "harness/app/store/context.hpp"
#include "harness/core/kernels/kernel_audit.hpp"

namespace ulpgate::app {

namespace {

struct KernelOptions {
  std::string kernels = "all";
  std::string types = "all";
  std::string strata = "all";
  std::uint64_t samples = 1000;
  std::uint64_t seed = 1;
  unsigned threads = 0;
  std::string shard = "0/1";
  std::string out;
  bool timing = false;
  bool resume = false;
  bool overwrite = false;
  bool audit = false;
  bool json = false;
};

std::vector<RowRecord> measure(const KernelPlan& plan, const Shard& shard, unsigned threads,
                               Checkpoint& checkpoint, bool& complete) {
  std::vector<std::unique_ptr<RowHint>> hints;
  for (const auto& row : plan.rows())
    hints.push_back(std::make_unique<RowHint>(static_cast<int>(row.kernel->outputs.size())));
  std::vector<CostModel::Row> costs;
  for (const auto& row : plan.rows()) {
    const auto type =
        static_cast<std::size_t>(std::ranges::find(plan.request().types, row.engine->descriptor().token) -
                                 plan.request().types.begin());
    const auto group = type * dem::all_kernels().size() + static_cast<std::size_t>(row.kernel->id);
    costs.push_back({group, prior_cost(row.engine->descriptor()), 0});
  }
  const UnitJob job{
      "kernels", plan.units(), std::move(costs), [&](const WorkUnit& unit) {
        const KernelRow& row = plan.rows()[unit.row];
        const CrashPlace place(row.kernel->name, row.engine->descriptor().token, name_of(row.source.stratum));
        return row.engine->evaluate(*row.kernel, row.source, unit.first, unit.last, *hints[unit.row]);
      }};
  const UnitSummaries done = run_units(job, shard, threads, checkpoint);
  complete = done.complete;
  std::vector<RowRecord> records;
  for (std::size_t i = 0; i < done.rows.size(); ++i) {
    if (done.rows[i].empty()) continue;
    for (auto& record : finish_kernel_row(plan, plan.rows()[i], done.rows[i]))
      records.push_back(std::move(record));
  }
  return records;
}

void print_unstable(const std::vector<RowRecord>& records) {
  std::size_t unstable = 0;
  for (const auto& r : records) {
    if (is_stable(r.summary)) continue;
    ++unstable;
    fmt::print(stderr, "ulpgate: unstable: {} {} {} {}: {:.3g} roundings beyond its condition\n", r.function,
               r.part, r.type, r.stratum, r.summary.max_error_over_condition);
  }
  fmt::print(stderr, "ulpgate: {} of {} rows are unstable (error over {:g} times condition and roundoff)\n",
             unstable, records.size(), stability_limit);
}

ExitCode run_audit() {
  constexpr std::uint64_t states = 16;
  const auto found = audit_kernels(audited_kernel_table(), states);
  for (const auto& hidden : found)
    fmt::print("{}: the double {} becomes a number of the kernel's type: good to 16 digits only\n",
               hidden.kernel, hidden.literal);
  fmt::print("{} kernels, {} hidden doubles\n", dem::all_kernels().size(), found.size());
  return found.empty() ? ExitCode::pass : ExitCode::regression;
}

ExitCode run_kernels(const KernelOptions& o) {
  if (o.audit) return run_audit();
  if (o.out.empty()) throw Failure(ExitCode::bad_input, "--out DIR is required");
  const Shard shard = parse_shard(o.shard);
  KernelPlanRequest request;
  request.kernels = select_kernels(o.kernels);
  request.types = select_types(o.types);
  request.strata = select_state_strata(o.strata);
  request.samples = o.samples;
  request.seed = o.seed;
  const KernelPlan plan(std::move(request));
  const std::filesystem::path out = o.out;
  make_directory(out);
  if (o.resume && is_finished(out, plan.hash(), shard.text())) {
    fmt::print(stderr, "ulpgate: {} is complete already\n", out.string());
    print_unstable(read_records(out).records);
    return ExitCode::pass;
  }
  guard_output(out, plan.hash(), o.overwrite);
  Checkpoint checkpoint(out, {"kernels", plan.hash(), shard.text(), machine_facts()},
                        partial_run(o.resume, o.overwrite));
  const unsigned threads = o.threads != 0 ? o.threads : std::max(1U, std::thread::hardware_concurrency());
  bool complete = true;
  const auto records = measure(plan, shard, threads, checkpoint, complete);
  const std::string text = records_text(records);
  write_file(out / kernel_records_file, text);
  Json context = make_context(plan, {shard.text()}, threads, complete && shard.count == 1);
  if (o.timing && complete) write_file(out / "timing.jsonl", timing_text(measure_times(plan.request())));
  write_context(out, context, complete);
  if (complete) checkpoint.remove();
  if (o.json) fmt::print("{}", text);
  if (!complete) {
    throw Failure(ExitCode::incomplete,
                  fmt::format("interrupted; what was done is in {}; --resume goes on", out.string()));
  }
  fmt::print(stderr, "ulpgate: {} records in {}, plan {}\n", records.size(),
             (out / kernel_records_file).string(), plan.hash());
  print_unstable(records);
  return ExitCode::pass;
}

}  // namespace

void add_kernels_command(CLI::App& app, Action& action) {
  auto* kernels = app.add_subcommand("kernels", "Evaluate DEM kernels and judge them against RealHP<4>");
  auto o = std::make_shared<KernelOptions>();
  kernels->add_option("--kernels", o->kernels, "all or names, comma-separated")->capture_default_str();
  kernels->add_option("--types", o->types, "all or tokens, comma-separated")->capture_default_str();
  kernels->add_option("--strata", o->strata, "all or names of strata of states, comma-separated")
      ->capture_default_str();
  kernels->add_option("--samples", o->samples, "states of each stratum")
      ->capture_default_str()
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 48U));
  kernels->add_option("--seed", o->seed, "seed of the states")->capture_default_str();
  kernels->add_option("--threads", o->threads, "threads, 0: one a core")
      ->capture_default_str()
      ->check(CLI::Range(0U, 4096U));
  kernels->add_option("--shard", o->shard, "i/n: the i-th of n parts, 0 <= i < n; `ulpgate merge` joins them")
      ->capture_default_str();
  kernels->add_option("--out", o->out, "directory of the records");
  kernels->add_flag("--timing", o->timing, "write timing.jsonl: ns per evaluation of every kernel");
  kernels->add_flag("--audit", o->audit, "name kernels that hold a double literal instead of measuring");
  auto* resume = kernels->add_flag("--resume", o->resume,
                                   "go on with a run that was interrupted or killed; a new one starts");
  kernels->add_flag("--overwrite", o->overwrite, "write over the records of another plan, or a partial run")
      ->excludes(resume);
  kernels->add_flag("--json", o->json, "print the records as well");
  kernels->callback([=, &action] { action = [=] { return run_kernels(*o); }; });
}

}  // namespace ulpgate::app
