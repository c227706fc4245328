// Eigen types of RealHP<N>, with number traits that are right for every Real.
//
// Boost 1.81's <boost/multiprecision/eigen.hpp> returns the smallest positive number as
// NumTraits<T>::lowest(), which makes an AlignedBox of a multiprecision type wrong; so that header must not
// be included beside this one.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "reference/types/complex.hpp"

namespace Eigen {

template <class Real>
requires(ulpgate::RealType<Real> && !ulpgate::NativeReal<Real>) struct NumTraits<Real>
    : GenericNumTraits<Real> {
  using Real_ = Real;
  using NonInteger = Real;
  using Nested = Real;
  using Literal = Real;
  enum {
    IsInteger = 0,
    IsSigned = 1,
    IsComplex = 0,
    RequireInitialization = 1,
    ReadCost = 10,
    AddCost = 20,
    MulCost = 40,
  };
  static Real epsilon() { return std::numeric_limits<Real>::epsilon(); }
  // The tolerance of isApprox: an eighth of the digits are left to rounding.
  static Real dummy_precision() {
    return ldexp(Real(1), -static_cast<int>(std::numeric_limits<Real>::digits * 7L / 8));
  }
  static Real highest() { return (std::numeric_limits<Real>::max)(); }
  static Real lowest() { return -(std::numeric_limits<Real>::max)(); }
  static Real infinity() { return std::numeric_limits<Real>::infinity(); }
  // NOLINTNEXTLINE(readability-identifier-naming): Eigen asks for it
  static Real quiet_NaN() { return std::numeric_limits<Real>::quiet_NaN(); }
  static int digits10() { return std::numeric_limits<Real>::digits10; }
};

}  // namespace Eigen

namespace ulpgate {

// Rows x 1 and Rows x Cols; X (Eigen::Dynamic) sizes are chosen at run time.
template <unsigned N, class Base, int Rows>
using VectorNrHP = Eigen::Matrix<RealHP<N, Base>, Rows, 1>;
template <unsigned N, class Base>
using Vector2rHP = VectorNrHP<N, Base, 2>;
template <unsigned N, class Base>
using Vector3rHP = VectorNrHP<N, Base, 3>;
template <unsigned N, class Base>
using VectorXrHP = VectorNrHP<N, Base, Eigen::Dynamic>;
template <unsigned N, class Base>
using Matrix3rHP = Eigen::Matrix<RealHP<N, Base>, 3, 3>;
template <unsigned N, class Base>
using MatrixXrHP = Eigen::Matrix<RealHP<N, Base>, Eigen::Dynamic, Eigen::Dynamic>;
template <unsigned N, class Base>
using QuaternionrHP = Eigen::Quaternion<RealHP<N, Base>>;
template <unsigned N, class Base>
using AngleAxisrHP = Eigen::AngleAxis<RealHP<N, Base>>;
template <unsigned N, class Base, int Rows>
using AlignedBoxrHP = Eigen::AlignedBox<RealHP<N, Base>, Rows>;

}  // namespace ulpgate
