// CallsInHand<Real>: a batch of a function as the work of its thread.
#pragma once

#include <string>
#include <vector>

#include "harness/core/watch/heartbeat.hpp"
#include "kernels/math/function_table.hpp"
#include "reference/functions/function_info.hpp"
#include "reference/text/text.hpp"

namespace ulpgate {

// `args` may be filled again and again; the heartbeat's beat of a batch says how many of its points count.
template <RealType Real>
class CallsInHand final : public WorkInHand {
 public:
  CallsInHand(const FunctionInfo& f, BatchFunction<Real> call, const std::vector<Real>& args)
      : function_(f), call_(call), args_(args) {}

  [[nodiscard]] std::size_t count() const override { return args_.size() / arity(); }
  [[nodiscard]] std::string arguments(std::size_t i) const override {
    std::string text;
    for (std::size_t j = 0; j < arity(); ++j)
      text += (j == 0 ? "" : " ") + to_hexfloat(args_[i * arity() + j]);
    return text;
  }
  void repeat(std::size_t i) const override {
    std::vector<Real> results(static_cast<std::size_t>(function_.parts));
    std::uint8_t threw = 0;
    call_(&args_[i * arity()], results.data(), &threw, 1);
  }

 private:
  [[nodiscard]] std::size_t arity() const { return static_cast<std::size_t>(function_.arity); }

  const FunctionInfo& function_;
  BatchFunction<Real> call_;
  const std::vector<Real>& args_;
};

}  // namespace ulpgate
