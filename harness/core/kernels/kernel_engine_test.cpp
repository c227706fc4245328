// Tests of the kernel job: coverage, verdicts, planted defects and literals, units that merge.
#include <gtest/gtest.h>

#include <cmath>

#include "harness/core/kernels/kernel_audit.hpp"
#include "harness/core/kernels/kernel_engine_impl.hpp"
#include "harness/core/kernels/kernel_plan.hpp"
#include "kernels/dem/table/kernel_table_impl.hpp"

namespace ulpgate {
namespace {

using dem::KernelId;

Summary run(const KernelEngine& engine, KernelId id, std::size_t quantity, StateStratum stratum,
            std::uint64_t count) {
  const auto& kernel = dem::info_of(id);
  RowHint hint(static_cast<int>(kernel.outputs.size()));
  return engine.evaluate(kernel, {stratum, 1, count}, 0, count, hint)[quantity];
}

KernelEngineOf<double> engine_with(KernelId id, dem::BatchKernel<double> replacement) {
  auto table = dem::kernel_table<double>();
  table[static_cast<std::size_t>(id)] = replacement;
  return {describe<double>("double", "double"), std::move(table), dem::kernel_table<RealHP<4, double>>()};
}

TEST(KernelJob, EveryKernelRunsInEveryTypeAndStratum) {
  for (const auto& engine : all_kernel_engines()) {
    for (const auto& kernel : dem::all_kernels()) {
      for (const auto& stratum : all_state_strata) {
        RowHint hint(static_cast<int>(kernel.outputs.size()));
        const auto summaries = engine->evaluate(kernel, {stratum.id, 1, 2}, 0, 2, hint);
        ASSERT_EQ(summaries.size(), kernel.outputs.size());
        for (const auto& s : summaries) {
          EXPECT_EQ(s.samples, 2U) << kernel.name;
          EXPECT_EQ(s.outcomes[static_cast<std::size_t>(Outcome::exception)], 0U) << kernel.name;
          EXPECT_EQ(s.outcomes[static_cast<std::size_t>(Outcome::nan)], 0U)
              << kernel.name << " " << engine->descriptor().token << " " << stratum.name;
        }
      }
    }
  }
}

TEST(KernelJob, ACancellingOverlapIsIllConditionedNotUnstable) {
  const Summary s =
      run(*find_kernel_engine("double"), KernelId::sphere_sphere, 0, StateStratum::touching, 200);
  EXPECT_GT(s.max_error.value, 1e6);
  EXPECT_GT(s.normwise.value, 1e6);
  EXPECT_TRUE(is_stable(s)) << s.max_error_over_condition;
}

// A copy of a kernel whose first component of the normal is off by 1e-12: wrong beyond any condition.
void wrong_normal(const double* in, double* out, std::uint8_t* threw, std::size_t count) {
  dem::kernel_table<double>()[static_cast<std::size_t>(KernelId::sphere_sphere)](in, out, threw, count);
  for (std::size_t i = 0; i < count; ++i) out[7 * i + 1] *= 1 + 1e-12;
}

TEST(KernelJob, AFlippedDigitInACopiedKernelIsUnstable) {
  const auto wrong = engine_with(KernelId::sphere_sphere, wrong_normal);
  EXPECT_FALSE(is_stable(run(wrong, KernelId::sphere_sphere, 1, StateStratum::typical, 20)));
  EXPECT_TRUE(is_stable(run(wrong, KernelId::sphere_sphere, 0, StateStratum::typical, 20)));
}

void nan_at_contact(const double* in, double* out, std::uint8_t* threw, std::size_t count) {
  dem::kernel_table<double>()[static_cast<std::size_t>(KernelId::shear_torque)](in, out, threw, count);
  out[0] = NAN;
}

TEST(KernelJob, ANaNIsAMismatch) {
  const auto wrong = engine_with(KernelId::shear_torque, nan_at_contact);
  EXPECT_EQ(run(wrong, KernelId::shear_torque, 0, StateStratum::typical, 5)
                .outcomes[static_cast<std::size_t>(Outcome::nan)],
            5U);
}

TEST(KernelJob, UnitsMergeToTheWhole) {
  const auto& engine = *find_kernel_engine("double");
  const auto& kernel = dem::info_of(KernelId::cundall_strack);
  const StateSource source{StateStratum::stratified, 3, 60};
  RowHint hint(3);
  RowHint other(3);
  const auto whole = engine.evaluate(kernel, source, 0, 60, hint);
  auto first = engine.evaluate(kernel, source, 0, 17, other);
  const auto rest = engine.evaluate(kernel, source, 17, 60, other);
  for (std::size_t q = 0; q < whole.size(); ++q) {
    first[q].merge(rest[q]);
    EXPECT_EQ(first[q].max_error.value, whole[q].max_error.value);
    EXPECT_EQ(first[q].max_error.index, whole[q].max_error.index);
    EXPECT_EQ(first[q].normwise.index, whole[q].normwise.index);
    EXPECT_EQ(first[q].max_error_over_condition, whole[q].max_error_over_condition);
    EXPECT_EQ(first[q].histogram.counts, whole[q].histogram.counts);
  }
}

TEST(KernelJob, APointReproducesItsRecord) {
  const auto& engine = *find_kernel_engine("double");
  const auto& kernel = dem::info_of(KernelId::rotation);
  const StateSource source{StateStratum::uniform, 1, 50};
  RowHint hint(2);
  const auto s = engine.evaluate(kernel, source, 0, 50, hint)[1];
  const auto p = engine.point(kernel, source, s.normwise.index);
  std::vector<MpfrValue> inputs;
  for (const auto& hex : p.inputs_hex) {
    inputs.emplace_back(53);
    ASSERT_EQ(mpfr_set_str(inputs.back(), hex.c_str(), 0, MPFR_RNDN), 0);
  }
  EXPECT_EQ(engine.point(kernel, inputs).quantities[1].normwise_error, p.quantities[1].normwise_error);
  EXPECT_NEAR(p.quantities[1].normwise_error, s.normwise.value, 1e-9);
}

TEST(Audit, NoKernelHoldsADouble) {
  for (const auto& hidden : audit_kernels(audited_kernel_table(), 4))
    ADD_FAILURE() << hidden.kernel << " holds the double " << hidden.literal;
}

// A copy of a kernel with the literal 0.4 where 2/5 belongs.
void with_a_literal(const AuditedReal* in, AuditedReal* out, std::uint8_t*, std::size_t) {
  const AuditedReal mass = dem::sphere_mass(in[0], in[1]);
  out[0] = mass;
  out[1] = 0.4 * mass * in[0] * in[0];
}

TEST(Audit, APlantedLiteralIsFoundAndTheKernelNamed) {
  auto table = audited_kernel_table();
  table[static_cast<std::size_t>(KernelId::sphere_inertia)] = with_a_literal;
  const auto found = audit_kernels(table, 1);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].kernel, "sphere_inertia");
  EXPECT_EQ(found[0].literal, 0.4);
}

}  // namespace
}  // namespace ulpgate
