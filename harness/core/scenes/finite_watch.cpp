// FiniteWatch.
#include "harness/core/scenes/finite_watch.hpp"

namespace ulpgate {

namespace {
// Between two states kept: writing one takes far less, and no more than this is taken again.
constexpr std::chrono::seconds between_states{20};
}  // namespace

std::string LostState::text() const {
  return "step " + std::to_string(step) + ": " + what.text() + " is not finite";
}

std::optional<LostState> FiniteWatch::look(dem::DemEngine& engine) {
  const std::uint64_t step = engine.iteration();
  if (const auto found = engine.not_finite()) return locate(step, *found);
  good_step_ = step;
  if (Clock::now() - kept_at_ >= between_states) keep(engine);
  return std::nullopt;
}

void FiniteWatch::keep(dem::DemEngine& engine) {
  kept_state_ = engine.save();
  kept_at_ = Clock::now();
  good_step_ = engine.iteration();
}

LostState FiniteWatch::locate(std::uint64_t lost_by, const dem::NotFinite& found) const {
  const auto again = make_at_start_();
  if (!kept_state_.empty()) again->restore(kept_state_, dem::Constants::from_text);
  if (good_step_ > again->iteration()) again->step(good_step_ - again->iteration());
  while (true) {
    if (const auto lost = again->not_finite()) return {again->iteration(), *lost};
    // Never reached by a simulation that repeats.
    if (again->iteration() >= lost_by) return {lost_by, found};
    again->step(1);
  }
}

}  // namespace ulpgate
