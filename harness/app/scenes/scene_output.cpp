// What a scene run writes.
#include "harness/app/scenes/scene_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "harness/core/arguments/random_words.hpp"
#include "reference/text/text.hpp"

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

namespace {

// What does not exist is no number.
Json number_json(double x) {
  if (std::isnan(x)) return nullptr;
  return std::isinf(x) ? Json(x > 0 ? "inf" : "-inf") : Json(x);
}

Json place_json(const CollisionPlace& p, bool exists) {
  return exists ? Json::array({p.first, p.second, p.begin_step}) : Json(nullptr);
}

}  // namespace

Json collision_json(const dem::CollisionRecord& r) {
  Json j;
  j["first"] = r.first;
  j["second"] = r.second;
  j["open"] = r.open;
  j["begin_step"] = r.begin_step;
  j["end_step"] = r.end_step;
  j["steps_inside"] = r.steps_inside;
  const std::pair<const char*, double> numbers[] = {
      {"begin_s", r.begin_s},
      {"end_s", r.end_s},
      {"duration_s", r.duration_s},
      {"normal_velocity_before", r.normal_velocity_before},
      {"normal_velocity_after", r.normal_velocity_after},
      {"restitution", r.restitution},
      {"largest_overlap_m", r.largest_overlap_m},
      {"energy_before_J", r.energy_before},
      {"energy_after_J", r.energy_after},
      {"energy_gained_J", r.energy_gained},
      {"energy_created", r.energy_created},
      {"omega_dt", r.omega_dt},
      {"condition", r.open ? dem::CollisionRecord::none : r.condition},
      {"rounding_bound_J", r.open ? dem::CollisionRecord::none : r.rounding_bound},
      {"step_bound_J", r.open ? dem::CollisionRecord::none : r.step_bound},
      {"law_bound_J", r.open ? dem::CollisionRecord::none : r.law_bound}};
  for (const auto& [name, value] : numbers) j[name] = number_json(value);
  j["beyond_condition"] = r.beyond_condition;
  return j;
}

Json ledger_json(const CollisionSummary& s, std::uint64_t rows) {
  Json j;
  j["rows"] = rows;
  j["ended"] = s.ended;
  j["still_open"] = s.open;
  j["creating"] = s.creating;
  j["beyond"] = s.beyond;
  j["largest_created"] = number_json(s.largest_created);
  j["largest_created_at"] = place_json(s.largest_at, s.largest_created > 0);
  j["largest_part_of_bound"] = number_json(s.largest_part_of_bound);
  j["largest_part_of_bound_at"] = place_json(s.nearest_at, s.largest_part_of_bound > 0);
  j["mean_restitution"] = number_json(s.mean_restitution());
  j["shortest_steps"] = s.shortest;
  j["largest_omega_dt"] = number_json(s.largest_omega_dt);
  return j;
}

namespace {

// The numbers of the totals, by one list for writing and for reading.
template <class Summary, class Visit>
void each_number(Summary& s, Visit visit) {
  for (auto* n : {&s.ended, &s.open, &s.creating, &s.beyond, &s.restitutions, &s.shortest,
                  &s.largest_at.begin_step, &s.nearest_at.begin_step}) {
    visit(*n);
  }
  for (auto* n : {&s.largest_at.first, &s.largest_at.second, &s.nearest_at.first, &s.nearest_at.second})
    visit(*n);
  for (auto* x : {&s.largest_created, &s.largest_part_of_bound, &s.restitution_sum, &s.largest_omega_dt})
    visit(*x);
}

}  // namespace

Json state_json(const CollisionSummary& s) {
  Json j = Json::array();
  each_number(s, [&](const auto& x) {
    if constexpr (std::is_floating_point_v<std::remove_cvref_t<decltype(x)>>) {
      j.push_back(to_hexfloat(x));
    } else {
      j.push_back(x);
    }
  });
  return j;
}

CollisionSummary summary_of(const Json& state) {
  CollisionSummary s;
  std::size_t at = 0;
  each_number(s, [&](auto& x) {
    using Number = std::remove_cvref_t<decltype(x)>;
    const Json& j = state.at(at++);
    if constexpr (std::is_floating_point_v<Number>) {
      x = std::strtod(j.get<std::string>().c_str(), nullptr);
    } else {
      x = j.get<Number>();
    }
  });
  return s;
}

std::string summary_text(const CollisionSummary& s) {
  if (s.ended == 0) return fmt::format("  collisions: none ended, {} open\n", s.open);
  const auto at = [](const CollisionPlace& p) {
    return fmt::format("bodies {}-{} from step {}", p.first, p.second, p.begin_step);
  };
  std::string text = fmt::format(
      "  collisions: {} ended, {} open; mean restitution {:.6g}, shortest {} steps, largest omega dt "
      "{:.3g}\n",
      s.ended, s.open, s.mean_restitution(), s.shortest, s.largest_omega_dt);
  text += fmt::format("    {} made energy, {} beyond their condition", s.creating, s.beyond);
  if (s.largest_created > 0)
    text += fmt::format("; at most {:.3e} of the pair's ({})", s.largest_created, at(s.largest_at));
  if (s.largest_part_of_bound > 0)
    text += fmt::format("; {:.3g} of what it may ({})", s.largest_part_of_bound, at(s.nearest_at));
  return text + "\n";
}

}  // namespace ulpgate::app
