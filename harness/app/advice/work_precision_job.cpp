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
#include "kernels/ode/problems/initial_value_cases.hpp"

namespace ulpgate::app {

namespace {

// Steps of a scene by default: its own times 2 down to its own over 16.
constexpr int coarser = 1;
constexpr int finer = 4;

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
  explicit JobMaker(const WorkPrecisionOptions& o) : o_(o) { job_.types = select_types(o.types); }

  [[nodiscard]] WorkPrecisionJob make() {
    const Selected s = select(o_);
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
        fmt::format("ulpgate work-precision plan 1\ntypes {}\nsamples {} digits {} budget {:a}\n",
                    fmt::join(job_.types, " "), o_.samples, o_.digits, o_.budget);
    if (!o_.overrides.empty()) job_.plan_text += fmt::format("set {}\n", fmt::join(o_.overrides, " "));
    for (const auto& text : scene_texts_) job_.plan_text += fmt::format("scene {:016x}\n", fnv1a(text));
    for (const auto* m : job_.settings) job_.plan_text += m->setting().key() + "\n";
    job_.plan = fmt::format("{:016x}", fnv1a(job_.plan_text));
    return std::move(job_);
  }

 private:
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
    const std::string text = o_.steps.empty() ? (problem.stiff ? "16..4096" : "128..65536") : o_.steps;
    const auto steps = step_list(text);
    const SharedTruth truth = shared_truth(problem.name, end, o_.digits);
    for (const auto& integrator : integrators_) {
      for (const auto& type : job_.types) {
        const TrajectoryEngine& engine = *find_trajectory_engine(type);
        if (!engine.applies(integrator, problem.name)) continue;
        for (const auto n : steps) {
          WorkSetting s{WorkSubject::trajectory,
                        problem.name,
                        type,
                        integrator,
                        end,
                        "",
                        n,
                        ode::end_time<double>(end) / static_cast<double>(n)};
          add(std::make_unique<TrajectorySetting>(std::move(s), engine, truth, o_.budget),
              cost_of_operation(type) * evaluations_of_step(integrator));
        }
      }
    }
  }

  void add_scene(const std::string& name) {
    const SceneLadder ladder = scene_ladder(name, o_.overrides, o_.dt, o_.until, coarser, finer);
    scene_texts_.push_back(load_scene(name, o_.overrides).text);
    ReferenceRequest request;
    request.scene = ladder.scene;
    request.finest_steps = ladder.steps.back();
    request.most_steps = 16 * request.finest_steps;
    request.instants = ladder.instants;
    for (const auto& type : job_.types)
      request.bits = std::max<long>(request.bits, type_or_fail(type).significand_bits);
    request.wanted_error = std::ldexp(1e-3, static_cast<int>(-request.bits));
    const SharedReference reference = shared_reference(request);
    for (const auto& integrator : admitted(ladder, integrators_)) {
      for (const auto& type : job_.types) {
        for (std::size_t k = 0; k < ladder.dts.size(); ++k) {
          add(scene_setting(ladder, k, type, integrator, reference),
              10 * cost_of_operation(type) * evaluations_of_step(integrator));
        }
      }
    }
  }

  const WorkPrecisionOptions& o_;
  WorkPrecisionJob job_;
  std::vector<std::string> integrators_;
  std::vector<std::string> scene_texts_;
  std::string curve_;
  std::size_t group_ = 0;
};

}  // namespace

WorkPrecisionJob make_work_precision_job(const WorkPrecisionOptions& o) {
  return JobMaker(o).make();
}

std::vector<std::string> problem_names() {
  std::vector<std::string> names;
  for (const auto& p : initial_value_problems()) names.push_back(p.name);
  return names;
}

const InitialValueInfo* find_problem(const std::string& name) {
  const auto& all = initial_value_problems();
  const auto it = std::ranges::find(all, name, &InitialValueInfo::name);
  return it == all.end() ? nullptr : &*it;
}

std::vector<std::string> select_integrators_of(const std::string& text) {
  std::vector<std::string> known;
  for (const auto& i : ode::integrators()) known.push_back(i.name);
  if (text == "all") return known;
  const auto chosen = split(text, ',');
  for (const auto& name : chosen) {
    if (std::ranges::find(known, name) == known.end()) unknown_name("integrator", name, known);
  }
  if (chosen.empty()) throw Failure(Standing::bad_input, "--integrators names no integrator");
  std::erase_if(known, [&](const auto& name) { return std::ranges::find(chosen, name) == chosen.end(); });
  return known;
}

std::string end_of_problem(const InitialValueInfo& problem, const std::string& until) {
  if (until.empty()) return problem.ends.front();
  if (std::ranges::find(problem.ends, until) != problem.ends.end()) return until;
  throw Failure(Standing::bad_input, fmt::format("--until '{}': {} has the ends {}", until, problem.name,
                                                 fmt::join(problem.ends, ", ")));
}

std::vector<std::uint64_t> step_list(const std::string& text) {
  std::vector<std::uint64_t> steps;
  for (const auto& word : split(text, ',')) {
    const auto dots = word.find("..");
    const std::uint64_t first = parse_steps("--steps", word.substr(0, dots));
    const std::uint64_t last =
        dots == std::string::npos ? first : parse_steps("--steps", word.substr(dots + 2));
    if (last < first)
      throw Failure(Standing::bad_input, fmt::format("--steps '{}': ends before it begins", word));
    for (std::uint64_t n = first; n <= last; n *= 2) steps.push_back(n);
  }
  if (steps.empty()) throw Failure(Standing::bad_input, fmt::format("--steps '{}': names no number", text));
  std::ranges::sort(steps);
  const auto again = std::ranges::unique(steps);
  steps.erase(again.begin(), again.end());
  return steps;
}

}  // namespace ulpgate::app
