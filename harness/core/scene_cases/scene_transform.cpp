// Transforming the texts of a scene, and comparing states in exact arithmetic.
#include "harness/core/scene_cases/scene_transform.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "harness/core/scene_cases/kernel_state_case.hpp"

namespace ulpgate {

namespace {

using dem::BodyQuantity;
using scenes::Expression;
using scenes::Triple;

// text * 2^k.
Expression scaled(const Expression& text, int k) {
  if (k == 0 || text.empty()) return text;
  return "(" + text + ")*0x1p" + std::to_string(k);
}
Triple scaled(const Triple& t, int k) {
  return {scaled(t[0], k), scaled(t[1], k), scaled(t[2], k)};
}
void scale(std::optional<Expression>& text, int k) {
  if (text) text = scaled(*text, k);
}

// M t / divisor, each component a sum in the order of the axes.
Triple mapped(const SpaceMap& map, const Triple& t, bool shifted, int sign = 1) {
  Triple out;
  for (std::size_t row = 0; row < 3; ++row) {
    Expression sum;
    for (std::size_t column = 0; column < 3; ++column) {
      const int factor = sign * map.m[row][column];
      if (factor == 0) continue;
      const Expression term = std::abs(factor) == 1
                                  ? "(" + t[column] + ")"
                                  : std::to_string(std::abs(factor)) + "*(" + t[column] + ")";
      sum += (factor < 0 ? "-" : sum.empty() ? "" : "+") + term;
    }
    if (map.divisor != 1) sum.insert(0, "(").append(")/").append(std::to_string(map.divisor));
    if (shifted && map.shift[row] != "0") sum += "+" + map.shift[row];
    out[row] = sum;
  }
  return out;
}

void scale_material(scenes::Material& m, const UnitScale& s) {
  const int pressure = s.mass - s.length - 2 * s.time;
  m.density = scaled(m.density, s.mass - 3 * s.length);
  m.young = scaled(m.young, pressure);
  scale(m.stiffness, s.mass - 2 * s.time);
  m.collision_time = scaled(m.collision_time, s.time);
  scale(m.cohesion, pressure);
  m.adhesion = scaled(m.adhesion, pressure);
}

void map_wall(scenes::WallSpec& w, const SpaceMap& map) {
  const auto axis = static_cast<std::size_t>(w.axis);
  for (std::size_t row = 0; row < 3; ++row) {
    const int factor = map.m[row][axis];
    if (factor == 0) continue;
    if (std::abs(factor) != map.divisor)
      throw std::invalid_argument("a wall would no longer lie across an axis");
    w.axis = static_cast<int>(row);
    if (factor < 0) {
      w.position = "-(" + w.position + ")";
      w.velocity = "-(" + w.velocity + ")";
    }
    if (map.shift[row] != "0") w.position += "+" + map.shift[row];
    return;
  }
}

WideReal exact_of(const dem::DemEngine& e, BodyQuantity q, std::size_t body, std::size_t c) {
  MpfrValue x;
  e.exact(q, body, c, x);
  WideReal out(0);
  mpfr_set(out.backend().data(), x, MPFR_RNDN);
  return out;
}

}  // namespace

bool SpaceMap::mirrors() const {
  const auto minor = [&](std::size_t a, std::size_t b) { return m[1][a] * m[2][b] - m[1][b] * m[2][a]; };
  return m[0][0] * minor(1, 2) - m[0][1] * minor(0, 2) + m[0][2] * minor(0, 1) < 0;
}

scenes::Scene SceneTransform::apply(scenes::Scene scene) const {
  const int speed = scale.length - scale.time;
  const int turns = map.mirrors() ? -1 : 1;
  for (auto& m : scene.materials) scale_material(m, scale);
  for (auto& s : scene.spheres) {
    s.position = mapped(map, scaled(s.position, scale.length), true);
    s.velocity = mapped(map, scaled(s.velocity, speed), false);
    s.angular_velocity = mapped(map, scaled(s.angular_velocity, -scale.time), false, turns);
    s.radius = scaled(s.radius, scale.length);
    ulpgate::scale(s.mass, scale.mass);
    if (s.inertia) throw std::invalid_argument("principal moments are not transformed");
  }
  if (renumber) {
    if (!scene.generators.empty() || !scene.bonds.empty())
      throw std::invalid_argument("generators and bonds are not renumbered");
    std::reverse(scene.spheres.begin(), scene.spheres.end());
  }
  if (!scene.generators.empty() || !scene.boxes.empty())
    throw std::invalid_argument("generators and boxes are not transformed");
  for (auto& f : scene.facets) {
    for (auto& v : f.vertices) v = mapped(map, scaled(v, scale.length), true);
  }
  for (auto& w : scene.walls) {
    w.position = scaled(w.position, scale.length);
    w.velocity = scaled(w.velocity, speed);
    map_wall(w, map);
  }
  scene.gravity = mapped(map, scaled(scene.gravity, scale.length - 2 * scale.time), false);
  scene.dt = scaled(scene.dt, scale.time);
  scene.until = scaled(scene.until, scale.time);
  ulpgate::scale(scene.sweep, scale.length);
  return scene;
}

std::size_t SceneTransform::body(const scenes::Scene& scene, std::size_t i) const {
  return renumber && i < scene.spheres.size() ? scene.spheres.size() - 1 - i : i;
}

TransformedDistance compare_transformed(const dem::DemEngine& base, const dem::DemEngine& moved,
                                        const scenes::Scene& scene, const SceneTransform& t) {
  struct Quantity {
    BodyQuantity q;
    const char* name;
    int power;
    double size;
  };
  StateScale size;
  raise_scale(moved, size);
  const int speed = t.scale.length - t.scale.time;
  const Quantity quantities[] = {
      {BodyQuantity::position, "position", t.scale.length, size.position},
      {BodyQuantity::velocity, "velocity", speed, size.speed},
      {BodyQuantity::angular_velocity, "angular velocity", -t.scale.time, size.spin}};
  TransformedDistance out;
  const scenes::Evaluator<WideReal> evaluate;
  for (const Quantity& q : quantities) {
    const bool place = q.q == BodyQuantity::position;
    const int sign = q.q == BodyQuantity::angular_velocity && t.map.mirrors() ? -1 : 1;
    for (std::size_t i = 0; i < base.bodies(); ++i) {
      if (base.shape(i) != scenes::Shape::sphere) continue;
      double distance = 0;
      for (std::size_t row = 0; row < 3; ++row) {
        WideReal want(0);
        for (std::size_t column = 0; column < 3; ++column)
          want += sign * t.map.m[row][column] * exact_of(base, q.q, i, column);
        want /= t.map.divisor;
        want = ldexp(want, q.power);
        if (place) want += evaluate(t.map.shift[row]);
        const WideReal got = exact_of(moved, q.q, t.body(scene, i), row);
        distance = std::hypot(distance, static_cast<double>(WideReal(got - want)));
      }
      if (!std::isfinite(distance)) return {HUGE_VAL, "a number that is not finite"};
      if (distance == 0) continue;
      if (out.first.empty()) out.first = std::string("the ") + q.name + " of body " + std::to_string(i);
      out.distance = std::max(out.distance, q.size > 0 ? distance / q.size : HUGE_VAL);
    }
  }
  return out;
}

}  // namespace ulpgate
