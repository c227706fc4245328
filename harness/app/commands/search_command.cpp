// ulpgate search: hunts for the largest error of a function in a type, and offers it to the worst cases.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <limits>
#include <thread>

#include "harness/app/commands/commands.hpp"
#include "harness/app/shell/crash_report.hpp"
#include "harness/app/shell/files.hpp"
#include "harness/app/shell/interrupt.hpp"
#include "harness/app/shell/progress.hpp"
#include "harness/app/shell/selection.hpp"
#include "harness/app/store/records.hpp"
#include "harness/app/store/worst_cases.hpp"
#include "harness/core/search/function_search.hpp"

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
  bool json = false;
};

std::string reproducer(const Subject& subject, const Point& point) {
  return fmt::format("ulpgate at {} {} {}", subject.name(), subject.type().token,
                     fmt::join(point.args_hex, " "));
}

// The batches of a round on several threads.
void run_round(FunctionSearch& search, std::size_t batches, unsigned threads) {
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    const MpfrThread mpfr;
    for (std::size_t i = next++; i < batches; i = next++) search.run_batch(i);
  };
  std::vector<std::thread> pool;
  for (unsigned t = 1; t < threads; ++t) pool.emplace_back(work);
  work();
  for (auto& t : pool) t.join();
}

// Until the seconds or the evaluations are spent; false after an interrupt.
bool hunt(const SearchOptions& o, FunctionSearch& search, unsigned threads, const Subject& subject) {
  const InterruptGuard guard;
  Progress progress("search");
  const auto start = Clock::now();
  std::string shown;
  while (!interrupted()) {
    const std::uint64_t limit =
        o.evaluations != 0 ? o.evaluations : std::numeric_limits<std::uint64_t>::max();
    const double elapsed_s = std::chrono::duration<double>(Clock::now() - start).count();
    if (search.evaluations() >= limit || (o.evaluations == 0 && elapsed_s >= o.seconds)) return true;
    run_round(search, search.begin_round(limit - search.evaluations()), threads);
    search.end_round();
    const std::string now = fmt::format("{:.4g}", search.best_error_ulp());
    if (search.best_error_ulp() >= 0 && now != shown) {
      const Point point = subject.point(search.best().args);
      progress.clear();
      fmt::print(stderr, "ulpgate: {} ULP at {} after {} evaluations\n", now, fmt::join(point.args_hex, " "),
                 search.evaluations());
      shown = now;
    }
    if (o.evaluations != 0) {
      progress.update(static_cast<double>(search.evaluations()), static_cast<double>(o.evaluations));
    } else {
      progress.update(elapsed_s, o.seconds);
    }
  }
  return false;
}

Json to_json(const SearchOptions& o, const Subject& subject, const FunctionSearch& search,
             const SearchBest& best, const Point& point) {
  Json mismatches = Json::array();
  for (const auto& [outcome, m] : search.mismatches()) {
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
  return {{"function", subject.name()},
          {"type", o.type},
          {"seed", o.seed},
          {"evaluations", search.evaluations()},
          {"args", point.args_hex},
          {"value", values},
          {"reference", exact},
          {"ulp_error", number_or_text(best.error_ulp)},
          {"float_distance", number_or_text(best.distance)},
          {"found_after", best.evaluations},
          {"reproduce", point.args_hex.empty() ? "" : reproducer(subject, point)},
          {"mismatches", mismatches}};
}

void print_text(const Json& found) {
  if (found.at("args").empty()) {
    fmt::print("{} {}: no argument with an error in ULP was found\n", found.at("function").get<std::string>(),
               found.at("type").get<std::string>());
  } else {
    const Json& error = found.at("ulp_error");
    fmt::print("{} {}\n", found.at("function").get<std::string>(), found.at("type").get<std::string>());
    fmt::print("  largest ULP error   {}\n",
               error.is_string() ? error.get<std::string>() : fmt::format("{:.6f}", error.get<double>()));
    fmt::print("  argument            {}\n",
               fmt::join(found.at("args").get<std::vector<std::string>>(), " "));
    fmt::print("  float_distance      {}\n", found.at("float_distance").dump());
    fmt::print("  reproduce           {}\n", found.at("reproduce").get<std::string>());
  }
  fmt::print("  evaluations         {} (found after {})\n", found.at("evaluations").get<std::uint64_t>(),
             found.at("found_after").get<std::uint64_t>());
  for (const auto& m : found.at("mismatches")) {
    fmt::print("  mismatch            {}: {}\n", m.at("outcome").get<std::string>(),
               m.at("reproduce").get<std::string>());
  }
}

ExitCode run_search(const SearchOptions& o) {
  const FunctionInfo& f = function_or_fail(o.function);
  const Subject& subject = subject_or_fail(o.function, o.type);
  if (!can_search(subject)) {
    throw Failure(ExitCode::bad_input,
                  fmt::format("{} is a special function with whole-numbered arguments: search takes real and "
                              "complex functions",
                              f.name));
  }
  // What is wrong with the files should be known before the hunt.
  if (!o.worst_cases.empty()) static_cast<void>(worst_cases_of(o.worst_cases, f, o.type));
  const CrashPlace place(f.name, o.type, "search");
  const auto search = make_search(subject, o.seed);
  const unsigned threads = o.threads != 0 ? o.threads : std::max(1U, std::thread::hardware_concurrency());
  const bool complete = hunt(o, *search, threads, subject);
  const SearchBest best = search->best();
  const Point point = best.args.empty() ? Point{} : subject.point(best.args);
  const Json found = to_json(o, subject, *search, best, point);
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
  if (!complete) throw Failure(ExitCode::incomplete, "interrupted; what was found so far stands above");
  return best.args.empty() && search->mismatches().empty() ? ExitCode::incomplete : ExitCode::pass;
}

}  // namespace

void add_search_command(CLI::App& app, Action& action) {
  auto* search =
      app.add_subcommand("search", "Hunt for the largest error of a function over its whole domain");
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
  search->add_flag("--json", o->json, "print JSON");
  search->callback([=, &action] { action = [=] { return run_search(*o); }; });
}

}  // namespace ulpgate::app
