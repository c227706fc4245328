// Native functions as cheap references.
#include "reference/native/native_functions.hpp"

#include <cmath>
#include <type_traits>

#include "reference/double_lanes/double_lanes.hpp"

#ifdef ULPGATE_HAVE_FLOAT128
#include <quadmath.h>
#endif

namespace ulpgate {

namespace {

// Bounds in ulp of the type; negative: not trusted.
constexpr double bound_in_binary64(FunctionId id) {
  switch (id) {
    case FunctionId::add:
    case FunctionId::sub:
    case FunctionId::mul:
    case FunctionId::div:
    case FunctionId::fma:
      return 0.5;
    case FunctionId::fmod:
    case FunctionId::remainder:
    case FunctionId::logb:
      return 0;
    case FunctionId::hypot:
      return 8;
    case FunctionId::atan2:
    case FunctionId::pow:
      return 4;
    default:
      return -1;
  }
}

struct Bounds {
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
      return {0.5, 0.5};
    case FunctionId::sqrt:
      return {0.5, 2};
    case FunctionId::fmod:
    case FunctionId::remainder:
    case FunctionId::logb:
      return {0, 0};
    case FunctionId::cbrt:
      return {1.75, 8};
    case FunctionId::hypot:
      return {1.25, 16};
    case FunctionId::sin:
    case FunctionId::cos:
      return {2.5, 16};
    case FunctionId::tan:
      return {3.25, 16};
    case FunctionId::sinh:
    case FunctionId::cosh:
      return {4, 16};
    case FunctionId::tanh:
      return {5, 16};
    case FunctionId::asin:
      return {2, 16};
    case FunctionId::acos:
      return {2.25, 16};
    case FunctionId::atan:
    case FunctionId::atan2:
      return {1.5, 16};
    case FunctionId::asinh:
    case FunctionId::acosh:
      return {5, 24};
    case FunctionId::atanh:
      return {5.5, 24};
    case FunctionId::log:
      return {1.75, 8};
    case FunctionId::log10:
      return {2.75, 16};
    case FunctionId::log2:
      return {1.25, 16};
    case FunctionId::log1p:
      return {3, 16};
    case FunctionId::exp:
    case FunctionId::exp2:
      return {2.25, 8};
    case FunctionId::expm1:
      return {3.5, 16};
    case FunctionId::pow:
      return {3.75, 128};
    case FunctionId::erf:
      return {1.5, 16};
    case FunctionId::erfc:
      return {5.5, 32};
    case FunctionId::tgamma:
      return {14, 64};
    case FunctionId::lgamma:
      return {8, 64};
    default:
      return {-1, -1};
  }
}

template <class W>
constexpr double bound_of(FunctionId id) {
  if constexpr (std::is_same_v<W, double>) {
    return bound_in_binary64(id);
  } else if constexpr (std::is_same_v<W, long double>) {
    return bounds_of(id).x87_extended;
  } else {
    return bounds_of(id).binary128;
  }
}

constexpr int arity_of(FunctionId id) {
#define REAL2(name, d0, d1, hard, oracle) \
  if (id == FunctionId::name) return 2;
#define REAL3(name, d0, d1, d2, hard, oracle) \
  if (id == FunctionId::name) return 3;
#define OPER2(name, op, d0, d1, hard, oracle) REAL2(name, d0, d1, hard, oracle)
#include "reference/functions/functions.def"
  return 1;
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

// Of a function whose bound depends on where it is.
template <FunctionId Id, class W>
double bound_at([[maybe_unused]] W x) {
  using enum FunctionId;
  if constexpr (Id == sin || Id == cos || Id == tan) {
    if constexpr (digits_of<W> == 113) {
      if (x > 0x1p62 || x < -0x1p62) return -1;
    }
  }
  return bound_of<W>(Id);
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
  } else if constexpr (Id == lgamma) {
    // libquadmath's is only absolutely accurate next to the zeros between its poles.
    if constexpr (digits_of<W> == 113) {
      if (!(a[0] > 0)) return -1;
    }
    // The C library's own notes the sign in a variable that all threads share.
    int sign = 0;
    if constexpr (std::is_same_v<W, long double>) {
      result = ::lgammal_r(a[0], &sign);
    } else {
      result = Library<Id>::call(a);
    }
    return bound_of<W>(Id);
  } else {
    result = Library<Id>::call(a);
    return bound_at<Id, W>(a[0]);
  }
}

template <FunctionId Id, class W>
void evaluate_batch(const W* args, W* results, double* bounds, std::size_t count, int argument_bits) {
  constexpr auto arity = static_cast<std::size_t>(arity_of(Id));
  for (std::size_t i = 0; i < count; ++i)
    bounds[i] = evaluate<Id, W>(args + i * arity, results[i], argument_bits);
}

template <FunctionId Id, class W>
BoundedFunction<W> best_function() {
  if constexpr (std::is_same_v<W, double>) {
    if (const auto function = double_lanes_function(Id); function != nullptr) return function;
  }
  if constexpr (bound_of<W>(Id) < 0) {
    return nullptr;
  } else {
    return &evaluate_batch<Id, W>;
  }
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
