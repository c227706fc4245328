// Heartbeat.
#include "harness/core/watch/heartbeat.hpp"

#include <algorithm>
#include <chrono>
#include <mutex>
#include <thread>

namespace ulpgate {

namespace {

constinit thread_local std::array<char, 160> place_of_thread{};

// Never destroyed: threads may end after main.
struct Registry {
  std::mutex mutex;
  std::vector<Heartbeat*> hearts;
};
Registry& registry() {
  static auto* all = new Registry;
  return *all;
}

}  // namespace

Heartbeat& Heartbeat::mine() {
  thread_local Heartbeat heart;
  return heart;
}

Heartbeat::Heartbeat() : place_(place_of_thread.data()) {
  static_assert(longest_place == std::tuple_size_v<decltype(place_of_thread)>);
  const std::lock_guard lock(registry().mutex);
  registry().hearts.push_back(this);
}

Heartbeat::~Heartbeat() {
  const std::lock_guard lock(registry().mutex);
  std::erase(registry().hearts, this);
}

// Sequentially consistent, as in Watch::look: either the watch sees the new work, or this thread sees that it
// is condemned and keeps the old one alive.
void Heartbeat::hold(const WorkInHand* work) {
  work_.store(work, std::memory_order_seq_cst);
  beats_.store(beats_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  if (condemned_.load(std::memory_order_seq_cst)) stand_still();
}

void Heartbeat::stand_still() {
  while (true) std::this_thread::sleep_for(std::chrono::hours(1));
}

WorkPlace::WorkPlace(std::string_view subject, std::string_view type, std::string_view part) {
  Heartbeat& heart = Heartbeat::mine();
  std::size_t at = 0;
  for (const auto text : {subject, std::string_view(" "), type, std::string_view(" "), part}) {
    for (const char c : text) {
      if (at + 1 < Heartbeat::longest_place) heart.place_[at++] = c;
    }
  }
  while (at > 0 && heart.place_[at - 1] == ' ') --at;
  heart.place_[at] = '\0';
  heart.beat(WorkPhase::none);
  heart.working_.store(true, std::memory_order_release);
}

WorkPlace::~WorkPlace() {
  Heartbeat& heart = Heartbeat::mine();
  heart.working_.store(false, std::memory_order_relaxed);
  heart.beat(WorkPhase::none);
  heart.place_[0] = '\0';
}

const char* WorkPlace::name() {
  return place_of_thread.data();
}

HandScope::HandScope(const WorkInHand& work)
    : heart_(Heartbeat::mine()), before_(heart_.work_.load(std::memory_order_relaxed)) {
  heart_.hold(&work);
}

HandScope::~HandScope() {
  heart_.hold(before_);
}

std::vector<Stalled> Watch::look(double passed_s, double most_s) {
  std::vector<Stalled> stalled;
  std::vector<Seen> now;
  // Threads leave the registry when they end: none does while it is looked at.
  const std::lock_guard lock(registry().mutex);
  for (Heartbeat* heart : registry().hearts) {
    if (!heart->working_.load(std::memory_order_acquire)) continue;
    Seen seen{heart, heart->beats_.load(std::memory_order_relaxed),
              heart->steps_.load(std::memory_order_relaxed), 0};
    const auto before = std::ranges::find(seen_, static_cast<const Heartbeat*>(heart), &Seen::heart);
    if (before != seen_.end() && before->beats == seen.beats && before->steps == seen.steps)
      seen.still_s = before->still_s + passed_s;
    now.push_back(seen);
    if (seen.still_s < most_s) continue;
    heart->condemned_.store(true, std::memory_order_seq_cst);
    stalled.push_back({heart->place_, heart->phase_.load(std::memory_order_relaxed),
                       heart->point_.load(std::memory_order_relaxed),
                       heart->work_.load(std::memory_order_seq_cst)});
  }
  seen_ = std::move(now);
  return stalled;
}

}  // namespace ulpgate
