// AuditedReal: a Real of 62 digits that notes every double, float or long double that becomes one of it and
// that is no short number; a kernel that holds such a literal is good to 16 digits only, whatever its type.
#pragma once

#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <compare>
#include <concepts>
#include <set>

#include "reference/types/real_types.hpp"

namespace ulpgate {

class AuditedReal {
 public:
  using Value = MpfrReal<62>;

  AuditedReal() = default;
  template <std::integral Integer>
  AuditedReal(Integer i) : value_(i) {}  // NOLINT(google-explicit-constructor): as the types it stands for
  template <std::floating_point Float>
  AuditedReal(Float x) : value_(x) {  // NOLINT(google-explicit-constructor)
    // 1/2, 0.75, 1024: up to 16 bits are meant as they stand.
    int exponent = 0;
    const auto scaled = std::ldexp(std::frexp(static_cast<long double>(x), &exponent), 16);
    if (scaled != std::floor(scaled)) found_.insert(static_cast<double>(x));
  }
  explicit AuditedReal(Value value) : value_(std::move(value)) {}

  [[nodiscard]] const Value& value() const { return value_; }

  // The literals that this thread has met since the last call.
  [[nodiscard]] static std::set<double> take_found() { return std::exchange(found_, {}); }

#define ULPGATE_AUDITED_OPERATOR(op)                                           \
  friend AuditedReal operator op(const AuditedReal& a, const AuditedReal& b) { \
    return AuditedReal(Value(a.value_ op b.value_));                           \
  }                                                                            \
  AuditedReal& operator op##=(const AuditedReal& b) {                          \
    return *this = *this op b;                                                 \
  }
  ULPGATE_AUDITED_OPERATOR(+)
  ULPGATE_AUDITED_OPERATOR(-)
  ULPGATE_AUDITED_OPERATOR(*)
  ULPGATE_AUDITED_OPERATOR(/)
#undef ULPGATE_AUDITED_OPERATOR
  friend AuditedReal operator-(const AuditedReal& a) {
    return AuditedReal(Value(-a.value_));
  }
  friend bool operator==(const AuditedReal& a, const AuditedReal& b) {
    return a.value_ == b.value_;
  }
  friend bool operator<(const AuditedReal& a, const AuditedReal& b) {
    return a.value_ < b.value_;
  }
  friend bool operator>(const AuditedReal& a, const AuditedReal& b) {
    return a.value_ > b.value_;
  }
  friend bool operator<=(const AuditedReal& a, const AuditedReal& b) {
    return a.value_ <= b.value_;
  }
  friend bool operator>=(const AuditedReal& a, const AuditedReal& b) {
    return a.value_ >= b.value_;
  }

#define ULPGATE_AUDITED_FUNCTION(name)            \
  friend AuditedReal name(const AuditedReal& x) { \
    return AuditedReal(Value(name(x.value_)));    \
  }
  ULPGATE_AUDITED_FUNCTION(abs)
  ULPGATE_AUDITED_FUNCTION(sqrt)
  ULPGATE_AUDITED_FUNCTION(exp)
  ULPGATE_AUDITED_FUNCTION(log)
  ULPGATE_AUDITED_FUNCTION(sin)
  ULPGATE_AUDITED_FUNCTION(cos)
  ULPGATE_AUDITED_FUNCTION(tan)
#undef ULPGATE_AUDITED_FUNCTION
  friend AuditedReal atan2(const AuditedReal& y, const AuditedReal& x) {
    return AuditedReal(Value(atan2(y.value_, x.value_)));
  }
  friend AuditedReal ldexp(const AuditedReal& x, int exponent) {
    return AuditedReal(Value(ldexp(x.value_, exponent)));
  }
  friend AuditedReal frexp(const AuditedReal& x, int* exponent) {
    return AuditedReal(Value(frexp(x.value_, exponent)));
  }

 private:
  Value value_{0};
  static inline thread_local std::set<double> found_;
};

template <>
inline constexpr bool is_instrumented_real<AuditedReal> = true;

}  // namespace ulpgate

template <>
class std::numeric_limits<ulpgate::AuditedReal> : public std::numeric_limits<ulpgate::AuditedReal::Value> {};

// Boost makes constants of a type that it does not know from text through a stream; pi is all that kernels
// ask for.
template <>
struct boost::math::constants::detail::constant_pi<ulpgate::AuditedReal> {
  // How it would be made; boost::integral_constant or std's by the version of Boost.
  template <class Way>
  static const ulpgate::AuditedReal& get(const Way&) {
    static const ulpgate::AuditedReal value(boost::math::constants::pi<ulpgate::AuditedReal::Value>());
    return value;
  }
};
