// The MPFR oracle: dispatch of every row of functions.def to MPFR, MPC or a series of ours.
#include "reference/oracle.hpp"

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
#define COMPLEX1(token, callee, call)                             \
  case FunctionId::token: {                                       \
    const ComplexArgument z(a[0], a[1]);                          \
    ComplexOut w(out);                                            \
    call(w.value, z.value, MPC_RNDNN);                            \
    break;                                                        \
  }
#define COMPLEX2(token, callee, call)                  \
  case FunctionId::token: {                            \
    const ComplexArgument z(a[0], a[1]);               \
    const ComplexArgument y(a[2], a[3]);               \
    ComplexOut w(out);                                 \
    call(w.value, z.value, y.value, MPC_RNDNN);        \
    break;                                             \
  }
#define COMPLEX_REAL(token, callee, call)  \
  case FunctionId::token: {                \
    const ComplexArgument z(a[0], a[1]);   \
    call(out[0], z.value, nearest);        \
    break;                                 \
  }
#define POLAR(token, callee) \
  case FunctionId::token:    \
    polar(a, out);           \
    break;
#define SPECIAL1(token, d0)    \
  case FunctionId::token:      \
    oracle::token(a, out);     \
    break;
#define SPECIAL2(token, d0, d1, hard) SPECIAL1(token, d0)
#define SPECIAL3(token, d0, d1, d2) SPECIAL1(token, d0)
#define SPECIAL4_COMPLEX(token, d0, d1, d2, d3) SPECIAL1(token, d0)
#include "reference/functions.def"
  }
}

}  // namespace ulpgate
