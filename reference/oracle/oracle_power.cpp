// Complex powers.
#include "reference/oracle/oracle_power.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "reference/oracle/oracle_angles.hpp"
#include "reference/oracle/rounding_made.hpp"

namespace ulpgate::oracle {

namespace {

constexpr auto nearest = MPFR_RNDN;

long exponent_of(mpfr_srcptr x) {
  return mpfr_regular_p(x) ? static_cast<long>(mpfr_get_exp(x)) : 0L;
}

// arg z in units of pi/4 where z lies on an axis or a diagonal; -pi below the cut, at -x - 0i.
std::optional<int> eighths_of_turn(mpc_srcptr z) {
  const int re = mpfr_sgn(mpc_realref(z));
  const int im = mpfr_sgn(mpc_imagref(z));
  if (re != 0 && im != 0 && mpfr_cmpabs(mpc_realref(z), mpc_imagref(z)) != 0) return std::nullopt;
  if (re > 0) return im;
  if (im == 0) return mpfr_signbit(mpc_imagref(z)) != 0 ? -4 : 4;
  return re == 0 ? 2 * im : 3 * im;
}

bool is_of_modulus_one(mpc_srcptr z) {
  MpfrValue norm(2 * std::max(mpfr_get_prec(mpc_realref(z)), mpfr_get_prec(mpc_imagref(z))));
  return mpc_norm(norm, z, nearest) == 0 && mpfr_cmp_ui(norm, 1) == 0;
}

// A part of a power beyond MPFR's range, which is no zero though its modulus has become one.
void mark_vanished(Exactness& exactness, mpfr_srcptr part, mpfr_srcptr direction) {
  if (mpfr_zero_p(part) != 0 && mpfr_zero_p(direction) == 0) exactness = Exactness::rounded;
}

// |z^w| (cos t + i sin t) where t is the exact multiple Re(w) eighths of pi/4, so that exact zeros are zeros.
ExactParts power_by_turns(mpc_ptr out, mpc_srcptr log_power, mpfr_srcptr re_w, int eighths) {
  MpfrValue half_turns(mpfr_get_prec(re_w) + 4);
  mpfr_mul_si(half_turns, re_w, eighths, nearest);
  mpfr_div_2ui(half_turns, half_turns, 2, nearest);
  MpfrValue modulus(mpc_get_prec(log_power));
  MpfrValue direction(mpc_get_prec(log_power));
  mpfr_exp(modulus, mpc_realref(log_power), nearest);
  ExactParts parts = not_known;
  const auto set_part = [&](mpfr_ptr part, Exactness& exactness) {
    // A modulus beyond the range does not make an exact zero undefined.
    if (mpfr_zero_p(direction)) {
      mpfr_set(part, direction, nearest);
    } else {
      mpfr_mul(part, modulus, direction, nearest);
      mark_vanished(exactness, part, direction);
    }
  };
  mpfr_cospi(direction, half_turns, nearest);
  set_part(mpc_realref(out), parts[0]);
  mpfr_sinpi(direction, half_turns, nearest);
  set_part(mpc_imagref(out), parts[1]);
  return parts;
}

// Logarithms of numbers r = 1 + k / 2^shift next to 1, of this thread, made where they are asked for and
// again where more of their bits are.
class LogarithmsNextTo1 {
 public:
  explicit LogarithmsNextTo1(unsigned shift) : shift_(shift) {}
  mpfr_srcptr at(long k, mpfr_prec_t bits) {
    MpfrValue& value = values_.try_emplace(k, MPFR_PREC_MIN).first->second;
    if (mpfr_get_prec(value) < bits) {
      mpfr_set_prec(value, bits + bits / 4);
      MpfrValue r(64);
      mpfr_set_si_2exp(r, k, -static_cast<mpfr_exp_t>(shift_), nearest);
      mpfr_log1p(value, r, nearest);
    }
    return value;
  }

 private:
  unsigned shift_;
  std::map<long, MpfrValue> values_;
};

}  // namespace

void logarithm_of(mpfr_ptr out, mpfr_srcptr x) {
  const mpfr_prec_t bits = mpfr_get_prec(out) + 32;
  // x = 2^e m, m in [2/3, 4/3); times three numbers r it is 1 + t, |t| < 2^-8, 2^-16 and 2^-24 in turn.
  MpfrValue t(bits);
  mpfr_set(t, x, nearest);
  mpfr_exp_t e = mpfr_get_exp(t.get());
  mpfr_set_exp(t, 0);
  if (mpfr_cmp_d(t, 2.0 / 3) < 0) {
    mpfr_set_exp(t, 1);
    --e;
  }
  MpfrValue sum(bits), step(bits);
  mpfr_const_log2(sum, nearest);
  mpfr_mul_si(sum, sum, e, nearest);
  static thread_local std::array<LogarithmsNextTo1, 3> tables{LogarithmsNextTo1(8), LogarithmsNextTo1(16),
                                                              LogarithmsNextTo1(24)};
  for (unsigned i = 0; i < tables.size(); ++i) {
    const unsigned shift = 8 * (i + 1);
    // The first of a number, the others of its distance from 1.
    const double d = mpfr_get_d(t, nearest);
    const long k = std::lround(std::ldexp(i == 0 ? 1 / d - 1 : -d, static_cast<int>(shift)));
    if (k != 0) {
      mpfr_sub(sum, sum, tables[i].at(k, bits), nearest);
      // (1 + t)(1 + k 2^-shift) - 1, of the first one 1 + t itself.
      mpfr_mul_si(step, t, k, nearest);
      mpfr_div_2ui(step, step, shift, nearest);
      mpfr_add(t, t, step, nearest);
      if (i > 0) {
        mpfr_set_si_2exp(step, k, -static_cast<mpfr_exp_t>(shift), nearest);
        mpfr_add(t, t, step, nearest);
      }
    }
    if (i == 0) mpfr_sub_ui(t, t, 1, nearest);
  }
  // log(1 + t) = 2 artanh s, s = t / (2 + t) (DLMF 4.6.5), a term 2^-48 of the one before it.
  if (mpfr_regular_p(t.get()) != 0) {
    MpfrValue square(bits), power(bits);
    mpfr_add_ui(square, t, 2, nearest);
    mpfr_div(power, t, square, nearest);
    mpfr_mul_2ui(power, power, 1, nearest);
    mpfr_sqr(square, power, nearest);
    mpfr_div_2ui(square, square, 2, nearest);
    mpfr_set(t, power, nearest);
    const mpfr_exp_t least = mpfr_get_exp(t.get()) - static_cast<mpfr_exp_t>(bits) - 2;
    for (unsigned long odd = 3; mpfr_regular_p(power.get()) != 0; odd += 2) {
      mpfr_mul(power, power, square, nearest);
      if (mpfr_get_exp(power.get()) < least) break;
      mpfr_div_ui(step, power, odd, nearest);
      mpfr_add(t, t, step, nearest);
    }
  }
  mpfr_add(out, sum, t, nearest);
}

namespace {

// ln|z|, with all of its bits next to |z| = 1 as well: there of |z|^2 - 1 = (l - 1)(l + 1) + s^2, l the
// larger part.
void log_modulus(mpfr_ptr out, mpc_srcptr z) {
  mpfr_srcptr l = mpc_realref(z);
  mpfr_srcptr s = mpc_imagref(z);
  if (mpfr_cmpabs(l, s) < 0) std::swap(l, s);
  if (exponent_of(l) == 0 || exponent_of(l) == 1) {
    MpfrValue size(mpfr_get_prec(l)), below(mpfr_get_prec(l) + 2), above(mpfr_get_prec(l) + 2);
    mpfr_abs(size, l, nearest);
    mpfr_sub_ui(below, size, 1, nearest);
    mpfr_add_ui(above, size, 1, nearest);
    mpfr_fmma(out, below, above, s, s, nearest);
    if (mpfr_zero_p(out) || exponent_of(out) <= -1) {
      mpfr_log1p(out, out, nearest);
      mpfr_div_2ui(out, out, 1, nearest);
      return;
    }
  }
  MpfrValue norm(mpfr_get_prec(out) + 16);
  mpfr_fmma(norm, l, l, s, s, nearest);
  logarithm_of(out, norm);
  mpfr_div_2ui(out, out, 1, nearest);
}

// w log z with an absolute error of 2^(-bits - spared_bits()), but for the exponent of log z: of its
// imaginary part always, of its real part below 2^64; beyond that a power is beyond MPFR's range, whatever
// the rest of it.
class PowerLogarithm {
 public:
  // Exponent from which on the real part is the logarithm of what is beyond MPFR's range.
  static constexpr long ordinary = 64;
  // `least` more bits of both ln|z| and arg z in any case.
  PowerLogarithm(mpc_srcptr z, mpc_srcptr w, long bits, long least)
      : re_(exponent_of(mpc_realref(w))),
        im_(exponent_of(mpc_imagref(w))),
        of_log_(std::max({im_, std::min(re_, ordinary), least, 0L})),
        of_arg_(std::max({re_, std::min(im_, ordinary), least, 0L})),
        bits_(bits),
        value_(bits + std::max({re_, im_, 0L}) + ordinary) {
    MpfrValue log(bits + of_log_);
    MpfrValue arg(bits + of_arg_);
    log_modulus(log, z);
    angle_of(arg, mpc_imagref(z), mpc_realref(z));
    mpfr_fmms(mpc_realref(value()), mpc_realref(w), log, mpc_imagref(w), arg, nearest);
    mpfr_fmma(mpc_imagref(value()), mpc_realref(w), arg, mpc_imagref(w), log, nearest);
    // A term that is 0 is off by nothing.
    if (mpfr_regular_p(mpc_realref(w)) && mpfr_regular_p(log.get()))
      real_error_ = re_ + exponent_of(log) - of_log_ + 3 - bits;
    if (mpfr_regular_p(mpc_imagref(w)) && mpfr_regular_p(arg.get()))
      real_error_ = std::max(real_error_, im_ + exponent_of(arg) - of_arg_ + 3 - bits);
  }
  [[nodiscard]] mpc_ptr value() { return value_; }
  // Of a small w the error is as small.
  [[nodiscard]] long spared_bits() const { return std::max(0L, -std::max(re_, im_)); }
  // Of the parts of the power, whose real part was rounded to `re`: whether 1 is the exact value, and on
  // which side of it that lies.  It is 1 + d, d = p - q^2/2, but for the squares and the product of these two
  // terms.
  [[nodiscard]] ExactParts exactness(mpfr_srcptr re) {
    if (mpfr_cmp_ui(re, 1) != 0) return not_known;
    constexpr long bits = 160;
    mpfr_srcptr p = mpc_realref(value());
    MpfrValue d(bits);
    MpfrValue half_square(bits);
    mpfr_sqr(half_square, mpc_imagref(value()), nearest);
    mpfr_div_2ui(half_square, half_square, 1, nearest);
    mpfr_sub(d, p, half_square, nearest);
    if (!mpfr_regular_p(d.get())) return not_known;
    long terms = exponent_of(d);
    if (mpfr_regular_p(p)) terms = std::max(terms, exponent_of(p));
    if (mpfr_regular_p(half_square.get())) terms = std::max(terms, exponent_of(half_square));
    // Of itself q is known as well as p is.
    if (exponent_of(d) <= std::max({terms - bits + 8, 2 * terms + 4, real_error_ + 3})) return not_known;
    return {mpfr_sgn(d.get()) < 0 ? Exactness::rounded_up : Exactness::rounded_down, Exactness::unknown};
  }
  // Whether the power is, whose exponents end at 2^62.
  [[nodiscard]] bool is_beyond_range() { return exponent_of(mpc_realref(value())) > ordinary; }
  // Whether the real part is not known well enough, which then has cancelled.
  [[nodiscard]] bool is_vague() {
    const long lacking = std::max(re_ - of_log_, im_ - of_arg_);
    // |log z| is below 2^64.
    return lacking > 0 && exponent_of(mpc_realref(value())) <= std::max(lacking - bits_ + 80, ordinary);
  }

 private:
  long re_;
  long im_;
  long of_log_;
  long of_arg_;
  long bits_;
  long real_error_ =
      std::numeric_limits<long>::min() / 2;  // exponent of what the real part is off by at most
  MpcValue value_;
};

// The parts of a power beyond MPFR's range, e^p (cos q + i sin q), where q is known to less than 2^-known.
std::optional<ExactParts> signs_of_power(mpc_ptr out, mpc_srcptr log_power, long known) {
  constexpr long bits = 96;
  unsigned quadrant = 0;
  MpfrValue r(64);
  if (!reduce_to_quadrant(quadrant, r, mpc_imagref(log_power), bits) || mpfr_regular_p(r.get()) == 0 ||
      -exponent_of(r) > std::min(known, bits - 16))
    return std::nullopt;
  const int next_to_0 = mpfr_sgn(r.get());
  const bool odd = quadrant % 2 == 1;
  const int turned = quadrant < 2 ? 1 : -1;
  const int cosine = (odd ? -next_to_0 : 1) * turned;
  const int sine = (odd ? 1 : next_to_0) * turned;
  const auto set = [&](mpfr_ptr part, int sign) {
    if (mpfr_sgn(mpc_realref(log_power)) > 0) {
      mpfr_set_inf(part, sign);
    } else {
      mpfr_set_zero(part, sign);
    }
  };
  set(mpc_realref(out), cosine);
  set(mpc_imagref(out), sine);
  return mpfr_sgn(mpc_realref(log_power)) > 0 ? not_known
                                              : ExactParts{Exactness::rounded, Exactness::rounded};
}

}  // namespace

ExactParts power(mpc_ptr out, mpc_srcptr z, mpc_srcptr w, mpc_rnd_t rounding) {
  const long size = std::max({exponent_of(mpc_realref(w)), exponent_of(mpc_imagref(w)), 0L});
  const bool zero = mpfr_zero_p(mpc_realref(z)) && mpfr_zero_p(mpc_imagref(z));
  MpfrValue twice(mpfr_get_prec(mpc_realref(w)));
  mpfr_mul_ui(twice, mpc_realref(w), 2, nearest);
  const bool half_integer = mpfr_zero_p(mpc_imagref(w)) && size <= 10 && mpfr_integer_p(twice);
  if (zero || half_integer || !is_finite(z) || !is_finite(w))
    return complex_parts(mpc_pow(out, z, w, rounding));

  // The angle Re(w) arg(z) + Im(w) ln|z|: without its second term it may be an exact multiple of pi/4.
  const bool one_term = mpfr_zero_p(mpc_imagref(w)) || is_of_modulus_one(z);
  const auto eighths = one_term ? eighths_of_turn(z) : std::nullopt;
  const mpfr_prec_t precision = mpfr_get_prec(mpc_realref(out));
  // Where the angle comes close to a multiple of pi/2 its sine or cosine loses as many bits; they are added
  // until they suffice, for a part beyond MPFR's range as well, which is nothing but its sign.  Neither is
  // exactly zero here, but a limit must stand.
  constexpr long most_guard_bits = 1L << 16U;
  // Each of ln|z| and arg z has the bits that the angle asks of it, and of an ordinary modulus.
  bool all_bits = false;
  // Of a huge exponent nothing but its signs is asked of the power, unless |z| is next to 1.
  mpfr_prec_t bits = size > PowerLogarithm::ordinary ? 0 : precision;
  for (long guard = 112;;) {
    PowerLogarithm log_power(z, w, bits + guard, all_bits ? size : 0);
    if (log_power.is_vague()) {
      all_bits = true;
      continue;
    }
    if (bits < precision && !log_power.is_beyond_range()) {
      bits = precision;
      continue;
    }
    if (eighths) {
      ExactParts parts = power_by_turns(out, log_power.value(), mpc_realref(w), *eighths);
      if (parts[0] == Exactness::unknown) parts[0] = log_power.exactness(mpc_realref(out))[0];
      return parts;
    }
    if (log_power.is_beyond_range()) {
      if (const auto parts = signs_of_power(out, log_power.value(), guard + log_power.spared_bits() - 80))
        return *parts;
    }
    MpfrValue sine(bits + 32);
    MpfrValue cosine(bits + 32);
    sine_and_cosine(sine, cosine, mpc_imagref(log_power.value()));
    const long lost = -std::min(exponent_of(sine), exponent_of(cosine));
    // |log z| needs up to 12 bits before its point for binary64's exponents, 64 for any.
    const long lacking = lost - log_power.spared_bits();
    if (lacking + 80 > guard && guard < most_guard_bits) {
      guard = std::min(lacking + 160, most_guard_bits);
      continue;
    }
    MpfrValue modulus(bits + 32);
    mpfr_exp(modulus, mpc_realref(log_power.value()), nearest);
    mpfr_mul(mpc_realref(out), modulus, cosine, nearest);
    mpfr_mul(mpc_imagref(out), modulus, sine, nearest);
    ExactParts parts = log_power.exactness(mpc_realref(out));
    mark_vanished(parts[0], mpc_realref(out), cosine);
    mark_vanished(parts[1], mpc_imagref(out), sine);
    return parts;
  }
}

}  // namespace ulpgate::oracle
