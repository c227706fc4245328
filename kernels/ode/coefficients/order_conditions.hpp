// Order conditions of composition methods: coefficients of words in a product of exponentials.
//
// A symmetric second-order step S(h) is exp(h Y1 + h^3 Y3 + h^5 Y5 + ...) with non-commuting Y (H. Yoshida,
// Phys. Lett. A 150 (1990) 262).  A composition S(w1 h) S(w2 h) ... has order p when it agrees with exp(h Y1)
// in every Lyndon word of grade <= p; a palindromic one agrees in all even grades by itself.  The numbers of
// conditions 1, 2, 4, 8, 16 for p = 2 ... 10 are those of E. Hairer, C. Lubich, G. Wanner, Geometric
// Numerical Integration (2006), V.3.2.  A product of kicks and drifts is expanded in the same way over two
// letters of grade 1.
#pragma once

#include <span>
#include <vector>

#include "kernels/ode/coefficients/lyndon_words.hpp"

namespace ulpgate::ode {

inline constexpr int kDrift = 0;  // q += h v
inline constexpr int kKick = 1;   // v += h a(q)

// The exponential of one letter, or of a whole symmetric step of size `weight`.
template <class Scalar>
struct Factor {
  static constexpr int kSymmetricStep = -1;
  int letter = kSymmetricStep;  // kDrift, kKick or kSymmetricStep (letters are then the indices 1, 3, 5 ...)
  Scalar weight{};

  // Coefficient of `word` (not empty) in the exponential.
  [[nodiscard]] Scalar coefficient(std::span<const int> word) const {
    int power = 0;
    long factorial = 1;
    for (std::size_t i = 0; i < word.size(); ++i) {
      if (letter != kSymmetricStep && word[i] != letter) return Scalar(0);
      power += letter == kSymmetricStep ? word[i] : 1;
      factorial *= static_cast<long>(i) + 1;
    }
    Scalar result = weight;
    for (int i = 1; i < power; ++i) result = result * weight;
    return result / Scalar(static_cast<int>(factorial));
  }
};

// Coefficient of `word` in the product of the factors, left to right.  Words are short: factorials fit an int
// up to 12 letters.
template <class Scalar>
[[nodiscard]] Scalar word_coefficient(std::span<const Factor<Scalar>> factors, const Word& word) {
  const std::span<const int> letters(word);
  std::vector<Scalar> prefix(word.size() + 1, Scalar(0));
  prefix[0] = Scalar(1);
  for (const Factor<Scalar>& factor : factors) {
    for (std::size_t end = word.size(); end > 0; --end) {
      for (std::size_t begin = end; begin-- > 0;) {
        prefix[end] = prefix[end] + prefix[begin] * factor.coefficient(letters.subspan(begin, end - begin));
        // A word that holds another letter does not occur in this exponential, nor does a longer one.
        if (factor.letter != Factor<Scalar>::kSymmetricStep && letters[begin] != factor.letter) break;
      }
    }
  }
  return prefix.back();
}

// Words whose coefficients decide the order of a palindromic composition of symmetric steps.
[[nodiscard]] inline std::vector<Word> symmetric_step_words(int order) {
  const std::vector<int> letters = {1, 3, 5, 7, 9, 11};
  std::vector<Word> words;
  for (int grade = 1; grade < order; grade += 2) {
    const std::vector<Word> more = lyndon_words(letters, letters, grade);
    words.insert(words.end(), more.begin(), more.end());
  }
  return words;
}

// Words whose coefficients decide the order of any product of kicks and drifts.
[[nodiscard]] inline std::vector<Word> splitting_words(int order) {
  const std::vector<int> letters = {kDrift, kKick};
  const std::vector<int> grades = {1, 1};
  std::vector<Word> words;
  for (int grade = 1; grade <= order; ++grade) {
    const std::vector<Word> more = lyndon_words(letters, grades, grade);
    words.insert(words.end(), more.begin(), more.end());
  }
  return words;
}

}  // namespace ulpgate::ode
