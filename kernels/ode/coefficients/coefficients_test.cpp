// Composition methods against their order conditions at 248 digits.
#include <gtest/gtest.h>

#include <array>

#include "kernels/ode/integrators/splitting.hpp"
#include "reference/text/literal.hpp"

namespace ulpgate::ode {
namespace {

using Reference = MpfrReal<248>;  // RealHP<4, mpfr62>

// What the kicks and drifts of a method miss of exp(h (A + B)), whose coefficient of a word of n letters is
// 1/n!: the largest over the Lyndon words of one length.  Another algebra than the one that was solved.
Reference largest_miss(const std::vector<Substep<Reference>>& sequence, int length) {
  std::vector<Factor<Reference>> factors;
  factors.reserve(sequence.size());
  for (const auto& s : sequence) factors.push_back({s.flow, s.fraction});
  const std::vector<int> letters = {kDrift, kKick};
  const std::vector<int> grades = {1, 1};
  Reference factorial(1);
  for (int i = 2; i <= length; ++i) factorial *= i;
  Reference largest(0);
  for (const Word& word : lyndon_words(letters, grades, length)) {
    const Reference miss =
        abs(word_coefficient(std::span<const Factor<Reference>>(factors), word) - 1 / factorial);
    if (miss > largest) largest = miss;
  }
  return largest;
}

TEST(LyndonWords, NumbersOfConditionsAreThoseInPrint) {
  // Hairer, Lubich & Wanner (2006), V.3.2.
  EXPECT_EQ(symmetric_step_words(2).size(), 1U);
  EXPECT_EQ(symmetric_step_words(4).size(), 2U);
  EXPECT_EQ(symmetric_step_words(6).size(), 4U);
  EXPECT_EQ(symmetric_step_words(8).size(), 8U);
  EXPECT_EQ(symmetric_step_words(10).size(), 16U);
  // Binary necklaces without a period: 2, 1, 2, 3, 6, 9 (E. Witt, J. reine angew. Math. 177 (1937) 152).
  EXPECT_EQ(splitting_words(6).size(), 23U);
}

TEST(Compositions, MeetTheirOrderConditionsTo200Digits) {
  for (const CompositionRow& row : composition_rows()) {
    const auto& sequence = splitting<Reference>(row.name);
    for (int length = 1; length <= row.order; ++length) {
      EXPECT_LT(largest_miss(sequence, length), real<Reference>("1e-240"))
          << row.name << " length " << length;
    }
    EXPECT_GT(largest_miss(sequence, row.order + 1), real<Reference>("1e-9"))
        << row.name << " is of a higher order";
  }
}

TEST(Compositions, KeepThePublishedDigits) {
  for (const CompositionRow& row : composition_rows()) {
    if (row.published.empty()) continue;
    const auto solved = solve_composition<Guarded<Reference>>(row);
    ASSERT_TRUE(solved) << row.name;
    for (std::size_t i = 0; i < solved->size(); ++i) {
      // The last digits in print are wrong in solution D of Yoshida's table 2, by up to 2.8e-13.
      EXPECT_LT(abs((*solved)[i] - real<Guarded<Reference>>(row.published[i])),
                real<Guarded<Reference>>("3e-13"))
          << row.name << " parameter " << i;
    }
  }
}

TEST(Compositions, ForestRuthIsItsClosedForm) {
  const Reference theta = 1 / (2 - cbrt(Reference(2)));
  const std::vector<Reference> wanted = {theta / 2,       theta, (1 - theta) / 2, 1 - 2 * theta,
                                         (1 - theta) / 2, theta, theta / 2};
  const auto& got = splitting<Reference>("forest_ruth");
  ASSERT_EQ(got.size(), wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    EXPECT_LT(abs(got[i].fraction - wanted[i]), real<Reference>("1e-246")) << i;
    EXPECT_EQ(got[i].flow, i % 2 == 0 ? kDrift : kKick);
  }
}

// Each type solves for itself; they must have found the same member of a family.
TEST(Compositions, AreTheSameInEveryType) {
  for (const CompositionRow& row : composition_rows()) {
    const auto& wide = splitting<Reference>(row.name);
    const auto& narrow = splitting<double>(row.name);
    const auto& middle = splitting<MpfrReal<62>>(row.name);
    ASSERT_EQ(wide.size(), narrow.size());
    for (std::size_t i = 0; i < wide.size(); ++i) {
      EXPECT_EQ(narrow[i].fraction, static_cast<double>(wide[i].fraction)) << row.name << " " << i;
      EXPECT_EQ(middle[i].fraction, from_mpfr<MpfrReal<62>>(wide[i].fraction.backend().data()))
          << row.name << " " << i;
    }
  }
}

TEST(Compositions, DigitsThatLeadNowhereAreRunAsTheyStand) {
  const std::array<std::string_view, 2> digits = {"1.3", "-1.6"};
  const CompositionRow row{"wrong", 4, 3, CompositionKind::drift_first, digits, "none"};
  EXPECT_FALSE(solve_composition<MpfrReal<62>>(row));
  EXPECT_EQ(composition_parameters<double>(row), (std::vector<double>{1.3, -1.6}));
  EXPECT_THROW((void)splitting<double>("nothing"), std::invalid_argument);
}

}  // namespace
}  // namespace ulpgate::ode
