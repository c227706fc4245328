// AdviceCase.
#include "harness/app/advice/advice_case.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cmath>

#include "harness/app/shell/selection.hpp"
#include "harness/core/trajectories/truth.hpp"
#include "kernels/ode/integrators/integrators.hpp"
#include "kernels/ode/problems/initial_value_cases.hpp"
#include "kernels/scenes/reader/expression.hpp"

namespace ulpgate::app {

namespace {

// Trajectories begin with so many steps, or with those of the coarsest tolerance.
constexpr std::uint64_t first_steps = 4;
constexpr int equal_levels = 24;
// A step's error that is a tenth takes so many times the steps, by the orders that plans are made with.
constexpr double stiff_growth = 1.78;
constexpr double smooth_growth = 1.39;
constexpr int scene_levels = 18;
constexpr int coarser_levels = 2;
// Truths and references are good to a tenth of the wanted error, in digits of the case two more.
constexpr double reference_share = 0.1;

std::vector<std::string> fine_types(const AdviceOptions& o) {
  std::vector<std::string> types;
  for (const auto& token : select_types(o.types))
    if (std::ldexp(1.0, -type_or_fail(token).significand_bits) <= o.error) types.push_back(token);
  std::ranges::stable_sort(types, {}, [](const auto& t) { return type_or_fail(t).significand_bits; });
  if (types.empty()) {
    throw Failure(
        Standing::incomplete,
        fmt::format("--error {:g} is below the roundoff of every type of --types {}", o.error, o.types));
  }
  return types;
}

// A double of so many operations takes about a nanosecond each.
double operation_s(const std::string& token) {
  const int bits = type_or_fail(token).significand_bits;
  return bits <= 53 ? 1e-9 : (bits <= 64 ? 2e-9 : 3e-8 + 4e-10 * bits);
}

// About 2^(quarter/4) times the first, a multiple of a sixteenth of the power of two below, so that steps end
// at many of the times at which runs are compared.
std::uint64_t steps_of_quarter(int quarter) {
  const double wanted = static_cast<double>(first_steps) * std::exp2(quarter / 4.0);
  const auto whole = static_cast<std::uint64_t>(std::llround(wanted));
  const std::uint64_t unit = std::clamp<std::uint64_t>(std::bit_floor(whole) / 16, 1, compared_parts);
  return (whole + unit / 2) / unit * unit;
}

// 1e-3, 5.6e-4, 3.2e-4, 1.8e-4, 1e-4 ...
double tolerance_of_quarter(int quarter) {
  constexpr std::array<const char*, quarters_of_level> mantissas = {"1", "5.6", "3.2", "1.8"};
  const int exponent = 3 + (quarter + quarters_of_level - 1) / quarters_of_level;
  return std::stod(
      fmt::format("{}e-{}", mantissas.at(static_cast<std::size_t>(quarter % quarters_of_level)), exponent));
}

class TrajectoryAdvice final : public AdviceCase {
 public:
  TrajectoryAdvice(const InitialValueInfo& problem, const AdviceOptions& o)
      : problem_(problem),
        end_(end_of_problem(problem, o.until)),
        digits_(std::clamp(static_cast<int>(std::ceil(-std::log10(o.error))) + 2, 15, most_truth_digits)),
        wanted_(o.along ? AdvicePoint::Wanted::on_the_way : AdvicePoint::Wanted::final),
        truths_(shared_truths(problem.name, end_, digits_)) {
    for (const auto& type : fine_types(o)) {
      for (const auto& integrator : select_integrators_of(o.integrators)) {
        if (!find_trajectory_engine(type)->applies(integrator, problem.name)) continue;
        choices_.push_back({type, integrator, Steps::equal});
        if (has_plans()) choices_.push_back({type, integrator, Steps::planned});
      }
    }
  }

  void prepare(const ode::StopFlag& stop) const override {
    for (const auto& truth : {truths_.equal, truths_.graded}) static_cast<void>(truth->get(stop));
  }
  [[nodiscard]] AdviceCurve curve(const Choice& choice) const override {
    const double size = static_cast<double>(problem_.components);
    const double step_s =
        evaluations_of_step(choice.integrator) * (20 + 10 * size) * operation_s(choice.type);
    if (choice.steps == Steps::equal) return {equal_levels, static_cast<double>(first_steps) * step_s, 2};
    const auto decades =
        static_cast<int>(std::floor(std::log10(coarsest_tolerance / finest_tolerance) + 0.5));
    const auto steps = graded_plan(problem_.name, end_, coarsest_tolerance).behind.back();
    return {decades + 1, static_cast<double>(steps) * step_s, problem_.stiff ? stiff_growth : smooth_growth};
  }
  [[nodiscard]] std::unique_ptr<SettingMeasurement> setting(const Choice& choice,
                                                            int quarter) const override {
    const WorkSetting s =
        choice.steps == Steps::equal
            ? equal_setting(problem_.name, choice.type, choice.integrator, end_, steps_of_quarter(quarter))
            : planned_setting(problem_.name, choice.type, choice.integrator, end_,
                              tolerance_of_quarter(quarter));
    return std::make_unique<TrajectorySetting>(s, *find_trajectory_engine(choice.type), truths_.of(s),
                                               default_evaluation_budget);
  }
  [[nodiscard]] AdvicePoint::Wanted wanted() const override { return wanted_; }

  [[nodiscard]] std::string step_words(const WorkSetting& s) const override {
    if (!s.planned())
      return fmt::format("{} equal steps of {:.6g} of the problem's time", s.steps, s.dt_value);
    return fmt::format("{} steps planned for a tolerance of {}", s.steps, s.dt.substr(plan_mark.size()));
  }
  [[nodiscard]] std::string error_words() const override {
    return fmt::format("error of the state at t = {}{}, {} (truth to {} digits)", end_,
                       wanted_ == AdvicePoint::Wanted::final ? "" : " and on the way",
                       problem_.stiff ? "of each component relative to itself, the largest of them"
                                      : "relative to its largest component",
                       digits_);
  }
  [[nodiscard]] std::string kink_words(const std::string& integrator) const override {
    if (!problem_.stiff)
      return "steps are too long for the order to show, or the motion is not smooth enough";
    return ode::is_for_stiff(ode::find_integrator(integrator).kind)
               ? "reduction of the order, as the problem is stiff, or steps too long for it to show"
               : "the problem is stiff and the method is made for others";
  }
  [[nodiscard]] std::string contact_words(const WorkSetting& /*setting*/) const override { return ""; }
  [[nodiscard]] std::string run_command(const WorkSetting& s) const override {
    std::string words =
        fmt::format("ulpgate work-precision --cases {} --integrators {} --types {} {}", s.name, s.integrator,
                    s.type, s.planned() ? "--dt " + s.dt : fmt::format("--steps {}", s.steps));
    if (end_ != problem_.ends.front()) words += fmt::format(" --until '{}'", end_);
    return words + (digits_ > default_digits({s.type}) ? fmt::format(" --digits {}", digits_) : "");
  }
  [[nodiscard]] std::string measure_command(const WorkSetting& s) const override { return run_command(s); }

 private:
  [[nodiscard]] bool has_plans() const {
    try {
      static_cast<void>(graded_plan(problem_.name, end_, coarsest_tolerance));
      return true;
    } catch (const std::runtime_error&) {
      return false;
    }
  }

  const InitialValueInfo& problem_;
  std::string end_;
  int digits_;
  AdvicePoint::Wanted wanted_;
  ProblemTruths truths_;
};

class SceneAdvice final : public AdviceCase {
 public:
  explicit SceneAdvice(const AdviceOptions& o)
      : o_(o),
        ladder_(scene_ladder(o.name, o.overrides, "", o.until, coarser_levels,
                             scene_levels - 1 - coarser_levels)) {
    ReferenceRequest request;
    request.scene = ladder_.scene;
    // It is made finer until it is good enough, and no finer.
    request.finest_steps = ladder_.rungs.front().steps;
    request.instants = ladder_.instants;
    request.bits = static_cast<long>(std::ceil(-std::log2(o.error))) + 16;
    request.wanted_error = reference_share * o.error;
    request.most_work = 5 * most_reference_work;
    reference_ = shared_reference(request);
    for (const auto& type : fine_types(o)) {
      for (const auto& integrator : admitted(ladder_, select_integrators_of(o.integrators)))
        choices_.push_back({type, integrator, Steps::equal});
    }
    size_m_ = scene_size(*rough_engine());
    smooth_ = admits(ladder_.scene, rough_type(), "velocity_verlet");
  }

  void prepare(const ode::StopFlag& stop) const override { static_cast<void>(reference_->get(stop)); }
  // A few steps are taken: what a step costs is measured, what its error is is not assumed.
  [[nodiscard]] AdviceCurve curve(const Choice& choice) const override {
    using Clock = std::chrono::steady_clock;
    SceneRequest scene = ladder_.scene;
    scene.integrator = choice.integrator;
    const auto engine = engine_of(choice.type, dem::Level::own, make_job(scene));
    constexpr std::uint64_t probe = 4;
    engine->step(1);
    const auto start = Clock::now();
    engine->step(probe);
    const double step_s = std::chrono::duration<double>(Clock::now() - start).count() / probe;
    return {static_cast<int>(ladder_.rungs.size()), step_s * static_cast<double>(ladder_.rungs.front().steps),
            2};
  }
  [[nodiscard]] std::unique_ptr<SettingMeasurement> setting(const Choice& choice,
                                                            int quarter) const override {
    return scene_setting(ladder_, rung_between(ladder_, static_cast<double>(quarter) / quarters_of_level),
                         choice.type, choice.integrator, reference_);
  }
  [[nodiscard]] AdvicePoint::Wanted wanted() const override { return AdvicePoint::Wanted::on_the_way; }

  [[nodiscard]] std::string step_words(const WorkSetting& s) const override {
    return fmt::format("{} steps of {:.6g} s", s.steps, s.dt_value);
  }

  [[nodiscard]] std::string error_words() const override {
    return fmt::format(
        "largest position error up to t = {} s{} against the converged reference, relative to the scene's "
        "size "
        "of {:.3g} m",
        ladder_.end, shorter_words(), size_m_);
  }
  [[nodiscard]] std::string kink_words(const std::string& integrator) const override {
    if (smooth_) {
      return integrator == "leapfrog"
                 ? "the leapfrog takes v(0) for that of half a step before, which costs it an order"
                 : "steps are too long for the order to show";
    }
    return "force kink: contacts begin and end within steps";
  }
  [[nodiscard]] std::string contact_words(const WorkSetting& s) const override {
    if (smooth_) return "";
    std::vector<std::string> words;
    if (const auto t_c = collision_time_s())
      words.push_back(fmt::format("{:.3g} steps a contact (t_c = {:g} s)", *t_c / s.dt_value, *t_c));
    const auto engine = rough_engine();
    for (const auto* name : {"stiffness", "rayleigh"}) {
      const dem::CriticalStep critical = engine->critical_step(name);
      if (critical.refusal.empty() && std::isfinite(critical.step_s) && critical.step_s > 0)
        words.push_back(fmt::format("{:.2g} of the critical step by {}", s.dt_value / critical.step_s, name));
    }
    return fmt::format("{}", fmt::join(words, ", "));
  }
  [[nodiscard]] std::string run_command(const WorkSetting& s) const override {
    SceneRequest scene = ladder_.scene;
    scene.dt = s.dt;
    scene.steps.reset();
    scene.until = ladder_.end;
    const bool exact = make_job(scene).steps == s.steps;
    return fmt::format("ulpgate scene run {} --types {} --integrator {} --dt '{}' {}{}", o_.name, s.type,
                       s.integrator, s.dt,
                       exact ? "--until " + ladder_.end : "--steps " + std::to_string(s.steps), set_words());
  }
  [[nodiscard]] std::string measure_command(const WorkSetting& s) const override {
    return fmt::format("ulpgate work-precision --cases {} --types {} --integrators {} --dt '{}' --until {}{}",
                       o_.name, s.type, s.integrator, s.dt, ladder_.end, set_words());
  }

 private:
  // That no --until was given, and the scene goes on.
  [[nodiscard]] std::string shorter_words() const {
    if (ladder_.own_end_s <= ladder_.until_s * (1 + 1e-9)) return "";
    return fmt::format(" (the scene's own end is {:.6g} s: --until goes further)", ladder_.own_end_s);
  }
  [[nodiscard]] std::unique_ptr<dem::DemEngine> rough_engine() const {
    return engine_of(rough_type(), dem::Level::own, make_job(ladder_.scene));
  }
  [[nodiscard]] std::string set_words() const {
    std::string words;
    for (const auto& text : o_.overrides) words += " --set '" + text + "'";
    return words;
  }
  // The shortest of the scene's visco-elastic contacts.
  [[nodiscard]] std::optional<double> collision_time_s() const {
    const scenes::Scene scene = make_job(ladder_.scene).loaded.scene;
    if (scene.law != scenes::ContactLaw::viscoelastic) return std::nullopt;
    scenes::Evaluator<double> evaluate;
    for (const auto& [name, value] : scene.constants) evaluate.define(name, evaluate(value));
    double least = HUGE_VAL;
    for (const auto& m : scene.materials) least = std::min(least, evaluate(m.collision_time));
    return std::isfinite(least) ? std::optional(least) : std::nullopt;
  }

  AdviceOptions o_;
  SceneLadder ladder_;
  SharedReference reference_;
  double size_m_ = 1;
  bool smooth_ = false;
};

}  // namespace

std::unique_ptr<AdviceCase> make_advice_case(const AdviceOptions& o) {
  std::unique_ptr<AdviceCase> made;
  if (const auto* problem = find_problem(o.name)) {
    if (!o.overrides.empty())
      throw Failure(Standing::bad_input, fmt::format("--set is of scenes; {} is none", o.name));
    made = std::make_unique<TrajectoryAdvice>(*problem, o);
  } else {
    const bool file = o.name.find_first_of("./") != std::string::npos;
    const bool scene = std::ranges::any_of(builtin_scenes(), [&](const auto& b) { return o.name == b.name; });
    if (!file && !scene) {
      auto known = problem_names();
      for (const auto& b : builtin_scenes()) known.emplace_back(b.name);
      unknown_name("scene or case", o.name, known);
    }
    made = std::make_unique<SceneAdvice>(o);
  }
  if (made->choices().empty()) {
    throw Failure(Standing::incomplete,
                  fmt::format("no integrator of --integrators {} applies to {}", o.integrators, o.name));
  }
  return made;
}

std::optional<std::string> wider_type(const std::string& token) {
  const int bits = type_or_fail(token).significand_bits;
  const RealDescriptor* best = nullptr;
  for (const auto& type : all_types()) {
    if (type.significand_bits < bits + 8) continue;
    if (best == nullptr || type.significand_bits < best->significand_bits) best = &type;
  }
  return best == nullptr ? std::nullopt : std::optional(best->token);
}

}  // namespace ulpgate::app
