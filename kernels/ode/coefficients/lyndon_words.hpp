// Lyndon words of graded letters: the independent order conditions of composition and splitting methods.
//
// The coefficients of Lyndon words are independent coordinates of a product of exponentials of non-commuting
// letters, and all others follow from them by shuffle products (D. E. Radford, J. Algebra 58 (1979) 432).
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace ulpgate::ode {

using Word = std::vector<int>;

// Strictly smaller than each of its proper suffixes.
[[nodiscard]] inline bool is_lyndon(const Word& word) {
  for (std::size_t i = 1; i < word.size(); ++i) {
    if (!std::ranges::lexicographical_compare(word, std::span(word).subspan(i))) return false;
  }
  return !word.empty();
}

namespace detail {

inline void collect_lyndon(std::span<const int> letters, std::span<const int> grades, int left, Word& word,
                           std::vector<Word>& found) {
  if (left == 0) {
    if (is_lyndon(word)) found.push_back(word);
    return;
  }
  for (std::size_t i = 0; i < letters.size(); ++i) {
    if (grades[i] > left) continue;
    word.push_back(letters[i]);
    collect_lyndon(letters, grades, left - grades[i], word, found);
    word.pop_back();
  }
}

}  // namespace detail

// All Lyndon words whose grades add up to `grade`; letter i has grade grades[i].
[[nodiscard]] inline std::vector<Word> lyndon_words(std::span<const int> letters, std::span<const int> grades,
                                                    int grade) {
  std::vector<Word> found;
  Word word;
  detail::collect_lyndon(letters, grades, grade, word, found);
  return found;
}

}  // namespace ulpgate::ode
