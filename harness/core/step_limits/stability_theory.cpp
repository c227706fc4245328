// Stability functions as polynomials and ratios of them, and the known limits.
#include "harness/core/step_limits/stability_theory.hpp"

#include <array>
#include <numbers>
#include <vector>

#include "kernels/ode/coefficients/composition_rows.hpp"
#include "kernels/ode/integrators/explicit_runge_kutta.hpp"
#include "kernels/ode/integrators/integrators.hpp"
#include "kernels/ode/integrators/odeint_steppers.hpp"
#include "kernels/ode/integrators/splitting.hpp"

namespace ulpgate {

namespace {

using Wide = MpfrReal<62>;
using Polynomial = std::vector<Wide>;  // coefficients by rising power of z

Polynomial times(const Polynomial& a, const Polynomial& b) {
  Polynomial p(a.size() + b.size() - 1, Wide(0));
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) p[i + j] += a[i] * b[j];
  }
  return p;
}

// a + c z^power b.
Polynomial plus(Polynomial a, const Wide& c, const Polynomial& b, std::size_t power = 0) {
  if (a.size() < b.size() + power) a.resize(b.size() + power, Wide(0));
  for (std::size_t i = 0; i < b.size(); ++i) a[i + power] += c * b[i];
  return a;
}

Wide at(const Polynomial& p, const Wide& z) {
  Wide sum(0);
  for (std::size_t i = p.size(); i-- > 0;) sum = sum * z + p[i];
  return sum;
}

// p(iz) as real and imaginary part.
std::array<Wide, 2> at_imaginary(const Polynomial& p, const Wide& z) {
  std::array<Wide, 2> sum{Wide(0), Wide(0)};
  for (std::size_t i = p.size(); i-- > 0;) {
    const Wide real_part = p[i] - sum[1] * z;
    sum[1] = sum[0] * z;
    sum[0] = real_part;
  }
  return sum;
}

Wide growth_of_half_trace(const Wide& half) {
  const Wide size = abs(half);
  return size > 1 ? Wide(size - 1 + sqrt(Wide(size * size - 1))) : Wide(0);
}

class SplittingTheory final : public StabilityTheory {
 public:
  explicit SplittingTheory(const std::vector<ode::Substep<Wide>>& sequence) {
    for (const auto& s : sequence) {
      for (std::size_t column = 0; column < 2; ++column) {
        if (s.flow == ode::kKick) {
          v_[column] = plus(v_[column], -s.fraction, q_[column], 1);
        } else {
          q_[column] = plus(q_[column], s.fraction, v_[column], 1);
        }
      }
    }
    half_trace_ = times(plus(q_[0], Wide(1), v_[1]), {Wide(1) / 2});
  }

  [[nodiscard]] double oscillator_excess(double z) const override {
    return static_cast<double>(Wide(abs(at(half_trace_, Wide(z))) - 1));
  }
  [[nodiscard]] double oscillator_growth(double z) const override {
    return static_cast<double>(growth_of_half_trace(at(half_trace_, Wide(z))));
  }
  // Against cos z and sin z, power by power.
  [[nodiscard]] std::optional<int> oscillator_order() const override {
    const auto coefficient = [](const Polynomial& p, std::size_t power) {
      return power < p.size() ? p[power] : Wide(0);
    };
    Wide term(1);  // 1/power!, with the signs of the series
    for (std::size_t power = 1; power < most_order; ++power) {
      term /= static_cast<int>(power);
      const Wide cosine = power % 2 == 1 ? Wide(0) : power % 4 == 0 ? term : Wide(-term);
      const Wide sine = power % 2 == 0 ? Wide(0) : power % 4 == 1 ? term : Wide(-term);
      const Wide off = abs(coefficient(q_[0], power) - cosine) + abs(coefficient(q_[1], power) - sine) +
                       abs(coefficient(v_[0], power) + sine) + abs(coefficient(v_[1], power) - cosine);
      if (off > 1e-50) return static_cast<int>(power) - 1;
    }
    return std::nullopt;
  }
  [[nodiscard]] std::optional<double> decay_excess(double) const override { return std::nullopt; }

 private:
  static constexpr std::size_t most_order = 30;
  // Rows (q, v) of the step: q += d z v, v -= k z q.
  std::array<Polynomial, 2> q_{Polynomial{Wide(1)}, Polynomial{Wide(0)}};
  std::array<Polynomial, 2> v_{Polynomial{Wide(0)}, Polynomial{Wide(1)}};
  Polynomial half_trace_;
};

std::vector<ode::Substep<Wide>> kicks_and_drifts(const ode::CompositionRow& row) {
  return ode::substeps<Wide>(row.kind, ode::composition_parameters<Wide>(row));
}

class PolynomialTheory final : public StabilityTheory {
 public:
  explicit PolynomialTheory(Polynomial factor) : factor_(std::move(factor)) {}

  [[nodiscard]] double oscillator_excess(double z) const override {
    const auto [x, y] = at_imaginary(factor_, Wide(z));
    return static_cast<double>(Wide(sqrt(Wide(x * x + y * y)) - 1));
  }
  [[nodiscard]] double oscillator_growth(double z) const override { return oscillator_excess(z); }
  [[nodiscard]] std::optional<double> decay_excess(double z) const override {
    return static_cast<double>(Wide(abs(at(factor_, Wide(-z))) - 1));
  }

 private:
  Polynomial factor_;
};

// R = P/Q of a method whose stages are implicit.  Of a symmetric one, Q(z) = P(-z), the modulus on the
// imaginary axis is 1 and the half trace is the real part of R.
class RationalTheory final : public StabilityTheory {
 public:
  RationalTheory(Polynomial numerator, Polynomial denominator, bool symmetric)
      : numerator_(std::move(numerator)), denominator_(std::move(denominator)), symmetric_(symmetric) {}

  [[nodiscard]] double oscillator_excess(double z) const override {
    const auto [a, b] = at_imaginary(numerator_, Wide(z));
    const auto [c, d] = at_imaginary(denominator_, Wide(z));
    const Wide below = c * c + d * d;
    const Wide size =
        symmetric_ ? Wide(abs(Wide(a * c + b * d)) / below) : Wide(sqrt(Wide((a * a + b * b) / below)));
    return static_cast<double>(Wide(size - 1));
  }
  [[nodiscard]] double oscillator_growth(double z) const override {
    return symmetric_ ? 0 : oscillator_excess(z);
  }
  [[nodiscard]] std::optional<double> decay_excess(double z) const override {
    return static_cast<double>(Wide(abs(Wide(at(numerator_, Wide(-z)) / at(denominator_, Wide(-z)))) - 1));
  }

 private:
  Polynomial numerator_, denominator_;
  bool symmetric_;
};

// The numerator of degree k of the Pade approximant of exp(z) with a denominator of degree j; the denominator
// is that of (j, k) at -z.
Polynomial pade_numerator(int k, int j) {
  Polynomial p;
  Wide c(1);
  for (int i = 0; i <= k; ++i) {
    p.push_back(c);
    c *= Wide(k - i) / ((j + k - i) * Wide(i + 1));
  }
  return p;
}

Polynomial turned(Polynomial p) {
  for (std::size_t i = 1; i < p.size(); i += 2) p[i] = -p[i];
  return p;
}

std::unique_ptr<StabilityTheory> pade_theory(int k, int j) {
  return std::make_unique<RationalTheory>(pade_numerator(k, j), turned(pade_numerator(j, k)), k == j);
}

// Four stages with gamma = 1/2, order 3 and R = 0 at infinity: the denominator is (1 - z/2)^4, and the
// numerator, of degree 3, all of exp(z) (1 - z/2)^4 up to there.
std::unique_ptr<StabilityTheory> rodas3_theory() {
  Polynomial denominator{Wide(1)};
  for (int i = 0; i < 4; ++i) denominator = times(denominator, {Wide(1), Wide(-1) / 2});
  Polynomial numerator = times({Wide(1), Wide(1), Wide(1) / 2, Wide(1) / 6}, denominator);
  numerator.resize(4);
  return std::make_unique<RationalTheory>(std::move(numerator), std::move(denominator), false);
}

// Stage i is the polynomial 1 + z sum_j a_ij (stage j), the step 1 + z sum_i b_i (stage i).
Polynomial factor_of_tableau(const std::vector<std::vector<Wide>>& a, const std::vector<Wide>& b) {
  std::vector<Polynomial> stages;
  const auto combine = [&](const std::vector<Wide>& weights) {
    Polynomial p{Wide(1)};
    for (std::size_t j = 0; j < weights.size(); ++j) p = plus(std::move(p), weights[j], stages[j], 1);
    return p;
  };
  for (const auto& row : a) stages.push_back(combine(row));
  return combine(b);
}

template <class... Arrays>
std::vector<std::vector<Wide>> rows_of(const Arrays&... arrays) {
  return {{}, std::vector<Wide>(arrays.begin(), arrays.end())...};
}

template <class Array>
std::vector<Wide> row_of(const Array& array) {
  return {array.begin(), array.end()};
}

// W. B. Gragg's rule of n substeps with his smoothing step, H = z.
Polynomial modified_midpoint(int n) {
  const Wide h = Wide(1) / n;
  Polynomial before{Wide(1)};
  Polynomial now = plus({Wide(1)}, h, {Wide(1)}, 1);
  for (int i = 1; i < n; ++i) {
    Polynomial next = plus(before, 2 * h, now, 1);
    before = std::move(now);
    now = std::move(next);
  }
  const Polynomial sum = plus(plus(before, Wide(1), now), h, now, 1);
  return times(sum, {Wide(1) / 2});
}

Polynomial extrapolated(const std::vector<int>& sequence) {
  std::vector<Polynomial> row;
  for (std::size_t i = 0; i < sequence.size(); ++i) {
    std::vector<Polynomial> next{modified_midpoint(sequence[i])};
    for (std::size_t k = 1; k <= i; ++k) {
      const Wide ratio = Wide(sequence[i]) / sequence[i - k];
      const Wide weight = 1 / (ratio * ratio - 1);
      const Polynomial change = plus(next[k - 1], Wide(-1), row[k - 1]);
      next.push_back(plus(next[k - 1], weight, change));
    }
    row = std::move(next);
  }
  return row.back();
}

Polynomial cash_karp() {
  namespace odeint = boost::numeric::odeint;
  return factor_of_tableau(
      rows_of(odeint::rk54_ck_coefficients_a1<Wide>(), odeint::rk54_ck_coefficients_a2<Wide>(),
              odeint::rk54_ck_coefficients_a3<Wide>(), odeint::rk54_ck_coefficients_a4<Wide>(),
              odeint::rk54_ck_coefficients_a5<Wide>()),
      row_of(odeint::rk54_ck_coefficients_b<Wide>()));
}

Polynomial fehlberg() {
  namespace odeint = boost::numeric::odeint;
  return factor_of_tableau(
      rows_of(odeint::rk78_coefficients_a1<Wide>(), odeint::rk78_coefficients_a2<Wide>(),
              odeint::rk78_coefficients_a3<Wide>(), odeint::rk78_coefficients_a4<Wide>(),
              odeint::rk78_coefficients_a5<Wide>(), odeint::rk78_coefficients_a6<Wide>(),
              odeint::rk78_coefficients_a7<Wide>(), odeint::rk78_coefficients_a8<Wide>(),
              odeint::rk78_coefficients_a9<Wide>(), odeint::rk78_coefficients_a10<Wide>(),
              odeint::rk78_coefficients_a11<Wide>(), odeint::rk78_coefficients_a12<Wide>()),
      row_of(odeint::rk78_coefficients_b<Wide>()));
}

}  // namespace

std::unique_ptr<StabilityTheory> stability_theory(std::string_view integrator) {
  if (const ode::CompositionRow* row = ode::find_composition(integrator))
    return std::make_unique<SplittingTheory>(kicks_and_drifts(*row));
  if (const ode::ExplicitTableau* t = ode::find_explicit_tableau(integrator)) {
    std::vector<std::vector<Wide>> a;
    for (const auto& row : t->a) {
      a.emplace_back();
      for (const ode::Ratio& x : row) a.back().push_back(x.in<Wide>());
    }
    std::vector<Wide> b;
    for (const ode::Ratio& x : t->b) b.push_back(x.in<Wide>());
    return std::make_unique<PolynomialTheory>(factor_of_tableau(a, b));
  }
  if (integrator == "cash_karp54") return std::make_unique<PolynomialTheory>(cash_karp());
  if (integrator == "fehlberg78") return std::make_unique<PolynomialTheory>(fehlberg());
  if (integrator == "extrapolation8") return std::make_unique<PolynomialTheory>(extrapolated({2, 4, 6, 8}));
  if (integrator == "rodas3") return rodas3_theory();
  const ode::IntegratorInfo& info = ode::find_integrator(integrator);
  if (integrator.starts_with("gauss")) return pade_theory(info.stages, info.stages);
  if (integrator.starts_with("radau")) return pade_theory(info.stages - 1, info.stages);
  return nullptr;
}

const KnownLimit* known_limit(std::string_view integrator) {
  static const std::array<KnownLimit, 19> limits{{
      {"leapfrog", 2.0, false, {}},
      {"velocity_verlet", 2.0, false, {}},
      // Tables have 1.567387: other_arrangement().
      {"ruth3", 2.507481, false, {}},
      {"forest_ruth", 1.573402, false, {}},
      {"yoshida4", 1.573402, false, {}},
      {"suzuki4", 2.720975, false, {}},
      {"pefrl", 2.989450, false, {}},
      {"yoshida6", 2.269058, false, {}},
      {"yoshida8", 2.356508, false, {}},
      {"suzuki_umeno8", 3.393234, false, {}},
      {"sofroniou_spaletta10", 5.973668, false, {}},
      {"euler", {}, true, 2.0},
      {"rk2", {}, true, 2.0},
      {"rk3", std::numbers::sqrt3, false, 2.512745},
      {"rk4", 2 * std::numbers::sqrt2, false, 2.785294},
      {"cash_karp54", {}, true, 3.734360},
      {"dormand_prince54", 0.997189, false, 3.306568},
      {"fehlberg78", 2.365158, false, 5.007589},
      {"extrapolation8", 3.852869, false, 5.549574},
  }};
  for (const KnownLimit& k : limits) {
    if (k.integrator == integrator) return &k;
  }
  return nullptr;
}

// R. D. Ruth, IEEE Trans. Nucl. Sci. 30 (1983) 2669: kicks c = 7/24, 3/4, -1/24 and drifts d = 2/3, -2/3, 1.
// Its half trace is 1 - z^2/2 + z^4/24 - 7 z^6/3456.  With the drift of each pair before its kick, and also
// with all six read backwards and the kick first, it is 1 - z^2/2 - 637 z^4/5184 - 7 z^6/3456.
const OtherArrangement* other_arrangement(std::string_view integrator) {
  static const OtherArrangement ruth{"ruth3",
                                     1.567387,
                                     "kick 7/24, drift 2/3, kick 3/4, drift -2/3, kick -1/24, drift 1",
                                     "drift 2/3, kick 7/24, drift -2/3, kick 3/4, drift 1, kick -1/24",
                                     3,
                                     1};
  return integrator == ruth.integrator ? &ruth : nullptr;
}

std::unique_ptr<StabilityTheory> theory_of_other_arrangement(std::string_view integrator) {
  if (other_arrangement(integrator) == nullptr) return nullptr;
  auto sequence = kicks_and_drifts(*ode::find_composition(integrator));
  for (std::size_t i = 0; i + 1 < sequence.size(); i += 2) std::swap(sequence[i], sequence[i + 1]);
  return std::make_unique<SplittingTheory>(sequence);
}

}  // namespace ulpgate
