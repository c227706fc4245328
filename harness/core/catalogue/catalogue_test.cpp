// The catalogue as a whole: names, texts, and that every family is there.
#include "harness/core/catalogue/catalogue.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "harness/core/subject/registry.hpp"

namespace ulpgate {
namespace {

TEST(Catalogue, KeysAreUniqueAndEveryCaseSaysWhatItIs) {
  std::set<std::string> keys;
  std::map<std::string, int> kinds;
  for (const auto& c : stress_catalogue()) {
    EXPECT_TRUE(keys.insert(c.key()).second) << c.key();
    EXPECT_FALSE(c.title.empty()) << c.key();
    EXPECT_EQ(c.key().find_first_of(" ,\n"), std::string::npos) << c.key();
    EXPECT_TRUE(c.run) << c.key();
    ++kinds[c.kind];
  }
  for (const char* kind : {"formula", "trajectory", "state", "scene", "metamorphic", "step_limit"})
    EXPECT_GT(kinds[kind], 4) << kind;
}

TEST(Catalogue, KnownVerdictsNameTypesAndCauses) {
  const std::set<std::string> tokens{"float",  "double",  "long_double",    "float128",
                                     "mpfr62", "mpfr150", "cpp_bin_float62"};
  for (const auto& c : stress_catalogue()) {
    for (const auto& known : c.known) {
      EXPECT_GT(known.cause.size(), 15U) << c.key();
      // A refusal is known by its text; a sentence of it, no word that any error could have.
      EXPECT_EQ(known.says.size() > 15U, known.verdict == StressVerdict::refused) << c.key();
      if (known.types == "all") continue;
      for (std::size_t at = 0; at <= known.types.size();) {
        const std::size_t end = std::min(known.types.find(',', at), known.types.size());
        EXPECT_TRUE(tokens.contains(known.types.substr(at, end - at))) << c.key() << ": " << known.types;
        at = end + 1;
      }
    }
  }
}

}  // namespace
}  // namespace ulpgate
