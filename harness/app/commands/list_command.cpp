// ulpgate list: what can be measured.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>
#include <vector>

#include "harness/app/commands/commands.hpp"
#include "harness/app/scenes/scene_files.hpp"
#include "harness/app/store/context.hpp"
#include "harness/app/terminal/help.hpp"
#include "harness/app/terminal/terminal.hpp"
#include "harness/core/subject/registry.hpp"
#include "kernels/ode/integrators/integrators.hpp"

namespace ulpgate::app {

namespace {

// Which code each type runs.
Json implementations(const std::string& name) {
  Json by_type = Json::object();
  for (const auto& type : all_types())
    by_type[type.token] = find_subject(name, type.token)->info().implementation;
  return by_type;
}

std::string joined(const std::vector<std::string>& names) {
  return fmt::format("{}", fmt::join(names, ","));
}

std::vector<std::string> part_names(const SubjectInfo& subject) {
  std::vector<std::string> names;
  for (const auto& part : subject.parts) names.push_back(part.name);
  return names;
}

using Table = std::vector<std::vector<std::string>>;

void print(bool json, const Json& rows, const Table& table, std::string_view sides) {
  if (json) {
    fmt::print("{}\n", rows.dump(2));
  } else {
    show_text(aligned(table, sides));
  }
}

void list_functions(bool json) {
  Json rows = Json::array();
  Table table(1, {"function", "class", "arity", "parts", "domain"});
  for (const auto* f : subjects_of(SubjectKind::function)) {
    std::vector<std::string> domains;
    for (const auto& input : f->inputs) domains.push_back(input.domain);
    if (json) {
      rows.push_back({{"function", f->name},
                      {"class", f->subject_class},
                      {"arity", f->inputs.size()},
                      {"parts", joined(part_names(*f))},
                      {"domain", joined(domains)},
                      {"implementation", implementations(f->name)}});
    } else {
      table.push_back({f->name, f->subject_class, std::to_string(f->inputs.size()), joined(part_names(*f)),
                       joined(domains)});
    }
  }
  print(json, rows, table, "llrll");
}

void list_types(bool json) {
  std::vector<std::string> tokens;
  for (const auto& type : all_types()) tokens.push_back(type.token);
  if (json) return fmt::print("{}\n", type_rows(tokens).dump(2));
  const auto or_dash = [](int n) { return n == 0 ? std::string("-") : std::to_string(n); };
  // Two lines of heads, so that the numbers take a terminal of 80 columns.
  Table table = {{"", "total", "decimal", "exponent", "significand", "RealHP<4>"},
                 {"token", "bits", "places", "bits", "bits", "bits", "C++ type"}};
  for (const RealDescriptor& d : all_types()) {
    table.push_back({d.token, d.total_bits == 0 ? "N" : std::to_string(d.total_bits),
                     std::to_string(d.decimal_places), or_dash(d.exponent_bits),
                     std::to_string(d.significand_bits), std::to_string(d.reference_bits), d.cpp_type});
  }
  print(false, {}, table, "lrrrrrl");
}

template <class Strata>
void add_strata(const Strata& strata, const char* what, bool json, Json& rows, Table& table) {
  for (const auto& s : strata) {
    if (json) {
      rows.push_back({{"of", what}, {"stratum", s.name}, {"description", s.description}});
    } else {
      table.push_back({what, std::string(s.name), std::string(s.description)});
    }
  }
}

void list_strata(bool json) {
  Json rows = Json::array();
  Table table(1, {"of", "stratum", "what is drawn"});
  add_strata(function_strata, "math", json, rows, table);
  add_strata(kernel_strata, "kernels", json, rows, table);
  print(json, rows, table, "lll");
}

// With spaces, at which a line can be broken.
std::string spaced(const std::string& names) {
  std::string text;
  for (const char c : names) text += c == ',' ? std::string(", ") : std::string(1, c);
  return text;
}

void list_kernels(bool json) {
  Json rows = Json::array();
  Table table(1, {"kernel", "(inputs) -> outputs"});
  for (const auto* k : subjects_of(SubjectKind::kernel)) {
    std::vector<std::string> names;
    for (const auto& input : k->inputs) names.push_back(input.name);
    const std::string inputs = joined(names);
    const std::string outputs = joined(part_names(*k));
    if (json) {
      rows.push_back({{"kernel", k->name}, {"inputs", inputs}, {"outputs", outputs}});
    } else {
      table.push_back({k->name, fmt::format("({}) -> {}", spaced(inputs), spaced(outputs))});
    }
  }
  print(json, rows, table, "ll");
}

void list_scenes(bool json) {
  Json rows = Json::array();
  Table table(1, {"scene", "what it is"});
  for (const auto& builtin : builtin_scenes()) {
    const auto scene = load_scene(builtin.name, {}).scene;
    if (json) {
      rows.push_back(
          {{"scene", scene.name}, {"title", scene.title}, {"dt", scene.dt}, {"until", scene.until}});
    } else {
      table.push_back(
          {scene.name, fmt::format("{} (dt {} s, until {} s)", scene.title, scene.dt, scene.until)});
    }
  }
  print(json, rows, table, "ll");
}

void list_integrators(bool json) {
  Json rows = Json::array();
  Table table(1, {"integrator", "kind", "order", "source"});
  for (const auto& i : ode::integrators()) {
    const std::string kind(ode::to_string(i.kind));
    if (json) {
      rows.push_back(
          {{"integrator", i.name},
           {"kind", kind},
           {"order", i.order ? Json(*i.order) : Json(nullptr)},
           {"evaluations_per_step", i.evaluations_per_step ? Json(*i.evaluations_per_step) : Json(nullptr)},
           {"citation", i.citation}});
    } else {
      table.push_back(
          {std::string(i.name), kind, i.order ? std::to_string(*i.order) : "free", std::string(i.citation)});
    }
  }
  print(json, rows, table, "llrl");
}

}  // namespace

void add_list_command(CLI::App& app, Action& action) {
  auto* list = app.add_subcommand("list", "List functions, types, strata, kernels, scenes or integrators");
  set_foot(*list, {"ulpgate list functions", "ulpgate list types --json"});
  auto what = std::make_shared<std::string>();
  auto json = std::make_shared<bool>(false);
  list->add_option("what", *what, "functions, types, strata, kernels, scenes or integrators")
      ->required()
      ->check(CLI::IsMember({"functions", "types", "strata", "kernels", "scenes", "integrators"}));
  list->add_flag("--json", *json, "Print JSON");
  list->callback([=, &action] {
    action = [=] {
      if (*what == "functions") list_functions(*json);
      if (*what == "types") list_types(*json);
      if (*what == "strata") list_strata(*json);
      if (*what == "kernels") list_kernels(*json);
      if (*what == "scenes") list_scenes(*json);
      if (*what == "integrators") list_integrators(*json);
      return Standing::pass;
    };
  });
}

}  // namespace ulpgate::app
