// run_measurements().
#include "harness/app/orders/measurement_run.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <mutex>
#include <numeric>
#include <thread>

#include "harness/app/machine/environment.hpp"
#include "harness/app/machine/threads.hpp"
#include "harness/app/shell/interrupt.hpp"
#include "harness/app/shell/progress.hpp"
#include "harness/core/watch/heartbeat.hpp"
#include "harness/core/watch/stopwatch.hpp"
#include "reference/types/mpfr_value.hpp"

namespace ulpgate::app {

namespace {

// What a killed process may lose of a measurement whose pieces may be of any size.
constexpr double piece_s = 0.5;
constexpr long first_piece_steps = 16;
constexpr long greatest_piece_steps = 1L << 40;

class MeasurementRun {
 public:
  MeasurementRun(const MeasurementJob& job, unsigned threads, PieceLog* log)
      : measurements_(job.measurements),
        names_(job.names),
        threads_(threads),
        log_(log),
        costs_(with_points(job)),
        progress_(job.name) {
    if (log_ != nullptr) log_->restore([&](const PieceLog::Piece& piece) { return take(piece); });
    before_s_ = costs_.spent_s();
    // The longest first: what is left at the end is short, and no thread waits long for another.
    queue_.resize(measurements_.size());
    std::iota(queue_.begin(), queue_.end(), std::size_t{0});
    std::erase_if(queue_, [&](std::size_t i) { return measurements_[i]->complete(); });
    std::ranges::stable_sort(queue_, std::ranges::greater{}, [&](std::size_t i) {
      return job.costs[i].prior * static_cast<double>(measurements_[i]->expected_steps_left());
    });
  }

  // Until nothing is left for this thread.
  void work() {
    const MpfrThread mpfr;
    try {
      while (const auto i = next()) measure(*i);
    } catch (const ode::Stopped&) {
      return;
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
      interrupt();
    }
  }

  // All threads are back.
  [[nodiscard]] bool finish() const {
    if (failure_) std::rethrow_exception(failure_);
    return std::ranges::all_of(measurements_, [](const auto& m) { return m->complete(); });
  }

 private:
  static std::vector<CostModel::Row> with_points(const MeasurementJob& job) {
    std::vector<CostModel::Row> rows = job.costs;
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i].points = job.measurements[i]->expected_steps_left();
    return rows;
  }

  std::optional<std::size_t> next() {
    const std::lock_guard lock(mutex_);
    if (next_ >= queue_.size() || interrupted()) return std::nullopt;
    return queue_[next_++];
  }

  void measure(std::size_t i) {
    Measurement& m = *measurements_[i];
    const WorkPlace place(names_[i], "", "");
    const ode::StopFlag stop(interrupt_flag(), &Heartbeat::mine().steps());
    for (long steps = first_piece_steps; !m.complete();) {
      const auto start = Clock::now();
      const auto before = m.steps_done();
      const std::string text = in_checked_environment([&] { return m.proceed(steps, stop); });
      const double seconds = seconds_since(start);
      keep({i, seconds, text}, m.steps_done() - before);
      if (seconds < piece_s / 2)
        steps = std::min(greatest_piece_steps, steps * (seconds < piece_s / 16 ? 8 : 2));
      if (seconds > piece_s * 2) steps = std::max(1L, steps / 2);
    }
  }

  bool take(const PieceLog::Piece& piece) {
    if (piece.measurement >= measurements_.size()) return false;
    Measurement& m = *measurements_[piece.measurement];
    const auto before = m.steps_done();
    if (!m.take(piece.text)) return false;
    count(piece, m.steps_done() - before);
    return true;
  }

  void count(const PieceLog::Piece& piece, std::uint64_t steps) {
    costs_.add(piece.measurement, steps, piece.seconds);
    if (measurements_[piece.measurement]->complete()) costs_.drop(piece.measurement);
  }

  void keep(const PieceLog::Piece& piece, std::uint64_t steps) {
    const std::lock_guard lock(mutex_);
    if (log_ != nullptr) log_->append(piece);
    count(piece, steps);
    if (!progress_.is_due()) return;
    const double left_s = costs_.remaining_s();
    // Threads share cores with each other and with other programs: what a second brought so far counts.
    const double elapsed_s = seconds_since(start_);
    const double speed = elapsed_s > 1 ? (costs_.spent_s() - before_s_) / elapsed_s : threads_;
    progress_.update(costs_.spent_s(), costs_.spent_s() + left_s, left_s / std::max(speed, 1e-3));
  }

  const std::vector<std::unique_ptr<Measurement>>& measurements_;
  const std::vector<std::string>& names_;
  double threads_;
  PieceLog* log_;
  CostModel costs_;
  Progress progress_;
  std::vector<std::size_t> queue_;
  std::size_t next_ = 0;
  double before_s_ = 0;
  Clock::time_point start_ = Clock::now();
  std::mutex mutex_;
  std::exception_ptr failure_;
};

}  // namespace

bool run_measurements(const MeasurementJob& job, unsigned threads, PieceLog* log) {
  const InterruptGuard guard;
  MeasurementRun run(job, threads, log);
  Threads pool(1, threads, [&](unsigned) { run.work(); });
  run.work();
  pool.join();
  return run.finish();
}

}  // namespace ulpgate::app
