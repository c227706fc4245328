// RowRecord: finishing and merging.
#include "harness/core/records/row_record.hpp"

namespace ulpgate {

std::vector<RowRecord> finish_row(const Plan& plan, const PlanRow& row,
                                  const std::vector<Summary>& summaries) {
  std::vector<RowRecord> records;
  const auto at = [&](std::uint64_t k) { return row.engine->point(row.function, row.source, k); };
  for (std::size_t part = 0; part < summaries.size(); ++part) {
    const Summary& s = summaries[part];
    RowRecord r;
    r.function = row.function.name;
    r.part = part_name(row.function, static_cast<int>(part));
    r.type = row.engine->descriptor().token;
    r.function_class = name_of(row.function.function_class);
    r.stratum = name_of(row.source.stratum);
    r.planned = row.source.count;
    r.seed = row.source.seed;
    r.reference = "full";
    r.reference_bits = row.engine->descriptor().reference_bits;
    r.plan = plan.hash();
    r.summary = s;
    if (s.max_error.index != no_index) {
      const Point p = at(s.max_error.index);
      r.points.argmax = p.args_hex;
      r.points.got = p.parts[part].got_hex;
      r.points.exact = p.parts[part].exact_decimal;
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

void merge_record(RowRecord& into, const RowRecord& other) {
  const Summary before = into.summary;
  into.summary.merge(other.summary);
  if (into.summary.max_error.index != before.max_error.index) {
    into.points.argmax = other.points.argmax;
    into.points.got = other.points.got;
    into.points.exact = other.points.exact;
  }
  for (std::size_t o = 1; o < outcome_count; ++o) {
    if (into.summary.first_index[o] != before.first_index[o]) {
      into.points.first_mismatch[static_cast<Outcome>(o)] =
          other.points.first_mismatch.at(static_cast<Outcome>(o));
    }
  }
  if (into.summary.normwise.index != before.normwise.index) {
    into.points.normwise_argmax = other.points.normwise_argmax;
    into.points.condition = other.points.condition;
  }
  if (into.summary.oracle.difference.index != before.oracle.difference.index) {
    into.points.oracle_argmax = other.points.oracle_argmax;
  }
}

}  // namespace ulpgate
