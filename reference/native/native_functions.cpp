// Native functions as cheap references.
#include "reference/native/native_functions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <type_traits>

#include "reference/native/large_angles.hpp"
#include "reference/native/vector_functions.hpp"

#ifdef ULPGATE_HAVE_FLOAT128
#include <quadmath.h>
#endif

namespace ulpgate {

namespace {

// Bounds in ulp of the type; negative: not trusted.
struct Bounds {
  double binary64;
  double x87_extended;
  double binary128;
};

constexpr Bounds bounds_of(FunctionId id) {
  switch (id) {
    case FunctionId::add:
    case FunctionId::sub:
    case FunctionId::mul:
    case FunctionId::div:
    case FunctionId::fma:
      return {0.5, 0.5, 0.5};
    case FunctionId::sqrt:
      return {0.5, 0.5, 2};
    case FunctionId::fmod:
    case FunctionId::remainder:
    case FunctionId::logb:
      return {0, 0, 0};
    case FunctionId::cbrt:
      return {16, 1.75, 8};
    case FunctionId::hypot:
      return {8, 1.25, 16};
    case FunctionId::sin:
    case FunctionId::cos:
      return {4, 2.5, 16};
    case FunctionId::tan:
      return {4, 3.25, 16};
    case FunctionId::sinh:
    case FunctionId::cosh:
      return {16, 4, 16};
    case FunctionId::tanh:
      return {16, 5, 16};
    case FunctionId::asin:
      return {4, 2, 16};
    case FunctionId::acos:
      return {4, 2.25, 16};
    case FunctionId::atan:
    case FunctionId::atan2:
      return {4, 1.5, 16};
    case FunctionId::asinh:
    case FunctionId::acosh:
      return {16, 5, 24};
    case FunctionId::atanh:
      return {16, 5.5, 24};
    case FunctionId::log:
      return {4, 1.75, 8};
    case FunctionId::log10:
      return {8, 2.75, 16};
    case FunctionId::log2:
      return {4, 1.25, 16};
    case FunctionId::log1p:
      return {8, 3, 16};
    case FunctionId::exp:
    case FunctionId::exp2:
      return {4, 2.25, 8};
    case FunctionId::expm1:
      return {8, 3.5, 16};
    case FunctionId::pow:
      return {4, 3.75, 128};
    case FunctionId::erf:
      return {8, 1.5, 16};
    case FunctionId::erfc:
      return {32, 5.5, 32};
    case FunctionId::tgamma:
      return {64, 14, 64};
    case FunctionId::lgamma:
      return {64, 8, 64};
    default:
      return {-1, -1, -1};
  }
}

// In ulp, by libmvec's documentation.
constexpr double vector_bound = 4;

template <class W>
constexpr double bound_of(FunctionId id) {
  const Bounds bounds = bounds_of(id);
  if constexpr (std::is_same_v<W, double>) {
    return bounds.binary64;
  } else if constexpr (std::is_same_v<W, long double>) {
    return bounds.x87_extended;
  } else {
    return bounds.binary128;
  }
}

constexpr int arity_of(FunctionId id) {
  switch (id) {
#define REAL2(name, d0, d1, hard, oracle) \
  case FunctionId::name:                  \
    return 2;
#define REAL3(name, d0, d1, d2, hard, oracle) \
  case FunctionId::name:                      \
    return 3;
#define OPER2(name, op, d0, d1, hard, oracle) REAL2(name, d0, d1, hard, oracle)
#include "reference/functions/functions.def"
    default:
      return 1;
  }
}

// The library's function of a row, for each type.
template <FunctionId Id>
struct Library;
#ifdef ULPGATE_HAVE_FLOAT128
#define ULPGATE_BINARY128(...)                \
  static Binary128 call(const Binary128* a) { \
    return __VA_ARGS__;                       \
  }
#else
#define ULPGATE_BINARY128(...)
#endif
#define REAL1(name, d0, hard, oracle)                                         \
  template <>                                                                 \
  struct Library<FunctionId::name> {                                          \
    static double call(const double* a) { return std::name(a[0]); }           \
    static long double call(const long double* a) { return std::name(a[0]); } \
    ULPGATE_BINARY128(name##q(a[0]))                                          \
  };
#define REAL2(name, d0, d1, hard, oracle)                                           \
  template <>                                                                       \
  struct Library<FunctionId::name> {                                                \
    static double call(const double* a) { return std::name(a[0], a[1]); }           \
    static long double call(const long double* a) { return std::name(a[0], a[1]); } \
    ULPGATE_BINARY128(name##q(a[0], a[1]))                                          \
  };
#include "reference/functions/functions.def"

template <class W>
constexpr int digits_of = std::is_same_v<W, double>        ? 53
                          : std::is_same_v<W, long double> ? 64
                                                           : 113;

// A sum is exact where either term comes back: then Knuth's two-sum leaves an error of 0.
template <class W>
double bound_of_sum(W sum, W a, W b) {
  return sum - a == b && sum - b == a ? 0 : 0.5;
}

// Of a function whose bound depends on where it is, for the result at x.
template <FunctionId Id, class W>
double bound_at(W x, W result) {
  using enum FunctionId;
  if constexpr (Id == sin || Id == cos || Id == tan) {
    const W size = x < 0 ? -x : x;
    if constexpr (std::is_same_v<W, double>) {
      // The error of the argument reduction is absolute: it shows next to multiples of pi/2 alone.
      const W result_size = result < 0 ? -result : result;
      if (size > 0x1p20) return result_size > 0x1p-20 && result_size < 0x1p20 ? 16 : 0x1p19;
    } else if constexpr (digits_of<W> == 113) {
      if (size > 0x1p62) return -1;
    }
  }
  return bound_of<W>(Id);
}

// The gamma functions of binary64 where a short formula does: a tenth of the library's time, for nine of ten
// binary32 numbers.
// Negative numbers of 24 bits from here on are integers, poles of both.
constexpr double poles_below = -0x1p23;
constexpr double gamma_series_below = 0x1p-27;

std::optional<double> short_tgamma(double x, int argument_bits) {
  // 1/x - gamma + O(x), DLMF 5.7.1; the next term is x^2 of the first.
  if (std::fabs(x) < gamma_series_below) return 1 / x - std::numbers::egamma;
  if (x > 171.7) return std::numeric_limits<double>::infinity();
  if (x <= poles_below && argument_bits <= 24) return std::numeric_limits<double>::quiet_NaN();
  return std::nullopt;
}

std::optional<double> short_lgamma(double x, int argument_bits) {
  if (std::fabs(x) < gamma_series_below) return -std::log(std::fabs(x)) - std::numbers::egamma * x;
  // Stirling's series, DLMF 5.11.1; the first term left out is 1/(1680 x^7).
  if (x >= 64 && x < 0x1p1000) {
    constexpr double half_log_two_pi = 0x1.d67f1c864beb5p-1;
    const double r = 1 / x;
    const double s = r * r;
    return (x - 0.5) * std::log(x) - x +
           (half_log_two_pi + r * (1.0 / 12 - s * (1.0 / 360 - s * (1.0 / 1260))));
  }
  if (x <= poles_below && argument_bits <= 24) return std::numeric_limits<double>::infinity();
  return std::nullopt;
}

// One point; returns the bound of its error.
template <FunctionId Id, class W>
double evaluate(const W* a, W& result, int argument_bits) {
  using enum FunctionId;
  // Products of any two arguments; the wider types have exponents enough for the last bit.
  const bool products_are_exact = 2 * argument_bits <= digits_of<W>;
  if constexpr (Id == add) {
    result = a[0] + a[1];
    return bound_of_sum<W>(result, a[0], a[1]);
  } else if constexpr (Id == sub) {
    result = a[0] - a[1];
    return bound_of_sum<W>(result, a[0], -a[1]);
  } else if constexpr (Id == mul) {
    result = a[0] * a[1];
    return products_are_exact ? 0 : 0.5;
  } else if constexpr (Id == div) {
    result = a[0] / a[1];
    return 0.5;
  } else if constexpr (Id == fma) {
    const W product = a[0] * a[1];
    result = product + a[2];
    return products_are_exact ? bound_of_sum<W>(result, product, a[2]) : -1;
  } else if constexpr (Id == tgamma && std::is_same_v<W, double>) {
    const std::optional<double> value = short_tgamma(a[0], argument_bits);
    result = value ? *value : Library<Id>::call(a);
    return bound_of<W>(Id);
  } else if constexpr (Id == lgamma) {
    // libquadmath's is only absolutely accurate next to the zeros between its poles.
    if constexpr (digits_of<W> == 113) {
      if (!(a[0] > 0)) return -1;
    }
    // The C library's own notes the sign in a variable that all threads share.
    int sign = 0;
    if constexpr (std::is_same_v<W, double>) {
      const std::optional<double> value = short_lgamma(a[0], argument_bits);
      result = value ? *value : ::lgamma_r(a[0], &sign);
    } else if constexpr (std::is_same_v<W, long double>) {
      result = ::lgammal_r(a[0], &sign);
    } else {
      result = Library<Id>::call(a);
    }
    return bound_of<W>(Id);
  } else {
    result = Library<Id>::call(a);
    return bound_at<Id, W>(a[0], result);
  }
}

template <FunctionId Id, class W>
void evaluate_batch(const W* args, W* results, double* bounds, std::size_t count, int argument_bits) {
  constexpr auto arity = static_cast<std::size_t>(arity_of(Id));
  for (std::size_t i = 0; i < count; ++i)
    bounds[i] = evaluate<Id, W>(args + i * arity, results[i], argument_bits);
}

// Several points at once.
template <FunctionId Id>
void evaluate_vectors(const double* args, double* results, double* bounds, std::size_t count, int) {
  static const VectorFunction function = vector_function(Id);
  function(args, results, count);
  for (std::size_t i = 0; i < count; ++i)
    bounds[i] = std::max(2 * vector_bound, bound_at<Id, double>(args[i], results[i]));
}

// f(x) from f's base function, sin or tan, at an angle y that is exact to 2 ulp: x = n pi/2 + r.
template <FunctionId Id>
double base_angle(double r, unsigned quadrant) {
  // cos x = sin (x + pi/2); an odd quadrant makes of the sine a cosine, which is that of the complement.
  const bool odd = ((Id == FunctionId::cos ? quadrant + 1 : quadrant) & 1U) != 0;
  return odd && Id != FunctionId::tan ? std::numbers::pi / 2 - std::fabs(r) : r;
}
template <FunctionId Id>
double from_base(double value, unsigned quadrant) {
  const unsigned n = Id == FunctionId::cos ? quadrant + 1 : quadrant;
  if constexpr (Id == FunctionId::tan) return (n & 1U) != 0 ? -1 / value : value;
  return (n & 2U) != 0 ? -value : value;
}

template <FunctionId Id>
void evaluate_angles(const double* args, double* results, double* bounds, std::size_t count,
                     int argument_bits) {
  static const VectorFunction base = vector_function(Id == FunctionId::tan ? Id : FunctionId::sin);
  constexpr std::size_t most = 256;
  for (std::size_t first = 0; first < count; first += most) {
    const std::size_t n = std::min(most, count - first);
    const double* x = args + first;
    double* out = results + first;
    std::array<bool, most> large{};
    std::size_t large_ones = 0;
    for (std::size_t i = 0; i < n; ++i) {
      large[i] = std::fabs(x[i]) >= least_large_angle &&
                 std::fabs(x[i]) <= double{std::numeric_limits<float>::max()};
      large_ones += large[i] ? 1U : 0U;
    }
    if (large_ones < n || argument_bits > 24) evaluate_vectors<Id>(x, out, bounds + first, n, argument_bits);
    if (large_ones == 0 || argument_bits > 24) continue;
    std::array<double, most> angles;
    std::array<std::uint8_t, most> quadrants;
    reduce_large_angles(x, n, angles.data(), quadrants.data());
    for (std::size_t i = 0; i < n; ++i) angles[i] = large[i] ? base_angle<Id>(angles[i], quadrants[i]) : 1;
    base(angles.data(), angles.data(), n);
    for (std::size_t i = 0; i < n; ++i) {
      if (!large[i]) continue;
      out[i] = from_base<Id>(angles[i], quadrants[i]);
      bounds[first + i] = 4 * vector_bound;
    }
  }
}

template <FunctionId Id, class W>
BoundedFunction<W> best_function() {
  if (bound_of<W>(Id) < 0) return nullptr;
  if constexpr (std::is_same_v<W, double>) {
    if (vector_function(Id) != nullptr) {
      if constexpr (Id == FunctionId::sin || Id == FunctionId::cos || Id == FunctionId::tan) {
        if (vector_function(FunctionId::sin) != nullptr) return &evaluate_angles<Id>;
      }
      return &evaluate_vectors<Id>;
    }
  }
  return &evaluate_batch<Id, W>;
}

}  // namespace

template <class W>
BoundedFunction<W> bounded_function(FunctionId id) {
  switch (id) {
#define ULPGATE_CASE(name) \
  case FunctionId::name:   \
    return best_function<FunctionId::name, W>();
#define REAL1(name, d0, hard, oracle) ULPGATE_CASE(name)
#define REAL2(name, d0, d1, hard, oracle) ULPGATE_CASE(name)
#define REAL3(name, d0, d1, d2, hard, oracle) ULPGATE_CASE(name)
#define OPER2(name, op, d0, d1, hard, oracle) ULPGATE_CASE(name)
#include "reference/functions/functions.def"
    default:
      return nullptr;
  }
}

template BoundedFunction<double> bounded_function<double>(FunctionId);
template BoundedFunction<long double> bounded_function<long double>(FunctionId);
#ifdef ULPGATE_HAVE_FLOAT128
template BoundedFunction<Binary128> bounded_function<Binary128>(FunctionId);
#endif

}  // namespace ulpgate
