// Problems and distances, in a type that holds every state exactly.
#include "harness/core/trajectories/trajectory_engine.hpp"

#include <array>
#include <cmath>
#include <stdexcept>

#include "kernels/ode/problems/initial_value_cases.hpp"
#include "reference/types/mpfr_value.hpp"

namespace ulpgate {

namespace {

// |a - b| and |b| of components, rounded to double: relative distances are wanted to a few digits, but the
// difference is exact.
struct Gap {
  double difference;
  double size;
};

Gap gap(const std::string& a, const std::string& b) {
  constexpr mpfr_prec_t bits = 4096;
  MpfrValue x(bits);
  MpfrValue y(bits);
  mpfr_strtofr(x.get(), a.c_str(), nullptr, 0, MPFR_RNDN);
  mpfr_strtofr(y.get(), b.c_str(), nullptr, 0, MPFR_RNDN);
  Gap g{};
  MpfrValue d(bits);
  mpfr_sub(d.get(), x.get(), y.get(), MPFR_RNDN);
  g.difference = std::abs(mpfr_get_d(d.get(), MPFR_RNDN));
  g.size = std::abs(mpfr_get_d(y.get(), MPFR_RNDN));
  return g;
}

void require_same_length(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  if (a.size() != b.size() || a.empty()) throw std::invalid_argument("states of different lengths");
}

std::vector<InitialValueInfo> make_problems() {
  std::vector<InitialValueInfo> list;
  for (const auto& c : ode::initial_value_cases<double>()) {
    list.push_back({c.name, c.ends, c.problem.start.size(), c.stiff,
                    static_cast<bool>(c.problem.acceleration), static_cast<bool>(c.invariant)});
  }
  return list;
}

}  // namespace

const std::vector<InitialValueInfo>& initial_value_problems() {
  static const std::vector<InitialValueInfo> list = make_problems();
  return list;
}

const TrajectoryEngine& reference_trajectory_engine(int significand_bits) {
  // The least of those built that is wide enough.
  const TrajectoryEngine* best = nullptr;
  for (const std::string_view token : trajectory_references()) {
    const TrajectoryEngine* engine = find_trajectory_engine(token);
    const int bits = engine->significand_bits();
    if (bits < 200 || bits < 2 * significand_bits) continue;
    if (best == nullptr || bits < best->significand_bits()) best = engine;
  }
  if (best == nullptr)
    throw std::invalid_argument("no reference of " + std::to_string(2 * significand_bits) +
                                " bits is built in");
  return *best;
}

double relative_distance(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  require_same_length(a, b);
  double difference = 0;
  double size = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Gap g = gap(a[i], b[i]);
    if (!(g.difference <= difference)) difference = g.difference;
    size = std::max(size, g.size);
  }
  return difference == 0 ? 0 : difference / size;
}

double componentwise_distance(const std::vector<std::string>& a, const std::vector<std::string>& b,
                              const std::vector<double>& sizes) {
  require_same_length(a, b);
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Gap g = gap(a[i], b[i]);
    const double weight = std::max(g.size, 1e-30 * sizes.at(i));
    if (g.difference == 0) continue;
    const double relative = g.difference / weight;
    if (!(relative <= largest)) largest = relative;
  }
  return largest;
}

}  // namespace ulpgate
