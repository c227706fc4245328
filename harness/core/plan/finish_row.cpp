// The records of a finished row.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/core/plan/plan.hpp"

namespace ulpgate {

std::vector<RowRecord> finish_row(const Plan& plan, const PlanRow& row,
                                  const std::vector<Summary>& summaries) {
  const SubjectInfo& subject = row.subject->info();
  const auto at = [&](std::uint64_t k) { return row.subject->point(row.source, k); };
  std::vector<RowRecord> records;
  for (std::size_t part = 0; part < summaries.size(); ++part) {
    const Summary& s = summaries[part];
    RowRecord r;
    r.subject = subject.name;
    r.part = subject.parts[part].name;
    r.type = row.subject->type().token;
    r.subject_class = subject.subject_class;
    r.implementation = subject.implementation;
    r.stratum = name_of(row.source.stratum);
    r.planned = row.source.count;
    r.seed = row.source.seed;
    r.reference = "full";
    r.reference_bits = row.subject->type().reference_bits;
    r.plan = plan.hash();
    r.summary = s;
    if (s.max_error.index != no_index) {
      const Point p = at(s.max_error.index);
      r.points.argmax = p.args_hex;
      r.points.got = fmt::format("{}", fmt::join(p.parts[part].got_hex, " "));
      r.points.exact = fmt::format("{}", fmt::join(p.parts[part].exact_decimal, " "));
    }
    if (s.normwise.index != no_index) {
      const Point p = at(s.normwise.index);
      r.points.normwise_argmax = p.args_hex;
      r.points.condition = p.parts[part].condition;
    }
    for (std::size_t o = 1; o < outcome_count; ++o) {
      if (s.outcomes[o] > 0) r.points.first_mismatch[static_cast<Outcome>(o)] = at(s.first_index[o]).args_hex;
    }
    if (s.oracle.difference.index != no_index)
      r.points.oracle_argmax = at(s.oracle.difference.index).args_hex;
    records.push_back(std::move(r));
  }
  return records;
}

}  // namespace ulpgate
