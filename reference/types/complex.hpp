// ComplexHP<N, Base>: the complex type that belongs to each Real.
#pragma once

#include <boost/multiprecision/complex_adaptor.hpp>
#include <boost/multiprecision/cpp_complex.hpp>
#ifdef ULPGATE_HAVE_FLOAT128
#include <boost/multiprecision/complex128.hpp>
#endif
#include <complex>

#include "reference/types/real_types.hpp"

namespace ulpgate {

namespace detail {
template <class Real>
struct ComplexOf {
  using type = typename mp::complex_result_from_scalar<Real>::type;
};
template <NativeReal Real>
struct ComplexOf<Real> {
  using type = std::complex<Real>;
};
}  // namespace detail

// std::complex for native types; Boost.Multiprecision's own complex number for the others, because the
// standard leaves std::complex of anything else unspecified.
template <unsigned N, RealType Base>
using ComplexHP = typename detail::ComplexOf<RealHP<N, Base>>::type;

}  // namespace ulpgate
