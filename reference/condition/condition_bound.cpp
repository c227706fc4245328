// Lower bounds of condition numbers.
#include "reference/condition/condition_bound.hpp"

#include <algorithm>
#include <boost/math/special_functions/digamma.hpp>
#include <cmath>
#include <complex>
#include <numbers>

namespace ulpgate {

namespace {

using Wide = long double;
using Complex = std::complex<Wide>;
constexpr Wide margin = 1 - 0x1p-12L;
constexpr Wide cancelling = 0x1p-30L;
constexpr Wide two_over_sqrt_pi = 2 * std::numbers::inv_sqrtpi_v<Wide>;
constexpr Wide nothing = 0;

using QuietPolicy =
    boost::math::policies::policy<boost::math::policies::pole_error<boost::math::policies::ignore_error>,
                                  boost::math::policies::domain_error<boost::math::policies::ignore_error>,
                                  boost::math::policies::overflow_error<boost::math::policies::ignore_error>>;
Wide digamma(Wide x) {
  return boost::math::digamma(x, QuietPolicy());
}

// |x f'(x) / f(x)| of a real function, summed over the arguments; v = f(a).
Wide real_condition(FunctionId id, const Wide* a, Wide v) {
  const Wide x = a[0];
  switch (id) {
    case FunctionId::add:
    case FunctionId::sub:
      return (std::fabs(a[0]) + std::fabs(a[1])) / v;
    case FunctionId::mul:
    case FunctionId::div:
      return 2;
    case FunctionId::fma:
      return (2 * std::fabs(a[0] * a[1]) + std::fabs(a[2])) / v;
    case FunctionId::sqrt:
      return 0.5L;
    case FunctionId::hypot:
      return 1;
    case FunctionId::sin:
      return x * std::cos(x) / v;
    case FunctionId::cos:
      return x * std::sin(x) / v;
    case FunctionId::tan:
      return x * (1 + v * v) / v;
    case FunctionId::sinh:
      return x * std::cosh(x) / v;
    case FunctionId::cosh:
      return x * std::tanh(x);
    case FunctionId::tanh:
      return 2 * x / std::sinh(2 * x);
    case FunctionId::asin:
    case FunctionId::acos:
      return x / (std::sqrt((1 - x) * (1 + x)) * v);
    case FunctionId::atan:
      return x / ((1 + x * x) * v);
    case FunctionId::asinh:
      return x / (std::sqrt(1 + x * x) * v);
    case FunctionId::acosh:
      return x / (std::sqrt((x - 1) * (x + 1)) * v);
    case FunctionId::atanh:
      return x / ((1 - x) * (1 + x) * v);
    case FunctionId::atan2:
      return 2 * (x / (x * x + a[1] * a[1])) * a[1] / v;
    case FunctionId::log:
      return 1 / v;
    case FunctionId::log10:
      return 1 / (std::numbers::ln10_v<Wide> * v);
    case FunctionId::log2:
      return 1 / (std::numbers::ln2_v<Wide> * v);
    case FunctionId::log1p:
      return x / ((1 + x) * v);
    case FunctionId::exp:
      return x;
    case FunctionId::exp2:
      return x * std::numbers::ln2_v<Wide>;
    case FunctionId::expm1:
      return x / std::expm1(-x);
    case FunctionId::pow:
      return std::fabs(a[1]) * (1 + std::fabs(std::log(x)));
    case FunctionId::erf:
    case FunctionId::erfc:
      return two_over_sqrt_pi * x * std::exp(-x * x) / v;
    case FunctionId::tgamma:
      return std::fabs(x * digamma(x)) - cancelling * (1 + std::fabs(x));
    case FunctionId::lgamma:
      return (std::fabs(x * digamma(x)) - cancelling * (1 + std::fabs(x))) / std::fabs(v);
    default:
      return nothing;  // piecewise, or below 1 everywhere
  }
}

// (|x Re d| + |y Im d|) and (|x Im d| + |y Re d|) for f'(z) = d: the Cauchy-Riemann equations; less what may
// have cancelled in a part of d.
template <class T>
T sensitivity(std::complex<T> z, std::complex<T> d, int part) {
  const T lost = static_cast<T>(cancelling) * std::abs(d);
  const T re = std::max(std::fabs(d.real()) - lost, T(0));
  const T im = std::max(std::fabs(d.imag()) - lost, T(0));
  const T x = std::fabs(z.real());
  const T y = std::fabs(z.imag());
  return part == 0 ? x * re + y * im : x * im + y * re;
}

Wide complex_sensitivity(FunctionId id, const Wide* a, int part) {
  const Complex z(a[0], a[1]);
  const Complex one(1);
  const auto of = [&](Complex derivative) { return sensitivity(z, derivative, part); };
  switch (id) {
    case FunctionId::csin:
      return of(std::cos(z));
    case FunctionId::ccos:
      return of(std::sin(z));
    case FunctionId::csinh:
      return of(std::cosh(z));
    case FunctionId::ccosh:
      return of(std::sinh(z));
    case FunctionId::ctan:
      return of(one / (std::cos(z) * std::cos(z)));
    case FunctionId::ctanh:
      return of(one / (std::cosh(z) * std::cosh(z)));
    case FunctionId::casin:
    case FunctionId::cacos:
      return of(one / (std::sqrt(one - z) * std::sqrt(one + z)));
    case FunctionId::casinh: {
      const Complex iz(-z.imag(), z.real());
      return of(one / (std::sqrt(one - iz) * std::sqrt(one + iz)));
    }
    case FunctionId::cacosh:
      return of(one / (std::sqrt(z - one) * std::sqrt(z + one)));
    case FunctionId::catan: {
      const Complex iz(-z.imag(), z.real());
      return of(one / ((one - iz) * (one + iz)));
    }
    case FunctionId::catanh:
      return of(one / ((one - z) * (one + z)));
    case FunctionId::cexp:
      return of(std::exp(z));
    case FunctionId::clog:
      return of(one / z);
    case FunctionId::clog10:
      return of(one / (z * std::numbers::ln10_v<Wide>));
    case FunctionId::csqrt:
      return of(one / (Wide(2) * std::sqrt(z)));
    case FunctionId::cpow: {
      const Complex w(a[2], a[3]);
      const Complex logarithm = std::log(z);
      const Complex power = std::exp(w * logarithm);
      return of(power * w / z) + sensitivity(w, power * logarithm, part);
    }
    case FunctionId::cpolar: {
      const Wide c = std::fabs(a[0] * std::cos(a[1]));
      const Wide s = std::fabs(a[0] * std::sin(a[1]));
      return part == 0 ? c + std::fabs(a[1]) * s : s + std::fabs(a[1]) * c;
    }
    case FunctionId::cabs:
      return std::hypot(a[0], a[1]);
    case FunctionId::cnorm:
      return 2 * (a[0] * a[0] + a[1] * a[1]);
    case FunctionId::carg:
      return 2 * std::fabs(a[0] / (a[0] * a[0] + a[1] * a[1]) * a[1]);
    default:
      return nothing;
  }
}

// z^w = e^p (cos q + i sin q), of which the part says e^p: in double, where that has the exponents, and knows
// q.
Wide power_condition(const Wide* a, Wide v, int part) {
  const auto fits = [](Wide x) { return x == 0 || (std::fabs(x) > 0x1p-400L && std::fabs(x) < 0x1p400L); };
  if (std::all_of(a, a + 4, fits) && (a[0] != 0 || a[1] != 0)) {
    const std::complex<double> z(static_cast<double>(a[0]), static_cast<double>(a[1]));
    const std::complex<double> w(static_cast<double>(a[2]), static_cast<double>(a[3]));
    const std::complex<double> logarithm(0.5 * std::log(std::norm(z)), std::arg(z));
    const double q = w.imag() * logarithm.real() + w.real() * logarithm.imag();
    const double error =
        0x1p-48 * (std::fabs(w.imag()) * (1 + std::fabs(logarithm.real())) + 4 * std::fabs(w.real()));
    const std::complex<double> direction(std::cos(q), std::sin(q));
    const double size = std::fabs(part == 0 ? direction.real() : direction.imag());
    if (error < 0x1p-32 && size > 0x1p-12)
      return (sensitivity(z, direction * w / z, part) + sensitivity(w, direction * logarithm, part)) /
             (size + 0x1p-30);
  }
  return complex_sensitivity(FunctionId::cpow, a, part) / v;
}

// |x J_n'(x)| = |x J_(n-1) - n J_n| (DLMF 10.6.2); the library's J is good to its amplitude only.
Wide bessel_sensitivity(const Wide* a, Wide v) {
  const Wide x = a[1];
  if (!(std::fabs(x) < 0x1p20L)) return nothing;
  const int n = static_cast<int>(a[0]);
  const Wide neighbour = ::jnl(n == 0 ? 1 : n - 1, x);
  const Wide lost = cancelling * (std::fabs(x) + n);
  const Wide sum = n == 0 ? x * neighbour : x * neighbour - static_cast<Wide>(n) * v;
  return std::fabs(sum) - lost * std::max(std::fabs(neighbour), std::fabs(v)) - 0x1p-40L * std::fabs(x);
}

// |x dL/dx| with dL_n^m/dx = -L_(n-1)^(m+1) (DLMF 18.9.23), by the recurrence in the degree (DLMF 18.9.1).
Wide laguerre_sensitivity(const Wide* a) {
  const int n = static_cast<int>(a[0]);
  const Wide order = a[1] + 1;
  if (n == 0) return nothing;
  Wide before = 0;
  Wide now = 1;
  Wide largest = 1;
  for (int k = 0; k < n - 1; ++k) {
    const Wide degree = k;
    const Wide next = ((2 * degree + 1 + order - a[2]) * now - (degree + order) * before) / (degree + 1);
    before = now;
    now = next;
    largest = std::max(largest, std::fabs(now));
  }
  return std::fabs(a[2]) * (std::fabs(now) - cancelling * largest);
}

// Y = P(theta) e^(i m phi): |theta P'/P| + |m phi tan(m phi)|, the second term with cot for the imaginary
// part.  sin(theta) P' = n cos(theta) P_n - (n + m) P_(n-1) (DLMF 14.10.5), by the recurrence in the degree.
Wide harmonic_condition(const Wide* a, int part) {
  const int n = static_cast<int>(a[0]);
  const int m = std::abs(static_cast<int>(a[1]));
  if (m > n) return nothing;
  const Wide c = std::cos(a[2]);
  Wide before = 0;
  Wide now = 1;
  Wide largest = 1;
  for (int l = m; l < n; ++l) {
    const Wide next =
        ((2 * l + 1) * c * now - static_cast<Wide>(l + m) * before) / static_cast<Wide>(l - m + 1);
    before = now;
    now = next;
    largest = std::max(largest, std::fabs(now));
  }
  const Wide lost = cancelling * static_cast<Wide>(n + m + 1) * largest;
  const Wide slope = std::fabs(static_cast<Wide>(n) * c * now - static_cast<Wide>(n + m) * before) - lost;
  const Wide polar = std::fabs(a[2] / std::sin(a[2])) * slope / (std::fabs(now) + lost);
  const Wide angle = static_cast<Wide>(m) * a[3];
  const Wide turn = std::fabs(part == 0 ? angle * std::tan(angle) : angle / std::tan(angle));
  return std::max(polar, nothing) + (m == 0 ? nothing : turn);
}

bool ordinary(Wide x) {
  return x == 0 || (std::fabs(x) > 0x1p-5000L && std::fabs(x) < 0x1p5000L);
}

}  // namespace

double condition_lower_bound(const FunctionInfo& f, const long double* args, long double value, int part) {
  if (f.function_class == FunctionClass::real && f.hard == HardFamily::trig) {
    // Huge arguments are common here, and nothing overflows but the condition number.
    const Wide condition = std::fabs(real_condition(f.id, args, value)) * margin;
    return std::isfinite(args[0]) && condition > 0 ? static_cast<double>(std::min(condition, 1e300L)) : 0;
  }
  // e^(-x^2) and erfc x become small together, with all of their bits.
  const bool small_together = f.id == FunctionId::erfc && std::fabs(value) > 0x1p-16300L;
  if (value == 0 || !(ordinary(value) || small_together)) return 0;
  for (int i = 0; i < f.arity; ++i) {
    if (!ordinary(args[i])) return 0;
  }
  Wide condition = 0;
  if (f.function_class == FunctionClass::real) {
    condition = real_condition(f.id, args, value);
  } else if (f.id == FunctionId::cpow) {
    condition = power_condition(args, value, part);
  } else if (f.function_class == FunctionClass::complex) {
    condition = complex_sensitivity(f.id, args, part) / value;
  } else if (f.id == FunctionId::cyl_bessel_j) {
    condition = bessel_sensitivity(args, value) / std::fabs(value);
  } else if (f.id == FunctionId::laguerre) {
    condition = laguerre_sensitivity(args) / std::fabs(value);
  } else if (f.id == FunctionId::spherical_harmonic) {
    condition = harmonic_condition(args, part);
  }
  // Where the terms stand for a difference, a negative one says nothing; elsewhere only the sign differs.
  const bool difference =
      f.function_class == FunctionClass::special || f.id == FunctionId::tgamma || f.id == FunctionId::lgamma;
  condition = difference ? std::max(condition, nothing) : std::fabs(condition);
  const auto bound = static_cast<double>(condition * margin);
  return std::isfinite(bound) ? bound : 0;
}

}  // namespace ulpgate
