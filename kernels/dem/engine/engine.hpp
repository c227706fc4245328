// DemEngine: a simulation behind an interface that knows no number type; values leave as exact text or as
// MPFR.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kernels/dem/step/broad_phase.hpp"
#include "kernels/dem/step/collision_record.hpp"
#include "kernels/dem/step/parts.hpp"
#include "kernels/scenes/reader/scene.hpp"
#include "reference/types/mpfr_value.hpp"

namespace ulpgate::dem {

struct EngineOptions {
  bool all_parts = false;  // nothing is left out; the trajectory is the same to the last bit
  int threads = 1;
  bool allow_large = false;  // more memory than scenes::most_bytes
  // Counted up while a call of step() is under way, by whichever thread gets on: after 4096 pairs and bodies
  // at most, those of several steps together where they are few, and at the end of a call.  Neither
  // the motion of all bodies nor a rebuild of the list of pairs is counted within.  Null where nobody looks.
  std::atomic<std::uint64_t>* progress = nullptr;
  // Keeps a ledger of every collision.  The trajectory is the same to the last bit; without it a step costs
  // nothing more.
  bool collisions = false;
};

// Which of RealHP<1> and RealHP<4> of a token's type.
enum class Level { own = 1, reference = 4 };

// Vectors of a body, three components each; orientation four (w, x, y, z).
enum class BodyQuantity { position, velocity, angular_velocity, orientation };

// Constants of a restored state: the values in the text (widened exactly), or those the engine made itself
// from the scene in its own precision.
enum class Constants { from_text, own };

// A part of a step: a kick or a drift over a fraction of it, as exact text.
struct FlowText {
  bool kick;
  std::string fraction;
};

// What of a state is no finite number: "the velocity", of a body; "the energy account" is of none.
struct NotFinite {
  std::string quantity;
  std::optional<std::size_t> body;

  // "the velocity of body 3"
  [[nodiscard]] std::string text() const {
    return body ? quantity + " of body " + std::to_string(*body) : quantity;
  }
};

// What a rule for the critical step says of a scene.
struct CriticalStep {
  double step_s = 0;    // 0 where nothing limits the step
  std::string refusal;  // why the rule has nothing to say; empty where it has
};

class DemEngine {
 public:
  DemEngine() = default;
  DemEngine(const DemEngine&) = delete;
  DemEngine& operator=(const DemEngine&) = delete;
  virtual ~DemEngine() = default;

  [[nodiscard]] virtual std::string type_name() const = 0;
  virtual void step(std::uint64_t count) = 0;
  // Any number gives the same bits.
  virtual void set_threads(int threads) = 0;
  // A composition method instead of the leapfrog; the given velocities are then those of the start itself.
  // Throws std::invalid_argument where the scene is more than unbreakable bonds and gravity.
  virtual void set_flow(const std::vector<FlowText>& flow) = 0;
  [[nodiscard]] virtual std::uint64_t iteration() const = 0;
  // iteration * dt, rounded to double: for plots and messages.
  [[nodiscard]] virtual double time_s() const = 0;

  [[nodiscard]] virtual std::size_t bodies() const = 0;
  [[nodiscard]] virtual scenes::Shape shape(std::size_t body) const = 0;
  [[nodiscard]] virtual bool is_fixed(std::size_t body) const = 0;
  // Pairs that exert a force, sorted by body numbers.
  [[nodiscard]] virtual std::vector<BodyPair> contacts() const = 0;

  // Components of a quantity: 3, or 4 of an orientation.  A quantity that the scene left out has its constant
  // value: no angular velocity, the orientation of the start.
  [[nodiscard]] virtual double approximate(BodyQuantity q, std::size_t body, std::size_t component) const = 0;
  [[nodiscard]] virtual std::string text(BodyQuantity q, std::size_t body,
                                         std::size_t component) const = 0;  // hexfloat
  // Exact, `out` is given the precision it needs.
  virtual void exact(BodyQuantity q, std::size_t body, std::size_t component, mpfr_ptr out) const = 0;
  [[nodiscard]] virtual double radius(std::size_t body) const = 0;          // m; 0 of flat bodies
  [[nodiscard]] virtual double mass(std::size_t body) const = 0;            // kg
  [[nodiscard]] virtual std::string mass_text(std::size_t body) const = 0;  // hexfloat
  // Corners for drawing: three of a facet, else none.
  [[nodiscard]] virtual std::vector<std::array<double, 3>> corners(std::size_t body) const = 0;
  // kn, ks, cn, cs of a touching pair as the engine holds them (hexfloat, "0x0p+0" where left out).
  [[nodiscard]] virtual std::vector<std::string> contact_constants(BodyPair pair) const = 0;

  // "translational_on_step", "rotational_on_step", "elastic", "potential", "friction", "damping", "viscous",
  // "broken", "work", "sum", in joule; empty where the account is not kept.  They belong to the positions
  // before the last step, with the mean of the half-step velocities around it (the velocity on the step): sum
  // is then constant up to O(dt^2).  Of a composition method they belong to the state itself.
  [[nodiscard]] virtual std::vector<std::string> energy_names() const = 0;
  // Throws std::invalid_argument where no energy has this name.
  [[nodiscard]] virtual double energy(std::string_view name) const = 0;
  virtual void energy_exact(std::string_view name, mpfr_ptr out) const = 0;
  // Kinetic energy of all movable bodies, translation and rotation, in joule, from the velocities as the
  // state holds them; always there.  Those of the leapfrog are half a step before the positions, which is
  // another number than the account's; those of a composition method are of the same instant.
  [[nodiscard]] virtual double kinetic_energy() const = 0;
  virtual void kinetic_energy_exact(mpfr_ptr out) const = 0;
  // Critical steps by name: "stiffness" of the contacts; "p_wave", "rayleigh" of the masses, radii and
  // elastic materials of the spheres, which say nothing where springs come from something else.  Throws
  // std::invalid_argument where no rule has this name.
  [[nodiscard]] virtual CriticalStep critical_step(std::string_view name) const = 0;

  // The first of body numbers whose velocity, position, rotation or kinetic energy is not finite in the type
  // of the run, then the account; nothing of a state that is.  A state that has left the numbers never comes
  // back to them: a velocity and a position that are not finite stay so.
  [[nodiscard]] virtual std::optional<NotFinite> not_finite() const = 0;

  [[nodiscard]] virtual const Parts& explain() const = 0;
  [[nodiscard]] virtual std::size_t memory_bytes() const = 0;
  [[nodiscard]] virtual std::size_t collider_rebuilds() const = 0;

  // Collisions that have ended since the last call, by their last step, then by pair; none where no ledger is
  // kept.  The state holds those that were not taken.
  [[nodiscard]] virtual std::vector<CollisionRecord> take_collisions() = 0;
  // Those that have begun and not ended, by pair.
  [[nodiscard]] virtual std::vector<CollisionRecord> open_collisions() const = 0;

  // The whole state as exact text, with the ledger of collisions where one is kept.  Restored into the same
  // scene and type, also with other threads, a run continues with the same bits.  A higher precision may
  // restore the text of a lower one: every value is widened.
  [[nodiscard]] virtual std::string save() = 0;
  // Throws ArchiveError (archive.hpp) where `state` is not one of this scene; the engine is then unusable.
  virtual void restore(std::string_view state, Constants constants) = 0;
};

// Tokens that were built in.
[[nodiscard]] std::vector<std::string> engine_tokens();

// Null where `token` was not built in.  Throws a scenes::SceneFault where the scene is none in this type.
[[nodiscard]] std::unique_ptr<DemEngine> make_engine(std::string_view token, Level level,
                                                     const scenes::Scene& scene,
                                                     const EngineOptions& options);

}  // namespace ulpgate::dem
