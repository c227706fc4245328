// Levels of instruction sets.
#include "reference/lanes/levels.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>
#include <string_view>

namespace ulpgate {

namespace {

std::size_t levels_of_processor() {
#ifdef ULPGATE_LEVELS
  if (__builtin_cpu_supports("x86-64-v4") != 0) return 3;
  if (__builtin_cpu_supports("x86-64-v3") != 0) return 2;
#endif
  return 1;
}

std::size_t levels_of_environment() {
  constexpr std::array<std::string_view, 3> names = {"baseline", "avx2", "avx512"};
  const char* wanted = std::getenv("ULPGATE_INSTRUCTIONS");
  if (wanted == nullptr || *wanted == '\0') return names.size();
  const auto* found = std::ranges::find(names, std::string_view(wanted));
  if (found == names.end())
    throw UnknownInstructions("ULPGATE_INSTRUCTIONS is '" + std::string(wanted) +
                              "'; it may be baseline, avx2 or avx512");
  return static_cast<std::size_t>(found - names.begin()) + 1;
}

}  // namespace

std::size_t instruction_levels() {
  static const std::size_t levels = std::min(levels_of_processor(), levels_of_environment());
  return levels;
}

}  // namespace ulpgate
