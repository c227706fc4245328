// Known defects of a family's RealHP<4>, found by comparing it with MPFR and MPC over all strata
// (Boost 1.81).
#include "harness/core/functions/oracle_defects.hpp"

#include <algorithm>
#include <array>

namespace ulpgate {

namespace {

struct Defect {
  FunctionId function;
  std::string_view family;  // prefix of the type token; empty for every type
  std::string_view reason;
};

constexpr std::string_view definitions =
    "boost complex_adaptor evaluates the textbook definition: parts of unlike size cancel or overflow";
constexpr std::string_view reduction =
    "boost cpp_bin_float: the argument reduction carries too few digits for huge arguments next to multiples "
    "of pi/2";
constexpr std::string_view range_end = "boost cpp_bin_float: wrong next to over- and underflow at 2^(2^31)";
constexpr std::string_view remainders =
    "boost cpp_bin_float: fmod and remainder of huge quotients and of infinities";
constexpr std::string_view poles = "boost cpp_bin_float: tgamma of huge negative arguments gives no zero";
constexpr std::string_view cancelling = "the polynomial cancels more digits than RealHP<4> carries";

constexpr std::array defects = {
    Defect{FunctionId::ctan, "", definitions},
    Defect{FunctionId::ctanh, "", definitions},
    Defect{FunctionId::casin, "", definitions},
    Defect{FunctionId::casinh, "", definitions},
    Defect{FunctionId::cacos, "", definitions},
    Defect{FunctionId::cacosh, "", definitions},
    Defect{FunctionId::catan, "", definitions},
    Defect{FunctionId::catanh, "", definitions},
    Defect{FunctionId::cpow, "", definitions},
    Defect{FunctionId::csin, "cpp_bin_float", definitions},
    Defect{FunctionId::csinh, "cpp_bin_float", definitions},
    Defect{FunctionId::sin, "cpp_bin_float", reduction},
    Defect{FunctionId::cos, "cpp_bin_float", reduction},
    Defect{FunctionId::tan, "cpp_bin_float", reduction},
    Defect{FunctionId::exp, "cpp_bin_float", range_end},
    Defect{FunctionId::exp2, "cpp_bin_float", range_end},
    Defect{FunctionId::expm1, "cpp_bin_float", range_end},
    Defect{FunctionId::sinh, "cpp_bin_float", range_end},
    Defect{FunctionId::cosh, "cpp_bin_float", range_end},
    Defect{FunctionId::erfc, "cpp_bin_float", range_end},
    Defect{FunctionId::fmod, "cpp_bin_float", remainders},
    Defect{FunctionId::remainder, "cpp_bin_float", remainders},
    Defect{FunctionId::ccos, "cpp_bin_float", definitions},
    Defect{FunctionId::ccosh, "cpp_bin_float", definitions},
    Defect{FunctionId::cexp, "cpp_bin_float", reduction},
    Defect{FunctionId::cpolar, "cpp_bin_float", reduction},
    Defect{FunctionId::cyl_bessel_j, "cpp_bin_float", reduction},
    Defect{FunctionId::tgamma, "cpp_bin_float", poles},
    Defect{FunctionId::laguerre, "float", cancelling},
};

}  // namespace

std::optional<std::string_view> known_oracle_defect(const FunctionInfo& f, std::string_view token) {
  const auto* it = std::ranges::find_if(
      defects, [&](const Defect& d) { return d.function == f.id && token.starts_with(d.family); });
  return it == defects.end() ? std::nullopt : std::optional(it->reason);
}

}  // namespace ulpgate
