// print_truth().
#include "harness/app/stress/truth_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <mutex>
#include <string>
#include <vector>

#include "harness/app/machine/environment.hpp"
#include "harness/app/machine/threads.hpp"
#include "harness/app/shell/failure.hpp"
#include "harness/app/shell/interrupt.hpp"
#include "harness/app/shell/selection.hpp"
#include "harness/core/trajectories/published_values.hpp"
#include "harness/core/trajectories/trajectory_engine.hpp"
#include "harness/core/trajectories/truth.hpp"
#include "harness/core/watch/heartbeat.hpp"

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

// A line for each component of a solution in print, and what they come to.
class PublishedTable {
 public:
  void add(const Task& task) {
    for (const auto& p : published_values()) {
      if (p.problem != task.problem || p.end != task.end) continue;
      const PublishedAgreement a = agreement_with_truth(p, task.values);
      const std::string place = fmt::format("{} t = {} component {}", p.problem, p.end, p.component + 1);
      fmt::print(stderr, "ulpgate: {}: published {} {} ({})\n", place, p.value,
                 words(a, task.values[p.component].value), p.source);
      ++compared_;
      if (a.standing == PublishedStanding::to_the_last) ++to_the_last_;
      if (a.standing == PublishedStanding::wrong) wrong_.push_back(place);
    }
  }
  void print_sum() const {
    if (compared_ == 0) return;
    fmt::print(stderr,
               "ulpgate: of {} published values {} hold to the last digit, {} in part, {} are wrong{}{}\n",
               compared_, to_the_last_, compared_ - to_the_last_ - wrong_.size(), wrong_.size(),
               wrong_.empty() ? "" : ": ", fmt::join(wrong_, ", "));
  }

 private:
  static std::string words(const PublishedAgreement& a, const std::string& truth) {
    if (a.printed == 0 && a.standing == PublishedStanding::to_the_last)
      return fmt::format("holds: the component is {} beside much larger ones", truth);
    const std::string count =
        fmt::format("{:.1f} of {} digits{}", a.digits, a.printed,
                    a.compared < a.printed ? fmt::format(", {} compared", a.compared) : "");
    if (a.standing == PublishedStanding::to_the_last) return "holds to the last digit: " + count;
    if (a.standing == PublishedStanding::in_part) return "holds in part: " + count;
    return fmt::format("is WRONG: {} hold, the truth is {}", count, truth);
  }

  std::size_t compared_ = 0;
  std::size_t to_the_last_ = 0;
  std::vector<std::string> wrong_;
};

}  // namespace

Verdict print_truth(const std::string& cases, int digits, unsigned threads) {
  std::vector<Task> tasks = chosen_tasks(cases);
  const InterruptGuard guard;
  std::mutex mutex;
  std::size_t next = 0;
  std::size_t printed = 0;
  Verdict verdict;
  PublishedTable published;
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
      published.add(task);
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
  published.print_sum();
  if (printed < tasks.size()) throw Failure(Standing::incomplete, "interrupted");
  return verdict;
}

}  // namespace ulpgate::app
