// Assembly<Real>: the bodies, materials and run parameters of a scene as numbers, every constant made in
// Real.
#pragma once

#include <map>
#include <vector>

#include "kernels/dem/formulas/contact_physics.hpp"
#include "kernels/dem/formulas/flat_geometry.hpp"
#include "kernels/dem/formulas/sphere_body.hpp"
#include "kernels/scenes/reader/expression.hpp"
#include "kernels/scenes/reader/lattices.hpp"
#include "kernels/scenes/reader/scene.hpp"

namespace ulpgate::scenes {

enum class Shape : std::uint8_t { sphere, facet, box, wall };

template <RealType Real>
struct Body {
  Shape shape = Shape::sphere;
  bool fixed = true;
  int material = 0;
  dem::Vec3<Real> position;  // of a facet its centroid, of a wall a point on it
  dem::Vec3<Real> velocity;  // of a fixed body prescribed
  dem::Vec3<Real> angular_velocity;
  Real radius{0};
  Real mass{0};
  dem::Vec3<Real> inertia;  // principal moments
  bool aspherical = false;
  dem::Quaternion<Real> orientation;
  dem::Facet<Real> facet;     // facets: vertices
  dem::Vec3<Real> half_size;  // boxes
  int axis = 0;               // walls
};

template <RealType Real>
struct MaterialValues {
  Real density;
  dem::Elastic<Real> elastic;
  dem::Collision<Real> collision;
  bool breakable = false;
  Real cohesion{0};
  Real adhesion{0};
  bool moments = false;
  Real moment_stiffness{0};
};

template <RealType Real>
struct Assembly {
  std::vector<Body<Real>> bodies;
  std::vector<MaterialValues<Real>> materials;
  std::vector<Bond> bonds;  // sorted
  dem::Vec3<Real> gravity;
  Real damping{0};
  Real dt{0};
  Real sweep{0};  // 0: to be chosen from the smallest radius
};

namespace detail {

// What a scene's constants are computed in (ConstantsRule::rounded_once), to be rounded to Real once.  In
// float arithmetic the pendulum's start would be off by several roundings, and be true for 0.85 s instead
// of 1.10 s.
template <RealType Real>
using ConstantReal = std::conditional_t<std::same_as<Real, float>, double, Real>;

template <RealType Real>
class RoundedEvaluator {
 public:
  explicit RoundedEvaluator(ConstantsRule rule) : stepwise_(rule == ConstantsRule::stepwise) {}
  void define(const std::string& name, std::string_view text) {
    if (stepwise_) {
      own_.define(name, own_(text));
    } else {
      wide_.define(name, wide_(text));
    }
  }
  [[nodiscard]] Real operator()(std::string_view text) const {
    return stepwise_ ? own_(text) : static_cast<Real>(wide_(text));
  }

 private:
  bool stepwise_;
  Evaluator<ConstantReal<Real>> wide_;
  Evaluator<Real> own_;
};

template <RealType Real>
class Assembler {
 public:
  explicit Assembler(const Scene& scene) : scene_(scene), evaluate_(scene.constants_rule) {
    for (const auto& [name, text] : scene.constants) evaluate_.define(name, text);
  }

  [[nodiscard]] Assembly<Real> run() {
    for (const Material& m : scene_.materials) add_material(m);
    for (const SphereSpec& s : scene_.spheres) add_sphere(s);
    for (const Generator& g : scene_.generators) generate(g);
    for (const FacetSpec& f : scene_.facets) {
      add_facet({vec(f.vertices[0]), vec(f.vertices[1]), vec(f.vertices[2])}, index_of(f.material));
    }
    for (const BoxSpec& b : scene_.boxes) add_box(b);
    for (const WallSpec& w : scene_.walls) add_wall(w);
    add_bonds();
    out_.gravity = vec(scene_.gravity);
    out_.damping = evaluate_(scene_.damping);
    out_.dt = evaluate_(scene_.dt);
    if (scene_.sweep) out_.sweep = evaluate_(*scene_.sweep);
    return std::move(out_);
  }

 private:
  // Adding +0 turns a negative zero into a positive one, so that leaving a zero part out can never show in a
  // sign.
  dem::Vec3<Real> vec(const Triple& t) const {
    return {evaluate_(t[0]) + Real(0), evaluate_(t[1]) + Real(0), evaluate_(t[2]) + Real(0)};
  }
  Real radians(const Expression& degrees) const {
    return evaluate_(degrees) * boost::math::constants::pi<Real>() / 180;
  }
  int index_of(const std::string& material) const {
    for (std::size_t i = 0; i < scene_.materials.size(); ++i) {
      if (scene_.materials[i].name == material) return static_cast<int>(i);
    }
    return 0;
  }

  void add_material(const Material& m) {
    MaterialValues<Real> v;
    v.density = evaluate_(m.density);
    v.elastic = {evaluate_(m.young), evaluate_(m.poisson), radians(m.friction_angle)};
    if (m.stiffness) v.elastic.stiffness = evaluate_(*m.stiffness);
    v.collision = {evaluate_(m.collision_time), evaluate_(m.restitution_normal),
                   evaluate_(m.restitution_tangential), radians(m.friction_angle)};
    v.breakable = m.cohesion.has_value();
    if (m.cohesion) v.cohesion = evaluate_(*m.cohesion);
    v.adhesion = evaluate_(m.adhesion);
    v.moments = m.moment_stiffness.has_value();
    if (m.moment_stiffness) v.moment_stiffness = evaluate_(*m.moment_stiffness);
    out_.materials.push_back(v);
  }

  Real sphere_mass(const Real& radius, int material) const {
    using Wide = ConstantReal<Real>;
    const Real density = out_.materials[static_cast<std::size_t>(material)].density;
    if (scene_.constants_rule == ConstantsRule::stepwise) return dem::sphere_mass<Real>(radius, density);
    return static_cast<Real>(dem::sphere_mass<Wide>(radius, density));
  }

  void add_ball(const dem::Vec3<Real>& position, const Real& radius, int material, bool fixed) {
    Body<Real> b;
    b.fixed = fixed;
    b.material = material;
    b.position = position;
    b.radius = radius;
    b.mass = scene_.mass_rule == MassRule::yade ? contaminated_mass(radius, material)
                                                : sphere_mass(radius, material);
    const Real moment = dem::sphere_inertia(b.mass, radius);
    b.inertia = {moment, moment, moment};
    out_.bodies.push_back(b);
  }

  // The mass as YADE has it: 4/3 pi is a product of doubles, off by 1.1e-16, and the rest is in Real (see
  // pendulum3.toml).
  Real contaminated_mass(const Real& radius, int material) const {
    const double factor = (4. / 3) * boost::math::constants::pi<double>();
    const Real volume = Real(factor) * radius * radius * radius;
    return volume * out_.materials[static_cast<std::size_t>(material)].density;
  }

  void add_sphere(const SphereSpec& s) {
    add_ball(vec(s.position), evaluate_(s.radius), index_of(s.material), s.fixed);
    Body<Real>& b = out_.bodies.back();
    b.velocity = vec(s.velocity);
    b.angular_velocity = vec(s.angular_velocity);
    if (s.mass) {
      b.mass = evaluate_(*s.mass);
      const Real moment = dem::sphere_inertia(b.mass, b.radius);
      b.inertia = {moment, moment, moment};
    }
    if (s.inertia) {
      b.inertia = vec(*s.inertia);
      b.aspherical = true;
    }
  }

  void add_facet(const dem::Facet<Real>& facet, int material) {
    Body<Real> b;
    b.shape = Shape::facet;
    b.material = material;
    b.facet = facet;
    b.position = (facet.a + facet.b + facet.c) / Real(3);
    out_.bodies.push_back(b);
  }

  void add_box(const BoxSpec& s) {
    Body<Real> b;
    b.shape = Shape::box;
    b.material = index_of(s.material);
    b.position = vec(s.centre);
    b.half_size = vec(s.half_size);
    const dem::Vec3<Real> axis = vec(s.axis);
    b.orientation = dem::from_angle_axis(radians(s.angle), axis / dem::norm(axis));
    out_.bodies.push_back(b);
  }

  void add_wall(const WallSpec& s) {
    Body<Real> b;
    b.shape = Shape::wall;
    b.material = index_of(s.material);
    b.axis = s.axis;
    b.position[static_cast<std::size_t>(s.axis)] = evaluate_(s.position) + Real(0);
    b.velocity[static_cast<std::size_t>(s.axis)] = evaluate_(s.velocity) + Real(0);
    out_.bodies.push_back(b);
  }

  void generate(const Generator& g) {
    const int material = index_of(g.material);
    if (g.kind == GeneratorKind::facet_box) {
      for (const auto& facet : facet_box(vec(g.centre), vec(g.half_size))) add_facet(facet, material);
    } else if (g.kind == GeneratorKind::hexagonal_ball) {
      const Real radius = evaluate_(g.radius);
      for (const auto& p :
           hexagonal_ball(radius, evaluate_(g.gap), evaluate_(g.ball_radius), vec(g.corner))) {
        add_ball(p, radius, material, false);
      }
    } else {
      for (const auto& node : grid<Real>(g.counts, vec(g.spacing), vec(g.corner), evaluate_(g.jitter),
                                         evaluate_(g.radius), evaluate_(g.radius_spread), g.seed)) {
        add_ball(node.position, node.radius, material, node.i < g.fixed_layers);
      }
    }
  }

  void add_bonds() {
    out_.bonds = scene_.bonds;
    if (scene_.bond_reach) {
      const Real reach = evaluate_(*scene_.bond_reach);
      const auto count = static_cast<int>(out_.bodies.size());
      for (int i = 0; i < count; ++i) {
        for (int j = i + 1; j < count; ++j) {
          const Body<Real>& a = out_.bodies[static_cast<std::size_t>(i)];
          const Body<Real>& b = out_.bodies[static_cast<std::size_t>(j)];
          if (a.shape != Shape::sphere || b.shape != Shape::sphere || (a.fixed && b.fixed)) continue;
          const Real far = reach * (a.radius + b.radius);
          if (dem::squared_norm(b.position - a.position) < far * far) out_.bonds.push_back({i, j});
        }
      }
    }
    const auto key = [](const Bond& b) { return std::pair(b.first, b.second); };
    std::sort(out_.bonds.begin(), out_.bonds.end(),
              [&](const Bond& a, const Bond& b) { return key(a) < key(b); });
    const auto same = [&](const Bond& a, const Bond& b) { return key(a) == key(b); };
    out_.bonds.erase(std::unique(out_.bonds.begin(), out_.bonds.end(), same), out_.bonds.end());
  }

  const Scene& scene_;
  RoundedEvaluator<Real> evaluate_;
  Assembly<Real> out_;
};

}  // namespace detail

// A scene that read_scene() accepted always assembles.
template <RealType Real>
[[nodiscard]] Assembly<Real> assemble(const Scene& scene) {
  return detail::Assembler<Real>(scene).run();
}

}  // namespace ulpgate::scenes
