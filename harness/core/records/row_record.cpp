// RowRecord: merging.
#include "harness/core/records/row_record.hpp"

namespace ulpgate {

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
