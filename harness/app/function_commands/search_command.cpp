// ulpgate search: hunts for the largest error of a function in a type, everywhere and away from what is
// known, and offers it to the worst cases.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <limits>
#include <thread>

#include "harness/app/foreign/foreign_options.hpp"
#include "harness/app/function_commands/function_commands.hpp"
#include "harness/app/machine/environment.hpp"
#include "harness/app/machine/threads.hpp"
#include "harness/app/search/search_round.hpp"
#include "harness/app/shell/files.hpp"
#include "harness/app/shell/interrupt.hpp"
#include "harness/app/shell/progress.hpp"
#include "harness/app/shell/selection.hpp"
#include "harness/app/store/records.hpp"
#include "harness/app/store/worst_cases.hpp"
#include "harness/app/terminal/help.hpp"
#include "harness/app/terminal/terminal.hpp"
#include "harness/core/search/function_search.hpp"
#include "harness/core/watch/heartbeat.hpp"

namespace ulpgate::app {

namespace {

using Clock = std::chrono::steady_clock;

struct SearchOptions {
  std::string function;
  std::string type;
  double seconds = 30;
  std::uint64_t evaluations = 0;  // 0: as many as fit into the seconds
  std::uint64_t seed = 1;
  unsigned threads = 0;
  std::string out;
  std::string worst_cases;
  std::string known;
  double limit_ulp = 0;  // 0: none
  bool json = false;
  ForeignOptions foreign;
};

std::string reproducer(const Subject& subject, const Point& point) {
  return fmt::format("ulpgate at {} {} {}{}", subject.name(), subject.type().token,
                     fmt::join(point.args_hex, " "), subject.info().selection);
}

// One hunt over the whole domain, hard arguments first, and one that passes over the neighbourhoods of those
// and of the known worst cases: where a function is off by 1e5 ULP, nothing else would ever be reported.
struct Hunts {
  std::unique_ptr<FunctionSearch> whole;
  std::unique_ptr<FunctionSearch> elsewhere;

  [[nodiscard]] std::uint64_t evaluations() const { return whole->evaluations() + elsewhere->evaluations(); }
  // The one that is behind.
  [[nodiscard]] FunctionSearch& next() const {
    return elsewhere->evaluations() < whole->evaluations() ? *elsewhere : *whole;
  }
  [[nodiscard]] double best_error_ulp() const {
    return std::max(whole->best_error_ulp(), elsewhere->best_error_ulp());
  }
  [[nodiscard]] SearchBest best() const {
    return elsewhere->best_error_ulp() > whole->best_error_ulp() ? elsewhere->best() : whole->best();
  }
  [[nodiscard]] std::map<Outcome, SearchMismatch> mismatches() const {
    auto all = whole->mismatches();
    for (auto& [outcome, m] : elsewhere->mismatches()) {
      SearchMismatch& to = all[outcome];
      if (to.confirmed == 0) to.args = std::move(m.args);
      to.confirmed += m.confirmed;
    }
    return all;
  }
};

Hunts make_hunts(const SearchOptions& o, const FunctionInfo& f, const Subject& subject) {
  ArgumentList known = subject.listed(Stratum::hard);
  const std::string& given = o.known.empty() ? o.worst_cases : o.known;
  const std::filesystem::path directory = given.empty() ? "ci/worst_cases" : given;
  // What is wrong with the files should be known before the hunt.
  if (!given.empty() || std::filesystem::is_directory(directory)) {
    for (auto& point : worst_cases_of(directory, f, o.type)) known.push_back(std::move(point));
  }
  return {make_search(subject, o.seed), make_search_elsewhere(subject, o.seed, known)};
}

// Until the seconds or the evaluations are spent; false after an interrupt.
bool hunt(const SearchOptions& o, const Hunts& hunts, unsigned threads, const Subject& subject) {
  const InterruptGuard guard;
  Progress progress("search");
  const auto start = Clock::now();
  std::string shown;
  while (!interrupted()) {
    const std::uint64_t limit =
        o.evaluations != 0 ? o.evaluations : std::numeric_limits<std::uint64_t>::max();
    const double elapsed_s = std::chrono::duration<double>(Clock::now() - start).count();
    if (hunts.evaluations() >= limit || (o.evaluations == 0 && elapsed_s >= o.seconds)) return true;
    FunctionSearch& search = hunts.next();
    run_round(search, limit - hunts.evaluations(), threads, subject);
    const std::string now = fmt::format("{:.4g}", hunts.best_error_ulp());
    if (hunts.best_error_ulp() >= 0 && now != shown) {
      const Point point = subject.point(hunts.best().args);
      progress.clear();
      fmt::print(stderr, "ulpgate: {} ULP at {} after {} evaluations\n", now, fmt::join(point.args_hex, " "),
                 hunts.evaluations());
      shown = now;
    }
    if (o.evaluations != 0) {
      progress.update(static_cast<double>(hunts.evaluations()), static_cast<double>(o.evaluations));
    } else {
      progress.update(elapsed_s, o.seconds);
    }
  }
  return false;
}

Json to_json(const SearchOptions& o, const Subject& subject, const Hunts& hunts, const SearchBest& best,
             const Point& point) {
  Json mismatches = Json::array();
  for (const auto& [outcome, m] : hunts.mismatches()) {
    const Point at = subject.point(m.args);
    mismatches.push_back({{"outcome", name_of(outcome)},
                          {"args", at.args_hex},
                          {"confirmed", m.confirmed},
                          {"reproduce", reproducer(subject, at)}});
  }
  Json values = Json::array();
  Json exact = Json::array();
  for (const auto& part : point.parts) {
    values.push_back(part.got_hex.front());
    exact.push_back(part.exact_decimal.front());
  }
  Json elsewhere = nullptr;
  if (const SearchBest other = hunts.elsewhere->best(); !other.args.empty()) {
    const Point at = subject.point(other.args);
    elsewhere = {{"args", at.args_hex},
                 {"ulp_error", number_or_text(other.error_ulp)},
                 {"reproduce", reproducer(subject, at)}};
  }
  return {{"function", subject.name()},
          {"type", o.type},
          {"seed", o.seed},
          {"evaluations", hunts.evaluations()},
          {"args", point.args_hex},
          {"value", values},
          {"reference", exact},
          {"ulp_error", number_or_text(best.error_ulp)},
          {"float_distance", number_or_text(best.distance)},
          {"found_after", best.evaluations},
          {"reproduce", point.args_hex.empty() ? "" : reproducer(subject, point)},
          {"elsewhere", elsewhere},
          {"mismatches", mismatches}};
}

std::string text_of(const Json& error) {
  return error.is_string() ? error.get<std::string>() : fmt::format("{:.6f}", error.get<double>());
}

void print_text(const Json& found) {
  if (found.at("args").empty()) {
    show("{} {}: no argument with an error in ULP was found\n", found.at("function").get<std::string>(),
         found.at("type").get<std::string>());
  } else {
    show("{} {}\n", found.at("function").get<std::string>(), found.at("type").get<std::string>());
    show("  largest ULP error   {}\n", text_of(found.at("ulp_error")));
    show("  argument            {}\n", fmt::join(found.at("args").get<std::vector<std::string>>(), " "));
    fmt::print("  float_distance      {}\n", found.at("float_distance").dump());
    show("  reproduce           {}\n", found.at("reproduce").get<std::string>());
  }
  if (const Json& other = found.at("elsewhere"); !other.is_null()) {
    show("  elsewhere           {} away from hard arguments and known worst cases\n",
         text_of(other.at("ulp_error")));
    show("  reproduce           {}\n", other.at("reproduce").get<std::string>());
  }
  show("  evaluations         {} (found after {})\n", found.at("evaluations").get<std::uint64_t>(),
       found.at("found_after").get<std::uint64_t>());
  for (const auto& m : found.at("mismatches")) {
    show("  mismatch            {}: {}\n", m.at("outcome").get<std::string>(),
         m.at("reproduce").get<std::string>());
  }
}

// A confirmed mismatch, and an error beyond a claim or beyond the limit that was given: what a search was
// for.
Verdict judge(const SearchOptions& o, const Subject& subject, const Hunts& hunts, const Json& found) {
  const SearchBest best = hunts.best();
  const auto mismatches = hunts.mismatches();
  if (best.args.empty() && mismatches.empty()) return Standing::nothing_measured;
  Verdict verdict;
  for (const auto& [outcome, m] : mismatches) {
    verdict |= Standing::regression;
    fmt::print(stderr, "ulpgate: {} {}: a confirmed mismatch, {}: {}\n", subject.name(), o.type,
               name_of(outcome), reproducer(subject, subject.point(m.args)));
  }
  const auto hold = [&](double error_ulp, double limit_ulp, std::string_view what, const Json& at) {
    const Standing standing = at_most(error_ulp, limit_ulp);
    if (standing == Standing::pass) return;
    verdict |= Standing::regression;
    fmt::print(stderr, "ulpgate: {} {}: off by {:.6g} ULP, {} {}: {}\n", subject.name(), o.type, error_ulp,
               what, limit_ulp, at.at("reproduce").get<std::string>());
  };
  if (!best.args.empty() && subject.info().claimed_ulp)
    hold(best.error_ulp, *subject.info().claimed_ulp, "claimed", found);
  if (o.limit_ulp > 0 && !found.at("elsewhere").is_null())
    hold(hunts.elsewhere->best_error_ulp(), o.limit_ulp, "limit", found.at("elsewhere"));
  return verdict;
}

Verdict run_search(const SearchOptions& o) {
  const FunctionInfo& f = function_or_fail(o.function);
  bind_foreign(o.foreign, o.function, o.type);
  const Subject& subject = subject_or_fail(o.function, o.type);
  if (!can_search(subject)) {
    throw Failure(Standing::bad_input,
                  fmt::format("{} is a special function with whole-numbered arguments: search takes real and "
                              "complex functions",
                              f.name));
  }
  const Hunts hunts = make_hunts(o, f, subject);
  const unsigned threads = o.threads != 0 ? o.threads : std::max(1U, std::thread::hardware_concurrency());
  const bool complete = hunt(o, hunts, threads, subject);
  const SearchBest best = hunts.best();
  const Point point = best.args.empty() ? Point{} : subject.point(best.args);
  const Json found = to_json(o, subject, hunts, best, point);
  if (o.json) {
    fmt::print("{}\n", found.dump());
  } else {
    print_text(found);
  }
  if (!o.out.empty()) write_file(o.out, found.dump(2) + "\n");
  if (!best.args.empty()) {
    const std::string line = fmt::format("{} {}", f.name, fmt::join(point.args_hex, " "));
    if (o.worst_cases.empty()) {
      fmt::print(stderr, "ulpgate: to keep it, add to ci/worst_cases/{}.txt (--worst-cases DIR does): {}\n",
                 o.type, line);
    } else {
      fmt::print(stderr, "ulpgate: {}\n",
                 offer_worst_case(o.worst_cases, f, o.type, best.args, best.error_ulp));
    }
  }
  if (!complete) throw Failure(Standing::incomplete, "interrupted; what was found so far stands above");
  Verdict verdict = judge(o, subject, hunts, found);
  verdict |= foreign_verdict();
  return verdict;
}

}  // namespace

void add_search_command(CLI::App& app, Action& action) {
  auto* search =
      app.add_subcommand("search", "Hunt for the largest error of a function over its whole domain");
  set_foot(*search, {"ulpgate search tgamma double --seconds 5",
                     "ulpgate search exp double --evaluations 100000 --limit 0.52 --json"});
  auto o = std::make_shared<SearchOptions>();
  search->add_option("FUNCTION", o->function, "a real or complex function")->required();
  search->add_option("TYPE", o->type, "a type")->required();
  auto* seconds = search->add_option("--seconds", o->seconds, "time of the hunt")
                      ->capture_default_str()
                      ->check(CLI::Range(0.0, 1e9));
  search
      ->add_option(
          "--evaluations", o->evaluations,
          "evaluations of the function instead of seconds: the result then depends on them and on the "
          "seed alone")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 48U))
      ->excludes(seconds);
  search->add_option("--seed", o->seed, "seed of the hunt")->capture_default_str();
  search->add_option("--threads", o->threads, "threads, 0: one a core; the result does not depend on them")
      ->capture_default_str()
      ->check(CLI::Range(0U, 4096U));
  search->add_option("--out", o->out, "file for the result as JSON");
  search->add_option(
      "--worst-cases", o->worst_cases,
      "directory of worst cases: what was found is added to TYPE.txt unless that holds a worse "
      "one of the function");
  search->add_option(
      "--known", o->known,
      "directory of worst cases that the second hunt passes over instead of those of --worst-cases: a "
      "search that is made again finds the same, though the first added what it found");
  search
      ->add_option("--limit", o->limit_ulp,
                   "exit 1 where the error in ULP, away from hard arguments and known worst cases, is larger")
      ->check(CLI::Range(0.0, 1e300));
  add_foreign_options(*search, o->foreign, false);
  search->add_flag("--json", o->json, "print JSON");
  search->callback([=, &action] { action = [=] { return run_search(*o); }; });
}

}  // namespace ulpgate::app
