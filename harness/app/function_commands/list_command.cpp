// ulpgate list: what can be measured.
#include <algorithm>
#include <memory>

#include "harness/app/function_commands/function_commands.hpp"
#include "harness/app/function_commands/listing.hpp"
#include "harness/app/terminal/help.hpp"

namespace ulpgate::app {

namespace {

// Which code each type runs.
Json implementations(const std::string& name) {
  Json by_type = Json::object();
  for (const auto& type : all_types())
    by_type[type.token] = find_subject(name, type.token)->info().implementation;
  return by_type;
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
  print_listing(json, rows, table, "llrll");
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
  print_listing(false, {}, table, "lrrrrrl");
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
  print_listing(json, rows, table, "lll");
}

}  // namespace

void add_list_command(CLI::App& app, Action& action, std::vector<Listing> more) {
  auto listings = std::make_shared<std::vector<Listing>>(
      std::vector<Listing>{{"functions", list_functions}, {"types", list_types}, {"strata", list_strata}});
  listings->insert(listings->end(), more.begin(), more.end());
  std::vector<std::string> names;
  for (const Listing& listing : *listings) names.push_back(listing.name);
  const std::string choices =
      fmt::format("{} or {}", fmt::join(names.begin(), names.end() - 1, ", "), names.back());
  auto* list = app.add_subcommand("list", "List " + choices);
  set_foot(*list, {"ulpgate list functions", "ulpgate list types --json"});
  auto what = std::make_shared<std::string>();
  auto json = std::make_shared<bool>(false);
  list->add_option("what", *what, choices)->required()->check(CLI::IsMember(names));
  list->add_flag("--json", *json, "Print JSON");
  list->callback([=, &action] {
    action = [=] {
      std::ranges::find(*listings, *what, &Listing::name)->print(*json);
      return Standing::pass;
    };
  });
}

}  // namespace ulpgate::app
