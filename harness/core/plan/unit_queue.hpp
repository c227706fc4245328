// UnitQueue: which units of a run are still to be taken, who has which, and which are given once more because
// their taker is silent.
#pragma once

#include <cstddef>
#include <vector>

namespace ulpgate {

// Who takes a unit: a thread or a rank.
using Taker = std::size_t;

class UnitQueue {
 public:
  enum class Answer {
    unit,      // here is one
    wait,      // all are taken, some are not finished
    all_done,  // nothing will come any more
  };
  struct Taken {
    Answer answer;
    std::size_t position = 0;  // of a unit
  };

  // `done` by position: the units that need no work.  A unit that was taken more than `patience_s` seconds
  // ago may be taken again by another taker: to work on a unit twice costs time, and changes nothing.
  UnitQueue(std::vector<bool> done, double patience_s);

  // Units in order, then the longest taken one of those that are overdue.  `now_s` never decreases.
  [[nodiscard]] Taken take(Taker taker, double now_s);
  // False where the unit was finished before: its result counts once.
  bool finish(std::size_t position);
  [[nodiscard]] bool is_done(std::size_t position) const { return done_[position]; }
  [[nodiscard]] bool all_done() const { return left_ == 0; }

 private:
  struct Hold {
    std::size_t position;
    Taker taker;
    double since_s;
  };
  std::vector<bool> done_;
  std::vector<Hold> taken_;  // oldest first
  std::size_t next_ = 0;
  std::size_t left_ = 0;
  double patience_s_;
};

}  // namespace ulpgate
