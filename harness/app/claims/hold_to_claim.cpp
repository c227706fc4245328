// hold_to_claim(): one function against its claim.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <thread>

#include "harness/app/claims/claim.hpp"
#include "harness/app/run/plan_run.hpp"
#include "harness/app/search/search_round.hpp"
#include "harness/app/shell/files.hpp"
#include "harness/app/shell/interrupt.hpp"
#include "harness/app/shell/selection.hpp"
#include "harness/core/search/function_search.hpp"
#include "reference/functions/function_info.hpp"

namespace ulpgate::app {

namespace {

using Clock = std::chrono::steady_clock;
constexpr const char* search_file = "search.json";
constexpr double beyond_any = std::numeric_limits<double>::infinity();

std::filesystem::path path_of(const ListedFunction& row, const ClaimOptions& o) {
  return std::filesystem::path(o.out) / directory_of(row);
}

unsigned threads_of(const ClaimOptions& o) {
  return o.threads != 0 ? o.threads : std::max(1U, std::thread::hardware_concurrency());
}

void add_error(ClaimFound& found, double ulp, const std::string& where,
               const std::vector<std::string>& args) {
  if (!(ulp > found.largest_ulp)) return;
  found.largest_ulp = ulp;
  found.where = where;
  found.args = args;
}

void add_mismatch(ClaimFound& found, std::string_view outcome, std::uint64_t count,
                  const std::vector<std::string>& args) {
  const auto it = std::ranges::find(found.mismatches, outcome, &ClaimFound::Mismatch::outcome);
  if (it != found.mismatches.end()) {
    it->count += count;
  } else {
    found.mismatches.push_back({std::string(outcome), count, args, beyond_any});
  }
}

void add_records(const std::vector<RowRecord>& records, ClaimFound& found) {
  for (const auto& r : records) {
    found.arguments += r.summary.samples;
    if (r.summary.judged() > 0) add_error(found, r.summary.max_error.value, r.stratum, r.points.argmax);
    for (std::size_t i = 1; i < outcome_count; ++i)
      if (r.summary.outcomes[i] != 0)
        add_mismatch(found, outcome_names[i], r.summary.outcomes[i],
                     r.points.first_mismatch.at(static_cast<Outcome>(i)));
  }
}

// What a zero for the exact value at these arguments errs by, in units of the smallest number.
double error_of_zero(const FunctionInfo& f, const RealDescriptor& type,
                     const std::vector<std::string>& args) {
  const WideExponentRange wide;
  MpfrValue y = exact_at(f, type, args);
  mpfr_mul_2si(y.get(), y, type.format.precision - 1 - type.format.exponent_min, MPFR_RNDN);
  return std::fabs(mpfr_get_d(y, MPFR_RNDN));
}

void size_mismatches(const FunctionInfo& f, const Subject& subject, ClaimFound& found) {
  for (auto& m : found.mismatches) {
    if (m.outcome == name_of(Outcome::lane_dependent)) m.error_ulp = 0;
    if (m.outcome != name_of(Outcome::underflow_spurious) && m.outcome != name_of(Outcome::zero_sign))
      continue;
    // The sign of a zero that stands for a number is part of its error; that of an exact zero is no number of
    // units.
    if (const double error = error_of_zero(f, subject.type(), m.args); error > 0) m.error_ulp = error;
  }
}

void measure_strata(const ListedFunction& row, const ClaimOptions& o, ClaimFound& found) {
  PlanOptions p;
  p.subjects = row.function;
  p.types = row.type;
  p.samples = o.samples;
  p.seed = o.seed;
  p.threads = o.threads;
  p.out = path_of(row, o).string();
  p.resume = !o.overwrite;
  p.overwrite = o.overwrite;
  p.allow_large = true;
  PlanRequest request = request_of(p);
  const Subject* subject = find_subject(row.function, row.type);
  if (o.exhaustive && subject->can_exhaust()) request.strata.push_back(Stratum::exhaustive);
  const auto take = [&](const RunResult& result) -> Verdict {
    add_records(result.records, found);
    return Standing::pass;
  };
  static_cast<void>(run_and_write({std::move(request), {}}, p, nullptr, take));
}

Json searched(const Subject& subject, const ClaimOptions& o) {
  const InterruptGuard guard;
  const auto search = make_search(subject, o.seed);
  while (search->evaluations() < o.evaluations) {
    if (interrupted()) throw Failure(Standing::incomplete, "interrupted; --resume goes on");
    if (!run_round(*search, o.evaluations - search->evaluations(), threads_of(o), subject)) break;
  }
  Json mismatches = Json::array();
  for (const auto& [outcome, m] : search->mismatches())
    mismatches.push_back(
        {{"outcome", name_of(outcome)}, {"count", m.confirmed}, {"args", subject.point(m.args).args_hex}});
  const SearchBest best = search->best();
  return {{"seed", o.seed},
          {"evaluations", search->evaluations()},
          {"asked", o.evaluations},
          {"code", subject.info().code_facts},
          {"selection", subject.info().selection},
          {"ulp", best.args.empty() ? -1 : best.error_ulp},
          {"args", best.args.empty() ? std::vector<std::string>{} : subject.point(best.args).args_hex},
          {"mismatches", mismatches}};
}

void search_worst(const ListedFunction& row, const Subject& subject, const ClaimOptions& o,
                  ClaimFound& found) {
  if (o.evaluations == 0 || !can_search(subject)) return;
  const auto file = path_of(row, o) / search_file;
  Json result;
  if (!o.overwrite && std::filesystem::exists(file)) {
    result = Json::parse(read_file(file), nullptr, false);
    const bool same = result.is_object() && result.value("seed", Json()) == o.seed &&
                      result.value("asked", Json()) == o.evaluations &&
                      result.value("code", Json()) == Json(subject.info().code_facts) &&
                      result.value("selection", Json()) == subject.info().selection;
    if (!same) result = Json();
  }
  if (result.is_null()) {
    result = searched(subject, o);
    write_file(file, result.dump(2) + "\n");
  }
  found.arguments += result.at("evaluations").get<std::uint64_t>();
  add_error(found, result.at("ulp").get<double>(), "search",
            result.at("args").get<std::vector<std::string>>());
  for (const auto& m : result.at("mismatches")) {
    const auto outcome = m.at("outcome").get<std::string>();
    if (std::ranges::find(found.mismatches, outcome, &ClaimFound::Mismatch::outcome) ==
        found.mismatches.end())
      found.mismatches.push_back({outcome, m.at("count"), m.at("args"), beyond_any});
  }
}

// The strata and the search are those of the whole function: of a narrow domain they may see nothing.
void judge_within_domain(const ListedFunction& row, const Subject& subject, ClaimFound& found) {
  if (row.claim.domain.empty()) return;
  for (const auto& words : found.sample->args) {
    const Point point = subject.point(values_of(subject.type(), split(words, ' ')));
    const Judgement& j = point.parts.front().judgement;
    ++found.arguments;
    if (j.outcome == Outcome::finite) {
      add_error(found, recorded(j.error).value, "domain", point.args_hex);
    } else {
      add_mismatch(found, name_of(j.outcome), 1, point.args_hex);
    }
  }
}

}  // namespace

std::string directory_of(const ListedFunction& row) {
  std::string name = fmt::format("{}-{}-{}", row.function, row.type, row.spec.symbol);
  // One symbol may have claims on several domains.
  for (const auto& [low, high] : row.claim.domain) name += fmt::format("-{}_{}", low, high);
  for (auto& c : name)
    if (c == '/') c = '_';
  return name;
}

ClaimFound hold_to_claim(const ListedFunction& row, const BoundFunction& bound, const ClaimOptions& o) {
  const auto start = Clock::now();
  const FunctionInfo& f = function_or_fail(row.function);
  ClaimFound found;
  found.implementation = bound.subject->info().implementation;
  measure_strata(row, o, found);
  search_worst(row, *bound.subject, o, found);
  found.sample = sampled_results(*bound.code, f, bound.element, row.claim, o.seed);
  judge_within_domain(row, *bound.subject, found);
  size_mismatches(f, *bound.subject, found);
  found.properties = broken_properties(*bound.code, f, bound.element, row.claim, o.seed);
  found.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return found;
}

}  // namespace ulpgate::app
