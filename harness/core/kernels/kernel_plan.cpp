// KernelPlan: rows, units, hash and records.
#include "harness/core/kernels/kernel_plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "harness/core/arguments/random_words.hpp"

namespace ulpgate {

namespace {

std::string plan_text(const KernelPlanRequest& r) {
  std::vector<std::string_view> kernels;
  std::vector<std::string_view> strata;
  for (const auto id : r.kernels) kernels.push_back(dem::info_of(id).name);
  for (const auto s : r.strata) strata.push_back(name_of(s));
  // Versions of the rules that make states and that record errors: raise them when they change.
  return fmt::format(
      "ulpgate kernel plan\nstates 1\nerrors 3\nunit {}\nseed {}\nsamples {}\ntypes {}\nstrata {}\nkernels "
      "{}\n"
      "reference full\n",
      unit_size, r.seed, r.samples, fmt::join(r.types, ","), fmt::join(strata, ","), fmt::join(kernels, ","));
}

}  // namespace

KernelPlan::KernelPlan(KernelPlanRequest request) : request_(std::move(request)) {
  for (const auto& token : request_.types) {
    for (const auto id : request_.kernels) {
      for (const auto s : request_.strata) {
        rows_.push_back({find_kernel_engine(token), &dem::info_of(id), {s, request_.seed, request_.samples}});
      }
    }
  }
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    for (std::uint64_t k = 0; k < request_.samples; k += unit_size) {
      units_.push_back({row, k, std::min(k + unit_size, request_.samples)});
    }
  }
  text_ = plan_text(request_);
  hash_ = fmt::format("{:016x}", fnv1a(text_));
}

std::vector<RowRecord> finish_kernel_row(const KernelPlan& plan, const KernelRow& row,
                                         const std::vector<Summary>& summaries) {
  std::vector<RowRecord> records;
  const auto at = [&](std::uint64_t k) { return row.engine->point(*row.kernel, row.source, k); };
  for (std::size_t q = 0; q < summaries.size(); ++q) {
    const Summary& s = summaries[q];
    RowRecord r;
    r.function = row.kernel->name;
    r.part = row.kernel->outputs[q].name;
    r.type = row.engine->descriptor().token;
    r.function_class = kernel_class;
    r.stratum = name_of(row.source.stratum);
    r.planned = row.source.count;
    r.seed = row.source.seed;
    r.reference = "full";
    r.reference_bits = row.engine->descriptor().reference_bits;
    r.plan = plan.hash();
    r.summary = s;
    if (s.max_error.index != no_index) {
      const KernelPoint p = at(s.max_error.index);
      r.points.argmax = p.inputs_hex;
      r.points.got = fmt::format("{}", fmt::join(p.quantities[q].got_hex, " "));
      r.points.exact = fmt::format("{}", fmt::join(p.quantities[q].exact_decimal, " "));
    }
    if (s.normwise.index != no_index) {
      const KernelPoint p = at(s.normwise.index);
      r.points.normwise_argmax = p.inputs_hex;
      r.points.condition = p.quantities[q].condition;
    }
    for (std::size_t o = 1; o < outcome_count; ++o) {
      if (s.outcomes[o] > 0)
        r.points.first_mismatch[static_cast<Outcome>(o)] = at(s.first_index[o]).inputs_hex;
    }
    records.push_back(std::move(r));
  }
  return records;
}

}  // namespace ulpgate
