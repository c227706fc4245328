// Budgets as they are measured and updated.
#include "harness/core/gate/budgets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "harness/core/gate/digest.hpp"
#include "harness/core/gate/limits.hpp"

namespace ulpgate {

std::string budget_key(const RowRecord& r) {
  return r.part == "value" ? r.subject : r.subject + "." + r.part;
}

std::vector<OtherCode> other_codes(const std::vector<RowRecord>& records, const Budgets& budgets) {
  std::map<std::array<std::string, 3>, std::set<std::string>> rows;
  for (const RowRecord& r : records) {
    const auto type = budgets.find(r.type);
    if (type == budgets.end()) continue;
    const auto budget = type->second.rows.find(budget_key(r));
    if (budget == type->second.rows.end()) continue;
    const std::string& then = budget->second.implementation;
    if (!then.empty() && then != r.implementation)
      rows[{r.type, then, r.implementation}].insert(budget->first);
  }
  std::vector<OtherCode> found;
  found.reserve(rows.size());
  for (const auto& [key, names] : rows) found.push_back({key[0], key[1], key[2], names.size()});
  return found;
}

void forget_digests(Budgets& budgets) {
  for (auto& [token, type] : budgets)
    for (auto& [row, budget] : type.rows) budget.digest.clear();
}

namespace {

void measure_row(const RowRecord& r, Budget& budget) {
  const Summary& s = r.summary;
  const auto stratum = find_stratum(r.stratum);
  budget.implementation = r.implementation;
  budget.samples[r.stratum] = r.planned;
  for (const auto& column : limit_columns()) {
    double figure = column.figure(s);
    // Of a row without a judged result, of which only outcomes can be asked for.
    if (s.judged() == 0) figure = 0;
    // Beyond measure, which is counted below.
    if (!std::isfinite(figure)) continue;
    // A percentile is the edge of a bucket.
    (budget.*column.limits)[r.stratum] = column.limits == &Budget::p99_ulp ? figure : round_up(figure);
  }
  const auto p99 = budget.p99_ulp.find(r.stratum);
  if (stratum && is_drawn(*stratum) && p99 != budget.p99_ulp.end() && p99->second > 0)
    budget.winsorized_ulp[r.stratum] = round_up(winsorized_mean(s.histogram, p99->second).mean);
  for (const int e : tail_exponents) {
    if (const std::uint64_t n = count_above(s.histogram, e); n > 0) budget.above[r.stratum][e] = n;
  }
  for (std::size_t o = 1; o < outcome_count; ++o) {
    if (s.outcomes[o] > 0) budget.mismatch[mismatch_key(r, o)] = s.outcomes[o];
  }
  if (r.subject_class == kernel_class && has_portable_results(r.type))
    budget.digest[r.stratum] = results_digest(r);
}

}  // namespace

Budgets measured_budgets(const std::vector<RowRecord>& records, std::uint64_t samples, std::uint64_t seed) {
  Budgets budgets;
  for (const RowRecord& r : records) {
    TypeBudgets& type = budgets[r.type];
    type.samples = samples;
    type.seed = seed;
    measure_row(r, type.rows[budget_key(r)]);
  }
  return budgets;
}

std::string why_another_plan(const Budgets& present, const std::vector<RowRecord>& records,
                             std::uint64_t samples, std::uint64_t seed) {
  for (const RowRecord& r : records) {
    const auto type = present.find(r.type);
    if (type != present.end() && (type->second.samples != samples || type->second.seed != seed)) {
      return fmt::format(
          "the budgets of {} are of {} samples with seed {}, these records of {} with seed {}; remove the "
          "file to start anew with another plan",
          r.type, type->second.samples, type->second.seed, samples, seed);
    }
    if (type == present.end()) continue;
    const auto row = type->second.rows.find(budget_key(r));
    const auto stratum = find_stratum(r.stratum);
    if (row == type->second.rows.end() || !row->second.knows(r.stratum) || !stratum || !is_drawn(*stratum))
      continue;
    if (!is_of_plan(r, type->second, row->second)) {
      return fmt::format("{} {} {} has {} points of seed {}, its budget {} of seed {}", budget_key(r), r.type,
                         r.stratum, r.planned, r.seed, budgeted_samples(r, type->second, row->second),
                         type->second.seed);
    }
  }
  return "";
}

namespace {

template <class Map>
void note_rise(std::string& what, const Map& before, const Map& after, std::string_view words) {
  for (const auto& [stratum, limit] : after) {
    const auto old = before.find(stratum);
    if (old != before.end() && limit > old->second)
      what += fmt::format(" {} {} {:.4g} -> {:.4g};", stratum, words, static_cast<double>(old->second),
                          static_cast<double>(limit));
  }
}

// A limit of a stratum that was measured again and has none now: its figure is beyond measure.
void note_loss(std::string& what, const std::map<std::string, double>& before,
               const std::map<std::string, double>& after, const Budget& measured, std::string_view words) {
  for (const auto& [stratum, limit] : before) {
    if (measured.samples.contains(stratum) && !after.contains(stratum))
      what += fmt::format(" {} {} {:.4g} -> beyond measure;", stratum, words, limit);
  }
}

// What would become looser from `before` to `after`, as text; empty when nothing would.
std::string rises(const Budget& before, const Budget& after) {
  std::string what;
  for (const auto& column : limit_columns()) {
    note_rise(what, before.*column.limits, after.*column.limits, column.key);
    note_loss(what, before.*column.limits, after.*column.limits, after, column.key);
  }
  for (const auto& bound : bound_columns)
    note_rise(what, before.*bound.limits, after.*bound.limits, bound.key);
  note_rise(what, before.winsorized_ulp, after.winsorized_ulp, "winsorized_ulp");
  for (const auto& [stratum, counts] : after.above) {
    // A stratum that was never counted: its counts appear freely, like its limit.
    if (!before.samples.contains(stratum)) continue;
    const auto old = before.above.find(stratum);
    for (const auto& [e, count] : counts) {
      const std::uint64_t known =
          old != before.above.end() && old->second.contains(e) ? old->second.at(e) : 0;
      if (count > known)
        what += fmt::format(" {} results above 2^{} ULP {} -> {};", stratum, e, known, count);
    }
  }
  for (const auto& [key, count] : after.mismatch) {
    if (!before.knows(key.substr(0, key.find('.')))) continue;
    const auto old = before.mismatch.find(key);
    const std::uint64_t known = old == before.mismatch.end() ? 0 : old->second;
    if (count > known) what += fmt::format(" {} {} -> {};", key, known, count);
  }
  for (const auto& [stratum, count] : after.samples) {
    const auto old = before.samples.find(stratum);
    if (old != before.samples.end() && count < old->second)
      what += fmt::format(" {} samples {} -> {};", stratum, old->second, count);
  }
  if (what.empty()) return what;
  return what.substr(1, what.size() - 2);
}

// Replaces the limits of the strata that `measured` holds.
void replace_strata(Budget& mine, const Budget& measured) {
  for (const auto& [stratum, count] : measured.samples) {
    mine.samples[stratum] = count;
    for (const auto& column : limit_columns()) (mine.*column.limits).erase(stratum);
    mine.winsorized_ulp.erase(stratum);
    mine.above.erase(stratum);
    mine.digest.erase(stratum);
    std::erase_if(mine.mismatch,
                  [&name = stratum](const auto& entry) { return is_of_stratum(entry.first, name); });
  }
  const auto take = [](auto& into, const auto& from) {
    for (const auto& [key, value] : from) into[key] = value;
  };
  for (const auto& column : limit_columns()) take(mine.*column.limits, measured.*column.limits);
  // Bounds stay where no other seeds were measured.
  for (const auto& bound : bound_columns) take(mine.*bound.limits, measured.*bound.limits);
  take(mine.winsorized_ulp, measured.winsorized_ulp);
  take(mine.above, measured.above);
  take(mine.mismatch, measured.mismatch);
  take(mine.digest, measured.digest);
  mine.implementation = measured.implementation;
}

}  // namespace

std::vector<Raise> update_budgets(Budgets& present, const Budgets& measured, const std::string& reason) {
  std::vector<Raise> raises;
  for (const auto& [token, type] : measured) {
    TypeBudgets& mine = present[token];
    mine.samples = type.samples;
    mine.seed = type.seed;
    // Limits of a part measured elsewhere do not move the others.
    // By name: clang 14 captures no structured bindings.
    const bool whole = std::ranges::all_of(
        mine.rows, [&rows = type.rows](const auto& row) { return rows.contains(row.first); });
    if (whole) mine.machine = type.machine;
    for (const auto& [row, budget] : type.rows) {
      Budget& old = mine.rows[row];
      const std::string what = rises(old, budget);
      if (!what.empty()) raises.push_back({token, row, what});
      if (!what.empty() && reason.empty()) continue;
      replace_strata(old, budget);
      if (!what.empty()) old.reason = reason;
    }
  }
  return raises;
}

std::vector<Raise> tighten_budgets(Budgets& present, const std::vector<RowRecord>& records) {
  std::map<std::pair<std::string, std::string>, std::string> lowered;
  for (const RowRecord& r : records) {
    const auto type = present.find(r.type);
    if (type == present.end()) continue;
    const auto row = type->second.rows.find(budget_key(r));
    if (row == type->second.rows.end()) continue;
    Budget& budget = row->second;
    const auto stratum = find_stratum(r.stratum);
    // A list whose worst error fell has lost its cases or got better: nobody but --update decides.
    if (!stratum || !is_drawn(*stratum) || !budget.reason.empty()) continue;
    if (!is_of_plan(r, type->second, budget)) continue;
    for (const auto& column : limit_columns()) {
      auto& limits = budget.*column.limits;
      const auto limit = limits.find(r.stratum);
      const double figure = r.summary.judged() > 0 ? column.figure(r.summary) : 0;
      // Written so that a figure that is no number lowers nothing.
      if (limit == limits.end() || !(figure >= 0) || !(figure < limit->second / ratchet)) continue;
      const double after = column.limits == &Budget::p99_ulp ? figure : round_up(figure);
      lowered[{r.type, row->first}] +=
          fmt::format(" {} {} {:.4g} -> {:.4g};", r.stratum, column.key, limit->second, after);
      limit->second = after;
    }
  }
  std::vector<Raise> changes;
  changes.reserve(lowered.size());
  for (const auto& [key, what] : lowered)
    changes.push_back({key.first, key.second, what.substr(1, what.size() - 2)});
  return changes;
}

}  // namespace ulpgate
