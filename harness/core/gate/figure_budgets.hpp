// Budgets of rows that have a few named figures: scenes with their collisions, integrators, stiff and extreme
// cases, error against run time.  One mechanism judges, updates and tightens all of them.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "harness/core/gate/budgets.hpp"

namespace ulpgate {

enum class LimitSense { at_most, at_least };

// A figure that budgets of a kind of row may limit.
struct FigureColumn {
  std::string_view key;    // in budget files and records: "t_s"
  std::string_view words;  // in findings: "true for"
  std::string_view unit;   // empty: none
  LimitSense sense = LimitSense::at_most;
  // A budget stands that many times above what was measured: of a run whose every rounding is fixed it varies
  // only with the C library that made the start.
  double margin = 1.1;
  double allowance = 0;  // what may be lacking of a least value beyond its budget, in the unit
};
// Of the kinds that are not samples.  The figures of one kind, in the order of the files.
[[nodiscard]] std::span<const FigureColumn> figure_columns(RowKind of);

// t_s comes in chunks of 0.05 s: another C library may start a chaotic run from a last digit that differs and
// lose two of them.
inline constexpr double t_s_allowance = 0.1;

// What one run of one row showed.
struct MeasuredRow {
  RowKind of = RowKind::scene;
  std::string name;  // of the budget file: a scene, a problem, a kind of case
  std::string type;
  std::string run;  // what else fixes its numbers: "leapfrog dt=1e-5 steps=1200000 mass=yade"
  // By key of a column.  Not there: not measured; NaN and infinity: beyond every budget.
  std::map<std::string, double> figures{};
  std::string outcome{};    // a word that a budget holds as it is: "stable", "refused"; empty: none
  std::string digest{};     // of the final state, as a text; empty: none was taken
  std::string reproduce{};  // a command
  // What is wrong whatever a budget says, in words; empty: nothing.
  std::string breach{};
  std::string got{}, wanted{};  // of the breach
};

struct FigureBudget {
  std::map<std::string, double> limits;  // finite, by key of a column
  std::string outcome;
  std::string digest;  // empty: the final state may be any
  std::string reason;
  friend bool operator==(const FigureBudget&, const FigureBudget&) = default;
};
// All budgets of one file, by "type run".  The kind of a file is that of its rows.
struct FigureFile {
  RowKind of = RowKind::scene;
  std::map<std::string, FigureBudget> rows;
  friend bool operator==(const FigureFile&, const FigureFile&) = default;
};
using FigureBudgets = std::map<std::string, FigureFile>;  // by name

// As of samples.
void forget_digests(FigureBudgets& budgets);

[[nodiscard]] std::string figure_key(const MeasuredRow& m);

// What is wrong with no budget asked: a collision that makes energy beyond its condition, an order that is
// too low, a verdict that is not as known.
[[nodiscard]] std::vector<GateFinding> breaches(const std::vector<MeasuredRow>& measured);

// Breaches, and what the budgets say.  A NaN is beyond every budget.
[[nodiscard]] std::vector<GateFinding> judge_figures(const std::vector<MeasuredRow>& measured,
                                                     const FigureBudgets& budgets, MissingRecords missing);
[[nodiscard]] std::vector<JudgedRow> judged_rows(const std::vector<MeasuredRow>& measured,
                                                 const FigureBudgets& budgets);

// With the margins of the columns, rounded up to three digits; a least value as it was measured.
[[nodiscard]] FigureBudget measured_figure_budget(const MeasuredRow& m);

// Limits become tighter and rows appear freely; one that would become looser is listed, and changed only with
// a reason.
[[nodiscard]] std::vector<Raise> update_figure_budgets(FigureBudgets& present,
                                                       const std::vector<MeasuredRow>& measured,
                                                       const std::string& reason);
// As tighten_budgets.
[[nodiscard]] std::vector<Raise> tighten_figure_budgets(FigureBudgets& present,
                                                        const std::vector<MeasuredRow>& measured);

}  // namespace ulpgate
