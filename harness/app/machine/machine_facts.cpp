// Machine facts.
#include "harness/app/machine/machine_facts.hpp"

#include <fmt/format.h>
#include <gmp.h>
#include <gnu/libc-version.h>
#include <mpc.h>
#include <mpfr.h>

#include <Eigen/Core>
#include <array>
#include <boost/version.hpp>
#include <fstream>
#include <map>

#include "harness/app/machine/build_facts.hpp"
#include "harness/app/machine/loaded_code.hpp"

namespace ulpgate::app {

namespace {

using Json = nlohmann::ordered_json;

// Cores of one name come in models and steppings that need not round the same approximations.
std::string processor() {
  std::ifstream in("/proc/cpuinfo");
  std::map<std::string, std::string> first;
  for (std::string line; std::getline(in, line) && !line.empty();) {
    const auto colon = line.find(':');
    if (colon == std::string::npos) continue;
    const auto end = line.find_last_not_of(" \t", colon - 1);
    first[line.substr(0, end + 1)] = colon + 2 < line.size() ? line.substr(colon + 2) : "";
  }
  std::string text;
  for (const auto& [key, word] :
       std::initializer_list<std::pair<const char*, const char*>>{{"model name", ""},
                                                                  {"cpu family", "family "},
                                                                  {"model", "model "},
                                                                  {"stepping", "stepping "},
                                                                  {"CPU implementer", "implementer "},
                                                                  {"CPU part", "part "},
                                                                  {"CPU revision", "revision "}}) {
    if (first.contains(key)) text += (text.empty() ? "" : ", ") + (word + first[key]);
  }
  return text.empty() ? "unknown" : text;
}

std::string boost_version() {
  return fmt::format("{}.{}.{}", BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000, BOOST_VERSION % 100);
}

}  // namespace

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
  Json loaded = Json::object();
  for (const auto& [file, library] : loaded_libraries())
    loaded[file] = {{"path", library.path}, {"build_id", library.build_id}};
  c["loaded"] = loaded;
  c["libm_variants"] = function_variants();
  c["instruction_sets"] = active_instruction_sets();
  c["cpu"] = processor();
  return c;
}

std::vector<std::string> machine_differences(const Json& there, const Json& here) {
  std::vector<std::string> texts;
  for (const auto* key : {"tool", "compiler", "flags", "build_type", "libraries", "loaded", "libm_variants",
                          "instruction_sets", "cpu"}) {
    const Json other = there.value(key, Json());
    const Json mine = here.value(key, Json());
    if (other != mine) texts.push_back(fmt::format("{} {}, not {}", key, other.dump(), mine.dump()));
  }
  return texts;
}

std::map<std::string, std::string> deciding_facts(const Json& context) {
  std::map<std::string, std::string> facts;
  const auto note = [&](const std::string& name, const Json& value) {
    if (value.is_string() && !value.get_ref<const std::string&>().empty()) facts[name] = value;
  };
  const auto object = [&](const char* key) {
    const auto it = context.find(key);
    return it != context.end() && it->is_object() ? *it : Json::object();
  };
  const Json libraries = object("libraries");
  for (const auto& [name, version] : libraries.items()) note(name, version);
  const Json loaded = object("loaded");
  for (const auto& [file, library] : loaded.items()) {
    if (library.is_object() && library.contains("build_id")) note(file, library["build_id"]);
  }
  for (const auto* key : {"libm_variants", "instruction_sets", "cpu"}) {
    if (context.contains(key)) note(key, context[key]);
  }
  return facts;
}

}  // namespace ulpgate::app
