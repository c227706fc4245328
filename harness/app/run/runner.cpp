// Runner.
#include "harness/app/run/runner.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <exception>
#include <limits>
#include <memory>
#include <mutex>
#include <thread>

#include "harness/app/machine/environment.hpp"
#include "harness/app/machine/threads.hpp"
#include "harness/app/shell/failure.hpp"
#include "harness/app/shell/interrupt.hpp"
#include "harness/app/shell/progress.hpp"
#include "harness/core/stages/finding.hpp"
#include "harness/core/watch/heartbeat.hpp"
#include "harness/core/watch/stopwatch.hpp"
#include "harness/foreign/foreign_failure.hpp"

namespace ulpgate::app {

namespace {

// Merges what the units give, keeps them and shows the progress; the first failure ends the run.
class Collector {
 public:
  Collector(const UnitJob& job, const ShardUnits& units, unsigned threads, Checkpoint& checkpoint)
      : job_(job),
        units_(units),
        threads_(threads),
        checkpoint_(checkpoint),
        costs_(rows_with_points(job, units)),
        progress_(job.name),
        found_(units.size(), job.rows.size()) {
    checkpoint_.restore(units_, found_);
    for (std::size_t row = 0; row < found_.rows.size(); ++row)
      if (found_.rows[row].points > 0) costs_.add(row, found_.rows[row].points, found_.rows[row].seconds);
    before_s_ = costs_.spent_s();
  }

  // A few points of every function and type tell the time left before whole units have been measured.
  void try_costs() {
    if (!progress_.is_shown()) return;
    const auto start = Clock::now();
    for (std::size_t p = 0; p < units_.size() && !interrupted() && seconds_since(start) < 3; ++p) {
      WorkUnit unit = units_[p];
      if (found_.done[p] || costs_.is_known(unit.row)) continue;
      unit.last = std::min(unit.last, unit.first + 4);
      const auto begin = Clock::now();
      static_cast<void>(job_.evaluate(unit));
      costs_.add_trial(unit.row, unit.last - unit.first, seconds_since(begin));
    }
    start_ = Clock::now();
  }

  [[nodiscard]] const std::vector<bool>& done() const { return found_.done; }

  void add(std::size_t position, const std::vector<Summary>& summaries, double seconds) {
    const std::lock_guard lock(mutex_);
    const std::size_t row = units_[position].row;
    found_.rows[row].add(summaries, seconds, units_.points(position));
    found_.done[position] = true;
    checkpoint_.append(position, seconds, summaries, units_, found_);
    costs_.add(row, units_.points(position), seconds);
    if (!progress_.is_due()) return;
    const double left_s = costs_.remaining_s();
    // Threads share cores with each other and with other programs: what a second brought so far counts.
    const double elapsed_s = seconds_since(start_);
    const double speed = elapsed_s > 1 ? (costs_.spent_s() - before_s_) / elapsed_s : threads_;
    progress_.update(costs_.spent_s(), costs_.spent_s() + left_s, left_s / std::max(speed, 1e-3));
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
        throw Failure(Standing::regression, e.what());
      } catch (const ForeignHangs& e) {
        throw Failure(Standing::regression, e.what());
      } catch (const ForeignFailure& e) {
        throw Failure(Standing::environment, e.what());
      }
    }
    UnitSummaries result;
    result.complete = !interrupted();
    for (auto& row : found_.rows) result.rows.push_back(std::move(row.parts));
    return result;
  }

 private:
  static std::vector<CostModel::Row> rows_with_points(const UnitJob& job, const ShardUnits& units) {
    std::vector<CostModel::Row> rows = job.rows;
    for (auto& row : rows) row.points = 0;
    for (std::size_t p = 0; p < units.size(); ++p) rows[units[p].row].points += units.points(p);
    return rows;
  }

  const UnitJob& job_;
  const ShardUnits& units_;
  double threads_;
  Checkpoint& checkpoint_;
  CostModel costs_;
  Progress progress_;
  UnitProgress found_;
  double before_s_ = 0;
  Clock::time_point start_ = Clock::now();
  std::mutex mutex_;
  std::exception_ptr failure_;
  std::atomic<bool> failed_{false};
};

// Hands the units out, to threads and to ranks.
class Exchange : public UnitExchange {
 public:
  Exchange(Collector& collector, double patience_s)
      : collector_(collector), queue_(collector.done(), patience_s) {}

  UnitQueue::Taken take(Taker taker) override {
    const std::lock_guard lock(mutex_);
    if (stopped()) return {UnitQueue::Answer::all_done};
    return queue_.take(taker, seconds_since(start_));
  }
  void finish(std::size_t position, double seconds, const std::vector<Summary>& summaries) override {
    const std::lock_guard lock(mutex_);
    // Only a unit that is kept is done.
    if (queue_.is_done(position)) return;
    collector_.add(position, summaries, seconds);
    queue_.finish(position);
  }
  void fail(std::exception_ptr failure) override { collector_.fail(std::move(failure)); }
  bool over() override {
    const std::lock_guard lock(mutex_);
    return stopped() || queue_.all_done();
  }

 private:
  [[nodiscard]] bool stopped() const { return interrupted() || collector_.failed(); }

  Collector& collector_;
  UnitQueue queue_;
  Clock::time_point start_ = Clock::now();
  std::mutex mutex_;
};

class PlanUnits {
 public:
  PlanUnits(const Plan& plan, const Shard& shard, ReferenceMode mode) : plan_(plan), mode_(mode) {
    std::vector<std::vector<RowHint::Range>> ranges(plan.rows().size());
    const ShardUnits units{plan.units(), shard.index, shard.count};
    for (std::size_t i = 0; i < units.size(); ++i)
      ranges[units[i].row].push_back({units[i].first, units[i].last});
    for (std::size_t row = 0; row < plan.rows().size(); ++row) {
      hints_.push_back(std::make_unique<RowHint>(plan.rows()[row].subject->info().parts.size(), ranges[row]));
    }
  }
  [[nodiscard]] std::vector<Summary> evaluate(const WorkUnit& unit) const {
    const PlanRow& row = plan_.rows()[unit.row];
    const WorkPlace place(row.subject->name(), row.subject->type().token, name_of(row.source.stratum));
    return in_checked_environment(
        [&] { return row.subject->evaluate(row.source, unit.first, unit.last, mode_, *hints_[unit.row]); });
  }
  [[nodiscard]] std::array<std::uint64_t, stage_count> decided() const {
    std::array<std::uint64_t, stage_count> sum{};
    for (const auto& hint : hints_)
      for (std::size_t stage = 0; stage < stage_count; ++stage) sum[stage] += hint->decided[stage];
    return sum;
  }

 private:
  const Plan& plan_;
  ReferenceMode mode_;
  std::vector<std::unique_ptr<RowHint>> hints_;
};

}  // namespace

double prior_cost(const RealDescriptor& type) {
  return std::pow(static_cast<double>(type.reference_bits), 1.5);
}

UnitSummaries run_units(const UnitJob& job, const Shard& shard, unsigned threads, Checkpoint& checkpoint,
                        Ranks* ranks) {
  const ShardUnits units{job.units, shard.index, shard.count};
  const InterruptGuard guard;
  Collector collector(job, units, threads, checkpoint);
  collector.try_costs();
  Exchange exchange(collector,
                    ranks != nullptr ? ranks->patience_s() : std::numeric_limits<double>::infinity());
  const auto work = [&](Taker self) {
    const MpfrThread mpfr;
    while (true) {
      const auto taken = exchange.take(self);
      if (taken.answer == UnitQueue::Answer::wait && ranks != nullptr) {
        // What another rank has may yet be given to this one.
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        continue;
      }
      if (taken.answer != UnitQueue::Answer::unit) break;
      try {
        const auto start = Clock::now();
        const auto summaries = job.evaluate(units[taken.position]);
        exchange.finish(taken.position, seconds_since(start), summaries);
      } catch (...) {
        exchange.fail(std::current_exception());
      }
    }
  };
  // Ranks are takers by their number, threads count from behind.
  const Taker last = std::numeric_limits<Taker>::max();
  Threads pool(ranks != nullptr ? 0U : 1U, threads, [&](unsigned t) { work(last - t); });
  if (ranks != nullptr) {
    ranks->serve(exchange, checkpoint.identity());
  } else {
    work(last);
  }
  pool.join();
  return collector.take();
}

RunResult run_plan(const Plan& plan, const Shard& shard, unsigned threads, ReferenceMode mode,
                   Checkpoint& checkpoint, Ranks* ranks) {
  const PlanUnits units(plan, shard, mode);
  // Rows of one subject stand together.
  std::vector<CostModel::Row> costs;
  std::size_t group = 0;
  for (std::size_t i = 0; i < plan.rows().size(); ++i) {
    const PlanRow& row = plan.rows()[i];
    if (i > 0 && row.subject != plan.rows()[i - 1].subject) ++group;
    costs.push_back({group, prior_cost(row.subject->type()), 0});
  }
  const UnitJob job{plan.request().kind == SubjectKind::function ? "math" : "kernels", plan.units(),
                    std::move(costs), [&](const WorkUnit& unit) { return units.evaluate(unit); }};
  const UnitSummaries done = run_units(job, shard, threads, checkpoint, ranks);
  RunResult result;
  result.complete = done.complete;
  result.decided = units.decided();
  for (std::size_t i = 0; i < done.rows.size(); ++i) {
    if (done.rows[i].empty()) continue;
    for (auto& record : finish_row(plan, plan.rows()[i], done.rows[i]))
      result.records.push_back(std::move(record));
  }
  return result;
}

void help_plan(const Plan& plan, const Shard& shard, ReferenceMode mode, const RunIdentity& identity,
               Ranks& ranks) {
  const PlanUnits units(plan, shard, mode);
  const InterruptGuard guard;
  ranks.help(identity, {plan.units(), shard.index, shard.count},
             [&](const WorkUnit& unit) { return units.evaluate(unit); });
}

}  // namespace ulpgate::app
