// The scenes whose largest stable steps are measured.
#include "harness/core/step_limits/scenes/limit_scenes.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "harness/core/step_limits/scenes/scene_step.hpp"

namespace ulpgate {

namespace {

using Vector3 = Eigen::Vector3d;

scenes::Triple triple(const Vector3& v) {
  return {number_text(v.x()), number_text(v.y()), number_text(v.z())};
}

scenes::SphereSpec sphere(const Vector3& at, double radius) {
  scenes::SphereSpec s;
  s.position = triple(at);
  s.radius = number_text(radius);
  s.material = "grain";
  return s;
}

scenes::Scene empty_scene(std::string name, scenes::ContactLaw law) {
  scenes::Scene scene;
  scene.name = std::move(name);
  scene.law = law;
  scene.dt = "1e-12";
  scene.until = "1";
  scenes::Material m;
  m.name = "grain";
  scene.materials.push_back(m);
  return scene;
}

// Bonds of spheres that touch: no cohesion, so that none breaks, and adhesion enough that none slips.
scenes::Scene bonded_scene(std::string name, double poisson) {
  scenes::Scene scene = empty_scene(std::move(name), scenes::ContactLaw::cohesive);
  scene.between = scenes::ContactsBetween::bonded;
  scene.bond_reach = "1.05";
  scenes::Material& m = scene.materials[0];
  m.density = "2600";
  m.young = "1e7";
  m.poisson = number_text(poisson);
  m.friction_angle = poisson > 0 ? "30" : "0";
  m.adhesion = poisson > 0 ? "1e9" : "0";
  return scene;
}

constexpr double grain_radius = 0.01;

std::vector<Vector3> lattice_points(std::string_view lattice) {
  std::vector<Vector3> points;
  const double a = 2 * grain_radius;
  if (lattice == "chain") {
    for (int i = 0; i < 5; ++i) points.emplace_back(i * a, 0, 0);
  } else if (lattice == "cubic") {
    for (int i = 0; i < 27; ++i) points.emplace_back(i % 3 * a, i / 3 % 3 * a, i / 9 * a);
  } else if (lattice == "fcc") {
    // A sphere, its twelve neighbours and the six behind them.
    const double b = a / std::numbers::sqrt2;
    for (int i = -2; i <= 2; ++i) {
      for (int j = -2; j <= 2; ++j) {
        for (int k = -2; k <= 2; ++k) {
          if ((i + j + k) % 2 == 0 && i * i + j * j + k * k <= 4) points.emplace_back(i * b, j * b, k * b);
        }
      }
    }
  } else {
    throw std::invalid_argument("no lattice '" + std::string(lattice) + "'");
  }
  return points;
}

// A turn that carries x to where its name says.
Eigen::Matrix3d turn_of(std::string_view turn) {
  // About x cross `to`, of which 1 + c is not near 0 for any of these.  Not Eigen's FromTwoVectors, which
  // instantiates a singular value decomposition for vectors that point apart.
  const auto onto = [](const Vector3& to) {
    const Vector3 axis = Vector3::UnitX().cross(to);
    const double size = to.norm();
    return Eigen::Quaterniond(size + to.x(), axis.x(), axis.y(), axis.z()).normalized().toRotationMatrix();
  };
  if (turn == "aligned") return Eigen::Matrix3d::Identity();
  if (turn == "turned_45") return onto({1, 1, 0});
  if (turn == "turned_111") return onto({1, 1, 1});
  if (turn == "turned_any") return onto({1, 2, 3});
  throw std::invalid_argument("no turn '" + std::string(turn) + "'");
}

scenes::WallSpec wall(int axis, double position) {
  scenes::WallSpec w;
  w.axis = axis;
  w.position = number_text(position);
  w.material = "grain";
  return w;
}

// kn/m of a sphere against a wall by the visco-elastic law: its partner counts as an equal.
double visco_square(double restitution, double time) {
  const double ln = std::log(restitution);
  return (std::numbers::pi * std::numbers::pi + ln * ln) / (2 * time * time);
}

}  // namespace

LimitScene rod_pendulum(double young) {
  const double length = 0.1;
  LimitScene s{fmt::format("young_1e{:.0f}", std::log10(young)),
               empty_scene("rod_pendulum", scenes::ContactLaw::cohesive),
               {},
               1e-4 * length / 4,
               true};
  s.scene.between = scenes::ContactsBetween::bonded;
  s.scene.materials[0].density = "10";
  s.scene.materials[0].young = number_text(young);
  s.scene.gravity = {"0", "-9.81", "0"};
  for (int i = 0; i < 4; ++i) {
    s.scene.spheres.push_back(sphere({0, -i * length / 4, 0}, length / 100));
    s.scene.spheres.back().fixed = i == 0;
    if (i > 0) s.scene.bonds.push_back({i - 1, i});
  }
  return s;
}

LimitScene sphere_on_wall(double restitution) {
  LimitScene s{fmt::format("restitution_{:g}", restitution),
               empty_scene("sphere_on_wall", scenes::ContactLaw::viscoelastic),
               {{1, 1}},
               0,
               true};
  s.scene.materials[0].density = "2500";
  s.scene.materials[0].restitution_normal = number_text(restitution);
  const double overlap = grain_radius / 10;
  s.disturbance = 1e-4 * overlap;
  s.scene.spheres.push_back(sphere({0, grain_radius - overlap, 0}, grain_radius));
  s.scene.walls.push_back(wall(1, 0));
  s.scene.gravity = {"0", number_text(-visco_square(restitution, 1e-3) * overlap), "0"};
  return s;
}

LimitScene hertz_on_wall() {
  LimitScene s{
      "hertz_on_wall", empty_scene("hertz_on_wall", scenes::ContactLaw::hertz_mindlin), {{1, 1}}, 0, true};
  scenes::Material& m = s.scene.materials[0];
  m.density = "2500";
  m.young = "1e8";
  m.poisson = "0.25";
  const double r = grain_radius;
  const double overlap = 1e-3 * r;
  s.disturbance = 1e-4 * overlap;
  s.scene.spheres.push_back(sphere({0, r - overlap, 0}, r));
  s.scene.walls.push_back(wall(1, 0));
  // Fn = 4/3 E* sqrt(r/2) u^(3/2): the engine gives a wall the radius of the sphere.
  const double e_star = 1e8 / (2 * (1 - 0.0625));
  const double mass = 4.0 / 3 * std::numbers::pi * r * r * r * 2500;
  const double force = 4.0 / 3 * e_star * std::sqrt(r / 2) * overlap * std::sqrt(overlap);
  s.scene.gravity = {"0", number_text(-force / mass), "0"};
  return s;
}

LimitScene sphere_far_along_wall() {
  LimitScene s{
      "far_along_wall", empty_scene("far_along_wall", scenes::ContactLaw::frictional), {{1, 1}}, 0, true};
  s.scene.materials[0].density = "2600";
  s.scene.materials[0].young = "1e7";
  const double r = grain_radius;
  const double overlap = 1e-2 * r;
  s.disturbance = 1e-4 * overlap;
  s.scene.spheres.push_back(sphere({0.05, r - overlap, 0.05}, r));
  s.scene.walls.push_back(wall(1, 0));
  const double mass = 4.0 / 3 * std::numbers::pi * r * r * r * 2600;
  s.scene.gravity = {"0", number_text(-1e7 * r * overlap / mass), "0"};
  return s;
}

LimitScene free_pair(double poisson, const std::array<double, 3>& direction) {
  LimitScene s{
      poisson > 0 ? "shear" : "normal", bonded_scene("free_pair", poisson), {}, 1e-5 * grain_radius, false};
  const Vector3 d = Vector3(direction[0], direction[1], direction[2]).normalized() * grain_radius;
  s.scene.spheres = {sphere(-d, grain_radius), sphere(d, grain_radius)};
  return s;
}

LimitScene bonded_packing(std::string_view lattice, double poisson, std::string_view turn) {
  LimitScene s{
      fmt::format("{}_{}", lattice, turn), bonded_scene("packing", poisson), {}, 1e-5 * grain_radius, false};
  const Eigen::Matrix3d turned = turn_of(turn);
  for (const Vector3& p : lattice_points(lattice))
    s.scene.spheres.push_back(sphere(turned * p, grain_radius));
  return s;
}

const std::vector<std::string>& packing_turns() {
  static const std::vector<std::string> turns{"aligned", "turned_45", "turned_111", "turned_any"};
  return turns;
}

LimitScene boxed_packing(double restitution) {
  LimitScene s{"boxed",
               empty_scene("boxed_packing", scenes::ContactLaw::viscoelastic),
               {},
               1e-6 * grain_radius,
               false};
  scenes::Material& m = s.scene.materials[0];
  m.density = "2300";
  m.friction_angle = "35";
  m.restitution_normal = m.restitution_tangential = number_text(restitution);
  const double r = grain_radius;
  const double overlap = 2e-2 * r;
  const double spacing = 2 * r - overlap;
  for (int i = 0; i < 27; ++i) {
    s.scene.spheres.push_back(
        sphere({(i % 3 - 1) * spacing, (i / 3 % 3 - 1) * spacing, (i / 9 - 1) * spacing}, r));
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (const int side : {-1, 1}) {
      s.scene.walls.push_back(wall(axis, side * (spacing + r - overlap)));
      s.walls.push_back({axis, -side});
    }
  }
  return s;
}

void disturb(LimitScene& s, const CriticalMode& mode, double amplitude) {
  const double speed = amplitude * 2 / mode.step;
  for (std::size_t i = 0; i < s.scene.spheres.size(); ++i) {
    scenes::SphereSpec& sphere = s.scene.spheres[i];
    if (sphere.fixed) continue;
    for (std::size_t d = 0; d < 3; ++d) {
      const double other = s.along_mode ? 0 : 0.1 * std::sin(static_cast<double>(12 * i + 5 * d + 1));
      sphere.velocity[d] = number_text(speed * (mode.shape[i][d] + other));
      if (mode.shape[i][3 + d] != 0) sphere.angular_velocity[d] = number_text(speed * mode.shape[i][3 + d]);
    }
  }
}

}  // namespace ulpgate
