// WorkPrecisionRow and the text of an outcome.
#include "harness/core/work_precision/work_precision_row.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "harness/core/orders/piece_text.hpp"

namespace ulpgate {

namespace {

constexpr std::array<std::string_view, 4> subject_names = {"function", "kernel", "trajectory", "scene"};
constexpr std::array<std::string_view, 4> failure_names = {"", "diverged", "refused", "mismatch"};
constexpr std::string_view absent = "-";

template <class Enum, std::size_t N>
std::optional<Enum> named(std::string_view text, const std::array<std::string_view, N>& names) {
  const auto* it = std::ranges::find(names, text);
  if (it == names.end()) return std::nullopt;
  return static_cast<Enum>(it - names.begin());
}

std::string number_text(const std::optional<double>& x) {
  return x ? to_hexfloat(*x) : std::string(absent);
}
std::optional<double> number_of(std::string_view text) {
  if (text == absent) return std::nullopt;
  return parse_real<double>(text);
}

std::uint64_t whole_of(std::string_view text) {
  const long n = count_of(text);
  if (n < 0) throw std::invalid_argument("a negative count: '" + std::string(text) + "'");
  return static_cast<std::uint64_t>(n);
}

}  // namespace

std::string_view to_string(WorkSubject subject) {
  return subject_names.at(static_cast<std::size_t>(subject));
}
std::optional<WorkSubject> work_subject_of(std::string_view text) {
  return named<WorkSubject>(text, subject_names);
}
std::string_view to_string(WorkFailure failure) {
  return failure_names.at(static_cast<std::size_t>(failure));
}
std::optional<WorkFailure> work_failure_of(std::string_view text) {
  return named<WorkFailure>(text, failure_names);
}

std::string WorkSetting::curve() const {
  std::string text = std::string(to_string(subject)) + "/" + name + "/" + type;
  if (!integrator.empty()) text += "/" + integrator + "/" + end;
  return planned() ? text + "/planned" : text;
}

std::string WorkSetting::key() const {
  if (integrator.empty()) return curve();
  return curve() + "/" + std::to_string(steps) + (dt.empty() ? "" : "/" + dt);
}

std::optional<double> WorkOutcome::error() const {
  return final_error ? final_error : largest_error;
}

std::string WorkOutcome::to_text() const {
  std::string text(failure == WorkFailure::none ? absent : to_string(failure));
  text += " " + std::to_string(steps) + " " + std::to_string(evaluations);
  for (const auto& x : {final_error, largest_error, largest_error_ulp, energy_error, reference_error, t_s,
                        growth_rate, correct_digits})
    text += " " + number_text(x);
  text += " " + (instants ? std::to_string(*instants) : std::string(absent));
  text += t_s_to_the_end ? " 1" : " 0";
  // Whatever the error's text holds, a piece is one line.
  std::string words = why;
  std::ranges::replace_if(
      words, [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return words.empty() ? text : text + " " + words;
}

WorkOutcome WorkOutcome::from_text(std::string_view text) {
  constexpr std::size_t count = 13;
  std::array<std::string_view, count> words;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t end = text.find(' ');
    words.at(i) = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  const auto failure = work_failure_of(words[0] == absent ? "" : words[0]);
  if (!failure) throw std::invalid_argument("no outcome: '" + std::string(words[0]) + "'");
  WorkOutcome o;
  o.failure = *failure;
  o.steps = whole_of(words[1]);
  o.evaluations = whole_of(words[2]);
  o.final_error = number_of(words[3]);
  o.largest_error = number_of(words[4]);
  o.largest_error_ulp = number_of(words[5]);
  o.energy_error = number_of(words[6]);
  o.reference_error = number_of(words[7]);
  o.t_s = number_of(words[8]);
  o.growth_rate = number_of(words[9]);
  o.correct_digits = number_of(words[10]);
  if (words[11] != absent) o.instants = whole_of(words[11]);
  if (words[12] != "0" && words[12] != "1") throw std::invalid_argument("no outcome: it is cut");
  o.t_s_to_the_end = words[12] == "1";
  o.why = text;
  return o;
}

double correct_digits_of(double error, double most) {
  if (!(error > 0)) return std::isnan(error) ? 0 : most;
  return std::clamp(-std::log10(error), 0.0, most);
}

}  // namespace ulpgate
