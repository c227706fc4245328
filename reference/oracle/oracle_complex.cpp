// Exact values of complex functions by formulas of ours.
#include "reference/oracle/oracle_complex.hpp"

#include <algorithm>

#include "reference/oracle/oracle_angles.hpp"
#include "reference/oracle/oracle_hyperbolic.hpp"

namespace ulpgate::oracle {

namespace {

constexpr auto nearest = MPFR_RNDN;
constexpr mpfr_prec_t guard_bits = 32;

// The functions below write a real and an imaginary part of their own precision from finite x and y, not 0.
using Parts = void (*)(mpfr_ptr re, mpfr_ptr im, mpfr_srcptr x, mpfr_srcptr y);

// sin(x + iy) = sin x cosh y + i cos x sinh y (DLMF 4.21.37).
void sine(mpfr_ptr re, mpfr_ptr im, mpfr_srcptr x, mpfr_srcptr y) {
  const mpfr_prec_t bits = mpfr_get_prec(re);
  MpfrValue sh(bits), ch(bits);
  sinh_and_cosh(sh, ch, y);
  sine_and_cosine(re, im, x);
  mpfr_mul(re, re, ch, nearest);
  mpfr_mul(im, im, sh, nearest);
}

// cos(x + iy) = cos x cosh y - i sin x sinh y (DLMF 4.21.38).
void cosine(mpfr_ptr re, mpfr_ptr im, mpfr_srcptr x, mpfr_srcptr y) {
  const mpfr_prec_t bits = mpfr_get_prec(re);
  MpfrValue sh(bits), ch(bits);
  sinh_and_cosh(sh, ch, y);
  sine_and_cosine(im, re, x);
  mpfr_mul(re, re, ch, nearest);
  mpfr_mul(im, im, sh, nearest);
  mpfr_neg(im, im, nearest);
}

// sinh z = -i sin(iz), cosh z = cos(iz).
void hyperbolic_sine(mpfr_ptr re, mpfr_ptr im, mpfr_srcptr x, mpfr_srcptr y) {
  sine(im, re, y, x);
}
void hyperbolic_cosine(mpfr_ptr re, mpfr_ptr im, mpfr_srcptr x, mpfr_srcptr y) {
  cosine(re, im, y, x);
  mpfr_neg(im, im, nearest);
}

void exponential(mpfr_ptr re, mpfr_ptr im, mpfr_srcptr x, mpfr_srcptr y) {
  MpfrValue modulus(mpfr_get_prec(re));
  mpfr_exp(modulus, x, nearest);
  sine_and_cosine(im, re, y);
  mpfr_mul(re, re, modulus, nearest);
  mpfr_mul(im, im, modulus, nearest);
}

// 1 - x^2 - y^2 to the precision of `out`: exact up to the last subtraction, unless 1 or both squares are
// negligible.
void one_minus_norm(mpfr_ptr out, mpfr_srcptr x, mpfr_srcptr y) {
  const bool x_larger = mpfr_cmpabs(x, y) > 0;
  mpfr_srcptr large = x_larger ? x : y;
  mpfr_srcptr small = x_larger ? y : x;
  const mpfr_prec_t bits = mpfr_get_prec(out);
  const mpfr_prec_t p = std::max(mpfr_get_prec(x), mpfr_get_prec(y));
  const auto reach = static_cast<mpfr_exp_t>(bits + p);
  if (mpfr_get_exp(large) > reach || mpfr_get_exp(large) < -reach) {
    if (mpfr_get_exp(large) < 0) {
      mpfr_set_ui(out, 1, nearest);
    } else {
      mpfr_fmma(out, large, large, small, small, nearest);
      mpfr_neg(out, out, nearest);
    }
    return;
  }
  MpfrValue sum(2 * p + 2 * reach + 4);
  mpfr_sqr(sum, large, nearest);  // exact
  mpfr_ui_sub(sum, 1, sum, nearest);
  MpfrValue square(2 * p);
  mpfr_sqr(square, small, nearest);
  mpfr_sub(out, sum, square, nearest);
}

// With y >= 0 the parts of atan(x + iy) are (Kahan 1987)
//   1/2 atan2(2x, 1 - x^2 - y^2)   and   1/4 log1p(4y / (x^2 + (1 - y)^2)).
void arc_tangent(mpfr_ptr re, mpfr_ptr im, mpfr_srcptr x, mpfr_srcptr y) {
  const mpfr_prec_t bits = mpfr_get_prec(re);
  MpfrValue t(bits), u(bits);
  one_minus_norm(t, x, y);
  mpfr_mul_2ui(u, x, 1, nearest);
  angle_of(re, u, t);
  mpfr_div_2ui(re, re, 1, nearest);
  const bool negative = mpfr_signbit(y) != 0;
  if (negative) {
    mpfr_add_ui(t, y, 1, nearest);
  } else {
    mpfr_ui_sub(t, 1, y, nearest);
  }
  mpfr_fmma(t, t, t, x, x, nearest);
  mpfr_abs(u, y, nearest);
  mpfr_mul_2ui(u, u, 2, nearest);
  mpfr_div(t, u, t, nearest);
  mpfr_log1p(im, t, nearest);
  mpfr_div_2ui(im, im, 2, nearest);
  if (negative) mpfr_neg(im, im, nearest);
}

// atanh z = -i atan(iz).
void hyperbolic_arc_tangent(mpfr_ptr re, mpfr_ptr im, mpfr_srcptr x, mpfr_srcptr y) {
  MpfrValue minus_y(mpfr_get_prec(y));
  mpfr_neg(minus_y, y, nearest);
  arc_tangent(im, re, minus_y, x);
  mpfr_neg(im, im, nearest);
}

// Hull, Fairgrieve and Tang, "Implementing the complex arcsine and arccosine functions using exception
// handling", ACM TOMS 23 (1997): with x, y > 0, r and s the distances from -1 and 1 and a = (r + s)/2,
//   acos = atan2(q, x) - i l,   asin = atan2(x, q) + i l,   q = sqrt(a^2 - x^2),   l = log1p(b + sqrt(b (a +
//   1))),
// b = a - 1, where a - x and a - 1 are written without cancellation.
struct Arc {
  Arc(mpfr_prec_t bits, mpfr_srcptr x, mpfr_srcptr y) : q(bits), l(bits) {
    MpfrValue ax(mpfr_get_prec(x));
    MpfrValue ay(bits), plus(bits), minus(bits), r(bits), s(bits), a(bits), t(bits), y2(bits);
    mpfr_abs(ax, x, nearest);
    mpfr_abs(ay, y, nearest);
    mpfr_sqr(y2, ay, nearest);
    mpfr_add_ui(plus, ax, 1, nearest);
    mpfr_sub_ui(minus, ax, 1, nearest);
    mpfr_hypot(r, plus, ay, nearest);
    mpfr_hypot(s, minus, ay, nearest);
    mpfr_add(a, r, s, nearest);
    mpfr_div_2ui(a, a, 1, nearest);
    mpfr_add(r, r, plus, nearest);  // r + x + 1
    mpfr_div(r, y2, r, nearest);    // y^2 / (r + x + 1) = r - (x + 1)
    // s - |x - 1| and s + |x - 1|, of which the first is y^2 over the second.
    mpfr_abs(t, minus, nearest);
    mpfr_add(s, s, t, nearest);
    mpfr_div(t, y2, s, nearest);
    const bool inside = mpfr_sgn(static_cast<mpfr_srcptr>(minus)) <= 0;
    MpfrValue b(bits);
    // 2 (a - 1) = (r - x - 1) + (s + x - 1), 2 (a - x) = (r - x - 1) + (s - x + 1)
    mpfr_add(b, r, inside ? t : s, nearest);
    mpfr_add(q, r, inside ? s : t, nearest);
    mpfr_add(t, ax, a, nearest);
    mpfr_mul(q, q, t, nearest);
    mpfr_div_2ui(q, q, 1, nearest);
    mpfr_sqrt(q, q, nearest);
    mpfr_div_2ui(b, b, 1, nearest);
    mpfr_add_ui(a, a, 1, nearest);
    mpfr_mul(a, a, b, nearest);
    mpfr_sqrt(a, a, nearest);
    mpfr_add(a, a, b, nearest);
    mpfr_log1p(l, a, nearest);
  }
  MpfrValue q, l;
};

void arc_sine(mpfr_ptr re, mpfr_ptr im, mpfr_srcptr x, mpfr_srcptr y) {
  const Arc arc(mpfr_get_prec(re), x, y);
  angle_of(re, x, arc.q);
  mpfr_setsign(im, arc.l, mpfr_signbit(y), nearest);
}

void arc_cosine(mpfr_ptr re, mpfr_ptr im, mpfr_srcptr x, mpfr_srcptr y) {
  const Arc arc(mpfr_get_prec(re), x, y);
  angle_of(re, arc.q, x);
  mpfr_setsign(im, arc.l, mpfr_signbit(y) == 0 ? 1 : 0, nearest);
}

// asinh z = -i asin(iz), and asin is odd and symmetric to conjugation: the parts of z change their roles.
void hyperbolic_arc_sine(mpfr_ptr re, mpfr_ptr im, mpfr_srcptr x, mpfr_srcptr y) {
  arc_sine(im, re, y, x);
}

// acosh z = +-i acos z, the sign that makes the real part positive.
void hyperbolic_arc_cosine(mpfr_ptr re, mpfr_ptr im, mpfr_srcptr x, mpfr_srcptr y) {
  arc_cosine(im, re, x, y);
  mpfr_abs(re, re, nearest);
  mpfr_setsign(im, im, mpfr_signbit(y), nearest);
}

Parts formula(FunctionId id) {
  switch (id) {
    case FunctionId::csin:
      return sine;
    case FunctionId::ccos:
      return cosine;
    case FunctionId::csinh:
      return hyperbolic_sine;
    case FunctionId::ccosh:
      return hyperbolic_cosine;
    case FunctionId::cexp:
      return exponential;
    case FunctionId::catan:
      return arc_tangent;
    case FunctionId::catanh:
      return hyperbolic_arc_tangent;
    case FunctionId::casin:
      return arc_sine;
    case FunctionId::cacos:
      return arc_cosine;
    case FunctionId::casinh:
      return hyperbolic_arc_sine;
    case FunctionId::cacosh:
      return hyperbolic_arc_cosine;
    default:
      return nullptr;
  }
}

}  // namespace

bool complex_value(const FunctionInfo& f, std::span<const MpfrValue> args, std::span<MpfrValue> out) {
  const Parts parts = formula(f.id);
  if (parts == nullptr || !mpfr_regular_p(args[0].get()) || !mpfr_regular_p(args[1].get())) return false;
  MpfrValue re(mpfr_get_prec(out[0]) + guard_bits);
  MpfrValue im(mpfr_get_prec(out[0]) + guard_bits);
  parts(re, im, args[0], args[1]);
  mpfr_set(out[0], re, nearest);
  mpfr_set(out[1], im, nearest);
  return true;
}

}  // namespace ulpgate::oracle
