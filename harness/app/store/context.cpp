// Context.
#include "harness/app/store/context.hpp"

#include "harness/app/machine/machine_facts.hpp"
#include "harness/app/reading/planned_rows.hpp"
#include "harness/core/subject/registry.hpp"

namespace ulpgate::app {

Json type_rows(const std::vector<std::string>& tokens) {
  Json rows = Json::array();
  for (const auto& token : tokens) {
    const RealDescriptor& d = *find_type(token);
    rows.push_back({{"token", d.token},
                    {"cpp_type", d.cpp_type},
                    {"total_bits", d.total_bits == 0 ? Json(nullptr) : Json(d.total_bits)},
                    {"decimal_places", d.decimal_places},
                    {"exponent_bits", d.exponent_bits == 0 ? Json(nullptr) : Json(d.exponent_bits)},
                    {"significand_bits", d.significand_bits},
                    {"reference_bits", d.reference_bits}});
  }
  return rows;
}

namespace {

Json function_row(const SubjectInfo& f) {
  Json parts = Json::array();
  for (const auto& part : f.parts) parts.push_back(part.name);
  Json domain = Json::array();
  for (const auto& input : f.inputs) domain.push_back(input.domain);
  return {{"name", f.name},
          {"class", f.subject_class},
          {"arity", f.inputs.size()},
          {"parts", parts},
          {"domain", domain}};
}

Json kernel_row(const SubjectInfo& k) {
  Json inputs = Json::array();
  for (const auto& input : k.inputs)
    inputs.push_back({{"name", input.name}, {"components", input.components}});
  Json outputs = Json::array();
  for (const auto& q : k.parts) outputs.push_back({{"name", q.name}, {"components", q.components}});
  return {{"name", k.name}, {"inputs", inputs}, {"outputs", outputs}};
}

}  // namespace

Json make_context(const Plan& plan, const std::vector<std::string>& shards, unsigned threads, bool complete) {
  const PlanRequest& request = plan.request();
  Json strata = Json::array();
  for (const auto s : request.strata) strata.push_back(name_of(s));
  Json c = machine_facts();
  c["seed"] = request.seed;
  c["samples"] = request.samples;
  c["strata"] = strata;
  c["plan"] = plan.hash();
  c["plan_text"] = plan.text();
  c["shards"] = shards;
  c["threads"] = threads;
  c["complete"] = complete;
  c["types"] = type_rows(request.types);
  const bool functions = request.kind == SubjectKind::function;
  Json subjects = Json::array();
  for (const auto& name : request.subjects) {
    const SubjectInfo& subject = find_subject(name, request.types.front())->info();
    subjects.push_back(functions ? function_row(subject) : kernel_row(subject));
  }
  c[functions ? "functions" : "kernels"] = subjects;
  c["planned"] = planned_rows(plan);
  Json codes = Json::array();
  for (const auto& token : request.types) {
    for (const auto& name : request.subjects) {
      const SubjectInfo& info = find_subject(name, token)->info();
      if (info.selection.empty()) continue;
      Json code = {{"function", name},
                   {"type", token},
                   {"implementation", info.implementation},
                   {"selection", info.selection.substr(1)}};
      for (const auto& [what, value] : info.code_facts) code[what] = value;
      codes.push_back(code);
    }
  }
  if (!codes.empty()) c["foreign"] = codes;
  return c;
}

Json make_scene_context(const std::string& plan, const std::string& plan_text,
                        const std::vector<std::string>& types, unsigned threads, bool complete) {
  Json c = machine_facts();
  c["plan"] = plan;
  c["plan_text"] = plan_text;
  c["threads"] = threads;
  c["complete"] = complete;
  c["types"] = type_rows(types);
  return c;
}

}  // namespace ulpgate::app
