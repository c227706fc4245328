// PlanRun.
#include "harness/app/run/plan_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "harness/app/machine/machine_facts.hpp"
#include "harness/app/run/resume_options.hpp"
#include "harness/app/run/timing.hpp"
#include "harness/app/shell/files.hpp"
#include "harness/app/shell/selection.hpp"
#include "harness/app/store/checkpoint.hpp"
#include "harness/app/store/context.hpp"

namespace ulpgate::app {

namespace {

unsigned threads_of(const PlanOptions& o, const Ranks* ranks) {
  if (ranks == nullptr) return o.threads != 0 ? o.threads : std::max(1U, std::thread::hardware_concurrency());
  if (o.threads > 1) throw Failure(Standing::bad_input, "--threads: a rank is one thread; start more ranks");
  return 1;
}

// What the units of a plan take in memory, in bytes: each in the plan, in the queue and in the checkpoint.
double bytes_of_units(const PlanRequest& request) {
  constexpr double bytes_a_unit = 100;
  double units = 0;
  for (const Stratum s : request.strata) {
    if (!is_drawn(s)) continue;
    const auto count = static_cast<double>(drawn_count(request.kind, s, request.samples, request.strata));
    units += std::ceil(count / static_cast<double>(unit_size_of(s)));
  }
  return units * static_cast<double>(request.subjects.size() * request.types.size()) * bytes_a_unit;
}

// A plan that no memory holds is refused before any is asked for.
void refuse_large(const PlanRequest& request) {
  constexpr double most_gb = 4;
  const double gb = bytes_of_units(request) / 1e9;
  if (gb <= most_gb) return;
  throw Failure(
      Standing::bad_input,
      fmt::format("--samples {}: the units of this plan alone need {:.3g} GB of memory, more than {:g} GB; "
                  "--shard does not divide that; --allow-large tries it",
                  request.samples, gb, most_gb));
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
  verb.add_option(
          "--timing", o.timing,
          "write timing.jsonl: auto (unless a shard), on, off; repeats: timing_repeats.jsonl as well, for "
          "`ulpgate compare` and `ulpgate history`")
      ->capture_default_str()
      ->check(CLI::IsMember({"auto", "on", "off", "repeats"}));
  verb.add_option("--timing-processes", o.timing_processes,
                  "with --timing repeats: processes, one after the other")
      ->capture_default_str()
      ->check(CLI::Range(1U, 1000U));
  verb.add_option("--timing-rounds", o.timing_rounds,
                  "with --timing repeats: rounds over all rows in each process")
      ->capture_default_str()
      ->check(CLI::Range(1U, 1000U));
  // What such a process is started with; of no use to people.
  verb.add_option("--time-rounds", o.time_rounds)->group("")->check(CLI::Range(1U, 1000U));
  add_resume_options(verb, o.resume, o.overwrite);
  verb.add_flag("--allow-large", o.allow_large, "run a plan whose units need more than 4 GB of memory");
  verb.add_flag("--dry-run", o.dry_run,
                "print the plan's hash, rows, points and units as JSON, and measure nothing");
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
  if (!o.allow_large) refuse_large(request);
  return request;
}

namespace {

Verdict print_plan(const Plan& plan) {
  std::uint64_t points = 0;
  for (const auto& unit : plan.units()) points += unit.last - unit.first;
  const Json j = {{"plan", plan.hash()},
                  {"rows", plan.rows().size()},
                  {"points", points},
                  {"units", plan.units().size()}};
  fmt::print("{}\n", j.dump());
  return Standing::pass;
}

void write_times(const PlanRequest& request, const PlanOptions& o, const Shard& shard,
                 const OutputDirectory& out) {
  std::vector<TimingRecord> times;
  if (o.timing == "repeats") {
    const auto rows = time_in_processes(request, o.timing_processes, o.timing_rounds);
    for (const auto& row : rows) times.push_back(row.record);
    out.write(timing_repeats_file, repeats_text(rows));
  } else if (o.timing == "on" || (o.timing == "auto" && shard.count == 1)) {
    times = measure_times(request);
  } else {
    return;
  }
  out.write(timing_file, timing_text(times));
}

}  // namespace

Verdict run_and_write(const Plan& plan, const PlanOptions& o, Ranks* ranks, const PlanVerdict& verdict) {
  if (plan.rows().empty())
    throw Failure(Standing::incomplete, "the selection holds no samples: nothing to measure");
  if (o.time_rounds != 0) {
    fmt::print("{}", repeats_text(time_in_rounds(plan.request(), o.time_rounds)));
    return Standing::pass;
  }
  if (o.out.empty()) throw Failure(Standing::bad_input, "--out DIR is required");
  if (o.timing == "repeats" && ranks != nullptr)
    throw Failure(Standing::bad_input,
                  "--timing repeats: a rank starts no other processes; time with ulpgate");
  if (o.dry_run) return print_plan(plan);
  const bool functions = o.kind == SubjectKind::function;
  const char* file = functions ? math_records_file : kernel_records_file;
  const Shard shard = parse_shard(o.shard);
  const unsigned threads = threads_of(o, ranks);
  const auto mode = o.reference == "full" ? ReferenceMode::full : ReferenceMode::screened;
  const RunIdentity identity{
      functions ? "math" : "kernels", plan.hash(), {shard.text()}, "", machine_facts()};
  if (ranks != nullptr && !ranks->writes()) {
    help_plan(plan, shard, mode, identity, *ranks);
    return Standing::pass;
  }
  const OutputDirectory out(o.out, identity, partial_run(o.resume, o.overwrite));
  if (o.resume && out.is_finished()) {
    RecordSet set = read_finished_records(out.path(), plan);
    fmt::print(stderr, "ulpgate: {} is complete already\n", o.out);
    return verdict({std::move(set.records), true, {}});
  }
  if (shard.index >= plan.units().size()) {
    throw Failure(Standing::nothing_measured,
                  fmt::format("--shard {}: nothing to measure: the plan has {} units, shards from {} on none",
                              shard.text(), plan.units().size(), plan.units().size()));
  }
  const auto used_threads = ranks != nullptr ? static_cast<unsigned>(ranks->count()) : threads;
  Json context = make_context(plan, {shard.text()}, used_threads, false);
  if (functions) context["reference"] = o.reference;
  Checkpoint checkpoint(out);
  out.begin(context);
  const RunResult result = run_plan(plan, shard, threads, mode, checkpoint, ranks);
  const std::string text = records_text(result.records);
  out.write(file, text);
  if (result.complete) write_times(plan.request(), o, shard, out);
  context["complete"] = result.complete && shard.count == 1;
  out.finish(context, result.complete);
  if (result.complete) checkpoint.remove();
  if (o.json) fmt::print("{}", text);
  if (!result.complete) {
    throw Failure(Standing::incomplete,
                  fmt::format("interrupted; what was done is in {}; --resume goes on", o.out));
  }
  fmt::print(stderr, "ulpgate: {} records in {}, plan {}\n", result.records.size(),
             (out.path() / file).string(), plan.hash());
  return verdict(result);
}

}  // namespace ulpgate::app
