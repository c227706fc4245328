// Fingerprints of kernel states: the same seed makes the same states, on every machine and for ever.
//
// A state is made of random words by exact rules and by operations that round correctly (IEEE 754 and MPFR),
// and no C library has a say in it.  A change of a number below changes every record, every budget and every
// reported state of a kernel: that is a decision, to be taken with the version in the plan's text, and never
// a repair of this test.
#include <gtest/gtest.h>

#include "harness/core/kernels/kernel_states.hpp"
#include "harness/core/testing/fingerprint.hpp"

namespace ulpgate {
namespace {

using testing::Fingerprint;
using testing::literal;

// In float, double and mpfr62.
struct Row {
  std::string_view name;
  std::uint64_t in_float;
  std::uint64_t in_double;
  std::uint64_t in_mpfr62;
};

// Those of the kernel's states in one stratum; few in the slow type.
template <RealType Real>
std::uint64_t states(const dem::KernelInfo& kernel, Stratum stratum) {
  constexpr std::uint64_t count = NativeReal<Real> ? 48 : 6;
  const States<Real> states(kernel, {stratum, 7, count, nullptr});
  std::vector<Real> values(kernel.input_components());
  Fingerprint print;
  for (std::uint64_t k = 0; k < count; ++k) {
    states.make(k, values.data());
    for (const Real& x : values) print.add_value(x);
  }
  return print.value();
}

// Every kernel in every stratum counts in two sums: which row and which column differ tells which states do.
template <RealType Real>
struct Prints {
  Prints() : by_kernel(dem::all_kernels().size()), by_stratum(kernel_strata.size()) {
    for (std::size_t i = 0; i < by_kernel.size(); ++i) {
      for (std::size_t j = 0; j < by_stratum.size(); ++j) {
        const std::uint64_t print = states<Real>(dem::all_kernels()[i], kernel_strata[j].id);
        by_kernel[i].add(print);
        by_stratum[j].add(print);
      }
    }
  }
  std::vector<Fingerprint> by_kernel;
  std::vector<Fingerprint> by_stratum;
};

template <RealType Real>
const Prints<Real>& prints() {
  static const Prints<Real> all;
  return all;
}

void expect_row(const Row& row, std::uint64_t in_float, std::uint64_t in_double, std::uint64_t in_mpfr62) {
  EXPECT_TRUE(row.in_float == in_float && row.in_double == in_double && row.in_mpfr62 == in_mpfr62)
      << "now {\"" << row.name << "\", " << literal(in_float) << ", " << literal(in_double) << ", "
      << literal(in_mpfr62) << "},";
}

constexpr Row of_kernels[] = {
    {"sphere_sphere", 0x2aa9a7857e2a7a17, 0xfcbb607166434581, 0x2f4b164ef2457c46},
    {"facet_sphere", 0xd04cf84b4ae58d2e, 0xb7e47dd6c1827da2, 0x65237cc0aada6595},
    {"wall_sphere", 0x6407fd2f76938cc0, 0x4608f386a693792e, 0x6ffafda1fd256dda},
    {"box_sphere", 0x77307e5ff5003bbc, 0x5613801f59527d4d, 0xbf40928bdd14eb6a},
    {"sphere_bounds", 0xf4c4db385f498c01, 0x1b0f98b8ce20d260, 0xa0b8a73f1dbec2e8},
    {"facet_bounds", 0x9b83bd245bc15c90, 0x88517aefa2bfe8af, 0x06ee6dd885f0d916},
    {"sphere_relative_velocity", 0xdec31fb4abc4044c, 0x2035cb16796c34f4, 0x4e81e7f95eb98ab8},
    {"point_relative_velocity", 0x815ae831a0b20510, 0xe34af26d5a8bdbd4, 0xf5b0636c23db3c73},
    {"rotate_shear", 0x7a3f432184306625, 0x8e59c429dd2bde3d, 0x618aa84d500af7a9},
    {"twist_and_bending", 0x4e8d69dc27d1b265, 0xd9a7b1b4aaa030d4, 0x791ef56b8c8db6d7},
    {"frictional_physics", 0xbc1625c103f206b5, 0x72b4a269c48ee4b2, 0x6fff214fc30379a1},
    {"viscoelastic_physics", 0x5a5cb09f57a12c1d, 0x26156e0a72007e25, 0x71548cf2f9e7b4c6},
    {"hertz_mindlin_physics", 0xe96c51cb903ca5bf, 0x64c3cf489178dd88, 0x532bffbb1563b334},
    {"cundall_strack", 0x82d04ad6a971762b, 0x9def98c6cfd3b1e7, 0x14bfa9f9d683805b},
    {"viscoelastic", 0x778648dcea0df68b, 0x0a45bb00abeaf42e, 0x420d4b636261e621},
    {"hertz_mindlin", 0x12c3b6f038a82121, 0x310266e4643c4075, 0x14c66201aacfd61c},
    {"cohesive", 0x07cbf4fb849d81f4, 0x98fe9d26dc1bb64e, 0xf0be6c5a6b4bf21e},
    {"cut_to_cone", 0x87c070d30ee9d2f4, 0x3590680613da3fe2, 0xe53c826fd8fec656},
    {"bond_moment", 0x08f7858d97ade8bf, 0xf0f43b178a3436a2, 0x9a2108547b814dd8},
    {"shear_torque", 0x74e15560dddeb204, 0x15cd41891028c719, 0xae7228f546e5a25d},
    {"sphere_contact_step", 0x158b7d74d1142549, 0x560600f951c24619, 0xdef4a6f9f198257c},
    {"translation", 0x443c931659ce816b, 0x05fa623dcbbebb7b, 0xcb6dddc6451daa17},
    {"rotation", 0x598aacf00fa00d65, 0x7a8309114240ac05, 0x1bc5072160538db4},
    {"aspherical_rotation", 0x8dc9ddad56aaa30d, 0x5df120b150b06cbb, 0x328dfb86fabc5959},
    {"sphere_inertia", 0x31aeeedc644d02b4, 0x6489ba192b3f5b32, 0x6f4860ebeb4453a5},
    {"critical_steps", 0xb4283e7063985ddf, 0x0e4884aceaef9c77, 0xdd8db770cacda401},
    {"stiffness_step", 0x09a3fd4e124c50aa, 0x4e17a82f71a6fe4b, 0x0234c4a8104d4a9d},
    {"body_energy", 0xea6aa12c11adc604, 0x6de6653942f39ea3, 0x43cfcd080cad0c08},
    {"contact_energy", 0x651c60b5ded30bc5, 0x029fef6994563f41, 0x0c882338eff3c42f},
};

constexpr Row of_strata[] = {
    {"uniform", 0x80379e1d56c8e608, 0xb28b167eea35f3de, 0x29034bf5c0d828eb},
    {"stratified", 0x4a7aba808d53be6d, 0xdef70165de9f3236, 0x61419ac3449ab9bf},
    {"typical", 0xb31243613b732c3b, 0x26a4890a1fd8c3c6, 0xbb9ef92bae21b6fd},
    {"grazing", 0xb5b04a98bd28a42c, 0xdc58964f647cb35e, 0xa8539b60fa108016},
    {"touching", 0x7bc56401a0c13efa, 0x75da348e4d135697, 0x37c73511a02579ec},
    {"deep", 0xabb5d803705753a0, 0x879e3e3e8c188103, 0x6950a9dcfe8e7acc},
    {"ratio", 0x35ac2b42f54d4fd4, 0x3e44478911c10800, 0xb3e9d9364c0603a4},
    {"far", 0x48234ca84856d9cd, 0xb0fd27de9a084d57, 0xcc3c69d26bffa223},
    {"slow", 0xcf3a8c8c2de4e48c, 0xba4caf54149452bf, 0x55512777879ce013},
    {"parallel", 0xe3ba1eed3aeca096, 0x332c9bc05a2a7b09, 0xa54ccf923725363b},
    {"cone", 0x6a6d217ec462cd2c, 0x0eb229c37c8d926f, 0x017cfc5de2ff994c},
};

TEST(KernelFingerprints, EveryKernelsStatesAreThoseOfItsNameAndSeed) {
  const auto kernels = dem::all_kernels();
  ASSERT_EQ(std::size(of_kernels), kernels.size()) << "a new kernel gets a row";
  for (std::size_t i = 0; i < kernels.size(); ++i) {
    ASSERT_EQ(of_kernels[i].name, kernels[i].name);
    expect_row(of_kernels[i], prints<float>().by_kernel[i].value(), prints<double>().by_kernel[i].value(),
               prints<MpfrReal<62>>().by_kernel[i].value());
  }
}

TEST(KernelFingerprints, EveryStratumsStatesAreThoseOfItsNameAndSeed) {
  ASSERT_EQ(std::size(of_strata), kernel_strata.size()) << "a new stratum gets a row";
  for (std::size_t j = 0; j < kernel_strata.size(); ++j) {
    ASSERT_EQ(of_strata[j].name, kernel_strata[j].name);
    expect_row(of_strata[j], prints<float>().by_stratum[j].value(), prints<double>().by_stratum[j].value(),
               prints<MpfrReal<62>>().by_stratum[j].value());
  }
}

}  // namespace
}  // namespace ulpgate
