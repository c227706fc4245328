// Watchdog.
#include "harness/app/machine/watchdog.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <system_error>
#include <thread>

#include "harness/app/shell/failure.hpp"
#include "harness/core/watch/heartbeat.hpp"
#include "reference/types/mpfr_value.hpp"

namespace ulpgate::app {

namespace {

using Clock = std::chrono::steady_clock;

void sleep_for(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

// Calls the first `count` points one by one in a thread of its own: the one that it does not get past in
// `patience_s`.  Nothing where all come back: then it was not the argument alone.
std::optional<std::size_t> endless_point(const WorkInHand& work, std::size_t count, double patience_s) {
  const auto at = std::make_shared<std::atomic<std::size_t>>(0);
  try {
    std::thread([&work, count, at] {
      const MpfrThread mpfr;
      for (std::size_t i = 0; i < count; ++i) {
        at->store(i);
        work.repeat(i);
      }
      at->store(count);
    }).detach();
  } catch (const std::system_error&) {
    return std::nullopt;
  }
  constexpr double step_s = 0.01;
  double still_s = 0;
  for (std::size_t before = 0; still_s < patience_s; still_s += step_s) {
    sleep_for(step_s);
    const std::size_t now = at->load();
    if (now == count) return std::nullopt;
    if (now != before) still_s = 0;
    before = now;
  }
  return at->load();
}

std::string sentence(const Stalled& stalled, double timeout_s) {
  const WorkInHand* work = stalled.work;
  const std::size_t count = work == nullptr ? 0 : work->count();
  if (stalled.phase == WorkPhase::reference && stalled.point < count)
    return fmt::format("the reference of {} at {}", stalled.place, work->arguments(stalled.point));
  const std::size_t batch = std::min(stalled.point, count);
  if (batch == 0 || stalled.phase == WorkPhase::none) return stalled.place;
  const std::string among =
      fmt::format("one of {} points from {} to {}", batch, work->arguments(0), work->arguments(batch - 1));
  if (stalled.phase == WorkPhase::references)
    return batch == 1 ? fmt::format("the reference of {} at {}", stalled.place, work->arguments(0))
                      : fmt::format("the reference of {} at {}", stalled.place, among);
  if (batch == 1) return fmt::format("{} at {}", stalled.place, work->arguments(0));
  constexpr double most_patience_s = 5;
  const auto point = endless_point(*work, batch, std::min(timeout_s, most_patience_s));
  return fmt::format("{} at {}", stalled.place, point ? work->arguments(*point) : among);
}

[[noreturn]] void watch_threads(double timeout_s) {
  Watch watch;
  const double pause_s = std::clamp(timeout_s / 20, 1e-3, 0.5);
  for (auto last = Clock::now();;) {
    sleep_for(pause_s);
    const auto now = Clock::now();
    // A program that was stopped, or did not get a processor, has not stood still.
    const double passed_s = std::min(std::chrono::duration<double>(now - last).count(), 2 * pause_s);
    last = now;
    const auto stalled = watch.look(passed_s, timeout_s);
    if (stalled.empty()) continue;
    fmt::print(stderr,
               "ulpgate: {} has not come back in {:g} s; what was finished is kept, --timeout S waits "
               "longer\n",
               sentence(stalled.front(), timeout_s), timeout_s);
    for (std::size_t i = 1; i < stalled.size(); ++i)
      fmt::print(stderr, "ulpgate: nor has {}\n", stalled[i].place);
    ::_exit(exit_code(Standing::environment));
  }
}

}  // namespace

void add_timeout_option(CLI::App& app, double& timeout_s) {
  const auto add = [&](CLI::App& to) {
    to.add_option(
          "--timeout", timeout_s,
          "seconds after which an evaluation that does not come back ends the program with exit code 4")
        ->capture_default_str()
        ->check(CLI::Range(0.01, 1e9));
  };
  add(app);
  for (CLI::App* verb : app.get_subcommands({})) {
    const std::string& name = verb->get_name();
    if (name == "math" || name == "kernels" || name == "integrators" || name == "search") add(*verb);
    if (name != "scene") continue;
    for (CLI::App* what : verb->get_subcommands({})) {
      // The ladder of a scene is of its constants: no step is taken.
      if (what->get_name() != "ladder") add(*what);
    }
  }
}

void start_watchdog(double timeout_s) {
  try {
    std::thread(watch_threads, timeout_s).detach();
  } catch (const std::system_error& e) {
    throw Failure(Standing::environment,
                  fmt::format("cannot start the watchdog's thread: {}", e.code().message()));
  }
}

}  // namespace ulpgate::app
