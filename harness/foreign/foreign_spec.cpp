// ForeignSpec: names and signatures.
#include "harness/foreign/foreign_spec.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "harness/worker/worker_signature.h"

namespace ulpgate {

namespace {

// "_ZGVdN4vv_pow": lanes and arguments of the vector ABI; "" where it is no such name.
std::string vector_abi_signature(const std::string& symbol, char element) {
  if (!symbol.starts_with("_ZGV") || symbol.size() < 8 || symbol[5] != 'N') return "";
  std::size_t at = 6;
  std::string lanes;
  while (at < symbol.size() && symbol[at] >= '0' && symbol[at] <= '9') lanes += symbol[at++];
  const auto end = symbol.find('_', at);
  if (lanes.empty() || end == std::string::npos) return "";
  const std::string kinds = symbol.substr(at, end - at);
  const std::string operand = fmt::format("v{}{}", lanes, element);
  if (kinds == "v") return fmt::format("{0}({0})", operand);
  if (kinds == "vv") return fmt::format("{0}({0},{0})", operand);
  // sincos: a pointer for each lane.
  if (kinds == "vvv" && symbol.find("_sincos") == end) return fmt::format("void({0},{0}*,{0}*)", operand);
  if (kinds == "vvv") return fmt::format("{0}({0},{0},{0})", operand);
  if (kinds == "vl8l8" || kinds == "vl4l4") return fmt::format("void({0},{1}*,{1}*)", operand, element);
  return "";
}

// "Sleef_sind4_u10avx2", "Sleef_powf8_u10": SLEEF's names say type and lanes before the bound.
std::string sleef_signature(const std::string& symbol, char element, int arity) {
  if (!symbol.starts_with("Sleef_")) return "";
  const auto bound = symbol.find('_', 6);
  if (bound == std::string::npos) return "";
  std::size_t digits = bound;
  while (digits > 6 && symbol[digits - 1] >= '0' && symbol[digits - 1] <= '9') --digits;
  if (digits == bound || symbol[digits - 1] != element) return "";
  const std::string operand = fmt::format("v{}{}", symbol.substr(digits, bound - digits), element);
  std::string text = operand + "(" + operand;
  for (int i = 1; i < arity; ++i) text += "," + operand;
  ulpgate_signature parsed;
  text += ")";
  return ulpgate_parse_signature(text.c_str(), &parsed) != 0 ? text : "";
}

}  // namespace

std::string default_signature(const std::string& symbol, char element, int arity) {
  for (const auto& found : {vector_abi_signature(symbol, element), sleef_signature(symbol, element, arity)})
    if (!found.empty()) return found;
  std::string text = fmt::format("{0}({0}", element);
  for (int i = 1; i < arity; ++i) text += fmt::format(",{}", element);
  return text + ")";
}

std::string ForeignFacts::name_with(const std::string& symbol) const {
  const std::string file = std::filesystem::path(path).filename().string();
  return fmt::format("{} {}", !file.empty() ? file : soname, symbol);
}

std::string ForeignSpec::selection() const {
  const auto quoted = [](const std::string& word) {
    constexpr std::string_view plain =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=,:+@%";
    if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
    std::string text = "'";
    for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
  };
  std::string text = fmt::format(" --library {} --symbol {}", quoted(library), quoted(symbol));
  if (!signature.empty()) text += fmt::format(" --signature {}", quoted(signature));
  if (!worker.empty()) text += fmt::format(" --worker {}", quoted(worker));
  for (const auto& e : environment) text += fmt::format(" --worker-environment {}", quoted(e));
  return text;
}

}  // namespace ulpgate
