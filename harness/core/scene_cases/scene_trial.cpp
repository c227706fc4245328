// Running a scene beside its reference.
#include "harness/core/scene_cases/scene_trial.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "harness/core/scenes/scene_compare.hpp"
#include "harness/core/subject/registry.hpp"
#include "kernels/scenes/reader/scene_fault.hpp"
#include "kernels/scenes/reader/scene_reader.hpp"
#include "reference/text/text.hpp"

namespace ulpgate {

namespace {

using dem::BodyQuantity;
using dem::DemEngine;
using dem::Level;

constexpr dem::EngineOptions one_thread{};

double magnitude(const DemEngine& e, BodyQuantity q, std::size_t body) {
  double largest = 0;
  for (std::size_t c = 0; c < 3; ++c) largest = std::max(largest, std::fabs(e.approximate(q, body, c)));
  return largest;
}

// |a - b| of one body, in full precision.
double difference(const DemEngine& a, const DemEngine& b, BodyQuantity q, std::size_t body) {
  MpfrValue x;
  MpfrValue y;
  MpfrValue d(64);
  double sum = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    a.exact(q, body, c, x);
    b.exact(q, body, c, y);
    if (mpfr_number_p(x.get()) == 0 || mpfr_number_p(y.get()) == 0) return HUGE_VAL;
    mpfr_sub(d, x, y, MPFR_RNDN);
    sum = std::hypot(sum, mpfr_get_d(d, MPFR_RNDN));
  }
  return sum;
}

// +1 or -1, the same everywhere.
int drawn_sign(unsigned seed, std::size_t body, std::size_t component) {
  std::uint64_t x = seed * 0x9e3779b97f4a7c15ULL + body * 0xbf58476d1ce4e5b9ULL + component + 1;
  x ^= x >> 31U;
  x *= 0x94d049bb133111ebULL;
  x ^= x >> 29U;
  return (x & 1U) != 0 ? 1 : -1;
}

constexpr double perturbation = 4;  // in u
// Enough to meet a contact that lasts a sixteenth of the run.
constexpr std::uint64_t starts_of_a_trial = 16;

struct PerturbedStart {
  std::uint64_t step;
  std::string state;
};

// Steps before which a run of `steps` is perturbed.
std::vector<std::uint64_t> perturbed_steps(std::uint64_t steps, std::uint64_t most) {
  std::vector<std::uint64_t> list;
  for (std::uint64_t k = 0; k < most; ++k) {
    if (list.empty() || k * steps / most != list.back()) list.push_back(k * steps / most);
  }
  return list;
}

std::unique_ptr<DemEngine> reference_from(std::string_view token, const scenes::Scene& scene,
                                          const std::string& state) {
  auto engine = dem::make_engine(token, Level::reference, scene, one_thread);
  engine->restore(state, dem::Constants::from_text);
  return engine;
}

scenes::Scene halved(scenes::Scene scene) {
  scene.dt = "(" + scene.dt + ")/2";
  return scene;
}

// The root of the sum over all steps of the squared amplifications, from those of the perturbed starts.
double condition_of(std::string_view token, const scenes::Scene& scene,
                    const std::vector<PerturbedStart>& starts, const DemEngine& end, const StateScale& scale,
                    double u, const ode::StopFlag& stop) {
  double sum = 0;
  for (const PerturbedStart& start : starts) {
    const auto moved = reference_from(token, scene, start.state);
    while (moved->iteration() < end.iteration()) {
      stop.check();
      moved->step(std::min<std::uint64_t>(256, end.iteration() - moved->iteration()));
    }
    const double amplified = state_distance(*moved, end, scale) / (perturbation * u);
    sum += amplified * amplified;
  }
  return std::sqrt(sum / static_cast<double>(starts.size()) * static_cast<double>(end.iteration()));
}

}  // namespace

double trajectory_condition(std::string_view token, const scenes::Scene& scene, std::uint64_t steps,
                            std::uint64_t count, const ode::StopFlag& stop) {
  const double u = unit_roundoff(find_type(token)->significand_bits);
  const auto reference =
      reference_from(token, scene, dem::make_engine(token, Level::own, scene, one_thread)->save());
  StateScale scale;
  std::vector<PerturbedStart> starts;
  for (const std::uint64_t at : perturbed_steps(steps, count)) {
    stop.check();
    reference->step(at - reference->iteration());
    raise_scale(*reference, scale);
    starts.push_back({at, perturbed_state(*reference, perturbation * u, static_cast<unsigned>(at) + 1)});
  }
  reference->step(steps - reference->iteration());
  raise_scale(*reference, scale);
  return condition_of(token, scene, starts, *reference, scale, u, stop);
}

scenes::Scene scene_of(std::string_view toml) {
  auto result = scenes::read_scene(toml, "scene");
  if (!result.scene) {
    std::string text;
    for (const auto& error : result.errors) text += error.text() + "; ";
    throw std::invalid_argument(text);
  }
  return *result.scene;
}

void raise_scale(const DemEngine& engine, StateScale& scale) {
  for (std::size_t i = 0; i < engine.bodies(); ++i) {
    if (engine.shape(i) != scenes::Shape::sphere) continue;
    scale.position =
        std::max({scale.position, magnitude(engine, BodyQuantity::position, i), engine.radius(i)});
    scale.speed = std::max(scale.speed, magnitude(engine, BodyQuantity::velocity, i));
    scale.spin = std::max(scale.spin, magnitude(engine, BodyQuantity::angular_velocity, i));
    if (engine.radius(i) > 0) scale.spin = std::max(scale.spin, scale.speed / engine.radius(i));
  }
}

double state_distance(const DemEngine& a, const DemEngine& b, const StateScale& scale) {
  double largest = 0;
  for (std::size_t i = 0; i < a.bodies(); ++i) {
    if (a.shape(i) != scenes::Shape::sphere) continue;
    for (const auto& [q, size] :
         {std::pair(BodyQuantity::position, scale.position), std::pair(BodyQuantity::velocity, scale.speed),
          std::pair(BodyQuantity::angular_velocity, scale.spin)}) {
      const double d = difference(a, b, q, i);
      if (d != 0) largest = std::max(largest, size > 0 ? d / size : HUGE_VAL);
    }
  }
  return largest;
}

std::string perturbed_state(DemEngine& engine, double size, unsigned seed) {
  std::istringstream in(engine.save());
  std::string out;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string field;
    std::size_t bodies = 0;
    words >> field;
    const bool moves = field == "position" || field == "velocity" || field == "angular_velocity";
    if (!moves || !(words >> bodies) || bodies != engine.bodies()) {
      out += line + '\n';
      continue;
    }
    out += field + ' ' + std::to_string(bodies);
    const BodyQuantity q = field == "position"   ? BodyQuantity::position
                           : field == "velocity" ? BodyQuantity::velocity
                                                 : BodyQuantity::angular_velocity;
    for (std::size_t i = 0; i < bodies; ++i) {
      const bool sphere = engine.shape(i) == scenes::Shape::sphere && !engine.is_fixed(i);
      double by = sphere ? magnitude(engine, q, i) : 0;
      if (sphere && q == BodyQuantity::position) by = std::max(by, engine.radius(i));
      for (std::size_t c = 0; c < 3; ++c) {
        std::string word;
        words >> word;
        MpfrValue x(4096);
        mpfr_set_str(x, word.c_str(), 0, MPFR_RNDN);
        MpfrValue d(64);
        mpfr_set_d(d, by * drawn_sign(seed, i, c), MPFR_RNDN);
        mpfr_mul_d(d, d, size, MPFR_RNDN);
        mpfr_add(x, x, d, MPFR_RNDN);
        out += ' ' + to_hexfloat(x.get());
      }
    }
    out += '\n';
  }
  return out;
}

StressRow run_scene_case(const SceneCase& c, std::string_view token, const ode::StopFlag& stop) {
  StressRow row;
  const RealDescriptor& type = *find_type(token);
  const double u = unit_roundoff(type.significand_bits);
  const scenes::Scene scene = scene_of(c.toml);
  std::unique_ptr<DemEngine> own;
  try {
    own = dem::make_engine(token, Level::own, scene, one_thread);
  } catch (const scenes::SceneFault& fault) {
    row.why = fault.what();
    return row;
  }
  const auto reference = reference_from(token, scene, own->save());
  StateScale scale;
  raise_scale(*reference, scale);
  const double kinetic_start = own->kinetic_energy();

  // Where states are compared, and before which steps they are perturbed.
  std::vector<std::uint64_t> looks = comparison_steps(c.steps);
  std::vector<PerturbedStart> starts;
  const std::vector<std::uint64_t> start_steps = perturbed_steps(c.steps, starts_of_a_trial);
  std::vector<std::uint64_t> stops = looks;
  stops.insert(stops.end(), start_steps.begin(), start_steps.end());
  std::sort(stops.begin(), stops.end());
  stops.erase(std::unique(stops.begin(), stops.end()), stops.end());

  std::vector<std::pair<std::uint64_t, double>> errors;
  std::optional<std::string> lost;
  for (const std::uint64_t at : stops) {
    stop.check();
    const std::uint64_t count = at - reference->iteration();
    own->step(count);
    reference->step(count);
    if (const auto fault = own->not_finite()) {
      const auto reference_fault = reference->not_finite();
      lost = "by step " + std::to_string(at) + " " + fault->text() + " is not finite" +
             (reference_fault ? ", nor is it in RealHP<4>" : "; it is in RealHP<4>");
      row.first_wrong = "step " + std::to_string(at);
      break;
    }
    raise_scale(*reference, scale);
    errors.emplace_back(at, state_distance(*own, *reference, scale));
    if (std::find(start_steps.begin(), start_steps.end(), at) != start_steps.end() && at < c.steps)
      starts.push_back({at, perturbed_state(*reference, perturbation * u, static_cast<unsigned>(at) + 1)});
  }
  if (lost) {
    row.verdict = StressVerdict::diverged;
    row.why = *lost;
    return row;
  }
  row.error = errors.back().second;

  row.condition = condition_of(token, scene, starts, *reference, scale, u, stop);
  if (!std::isfinite(*row.condition)) row.condition.reset();
  const double kappa = row.condition.value_or(HUGE_VAL);

  {
    const scenes::Scene half = halved(scene);
    const auto fine =
        reference_from(token, half, dem::make_engine(token, Level::own, half, one_thread)->save());
    stop.check();
    fine->step(2 * c.steps);
    const double stepping = state_distance(*fine, *reference, scale);
    if (std::isfinite(stepping)) row.stepping_error = stepping;
  }
  row.verdict = judge_stress(*row.error, kappa, u);
  if (row.verdict == StressVerdict::unstable || row.verdict == StressVerdict::diverged) {
    for (const auto& [step, error] : errors) {
      if (judge_stress(error, kappa, u) == StressVerdict::unstable || !std::isfinite(error)) {
        row.first_wrong = "step " + std::to_string(step);
        break;
      }
    }
  }
  if (!std::isfinite(*row.error)) row.error.reset();
  if (kinetic_start > 0) row.figures["kinetic_energy_over_start"] = own->kinetic_energy() / kinetic_start;
  const SceneTrial trial{*own, *reference, kinetic_start, u, own->time_s() / static_cast<double>(c.steps)};
  if (c.outcome) {
    if (std::string wrong = c.outcome(trial, row); !wrong.empty()) {
      row.verdict = StressVerdict::wrong_outcome;
      row.why = std::move(wrong);
    }
  }
  const double all = std::max(row.error.value_or(1), row.stepping_error.value_or(0));
  const double most = type.significand_bits * std::log10(2.0);
  row.correct_digits = all > 0 ? std::clamp(-std::log10(all), 0.0, most) : most;
  std::erase_if(row.figures, [](const auto& figure) { return !std::isfinite(figure.second); });
  return row;
}

StressCase as_stress_case(SceneCase c) {
  StressCase out;
  out.kind = "scene";
  out.name = c.name;
  out.form = c.form;
  out.title = c.title;
  out.known = c.known;
  out.cost = 1e-5 * static_cast<double>(c.steps);
  out.run = [c = std::move(c)](std::string_view token,
                               const ode::StopFlag& stop) -> std::optional<StressRow> {
    if (find_type(token) == nullptr) return std::nullopt;
    return run_scene_case(c, token, stop);
  };
  return out;
}

}  // namespace ulpgate
