// Tests of the kernel job: coverage, verdicts, planted defects and literals, units that merge.
#include "harness/core/kernels/kernel_subject.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "harness/core/kernels/kernel_audit.hpp"
#include "harness/core/records/row_record.hpp"
#include "kernels/dem/table/kernel_table_impl.hpp"

namespace ulpgate {
namespace {

using dem::KernelId;

Summary run(const Subject& subject, std::size_t quantity, Stratum stratum, std::uint64_t count) {
  RowHint hint(subject.info().parts.size());
  return subject.evaluate({stratum, 1, count, nullptr}, 0, count, ReferenceMode::full, hint)[quantity];
}

KernelSubject<double> subject_with(KernelId id, dem::BatchKernel<double> replacement) {
  return {*find_type("double"), dem::info_of(id), replacement,
          dem::kernel_table<RealHP<4, double>>()[static_cast<std::size_t>(id)]};
}

TEST(KernelJob, EveryKernelRunsInEveryTypeAndStratum) {
  std::size_t kernels = 0;
  for (const auto& subject : all_subjects()) {
    if (subject->info().kind != SubjectKind::kernel) continue;
    ++kernels;
    for (const auto& stratum : kernel_strata) {
      RowHint hint(subject->info().parts.size());
      const auto summaries = subject->evaluate({stratum.id, 1, 2, nullptr}, 0, 2, ReferenceMode::full, hint);
      ASSERT_EQ(summaries.size(), subject->info().parts.size());
      for (const auto& s : summaries) {
        EXPECT_EQ(s.samples, 2U) << subject->name();
        EXPECT_EQ(s.outcomes[static_cast<std::size_t>(Outcome::exception)], 0U) << subject->name();
        EXPECT_EQ(s.outcomes[static_cast<std::size_t>(Outcome::nan)], 0U)
            << subject->name() << " " << subject->type().token << " " << stratum.name;
      }
    }
  }
  EXPECT_EQ(kernels, dem::all_kernels().size() * all_types().size());
}

TEST(KernelJob, ACancellingOverlapIsIllConditionedNotUnstable) {
  const Summary s = run(*find_subject("sphere_sphere", "double"), 0, Stratum::touching, 200);
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
  const auto wrong = subject_with(KernelId::sphere_sphere, wrong_normal);
  EXPECT_FALSE(is_stable(run(wrong, 1, Stratum::typical, 20)));
  EXPECT_TRUE(is_stable(run(wrong, 0, Stratum::typical, 20)));
}

void nan_at_contact(const double* in, double* out, std::uint8_t* threw, std::size_t count) {
  dem::kernel_table<double>()[static_cast<std::size_t>(KernelId::shear_torque)](in, out, threw, count);
  out[0] = NAN;
}

TEST(KernelJob, ANaNIsAMismatch) {
  const auto wrong = subject_with(KernelId::shear_torque, nan_at_contact);
  EXPECT_EQ(run(wrong, 0, Stratum::typical, 5).outcomes[static_cast<std::size_t>(Outcome::nan)], 5U);
}

TEST(KernelJob, UnitsMergeToTheWhole) {
  const Subject& subject = *find_subject("cundall_strack", "double");
  const StratumSource source{Stratum::stratified, 3, 60, nullptr};
  RowHint hint(3);
  RowHint other(3);
  const auto whole = subject.evaluate(source, 0, 60, ReferenceMode::full, hint);
  auto first = subject.evaluate(source, 0, 17, ReferenceMode::full, other);
  const auto rest = subject.evaluate(source, 17, 60, ReferenceMode::full, other);
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
  const Subject& subject = *find_subject("rotation", "double");
  const StratumSource source{Stratum::uniform, 1, 50, nullptr};
  RowHint hint(2);
  const auto s = subject.evaluate(source, 0, 50, ReferenceMode::full, hint)[1];
  const auto p = subject.point(source, s.normwise.index);
  std::vector<MpfrValue> inputs;
  for (const auto& hex : p.args_hex) {
    inputs.emplace_back(53);
    ASSERT_EQ(mpfr_set_str(inputs.back(), hex.c_str(), 0, MPFR_RNDN), 0);
  }
  EXPECT_EQ(subject.point(inputs).parts[1].normwise_error, p.parts[1].normwise_error);
  EXPECT_NEAR(*p.parts[1].normwise_error, s.normwise.value, 1e-9);
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
