// Runs at rising steps until one grows.
#include "harness/core/step_limits/scenes/scene_step.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "kernels/scenes/reader/scene_fault.hpp"

namespace ulpgate {

namespace {

constexpr std::uint64_t chunk = 4;

struct Run {
  std::string_view token;
  const SceneStepSearch& search;
  const ode::StopFlag& stop;

  [[nodiscard]] std::unique_ptr<dem::DemEngine> engine(double factor) const {
    scenes::Scene scene = search.scene;
    scene.dt = number_text(factor * search.expected);
    auto made = dem::make_engine(token, dem::Level::own, scene, {});
    if (made == nullptr) throw std::invalid_argument("no type '" + std::string(token) + "' is built in");
    return made;
  }

  [[nodiscard]] bool stable(double factor) const {
    const auto run = engine(factor);
    const double start = run->kinetic_energy();
    for (std::uint64_t n = 0; n < search.steps; n += chunk) {
      stop.check();
      run->step(chunk);
      if (!(run->kinetic_energy() <= search.grown * start)) return false;
    }
    return true;
  }

  // From the step at which the energy passes 3e3 times that of the start, where what shrinks is gone, to
  // where it is 300 times as large.
  [[nodiscard]] std::optional<double> growth(double factor) const {
    const auto run = engine(factor);
    const double start = run->kinetic_energy();
    double first = 0;
    double last = 0;
    std::uint64_t steps = 0;
    for (std::uint64_t n = 0; n < 4 * search.steps && !(last > 300 * first && first > 0); ++n) {
      stop.check();
      run->step(1);
      const double now = run->kinetic_energy();
      if (!std::isfinite(now)) break;
      if (first == 0 && now < 3e3 * start) continue;
      if (first == 0) {
        first = last = now;
      } else {
        last = now;
        ++steps;
      }
    }
    if (steps < 3) return std::nullopt;
    return std::pow(last / first, 1 / (2 * static_cast<double>(steps)));
  }
};

}  // namespace

std::string number_text(double x) {
  return fmt::format("{:.17g}", x);
}

MeasuredStep measure_scene_step(std::string_view token, const SceneStepSearch& search,
                                const ode::StopFlag& stop) {
  const Run run{token, search, stop};
  MeasuredStep result;
  try {
    double stable = 0;
    double unstable = 0;
    for (int percent = 10; percent <= 110; percent += percent < 80 ? 10 : 5) {
      const double factor = percent / 100.0;
      if (!run.stable(factor)) {
        if (unstable == 0) unstable = factor;
      } else if (unstable == 0) {
        stable = factor;
      } else if (!result.stable_again) {
        result.stable_again = factor;
      }
    }
    while (unstable - stable > search.resolution) {
      const double middle = (stable + unstable) / 2;
      (run.stable(middle) ? stable : unstable) = middle;
    }
    result.largest_stable = stable * search.expected;
    result.growth = run.growth(1.01);
  } catch (const scenes::SceneFault& fault) {
    result.refusal = fault.what();
  }
  return result;
}

}  // namespace ulpgate
