// StopFlag: how a long integration is ended from outside, by another thread or by a signal.
#pragma once

#include <atomic>
#include <exception>

namespace ulpgate::ode {

// Thrown out of an integration that was told to stop; its stepper is of no use then.
class Stopped final : public std::exception {
 public:
  [[nodiscard]] const char* what() const noexcept override { return "the integration was stopped"; }
};

// Looks at a flag that others raise; one made without a flag never stops anything.
class StopFlag {
 public:
  StopFlag() = default;
  explicit StopFlag(const std::atomic<bool>& raised) : raised_(&raised) {}

  // Cheap enough for every step: one relaxed load.
  void check() const {
    if (raised_ != nullptr && raised_->load(std::memory_order_relaxed)) throw Stopped();
  }

 private:
  const std::atomic<bool>* raised_ = nullptr;
};

}  // namespace ulpgate::ode
