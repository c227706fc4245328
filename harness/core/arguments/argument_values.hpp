// ArgumentValues: collects values of one format while lists of arguments are built.
#pragma once

#include <algorithm>
#include <vector>

#include "reference/types/mpfr_value.hpp"
#include "reference/types/rounding.hpp"

namespace ulpgate {

// Collects values of one format.
class ArgumentValues {
 public:
  explicit ArgumentValues(const FloatFormat& format) : format_(format) {}

  void add(mpfr_srcptr x) {
    MpfrValue v(format_.precision);
    MpfrValue exact(mpfr_get_prec(x));
    mpfr_set(exact, x, MPFR_RNDN);
    round_to_format(exact, format_);
    mpfr_set(v, exact, MPFR_RNDN);
    values.push_back(std::move(v));
  }
  void add_scaled(long m, long exponent) {
    MpfrValue v(64);
    mpfr_set_si_2exp(v, m, exponent, MPFR_RNDN);
    add(v);
  }
  // x and its neighbours up to `reach` steps away, with both signs.
  void add_around(mpfr_srcptr x, int reach) {
    for (int s = -reach; s <= reach; ++s) {
      MpfrValue v(std::max<mpfr_prec_t>(mpfr_get_prec(x), format_.precision));
      mpfr_set(v, x, MPFR_RNDN);
      round_to_format(v, format_);
      step_in_format(v, s, format_);
      add(v);
      mpfr_neg(v, v, MPFR_RNDN);
      add(v);
    }
  }
  void add_around_scaled(long m, long exponent, int reach) {
    MpfrValue v(64);
    mpfr_set_si_2exp(v, m, exponent, MPFR_RNDN);
    add_around(v, reach);
  }

  std::vector<MpfrValue> values;

 private:
  FloatFormat format_;
};

[[nodiscard]] inline MpfrValue copy(const MpfrValue& x) {
  MpfrValue v(mpfr_get_prec(x.get()));
  mpfr_set(v, x, MPFR_RNDN);
  return v;
}

}  // namespace ulpgate
