// ulpgate claims: holds what libraries document against what is found.
#include "harness/app/claims/claims_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "harness/app/claims/claim.hpp"
#include "harness/app/foreign/foreign_options.hpp"
#include "harness/app/shell/failure.hpp"
#include "harness/app/shell/files.hpp"
#include "harness/app/shell/selection.hpp"
#include "harness/app/terminal/help.hpp"
#include "harness/app/terminal/terminal.hpp"

namespace ulpgate::app {

namespace {

struct ClaimsOptions : ClaimOptions {
  std::string list;
  std::string functions = "all";
  std::string types = "all";
  std::string symbols;  // part of the symbol's name
  bool strict = false;
  bool json = false;
  bool resume = false;
  ForeignOptions foreign;
};

std::vector<ListedFunction> rows_of(const ClaimsOptions& o) {
  ForeignSpec common;
  common.worker = o.foreign.worker;
  common.environment = o.foreign.environment;
  common.timeout_s = o.foreign.call_timeout_s;
  std::vector<std::string> names;
  for (const auto& list : builtin_claims()) {
    names.push_back(list.name);
    if (list.name == o.list) return read_implementations("claims of " + list.name, list.text, common);
  }
  if (!std::filesystem::exists(o.list)) {
    throw Failure(Standing::bad_input,
                  fmt::format("{}: no such file, and no built-in list ({})", o.list, fmt::join(names, ", ")));
  }
  return read_implementations(o.list, read_file(o.list), common);
}

std::vector<ListedFunction> chosen_rows(const ClaimsOptions& o) {
  const auto functions = select_subjects(SubjectKind::function, o.functions);
  const auto types = select_types(o.types);
  std::vector<ListedFunction> rows = rows_of(o);
  const auto holds = [](const auto& all, const std::string& name) {
    return std::ranges::find(all, name) != all.end();
  };
  std::erase_if(rows, [&](const ListedFunction& r) {
    return !holds(functions, r.function) || !holds(types, r.type) ||
           r.spec.symbol.find(o.symbols) == std::string::npos;
  });
  for (const auto& r : rows) {
    if (!r.spec.claimed_ulp)
      throw Failure(Standing::bad_input,
                    fmt::format("{}{} claims nothing (claim_ulp)", r.place, r.spec.symbol));
  }
  if (rows.empty())
    throw Failure(Standing::nothing_measured, fmt::format("{}: nothing of it is chosen", o.list));
  return rows;
}

// What two variants of a function differ in: of the same library, function, type and claim.
struct Variants {
  std::string first;  // symbol
  SampledResults sample;
};
std::string difference_from(const Variants& v, const SampledResults& other) {
  std::size_t differ = 0;
  std::string first;
  for (std::size_t i = 0; i < other.results.size() && i < v.sample.results.size(); ++i) {
    if (other.results[i] == v.sample.results[i]) continue;
    if (differ++ == 0) first = other.args[i];
  }
  if (differ == 0) return "";
  return fmt::format("{} of {} results differ from {}'s, first at {}", differ, other.results.size(), v.first,
                     first);
}

Json to_json(const ListedFunction& row, const ClaimFound& found, const std::string& variant) {
  Json mismatches = Json::array();
  for (const auto& m : found.mismatches)
    mismatches.push_back({{"outcome", m.outcome}, {"count", m.count}, {"args", m.args}});
  Json properties = Json::array();
  for (const auto& p : found.properties)
    properties.push_back({{"property", p.property},
                          {"broken", p.broken},
                          {"of", p.looked_at},
                          {"args", p.args},
                          {"says", p.says}});
  Json domain = Json::array();
  for (const auto& [low, high] : row.claim.domain) domain.push_back({low, high});
  return {{"function", row.function},
          {"type", row.type},
          {"implementation", found.implementation},
          {"symbol", row.spec.symbol},
          {"claim_ulp", *row.spec.claimed_ulp},
          {"claim_floor", row.claim.floor},
          {"domain", domain},
          {"arguments", found.arguments},
          {"largest_ulp", found.largest_ulp},
          {"where", found.where},
          {"args", found.args},
          {"mismatches", mismatches},
          {"properties", properties},
          {"variant", variant},
          {"holds", !found.violates(*row.spec.claimed_ulp)},
          {"program", found.program}};
}

// Written where a violation can be shown by one.
void write_program(const ListedFunction& row, const BoundFunction& bound, const ClaimOptions& o,
                   ClaimFound& found) {
  if (!found.violates(*row.spec.claimed_ulp)) return;
  const bool by_error = found.largest_ulp > *row.spec.claimed_ulp * (1 + ClaimFound::negligible);
  const auto& args = by_error ? found.args : found.first_beyond(*row.spec.claimed_ulp)->args;
  if (args.empty()) return;
  const std::string text = program_text(row, bound, args);
  if (text.empty()) return;
  const auto file = std::filesystem::path(o.out) / "violations" / (directory_of(row) + ".c");
  make_directory(file.parent_path());
  write_file(file, text);
  found.program = file.string();
}

// With as many digits as tell it from the claim.
std::string shown_error(double ulp, double claim) {
  if (ulp < 0) return "-";
  std::string text = fmt::format("{:.6g}", ulp);
  if (ulp <= claim || ulp > 1.00001 * claim) return text;
  return fmt::format("{:g}+{:.1g}", claim, ulp - claim);
}

void print_row(const ListedFunction& row, const ClaimFound& found, const std::string& variant) {
  const double claim = *row.spec.claimed_ulp;
  const bool violated = found.violates(claim);
  const std::string word =
      painted(violated ? Paint::bad : Paint::good, fmt::format("{:<8}", violated ? "VIOLATED" : "holds"));
  show("{:<9} {:<10} {:<28} {:>7g} {:>12} {:<10}  {}  {}\n", row.function, row.type, row.spec.symbol, claim,
       shown_error(found.largest_ulp, claim), found.where, word, fmt::join(found.args, " "));
  for (const auto& m : found.mismatches)
    show("{:20}{} {} of {} arguments, first at {}\n", "", m.outcome, m.count, found.arguments,
         fmt::join(m.args, " "));
  for (const auto& p : found.properties)
    show("{:20}not {}: {} {} ({} of {})\n", "", p.property, fmt::join(p.args, " "), p.says, p.broken,
         p.looked_at);
  if (!variant.empty()) show("{:20}{}\n", "", variant);
  if (!found.program.empty()) show("{:20}shown by {}\n", "", found.program);
}

// A function that does not come to an end is a violation, and no reason to leave the others out.
ClaimFound held_or_ended(const ListedFunction& row, const BoundFunction& bound, const ClaimOptions& o) {
  try {
    return hold_to_claim(row, bound, o);
  } catch (const Failure& e) {
    if (e.standing() != Standing::regression) throw;
    fmt::print(stderr, "ulpgate: {}\n", e.what());
    ClaimFound found;
    found.implementation = bound.subject->info().implementation;
    found.mismatches.push_back({e.what(), 1, {}, std::numeric_limits<double>::infinity()});
    found.sample = SampledResults{};
    return found;
  }
}

Verdict run_claims(const ClaimsOptions& o) {
  const auto rows = chosen_rows(o);
  make_directory(o.out);
  if (!o.json)
    show("{:<9} {:<10} {:<28} {:>7} {:>12} {:<10}  {:<8}  {}\n", "function", "type", "symbol", "claim",
         "found", "where", "", "argument");
  std::map<std::string, Variants> variants;
  Json all = Json::array();
  Verdict verdict;
  std::size_t violated = 0;
  std::uint64_t arguments = 0;
  for (const auto& row : rows) {
    const BoundFunction bound = bind_listed(row);
    if (bound.subject == nullptr) continue;
    ClaimFound found = held_or_ended(row, bound, o);
    write_program(row, bound, o, found);
    // Of one domain, whose arguments are the same.
    std::string group =
        fmt::format("{} {} {} {}", row.spec.library, row.function, row.type, *row.spec.claimed_ulp);
    for (const auto& [low, high] : row.claim.domain) group += fmt::format(" [{}, {}]", low, high);
    std::string variant;
    if (const auto it = variants.find(group); it != variants.end()) {
      variant = difference_from(it->second, *found.sample);
    } else {
      variants[group] = {row.spec.symbol, *found.sample};
    }
    arguments += found.arguments;
    if (found.violates(*row.spec.claimed_ulp)) {
      ++violated;
      verdict |= Standing::regression;
    }
    if (o.strict && !found.properties.empty()) verdict |= Standing::regression;
    all.push_back(to_json(row, found, variant));
    if (!o.json) print_row(row, found, variant);
    std::fflush(stdout);
  }
  if (all.empty()) throw Failure(Standing::nothing_measured, "this processor can run none of them");
  write_file(std::filesystem::path(o.out) / "claims.json", all.dump(1) + "\n");
  if (o.json) fmt::print("{}\n", all.dump());
  fmt::print(stderr,
             "ulpgate: claims of {}: {} of {} hold, {} violated, over {} arguments; {} of {} rows left out\n",
             o.list, all.size() - violated, all.size(), violated, arguments, rows.size() - all.size(),
             rows.size());
  verdict |= foreign_verdict();
  return verdict;
}

}  // namespace

void add_claims_command(CLI::App& app, Action& action) {
  auto* claims = app.add_subcommand(
      "claims",
      "Hold the documented error bounds of libraries against what strata, search and all floats find");
  set_foot(*claims, {"ulpgate claims libm --functions fma,fmod --out out/claims",
                     "ulpgate claims sleef --types float --symbols avx2 --exhaustive --out out/sleef"});
  auto o = std::make_shared<ClaimsOptions>();
  claims->add_option("LIST", o->list, "sleef, libmvec, libm, or a TOML file of implementations with claims")
      ->required();
  claims->add_option("--out", o->out, "directory of records, claims.json and the C programs of violations")
      ->required();
  claims->add_option("--functions", o->functions, "all, or names, comma-separated")->capture_default_str();
  claims->add_option("--types", o->types, "all, or tokens, comma-separated")->capture_default_str();
  claims->add_option("--symbols", o->symbols, "those whose symbol holds this text alone: avx2, _u10");
  claims
      ->add_option("--samples", o->samples,
                   "samples of uniform and stratified together, as of `ulpgate math`")
      ->capture_default_str()
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 48U));
  claims->add_option("--evaluations", o->evaluations, "of the search for the largest error; 0: none")
      ->capture_default_str();
  claims->add_option("--seed", o->seed, "seed of samples and search")->capture_default_str();
  claims->add_option("--threads", o->threads, "threads, 0: one a core")
      ->capture_default_str()
      ->check(CLI::Range(0U, 4096U));
  claims->add_flag("--exhaustive", o->exhaustive,
                   "all 2^32 floats of functions of one float: minutes a function");
  claims->add_flag("--strict", o->strict, "exit 1 for a broken property as well");
  auto* resume = claims->add_flag("--resume", o->resume, "go on with what DIR holds (also without it)");
  claims->add_flag("--overwrite", o->overwrite, "measure again what DIR holds")->excludes(resume);
  claims->add_flag("--json", o->json, "print JSON");
  claims->add_option("--worker", o->foreign.worker,
                     "program that calls the functions (default: ulpgate-worker)");
  claims->add_option("--worker-environment", o->foreign.environment, "NAME=VALUE for that program");
  claims
      ->add_option("--call-timeout", o->foreign.call_timeout_s,
                   "seconds of processor time after which a call hangs")
      ->capture_default_str()
      ->check(CLI::Range(1e-3, 1e6));
  claims->callback([=, &action] { action = [=] { return run_claims(*o); }; });
}

}  // namespace ulpgate::app
