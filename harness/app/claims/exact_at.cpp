// exact_at(), values_of().
#include <stdexcept>
#include <utility>

#include "harness/app/claims/claim.hpp"
#include "reference/oracle/oracle.hpp"

namespace ulpgate::app {

std::vector<MpfrValue> values_of(const RealDescriptor& type, const std::vector<std::string>& args) {
  std::vector<MpfrValue> x;
  for (const auto& a : args) {
    x.emplace_back(type.format.precision);
    if (mpfr_set_str(x.back().get(), a.c_str(), 0, MPFR_RNDN) != 0)
      throw std::invalid_argument("not a number: '" + a + "'");
  }
  return x;
}

MpfrValue exact_at(const FunctionInfo& f, const RealDescriptor& type, const std::vector<std::string>& args) {
  std::vector<MpfrValue> y;
  y.emplace_back(type.reference_bits);
  exact_value(f, values_of(type, args), y);
  return std::move(y.front());
}

}  // namespace ulpgate::app
