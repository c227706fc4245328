// Context: where, with what and by which plan a run was made (context.json).
#pragma once

#include "harness/app/store/records.hpp"
#include "harness/core/plan/plan.hpp"

namespace ulpgate::app {

[[nodiscard]] Json make_context(const Plan& plan, const std::vector<std::string>& shards, unsigned threads,
                                bool complete);
[[nodiscard]] Json make_scene_context(const std::string& plan, const std::string& plan_text,
                                      const std::vector<std::string>& types, unsigned threads, bool complete);
[[nodiscard]] Json type_rows(const std::vector<std::string>& tokens);

}  // namespace ulpgate::app
