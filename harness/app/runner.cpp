// Runner.
#include "harness/app/runner.hpp"

#include <atomic>
#include <cmath>
#include <csignal>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>

#include "harness/app/crash_report.hpp"
#include "harness/app/failure.hpp"
#include "harness/app/progress.hpp"
#include "harness/core/reference_disagreement.hpp"

namespace ulpgate::app {

namespace {

std::atomic<bool> interrupted{false};

void on_interrupt(int) {
  interrupted.store(true, std::memory_order_relaxed);
}

// Ctrl-C and SIGTERM end the run after the units in hand; what is done is still written.
class InterruptGuard {
 public:
  InterruptGuard() : int_(std::signal(SIGINT, on_interrupt)), term_(std::signal(SIGTERM, on_interrupt)) {
    interrupted = false;
  }
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
  ~InterruptGuard() {
    std::signal(SIGINT, int_);
    std::signal(SIGTERM, term_);
  }

 private:
  void (*int_)(int);
  void (*term_)(int);
};

// Rough cost of a unit, for the progress bar alone: grows with the digits of the reference.
double cost(const Plan& plan, const WorkUnit& u) {
  const PlanRow& row = plan.rows()[u.row];
  return static_cast<double>(u.last - u.first) *
         std::pow(static_cast<double>(row.engine->descriptor().reference_bits), 1.5);
}

}  // namespace

RunResult run_plan(const Plan& plan, const Shard& shard, unsigned threads, ReferenceMode mode) {
  std::vector<WorkUnit> mine;
  double total = 0;
  for (std::size_t i = shard.index; i < plan.units().size(); i += shard.count) {
    mine.push_back(plan.units()[i]);
    total += cost(plan, mine.back());
  }
  struct Row {
    std::vector<Summary> summaries;
    std::unique_ptr<RowHint> hint;
  };
  std::vector<Row> rows(plan.rows().size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const int parts = plan.rows()[i].function.parts;
    rows[i].summaries.resize(static_cast<std::size_t>(parts));
    rows[i].hint = std::make_unique<RowHint>(parts);
  }

  const InterruptGuard guard;
  Progress progress("math");
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  double done = 0;
  std::exception_ptr failure;  // of the first unit that failed; the others end
  const auto evaluate = [&](const WorkUnit& unit, const PlanRow& row) {
    try {
      return row.engine->evaluate(row.function, row.source, unit.first, unit.last, mode,
                                  *rows[unit.row].hint);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!failure) failure = std::current_exception();
      next = mine.size();
      return std::vector<Summary>();
    }
  };
  const auto work = [&] {
    const MpfrThread mpfr;
    for (std::size_t i = next++; i < mine.size() && !interrupted; i = next++) {
      const WorkUnit& unit = mine[i];
      const PlanRow& row = plan.rows()[unit.row];
      const CrashPlace place(row.function.name, row.engine->descriptor().token, name_of(row.source.stratum));
      const auto summaries = evaluate(unit, row);
      const std::lock_guard lock(mutex);
      for (std::size_t part = 0; part < summaries.size(); ++part)
        rows[unit.row].summaries[part].merge(summaries[part]);
      done += cost(plan, unit);
      progress.update(done, total);
    }
  };
  std::vector<std::thread> pool;
  for (unsigned t = 1; t < threads; ++t) pool.emplace_back(work);
  work();
  for (auto& t : pool) t.join();
  if (failure) {
    try {
      std::rethrow_exception(failure);
    } catch (const ReferenceDisagreement& e) {
      throw Failure(ExitCode::regression, e.what());
    }
  }

  RunResult result;
  result.complete = !interrupted;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].summaries[0].samples == 0) continue;
    for (auto& record : finish_row(plan, plan.rows()[i], rows[i].summaries))
      result.records.push_back(std::move(record));
  }
  return result;
}

}  // namespace ulpgate::app
