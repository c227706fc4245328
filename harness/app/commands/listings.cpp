// What `ulpgate list` shows besides functions: kernels, scenes and integrators.
#include "harness/app/commands/commands.hpp"
#include "harness/app/function_commands/listing.hpp"
#include "harness/app/scenes/scene_files.hpp"
#include "kernels/ode/integrators/integrators.hpp"

namespace ulpgate::app {

namespace {

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
  print_listing(json, rows, table, "ll");
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
  print_listing(json, rows, table, "ll");
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
  print_listing(json, rows, table, "llrl");
}

}  // namespace

std::vector<Listing> listings_of_scenes() {
  return {{"kernels", list_kernels}, {"scenes", list_scenes}, {"integrators", list_integrators}};
}

}  // namespace ulpgate::app
