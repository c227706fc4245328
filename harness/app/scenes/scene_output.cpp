// What a scene run writes.
#include "harness/app/scenes/scene_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/core/arguments/random_words.hpp"

namespace ulpgate::app {

namespace {

using Quantity = dem::BodyQuantity;

double speed_squared(const dem::DemEngine& e, std::size_t body) {
  double sum = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double v = e.approximate(Quantity::velocity, body, c);
    sum += v * v;
  }
  return sum;
}

double kinetic(const dem::DemEngine& e, std::size_t body) {
  return e.is_fixed(body) ? 0 : e.mass(body) * speed_squared(e, body) / 2;
}

std::string_view shape_name(scenes::Shape shape) {
  switch (shape) {
    case scenes::Shape::sphere:
      return "sphere";
    case scenes::Shape::facet:
      return "facet";
    case scenes::Shape::wall:
      return "wall";
    case scenes::Shape::box:
      return "box";
  }
  return "unknown";
}

}  // namespace

std::array<double, 3> mean_position(const dem::DemEngine& engine) {
  std::array<double, 3> sum{};
  double count = 0;
  for (std::size_t body = 0; body < engine.bodies(); ++body) {
    if (engine.is_fixed(body)) continue;
    ++count;
    for (std::size_t c = 0; c < 3; ++c) sum[c] += engine.approximate(Quantity::position, body, c);
  }
  for (double& x : sum) x = count > 0 ? x / count : 0;
  return sum;
}

std::uint64_t state_hash(const dem::DemEngine& engine) {
  std::uint64_t hash = fnv1a("state");
  for (const auto q : {Quantity::position, Quantity::velocity, Quantity::angular_velocity}) {
    for (std::size_t body = 0; body < engine.bodies(); ++body) {
      for (std::size_t c = 0; c < 3; ++c) hash = fnv1a(engine.text(q, body, c) + " ", hash);
    }
  }
  return hash;
}

std::string snapshot_csv(const dem::DemEngine& engine) {
  std::string text = "body,shape,x_m,y_m,z_m,radius_m,kinetic_J,time_s\n";
  for (std::size_t b = 0; b < engine.bodies(); ++b) {
    text += fmt::format(
        "{},{},{},{},{},{},{},{}\n", b, shape_name(engine.shape(b)),
        engine.approximate(Quantity::position, b, 0), engine.approximate(Quantity::position, b, 1),
        engine.approximate(Quantity::position, b, 2), engine.radius(b), kinetic(engine, b), engine.time_s());
  }
  return text;
}

std::string vtk_text(const dem::DemEngine& engine, const std::string& title) {
  struct Point {
    double x, y, z, radius, speed, kinetic;
  };
  std::vector<Point> points;
  std::vector<std::size_t> vertices;
  std::vector<std::size_t> triangles;
  for (std::size_t b = 0; b < engine.bodies(); ++b) {
    if (engine.shape(b) == scenes::Shape::sphere) {
      vertices.push_back(points.size());
      points.push_back({engine.approximate(Quantity::position, b, 0),
                        engine.approximate(Quantity::position, b, 1),
                        engine.approximate(Quantity::position, b, 2), engine.radius(b),
                        std::sqrt(speed_squared(engine, b)), kinetic(engine, b)});
    }
    const auto corners = engine.corners(b);
    if (corners.size() == 3) triangles.push_back(points.size());
    for (const auto& c : corners) points.push_back({c[0], c[1], c[2], 0, 0, 0});
  }
  std::string text = fmt::format(
      "# vtk DataFile Version 3.0\n{}\nASCII\nDATASET POLYDATA\nPOINTS {} double\n", title, points.size());
  for (const auto& p : points) text += fmt::format("{} {} {}\n", p.x, p.y, p.z);
  if (!vertices.empty()) {
    text += fmt::format("VERTICES {} {}\n", vertices.size(), 2 * vertices.size());
    for (const auto i : vertices) text += fmt::format("1 {}\n", i);
  }
  if (!triangles.empty()) {
    text += fmt::format("POLYGONS {} {}\n", triangles.size(), 4 * triangles.size());
    for (const auto i : triangles) text += fmt::format("3 {} {} {}\n", i, i + 1, i + 2);
  }
  text += fmt::format("POINT_DATA {}\n", points.size());
  const auto column = [&](const char* name, double Point::*value) {
    text += fmt::format("SCALARS {} double 1\nLOOKUP_TABLE default\n", name);
    for (const auto& p : points) text += fmt::format("{}\n", p.*value);
  };
  column("radius_m", &Point::radius);
  column("speed_m_per_s", &Point::speed);
  column("kinetic_J", &Point::kinetic);
  return text;
}

std::string divergence_csv(const std::vector<Divergence>& rows) {
  std::string text =
      "step,time_s,max_position_error_m,max_position_ulp,max_velocity_error_m_per_s,max_velocity_ulp,energy_"
      "error_J,"
      "contacts_only_here,contacts_only_in_reference\n";
  for (const auto& d : rows) {
    text += fmt::format("{},{},{},{},{},{},{},{},{}\n", d.step, d.time_s, d.position_error_m,
                        d.position_error_ulp, d.velocity_error_m_per_s, d.velocity_error_ulp,
                        d.energy_error_j, d.only_tested.size(), d.only_reference.size());
  }
  return text;
}

std::string contact_differences_csv(const std::vector<Divergence>& rows) {
  std::string text = "step,only_in,first_body,second_body\n";
  for (const auto& d : rows) {
    for (const auto& p : d.only_tested) text += fmt::format("{},tested,{},{}\n", d.step, p.first, p.second);
    for (const auto& p : d.only_reference)
      text += fmt::format("{},reference,{},{}\n", d.step, p.first, p.second);
  }
  return text;
}

std::string pair_names(const std::vector<dem::BodyPair>& pairs) {
  constexpr std::size_t most = 5;
  std::string names;
  for (std::size_t i = 0; i < std::min(most, pairs.size()); ++i)
    names += fmt::format(" {}-{}", pairs[i].first, pairs[i].second);
  return pairs.empty()         ? " none"
         : pairs.size() > most ? fmt::format("{} and {} more", names, pairs.size() - most)
                               : names;
}

Json energy_json(const dem::DemEngine& engine) {
  const auto names = engine.energy_names();
  if (names.empty()) return nullptr;
  Json j;
  for (const auto& name : names) j[name] = engine.energy(name);
  return j;
}

}  // namespace ulpgate::app
