// FunctionInfo: the facts about a function that stand in its row of functions.def.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

namespace ulpgate {

enum class FunctionId : int {
#define ULPGATE_ID(name) name,
#define REAL1(name, domain, hard, mpfr) name,
#define REAL2(name, domain0, domain1, hard, mpfr) name,
#define REAL3(name, domain0, domain1, domain2, hard, mpfr) name,
#define OPER2(name, op, domain0, domain1, hard, mpfr) name,
#define COMPLEX1(token, callee, mpc) token,
#define COMPLEX2(token, callee, mpc) token,
#define COMPLEX_REAL(token, callee, mpc) token,
#define POLAR(token, callee) token,
#define SPECIAL1(token, domain0) token,
#define SPECIAL2(token, domain0, domain1, hard) token,
#define SPECIAL3(token, domain0, domain1, domain2) token,
#define SPECIAL4_COMPLEX(token, domain0, domain1, domain2, domain3) token,
#include "reference/functions/functions.def"
#undef ULPGATE_ID
};

enum class FunctionClass { real, complex, special };

// How an argument on (-100, 100) is brought into the domain (paper's maps): ALL x; PM1 fmod(|x|, 2) - 1;
// GTM1 |x| - 1; GT1 |x| + 1; GT0 |x|; NZ x, or 1 where x is 0; UINT |floor x|; INT floor x; MODPI fmod(|x|,
// pi); MOD2PI fmod(|x|, 2 pi).
enum class DomainMap { ALL, PM1, GTM1, GT1, GT0, NZ, UINT, INT, MODPI, MOD2PI };

// Families of structured hard arguments.
enum class HardFamily { none, unit, trig, range, gamma, power, bessel };

inline constexpr int max_arity = 4;
inline constexpr int max_parts = 2;

struct FunctionInfo {
  FunctionId id;
  std::string_view name;
  FunctionClass function_class;
  int arity;  // number of Real arguments; a complex argument counts two
  int parts;  // number of Real results: 1, or 2 for a complex value
  std::array<DomainMap, max_arity> domain;
  HardFamily hard;
};

[[nodiscard]] std::span<const FunctionInfo> all_functions();
[[nodiscard]] std::optional<FunctionInfo> find_function(std::string_view name);
[[nodiscard]] inline const FunctionInfo& info_of(FunctionId id) {
  return all_functions()[static_cast<std::size_t>(id)];
}
[[nodiscard]] std::string_view name_of(FunctionClass c);
[[nodiscard]] std::string_view name_of(DomainMap m);
// "value", or "re" and "im".
[[nodiscard]] std::string_view part_name(const FunctionInfo& f, int part);

}  // namespace ulpgate
