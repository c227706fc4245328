// What a plan asks for, as context.json holds it, and whether records are all of it.
#pragma once

#include <string>
#include <vector>

#include "harness/app/reading/json_fields.hpp"
#include "harness/core/plan/plan.hpp"

namespace ulpgate::app {

// {type: {subject: {stratum: points}}}, in the order of the plan's rows.
[[nodiscard]] Json planned_rows(const Plan& plan);

// Holds the records to what the context says was planned and dealt to its shards.  Throws a Failure of
// bad_input, with the place of the record, for one that is no row of the plan, is there twice or has other
// counts.  Returns what is absent: rows that were dealt and have no record, or fewer samples than dealt.
// `places` names the records ("DIR/math.jsonl:3"), `context_place` the context.
[[nodiscard]] std::vector<std::string> absent_rows(const Json& context, const std::string& context_place,
                                                   const std::vector<RowRecord>& records,
                                                   const std::vector<std::string>& places);

// The first of `names` and how many there are.
[[nodiscard]] std::string some_of(const std::vector<std::string>& names);

}  // namespace ulpgate::app
