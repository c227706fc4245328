// Evaluating and judging one state of a kernel.
#include "harness/core/scene_cases/kernel_state_case.hpp"

#include <cmath>
#include <sstream>
#include <utility>

#include "harness/core/subject/registry.hpp"
#include "reference/types/rounding.hpp"

namespace ulpgate {

namespace {

std::vector<std::string> words_of(std::string_view text) {
  std::istringstream in{std::string(text)};
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

WideReal wide_power_of_two(long exponent) {
  WideReal x(1);
  mpfr_set_ui_2exp(x.backend().data(), 1, exponent, MPFR_RNDN);
  return x;
}

WideReal wide_of(const std::string& text) {
  WideReal x(0);
  // Of a NaN and an infinity as well; what the point wrote is a number.
  mpfr_set_str(x.backend().data(), text.c_str(), 0, MPFR_RNDN);
  return x;
}

bool is_number(const WideReal& x) {
  return mpfr_number_p(x.backend().data()) != 0;
}

WideReal norm_of(const std::vector<WideReal>& v) {
  WideReal sum(0);
  for (const auto& x : v) sum += x * x;
  return sqrt(sum);
}

WideReal distance_of(const std::vector<WideReal>& a, const std::vector<WideReal>& b) {
  std::vector<WideReal> d;
  for (std::size_t i = 0; i < a.size(); ++i) d.push_back(a[i] - b[i]);
  return norm_of(d);
}

int rank_of(StressVerdict verdict) {
  switch (verdict) {
    case StressVerdict::refused:
      return 5;
    case StressVerdict::diverged:
      return 4;
    case StressVerdict::wrong_outcome:
      return 3;
    case StressVerdict::unstable:
      return 2;
    case StressVerdict::ill_conditioned:
      return 1;
    case StressVerdict::stable:
      break;
  }
  return 0;
}

// One part of the result against the truth.
StressRow judge_part(const KernelStateCase& c, const KernelPoint& p, const FloatFormat& format, std::size_t q,
                     int scan) {
  StressRow row;
  const PointPart& part = p.point.parts[q];
  row.condition = std::isfinite(part.condition) ? std::optional(part.condition) : std::nullopt;
  if (part.judgement.outcome == Outcome::exception) {
    row.verdict = StressVerdict::refused;
    row.why = "the kernel threw";
    return row;
  }
  for (const auto& x : p.got[q]) {
    if (is_number(x)) continue;
    row.verdict = StressVerdict::diverged;
    const std::string& exact = part.exact_decimal[static_cast<std::size_t>(&x - p.got[q].data())];
    row.why = "a component is not finite; in RealHP<4> it is " + exact;
    return row;
  }
  // Decimals of the reference are for people: its error is the point's own.
  double error = part.normwise_error.value_or(0) * p.roundoff;
  for (const KnownPart& known : c.truth) {
    if (known.part != q) continue;
    const auto evaluate = state_names(format, scan);
    std::vector<WideReal> truth;
    for (const auto& text : known.components) truth.push_back(evaluate(text));
    const WideReal size = norm_of(truth);
    const WideReal distance = distance_of(p.got[q], truth);
    error = distance == 0 ? 0 : size == 0 ? HUGE_VAL : static_cast<double>(WideReal(distance / size));
  }
  if (!std::isfinite(error)) {
    // A truth of 0 has no relative error: what is not 0 is another outcome.
    row.verdict = StressVerdict::wrong_outcome;
    row.why = "not 0, where 0 is true";
    return row;
  }
  row.error = error;
  row.verdict = judge_stress(*row.error, part.condition, p.roundoff);
  return row;
}

}  // namespace

scenes::Evaluator<WideReal> state_names(const FloatFormat& format, int scan) {
  scenes::Evaluator<WideReal> names;
  names.define("u", wide_power_of_two(-format.precision));
  names.define("huge",
               wide_power_of_two(format.exponent_max) * (2 - wide_power_of_two(1 - format.precision)));
  names.define("least", wide_power_of_two(format.exponent_least()));
  names.define("normal", wide_power_of_two(format.exponent_min));
  names.define("small", wide_power_of_two(format.exponent_min / 2));
  names.define("large", wide_power_of_two(format.exponent_max / 2));
  names.define("s", wide_power_of_two(scan));
  return names;
}

KernelPoint evaluate_state(std::string_view kernel, const RealDescriptor& type, std::string_view inputs,
                           int scan) {
  const Subject* subject = find_subject(kernel, type.token);
  if (subject == nullptr) throw std::invalid_argument("no kernel '" + std::string(kernel) + "'");
  const auto words = words_of(inputs);
  if (words.size() != subject->info().input_components())
    throw std::invalid_argument(std::string(kernel) + " takes " +
                                std::to_string(subject->info().input_components()) + " numbers, not " +
                                std::to_string(words.size()));
  KernelPoint p;
  p.roundoff = unit_roundoff(type.significand_bits);
  std::vector<MpfrValue> arguments;
  {
    const WideExponentRange wide;
    const auto evaluate = state_names(type.format, scan);
    for (const auto& word : words) {
      const WideReal x = evaluate(word);
      MpfrValue& value = arguments.emplace_back(std::numeric_limits<WideReal>::digits);
      mpfr_set(value, x.backend().data(), MPFR_RNDN);
      round_to_format(value, type.format);
      WideReal rounded(0);
      mpfr_set(rounded.backend().data(), value, MPFR_RNDN);
      p.inputs.push_back(rounded);
    }
  }
  p.point = subject->point(arguments);
  const WideExponentRange wide;
  for (const auto& part : p.point.parts) {
    auto& got = p.got.emplace_back();
    for (const auto& text : part.got_hex) got.push_back(wide_of(text));
    auto& exact = p.exact.emplace_back();
    for (const auto& text : part.exact_decimal) exact.push_back(wide_of(text));
  }
  return p;
}

StressRow judge_state(const KernelStateCase& c, const RealDescriptor& type, int scan) {
  const KernelPoint p = evaluate_state(c.kernel, type, c.inputs, scan);
  const WideExponentRange wide;
  std::optional<StressRow> worst;
  for (std::size_t q = 0; q < p.point.parts.size(); ++q) {
    StressRow row = judge_part(c, p, type.format, q, scan);
    const std::string& name = find_subject(c.kernel, type.token)->info().parts[q].name;
    if (!row.why.empty()) row.why = name + ": " + row.why;
    const auto weight = [](const StressRow& r) {
      const double kappa = r.condition && *r.condition > 1 ? *r.condition : 1;
      return std::pair(rank_of(r.verdict), r.error ? *r.error / kappa : HUGE_VAL);
    };
    if (!worst || weight(row) > weight(*worst)) worst = std::move(row);
  }
  if (c.outcome && rank_of(worst->verdict) < rank_of(StressVerdict::diverged)) {
    if (std::string wrong = c.outcome(p); !wrong.empty()) {
      worst->verdict = StressVerdict::wrong_outcome;
      worst->why = std::move(wrong);
    }
  }
  if (worst->error) {
    const double most = type.significand_bits * std::log10(2.0);
    const double digits = *worst->error > 0 ? -std::log10(*worst->error) : most;
    worst->correct_digits = std::min(most, std::max(0.0, digits));
  }
  // What is held against a closed form or an outcome is shown by the case alone, not by its kernel.
  if (!c.truth.empty() || c.outcome) return *worst;
  worst->reproducer = "ulpgate at " + c.kernel + " " + type.token;
  for (const auto& x : p.point.args_hex) worst->reproducer += " " + x;
  return *worst;
}

StressCase as_stress_case(KernelStateCase c) {
  StressCase out;
  out.kind = "state";
  out.name = c.name;
  out.form = c.form;
  out.title = c.title;
  out.known = c.known;
  out.cost = 0.01;
  out.run = [c = std::move(c)](std::string_view token,
                               const ode::StopFlag& stop) -> std::optional<StressRow> {
    const RealDescriptor* type = find_type(token);
    if (type == nullptr) return std::nullopt;
    if (c.scan_step == 0) return judge_state(c, *type, 0);
    StressRow last;
    const int direction = c.scan_step > 0 ? 1 : -1;
    for (int k = 0; direction * k <= direction * c.scan_end; k += c.scan_step) {
      stop.check();
      last = judge_state(c, *type, k);
      if (rank_of(last.verdict) < rank_of(StressVerdict::unstable)) continue;
      last.first_wrong = "s = 2^" + std::to_string(k);
      last.figures["log2_s"] = k;
      break;
    }
    return last;
  };
  return out;
}

}  // namespace ulpgate
