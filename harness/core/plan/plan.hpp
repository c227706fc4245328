// Plan: everything that fixes a run's numbers, its rows and work units, and the hash that stands in every
// record.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "harness/core/subject/type_engine.hpp"

namespace ulpgate {

// Known worst cases: (function, type token) -> exact arguments.
using WorstCases = std::map<std::pair<FunctionId, std::string>, ArgumentList>;

struct PlanRequest {
  std::vector<FunctionId> functions;
  std::vector<std::string> types;  // tokens of built types
  std::vector<Stratum> strata;
  std::uint64_t samples = 20000;
  std::uint64_t seed = 1;
  std::string worst_cases_text;  // canonical text of the worst cases that apply, part of the plan's identity
};

// One row: a function of a type over a stratum.
struct PlanRow {
  const TypeEngine* engine;
  FunctionInfo function;
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

  // Whether the function has an exhaustive row in the type: real functions of one argument, of float.
  [[nodiscard]] static bool can_exhaust(const FunctionInfo& f, std::string_view type);
  // Points of a drawn stratum: uniform and stratified share --samples in equal halves (uniform gets the odd
  // one), binades get as many as a half.
  [[nodiscard]] static std::uint64_t drawn_count(Stratum s, std::uint64_t samples);

 private:
  PlanRequest request_;
  std::vector<PlanRow> rows_;
  std::vector<WorkUnit> units_;
  std::map<std::tuple<FunctionId, std::string, Stratum>, ArgumentList> lists_;
  std::string text_;
  std::string hash_;
};

// Units have a fixed size: it bounds what a killed run loses and how finely shards can be dealt.
inline constexpr std::uint64_t unit_size = 2048;
// The 2^32 points of an exhaustive row would be two million of those.
inline constexpr std::uint64_t exhaustive_unit_size = std::uint64_t{1} << 20U;
[[nodiscard]] constexpr std::uint64_t unit_size_of(Stratum s) {
  return s == Stratum::exhaustive ? exhaustive_unit_size : unit_size;
}

}  // namespace ulpgate
