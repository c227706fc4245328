// Tests of complex functions by formulas of ours: in every quadrant those of MPC.
#include "reference/oracle/oracle_complex.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "reference/oracle/oracle.hpp"

namespace ulpgate {
namespace {

constexpr auto nearest = MPFR_RNDN;
constexpr long bits = 300;

struct Pair {
  FunctionId id;
  int (*mpc)(mpc_ptr, mpc_srcptr, mpc_rnd_t);
};

void expect_of_mpc(const Pair& f, double x, double y) {
  const WideExponentRange range;
  std::vector<MpfrValue> args, got;
  for (const double part : {x, y}) {
    args.emplace_back(53);
    mpfr_set_d(args.back(), part, nearest);
    got.emplace_back(bits);
  }
  exact_value(info_of(f.id), args, got);
  MpcValue z(53), want(bits + 100);
  mpc_set_d_d(z, x, y, MPC_RNDNN);
  f.mpc(want, z, MPC_RNDNN);
  const std::array<mpfr_srcptr, 2> parts = {mpc_realref(static_cast<mpc_ptr>(want)),
                                            mpc_imagref(static_cast<mpc_ptr>(want))};
  for (std::size_t part = 0; part < 2; ++part) {
    if (mpfr_equal_p(got[part], parts[part])) continue;
    // Within an ulp of its precision.
    MpfrValue difference(64);
    mpfr_reldiff(difference, parts[part], got[part], nearest);
    EXPECT_TRUE(mpfr_number_p(difference) && mpfr_cmp_d(difference, 0) != 0 &&
                mpfr_get_exp(difference.get()) <= 1 - bits)
        << info_of(f.id).name << " of " << x << " " << y << ", part " << part;
  }
}

TEST(ComplexFunctions, AreThoseOfMpcInEveryQuadrant) {
  using enum FunctionId;
  for (const Pair& f :
       {Pair{csin, mpc_sin}, Pair{ccos, mpc_cos}, Pair{ctan, mpc_tan}, Pair{csinh, mpc_sinh},
        Pair{ccosh, mpc_cosh}, Pair{ctanh, mpc_tanh}, Pair{casin, mpc_asin}, Pair{cacos, mpc_acos},
        Pair{catan, mpc_atan}, Pair{casinh, mpc_asinh}, Pair{cacosh, mpc_acosh}, Pair{catanh, mpc_atanh},
        Pair{cexp, mpc_exp}, Pair{clog, mpc_log}, Pair{clog10, mpc_log10}, Pair{csqrt, mpc_sqrt}}) {
    for (const double x : {0.25, 0.75, 1.0, 1.5, 6.25, 0x1p-20, 1 + 0x1p-30}) {
      for (const double y : {0.375, 1.0, 2.5, 8.0, 0x1p-30, 1 - 0x1p-40}) {
        for (const double re : {x, -x}) {
          for (const double im : {y, -y}) expect_of_mpc(f, re, im);
        }
      }
    }
  }
}

}  // namespace
}  // namespace ulpgate
