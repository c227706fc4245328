// StopFlag: how a long integration is ended from outside, by another thread or by a signal.
#pragma once

#include <atomic>
#include <cstdint>
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
  // `looks` counts the looks, for others to see that the integration gets on; one thread uses the flag.
  explicit StopFlag(const std::atomic<bool>& raised, std::atomic<std::uint64_t>* looks = nullptr)
      : raised_(&raised), looks_(looks) {}

  // Cheap enough for every step: a relaxed load, and a store where looks are counted.
  void check() const {
    if (looks_ != nullptr)
      looks_->store(looks_->load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
    if (raised_ != nullptr && raised_->load(std::memory_order_relaxed)) throw Stopped();
  }

 private:
  const std::atomic<bool>* raised_ = nullptr;
  std::atomic<std::uint64_t>* looks_ = nullptr;
};

}  // namespace ulpgate::ode
