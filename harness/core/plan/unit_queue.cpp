// UnitQueue.
#include "harness/core/plan/unit_queue.hpp"

#include <algorithm>

namespace ulpgate {

UnitQueue::UnitQueue(std::vector<bool> done, double patience_s)
    : done_(std::move(done)),
      left_(static_cast<std::size_t>(std::ranges::count(done_, false))),
      patience_s_(patience_s) {}

UnitQueue::Taken UnitQueue::take(Taker taker, double now_s) {
  if (all_done()) return {Answer::all_done};
  while (next_ < done_.size() && done_[next_]) ++next_;
  if (next_ < done_.size()) {
    taken_.push_back({next_, taker, now_s});
    return {Answer::unit, next_++};
  }
  const auto overdue = std::ranges::find_if(
      taken_, [&](const Hold& h) { return h.taker != taker && now_s - h.since_s > patience_s_; });
  if (overdue == taken_.end()) return {Answer::wait};
  const std::size_t position = overdue->position;
  taken_.erase(overdue);
  taken_.push_back({position, taker, now_s});
  return {Answer::unit, position};
}

bool UnitQueue::finish(std::size_t position) {
  std::erase_if(taken_, [&](const Hold& h) { return h.position == position; });
  if (done_[position]) return false;
  done_[position] = true;
  --left_;
  return true;
}

}  // namespace ulpgate
