// The comparison of measured limits of integrators with theory.
#include "harness/core/step_limits/integrator_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/core/step_limits/iteration_theory.hpp"
#include "harness/core/step_limits/stability_theory.hpp"
#include "harness/core/step_limits/stable_set.hpp"
#include "kernels/ode/integrators/integrators.hpp"

namespace ulpgate {

namespace {

constexpr double scan_end = 12;
constexpr double agreement = 1e-4;  // of measured limits with theory, relative

// One integrator on one problem in one type; the last step looked at is kept, since its excess and its
// rounding are asked for one after the other.
class Measured {
 public:
  Measured(const StabilityEngine& engine, LinearProblem problem, std::string_view integrator,
           const ode::StopFlag& stop)
      : engine_(engine), problem_(problem), integrator_(integrator), stop_(stop) {}

  const StepFactor& at(double z) {
    if (z != z_) {
      stop_.check();
      factor_ = problem_ == LinearProblem::oscillator ? engine_.oscillator(integrator_, z)
                                                      : engine_.decay(integrator_, z);
      z_ = z;
    }
    return factor_;
  }
  double excess(double z) {
    const StepFactor& f = at(z);
    return f.refusal.empty() ? f.excess : HUGE_VAL;
  }
  // A step of some dozen operations on numbers of the size of its matrix.
  double rounding(double z) { return 32 * roundoff() * (1 + std::min(at(z).norm, 1e6)); }
  [[nodiscard]] double roundoff() const { return unit_roundoff(engine_.significand_bits()); }

 private:
  const StabilityEngine& engine_;
  LinearProblem problem_;
  std::string integrator_;
  const ode::StopFlag& stop_;
  double z_ = -1;
  StepFactor factor_;
};

// The first step that the integrator refuses, found from small steps up.
struct Refusal {
  double from;
  std::string text;
};
std::optional<Refusal> first_refusal(Measured& measured, double spacing) {
  double accepted = 0;
  for (double z = spacing; z <= scan_end; z += spacing) {
    if (measured.at(z).refusal.empty()) {
      accepted = z;
      continue;
    }
    double refused = z;
    while (refused - accepted > 1e-3 * refused) {
      const double middle = (accepted + refused) / 2;
      (measured.at(middle).refusal.empty() ? accepted : refused) = middle;
    }
    return Refusal{refused, measured.at(refused).refusal};
  }
  return std::nullopt;
}

double theory_excess(const StabilityTheory& theory, LinearProblem problem, double z) {
  return problem == LinearProblem::oscillator ? theory.oscillator_excess(z) : *theory.decay_excess(z);
}

double theory_growth(const StabilityTheory& theory, LinearProblem problem, double z) {
  return problem == LinearProblem::oscillator ? theory.oscillator_growth(z) : *theory.decay_excess(z);
}

// Power and coefficient of the growth c z^p of a method without a stable interval, and the measured
// coefficient where the type has the digits: two steps, extrapolated.
void add_growth_from_nothing(StressRow& row, Measured& measured, const StabilityTheory& theory,
                             LinearProblem problem) {
  const double tiny = 1e-3;
  const double power =
      std::round(std::log2(theory_excess(theory, problem, 2 * tiny) / theory_excess(theory, problem, tiny)));
  const double wanted = theory_excess(theory, problem, tiny) / std::pow(tiny, power);
  row.figures["growth_power"] = power;
  row.figures["growth_coefficient_theory"] = wanted;
  double z = 0.5;
  while (z > 1e-2 && wanted * std::pow(z / 4, power) > 1e4 * measured.rounding(z / 4)) z /= 2;
  if (!(wanted * std::pow(z / 2, power) > 1e3 * measured.rounding(z / 2))) return;
  const double coarse = measured.excess(z) / std::pow(z, power);
  const double fine = measured.excess(z / 2) / std::pow(z / 2, power);
  row.figures["growth_coefficient"] = (4 * fine - coarse) / 3;
}

std::string list_of(const StableSet& set, Measured& measured, StressRow& row) {
  std::string text;
  int number = 0;
  for (const StepInterval& g : set.gaps()) {
    ++number;
    row.figures[fmt::format("gap_{}_from", number)] = g.from;
    row.figures[fmt::format("gap_{}_to", number)] = g.to;
    text += fmt::format("; gap {:.8g} to {:.8g}", g.from, g.to);
    const StepFactor& top = measured.at(g.largest_at);
    if (!top.refusal.empty()) continue;
    row.figures[fmt::format("gap_{}_growth", number)] = top.growth;
    text += fmt::format(", where it grows by up to {:.2g} a step", top.growth);
  }
  number = 0;
  for (const StepInterval& r : set.reentries()) {
    ++number;
    row.figures[fmt::format("reentry_{}_from", number)] = r.from;
    row.figures[fmt::format("reentry_{}_to", number)] = r.to;
    text += fmt::format("; stable again {:.8g} to {:.8g}", r.from, r.to);
  }
  return text;
}

// The sweep radius at which rounding is reached within the sweeps that the stepper allows (100 + digits).
double usable_radius(int bits) {
  return std::exp2(-static_cast<double>(bits - 7) / (100 + bits));
}

void add_iteration(StressRow& row, const Refusal& refusal, LinearProblem problem, int stages, int bits) {
  const Axis axis = problem == LinearProblem::oscillator ? Axis::imaginary : Axis::real;
  const double wanted = sweep_limit(stages, axis, usable_radius(bits));
  row.figures["iteration_limit"] = refusal.from;
  row.figures["iteration_limit_theory"] = wanted;
  row.figures["iteration_limit_without_end"] = sweep_limit(stages, axis, 1);
  row.figures["iteration_limit_1_over_rho_A"] = jacobi_limit(stages);
  row.why +=
      fmt::format("; refused from {:.4g} on ({}), where the sweeps over the stages fall too slowly: {:.4g}",
                  refusal.from, refusal.text, wanted);
  if (std::abs(refusal.from / wanted - 1) > 0.1) {
    row.verdict = StressVerdict::wrong_outcome;
    row.why += ", which is not where they are refused";
  }
}

// A limit in print that is of another arrangement of the coefficients: both are computed, and the printed one
// must be that of the arrangement that it is said to be of.
void compare_with_other_arrangement(StressRow& row, const StabilityTheory& theory,
                                    std::string_view integrator, double spacing) {
  const OtherArrangement* other = other_arrangement(integrator);
  if (other == nullptr) return;
  const auto other_theory = theory_of_other_arrangement(integrator);
  const StableSet set = find_stable_set([&](double z) { return other_theory->oscillator_excess(z); },
                                        [](double) { return 1e-28; }, scan_end, spacing);
  const double limit = set.limit().value_or(HUGE_VAL);
  const int own_order = theory.oscillator_order().value_or(0);
  const int order = other_theory->oscillator_order().value_or(0);
  row.figures["printed_elsewhere"] = other->printed;
  row.figures["other_arrangement_limit"] = limit;
  row.figures["other_arrangement_order"] = order;
  row.figures["order"] = own_order;
  row.why += fmt::format(
      "; tables give {:.7g}, which is the limit ({:.8g}) of {}, of order {}; this is {}, of order {}",
      other->printed, limit, other->other, order, other->own, own_order);
  if (std::abs(limit - other->printed) <= 1e-6 && order == other->other_order &&
      own_order == other->own_order)
    return;
  row.verdict = StressVerdict::wrong_outcome;
  row.why += ": the theory of one of them is not what it is said to be";
}

void compare(StressRow& row, Measured& measured, const StableSet& found, const StabilityTheory& theory,
             LinearProblem problem, std::string_view integrator, double spacing) {
  const double end = found.scanned_to;
  const ExcessOfStep of_theory = [&](double z) { return theory_excess(theory, problem, z); };
  const StableSet exact = find_stable_set(
      of_theory, [](double) { return 1e-28; }, end, spacing);
  const StableSet seen = find_stable_set(
      of_theory, [&](double z) { return measured.rounding(z); }, end, spacing);
  const std::optional<double> limit = found.limit();
  const std::optional<double> wanted = exact.limit();
  const std::optional<double> wanted_seen = seen.limit();
  if (wanted) row.figures["theory"] = *wanted;
  row.figures["gaps_hidden_by_rounding"] =
      std::max(0.0, static_cast<double>(exact.gaps().size()) - static_cast<double>(found.gaps().size()));
  double difference = 0;
  for (double z = spacing; z < std::min(end, 1.01 * limit.value_or(end)); z += spacing) {
    // The excess itself is a double.
    const double u = std::max(measured.roundoff(), 0x1p-52) * (1 + measured.at(z).norm);
    difference = std::max(difference, std::abs(measured.excess(z) - of_theory(z)) / u);
  }
  if (measured.roundoff() >= 0x1p-53) row.figures["step_matrix_error_u"] = difference;
  const bool none = wanted && *wanted == 0;
  bool agree = limit.has_value() == wanted_seen.has_value();
  if (agree && limit) {
    // Growth from nothing leaves the rounding where chance lets it.
    agree = none ? *limit <= 2 * *wanted_seen + 1e-3 && *wanted_seen <= 2 * *limit + 1e-3
                 : std::abs(*limit - *wanted_seen) <= agreement * *wanted_seen;
  }
  if (!agree || !(difference <= 256)) {
    row.verdict = StressVerdict::wrong_outcome;
    row.why += fmt::format("; theory has its limit at {:.8g}, the steps differ from it by {:.3g} u",
                           wanted_seen.value_or(HUGE_VAL), difference);
    return;
  }
  if (limit && !none && *limit * 1.01 < end) {
    const double z = *limit * 1.01;
    row.figures["growth_at_1.01_limit"] = measured.at(z).growth;
    row.figures["growth_at_1.01_limit_theory"] = theory_growth(theory, problem, z);
  }
  if (none) {
    row.verdict = StressVerdict::unstable;
    row.figures.erase("limit");
    row.figures["growth_seen_from"] = *limit;
    row.first_wrong = fmt::format("z = {:.3g}", *limit);
    add_growth_from_nothing(row, measured, theory, problem);
    row.why = fmt::format(
        "no stable step: the solution grows by {:.4g} z^{:.0f} a step; above rounding from z = {:.3g} on",
        row.figures["growth_coefficient_theory"], row.figures["growth_power"], *limit);
  }
  if (problem == LinearProblem::oscillator) compare_with_other_arrangement(row, theory, integrator, spacing);
  if (const KnownLimit* known = known_limit(integrator)) {
    const auto& published = problem == LinearProblem::oscillator ? known->oscillator : known->decay;
    if (published) row.figures["published"] = *published;
    const bool held = published ? wanted && std::abs(*wanted - *published) <= agreement
                                : problem == LinearProblem::decay || !known->oscillator_none || none;
    if (!held) {
      row.verdict = StressVerdict::wrong_outcome;
      row.why += fmt::format("; in print: {:.7g}", published.value_or(0));
    }
  }
}

StressCase case_of(const ode::IntegratorInfo& info, LinearProblem problem) {
  StressCase c;
  c.kind = "step_limit";
  const bool oscillator = problem == LinearProblem::oscillator;
  c.name = oscillator ? "oscillator" : "decay";
  c.form = info.name;
  c.title = std::string("Largest stable step of ") + info.name +
            (oscillator ? " on q'' = -q, z = omega dt" : " on y' = -y, z = lambda dt");
  if (const KnownLimit* known = known_limit(info.name);
      known != nullptr && oscillator && known->oscillator_none) {
    c.known.push_back(
        {"all", StressVerdict::unstable,
         "a property of the method: its stability region holds no interval of the imaginary axis"});
  }
  c.cost = info.stages > 0 ? 0.5 : 0.1;
  c.run = [name = info.name, problem](std::string_view token,
                                      const ode::StopFlag& stop) -> std::optional<StressRow> {
    const StabilityEngine* engine = find_stability_engine(token);
    if (engine == nullptr) return std::nullopt;
    return measure_step_limit(*engine, problem, name, stop);
  };
  return c;
}

}  // namespace

StressRow measure_step_limit(const StabilityEngine& engine, LinearProblem problem,
                             std::string_view integrator, const ode::StopFlag& stop) {
  Measured measured(engine, problem, integrator, stop);
  StressRow row;
  row.verdict = StressVerdict::stable;
  const ode::IntegratorInfo& info = ode::find_integrator(integrator);
  const bool implicit = info.kind == ode::IntegratorKind::collocation || ode::is_for_stiff(info.kind);
  const int bits = engine.significand_bits();
  const double spacing = implicit ? (bits > 113 ? 0.4 : 0.1) : bits > 113 ? 0.04 : 0.02;
  const std::optional<Refusal> refusal = first_refusal(measured, implicit ? spacing : 0.5);
  const double end = refusal ? 0.95 * refusal->from : scan_end;
  const StableSet found = find_stable_set([&](double z) { return measured.excess(z); },
                                          [&](double z) { return measured.rounding(z); }, end, spacing);
  if (const std::optional<double> limit = found.limit()) {
    row.figures["limit"] = *limit;
    row.why = fmt::format("stable up to z = {:.8g}", *limit);
  } else {
    row.why = fmt::format("stable at every z looked at, up to {:.4g}", end);
  }
  row.why += list_of(found, measured, row);
  if (implicit) row.why += "; A-stable: no limit";
  if (const auto theory = stability_theory(integrator)) {
    compare(row, measured, found, *theory, problem, integrator, spacing);
  } else {
    row.why += "; no theory is known here to hold it against";
  }
  if (refusal && info.kind == ode::IntegratorKind::collocation) {
    add_iteration(row, *refusal, problem, info.stages, bits);
  } else if (refusal) {
    row.why += fmt::format("; refused from {:.4g} on: {}", refusal->from, refusal->text);
  }
  return row;
}

std::vector<StressCase> integrator_limit_cases() {
  std::vector<StressCase> cases;
  for (const ode::IntegratorInfo& info : ode::integrators()) {
    // One that chooses its own inner steps has no largest one.
    if (!info.order) continue;
    cases.push_back(case_of(info, LinearProblem::oscillator));
    if (info.kind != ode::IntegratorKind::splitting) cases.push_back(case_of(info, LinearProblem::decay));
  }
  return cases;
}

}  // namespace ulpgate
