// Assembly<Real>: the bodies, materials and run parameters of a scene as numbers, every constant made in
// Real.
#pragma once

#include <array>
#include <cstdio>
#include <vector>

#include "kernels/dem/formulas/contact_physics.hpp"
#include "kernels/dem/formulas/sphere_body.hpp"
#include "kernels/scenes/reader/body.hpp"
#include "kernels/scenes/reader/expression.hpp"
#include "kernels/scenes/reader/lattices.hpp"
#include "kernels/scenes/reader/start_checks.hpp"

namespace ulpgate::scenes {

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

// A table of the scene by its name in errors: "sphere[3]".
inline std::string place(const char* table, std::size_t index) {
  return std::string(table) + "[" + std::to_string(index) + "]";
}

// Every number is judged here, in the type of the run and after all overrides: the reader judges the text in
// double alone.
template <RealType Real>
class Assembler {
 public:
  Assembler(const Scene& scene, bool allow_large)
      : scene_(scene), allow_large_(allow_large), evaluate_(scene.constants_rule) {
    for (const auto& [name, text] : scene.constants) evaluate_.define(name, text);
  }

  [[nodiscard]] Assembly<Real> run() {
    each("material", scene_.materials, &Assembler::add_material);
    claim("spheres, facets, boxes and walls",
          scene_.spheres.size() + scene_.facets.size() + scene_.boxes.size() + scene_.walls.size());
    each("sphere", scene_.spheres, &Assembler::add_sphere);
    each("generator", scene_.generators, &Assembler::generate);
    each("facet", scene_.facets, &Assembler::add_facet_spec);
    each("box", scene_.boxes, &Assembler::add_box);
    each("wall", scene_.walls, &Assembler::add_wall);
    add_bonds();
    out_.gravity = vec("run", "gravity", scene_.gravity);
    out_.damping = number("run", "damping", scene_.damping, Range::below_one);
    out_.dt = number("run", "dt", scene_.dt, Range::positive);
    if (scene_.sweep) out_.sweep = number("contacts", "sweep", *scene_.sweep, Range::positive);
    return std::move(out_);
  }

 private:
  template <class Spec>
  void each(const char* table, const std::vector<Spec>& specs,
            void (Assembler::*add)(const std::string&, const Spec&)) {
    for (std::size_t i = 0; i < specs.size(); ++i) (this->*add)(place(table, i), specs[i]);
  }

  // Refuses bodies that would not fit before any of them is made.
  void claim(const std::string& at, std::uint64_t bodies) {
    claimed_ += bodies;
    refuse_large(at + ": bodies", claimed_, most_bodies, bytes_of_body<Real>, allow_large_);
  }

  Real number(const std::string& at, const char* key, const Expression& text, Range range) const {
    Real value = evaluate_(text);
    const std::string fault = range_fault(value, range);
    if (!fault.empty())
      throw SceneFault(at + "." + key + ": " + fault + ", is '" + text + "'" + shown(value));
    return value;
  }
  // For people; a value that is no double is told by its text alone.
  static std::string shown(const Real& value) {
    if constexpr (is_instrumented_real<Real>) {
      return "";
    } else {
      std::array<char, 40> digits{};
      std::snprintf(digits.data(), digits.size(), " = %g", static_cast<double>(value));
      return digits.data();
    }
  }
  // Adding +0 turns a negative zero into a positive one, so that leaving a zero part out can never show in a
  // sign.
  dem::Vec3<Real> vec(const std::string& at, const char* key, const Triple& t,
                      Range range = Range::any) const {
    return {number(at, key, t[0], range) + Real(0), number(at, key, t[1], range) + Real(0),
            number(at, key, t[2], range) + Real(0)};
  }
  static Real radians(const Real& degrees) { return degrees * boost::math::constants::pi<Real>() / 180; }
  int index_of(const std::string& material) const {
    for (std::size_t i = 0; i < scene_.materials.size(); ++i) {
      if (scene_.materials[i].name == material) return static_cast<int>(i);
    }
    return 0;
  }

  void add_material(const std::string& at, const Material& m) {
    MaterialValues<Real> v;
    v.density = number(at, "density", m.density, Range::positive);
    const Real friction_angle = radians(number(at, "friction_angle", m.friction_angle, Range::acute));
    v.elastic = {number(at, "young", m.young, Range::positive),
                 number(at, "poisson", m.poisson, Range::below_one), friction_angle};
    if (m.stiffness) v.elastic.stiffness = number(at, "stiffness", *m.stiffness, Range::positive);
    v.collision = {number(at, "collision_time", m.collision_time, Range::positive),
                   number(at, "restitution_normal", m.restitution_normal, Range::unit_open_closed),
                   number(at, "restitution_tangential", m.restitution_tangential, Range::unit_open_closed),
                   friction_angle};
    v.breakable = m.cohesion.has_value();
    if (m.cohesion) v.cohesion = number(at, "cohesion", *m.cohesion, Range::not_negative);
    v.adhesion = number(at, "adhesion", m.adhesion, Range::not_negative);
    v.moments = m.moment_stiffness.has_value();
    if (m.moment_stiffness)
      v.moment_stiffness = number(at, "moment_stiffness", *m.moment_stiffness, Range::positive);
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

  // What follows from numbers that are each in their range need not be: a mass of 1e-999 kg is 0.
  void check_last_ball(const std::string& at) const {
    const Body<Real>& b = out_.bodies.back();
    const auto refuse = [&](const char* what) {
      throw SceneFault(at + " (body " + std::to_string(out_.bodies.size() - 1) + "): " + what);
    };
    const auto positive = [](const Real& x) { return x > 0 && is_finite(x); };
    const auto& elastic = out_.materials[static_cast<std::size_t>(b.material)].elastic;
    if (!is_finite(b.position)) refuse("its position must be finite");
    if (!positive(b.radius)) refuse("its radius must be positive and finite");
    if (!positive(b.mass)) refuse("its mass must be positive and finite");
    if (!positive(b.inertia.x) || !positive(b.inertia.y) || !positive(b.inertia.z))
      refuse("its moments of inertia must be positive and finite");
    if (elastic.stiffness == 0 && !positive(elastic.young * b.radius))
      refuse("its stiffness, young * radius, must be positive and finite");
  }

  void add_sphere(const std::string& at, const SphereSpec& s) {
    add_ball(vec(at, "position", s.position), number(at, "radius", s.radius, Range::positive),
             index_of(s.material), s.fixed);
    Body<Real>& b = out_.bodies.back();
    b.velocity = vec(at, "velocity", s.velocity);
    b.angular_velocity = vec(at, "angular_velocity", s.angular_velocity);
    if (s.mass) {
      b.mass = number(at, "mass", *s.mass, Range::positive);
      const Real moment = dem::sphere_inertia(b.mass, b.radius);
      b.inertia = {moment, moment, moment};
    }
    if (s.inertia) {
      b.inertia = vec(at, "inertia", *s.inertia, Range::positive);
      b.aspherical = true;
    }
    check_last_ball(at);
  }

  void add_facet(const std::string& at, const dem::Facet<Real>& facet, int material) {
    if (!has_area(facet))
      throw SceneFault(at + " (body " + std::to_string(out_.bodies.size()) +
                       "): the facet has no area: its corners must not lie on one line");
    Body<Real> b;
    b.shape = Shape::facet;
    b.material = material;
    b.facet = facet;
    b.position = (facet.a + facet.b + facet.c) / Real(3);
    out_.bodies.push_back(b);
  }

  void add_facet_spec(const std::string& at, const FacetSpec& f) {
    add_facet(at,
              {vec(at, "vertices[0]", f.vertices[0]), vec(at, "vertices[1]", f.vertices[1]),
               vec(at, "vertices[2]", f.vertices[2])},
              index_of(f.material));
  }

  void add_box(const std::string& at, const BoxSpec& s) {
    Body<Real> b;
    b.shape = Shape::box;
    b.material = index_of(s.material);
    b.position = vec(at, "centre", s.centre);
    b.half_size = vec(at, "half_size", s.half_size, Range::positive);
    const dem::Vec3<Real> axis = vec(at, "axis", s.axis);
    const Real length = dem::norm(axis);
    if (!(length > 0) || !is_finite(length))
      throw SceneFault(at + ".axis: its length must be positive and finite");
    b.orientation = dem::from_angle_axis(radians(number(at, "angle", s.angle, Range::any)), axis / length);
    out_.bodies.push_back(b);
  }

  void add_wall(const std::string& at, const WallSpec& s) {
    Body<Real> b;
    b.shape = Shape::wall;
    b.material = index_of(s.material);
    b.axis = s.axis;
    b.position[static_cast<std::size_t>(s.axis)] = number(at, "position", s.position, Range::any) + Real(0);
    b.velocity[static_cast<std::size_t>(s.axis)] = number(at, "velocity", s.velocity, Range::any) + Real(0);
    out_.bodies.push_back(b);
  }

  void generate(const std::string& at, const Generator& g) {
    if (g.kind == GeneratorKind::facet_box) return generate_facet_box(at, g);
    if (g.kind == GeneratorKind::hexagonal_ball) return generate_hexagonal_ball(at, g);
    generate_grid(at, g);
  }

  void generate_facet_box(const std::string& at, const Generator& g) {
    const auto facets =
        facet_box(vec(at, "centre", g.centre), vec(at, "half_size", g.half_size, Range::positive));
    claim(at, facets.size());
    for (const auto& facet : facets) add_facet(at, facet, index_of(g.material));
  }

  void generate_hexagonal_ball(const std::string& at, const Generator& g) {
    const Real radius = number(at, "radius", g.radius, Range::positive);
    const HexagonalBall<Real> ball{radius, number(at, "gap", g.gap, Range::not_negative),
                                   number(at, "ball_radius", g.ball_radius, Range::positive),
                                   vec(at, "corner", g.corner)};
    const auto counts = hexagonal_counts(ball);
    if (!counts)
      throw SceneTooLarge(at + ": more than " + std::to_string(most_lattice_planes) +
                          " spheres side by side, or a distance beyond the type of the run");
    claim(at, points_inside(*counts));
    const std::size_t before = out_.bodies.size();
    for (const auto& p : hexagonal_ball(ball, *counts)) {
      add_ball(p, radius, index_of(g.material), false);
      check_last_ball(at);
    }
    if (out_.bodies.size() == before) throw SceneFault(at + ": no sphere fits into the ball");
  }

  void generate_grid(const std::string& at, const Generator& g) {
    std::uint64_t count = 1;
    for (const int along : g.counts) count *= static_cast<std::uint64_t>(along);
    claim(at, count);
    for (const auto& node :
         grid<Real>(g.counts, vec(at, "spacing", g.spacing), vec(at, "corner", g.corner),
                    number(at, "jitter", g.jitter, Range::not_negative),
                    number(at, "radius", g.radius, Range::positive),
                    number(at, "radius_spread", g.radius_spread, Range::below_one), g.seed)) {
      add_ball(node.position, node.radius, index_of(g.material), node.i < g.fixed_layers);
      check_last_ball(at);
    }
  }

  void add_bonds() {
    out_.bonds = scene_.bonds;
    if (scene_.bond_reach) {
      const Real reach = number("contacts", "bond_reach", *scene_.bond_reach, Range::positive);
      bond_near(out_.bodies, reach, allow_large_, out_.bonds);
    }
    const auto key = [](const Bond& b) { return std::pair(b.first, b.second); };
    std::sort(out_.bonds.begin(), out_.bonds.end(),
              [&](const Bond& a, const Bond& b) { return key(a) < key(b); });
    const auto same = [&](const Bond& a, const Bond& b) { return key(a) == key(b); };
    out_.bonds.erase(std::unique(out_.bonds.begin(), out_.bonds.end(), same), out_.bonds.end());
    refuse_bonds_of_no_length(out_.bodies, out_.bonds);
    if (scene_.between == ContactsBetween::all) refuse_coincident(out_.bodies);
  }

  const Scene& scene_;
  bool allow_large_;
  RoundedEvaluator<Real> evaluate_;
  std::uint64_t claimed_ = 0;
  Assembly<Real> out_;
};

}  // namespace detail

// The scene's numbers in Real.  Throws a SceneFault that names the key or the body where one of them, or what
// follows from it, is out of its range in this type, and SceneTooLarge before the memory is taken where the
// scene needs more than is taken without `allow_large`.
template <RealType Real>
[[nodiscard]] Assembly<Real> assemble(const Scene& scene, bool allow_large = false) {
  return detail::Assembler<Real>(scene, allow_large).run();
}

}  // namespace ulpgate::scenes
