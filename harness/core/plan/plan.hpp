// Plan: everything that fixes a run's numbers, its rows and work units, and the hash that stands in every
// record.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "harness/core/records/row_record.hpp"
#include "harness/core/subject/subject.hpp"

namespace ulpgate {

// Known worst cases: (subject, type token) -> exact arguments.
using WorstCases = std::map<std::pair<std::string, std::string>, ArgumentList>;

struct PlanRequest {
  SubjectKind kind = SubjectKind::function;
  std::vector<std::string> subjects;  // names
  std::vector<std::string> types;     // tokens of built types
  std::vector<Stratum> strata;
  std::uint64_t samples = 20000;
  std::uint64_t seed = 1;
  std::string worst_cases_text;  // canonical text of the worst cases that apply, part of the plan's identity
};

// One row: a subject over a stratum.
struct PlanRow {
  const Subject* subject;
  StratumSource source;
};

struct WorkUnit {
  std::size_t row;
  std::uint64_t first;
  std::uint64_t last;
};

class Plan {
 public:
  Plan(PlanRequest request, const WorstCases& worst);

  [[nodiscard]] const PlanRequest& request() const { return request_; }
  [[nodiscard]] const std::vector<PlanRow>& rows() const { return rows_; }
  [[nodiscard]] const std::vector<WorkUnit>& units() const { return units_; }
  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] const std::string& hash() const { return hash_; }

 private:
  PlanRequest request_;
  std::vector<PlanRow> rows_;
  std::vector<WorkUnit> units_;
  std::map<std::tuple<std::string, std::string, Stratum>, ArgumentList> lists_;
  std::string text_;
  std::string hash_;
};

// Points of a drawn stratum of functions where a run asks for `samples`: uniform and stratified share them in
// equal halves (uniform gets the odd one), or the one that is chosen alone gets all; binades get as many as a
// half, and narrow a sixteenth, each of which is chosen among thousands.  A stratum of kernels has as many
// states as were asked for.
[[nodiscard]] std::uint64_t drawn_count(SubjectKind kind, Stratum s, std::uint64_t samples,
                                        const std::vector<Stratum>& chosen);

// Units have a fixed size: it bounds what a killed run loses and how finely shards can be dealt.
inline constexpr std::uint64_t unit_size = 2048;
// The 2^32 points of an exhaustive row would be two million of those.
inline constexpr std::uint64_t exhaustive_unit_size = std::uint64_t{1} << 20U;
// A sample of `narrow` is chosen among thousands of arguments.
inline constexpr std::uint64_t narrow_unit_size = 64;
inline constexpr std::uint64_t narrow_share = 16;
[[nodiscard]] constexpr std::uint64_t unit_size_of(Stratum s) {
  if (s == Stratum::narrow) return narrow_unit_size;
  return s == Stratum::exhaustive ? exhaustive_unit_size : unit_size;
}

// One record per part of a row; looks the points up that the summaries name.
[[nodiscard]] std::vector<RowRecord> finish_row(const Plan& plan, const PlanRow& row,
                                                const std::vector<Summary>& summaries);

}  // namespace ulpgate
