// RowRecord: the finished figures of one part of one row, as they stand in math.jsonl and as the gate reads
// them.
#pragma once

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "harness/core/arguments/strata.hpp"
#include "harness/core/records/summary.hpp"

namespace ulpgate {

// Texts of the points that a summary names by index.
struct RowPoints {
  std::vector<std::string> argmax;
  std::string got;
  std::string exact;
  std::map<Outcome, std::vector<std::string>> first_mismatch;
  std::vector<std::string> oracle_argmax;
  // Of a kernel's quantity: the state of the largest normwise error, and the condition number there.
  std::vector<std::string> normwise_argmax;
  double condition = 0;
};

// The class of kernel rows, beside the classes of functions.
inline constexpr std::string_view kernel_class = "kernel";

// A kernel is called unstable where its normwise error exceeds this many times condition number and unit
// roundoff: more roundings than a backward stable evaluation of a few dozen operations accumulates.
inline constexpr double stability_limit = 16;
[[nodiscard]] inline bool is_stable(const Summary& s) {
  return !(s.max_error_over_condition > stability_limit);
}

struct RowRecord {
  std::string subject;  // name of the function or kernel
  std::string part;
  std::string type;
  std::string subject_class;
  std::string implementation;  // the code that was measured, with its version
  std::string stratum;
  std::uint64_t planned = 0;
  std::uint64_t seed = 0;
  std::string reference;
  long reference_bits = 0;
  std::string plan;
  Summary summary;
  RowPoints points;
  // Words that select the code on a command line; empty where it is built in.
  std::string selection = {};

  // Sort key of the records file.
  [[nodiscard]] auto key() const { return std::tie(subject, part, type, stratum, implementation); }
};

// Whether every value of the type was an argument: the largest error is then proven for this libm.
[[nodiscard]] inline bool is_proof(const RowRecord& r) {
  return r.stratum == name_of(Stratum::exhaustive) && r.summary.samples == exhaustive_count;
}

// Adds `other`, a record of the same row from another shard.
void merge_record(RowRecord& into, const RowRecord& other);

}  // namespace ulpgate
