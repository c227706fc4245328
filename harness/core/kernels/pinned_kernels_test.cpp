// Tests that every kernel gives in every stratum what it has given: one number each, pinned.  A change of a
// law, of a geometry or of the states changes all records and budgets: a decision, after which
//   ULPGATE_PRINT_PINS=1 core_test --gtest_filter=PinnedKernels.*
// prints the numbers anew.  What is right about them is for closed forms and conservation laws to say; these
// see that nothing changed.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "harness/core/kernels/kernel_states.hpp"
#include "kernels/dem/table/kernel_table.hpp"

namespace ulpgate {
namespace {

struct Pin {
  const char* kernel;
  const char* stratum;
  double sum;   // of all outputs of all states, each with a weight
  double size;  // the same of their absolute values
};
constexpr Pin pins[] = {
#include "harness/core/kernels/pinned_kernels.inc"
};

constexpr std::size_t states_each = 24;

Pin measured(const dem::KernelInfo& kernel, const char* stratum, const States<double>& states) {
  std::vector<double> in(states_each * kernel.input_components());
  std::vector<double> out(states_each * kernel.output_components());
  std::vector<std::uint8_t> threw(states_each);
  for (std::size_t k = 0; k < states_each; ++k) states.make(k, in.data() + k * kernel.input_components());
  dem::kernel_table<double>()[static_cast<std::size_t>(kernel.id)](in.data(), out.data(), threw.data(),
                                                                   states_each);
  Pin pin{kernel.name.data(), stratum, 0, 0};
  for (std::size_t state = 0; state < states_each; ++state) {
    // No state's size drowns another's.
    const auto* first = out.data() + state * kernel.output_components();
    double largest = 0;
    for (std::size_t c = 0; c < kernel.output_components(); ++c) {
      if (std::isfinite(first[c])) largest = std::max(largest, std::fabs(first[c]));
    }
    for (std::size_t c = 0; c < kernel.output_components(); ++c) {
      const double weight = static_cast<double>((7 * state + 3 * c) % 11 + 1);
      const double x = std::isfinite(first[c]) ? first[c] / (largest > 0 ? largest : 1) : 2.5;
      pin.sum += weight * (x + (largest > 0 ? 0.01 * std::log2(largest) : 0));
      pin.size += weight * std::fabs(x);
    }
  }
  return pin;
}

TEST(PinnedKernels, GiveWhatTheyHaveGiven) {
  const bool print = std::getenv("ULPGATE_PRINT_PINS") != nullptr;
  std::size_t next = 0;
  for (const auto& kernel : dem::all_kernels()) {
    for (const auto& stratum : kernel_strata) {
      const States<double> states(kernel, {stratum.id, 1, states_each, nullptr});
      const Pin pin = measured(kernel, stratum.name.data(), states);
      if (print) {
        std::printf("{\"%s\", \"%s\", %.13g, %.13g},\n", pin.kernel, pin.stratum, pin.sum, pin.size);
        continue;
      }
      ASSERT_LT(next, std::size(pins)) << kernel.name << ' ' << stratum.name << " is pinned nowhere";
      const Pin& pinned = pins[next++];
      ASSERT_EQ(std::string(pinned.kernel) + ' ' + pinned.stratum,
                std::string(pin.kernel) + ' ' + pin.stratum);
      EXPECT_NEAR(pin.sum, pinned.sum, 1e-9 * pinned.size) << pin.kernel << ' ' << pin.stratum;
      EXPECT_NEAR(pin.size, pinned.size, 1e-9 * pinned.size) << pin.kernel << ' ' << pin.stratum;
    }
  }
  if (!print) {
    EXPECT_EQ(next, std::size(pins));
  }
}

}  // namespace
}  // namespace ulpgate
