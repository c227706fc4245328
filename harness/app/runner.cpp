// Runner.
#include "harness/app/runner.hpp"

#include <atomic>
#include <cmath>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>

#include "harness/app/crash_report.hpp"
#include "harness/app/failure.hpp"
#include "harness/app/interrupt.hpp"
#include "harness/app/progress.hpp"
#include "harness/core/reference_disagreement.hpp"

namespace ulpgate::app {

namespace {

// Merges what the units give; the first failure ends the run.
class Collector {
 public:
  Collector(const UnitJob& job, double total) : job_(job), total_(total), progress_(job.name) {
    result_.rows.resize(job.rows);
  }

  void add(const WorkUnit& unit, const std::vector<Summary>& summaries) {
    const std::lock_guard lock(mutex_);
    auto& row = result_.rows[unit.row];
    row.resize(summaries.size());
    for (std::size_t part = 0; part < summaries.size(); ++part) row[part].merge(summaries[part]);
    done_ += job_.cost(unit);
    progress_.update(done_, total_);
  }
  void fail(std::exception_ptr failure) {
    const std::lock_guard lock(mutex_);
    if (!failure_) failure_ = std::move(failure);
    failed_ = true;
  }
  [[nodiscard]] bool failed() const { return failed_; }

  UnitSummaries take() {
    if (failure_) {
      try {
        std::rethrow_exception(failure_);
      } catch (const ReferenceDisagreement& e) {
        throw Failure(ExitCode::regression, e.what());
      }
    }
    result_.complete = !interrupted();
    return std::move(result_);
  }

 private:
  const UnitJob& job_;
  double total_;
  double done_ = 0;
  Progress progress_;
  std::mutex mutex_;
  std::exception_ptr failure_;
  std::atomic<bool> failed_{false};
  UnitSummaries result_;
};

}  // namespace

UnitSummaries run_units(const UnitJob& job, const Shard& shard, unsigned threads) {
  std::vector<WorkUnit> mine;
  double total = 0;
  for (std::size_t i = shard.index; i < job.units.size(); i += shard.count) {
    mine.push_back(job.units[i]);
    total += job.cost(mine.back());
  }
  const InterruptGuard guard;
  Collector collector(job, total);
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    const MpfrThread mpfr;
    for (std::size_t i = next++; i < mine.size() && !interrupted() && !collector.failed(); i = next++) {
      try {
        collector.add(mine[i], job.evaluate(mine[i]));
      } catch (...) {
        collector.fail(std::current_exception());
      }
    }
  };
  std::vector<std::thread> pool;
  for (unsigned t = 1; t < threads; ++t) pool.emplace_back(work);
  work();
  for (auto& t : pool) t.join();
  return collector.take();
}

RunResult run_plan(const Plan& plan, const Shard& shard, unsigned threads, ReferenceMode mode) {
  std::vector<std::unique_ptr<RowHint>> hints;
  for (const auto& row : plan.rows()) hints.push_back(std::make_unique<RowHint>(row.function.parts));
  const UnitJob job{
      "math", plan.units(), plan.rows().size(),
      [&](const WorkUnit& unit) {
        const PlanRow& row = plan.rows()[unit.row];
        const CrashPlace place(row.function.name, row.engine->descriptor().token,
                               name_of(row.source.stratum));
        return row.engine->evaluate(row.function, row.source, unit.first, unit.last, mode, *hints[unit.row]);
      },
      [&](const WorkUnit& unit) {
        // Grows with the digits of the reference.
        const auto bits = static_cast<double>(plan.rows()[unit.row].engine->descriptor().reference_bits);
        return static_cast<double>(unit.last - unit.first) * std::pow(bits, 1.5);
      }};
  const UnitSummaries done = run_units(job, shard, threads);
  RunResult result;
  result.complete = done.complete;
  for (std::size_t i = 0; i < done.rows.size(); ++i) {
    if (done.rows[i].empty()) continue;
    for (auto& record : finish_row(plan, plan.rows()[i], done.rows[i]))
      result.records.push_back(std::move(record));
  }
  return result;
}

}  // namespace ulpgate::app
