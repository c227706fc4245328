// The judgement of records by budgets.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <tuple>
#include <utility>

#include "harness/core/gate/budgets.hpp"
#include "harness/core/gate/digest.hpp"
#include "harness/core/gate/findings/reproducer.hpp"
#include "harness/core/gate/limits.hpp"
#include "harness/core/verdict/verdict.hpp"

namespace ulpgate {

namespace {

RowKind kind_of(const RowRecord& r) {
  return r.subject_class == kernel_class ? RowKind::kernel : RowKind::function;
}

// What came out and what should have, of a result that no error in ULP describes.
std::pair<std::string, std::string> words_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::nan:
      return {"NaN", "a value"};
    case Outcome::not_nan:
      return {"a value", "NaN"};
    case Outcome::inf:
      return {"a number or the other infinity", "an infinity"};
    case Outcome::zero_sign:
      return {"a zero of the other sign", "a zero"};
    case Outcome::overflow_spurious:
      return {"an infinity", "a number inside the range"};
    case Outcome::overflow_missed:
      return {"a number", "an infinity, to which the exact value rounds"};
    case Outcome::underflow_spurious:
      return {"zero", "a number more than 1 ULP from it"};
    case Outcome::nonzero_for_zero:
      return {"a number", "zero"};
    default:
      break;
  }
  return {std::string(name_of(outcome)), "a value"};
}

class Judge {
 public:
  Judge(const Budgets& budgets, MissingRecords missing, const OtherPlan& other_plan)
      : budgets_(budgets), missing_(missing), other_plan_(other_plan) {}

  void judge(const RowRecord& r) {
    row_ = budget_key(r);
    kernels_ = r.subject_class == kernel_class;
    const auto plan = budgets_.find(r.type);
    samples_ = plan == budgets_.end() ? r.planned : plan->second.samples;
    measured_.insert({r.type, row_, r.stratum});
    if (measured(r.summary.samples, r.planned) != Standing::pass)
      add(FindingKind::incomplete, r,
          fmt::format("{} of {} samples in {}", r.summary.samples, r.planned, r.stratum));
    const auto type = budgets_.find(r.type);
    const auto row =
        type == budgets_.end() ? decltype(type->second.rows.end())() : type->second.rows.find(row_);
    if (type == budgets_.end() || row == type->second.rows.end() || !row->second.knows(r.stratum)) {
      add(FindingKind::missing_budget, r,
          fmt::format("no budget for {}; write one with --update", r.stratum));
      return;
    }
    const Budget& budget = row->second;
    const auto stratum = find_stratum(r.stratum);
    const bool same = is_of_plan(r, type->second, budget);
    if (!same && stratum && is_drawn(*stratum)) {
      judge_other_plan(r, type->second, budget);
    } else {
      judge_same_points(r, type->second, budget);
    }
  }

  std::vector<GateFinding> take() {
    for (const auto& [token, type] : budgets_) {
      for (const auto& [row, budget] : type.rows) {
        for (const auto& [stratum, limit] : budget.max_ulp) look_for(token, row, stratum);
        for (const auto& [stratum, samples] : budget.samples)
          if (!budget.max_ulp.contains(stratum)) look_for(token, row, stratum);
      }
    }
    sort_findings(findings_);
    return std::move(findings_);
  }

 private:
  // A finding of the row: what an output needs to say where it stands and how it is seen again.
  GateFinding& add(FindingKind kind, const RowRecord& r, std::string message, double severity = 0,
                   std::vector<std::string> at = {}) {
    GateFinding f{kind, r.type, row_, std::move(message), severity, std::move(at)};
    f.of = kind_of(r);
    f.stratum = r.stratum;
    f.budget_file = r.type;
    f.budget_key = row_;
    f.reproduce = row_reproducer(f.of, r.subject, r.type, r.stratum, samples_, r.seed) + r.selection;
    if (!f.at.empty())
      f.again = std::exchange(f.reproduce, point_reproducer(r.subject, r.type, f.at) + r.selection);
    // The record keeps the results of one point, that of the largest error.
    if (!f.at.empty() && f.at == r.points.argmax) {
      f.got = r.points.got;
      f.wanted = r.points.exact;
    }
    return findings_.emplace_back(std::move(f));
  }
  static void set_figures(GateFinding& f, std::string_view what, double measured, double budget) {
    f.what = what;
    f.measured = measured;
    f.budget = budget;
  }

  // The budgeted strata that no record is of.
  void look_for(const std::string& token, const std::string& row, const std::string& stratum) {
    if (missing_ != MissingRecords::fail) return;
    if (!measured_.contains({token, row, stratum})) {
      const TypeBudgets& type = budgets_.at(token);
      const bool of_kernel =
          std::ranges::find(kernel_strata, stratum, &StratumInfo::name) != kernel_strata.end();
      GateFinding f{FindingKind::missing_record, token, row,
                    fmt::format("budgeted but not measured in {}", stratum)};
      f.of = kernels_ && of_kernel ? RowKind::kernel : RowKind::function;
      f.stratum = stratum;
      f.budget_file = token;
      f.budget_key = row;
      f.reproduce =
          row_reproducer(f.of, row.substr(0, row.find('.')), token, stratum, type.samples, type.seed);
      findings_.push_back(std::move(f));
    }
  }

  // Limits of drawn strata that are far above what was measured.  A smaller run says nothing of them, and a
  // list whose worst error fell may have lost its cases.
  void note_slack(const RowRecord& r, const Budget& budget) {
    std::string what;
    std::optional<std::pair<double, double>> first;
    for (const auto& column : limit_columns()) {
      const auto& limits = budget.*column.limits;
      const auto limit = limits.find(r.stratum);
      const double figure = r.summary.judged() > 0 ? column.figure(r.summary) : 0;
      if (limit == limits.end() || !(figure >= 0) || !(figure < limit->second / ratchet)) continue;
      if (!first) first = {figure, limit->second};
      what += fmt::format(" {} {:.4g}, budget {:.4g};", column.key, figure, limit->second);
    }
    if (!first) return;
    what.back() = ':';
    GateFinding& f = add(FindingKind::could_lower, r,
                         fmt::format("measured in {}{} {}", r.stratum, what,
                                     budget.reason.empty() ? "can be lowered (--tighten)"
                                                           : "was raised for a reason, --update lowers it"));
    set_figures(f, "budget above twice the measured", first->first, first->second);
  }

  void judge_limit(const RowRecord& r, std::string_view words, double figure, double limit,
                   std::string_view limit_words) {
    const Summary& s = r.summary;
    // Nothing stands for no figure where results were judged.
    if (figure < 0) {
      add(FindingKind::incomplete, r,
          fmt::format("no {} of {} judged results in {}", words, s.judged(), r.stratum));
    } else if (at_most(figure, limit) != Standing::pass) {
      const bool normwise = r.subject_class == kernel_class && words.starts_with("error over");
      GateFinding& f =
          add(FindingKind::regression, r,
              fmt::format("{} {:.6g}, {} {:.6g} ({})", words, figure, limit_words, limit, r.stratum),
              figure / std::max(limit, 1e-300), normwise ? r.points.normwise_argmax : r.points.argmax);
      set_figures(f, words, figure, limit);
    }
  }

  void judge_mismatches(const RowRecord& r, const TypeBudgets& type, const Budget& budget, bool same) {
    const Summary& s = r.summary;
    for (std::size_t o = 1; o < outcome_count; ++o) {
      if (s.outcomes[o] == 0) continue;
      const auto it = budget.mismatch.find(mismatch_key(r, o));
      std::uint64_t allowed = it == budget.mismatch.end() ? 0 : it->second;
      // A class that was never seen is none that another seed may show.
      if (!same && allowed > 0)
        allowed = allowed_count(allowed, budgeted_samples(r, type, budget), s.samples);
      if (s.outcomes[o] <= allowed) continue;
      const auto first = r.points.first_mismatch.find(static_cast<Outcome>(o));
      GateFinding& f =
          add(FindingKind::regression, r,
              fmt::format("{} results of class {} in {}, budget {}", s.outcomes[o], outcome_names[o],
                          r.stratum, allowed),
              HUGE_VAL, first == r.points.first_mismatch.end() ? std::vector<std::string>{} : first->second);
      set_figures(f, fmt::format("results of class {}", outcome_names[o]), static_cast<double>(s.outcomes[o]),
                  static_cast<double>(allowed));
      // Of this point the record keeps the class alone.
      std::tie(f.got, f.wanted) = words_of(static_cast<Outcome>(o));
    }
  }

  // Points that the budget was measured at: every figure has its limit.
  void judge_same_points(const RowRecord& r, const TypeBudgets& type, const Budget& budget) {
    const Summary& s = r.summary;
    if (s.judged() > 0) {
      for (const auto& column : limit_columns()) {
        const auto& limits = budget.*column.limits;
        const auto limit = limits.find(r.stratum);
        // Beyond measure, which the counts above powers of two are for.
        if (limit != limits.end()) judge_limit(r, column.words, column.figure(s), limit->second, "budget");
      }
      if (budget.samples.contains(r.stratum)) judge_tail(r, budget);
    }
    judge_mismatches(r, type, budget, true);
    judge_digest(r, budget);
    const auto stratum = find_stratum(r.stratum);
    if (stratum && !is_drawn(*stratum)) {
      judge_list(r, budget);
    } else if (missing_ == MissingRecords::fail) {
      note_slack(r, budget);
    }
  }

  // One finding names all strata of a row.
  void judge_digest(const RowRecord& r, const Budget& budget) {
    const auto digest = budget.digest.find(r.stratum);
    if (digest == budget.digest.end() || digest->second == results_digest(r)) return;
    const auto [known, first] = other_results_.try_emplace({r.type, row_}, findings_.size());
    if (first) {
      add(FindingKind::other_results, r,
          "not the results that the budget was made of (--update where that is meant), in " + r.stratum);
    } else {
      findings_[known->second].message += ", " + r.stratum;
    }
  }

  // Every exponent: a count that the budget does not name is 0.
  void judge_tail(const RowRecord& r, const Budget& budget) {
    const auto tail = budget.above.find(r.stratum);
    for (const int e : tail_exponents) {
      std::uint64_t allowed = 0;
      if (tail != budget.above.end()) {
        const auto it = tail->second.find(e);
        if (it != tail->second.end()) allowed = it->second;
      }
      const std::uint64_t n = count_above(r.summary.histogram, e);
      if (n <= allowed) continue;
      GateFinding& f = add(
          FindingKind::regression, r,
          fmt::format("{} results err by more than 2^{} ULP in {}, budget {}", n, e, r.stratum, allowed),
          static_cast<double>(n) / static_cast<double>(std::max<std::uint64_t>(allowed, 1)), r.points.argmax);
      set_figures(f, fmt::format("results above 2^{} ULP", e), static_cast<double>(n),
                  static_cast<double>(allowed));
    }
  }

  // Losing the hard cases must not pass as an improvement.
  void judge_list(const RowRecord& r, const Budget& budget) {
    const auto then = budget.samples.find(r.stratum);
    if (then != budget.samples.end() && r.planned < then->second) {
      add(FindingKind::lost_cases, r,
          fmt::format(
              "{} arguments in {}, {} when its budget was measured: some were lost; if that is right, "
              "write the budget anew with --update --reason",
              r.planned, r.stratum, then->second));
    }
    // What a limit was raised for need not show here: the processor of another machine, say.
    const auto limit = budget.max_ulp.find(r.stratum);
    if (limit == budget.max_ulp.end() || !budget.reason.empty()) return;
    const double found = r.summary.judged() > 0 ? r.summary.max_error.value : 0;
    if (found >= 0 && found < limit->second / ratchet) {
      add(FindingKind::lost_cases, r,
          fmt::format(
              "measured {:.4g} ULP in {}, budget {:.4g}: were its worst cases lost?  If they are better "
              "now, lower the budget with --update",
              found, r.stratum, limit->second));
    }
  }

  void judge_other_plan(const RowRecord& r, const TypeBudgets& type, const Budget& budget) {
    const std::uint64_t then = budgeted_samples(r, type, budget);
    if (!other_plan_.accepted) {
      add(FindingKind::another_plan, r,
          fmt::format("{} points of seed {} in {}, the budget is of {} of seed {}: give --other-plan to hold "
                      "them to what no seed exceeds",
                      r.planned, r.seed, r.stratum, then, type.seed));
      return;
    }
    const Summary& s = r.summary;
    // A tenth, rounded up: nothing is judged by nothing.
    if (s.samples < other_plan_.least_samples.value_or((then + 9) / 10)) {
      add(FindingKind::incomplete, r,
          fmt::format("{} points in {} are too few to be judged by a budget of {}", s.samples, r.stratum,
                      then));
    }
    const bool part = is_part_of_plan(r, type, budget);
    judge_mismatches(r, type, budget, part);
    if (s.judged() == 0) return;
    if (part && budget.samples.contains(r.stratum)) judge_tail(r, budget);
    for (const auto& column : limit_columns()) {
      if (column.bounds == nullptr) continue;
      // More points meet what no seed of the budget's size did; the error has its row's largest bound.
      if (!kernels_ && column.limits == &Budget::over_condition && s.samples > then) continue;
      // Maxima of some of the budget's points are no larger than of all.
      const auto& bounds = budget.*(part ? column.limits : column.bounds);
      const auto bound = bounds.find(r.stratum);
      if (bound != bounds.end()) {
        judge_limit(r, column.words, column.figure(s), bound->second, part ? "budget" : "no seed exceeds");
      } else if (!part && column.limits == &Budget::max_ulp && budget.max_ulp.contains(r.stratum)) {
        add(FindingKind::missing_budget, r,
            fmt::format("no bound_ulp for another plan in {}; write one with --update --seeds", r.stratum));
      }
    }
    judge_other_tail(r, budget, then);
  }

  // The distribution of the errors against the budget's, each with what chance allows.
  void judge_other_tail(const RowRecord& r, const Budget& budget, std::uint64_t then) {
    const UlpHistogram& histogram = r.summary.histogram;
    const std::uint64_t n = r.summary.judged();
    if (const auto tail = budget.above.find(r.stratum); tail != budget.above.end()) {
      for (const auto& [e, count] : tail->second) {
        judge_count(r, count_above(histogram, e), allowed_count(count, then, n), fmt::format("2^{}", e));
      }
    }
    const auto p99 = budget.p99_ulp.find(r.stratum);
    if (p99 == budget.p99_ulp.end()) return;
    judge_count(r, count_above_edge(histogram, p99->second), allowed_count((then + 99) / 100, then, n),
                fmt::format("{:.4g}", p99->second));
    const auto mean = budget.winsorized_ulp.find(r.stratum);
    if (mean == budget.winsorized_ulp.end()) return;
    const WinsorizedMean now = winsorized_mean(histogram, p99->second);
    const double limit = mean->second + mean_allowance(now.variance, p99->second, n, then);
    if (at_most(now.mean, limit) == Standing::pass) return;
    GateFinding& f =
        add(FindingKind::regression, r,
            fmt::format("winsorized mean error {:.4g} ULP in {}, budget {:.4g} and {:.4g} by chance",
                        now.mean, r.stratum, mean->second, limit - mean->second),
            now.mean / std::max(limit, 1e-300), r.points.argmax);
    set_figures(f, "winsorized mean error in ULP", now.mean, limit);
  }

  void judge_count(const RowRecord& r, std::uint64_t n, std::uint64_t allowed, const std::string& edge) {
    if (n <= allowed) return;
    GateFinding& f =
        add(FindingKind::regression, r,
            fmt::format(
                "{} of {} results err by more than {} ULP in {}, by the budget and chance no more than {}", n,
                r.summary.judged(), edge, r.stratum, allowed),
            static_cast<double>(n) / static_cast<double>(allowed), r.points.argmax);
    set_figures(f, fmt::format("results above {} ULP", edge), static_cast<double>(n),
                static_cast<double>(allowed));
  }

  const Budgets& budgets_;
  MissingRecords missing_;
  OtherPlan other_plan_;
  std::string row_;
  std::uint64_t samples_ = 0;                      // of the plan of the budgets
  bool kernels_ = false;                           // the records are of kernels
  std::set<std::array<std::string, 3>> measured_;  // by type, row, stratum
  std::vector<GateFinding> findings_;
  std::map<std::pair<std::string, std::string>, std::size_t> other_results_;  // by type and row, of findings_
};

}  // namespace

std::vector<JudgedRow> judged_rows(const std::vector<RowRecord>& records, const Budgets& budgets) {
  std::vector<JudgedRow> rows;
  for (const RowRecord& r : records) {
    JudgedRow& row =
        rows.emplace_back(JudgedRow{kind_of(r), r.type, budget_key(r), r.stratum, "max_ulp", {}, {}, {}});
    const Summary& s = r.summary;
    if (s.judged() > 0 && s.max_error.value >= 0) row.measured = s.max_error.value;
    const auto type = budgets.find(r.type);
    if (type == budgets.end()) continue;
    const auto found = type->second.rows.find(row.row);
    if (found == type->second.rows.end()) continue;
    const bool same = is_of_plan(r, type->second, found->second);
    for (const auto& column : limit_columns()) {
      if (!same && column.bounds == nullptr) continue;
      const auto& limits = found->second.*(same ? column.limits : column.bounds);
      const auto limit = limits.find(r.stratum);
      if (limit == limits.end()) continue;
      if (column.limits == &Budget::max_ulp) row.budget = limit->second;
      const double figure = column.figure(s);
      if (s.judged() > 0 && figure >= 0)
        row.ratio = std::max(row.ratio.value_or(0), budget_ratio(figure, limit->second));
    }
  }
  return rows;
}

std::vector<GateFinding> judge_records(const std::vector<RowRecord>& records, const Budgets& budgets,
                                       MissingRecords missing, const OtherPlan& other_plan) {
  Judge judge(budgets, missing, other_plan);
  for (const RowRecord& r : records) judge.judge(r);
  return judge.take();
}

}  // namespace ulpgate
