// Wide numbers: MPFR behind plain handles.
#include <memory>
#include <vector>

#include "harness/interface/wide_value.hpp"

namespace {

constexpr long double_times_four = 212;

// Numbers that are not in use: a kernel makes and drops many a call.
class Store {
 public:
  Store() = default;
  Store(const Store&) = delete;
  Store& operator=(const Store&) = delete;
  ~Store() {
    for (auto* x : free_) destroy(x);
    mpfr_free_cache();
  }

  ulpgate_wide* take() {
    if (free_.empty()) {
      auto made = std::make_unique<ulpgate_wide>();
      mpfr_init2(made->value, precision_);
      mpfr_set_zero(made->value, 1);
      return made.release();
    }
    ulpgate_wide* x = free_.back();
    free_.pop_back();
    if (mpfr_get_prec(x->value) != precision_) mpfr_set_prec(x->value, precision_);
    mpfr_set_zero(x->value, 1);
    return x;
  }
  void give(ulpgate_wide* x) {
    constexpr std::size_t most = 256;
    if (free_.size() < most) {
      free_.push_back(x);
    } else {
      destroy(x);
    }
  }
  void set_precision(long bits) { precision_ = bits; }
  [[nodiscard]] long precision() const { return precision_; }

 private:
  static void destroy(ulpgate_wide* x) {
    mpfr_clear(x->value);
    delete x;
  }
  std::vector<ulpgate_wide*> free_;
  long precision_ = double_times_four;
};

Store& store() {
  thread_local Store mine;
  return mine;
}

// C's: to nearest, halves away from zero.
int round_away(mpfr_ptr to, mpfr_srcptr x) {
  return mpfr_round(to, x);
}

int log_gamma(mpfr_ptr to, mpfr_srcptr x) {
  int sign = 0;
  return mpfr_lgamma(to, &sign, x, MPFR_RNDN);
}

}  // namespace

extern "C" {

ulpgate_wide* ulpgate_wide_new(void) {
  return store().take();
}

void ulpgate_wide_free(ulpgate_wide* x) {
  if (x != nullptr) store().give(x);
}

void ulpgate_wide_set_precision(long bits) {
  store().set_precision(bits < MPFR_PREC_MIN ? MPFR_PREC_MIN : bits);
}

long ulpgate_wide_precision(void) {
  return store().precision();
}

void ulpgate_wide_assign(ulpgate_wide* to, const ulpgate_wide* from) {
  mpfr_set(to->value, from->value, MPFR_RNDN);
}

void ulpgate_wide_assign_double(ulpgate_wide* to, double from) {
  mpfr_set_d(to->value, from, MPFR_RNDN);
}

void ulpgate_wide_assign_long_double(ulpgate_wide* to, long double from) {
  mpfr_set_ld(to->value, from, MPFR_RNDN);
}

void ulpgate_wide_apply(enum ulpgate_operation operation, ulpgate_wide* to, const ulpgate_wide* a,
                        const ulpgate_wide* b) {
  mpfr_ptr r = to->value;
  mpfr_srcptr x = a->value;
  mpfr_srcptr y = b != nullptr ? b->value : a->value;
  constexpr mpfr_rnd_t nearest = MPFR_RNDN;
  switch (operation) {
    case ULPGATE_ADD:
      mpfr_add(r, x, y, nearest);
      break;
    case ULPGATE_SUB:
      mpfr_sub(r, x, y, nearest);
      break;
    case ULPGATE_MUL:
      mpfr_mul(r, x, y, nearest);
      break;
    case ULPGATE_DIV:
      mpfr_div(r, x, y, nearest);
      break;
    case ULPGATE_POW:
      mpfr_pow(r, x, y, nearest);
      break;
    case ULPGATE_HYPOT:
      mpfr_hypot(r, x, y, nearest);
      break;
    case ULPGATE_ATAN2:
      mpfr_atan2(r, x, y, nearest);
      break;
    case ULPGATE_FMOD:
      mpfr_fmod(r, x, y, nearest);
      break;
    case ULPGATE_REMAINDER:
      mpfr_remainder(r, x, y, nearest);
      break;
    case ULPGATE_FMIN:
      mpfr_min(r, x, y, nearest);
      break;
    case ULPGATE_FMAX:
      mpfr_max(r, x, y, nearest);
      break;
    case ULPGATE_COPYSIGN:
      mpfr_copysign(r, x, y, nearest);
      break;
    case ULPGATE_NEG:
      mpfr_neg(r, x, nearest);
      break;
    case ULPGATE_FABS:
      mpfr_abs(r, x, nearest);
      break;
    case ULPGATE_SQRT:
      mpfr_sqrt(r, x, nearest);
      break;
    case ULPGATE_CBRT:
      mpfr_cbrt(r, x, nearest);
      break;
    case ULPGATE_EXP:
      mpfr_exp(r, x, nearest);
      break;
    case ULPGATE_EXP2:
      mpfr_exp2(r, x, nearest);
      break;
    case ULPGATE_EXPM1:
      mpfr_expm1(r, x, nearest);
      break;
    case ULPGATE_LOG:
      mpfr_log(r, x, nearest);
      break;
    case ULPGATE_LOG2:
      mpfr_log2(r, x, nearest);
      break;
    case ULPGATE_LOG10:
      mpfr_log10(r, x, nearest);
      break;
    case ULPGATE_LOG1P:
      mpfr_log1p(r, x, nearest);
      break;
    case ULPGATE_SIN:
      mpfr_sin(r, x, nearest);
      break;
    case ULPGATE_COS:
      mpfr_cos(r, x, nearest);
      break;
    case ULPGATE_TAN:
      mpfr_tan(r, x, nearest);
      break;
    case ULPGATE_ASIN:
      mpfr_asin(r, x, nearest);
      break;
    case ULPGATE_ACOS:
      mpfr_acos(r, x, nearest);
      break;
    case ULPGATE_ATAN:
      mpfr_atan(r, x, nearest);
      break;
    case ULPGATE_SINH:
      mpfr_sinh(r, x, nearest);
      break;
    case ULPGATE_COSH:
      mpfr_cosh(r, x, nearest);
      break;
    case ULPGATE_TANH:
      mpfr_tanh(r, x, nearest);
      break;
    case ULPGATE_ASINH:
      mpfr_asinh(r, x, nearest);
      break;
    case ULPGATE_ACOSH:
      mpfr_acosh(r, x, nearest);
      break;
    case ULPGATE_ATANH:
      mpfr_atanh(r, x, nearest);
      break;
    case ULPGATE_ERF:
      mpfr_erf(r, x, nearest);
      break;
    case ULPGATE_ERFC:
      mpfr_erfc(r, x, nearest);
      break;
    case ULPGATE_TGAMMA:
      mpfr_gamma(r, x, nearest);
      break;
    case ULPGATE_LGAMMA:
      log_gamma(r, x);
      break;
    case ULPGATE_FLOOR:
      mpfr_floor(r, x);
      break;
    case ULPGATE_CEIL:
      mpfr_ceil(r, x);
      break;
    case ULPGATE_TRUNC:
      mpfr_trunc(r, x);
      break;
    case ULPGATE_ROUND:
      round_away(r, x);
      break;
  }
}

void ulpgate_wide_fma(ulpgate_wide* to, const ulpgate_wide* a, const ulpgate_wide* b, const ulpgate_wide* c) {
  mpfr_fma(to->value, a->value, b->value, c->value, MPFR_RNDN);
}

void ulpgate_wide_ldexp(ulpgate_wide* to, const ulpgate_wide* x, long n) {
  mpfr_mul_2si(to->value, x->value, n, MPFR_RNDN);
}

int ulpgate_wide_compare(const ulpgate_wide* a, const ulpgate_wide* b) {
  if (mpfr_unordered_p(a->value, b->value) != 0) return 2;
  const int order = mpfr_cmp(a->value, b->value);
  return order < 0 ? -1 : order > 0 ? 1 : 0;
}

int ulpgate_wide_sign_bit(const ulpgate_wide* x) {
  return mpfr_signbit(x->value) != 0 ? 1 : 0;
}

int ulpgate_wide_kind(const ulpgate_wide* x) {
  return mpfr_nan_p(x->value) != 0 ? 2 : mpfr_inf_p(x->value) != 0 ? 1 : 0;
}

double ulpgate_wide_to_double(const ulpgate_wide* x) {
  return mpfr_get_d(x->value, MPFR_RNDN);
}

}  // extern "C"
