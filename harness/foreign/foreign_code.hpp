// ForeignCode: a function of a library as the code behind a subject.
#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "harness/foreign/foreign_call.hpp"
#include "kernels/math/function_table.hpp"

namespace ulpgate {

// Evaluates batches in worker processes, one a thread.  A batch is evaluated twice, the second time in
// another order and other lanes: a point whose bits differ is no function of its argument (`not_a_function`),
// or of its lane's neighbours as well (`lane_dependent`).  A crash, a hang and another floating-point
// environment are outcomes of their points; the rest of the batch is what it would be without them.
//
// What a batch gives depends on the batch alone, as far as the code lets it: one in which anything happened
// is evaluated again by a fresh process, and the next one by another.
class ForeignCode final : public BatchCode {
 public:
  // Starts a worker to see what it loads.  Throws ForeignFailure.
  ForeignCode(ForeignSpec spec, const ForeignShape& shape);

  void evaluate(const void* args, void* results, std::uint8_t* threw, std::size_t count) const override;
  double call(const void* args, void* results, std::size_t count, int rounds) const override;
  [[nodiscard]] std::size_t batch() const override;

  [[nodiscard]] const ForeignSpec& spec() const { return call_.spec(); }
  [[nodiscard]] const ForeignFacts& facts() const { return facts_; }
  // What was found while it ran that belongs to no point of a record, with the arguments as bytes: that
  // values differed once and not again in a fresh process.
  [[nodiscard]] std::vector<std::string> findings() const;

 private:
  void note(const std::string& finding) const;

  ForeignCall call_;
  ForeignFacts facts_;
  mutable std::mutex mutex_;
  mutable std::vector<std::string> findings_;
};

}  // namespace ulpgate
