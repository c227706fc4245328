// SceneSetting.
#include "harness/app/advice/scene_setting.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "harness/app/scenes/scene_run.hpp"
#include "harness/core/scenes/chain_angles.hpp"
#include "harness/core/scenes/correlation.hpp"
#include "harness/core/subject/registry.hpp"
#include "harness/core/work_precision/trajectory_setting.hpp"

namespace ulpgate::app {

namespace {

// Bodies that are so many sizes of the scene away from where they should be have left it.
constexpr double diverged_error = 1e3;
constexpr std::size_t least_growth_errors = 6;

// The energy account's largest error on the way, relative to the larger of the energy at the start and the
// largest kinetic energy.
class EnergyWatch {
 public:
  void look(const dem::DemEngine& engine) {
    if (engine.energy_names().empty()) return;
    engine.energy_exact("sum", sum_);
    kinetic_ = std::max(kinetic_, std::fabs(engine.energy("translational_on_step")));
    if (!start_) {
      start_.emplace(mpfr_get_prec(sum_));
      mpfr_set(*start_, sum_, MPFR_RNDN);
      return;
    }
    mpfr_sub(difference_, sum_, *start_, MPFR_RNDN);
    const double off = std::fabs(mpfr_get_d(difference_, MPFR_RNDN));
    if (!(off <= largest_)) largest_ = off;
  }
  [[nodiscard]] std::optional<double> error() const {
    if (!start_) return std::nullopt;
    const double scale = std::max(kinetic_, std::fabs(mpfr_get_d(*start_, MPFR_RNDN)));
    if (!(scale > 0) || !std::isfinite(largest_)) return std::nullopt;
    return largest_ / scale;
  }

 private:
  MpfrValue sum_;
  MpfrValue difference_;
  std::optional<MpfrValue> start_;
  double kinetic_ = 0;
  double largest_ = 0;
};

}  // namespace

std::optional<double> growth_of(const std::vector<double>& errors, double until_s) {
  double n = 0;
  double x = 0;
  double y = 0;
  double xx = 0;
  double xy = 0;
  for (std::size_t i = errors.size() / 2; i < errors.size(); ++i) {
    if (!(errors[i] > 0) || !std::isfinite(errors[i])) continue;
    const double t = until_s * static_cast<double>(i + 1) / static_cast<double>(errors.size());
    const double log_error = std::log(errors[i]);
    n += 1;
    x += t;
    y += log_error;
    xx += t * t;
    xy += t * log_error;
  }
  if (n < static_cast<double>(least_growth_errors)) return std::nullopt;
  return (n * xy - x * y) / (n * xx - x * x);
}

SceneSetting::SceneSetting(WorkSetting setting, SceneRequest scene, const SceneInstants& instants,
                           SharedReference reference)
    : SettingMeasurement(std::move(setting)),
      scene_(std::move(scene)),
      instants_(instants),
      reference_(std::move(reference)) {}

SettingMeasurement::Work SceneSetting::prepare() const {
  auto job = std::make_shared<SceneJob>(make_job(scene_));
  // A run is worn out by its steps.
  auto ready =
      std::make_shared<std::unique_ptr<dem::DemEngine>>(engine_of(setting().type, dem::Level::own, *job));
  return [job, ready, type = setting().type](const ode::StopFlag& stop) {
    auto engine = std::exchange(*ready, nullptr);
    if (!engine) engine = engine_of(type, dem::Level::own, *job);
    while (engine->iteration() < job->steps) {
      stop.check();
      engine->step(std::min<std::uint64_t>(job->steps - engine->iteration(), 256));
    }
  };
}

WorkOutcome SceneSetting::measure(const ode::StopFlag& stop) {
  // Before the run, so that nobody waits for it in the middle of one.
  static_cast<void>(reference_->get(stop));
  SceneRequest request = scene_;
  request.energy = true;
  const SceneJob job = make_job(request);
  const auto engine = engine_of(setting().type, dem::Level::own, job);
  SceneView view;
  EnergyWatch energy;
  FiniteWatch watch = finite_watch(setting().type, dem::Level::own, job);
  if (instants_.angles) view.products.push_back(product_of(chain_angles(*engine)));
  const std::uint64_t stride = job.steps / instants_.records;
  for (std::uint64_t record = 1; record <= instants_.records; ++record) {
    const std::uint64_t last = record * stride;
    while (engine->iteration() < last) {
      stop.check();
      // The account begins behind the first step.
      const std::uint64_t most = engine->iteration() == 0 ? 1 : 256;
      engine->step(std::min(last - engine->iteration(), most));
      if (engine->iteration() == 1) energy.look(*engine);
    }
    if (instants_.angles) view.products.push_back(product_of(chain_angles(*engine)));
    if (record % (instants_.records / instants_.positions) != 0) continue;
    if (const auto lost = watch.look(*engine)) {
      WorkOutcome o;
      o.failure = WorkFailure::diverged;
      o.steps = lost->step;
      o.why = lost->text();
      return o;
    }
    energy.look(*engine);
    add_positions(*engine, view);
  }
  WorkOutcome o;
  o.steps = job.steps;
  o.evaluations = job.steps * static_cast<std::uint64_t>(evaluations_of_step(job.integrator));
  o.energy_error = energy.error();
  judge(view, o, stop);
  return o;
}

void SceneSetting::judge(const SceneView& view, WorkOutcome& o, const ode::StopFlag& stop) const {
  const SceneReference& reference = reference_->get(stop);
  const auto errors = position_errors(view, reference.view, reference.size_m);
  const double largest = *std::ranges::max_element(errors);
  if (!(largest <= diverged_error)) {
    o.failure = WorkFailure::diverged;
    o.why = "bodies are over 1000 times the scene's size from where they should be";
    o.energy_error.reset();
    return;
  }
  o.final_error = errors.back();
  o.largest_error = largest;
  o.instants = errors.size();
  o.reference_error = reference.error;
  const double until_s = setting().dt_value * static_cast<double>(setting().steps);
  o.growth_rate = growth_of(errors, until_s);
  const int bits = find_type(setting().type)->significand_bits;
  o.correct_digits = correct_digits_of(std::max(errors.back(), reference.error),
                                       bits * std::numbers::log10e * std::numbers::ln2);
  if (!instants_.angles) return;
  const CorrelationRule rule;
  const auto correlations = chunk_correlations(view.products, reference.view.products, rule);
  const std::size_t records = true_records(correlations, rule);
  o.t_s_to_the_end = records == correlations.size() * rule.chunk;
  o.t_s = static_cast<double>(records) * until_s / static_cast<double>(instants_.records);
}

}  // namespace ulpgate::app
