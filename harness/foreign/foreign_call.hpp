// ForeignCall: what is called and how, and the worker that each thread has for it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "harness/foreign/foreign_spec.hpp"
#include "harness/foreign/worker_process.hpp"
#include "harness/worker/worker_signature.h"

namespace ulpgate {

// Of which function and type it is asked.
struct ForeignShape {
  char element = 'd';  // f d l q
  int arity = 1;
  int result = 0;  // which of the two, where a call gives a pair
};

// Bytes of a number of an element, and those of them that hold its value.
[[nodiscard]] std::size_t size_of(char element);
[[nodiscard]] std::size_t value_bytes(char element);

class ForeignCall {
 public:
  // Throws ForeignFailure where signature and shape do not fit.
  ForeignCall(ForeignSpec spec, const ForeignShape& shape);

  [[nodiscard]] const ForeignSpec& spec() const { return spec_; }
  [[nodiscard]] const ForeignShape& shape() const { return shape_; }
  [[nodiscard]] const ulpgate_signature& signature() const { return signature_; }
  [[nodiscard]] std::size_t size() const { return size_of(shape_.element); }
  [[nodiscard]] std::size_t arity() const { return static_cast<std::size_t>(shape_.arity); }
  [[nodiscard]] std::size_t lanes() const { return static_cast<std::size_t>(signature_.lanes); }
  // Where a worker puts the result of a point, and how far from there that of the next is.
  [[nodiscard]] const unsigned char* result(const ulpgate_channel& c, std::size_t slot) const {
    const auto which = ulpgate_results_of(&signature_) == 1 ? 0 : static_cast<std::size_t>(shape_.result);
    return c.results + slot * stride() + which * size();
  }
  [[nodiscard]] std::size_t stride() const {
    return static_cast<std::size_t>(ulpgate_results_of(&signature_)) * size();
  }

  // The worker of this thread, which keeps the few that it used last; started where there is none.
  [[nodiscard]] WorkerProcess& worker() const;
  // Ends it: the next is a fresh one.
  void drop_worker() const;

 private:
  ForeignSpec spec_;
  ForeignShape shape_;
  std::string program_;
  ulpgate_signature signature_{};
  std::uint64_t id_;
};

}  // namespace ulpgate
