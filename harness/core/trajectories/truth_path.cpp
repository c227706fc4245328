// true_path().
#include "harness/core/trajectories/truth_path.hpp"

#include "harness/core/trajectories/truth.hpp"
#include "harness/core/trajectories/truth_integration.hpp"
#include "reference/text/text.hpp"

namespace ulpgate {

namespace {

template <RealType Real>
[[nodiscard]] std::vector<Real> numbers_of(const ComparedTimes& times, std::string_view end_text) {
  const Real end = ode::end_time<Real>(end_text);
  std::vector<Real> numbers;
  for (const double t : times.graded) numbers.push_back(static_cast<Real>(t));
  for (std::uint64_t k = 1; times.graded.empty() && k < times.equal_parts; ++k)
    numbers.push_back(end * static_cast<Real>(k) / static_cast<Real>(times.equal_parts));
  numbers.push_back(end);
  return numbers;
}

// Of all components at all times the fewest digits.
template <RealType Real>
[[nodiscard]] double least_agreement(const std::vector<std::vector<Real>>& a,
                                     const std::vector<std::vector<Real>>& b, ErrorNorm norm) {
  using std::abs;
  double least = HUGE_VAL;
  for (std::size_t k = 0; k < b.size(); ++k) {
    Real largest(0);
    for (const Real& x : b[k]) largest = std::max<Real>(largest, abs(x));
    for (std::size_t i = 0; i < b[k].size(); ++i) {
      const Real size = norm == ErrorNorm::componentwise ? Real(abs(b[k][i])) : largest;
      least = std::min(least, truth::agreement<Real>(a[k][i], b[k][i], size));
    }
  }
  return least;
}

template <RealType Real>
[[nodiscard]] TruePath path_of(const std::vector<std::vector<Real>>& states, ErrorNorm norm, int digits) {
  TruePath path{{}, norm, std::pow(10.0, -digits)};
  MpfrValue exact(std::numeric_limits<Real>::digits);
  for (const auto& state : states) {
    auto& texts = path.states.emplace_back();
    for (const Real& x : state) {
      to_mpfr(exact.get(), x);
      // Rounded far below what they are good for.
      texts.push_back(to_decimal(exact.get(), digits + 5));
    }
  }
  return path;
}

template <RealType Real>
[[nodiscard]] TruePath settled(std::string_view problem, std::string_view end, const ComparedTimes& times,
                               int digits, const ode::StopFlag& stop) {
  const auto p = truth::prepare<Real>(problem, end);
  const auto at = numbers_of<Real>(times, end);
  const ErrorNorm norm = p.stiff ? ErrorNorm::componentwise : ErrorNorm::normwise;
  // Radau's estimate is of a far lower order than its error, the extrapolation's is of nearly the same.
  double exponent = p.stiff ? 0.85 * digits : digits + 4.0;
  const double finer = 2;
  const int order = p.stiff ? 9 : 12 + digits / 10;
  bool high = false;
  const auto integrated = [&] {
    const int of = order + (high ? (p.stiff ? 4 : 3) : 0);
    high = !high;
    return truth::integrated<Real>(p, at, {of, std::pow(10.0, -exponent)}, digits, stop);
  };
  double least = 0;
  std::vector<std::vector<Real>> before;
  while (exponent <= std::numeric_limits<Real>::digits10 - 8) {
    if (before.empty()) before = integrated();
    exponent += finer;
    auto now = integrated();
    least = least_agreement<Real>(before, now, norm);
    if (least >= digits) return path_of<Real>(now, norm, digits);
    // They agree on what the first is good for; the second serves again where it is good enough.
    before = least + finer > digits ? std::move(now) : std::vector<std::vector<Real>>();
    if (before.empty()) exponent += digits + 1 - least - finer;
  }
  throw std::runtime_error("two integrations of " + std::string(problem) + " to t = " + std::string(end) +
                           " agree on " + std::to_string(static_cast<int>(least)) + " digits only");
}

}  // namespace

TruePath true_path(std::string_view problem, std::string_view end, const ComparedTimes& times, int digits,
                   const ode::StopFlag& stop) {
  if (digits < 1 || digits > most_truth_digits)
    throw std::invalid_argument("a true solution has 1 to " + std::to_string(most_truth_digits) + " digits");
  if (times.equal_parts < 1) throw std::invalid_argument("times to compare at: none");
  return digits > 34 ? settled<MpfrReal<150>>(problem, end, times, digits, stop)
                     : settled<MpfrReal<62>>(problem, end, times, digits, stop);
}

}  // namespace ulpgate
