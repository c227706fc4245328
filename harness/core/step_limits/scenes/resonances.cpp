// Energy errors of the swinging elastic rod over its step.
#include "harness/core/step_limits/scenes/resonances.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "harness/core/step_limits/scenes/limit_scenes.hpp"
#include "harness/core/step_limits/scenes/scene_step.hpp"

namespace ulpgate {

namespace {

constexpr double rod = 0.025;     // m
constexpr double radius = 0.001;  // m
constexpr double gravity = 9.81;  // m/s^2
constexpr double ratio = 20;      // of omega^2 to gravity/rod
constexpr std::uint64_t steps = 600;
constexpr double diverged = 100;  // of the energy error

double omega() {
  return std::sqrt(ratio * gravity / rod);
}

scenes::Scene elastic_pendulum(double z) {
  scenes::Scene s = rod_pendulum(1e5).scene;
  s.spheres.resize(2);
  s.bonds.resize(1);
  const double mass = 4.0 / 3 * std::numbers::pi * radius * radius * radius * 10;
  s.materials[0].young = number_text(mass * omega() * omega() / radius);
  s.spheres[1].position = {number_text(rod), "0", "0"};
  s.spheres[1].velocity = {number_text(0.1 * rod * omega()), "0", "0"};
  s.record = {"energy"};
  s.dt = number_text(z / omega());
  return s;
}

// Against the energy of the vibration and of the swing; at most 1e6.
double energy_error(std::string_view token, double z, const ode::StopFlag& stop) {
  const auto engine = dem::make_engine(token, dem::Level::own, elastic_pendulum(z), {});
  if (engine == nullptr) throw std::invalid_argument("no type '" + std::string(token) + "' is built in");
  const double speed = 0.1 * rod * omega();
  const double scale = engine->mass(1) * (speed * speed / 2 + gravity * rod);
  engine->step(1);
  const double start = engine->energy("sum");
  double largest = 0;
  for (std::uint64_t n = 1; n < steps; ++n) {
    stop.check();
    engine->step(1);
    const double error = std::abs(engine->energy("sum") - start) / scale;
    if (!(error <= 1e6)) return 1e6;
    largest = std::max(largest, error);
  }
  return largest;
}

struct PhasePoint {
  double z, error;
};

// How often a z errs as much as the median of those up to 0.1 away, those next to it left out.
double above_neighbours(const std::vector<PhasePoint>& line, std::size_t i) {
  std::vector<double> around;
  for (const PhasePoint& p : line) {
    const double off = std::abs(p.z - line[i].z);
    if (off > 0.01 && off < 0.11) around.push_back(p.error);
  }
  if (around.size() < 4) return 1;
  std::nth_element(around.begin(), around.begin() + static_cast<std::ptrdiff_t>(around.size() / 2),
                   around.end());
  const double median = around[around.size() / 2];
  return median > 0 ? line[i].error / median : 1;
}

}  // namespace

StressRow scan_resonances(std::string_view token, const ode::StopFlag& stop) {
  std::vector<double> places;
  for (int i = 4; i < 56; ++i) places.push_back(i * 0.025);
  for (int i = 140; i <= 195; ++i) places.push_back(i * 0.01);
  for (int n = 3; n <= 8; ++n) {
    const double z = 2 * std::sin(std::numbers::pi / n);
    for (const double off : {-4e-3, -2e-3, 0.0, 2e-3, 4e-3}) places.push_back(z + off);
  }
  std::sort(places.begin(), places.end());
  std::vector<PhasePoint> line;
  line.reserve(places.size());
  StressRow row;
  row.verdict = StressVerdict::stable;
  for (const double z : places) {
    line.push_back({z, energy_error(token, z, stop)});
  }
  // From where on no z is stable any more.
  std::size_t below = line.size();
  while (below > 0 && line[below - 1].error > diverged) --below;
  if (below < line.size()) {
    row.figures["diverged_from"] = line[below].z;
    row.why = fmt::format("diverges from z = {:.4g} on", line[below].z);
    line.resize(below);
  }
  int found = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const double over = above_neighbours(line, i);
    const bool top = (i == 0 || line[i - 1].error <= line[i].error) &&
                     (i + 1 == line.size() || line[i + 1].error < line[i].error);
    if (!top || over < 10) continue;
    ++found;
    row.figures[fmt::format("resonance_{}_z", found)] = line[i].z;
    row.figures[fmt::format("resonance_{}_ratio", found)] = over;
    row.why += fmt::format("{}z = {:.4g}: {:.3g} times its neighbours", row.why.empty() ? "" : "; ",
                           line[i].z, over);
  }
  row.figures["resonances"] = found;
  for (const PhasePoint& p : line) {
    const double tenths = p.z * 10;
    if (std::abs(tenths - std::round(tenths)) < 1e-9)
      row.figures[fmt::format("energy_error_at_{:.1f}", p.z)] = p.error;
  }
  if (row.why.empty()) row.why = "no z errs 10 times as much as its neighbours";
  return row;
}

}  // namespace ulpgate
