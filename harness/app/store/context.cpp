// Context.
#include "harness/app/store/context.hpp"

#include <fmt/format.h>
#include <gmp.h>
#include <gnu/libc-version.h>

#include <Eigen/Core>
#include <boost/version.hpp>
#include <cfenv>
#include <fstream>

#include "harness/app/shell/failure.hpp"
#include "harness/app/store/build_facts.hpp"
#include "harness/core/subject/registry.hpp"

namespace ulpgate::app {

namespace {

std::string cpu_name() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

std::string boost_version() {
  return fmt::format("{}.{}.{}", BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000, BOOST_VERSION % 100);
}

}  // namespace

// What every kind of run says about itself.
Json machine_facts() {
  Json c;
  c["tool"] = {{"name", "ulpgate"}, {"version", build_facts::version}};
  c["compiler"] = build_facts::compiler;
  c["flags"] = build_facts::flags;
  c["build_type"] = build_facts::build_type;
  c["libraries"] = {
      {"glibc", gnu_get_libc_version()},
      {"Boost", boost_version()},
      {"MPFR", mpfr_get_version()},
      {"MPC", mpc_get_version()},
      {"GMP", gmp_version},
      {"Eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)}};
  c["cpu"] = cpu_name();
  return c;
}

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

void assert_floating_point_environment() {
  if (std::fegetround() != FE_TONEAREST) {
    throw Failure(ExitCode::environment,
                  "the rounding mode is not to nearest; results would not be those of the type");
  }
  volatile double least_normal = std::numeric_limits<double>::min();
  volatile double subnormal = least_normal / 4;
  volatile double back = subnormal * 4;
  if (subnormal == 0 || back != least_normal) {
    throw Failure(ExitCode::environment,
                  "subnormal numbers are flushed to zero; results would not be those of the type");
  }
}

}  // namespace ulpgate::app
