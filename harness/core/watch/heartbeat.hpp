// Heartbeat: what each thread works on and whether it gets on, for a watchdog to look at from another thread.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace ulpgate {

// Points in a thread's hands.  All members are called by other threads while that thread stands still.
class WorkInHand {
 public:
  WorkInHand() = default;
  WorkInHand(const WorkInHand&) = delete;
  WorkInHand& operator=(const WorkInHand&) = delete;
  virtual ~WorkInHand() = default;

  [[nodiscard]] virtual std::size_t count() const = 0;
  // The arguments of point i, as `ulpgate at` takes them.
  [[nodiscard]] virtual std::string arguments(std::size_t i) const = 0;
  // Calls the code under test once more, at point i alone.
  virtual void repeat(std::size_t i) const = 0;
};

// What is being computed.
enum class WorkPhase : std::uint8_t {
  none,
  calls,       // the code under test, at some of the points in hand
  reference,   // the reference of one point
  references,  // the reference, at some of the points in hand
};

// One a thread.  The thread itself writes; a beat costs two stores.
class Heartbeat {
 public:
  [[nodiscard]] static Heartbeat& mine();
  Heartbeat(const Heartbeat&) = delete;
  Heartbeat& operator=(const Heartbeat&) = delete;

  // The thread has come this far.  Never returns once the thread was condemned.
  void beat(WorkPhase phase, std::size_t point = 0) {
    phase_.store(phase, std::memory_order_relaxed);
    point_.store(point, std::memory_order_relaxed);
    beats_.store(beats_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
    if (condemned_.load(std::memory_order_relaxed)) stand_still();
  }
  // Counted by others on behalf of this thread, which has neither points nor phases then.
  [[nodiscard]] std::atomic<std::uint64_t>& steps() { return steps_; }

 private:
  friend class WorkPlace;
  friend class HandScope;
  friend class Watch;
  static constexpr std::size_t longest_place = 160;
  Heartbeat();
  ~Heartbeat();
  void hold(const WorkInHand* work);
  [[noreturn]] static void stand_still();

  char* place_;  // plain characters: a signal handler may read nothing else
  std::atomic<bool> working_{false};
  std::atomic<WorkPhase> phase_{WorkPhase::none};
  std::atomic<std::size_t> point_{0};
  std::atomic<std::uint64_t> beats_{0};
  std::atomic<std::uint64_t> steps_{0};
  std::atomic<const WorkInHand*> work_{nullptr};
  std::atomic<bool> condemned_{false};
};

// While alive, this thread works on the named row; a signal handler of the thread may ask which.
class WorkPlace {
 public:
  WorkPlace(std::string_view subject, std::string_view type, std::string_view part);
  WorkPlace(const WorkPlace&) = delete;
  WorkPlace& operator=(const WorkPlace&) = delete;
  ~WorkPlace();
  // Of the calling thread: "sin double uniform", or empty.
  [[nodiscard]] static const char* name();
};

// While alive, this thread has these points in hand.
class HandScope {
 public:
  explicit HandScope(const WorkInHand& work);
  HandScope(const HandScope&) = delete;
  HandScope& operator=(const HandScope&) = delete;
  ~HandScope();

 private:
  Heartbeat& heart_;
  const WorkInHand* before_;
};

// What a thread that stands still was about.
struct Stalled {
  std::string place;
  WorkPhase phase;
  std::size_t point;
  const WorkInHand* work;  // nullptr where it told of none; stays alive, since its thread never leaves it
};

// Looks at all threads again and again; used by one thread.
class Watch {
 public:
  // Names a thread at work that has not got on in `most_s` seconds and condemns it: it will not leave what it
  // has in hand.  `passed_s`: since the last look, as far as this program was running.
  [[nodiscard]] std::vector<Stalled> look(double passed_s, double most_s);

 private:
  struct Seen {
    const Heartbeat* heart;
    std::uint64_t beats;
    std::uint64_t steps;
    double still_s;
  };
  std::vector<Seen> seen_;
};

}  // namespace ulpgate
