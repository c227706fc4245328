// SettingMeasurement: one setting, measured in one piece, and done again for the clock.
#pragma once

#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <stdexcept>

#include "harness/core/orders/measurement.hpp"
#include "harness/core/work_precision/work_precision_row.hpp"

namespace ulpgate {

class SettingMeasurement : public Measurement {
 public:
  explicit SettingMeasurement(WorkSetting setting) : setting_(std::move(setting)) {}

  [[nodiscard]] const WorkSetting& setting() const { return setting_; }
  // Of a measurement that is complete.
  [[nodiscard]] const WorkOutcome& outcome() const { return *outcome_; }
  [[nodiscard]] WorkPrecisionRow row() const { return {setting_, *outcome_}; }

  // The work once more, without what it is held against, and with all made ready that no run can be without
  // and no clock should see.  To be called once or more; throws ode::Stopped.
  using Work = std::function<void(const ode::StopFlag&)>;
  [[nodiscard]] virtual Work prepare() const = 0;
  // What one repeat is divided by: evaluations of a function, 1 of a run.
  [[nodiscard]] virtual std::uint64_t parts_of_repeat() const { return 1; }

  [[nodiscard]] bool complete() const override { return outcome_.has_value(); }
  [[nodiscard]] std::uint64_t steps_done() const override { return complete() ? size() : 0; }
  [[nodiscard]] std::uint64_t expected_steps_left() const override { return complete() ? 0 : size(); }

 protected:
  // A std::runtime_error of it is a refusal.
  [[nodiscard]] virtual WorkOutcome measure(const ode::StopFlag& stop) = 0;
  // What its cost is proportional to, at least 1.
  [[nodiscard]] virtual std::uint64_t size() const { return setting_.steps; }

 private:
  static constexpr std::string_view mark = "o ";  // a piece that begins with "refused" is none of ours

  [[nodiscard]] std::string measure_piece(long /*steps*/, const ode::StopFlag& stop) override {
    try {
      outcome_ = measure(stop);
    } catch (const std::runtime_error& e) {
      outcome_ = WorkOutcome();
      outcome_->failure = WorkFailure::refused;
      outcome_->why = e.what();
    }
    // As a run that goes on would read it.
    const std::string text = outcome_->to_text();
    outcome_ = WorkOutcome::from_text(text);
    return std::string(mark) + text;
  }
  [[nodiscard]] bool take_piece(std::string_view piece) override {
    if (!piece.starts_with(mark)) return false;
    outcome_ = WorkOutcome::from_text(piece.substr(mark.size()));
    return true;
  }

  WorkSetting setting_;
  std::optional<WorkOutcome> outcome_;
};

// A value that several measurements are held against, made by the first that asks; the others wait for it.
template <class T>
class Shared {
 public:
  using Make = std::function<T(const ode::StopFlag&)>;
  explicit Shared(Make make) : make_(std::move(make)) {}

  // Throws what the making threw, to all, and ode::Stopped.
  [[nodiscard]] const T& get(const ode::StopFlag& stop) {
    std::unique_lock lock(mutex_);
    while (state_ == State::in_hand) {
      changed_.wait_for(lock, std::chrono::milliseconds(50));
      stop.check();
    }
    if (state_ == State::absent) make(lock, stop);
    if (failure_) std::rethrow_exception(failure_);
    return *value_;
  }

 private:
  enum class State { absent, in_hand, done };

  void make(std::unique_lock<std::mutex>& lock, const ode::StopFlag& stop) {
    state_ = State::in_hand;
    lock.unlock();
    std::optional<T> made;
    std::exception_ptr failure;
    bool stopped = false;
    try {
      made = make_(stop);
    } catch (const ode::Stopped&) {
      stopped = true;
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    value_ = std::move(made);
    failure_ = failure;
    state_ = stopped ? State::absent : State::done;
    changed_.notify_all();
    if (stopped) throw ode::Stopped();
  }

  Make make_;
  std::mutex mutex_;
  std::condition_variable changed_;
  State state_ = State::absent;
  std::optional<T> value_;
  std::exception_ptr failure_;
};

}  // namespace ulpgate
