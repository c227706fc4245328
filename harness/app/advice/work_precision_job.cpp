// WorkPrecisionJob.
#include "harness/app/advice/work_precision_job.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "harness/app/shell/selection.hpp"
#include "harness/core/arguments/random_words.hpp"
#include "harness/core/work_precision/subject_setting.hpp"
#include "kernels/ode/integrators/integrators.hpp"

namespace ulpgate::app {

namespace {

// Steps of a scene by default: its own times 2 down to its own over 16.
constexpr int default_coarser = 1;
constexpr int default_finer = 4;

struct Selected {
  std::vector<std::string> functions, kernels, problems, scenes;
};

void add_once(std::vector<std::string>& list, const std::string& name) {
  if (std::ranges::find(list, name) == list.end()) list.push_back(name);
}

void select_subject(const std::string& word, Selected& s) {
  if (word == "function" || word == "kernel") {
    const auto kind = word == "function" ? SubjectKind::function : SubjectKind::kernel;
    for (const auto* info : subjects_of(kind))
      add_once(kind == SubjectKind::function ? s.functions : s.kernels, info->name);
  } else if (word == "trajectory") {
    for (const auto& name : problem_names()) add_once(s.problems, name);
  } else if (word == "scene") {
    for (const auto& scene : builtin_scenes()) add_once(s.scenes, scene.name);
  } else {
    std::vector<std::string> known = {"function", "kernel", "trajectory", "scene"};
    for (const auto kind : {SubjectKind::function, SubjectKind::kernel}) {
      for (const auto* info : subjects_of(kind)) {
        known.push_back(info->name);
        if (info->name == word)
          return add_once(kind == SubjectKind::function ? s.functions : s.kernels, word);
      }
    }
    unknown_name("subject", word, known);
  }
}

void select_case(const std::string& word, Selected& s) {
  if (find_problem(word) != nullptr) return add_once(s.problems, word);
  const bool file = word.find_first_of("./") != std::string::npos;
  const bool scene = std::ranges::any_of(builtin_scenes(), [&](const auto& b) { return word == b.name; });
  if (file || scene) return add_once(s.scenes, word);
  auto known = problem_names();
  for (const auto& b : builtin_scenes()) known.emplace_back(b.name);
  unknown_name("case", word, known);
}

Selected select(const WorkPrecisionOptions& o) {
  Selected s;
  for (const auto& word : split(o.subjects, ',')) select_subject(word, s);
  for (const auto& word : split(o.cases, ',')) select_case(word, s);
  if (o.subjects.empty() && o.cases.empty()) s.problems = {"kepler", "robertson"};
  return s;
}

// A guess for what an operation of a type costs.
double cost_of_operation(const std::string& token) {
  const auto bits = static_cast<double>(type_or_fail(token).format.precision);
  return bits <= 64 ? 1 : 20 + bits / 10;
}

class JobMaker {
 public:
  explicit JobMaker(const WorkPrecisionOptions& o) : o_(o) {
    job_.types = select_types(o.types);
    job_.kept = std::make_shared<std::optional<KeptResults>>();
    digits_ = o.digits > 0 ? o.digits : default_digits(job_.types);
  }

  [[nodiscard]] WorkPrecisionJob make() {
    const Selected s = select(o_);
    dts_ = dt_choices(o_.dt);
    refuse_unused(s);
    integrators_ = select_integrators_of(o_.integrators);
    for (const auto& list : {s.functions, s.kernels}) {
      for (const auto& name : list) {
        for (const auto& type : job_.types)
          add(std::make_unique<SubjectSetting>(subject_or_fail(name, type), o_.samples),
              cost_of_operation(type));
      }
    }
    for (const auto& name : s.problems) add_problem(*find_problem(name));
    for (const auto& name : s.scenes) add_scene(name);
    if (job_.settings.empty())
      throw Failure(Standing::incomplete, "no integrator of --integrators applies to any of the cases");
    job_.plan_text =
        fmt::format("ulpgate work-precision plan 2\ntypes {}\nsamples {} digits {} budget {:a}\n",
                    fmt::join(job_.types, " "), o_.samples, digits_, o_.budget);
    if (!o_.overrides.empty()) job_.plan_text += fmt::format("set {}\n", fmt::join(o_.overrides, " "));
    for (const auto& text : scene_texts_) job_.plan_text += fmt::format("scene {:016x}\n", fnv1a(text));
    for (const auto* m : job_.settings) job_.plan_text += m->setting().key() + "\n";
    job_.plan = fmt::format("{:016x}", fnv1a(job_.plan_text));
    return std::move(job_);
  }

 private:
  // An option that nothing would use was meant for something.
  void refuse_unused(const Selected& s) const {
    const auto refuse = [](bool unused, const std::string& option, const char* why) {
      if (unused) throw Failure(Standing::bad_input, option + ": " + why);
    };
    refuse(!o_.steps.empty() && s.problems.empty(), "--steps", "no initial value problem is among the cases");
    refuse(!dts_.tolerances.empty() && s.problems.empty(), "--dt plan",
           "steps are planned for initial value problems, and none is among the cases");
    refuse(!dts_.of_scenes.empty() && s.scenes.empty(), "--dt",
           "no scene is among the cases; problems have --steps 1024 or --dt plan:1e-6");
    refuse(!o_.overrides.empty() && s.scenes.empty(), "--set", "no scene is among the cases");
  }

  void add(std::unique_ptr<SettingMeasurement> m, double cost) {
    const std::string curve = m->setting().curve();
    if (curve != curve_) ++group_;
    curve_ = curve;
    job_.settings.push_back(m.get());
    job_.measurements.push_back(std::move(m));
    job_.costs.push_back({group_ - 1, cost, 0});
  }

  void add_problem(const InitialValueInfo& problem) {
    const std::string end = end_of_problem(problem, o_.until);
    // Stiff problems change fast at first and slowly later: equal steps are too long for one or too many for
    // the other.
    const bool planned = !dts_.tolerances.empty() || (problem.stiff && o_.steps.empty());
    const auto tolerances =
        !planned || !dts_.tolerances.empty() ? dts_.tolerances : dt_choices("plan:1e-3..1e-12").tolerances;
    const auto steps =
        planned ? std::vector<std::uint64_t>() : step_list(o_.steps.empty() ? "128..65536" : o_.steps);
    const ProblemTruths truths = kept_truths(problem.name, end, digits_, job_.kept);
    for (const auto& integrator : integrators_) {
      for (const auto& type : job_.types) {
        const TrajectoryEngine& engine = *find_trajectory_engine(type);
        if (!engine.applies(integrator, problem.name)) continue;
        const double cost = cost_of_operation(type) * evaluations_of_step(integrator);
        const auto add_setting = [&](const WorkSetting& s) {
          add(std::make_unique<TrajectorySetting>(s, engine, truths.of(s), o_.budget), cost);
        };
        for (const auto n : steps) add_setting(equal_setting(problem.name, type, integrator, end, n));
        for (const double t : tolerances)
          add_setting(planned_setting(problem.name, type, integrator, end, t));
      }
    }
  }

  void add_scene(const std::string& name) {
    const SceneLadder ladder =
        scene_ladder(name, o_.overrides, dts_.of_scenes, o_.until, default_coarser, default_finer);
    scene_texts_.push_back(load_scene(name, o_.overrides).text);
    ReferenceRequest request;
    request.scene = ladder.scene;
    request.finest_steps = ladder.rungs.back().steps;
    request.most_steps = 16 * request.finest_steps;
    request.instants = ladder.instants;
    for (const auto& type : job_.types)
      request.bits = std::max<long>(request.bits, type_or_fail(type).significand_bits);
    request.wanted_error = std::ldexp(1e-3, static_cast<int>(-request.bits));
    const SharedReference reference = shared_reference(request, job_.kept);
    for (const auto& integrator : admitted(ladder, integrators_)) {
      for (const auto& type : job_.types) {
        for (const auto& rung : ladder.rungs) {
          add(scene_setting(ladder, rung, type, integrator, reference),
              10 * cost_of_operation(type) * evaluations_of_step(integrator));
        }
      }
    }
  }

  const WorkPrecisionOptions& o_;
  WorkPrecisionJob job_;
  std::vector<std::string> integrators_;
  std::vector<std::string> scene_texts_;
  DtChoices dts_;
  int digits_ = 0;
  std::string curve_;
  std::size_t group_ = 0;
};

}  // namespace

WorkPrecisionJob make_work_precision_job(const WorkPrecisionOptions& o) {
  return JobMaker(o).make();
}

}  // namespace ulpgate::app
