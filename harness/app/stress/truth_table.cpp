// print_truth().
#include "harness/app/stress/truth_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <optional>

#include "harness/app/machine/environment.hpp"
#include "harness/app/machine/threads.hpp"
#include "harness/app/shell/failure.hpp"
#include "harness/app/shell/interrupt.hpp"
#include "harness/app/shell/selection.hpp"
#include "harness/core/trajectories/trajectory_engine.hpp"
#include "harness/core/trajectories/truth.hpp"
#include "harness/core/watch/heartbeat.hpp"
#include "reference/types/mpfr_value.hpp"

namespace ulpgate::app {

namespace {

struct Task {
  std::string problem;
  std::string end;
  std::vector<TrueValue> values;
  std::string failure;
  bool done = false;
};

std::vector<Task> chosen_tasks(const std::string& cases) {
  std::vector<std::string> known;
  for (const auto& p : initial_value_problems()) known.push_back(p.name);
  const auto wanted = cases == "all" ? known : split(cases, ',');
  for (const auto& name : wanted) {
    if (std::ranges::find(known, name) == known.end()) unknown_name("initial value problem", name, known);
  }
  std::vector<Task> tasks;
  for (const auto& p : initial_value_problems()) {
    if (std::ranges::find(wanted, p.name) == wanted.end()) continue;
    for (const auto& end : p.ends) tasks.push_back({p.name, end, {}, "", false});
  }
  if (tasks.empty()) throw Failure(Standing::bad_input, "--cases names no initial value problem");
  return tasks;
}

// |published - true|, and that over |true|.
void compare_with_published(const Task& task) {
  for (const auto& p : published_values()) {
    if (p.problem != task.problem || p.end != task.end || p.component >= task.values.size()) continue;
    constexpr mpfr_prec_t bits = 400;
    MpfrValue published(bits);
    MpfrValue exact(bits);
    mpfr_strtofr(published.get(), p.value.c_str(), nullptr, 10, MPFR_RNDN);
    mpfr_strtofr(exact.get(), task.values[p.component].value.c_str(), nullptr, 10, MPFR_RNDN);
    MpfrValue off(bits);
    mpfr_sub(off.get(), published.get(), exact.get(), MPFR_RNDN);
    mpfr_abs(off.get(), off.get(), MPFR_RNDN);
    // An orbit that closes does so to the digits of its constants.
    if (mpfr_cmp_d(off.get(), 1e-24) < 0 && task.problem == "arenstorf") continue;
    MpfrValue relative(bits);
    mpfr_div(relative.get(), off.get(), exact.get(), MPFR_RNDN);
    mpfr_abs(relative.get(), relative.get(), MPFR_RNDN);
    mpfr_log10(relative.get(), relative.get(), MPFR_RNDN);
    const double digits = -mpfr_get_d(relative.get(), MPFR_RNDN);
    if (digits >= 15.3) continue;
    fmt::print(stderr, "ulpgate: {} t = {} component {}: published {} has {:.1f} correct digits ({})\n",
               p.problem, p.end, p.component + 1, p.value, std::max(0.0, digits), p.source);
  }
}

}  // namespace

Verdict print_truth(const std::string& cases, int digits, unsigned threads) {
  std::vector<Task> tasks = chosen_tasks(cases);
  const InterruptGuard guard;
  std::mutex mutex;
  std::size_t next = 0;
  std::size_t printed = 0;
  Verdict verdict;
  // In the order of the list, as far as all before are done.
  const auto print_done = [&] {
    for (; printed < tasks.size() && tasks[printed].done; ++printed) {
      const Task& task = tasks[printed];
      if (!task.failure.empty()) {
        fmt::print(stderr, "ulpgate: {}\n", task.failure);
        verdict.add(Standing::incomplete);
        continue;
      }
      for (std::size_t i = 0; i < task.values.size(); ++i)
        fmt::print("{}\t{}\t{}\t{}\n", task.problem, task.end, i + 1, task.values[i].value);
      std::fflush(stdout);
      compare_with_published(task);
    }
  };
  const auto work = [&](unsigned) {
    const MpfrThread mpfr;
    while (true) {
      std::size_t i = 0;
      {
        const std::scoped_lock lock(mutex);
        if (next >= tasks.size() || interrupted()) return;
        i = next++;
      }
      Task& task = tasks[i];
      const WorkPlace place("the truth of " + task.problem, task.end, "");
      const ode::StopFlag stop(interrupt_flag(), &Heartbeat::mine().steps());
      try {
        in_checked_environment([&] {
          task.values = true_solution(task.problem, task.end, digits, stop);
          return 0;
        });
      } catch (const ode::Stopped&) {
        return;
      } catch (const std::runtime_error& e) {
        task.failure = e.what();
      }
      const std::scoped_lock lock(mutex);
      task.done = true;
      print_done();
    }
  };
  Threads pool(1, threads, work);
  work(0);
  pool.join();
  if (printed < tasks.size()) throw Failure(Standing::incomplete, "interrupted");
  return verdict;
}

}  // namespace ulpgate::app
