// FiniteWatch: finds the step at which the state of a simulation stopped being finite.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "kernels/dem/engine/engine.hpp"

namespace ulpgate {

// The first step after which the state was not finite.
struct LostState {
  std::uint64_t step = 0;
  dem::NotFinite what;

  // "step 12: the velocity of body 3 is not finite"
  [[nodiscard]] std::string text() const;
};

// A state that is lost stays lost, so it is enough to look now and then, at a cost of some operations a body;
// steps themselves are not slowed.  Where a look finds nothing left, the steps since the last look are taken
// again one by one in a second simulation, from a state that is kept in memory from time to time: simulations
// repeat to the last bit.
class FiniteWatch {
 public:
  using Maker = std::function<std::unique_ptr<dem::DemEngine>()>;

  // `make_at_start` makes the simulation watched once more, at its start.
  explicit FiniteWatch(Maker make_at_start) : make_at_start_(std::move(make_at_start)) {}

  // Looks at a simulation that has taken some steps since the last look.
  [[nodiscard]] std::optional<LostState> look(dem::DemEngine& engine);
  // Keeps its state, which is finite, to go back to: one from which a run goes on, say.
  void keep(dem::DemEngine& engine);

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] LostState locate(std::uint64_t lost_by, const dem::NotFinite& found) const;

  Maker make_at_start_;
  std::uint64_t good_step_ = 0;
  std::string kept_state_;  // empty: the start
  Clock::time_point kept_at_ = Clock::now();
};

}  // namespace ulpgate
