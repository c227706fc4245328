// Reproducers.
#include "harness/core/gate/findings/reproducer.hpp"

#include <fmt/format.h>

#include "harness/core/arguments/strata.hpp"

namespace ulpgate {

std::string point_reproducer(const std::string& subject, const std::string& type,
                             const std::vector<std::string>& at) {
  std::string text = fmt::format("ulpgate at {} {}", subject, type);
  for (const auto& a : at) text += " " + a;
  return text;
}

std::string row_reproducer(RowKind of, const std::string& subject, const std::string& type,
                           const std::string& stratum, std::uint64_t samples, std::uint64_t seed) {
  // The two share --samples: one of them alone would get all.
  const bool shared = of == RowKind::function &&
                      (stratum == name_of(Stratum::uniform) || stratum == name_of(Stratum::stratified));
  // The worst cases come from files.
  const bool worst = stratum == name_of(Stratum::worst);
  return fmt::format(
      "ulpgate {} {} --types {} --strata {} --samples {} --seed {}{} --out reproduced --overwrite",
      of == RowKind::kernel ? "kernels --kernels" : "math --functions", subject, type,
      shared ? "uniform,stratified" : stratum, samples, seed, worst ? " --worst-cases ci/worst_cases" : "");
}

std::string shell_word(const std::string& text) {
  constexpr const char* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+.,/:=@%";
  if (!text.empty() && text.find_first_not_of(plain) == std::string::npos) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace ulpgate
