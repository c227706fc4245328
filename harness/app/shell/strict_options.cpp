// Strict options.
#include "harness/app/shell/strict_options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>

namespace ulpgate::app {

namespace {

std::string quoted(const std::string& text) {
  return "'" + text + "'";
}

template <class Integer>
std::errc range_of(const std::string& text) {
  Integer n = 0;
  return std::from_chars(text.data(), text.data() + text.size(), n).ec;
}

}  // namespace

std::string count_fault(const std::string& text, bool negative) {
  const std::string digits = negative && text.starts_with("-") ? text.substr(1) : text;
  if (digits.empty() || !std::ranges::all_of(digits, [](char c) { return c >= '0' && c <= '9'; }))
    return fmt::format("{} is no whole number{}", quoted(text), negative ? "" : " from 0 on");
  if (digits.size() > 1 && digits.front() == '0')
    return fmt::format("{} begins with a zero: numbers are decimal, write it without", quoted(text));
  const std::errc range = negative ? range_of<std::int64_t>(text) : range_of<std::uint64_t>(text);
  return range == std::errc() ? "" : quoted(text) + " has more than 64 bits";
}

std::string real_fault(const std::string& text) {
  // strtod alone would take leading blanks, "nan" and "inf".
  constexpr const char* allowed = "0123456789+-.eEpPxXabcdfABCDF";
  char* end = nullptr;
  const double x = std::strtod(text.c_str(), &end);
  if (text.empty() || text.find_first_not_of(allowed) != std::string::npos ||
      end != text.c_str() + text.size())
    return quoted(text) + " is no finite number";
  return std::isfinite(x) ? "" : quoted(text) + " is beyond the range of a double";
}

void make_options_strict(CLI::App& app) {
  for (CLI::Option* option : app.get_options()) {
    // The type's name stands first; those of the checks follow.
    const std::string type = option->get_type_name();
    if (option->get_items_expected_max() == 0) continue;
    if (type.starts_with("UINT") || type.starts_with("INT")) {
      const bool negative = type.starts_with("INT");
      option->check([negative](const std::string& text) { return count_fault(text, negative); });
    } else if (type.starts_with("FLOAT")) {
      option->check([](const std::string& text) { return real_fault(text); });
    } else {
      option->check(
          [](const std::string& text) { return text.empty() ? std::string("'' is no value") : ""; });
    }
  }
  for (CLI::App* verb : app.get_subcommands({})) make_options_strict(*verb);
}

}  // namespace ulpgate::app
