// The words of a piece's text: exact numbers, lists of them.
#pragma once

#include <charconv>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reference/text/text.hpp"

namespace ulpgate {

// "a b,c -" as {"a", "b,c", "-"}; text without the separator is one word.
[[nodiscard]] inline std::vector<std::string_view> words_of(std::string_view text, char separator) {
  std::vector<std::string_view> words;
  while (true) {
    const std::size_t end = text.find(separator);
    words.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return words;
    text.remove_prefix(end + 1);
  }
}

// "-" for none.
template <RealType Real>
[[nodiscard]] std::string list_text(std::span<const Real> numbers) {
  std::string text;
  for (const Real& x : numbers) {
    if (!text.empty()) text += ',';
    text += to_hexfloat(x);
  }
  return text.empty() ? "-" : text;
}

// Throws std::invalid_argument where a word is no number.
template <RealType Real>
[[nodiscard]] std::vector<Real> list_of(std::string_view text) {
  std::vector<Real> numbers;
  if (text == "-") return numbers;
  for (const auto word : words_of(text, ',')) numbers.push_back(parse_real<Real>(word));
  return numbers;
}

[[nodiscard]] inline long count_of(std::string_view word) {
  long n = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), n);
  if (error != std::errc() || end != word.data() + word.size())
    throw std::invalid_argument("not a count: '" + std::string(word) + "'");
  return n;
}

}  // namespace ulpgate
