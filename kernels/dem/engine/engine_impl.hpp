// TypedEngine<Real>: DemEngine over a Simulation<Real>; included only by the one translation unit of each
// type.
#pragma once

#include <stdexcept>

#include "kernels/dem/engine/engine.hpp"
#include "kernels/dem/step/simulation.hpp"
#include "kernels/dem/step/stiffness_limit.hpp"

namespace ulpgate::dem {

template <RealType Real>
class TypedEngine final : public DemEngine {
 public:
  TypedEngine(std::string type_name, const scenes::Scene& scene, const EngineOptions& options)
      : type_name_(std::move(type_name)),
        simulation_(scene, {options.all_parts, options.threads, options.allow_large, options.progress,
                            options.collisions}) {
    for (const scenes::Material& m : scene.materials) material_names_.push_back(m.name);
  }

  [[nodiscard]] std::string type_name() const override { return type_name_; }
  void step(std::uint64_t count) override { simulation_.step(count); }
  void set_threads(int threads) override { simulation_.set_threads(threads); }
  void set_flow(const std::vector<FlowText>& flow) override {
    std::vector<FlowPart<Real>> parts;
    for (const auto& part : flow) parts.push_back({part.kick, parse_real<Real>(part.fraction)});
    simulation_.set_flow(std::move(parts));
  }
  [[nodiscard]] std::uint64_t iteration() const override { return s().iteration; }
  [[nodiscard]] double time_s() const override {
    return static_cast<double>(s().iteration) * static_cast<double>(s().dt);
  }

  [[nodiscard]] std::size_t bodies() const override { return s().bodies.size(); }
  [[nodiscard]] scenes::Shape shape(std::size_t body) const override { return s().bodies.shape[body]; }
  [[nodiscard]] bool is_fixed(std::size_t body) const override { return s().bodies.fixed[body] != 0; }
  [[nodiscard]] std::vector<BodyPair> contacts() const override { return simulation_.touching_pairs(); }

  [[nodiscard]] double approximate(BodyQuantity q, std::size_t body, std::size_t c) const override {
    return static_cast<double>(value(q, body, c));
  }
  [[nodiscard]] std::string text(BodyQuantity q, std::size_t body, std::size_t c) const override {
    return to_hexfloat(value(q, body, c));
  }
  void exact(BodyQuantity q, std::size_t body, std::size_t c, mpfr_ptr out) const override {
    to_mpfr(out, value(q, body, c));
  }
  [[nodiscard]] double radius(std::size_t body) const override {
    return static_cast<double>(s().bodies.radius[body]);
  }
  [[nodiscard]] double mass(std::size_t body) const override {
    return static_cast<double>(s().bodies.mass[body]);
  }
  [[nodiscard]] std::string mass_text(std::size_t body) const override {
    return to_hexfloat(s().bodies.mass[body]);
  }
  [[nodiscard]] std::vector<std::array<double, 3>> corners(std::size_t body) const override {
    std::vector<std::array<double, 3>> list;
    if (s().bodies.shape[body] != Shape::facet) return list;
    const auto& f = s().flats[static_cast<std::size_t>(s().bodies.flat[body])].facet;
    for (const auto* p : {&f.a, &f.b, &f.c}) {
      list.push_back({static_cast<double>(p->x), static_cast<double>(p->y), static_cast<double>(p->z)});
    }
    return list;
  }
  [[nodiscard]] std::vector<std::string> contact_constants(BodyPair pair) const override {
    const Contacts<Real>& c = s().contacts;
    const auto found = std::lower_bound(c.pair.begin(), c.pair.end(), pair);
    if (found == c.pair.end() || *found != pair) return {};
    const auto p = static_cast<std::size_t>(found - c.pair.begin());
    const auto get = [&](const std::vector<Real>& array) {
      return to_hexfloat(array.empty() ? Real(0) : array[p]);
    };
    return {get(c.kn), get(c.ks), get(c.cn), get(c.cs)};
  }

  [[nodiscard]] std::vector<std::string> energy_names() const override {
    if (!s().parts.energy) return {};
    return {"translational_on_step",
            "rotational_on_step",
            "elastic",
            "potential",
            "friction",
            "damping",
            "viscous",
            "broken",
            "work",
            "sum"};
  }
  [[nodiscard]] double energy(std::string_view name) const override {
    return static_cast<double>(energy_value(name));
  }
  void energy_exact(std::string_view name, mpfr_ptr out) const override { to_mpfr(out, energy_value(name)); }

  [[nodiscard]] double kinetic_energy() const override { return static_cast<double>(kinetic_sum()); }
  void kinetic_energy_exact(mpfr_ptr out) const override { to_mpfr(out, kinetic_sum()); }

  [[nodiscard]] CriticalStep critical_step(std::string_view name) const override {
    if (name == "stiffness") return {static_cast<double>(stiffness_limit(s())), ""};
    if (name != "p_wave" && name != "rayleigh")
      throw std::invalid_argument("no rule '" + std::string(name) + "' for the critical step");
    if (std::string refusal = wave_refusal(s(), material_names_); !refusal.empty())
      return {0, "the rule '" + std::string(name) + "': " + refusal};
    const Wave wave = name == "p_wave" ? Wave::pressure : Wave::rayleigh;
    return {static_cast<double>(wave_limit(s(), wave)), ""};
  }

  [[nodiscard]] std::optional<NotFinite> not_finite() const override {
    using scenes::is_finite;
    const Bodies<Real>& b = s().bodies;
    const Parts& parts = s().parts;
    for (std::size_t i = 0; i < b.size(); ++i) {
      if (!is_finite(b.velocity[i])) return NotFinite{"the velocity", i};
      if (!is_finite(b.position[i])) return NotFinite{"the position", i};
      if (parts.rotation && !is_finite(b.angular_velocity[i])) return NotFinite{"the angular velocity", i};
      if (parts.orientation) {
        const Quaternion<Real>& q = b.orientation[i];
        if (!is_finite(q.w) || !is_finite(Vec3<Real>{q.x, q.y, q.z})) return NotFinite{"the orientation", i};
      }
      if (b.fixed[i] == 0 && !is_finite(dem::kinetic_energy(b.mass[i], b.velocity[i])))
        return NotFinite{"the kinetic energy", i};
    }
    if (!is_finite(kinetic_sum())) return NotFinite{"the kinetic energy", std::nullopt};
    if (parts.energy && !is_finite(s().energies.sum())) return NotFinite{"the energy account", std::nullopt};
    return std::nullopt;
  }
  [[nodiscard]] const Parts& explain() const override { return simulation_.parts(); }
  [[nodiscard]] std::size_t memory_bytes() const override { return simulation_.memory(); }
  [[nodiscard]] std::size_t collider_rebuilds() const override { return simulation_.rebuilds(); }
  [[nodiscard]] std::vector<CollisionRecord> take_collisions() override {
    return simulation_.take_collisions();
  }
  [[nodiscard]] std::vector<CollisionRecord> open_collisions() const override {
    return simulation_.open_collisions();
  }
  [[nodiscard]] std::string save() override { return simulation_.save(); }
  void restore(std::string_view state, Constants constants) override {
    simulation_.restore(state, constants == Constants::from_text);
  }

 private:
  [[nodiscard]] const SimulationState<Real>& s() const { return simulation_.state(); }

  [[nodiscard]] Real value(BodyQuantity q, std::size_t body, std::size_t c) const {
    const Bodies<Real>& b = s().bodies;
    switch (q) {
      case BodyQuantity::position:
        return b.position[body][c];
      case BodyQuantity::velocity:
        return b.velocity[body][c];
      case BodyQuantity::angular_velocity:
        return s().parts.rotation ? b.angular_velocity[body][c] : Real(0);
      case BodyQuantity::orientation:
        break;
    }
    const Quaternion<Real> o = s().parts.orientation ? b.orientation[body] : Quaternion<Real>{};
    return c == 0 ? o.w : c == 1 ? o.x : c == 2 ? o.y : o.z;
  }

  [[nodiscard]] Real energy_value(std::string_view name) const {
    const Energies<Real>& e = s().energies;
    if (name == "translational_on_step") return e.kinetic;
    if (name == "rotational_on_step") return e.rotational;
    if (name == "elastic") return e.elastic;
    if (name == "potential") return e.potential;
    if (name == "friction") return e.friction;
    if (name == "damping") return e.damping;
    if (name == "viscous") return e.viscous;
    if (name == "broken") return e.broken;
    if (name == "work") return e.work;
    if (name == "sum") return e.sum();
    throw std::invalid_argument("no energy '" + std::string(name) + "'");
  }

  [[nodiscard]] Real kinetic_sum() const {
    const Bodies<Real>& b = s().bodies;
    Real sum{0};
    for (std::size_t i = 0; i < b.size(); ++i) {
      if (b.fixed[i] != 0) continue;
      sum += dem::kinetic_energy(b.mass[i], b.velocity[i]);
      if (s().parts.rotation) sum += rotational_energy(b.inertia[i], b.angular_velocity[i]);
    }
    return sum;
  }

  std::string type_name_;
  std::vector<std::string> material_names_;
  Simulation<Real> simulation_;
};

// Makes an engine of one type; specialised in no place, instantiated in one.
template <RealType Real>
[[nodiscard]] std::unique_ptr<DemEngine> make_typed_engine(const char* type_name, const scenes::Scene& scene,
                                                           const EngineOptions& options) {
  return std::make_unique<TypedEngine<Real>>(type_name, scene, options);
}

}  // namespace ulpgate::dem
