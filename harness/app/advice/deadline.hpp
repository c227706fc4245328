// Deadline: a stop flag that is raised when a time is over, or by Ctrl-C.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "harness/app/shell/interrupt.hpp"

namespace ulpgate::app {

class Deadline {
 public:
  explicit Deadline(double seconds)
      : end_(std::chrono::steady_clock::now() +
             std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                 std::chrono::duration<double>(seconds))),
        watch_([this] { watch(); }) {}
  Deadline(const Deadline&) = delete;
  Deadline& operator=(const Deadline&) = delete;
  ~Deadline() {
    {
      const std::lock_guard lock(mutex_);
      over_ = true;
    }
    changed_.notify_all();
    watch_.join();
  }

  // Outlives what looks at it.
  [[nodiscard]] const std::atomic<bool>& flag() const { return raised_; }

 private:
  void watch() {
    constexpr auto look = std::chrono::milliseconds(50);
    std::unique_lock lock(mutex_);
    while (!over_) {
      const auto now = std::chrono::steady_clock::now();
      if (now >= end_ || interrupted()) raised_.store(true, std::memory_order_relaxed);
      changed_.wait_until(lock, now < end_ ? std::min(end_, now + look) : now + look);
    }
  }

  std::chrono::steady_clock::time_point end_;
  std::atomic<bool> raised_{false};
  std::mutex mutex_;
  std::condition_variable changed_;
  bool over_ = false;
  std::thread watch_;
};

}  // namespace ulpgate::app
