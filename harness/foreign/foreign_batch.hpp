// ForeignBatch: a batch of points in the hands of its thread, called in every way that tells what it is.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "harness/foreign/foreign_call.hpp"
#include "reference/ulp/ulp.hpp"

namespace ulpgate {

class ForeignBatch {
 public:
  // `args` and `values` outlive it: `count` points of the call's arity and element, and room for their
  // values.
  ForeignBatch(const ForeignCall& call, const unsigned char* args, unsigned char* values, std::size_t count)
      : call_(call), args_(args), values_(values), troubles_(count) {}

  // Whether every point has a value, the same every time.  Throws ForeignHangs.
  [[nodiscard]] bool run();

  // Of each point 0, or which outcome from `exception` on, counted from 1.
  [[nodiscard]] const std::vector<std::uint8_t>& troubles() const { return troubles_; }

 private:
  using Points = std::span<const std::uint32_t>;
  // Is given points that have a value: that of the first, and the bytes from one to the next.
  using Take = std::function<void(Points, const unsigned char* from, std::size_t stride)>;

  [[nodiscard]] bool same(const unsigned char* a, const unsigned char* b) const;
  void put_arguments(ulpgate_channel& c, std::size_t slot, std::uint32_t i) const;
  void put_all_arguments(ulpgate_channel& c, Points points) const;
  void give_trouble(std::uint32_t i, Outcome o);
  // Of the points in this order.
  void evaluate_all(Points points, const Take& take);
  void evaluate(Points points, const Take& take, ulpgate_worker_mode mode);
  void take_answers(Points points, const WorkerProcess& worker, const Take& take);
  // A vector that ended its process: each of its points alone.
  void settle_group(Points group, const Take& take, Outcome outcome);
  // A point, or one of the lanes beside it, changed the environment.
  void settle_environment(std::uint32_t i, const Take& take);
  // Some points beside neighbours that vector code likes least.
  void look_at_lanes(Points order, std::vector<std::uint32_t>& differing);
  // The same batch in the same order and company: where that gives other bits it is no function, else its
  // lanes matter.
  void explain(const std::vector<std::uint32_t>& differing);

  const ForeignCall& call_;
  const unsigned char* args_;
  unsigned char* values_;
  std::vector<std::uint8_t> troubles_;
  int hangs_ = 0;
};

}  // namespace ulpgate
