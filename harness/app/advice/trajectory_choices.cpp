// What trajectories may be measured with: problems, integrators, ends, steps, truths.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "harness/app/advice/work_precision_job.hpp"
#include "harness/app/shell/selection.hpp"
#include "kernels/ode/integrators/integrators.hpp"
#include "reference/text/text.hpp"

namespace ulpgate::app {

namespace {

// The tolerances of "1e-6" or "1e-3..1e-12".
void add_tolerances(const std::string& word, const std::string& text, std::vector<double>& found) {
  const auto dots = text.find("..");
  const auto read = [&](const std::string& number) {
    double t = 0;
    const auto end = std::from_chars(number.data(), number.data() + number.size(), t);
    const bool whole = end.ec == std::errc() && end.ptr == number.data() + number.size();
    if (whole && t >= finest_tolerance && t <= coarsest_tolerance) return t;
    throw Failure(Standing::bad_input, fmt::format("--dt '{}': '{}' is no tolerance from {:g} to {:g}", word,
                                                   number, finest_tolerance, coarsest_tolerance));
  };
  const double first = read(text.substr(0, dots));
  const double last = dots == std::string::npos ? first : read(text.substr(dots + 2));
  if (last > first)
    throw Failure(Standing::bad_input,
                  fmt::format("--dt '{}': tolerances fall, as in plan:1e-3..1e-12", word));
  constexpr double slack = 1e-9;
  double t = first;
  // A decade below as it would be typed.
  for (int k = 1; t >= last * (1 - slack); ++k) {
    found.push_back(t);
    t = std::stod(fmt::format("{:.15g}", first / std::pow(10.0, k)));
  }
}

// What a TruePath is kept as.
std::vector<std::string> lines_of(const TruePath& path) {
  std::vector<std::string> lines = {
      fmt::format("truth {} {}", path.norm == ErrorNorm::componentwise ? "componentwise" : "normwise",
                  to_hexfloat(path.error))};
  for (const auto& state : path.states) lines.push_back(fmt::format("{}", fmt::join(state, " ")));
  return lines;
}
std::optional<TruePath> path_of(const std::vector<std::string>& lines) {
  const auto words = lines.empty() ? std::vector<std::string>() : split(lines.front(), ' ');
  if (words.size() != 3 || words[0] != "truth" || lines.size() < 2) return std::nullopt;
  TruePath path;
  path.norm = words[1] == "componentwise" ? ErrorNorm::componentwise : ErrorNorm::normwise;
  path.error = parse_real<double>(words[2]);
  for (std::size_t i = 1; i < lines.size(); ++i) path.states.push_back(split(lines[i], ' '));
  return path;
}

SharedTruth kept_truth(const std::string& key, SharedTruth computed, KeptPlace kept) {
  return std::make_shared<Shared<TruePath>>(
      [key, computed = std::move(computed), kept = std::move(kept)](const ode::StopFlag& stop) {
        if (!kept || !*kept) return computed->get(stop);
        if (const auto lines = (*kept)->find(key)) {
          if (auto path = path_of(*lines)) return std::move(*path);
        }
        const TruePath& path = computed->get(stop);
        (*kept)->keep(key, lines_of(path));
        return path;
      });
}

}  // namespace

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

ProblemTruths kept_truths(const std::string& problem, const std::string& end, int digits,
                          const KeptPlace& kept) {
  const ProblemTruths computed = shared_truths(problem, end, digits);
  const std::string key = fmt::format("truth of {} to {}, {} digits, at ", problem, end, digits);
  return {kept_truth(key + "equal times", computed.equal, kept),
          kept_truth(key + "graded times", computed.graded, kept)};
}

int default_digits(const std::vector<std::string>& types) {
  int bits = 0;
  for (const auto& type : types) bits = std::max(bits, type_or_fail(type).significand_bits);
  return std::clamp(static_cast<int>(bits * std::numbers::log10e * std::numbers::ln2) + 3, 15, 34);
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
  steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
  return steps;
}

DtChoices dt_choices(const std::string& text) {
  DtChoices choices;
  for (const auto& word : split(text, ',')) {
    if (word.starts_with(plan_mark)) {
      add_tolerances(word, word.substr(plan_mark.size()), choices.tolerances);
    } else {
      choices.of_scenes += (choices.of_scenes.empty() ? "" : ",") + word;
    }
  }
  if (!text.empty() && choices.of_scenes.empty() && choices.tolerances.empty())
    throw Failure(Standing::bad_input, fmt::format("--dt '{}': names no step", text));
  std::ranges::sort(choices.tolerances, std::ranges::greater{});
  choices.tolerances.erase(std::unique(choices.tolerances.begin(), choices.tolerances.end()),
                           choices.tolerances.end());
  return choices;
}

}  // namespace ulpgate::app
