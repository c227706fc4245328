// REQUIRE_THAT(got, ulpgate::WithinUlp(exact, limit)) for Catch2 2 and 3; `exact` is a number of the type of
// `got` or ulpgate::call().
#pragma once

#if __has_include(<catch2/matchers/catch_matchers.hpp>)
#include <catch2/matchers/catch_matchers.hpp>
namespace ulpgate::detail {
template <class Real>
using MatcherBase = Catch::Matchers::MatcherBase<Real>;
}
#else
#include <catch2/catch.hpp>
namespace ulpgate::detail {
template <class Real>
using MatcherBase = Catch::MatcherBase<Real>;
}
#endif

#include "ulpgate/matchers.hpp"

namespace ulpgate {

template <class Real, class Exact>
class UlpMatcher : public detail::MatcherBase<Real> {
 public:
  UlpMatcher(const Exact& exact, double limit) : exact_(exact), limit_(limit) {}
  bool match(const Real& got) const override {
    last_ = ulp_of(got, exact_, limit_);
    return last_.good;
  }
  // Asked for after a match() of the same object.
  std::string describe() const override { return last_.text; }

 private:
  Exact exact_;
  double limit_;
  mutable UlpResult last_;
};

template <class Real, std::enable_if_t<std::is_floating_point_v<Real>, int> = 0>
UlpMatcher<Real, Real> WithinUlp(Real exact, double limit) {
  return {exact, limit};
}
template <class Real, std::size_t N>
UlpMatcher<Real, Call<Real, N>> WithinUlp(const Call<Real, N>& exact, double limit) {
  return {exact, limit};
}

}  // namespace ulpgate
