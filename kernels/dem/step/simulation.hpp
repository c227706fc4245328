// Simulation<Real>: the DEM step over a scene, with the parts that the scene needs, on any number of threads.
//
// Order of a step: forces := 0; collider; contacts in the order of their bodies' numbers: geometry, physics
// of new ones, law; integration.  A body's force is the sum over its contacts in that order whatever the
// number of threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <optional>

#include "kernels/dem/step/bond_step.hpp"
#include "kernels/dem/step/collider.hpp"
#include "kernels/dem/step/collision_ledger.hpp"
#include "kernels/dem/step/contact_pass.hpp"
#include "kernels/dem/step/integrate.hpp"
#include "kernels/dem/step/load_scene.hpp"

namespace ulpgate::dem {

struct SimulationOptions {
  bool all_parts = false;  // nothing is left out; the trajectory is the same to the last bit
  int threads = 1;
  bool allow_large = false;                        // more memory than scenes::most_bytes
  std::atomic<std::uint64_t>* progress = nullptr;  // counted up while steps are taken, by any thread
  bool collisions = false;                         // a ledger of collisions is kept; the same trajectory
};

template <RealType Real>
class Simulation {
 public:
  Simulation(const scenes::Scene& scene, const SimulationOptions& options)
      : s_(load_scene<Real>(scene, options.all_parts, options.allow_large)), progress_(options.progress) {
    collider_.limit_pairs(scenes::pairs_allowed<Real>(options.allow_large));
    if (options.collisions) ledger_.emplace();
    set_threads(options.threads);
  }

  // Takes `count` steps.
  void step(std::uint64_t count) {
    // Broken rods may collide, which only the general step sees; a flow has none.
    const bool looked_at = ledger_ && flow_.empty();
    if (s_.parts.bonds_alone() && !s_.parts.moments && !collider_.started() && !looked_at) {
      // In parts, between which it tells that it gets on; their lengths change no bit.
      const std::uint64_t part = std::max<std::uint64_t>(1, work_between_counts / (s_.bonds.size() + 1));
      for (std::uint64_t left = count; left > 0;) {
        const std::uint64_t taken = std::min(left, part);
        run_bonds_alone(s_, taken, flow_);
        got_on();
        left -= taken;
      }
      return;
    }
    for (std::uint64_t left = count; left > 0;) {
      // Few pairs and bodies are counted over several steps: an atomic operation in each would be a tenth of
      // it.
      const std::uint64_t work = s_.contacts.size() + s_.bodies.size() + 1;
      const std::uint64_t taken = std::min(left, std::max<std::uint64_t>(1, work_between_counts / work));
      if (ledger_) {
        for (std::uint64_t i = 0; i < taken; ++i) step_once<true>();
      } else {
        for (std::uint64_t i = 0; i < taken; ++i) step_once<false>();
      }
      got_on();
      left -= taken;
    }
  }

  // Kicks and drifts of a composition method instead of the leapfrog.  Throws std::invalid_argument where the
  // scene is more than bonds and gravity.
  void set_flow(std::vector<FlowPart<Real>> flow) {
    if (!s_.parts.bonds_alone() || s_.parts.moments || !account_forgets(s_)) {
      throw std::invalid_argument(
          "only the leapfrog integrates this scene: others need unbreakable bonds alone, at rest or free, "
          "without damping, shear, rotation and moments, and no --all-parts");
    }
    flow_ = std::move(flow);
  }

  void set_threads(int threads) {
    threads_ = std::max(1, threads);
    collider_.restart();
  }

  [[nodiscard]] const SimulationState<Real>& state() const { return s_; }
  [[nodiscard]] std::size_t rebuilds() const { return collider_.rebuilds(); }
  [[nodiscard]] const Parts& parts() const { return s_.parts; }
  // Pairs of bodies that exert a force on each other, sorted.
  [[nodiscard]] std::vector<BodyPair> touching_pairs() const {
    std::vector<BodyPair> pairs;
    for (std::size_t p = 0; p < s_.contacts.size(); ++p) {
      if (s_.contacts.touching[p] != 0) pairs.push_back(s_.contacts.pair[p]);
    }
    return pairs;
  }

  // The whole state as exact text; restoring it, also into a higher precision, continues with the same bits.
  [[nodiscard]] std::string save() {
    ArchiveWriter<Real> archive;
    visit_state(archive, s_);
    if (ledger_) ledger_->visit(archive);
    return std::move(archive).text();
  }
  // Throws ArchiveError where `text` is not a state of this scene.  The state is then unspecified.
  void restore(std::string_view text, bool take_constants) {
    ArchiveReader<Real> archive(text, take_constants);
    visit_state(archive, s_);
    if (ledger_) {
      ledger_->visit(archive);
      ledger_->check(s_.bodies.size());
    }
    measure_mesh(s_);
    if (!archive.at_end()) throw ArchiveError("text is left over behind the state");
    collider_.restart();
  }

  // Collisions that have ended since the last call, and those that have not; none where no ledger is kept.
  [[nodiscard]] std::vector<CollisionRecord> take_collisions() {
    return ledger_ ? ledger_->take(s_.dt) : std::vector<CollisionRecord>();
  }
  [[nodiscard]] std::vector<CollisionRecord> open_collisions() const {
    return ledger_ ? ledger_->open(s_.iteration, s_.dt) : std::vector<CollisionRecord>();
  }

  // Bytes of the arrays of the state.
  [[nodiscard]] std::size_t memory() const {
    return memory_of(s_) + collider_.memory() + slots_.capacity() * sizeof(PairForce<Real>) +
           (ledger_ ? ledger_->memory() : 0);
  }

 private:
  static constexpr std::uint64_t work_between_counts = 4096;  // pairs and bodies

  void got_on() {
    if (progress_ != nullptr) progress_->fetch_add(1, std::memory_order_relaxed);
  }

  // Without a ledger a step knows nothing of one.
  template <bool Ledger>
  void step_once() {
    // The ledger wants the force of every pair, as threads do.
    const bool by_slots = Ledger || threads_ > 1;
    collider_.update(s_, by_slots);
    const ContactPass<Real> pass = contact_pass_of(s_, collider_.coarse());
    if (!s_.mesh.empty()) s_.contacts.touched_before = s_.contacts.touching;
    if (s_.parts.energy) clear_losses(s_.contacts);
    if (by_slots) {
      contacts_by_slots(pass);
      if constexpr (Ledger) ledger_->look(s_, pass, slots_, active_);
    } else {
      contacts_serial(pass);
    }
    const bool moved = integrate(s_, threads_, collider_);
    if (moved) collider_.outdate();
    ++s_.iteration;
  }

  void contacts_serial(const ContactPass<Real>& pass) {
    Bodies<Real>& b = s_.bodies;
    PairForce<Real> f;
    const std::size_t count = s_.contacts.size();
    for (std::size_t p = 0; p < count; ++p) {
      if ((p + 1) % work_between_counts == 0) got_on();
      if (!pass.evaluate(p, f)) continue;
      const auto i1 = static_cast<std::size_t>(f.first);
      const auto i2 = static_cast<std::size_t>(f.second);
      b.force[i1] -= f.force;
      b.force[i2] += f.force;
      if (s_.parts.rotation) {
        b.torque[i1] += f.torque1;
        b.torque[i2] += f.torque2;
      }
    }
  }

  // Every pair writes its own slot, then every body sums its slots in the order of the pairs: the serial
  // order.  Shares are fixed, so that a thread finds most slots and bodies in its own cache: pairs are in the
  // order of their bodies.
  void contacts_by_slots(const ContactPass<Real>& pass) {
    const auto count = static_cast<std::int64_t>(s_.contacts.size());
    if (slots_.size() < s_.contacts.size()) {
      slots_.resize(s_.contacts.size());
      active_.resize(s_.contacts.size());
    }
    Bodies<Real>& b = s_.bodies;
    const auto bodies = static_cast<std::int64_t>(b.size());
#pragma omp parallel num_threads(threads_)
    {
#pragma omp for schedule(static)
      for (std::int64_t k = 0; k < count; ++k) {
        const auto p = static_cast<std::size_t>(k);
        if ((p + 1) % work_between_counts == 0) got_on();
        active_[p] = pass.evaluate(p, slots_[p]) ? 1 : 0;
      }
#pragma omp for schedule(static)
      for (std::int64_t k = 0; k < bodies; ++k) {
        const auto i = static_cast<std::size_t>(k);
        for (const std::int32_t entry : collider_.pairs_of(i)) {
          const auto p = static_cast<std::size_t>(entry);
          if (active_[p] == 0) continue;
          const PairForce<Real>& f = slots_[p];
          const bool is_first = f.first == static_cast<std::int32_t>(i);
          if (is_first) {
            b.force[i] -= f.force;
          } else {
            b.force[i] += f.force;
          }
          if (s_.parts.rotation) b.torque[i] += is_first ? f.torque1 : f.torque2;
        }
      }
    }
  }

  SimulationState<Real> s_;
  Collider<Real> collider_;
  int threads_ = 1;
  std::atomic<std::uint64_t>* progress_;
  std::optional<CollisionLedger<Real>> ledger_;
  std::vector<FlowPart<Real>> flow_;
  std::vector<PairForce<Real>> slots_;
  std::vector<std::uint8_t> active_;
};

}  // namespace ulpgate::dem
