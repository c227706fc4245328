// Structured hard arguments: next to multiples of pi/2, to zeros, to the ends of the range, powers near 1.
#include <cmath>

#include "harness/core/arguments/argument_lists.hpp"
#include "harness/core/arguments/argument_values.hpp"
#include "reference/oracle/oracle.hpp"

namespace ulpgate {

namespace {

// 1 +- 2^-j and 2 +- 2^-j for every j of the format, and numbers a few steps from them.
void add_near_one(ArgumentValues& out, const FloatFormat& format, long centre) {
  MpfrValue v(format.precision + 2);
  for (long j = 1; j < format.precision + 1; ++j) {
    for (const int sign : {1, -1}) {
      mpfr_set_si_2exp(v, sign, -j, MPFR_RNDN);
      mpfr_add_si(v, v, centre, MPFR_RNDN);
      out.add(v);
    }
  }
}

// Walks x > 0 to where the binade of |f(x)| reaches `exponent`, by bisection; f must be monotonic on (low,
// high).
void add_crossing(ArgumentValues& out, const FunctionInfo& f, const FloatFormat& format, double low,
                  double high, long exponent, bool increasing) {
  const long bits = format.precision + 8;
  std::vector<MpfrValue> x;
  x.emplace_back(bits);
  std::vector<MpfrValue> y;
  y.emplace_back(64);
  MpfrValue a(bits);
  MpfrValue b(bits);
  mpfr_set_d(a, low, MPFR_RNDN);
  mpfr_set_d(b, high, MPFR_RNDN);
  for (long i = 0; i < bits + 40; ++i) {
    mpfr_add(x[0], a, b, MPFR_RNDN);
    mpfr_div_2ui(x[0], x[0], 1, MPFR_RNDN);
    exact_value(f, x, y);
    const bool beyond = mpfr_zero_p(y[0])  ? !increasing
                        : mpfr_inf_p(y[0]) ? increasing
                                           : (binade(y[0]) >= exponent) == increasing;
    mpfr_set(beyond ? b : a, x[0], MPFR_RNDN);
  }
  out.add_around(b, 3);
}

void add_range(ArgumentValues& out, const FunctionInfo& f, const FloatFormat& format) {
  // sinh(x) ~ e^x/2 reaches 2^E at x = E ln 2: all arguments lie below 2^31 in every format.
  const double limit = 1.5 * static_cast<double>(format.exponent_max) + 100;
  using enum FunctionId;
  if (f.id == exp || f.id == exp2 || f.id == expm1 || f.id == sinh || f.id == cosh) {
    add_crossing(out, f, format, 0, limit, format.exponent_max + 1, true);
  }
  if (f.id == exp || f.id == exp2) {
    for (const long exponent : {format.exponent_min, format.exponent_least(), format.exponent_least() - 1}) {
      add_crossing(out, f, format, -2 * limit, 0, exponent, true);
    }
  }
  if (f.id == erfc) {
    const double end = 2 * std::sqrt(limit);
    for (const long exponent : {format.exponent_min, format.exponent_least(), format.exponent_least() - 1}) {
      add_crossing(out, f, format, 0, end, exponent, false);
    }
  }
  add_near_one(out, format, 1);
}

void add_gamma(ArgumentValues& out, const FunctionInfo& f, const FloatFormat& format) {
  add_near_one(out, format, 1);
  add_near_one(out, format, 2);
  if (f.id != FunctionId::tgamma) return;
  for (long n = 0; n <= 30; ++n) {
    for (long j = 1; j < format.precision; j += 3) {
      MpfrValue v(format.precision + 8);
      for (const int sign : {1, -1}) {
        mpfr_set_si_2exp(v, sign, -j, MPFR_RNDN);
        mpfr_sub_si(v, v, n, MPFR_RNDN);
        out.add(v);
      }
    }
  }
  if (format.exponent_max <= 16383) add_crossing(out, f, format, 2, 2000, format.exponent_max + 1, true);
}

// Zeros of J_n below 100 by bisection and secant steps at the format's precision, with neighbours.
ArgumentList bessel_zeros(const FunctionInfo& f, const FloatFormat& format) {
  ArgumentList list;
  const long bits = format.precision + 32;
  for (const long n : {0L, 1L, 2L, 5L, 20L, 60L}) {
    std::vector<MpfrValue> at;
    at.emplace_back(64);
    at.emplace_back(bits);
    mpfr_set_si(at[0], n, MPFR_RNDN);
    std::vector<MpfrValue> y;
    y.emplace_back(bits);
    MpfrValue x0(bits), x1(bits), y0(bits), y1(bits), t(bits);
    const auto evaluate = [&](mpfr_srcptr x, mpfr_ptr value) {
      mpfr_set(at[1], x, MPFR_RNDN);
      exact_value(f, at, y);
      mpfr_set(value, y[0], MPFR_RNDN);
    };
    mpfr_set_d(x0, 0.5, MPFR_RNDN);
    evaluate(x0, y0);
    for (int step = 2; step <= 200; step += 1) {
      mpfr_set_d(x1, step * 0.5, MPFR_RNDN);
      evaluate(x1, y1);
      if (mpfr_sgn(y0.get()) * mpfr_sgn(y1.get()) < 0) {
        MpfrValue u0 = copy(x0), u1 = copy(x1), v0 = copy(y0), v1 = copy(y1);
        for (int i = 0; i < 14 && !mpfr_zero_p(v1); ++i) {
          mpfr_sub(t, v1, v0, MPFR_RNDN);
          if (mpfr_zero_p(t)) break;
          mpfr_sub(u0, u1, u0, MPFR_RNDN);
          mpfr_div(t, u0, t, MPFR_RNDN);
          mpfr_mul(t, t, v1, MPFR_RNDN);
          mpfr_set(u0, u1, MPFR_RNDN);
          mpfr_set(v0, v1, MPFR_RNDN);
          mpfr_sub(u1, u1, t, MPFR_RNDN);
          evaluate(u1, v1);
        }
        ArgumentValues near(format);
        near.add_around(u1, 1);
        for (auto& x : near.values) {
          std::vector<MpfrValue> point;
          point.emplace_back(64);
          mpfr_set_si(point[0], n, MPFR_RNDN);
          point.push_back(std::move(x));
          list.push_back(std::move(point));
        }
      }
      mpfr_swap(x0, x1);
      mpfr_swap(y0, y1);
    }
  }
  return list;
}

// pow: (1 +- j ulp)^y with y up to where the result leaves the range; x^y next to overflow and underflow.
ArgumentList power_pairs(const FloatFormat& format) {
  ArgumentList list;
  const auto add = [&](mpfr_srcptr x, mpfr_srcptr y) {
    std::vector<MpfrValue> point;
    ArgumentValues both(format);
    both.add(x);
    both.add(y);
    for (auto& v : both.values) point.push_back(std::move(v));
    list.push_back(std::move(point));
  };
  MpfrValue x(format.precision + 2);
  MpfrValue y(format.precision + 2);
  const long emax_bits = std::min(format.exponent_max, 16383L);
  for (long j = 1; j < format.precision; j += std::max(1L, format.precision / 50)) {
    for (const int sign : {1, -1}) {
      mpfr_set_si_2exp(x, sign, -j, MPFR_RNDN);
      mpfr_add_ui(x, x, 1, MPFR_RNDN);
      for (long e = -3; (1L << std::max(0L, e)) <= emax_bits; e += 2) {
        mpfr_set_si_2exp(y, 3, j + e - 2, MPFR_RNDN);
        add(x, y);
        mpfr_neg(y, y, MPFR_RNDN);
        add(x, y);
      }
    }
  }
  // y = E / log2 x rounded, for the exponents E of over- and underflow.
  for (const long i : {2L, 3L, 5L, 7L, 10L, 11L, 97L, 1009L}) {
    for (const long target : {format.exponent_max + 1, format.exponent_min, format.exponent_least() - 1}) {
      mpfr_set_si(x, i, MPFR_RNDN);
      mpfr_log2(y, x, MPFR_RNDN);
      mpfr_si_div(y, target, y, MPFR_RNDN);
      MpfrValue rounded(format.precision);
      mpfr_set(rounded, y, MPFR_RNDN);
      for (int s = -2; s <= 2; ++s) {
        MpfrValue v = copy(rounded);
        step_in_format(v, s, format);
        add(x, v);
      }
    }
  }
  return list;
}

}  // namespace

std::vector<MpfrValue> nearest_to_multiples_of_half_pi(const FloatFormat& format, long greatest) {
  const long p = format.precision;
  const long fraction_bits = 3 * p + 128;
  ArgumentValues out(format);
  mpz_t two_over_pi;  // floor(2^(greatest + fraction_bits) * 2/pi)
  mpz_inits(two_over_pi, nullptr);
  {
    MpfrValue v(greatest + fraction_bits + 64);
    mpfr_const_pi(v, MPFR_RNDN);
    mpfr_ui_div(v, 2, v, MPFR_RNDN);
    mpfr_mul_2si(v, v, greatest + fraction_bits, MPFR_RNDN);
    mpfr_get_z(two_over_pi, v, MPFR_RNDD);
  }
  mpz_t alpha, a, b, q, r, p0, p1, t;
  mpz_inits(alpha, a, b, q, r, p0, p1, t, nullptr);
  for (long e = 0; e <= greatest; ++e) {
    // alpha = frac(2^(e-p+1) * 2/pi) as an integer over 2^fraction_bits; x = m 2^(e-p+1), m of p bits.
    const long shift = greatest - (e - p + 1);
    mpz_tdiv_q_2exp(alpha, two_over_pi, static_cast<mp_bitcnt_t>(shift));
    mpz_tdiv_r_2exp(alpha, alpha, static_cast<mp_bitcnt_t>(fraction_bits));
    // Denominators of the convergents of alpha: the best m with |m alpha - k| small.
    mpz_set(b, alpha);
    mpz_set_ui(a, 1);
    mpz_mul_2exp(a, a, static_cast<mp_bitcnt_t>(fraction_bits));
    mpz_set_ui(p0, 0);
    mpz_set_ui(p1, 1);
    while (mpz_sgn(b) != 0) {
      mpz_fdiv_qr(q, r, a, b);
      mpz_set(a, b);
      mpz_set(b, r);
      mpz_mul(t, q, p1);
      mpz_add(t, t, p0);
      if (static_cast<long>(mpz_sizeinbase(t, 2)) > p) break;
      mpz_set(p0, p1);
      mpz_set(p1, t);
    }
    for (mpz_ptr m : {&p1[0], &p0[0]}) {
      if (mpz_sgn(m) == 0) continue;
      // The largest multiple of the denominator by a power of two that stays in p bits lies in this binade.
      const long spare = p - static_cast<long>(mpz_sizeinbase(m, 2));
      MpfrValue v(p);
      mpfr_set_z_2exp(v, m, e - p + 1 + spare, MPFR_RNDN);
      out.add(v);
    }
    // Between the last two denominators lie the intermediate fractions: the one that fills p bits.
    mpz_ui_pow_ui(t, 2, static_cast<unsigned long>(p));
    mpz_sub(t, t, p0);
    mpz_sub_ui(t, t, 1);
    mpz_fdiv_q(q, t, p1);
    mpz_mul(t, q, p1);
    mpz_add(t, t, p0);
    MpfrValue v(p);
    mpfr_set_z_2exp(v, t, e - p + 1, MPFR_RNDN);
    out.add(v);
  }
  mpz_clears(two_over_pi, alpha, a, b, q, r, p0, p1, t, nullptr);
  return std::move(out.values);
}

ArgumentList hard_arguments(const FunctionInfo& f, const FloatFormat& format) {
  const WideExponentRange wide;
  ArgumentValues out(format);
  switch (f.hard) {
    case HardFamily::none:
      return {};
    case HardFamily::bessel:
      return bessel_zeros(f, format);
    case HardFamily::power:
      return power_pairs(format);
    case HardFamily::trig:
      // IEEE formats: every binade.  For the others 1024 binades, see sampled_exponents.
      out.values = nearest_to_multiples_of_half_pi(format, format.subnormals ? format.exponent_max : 1023);
      break;
    case HardFamily::unit:
      add_near_one(out, format, 1);
      break;
    case HardFamily::range:
      add_range(out, f, format);
      break;
    case HardFamily::gamma:
      add_gamma(out, f, format);
      break;
  }
  ArgumentList list;
  for (auto& x : out.values) {
    std::vector<MpfrValue> point;
    point.push_back(std::move(x));
    list.push_back(std::move(point));
  }
  return list;
}

}  // namespace ulpgate
