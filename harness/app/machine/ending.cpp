// Ending.
#include "harness/app/machine/ending.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <new>
#include <system_error>

#include "harness/app/machine/environment.hpp"
#include "harness/app/machine/watchdog.hpp"
#include "harness/app/shell/failure.hpp"
#include "harness/app/shell/nearest_name.hpp"
#include "reference/lanes/levels.hpp"

namespace ulpgate::app {

Ending end_of(const Action& action, double timeout_s) {
  try {
    assert_floating_point_environment();
    start_watchdog(timeout_s);
    static_cast<void>(instruction_levels());  // a wrong word is told before anything is done
    const Verdict verdict = action();
    check_environment("something in this run");
    // What was written before has left its mark where it failed.
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
      throw Failure(Standing::environment, "cannot write to standard output");
    return {verdict.standing(), ""};
  } catch (const Failure& e) {
    return {e.standing(), e.what()};
  } catch (const UnknownInstructions& e) {
    return {Standing::bad_input, e.what()};
  } catch (const std::bad_alloc&) {
    return {Standing::environment, "out of memory"};
  } catch (const std::system_error& e) {
    return {Standing::environment, fmt::format("the system refuses: {}", e.what())};
  } catch (const std::exception& e) {
    return {Standing::environment, fmt::format("internal error: {}", e.what())};
  }
}

std::string wrong_verb(const CLI::App& app, int argc, const char* const* argv) {
  if (!app.get_subcommands().empty()) return "";
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--timeout" || word == "--patience") ++i;
    if (word.starts_with("-")) continue;
    std::vector<std::string> verbs;
    for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; }))
      verbs.push_back(verb->get_name());
    if (std::ranges::count(verbs, word) != 0) return "";
    return fmt::format("unknown verb '{}'{}", word, nearest_hint(word, verbs));
  }
  return "";
}

}  // namespace ulpgate::app
