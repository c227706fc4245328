// The MPFR oracle: dispatch of every row of functions.def to MPFR, MPC or a series of ours.
#include "reference/oracle.hpp"

#include <algorithm>

#include "reference/oracle_special.hpp"

namespace ulpgate {

namespace {

constexpr auto nearest = MPFR_RNDN;

// logb as C99 7.12.6.11 defines it: the exponent of the binade, -inf for 0, +inf for infinities.
int exact_logb(mpfr_ptr out, mpfr_srcptr x, mpfr_rnd_t rounding) {
  if (mpfr_nan_p(x)) {
    mpfr_set_nan(out);
  } else if (mpfr_inf_p(x)) {
    mpfr_set_inf(out, 1);
  } else if (mpfr_zero_p(x)) {
    mpfr_set_inf(out, -1);
  } else {
    return mpfr_set_si(out, static_cast<long>(mpfr_get_exp(x)) - 1, rounding);
  }
  return 0;
}

int exact_lgamma(mpfr_ptr out, mpfr_srcptr x, mpfr_rnd_t rounding) {
  int sign = 0;
  return mpfr_lgamma(out, &sign, x, rounding);
}

struct ComplexOut {
  explicit ComplexOut(std::span<MpfrValue> out) : value(mpfr_get_prec(out[0])), parts(out) {}
  ComplexOut(const ComplexOut&) = delete;
  ComplexOut& operator=(const ComplexOut&) = delete;
  ~ComplexOut() {
    mpfr_swap(parts[0], mpc_realref(static_cast<mpc_ptr>(value)));
    mpfr_swap(parts[1], mpc_imagref(static_cast<mpc_ptr>(value)));
  }
  MpcValue value;
  std::span<MpfrValue> parts;
};

// A complex argument that borrows two real ones: MPC reads its operands only, so their limbs need no copy.
struct ComplexArgument {
  ComplexArgument(mpfr_srcptr re, mpfr_srcptr im) {
    *mpc_realref(value) = *re;
    *mpc_imagref(value) = *im;
  }
  mpc_t value;
};

// polar(r, t) = (r cos t, r sin t); 32 guard bits make the product's error 2^-31 ulp at most.
void polar(std::span<const MpfrValue> a, std::span<MpfrValue> out) {
  MpfrValue s(mpfr_get_prec(out[0]) + 32);
  MpfrValue c(mpfr_get_prec(out[0]) + 32);
  mpfr_sin_cos(s, c, a[1], nearest);
  mpfr_mul(out[0], a[0], c, nearest);
  mpfr_mul(out[1], a[0], s, nearest);
}

// For a + ib with `trigonometric` a and `hyperbolic` b, tan(a + ib) has the parts
//   sin a cos a / (cos^2 a + sinh^2 b)   and   sinh b cosh b / (cos^2 a + sinh^2 b)       (DLMF 4.21.40),
// products and sums without cancellation.  mpc_tan needs hours and gigabytes where one part is huge or tiny.
void tangent_parts(mpfr_ptr from_trigonometric, mpfr_ptr from_hyperbolic, mpfr_srcptr a, mpfr_srcptr b) {
  const mpfr_prec_t bits = mpfr_get_prec(from_trigonometric) + 32;
  MpfrValue s(bits), c(bits), denominator(bits);
  mpfr_sin_cos(s, c, a, nearest);
  mpfr_mul(s, s, c, nearest);
  if (mpfr_regular_p(b) && mpfr_get_exp(b) > 40) {
    // sinh^2 b = e^(2|b|)/4 to more than 2^40 bits.
    mpfr_abs(denominator, b, nearest);
    mpfr_mul_si(denominator, denominator, -2, nearest);
    mpfr_exp(denominator, denominator, nearest);
    mpfr_mul_ui(s, s, 4, nearest);
    mpfr_mul(from_trigonometric, s, denominator, nearest);
    mpfr_set_si(from_hyperbolic, mpfr_sgn(b), nearest);
    return;
  }
  MpfrValue sh(bits), ch(bits);
  mpfr_sinh_cosh(sh, ch, b, nearest);
  mpfr_sqr(c, c, nearest);
  mpfr_sqr(denominator, sh, nearest);
  mpfr_add(denominator, denominator, c, nearest);
  mpfr_div(from_trigonometric, s, denominator, nearest);
  mpfr_mul(sh, sh, ch, nearest);
  mpfr_div(from_hyperbolic, sh, denominator, nearest);
}

bool is_finite(mpc_srcptr z) {
  return mpfr_number_p(mpc_realref(z)) != 0 && mpfr_number_p(mpc_imagref(z)) != 0;
}

void tangent(mpc_ptr out, mpc_srcptr z, mpc_rnd_t rounding) {
  if (!is_finite(z)) {
    mpc_tan(out, z, rounding);
  } else {
    tangent_parts(mpc_realref(out), mpc_imagref(out), mpc_realref(z), mpc_imagref(z));
  }
}

// tanh z = -i tan(iz): the parts of z change their roles.
void hyperbolic_tangent(mpc_ptr out, mpc_srcptr z, mpc_rnd_t rounding) {
  if (!is_finite(z)) {
    mpc_tanh(out, z, rounding);
  } else {
    tangent_parts(mpc_imagref(out), mpc_realref(out), mpc_imagref(z), mpc_realref(z));
  }
}

// z^w.  Where w is complex or large MPC searches for exact results without end in sight; there the definition
// exp(w log z) is evaluated, with guard bits for the size of w log z and for cancellation in its parts.
void power(mpc_ptr out, mpc_srcptr z, mpc_srcptr w, mpc_rnd_t rounding) {
  const auto exponent = [](mpfr_srcptr x) {
    return mpfr_regular_p(x) ? static_cast<long>(mpfr_get_exp(x)) : 0L;
  };
  const long size = std::max({exponent(mpc_realref(w)), exponent(mpc_imagref(w)), 0L});
  const bool zero = mpfr_zero_p(mpc_realref(z)) && mpfr_zero_p(mpc_imagref(z));
  // Only z^(n/2) has parts that are exactly zero or representable for the arguments that occur.
  MpfrValue twice(mpfr_get_prec(mpc_realref(w)));
  mpfr_mul_ui(twice, mpc_realref(w), 2, nearest);
  const bool half_integer = mpfr_zero_p(mpc_imagref(w)) && size <= 10 && mpfr_integer_p(twice);
  if (zero || half_integer || !is_finite(z) || !is_finite(w)) {
    mpc_pow(out, z, w, rounding);
    return;
  }
  MpcValue product(mpfr_get_prec(mpc_realref(out)) + size + 160);
  mpc_log(product, z, rounding);
  mpc_mul(product, product, w, rounding);
  mpc_exp(out, product, rounding);
}

}  // namespace

void exact_value(const FunctionInfo& f, std::span<const MpfrValue> a, std::span<MpfrValue> out) {
  const WideExponentRange wide;
  switch (f.id) {
#define REAL1(name, d0, hard, call) \
  case FunctionId::name:            \
    call(out[0], a[0], nearest);    \
    break;
#define REAL2(name, d0, d1, hard, call) \
  case FunctionId::name:                \
    call(out[0], a[0], a[1], nearest);  \
    break;
#define OPER2(name, op, d0, d1, hard, call) REAL2(name, d0, d1, hard, call)
#define REAL3(name, d0, d1, d2, hard, call)  \
  case FunctionId::name:                     \
    call(out[0], a[0], a[1], a[2], nearest); \
    break;
#define COMPLEX1(token, callee, call)    \
  case FunctionId::token: {              \
    const ComplexArgument z(a[0], a[1]); \
    ComplexOut w(out);                   \
    call(w.value, z.value, MPC_RNDNN);   \
    break;                               \
  }
#define COMPLEX2(token, callee, call)           \
  case FunctionId::token: {                     \
    const ComplexArgument z(a[0], a[1]);        \
    const ComplexArgument y(a[2], a[3]);        \
    ComplexOut w(out);                          \
    call(w.value, z.value, y.value, MPC_RNDNN); \
    break;                                      \
  }
#define COMPLEX_REAL(token, callee, call) \
  case FunctionId::token: {               \
    const ComplexArgument z(a[0], a[1]);  \
    call(out[0], z.value, nearest);       \
    break;                                \
  }
#define POLAR(token, callee) \
  case FunctionId::token:    \
    polar(a, out);           \
    break;
#define SPECIAL1(token, d0) \
  case FunctionId::token:   \
    oracle::token(a, out);  \
    break;
#define SPECIAL2(token, d0, d1, hard) SPECIAL1(token, d0)
#define SPECIAL3(token, d0, d1, d2) SPECIAL1(token, d0)
#define SPECIAL4_COMPLEX(token, d0, d1, d2, d3) SPECIAL1(token, d0)
#include "reference/functions.def"
  }
}

}  // namespace ulpgate
