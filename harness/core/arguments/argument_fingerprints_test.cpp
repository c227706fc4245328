// Fingerprints of arguments: the same seed draws the same points, on every machine and for ever.
//
// Arguments are made of random words by exact rules, by operations that round correctly and by MPFR, and no C
// library has a say in them.  A change of a number below changes every record, budget and reported point:
// that is a decision, to be taken with the version in the plan's text, and never a repair of this test.
#include <gtest/gtest.h>

#include "harness/core/arguments/narrow_arguments.hpp"
#include "harness/core/arguments/sampling.hpp"
#include "harness/core/testing/fingerprint.hpp"

namespace ulpgate {
namespace {

using testing::Fingerprint;
using testing::literal;

constexpr std::uint64_t seed = 7;

template <RealType Real>
std::uint64_t drawn(const FunctionInfo& f, Stratum stratum) {
  constexpr std::uint64_t count = 48;
  const auto arity = static_cast<std::size_t>(f.arity);
  std::vector<Real> x(count * arity);
  Arguments<Real>(f, {stratum, seed, count, nullptr}).make_all(0, count, x.data());
  Fingerprint print;
  for (const Real& value : x) print.add_value(value);
  return print.value();
}

std::uint64_t listed(const ArgumentList& list) {
  Fingerprint print;
  for (const auto& point : list)
    for (const auto& x : point) print.add_value(x.get());
  print.add(list.size());
  return print.value();
}

std::string table_row(std::string_view name, const std::vector<std::uint64_t>& prints) {
  std::string text = "{\"" + std::string(name) + "\", {";
  for (std::size_t i = 0; i < prints.size(); ++i) text += (i > 0 ? ", " : "") + literal(prints[i]);
  return text + "}},";
}

template <std::size_t N>
struct Row {
  std::string_view name;
  std::array<std::uint64_t, N> prints;
};

template <std::size_t N>
void expect_row(const Row<N>& row, const std::vector<std::uint64_t>& now) {
  EXPECT_TRUE(std::ranges::equal(row.prints, now)) << "now " << table_row(row.name, now);
}

const FunctionInfo& named(std::string_view name) {
  return info_of(find_function(name)->id);
}

// One of every domain and every number of arguments, and those that are drawn by rules of their own. Uniform,
// stratified and binades in float, in double and in mpfr62.
constexpr Row<9> of_drawn[] = {
    {"sin",
     {0x626504a1ce6c8b66, 0x929494d86fffc754, 0x762d0a72e8530ec6, 0xf6314d88ef8e93e4, 0x7c74cfe67188364e,
      0xc44871c69b7b9f15, 0xbe432a2d47d8de02, 0x8583c1467a24168a, 0xe98d52625a6191ac}},
    {"asin",
     {0x797479c571082a1e, 0x524836ced085e751, 0x7b0c5b40ba5eeda6, 0x0774e1272ecb4aa7, 0x9a971c444e038c73,
      0x4c44e61384562a97, 0x10ac58bbc733e3c4, 0x8d67c2a0353ca513, 0xf6df7ac2b9f1805f}},
    {"log1p",
     {0x1349e32b387d5530, 0xd6b2bbb9da45682a, 0xc03d981247216c8d, 0xf9e12c80be580022, 0xfdf8c4a226e4e974,
      0x9f003f26620685e6, 0xf443547ffe09014d, 0xe20efbf5364b905b, 0x043d2f3ebe943d84}},
    {"acosh",
     {0xf1e892cee1de3095, 0xfbaf5cfb75d40906, 0x879cfe40a956c347, 0x0cf35377eeb4da39, 0x228f336375e10c86,
      0x5711e58d0a517fbb, 0x930ccebd99ef22e2, 0xcc48b2b405548a65, 0xd9d57cdd1c417193}},
    {"log",
     {0x17166c233b27ea44, 0x4650abfdc5231c56, 0xe710325cf4a43cb2, 0x1e8c7986a7869bd2, 0x70563c0696600a73,
      0x6cb42dd5f6fdb777, 0x197c5d46b42db738, 0xf089b64e2c74cfad, 0x919d576563c07280}},
    {"div",
     {0x9ecd97159fee2ed9, 0x593f886a83f6f511, 0x303cf3c2a1114bfb, 0xc1fdcd828d32a8ca, 0x17c719238bde007d,
      0xdf0bbf4e911ad66c, 0xba46f2c6fb13a94e, 0xa35e3e525e5f91a2, 0xf92b0d0a2e2eccfd}},
    {"atan2",
     {0xae5a2eb97dc8c192, 0x26b51dc99f01b7e4, 0x3eefa788e9eac999, 0x64f56f456ffd5224, 0xfcd695500f33cd5f,
      0x83a795c8be71e677, 0x8a6abbdb695a74bb, 0x34180ae55df88209, 0x6d8459ef45148432}},
    {"fma",
     {0x6f75cf5aaff27378, 0xbc31c80686e0ed27, 0x52a64b6a150f54c3, 0xbcddf75acd63ea64, 0xdbe4fc34cb45af9d,
      0x6c91f183a434ad4a, 0xfc67fad72c2c5123, 0x9dcaa5705f1653bf, 0x454569eb07666c0a}},
    {"pow",
     {0x88704b19d6269eff, 0x6e34987ed6655f9d, 0x6fd36e53571f158a, 0x1f55a0480a4b656a, 0x959faaef1b23aa93,
      0x13a879de2c304819, 0xc833d3cacb078f91, 0x03d197b9ec00e086, 0x09eead2ea1d43b27}},
    {"csin",
     {0x58c82ec46e26302e, 0x9e30e1d949e5e37c, 0x0831fb5db31e4de7, 0xa80c2ff7ad63a7b1, 0x0bad928ba82bf4be,
      0xf00e72de46650c12, 0x03c70a87a28a0e53, 0xe65a1224d8f7a3f7, 0x9bf79d53be751aba}},
    {"cpow",
     {0x0941b34e9bbc8c19, 0x8688b4448da08681, 0x342b02d42e05e7a6, 0x60b471a1c156c3f0, 0x853b70199a9fb99d,
      0x39369e85d325e316, 0x79b39ee09914d794, 0x7077ab98af08a104, 0x41e1ea2a8be33be1}},
    {"cpolar",
     {0x0b0b737f8851448b, 0x4c5e8c13d26d90a4, 0xa33da3ba8e4e90a0, 0x04ee496b50fb2f5b, 0x5b840b81381f0695,
      0xcdb42573a4dc1d3a, 0x57b1395748834997, 0xce84e7aedfa326e5, 0x84cc7b5cc5df9059}},
    {"cyl_bessel_j",
     {0xabce584c54a2d355, 0x2e0fb75b20deb360, 0xdefee0f0193a0ac4, 0x84984ef8234e1141, 0x90150fe8ab8819dc,
      0x3fa9454d557ef732, 0x4d2b2a254e0c8f47, 0x27338ae53ef2e92c, 0x5017cecfdae557da}},
    {"factorial",
     {0x3aef6362bee32201, 0x3aef6362bee32201, 0x3aef6362bee32201, 0x5662a63e77d9ff8e, 0x5662a63e77d9ff8e,
      0x5662a63e77d9ff8e, 0x1e548b575ae4fbad, 0x1e548b575ae4fbad, 0x1e548b575ae4fbad}},
    {"laguerre",
     {0xd915a412945ad27d, 0x458c7b149bcb727f, 0x92ce9fe71e3e2c06, 0xee0bb7e767148dfb, 0xeb2e451e0cd9edb4,
      0x31120c5334ff5ff4, 0x4183c62d999e84a0, 0x3d19a1cbfd896d9b, 0x0735cc3bd91953e0}},
    {"spherical_harmonic",
     {0x94b9e17d9eb65787, 0xe410cf61f9fd6c5f, 0x4321d7c5aab7fdf3, 0x3671a3f00c7ddabf, 0x7b15e9618a4f95a1,
      0x42c492476f2be7dc, 0x21cfe3c5c65052fa, 0x5fe4829bd57834a5, 0x48138d6ee7f2e743}},
};

TEST(ArgumentFingerprints, WhatIsDrawnIsThatOfNameAndSeed) {
  for (const auto& row : of_drawn) {
    const FunctionInfo& f = named(row.name);
    std::vector<std::uint64_t> now;
    for (const auto stratum : {Stratum::uniform, Stratum::stratified, Stratum::binades})
      now.insert(now.end(),
                 {drawn<float>(f, stratum), drawn<double>(f, stratum), drawn<MpfrReal<62>>(f, stratum)});
    expect_row(row, now);
  }
}

// Edges and hard arguments in float, in double and in mpfr62; a function of every family.
constexpr Row<6> of_lists[] = {
    {"sin",
     {0x096f3ba417970986, 0xf22ca7ac9e550b1a, 0x13618f6abc95f80e, 0x88e323991bd80505, 0x914cdc7cf2250fe2,
      0x9f335cf592332639}},
    {"asin",
     {0x096f3ba417970986, 0xc82a06137f844b1c, 0x13618f6abc95f80e, 0x923600a34f12a88d, 0x914cdc7cf2250fe2,
      0x6f0210e175d61c3a}},
    {"acosh",
     {0x096f3ba417970986, 0xc82a06137f844b1c, 0x13618f6abc95f80e, 0x923600a34f12a88d, 0x914cdc7cf2250fe2,
      0x6f0210e175d61c3a}},
    {"log",
     {0x096f3ba417970986, 0xc82a06137f844b1c, 0x13618f6abc95f80e, 0x923600a34f12a88d, 0x914cdc7cf2250fe2,
      0x6f0210e175d61c3a}},
    {"div",
     {0x59391b516f0e32be, 0xa8c7f832281a39c5, 0xa2da51b9a3c51c86, 0xa8c7f832281a39c5, 0x4668427c08bf5620,
      0xa8c7f832281a39c5}},
    {"fma",
     {0x681a0bd3f44e1672, 0xa8c7f832281a39c5, 0xecbe5d161e93b5ae, 0xa8c7f832281a39c5, 0x7f0bae8ace3c831e,
      0xa8c7f832281a39c5}},
    {"pow",
     {0x59391b516f0e32be, 0x8d9aec69ccc9863c, 0xa2da51b9a3c51c86, 0x702d358a8a5572a6, 0x4668427c08bf5620,
      0x380c801088d449de}},
    {"exp",
     {0x096f3ba417970986, 0xe033b90c53190abc, 0x13618f6abc95f80e, 0x8df0c000c1e7ef31, 0x914cdc7cf2250fe2,
      0xe8203032d83df44a}},
    {"expm1",
     {0x096f3ba417970986, 0x2db02ac4d2e7894f, 0x13618f6abc95f80e, 0x2e31c4b8a3d13dea, 0x914cdc7cf2250fe2,
      0x8380ea907b8d6fdd}},
    {"cosh",
     {0x096f3ba417970986, 0xc474689b3dcb8637, 0x13618f6abc95f80e, 0xced8931b3985754e, 0x914cdc7cf2250fe2,
      0x59d3182ab36cbf5d}},
    {"erfc",
     {0x096f3ba417970986, 0xd1baffced3e9da3f, 0x13618f6abc95f80e, 0xee1e08fd2108f4e6, 0x914cdc7cf2250fe2,
      0xd677ac6e85c656f1}},
    {"tgamma",
     {0x096f3ba417970986, 0x23110461c951f376, 0x13618f6abc95f80e, 0xc8082218e148f223, 0x914cdc7cf2250fe2,
      0xa49411728f586643}},
    {"lgamma",
     {0x096f3ba417970986, 0x1d184e350e860397, 0x13618f6abc95f80e, 0xc689e846a005a1b9, 0x914cdc7cf2250fe2,
      0x4cde3e25467e05cc}},
    {"csin",
     {0x4e893f091b0c63c1, 0xa8c7f832281a39c5, 0x2ccfd3a9ddebb2f9, 0xa8c7f832281a39c5, 0x2ccfd3a9ddebb2f9,
      0xa8c7f832281a39c5}},
    {"cpolar",
     {0x4e893f091b0c63c1, 0xa8c7f832281a39c5, 0x2ccfd3a9ddebb2f9, 0xa8c7f832281a39c5, 0x2ccfd3a9ddebb2f9,
      0xa8c7f832281a39c5}},
    {"cpow",
     {0x0b956e90dd26d8d5, 0xa8c7f832281a39c5, 0xb6aaf67ae87efd05, 0xa8c7f832281a39c5, 0xb6aaf67ae87efd05,
      0xa8c7f832281a39c5}},
    {"cyl_bessel_j",
     {0x8c421e6acf95f179, 0x9f10ab4d767106cf, 0x7653193d5b0c6ea1, 0x1c9ca66bd49e6c7b, 0x4cc8dcbfbd6f6609,
      0xecaff4ef9d09093b}},
    {"factorial",
     {0xb539c15b24dc5759, 0xa8c7f832281a39c5, 0xb539c15b24dc5759, 0xa8c7f832281a39c5, 0xb539c15b24dc5759,
      0xa8c7f832281a39c5}},
    {"laguerre",
     {0xf4f81fa9b79fe2de, 0xa8c7f832281a39c5, 0x9f658507a07eabc6, 0xa8c7f832281a39c5, 0x1e67103cc9f03cae,
      0xa8c7f832281a39c5}},
    {"spherical_harmonic",
     {0xdcde0c3c3e9abfce, 0xa8c7f832281a39c5, 0xa9f7ace858c9f336, 0xa8c7f832281a39c5, 0xda163f661f3f74be,
      0xa8c7f832281a39c5}},
};

TEST(ArgumentFingerprints, TheListsAreThoseOfTheFormat) {
  for (const auto& row : of_lists) {
    const FunctionInfo& f = named(row.name);
    std::vector<std::uint64_t> now;
    for (const auto& format : {float_format<float>(), float_format<double>(), float_format<MpfrReal<62>>()}) {
      now.push_back(listed(edge_arguments(f, format)));
      now.push_back(listed(hard_arguments(f, format)));
    }
    expect_row(row, now);
  }
}

template <class Real>
std::uint64_t scanned(const FunctionInfo& f) {
  constexpr std::size_t count = 4096;
  std::vector<Real> x(count * static_cast<std::size_t>(f.arity));
  // Some from the start and some from far on.
  Fingerprint print;
  for (const std::uint64_t first : {std::uint64_t{0}, std::uint64_t{1} << 33U}) {
    NarrowArguments<Real>(f, seed).fill(first, count, x.data());
    for (const Real value : x) print.add_value(value);
  }
  return print.value();
}

// The points among which the stratum `narrow` looks, in float and double.
constexpr Row<2> of_scans[] = {
    {"sin", {0x37110ed83c6efd05, 0xede816ab342e91cc}},   {"asin", {0x1a9fcf3ee663b019, 0x7d4691a1c414f83a}},
    {"log1p", {0xf6de6f701718017e, 0x34912f503d796dfa}}, {"acosh", {0xf70b1b1f3d21b61d, 0x10f87b3127760128}},
    {"log", {0xfc78465990c02ed7, 0x6f87945ae589b0c1}},   {"div", {0x62b0983086360805, 0x4acd095d28ab8a7e}},
    {"fma", {0x2b7c18a970f0c32b, 0x8ac8fd0f9268cb42}},   {"pow", {0xb85e267438658a77, 0x1c837a1bfec2e1b2}},
};

TEST(ArgumentFingerprints, TheScannedPointsAreThoseOfNameAndSeed) {
  for (const auto& row : of_scans)
    expect_row(row, {scanned<float>(named(row.name)), scanned<double>(named(row.name))});
}

TEST(ArgumentFingerprints, TheOrderOfTheExhaustiveStratumIsFixed) {
  Fingerprint one_by_one;
  Fingerprint at_once;
  const Arguments<float> arguments(named("sin"), {Stratum::exhaustive, seed, exhaustive_count, nullptr});
  // The start, across the end of a block, and the end.
  for (const std::uint64_t first :
       {std::uint64_t{0}, (std::uint64_t{5} << 20U) - 24, exhaustive_count - 48}) {
    float x[48];
    arguments.make_all(first, 48, x);
    for (const float value : x) at_once.add(std::bit_cast<std::uint32_t>(value));
    for (std::uint64_t i = 0; i < 48; ++i) {
      arguments.make(first + i, x);
      one_by_one.add(std::bit_cast<std::uint32_t>(x[0]));
    }
  }
  EXPECT_EQ(literal(one_by_one.value()), "0xad30febae7fea1b5");
  EXPECT_EQ(literal(at_once.value()), literal(one_by_one.value()));
}

}  // namespace
}  // namespace ulpgate
