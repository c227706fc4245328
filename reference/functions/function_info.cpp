// The table of functions, expanded from functions.def.
#include "reference/functions/function_info.hpp"

#include <algorithm>

namespace ulpgate {

namespace {

using enum DomainMap;
using enum FunctionClass;
constexpr auto no = ALL;  // fills unused slots

constexpr FunctionInfo table[] = {
#define REAL1(name, d0, hard, mpfr) {FunctionId::name, #name, real, 1, 1, {d0, no, no, no}, HardFamily::hard},
#define REAL2(name, d0, d1, hard, mpfr) \
  {FunctionId::name, #name, real, 2, 1, {d0, d1, no, no}, HardFamily::hard},
#define REAL3(name, d0, d1, d2, hard, mpfr) \
  {FunctionId::name, #name, real, 3, 1, {d0, d1, d2, no}, HardFamily::hard},
#define OPER2(name, op, d0, d1, hard, mpfr) \
  {FunctionId::name, #name, real, 2, 1, {d0, d1, no, no}, HardFamily::hard},
#define COMPLEX1(token, callee, mpc) \
  {FunctionId::token, #token, complex, 2, 2, {ALL, ALL, no, no}, HardFamily::none},
#define COMPLEX2(token, callee, mpc) \
  {FunctionId::token, #token, complex, 4, 2, {ALL, ALL, ALL, ALL}, HardFamily::none},
#define COMPLEX_REAL(token, callee, mpc) \
  {FunctionId::token, #token, complex, 2, 1, {ALL, ALL, no, no}, HardFamily::none},
#define POLAR(token, callee) {FunctionId::token, #token, complex, 2, 2, {GT0, ALL, no, no}, HardFamily::none},
#define SPECIAL1(token, d0) {FunctionId::token, #token, special, 1, 1, {d0, no, no, no}, HardFamily::none},
#define SPECIAL2(token, d0, d1, hard) \
  {FunctionId::token, #token, special, 2, 1, {d0, d1, no, no}, HardFamily::hard},
#define SPECIAL3(token, d0, d1, d2) \
  {FunctionId::token, #token, special, 3, 1, {d0, d1, d2, no}, HardFamily::none},
#define SPECIAL4_COMPLEX(token, d0, d1, d2, d3) \
  {FunctionId::token, #token, special, 4, 2, {d0, d1, d2, d3}, HardFamily::none},
#include "reference/functions/functions.def"
};

}  // namespace

std::span<const FunctionInfo> all_functions() {
  return table;
}

std::optional<FunctionInfo> find_function(std::string_view name) {
  const auto* it = std::ranges::find(table, name, &FunctionInfo::name);
  return it == std::end(table) ? std::nullopt : std::optional(*it);
}

std::string_view name_of(FunctionClass c) {
  constexpr std::string_view names[] = {"real", "complex", "special"};
  return names[static_cast<std::size_t>(c)];
}

std::string_view name_of(DomainMap m) {
  constexpr std::string_view names[] = {"ALL", "PM1",  "GTM1", "GT1",   "GT0",
                                        "NZ",  "UINT", "INT",  "MODPI", "MOD2PI"};
  return names[static_cast<std::size_t>(m)];
}

std::string_view part_name(const FunctionInfo& f, int part) {
  if (f.parts == 1) return "value";
  return part == 0 ? "re" : "im";
}

}  // namespace ulpgate
