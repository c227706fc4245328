// Definition of kernel_table<Real>(); included only by the one translation unit of each type, and by tests
// that plant defects.
#pragma once

#include "kernels/dem/formulas/contact_laws.hpp"
#include "kernels/dem/formulas/critical_step.hpp"
#include "kernels/dem/formulas/energy.hpp"
#include "kernels/dem/formulas/newton.hpp"
#include "kernels/dem/formulas/sphere_body.hpp"
#include "kernels/dem/step/bounds.hpp"
#include "kernels/dem/table/kernel_table.hpp"

namespace ulpgate::dem {

// Writes results component by component.
template <RealType Real>
class ResultWriter {
 public:
  explicit ResultWriter(Real* out) : out_(out) {}
  ResultWriter& operator<<(const Real& x) {
    *out_++ = x;
    return *this;
  }
  ResultWriter& operator<<(const Vec3<Real>& v) { return *this << v.x << v.y << v.z; }
  ResultWriter& operator<<(const Quaternion<Real>& q) { return *this << q.w << q.x << q.y << q.z; }
  ResultWriter& operator<<(const ContactGeometry<Real>& g) {
    return *this << g.overlap << g.normal << g.point;
  }

 private:
  Real* out_;
};

namespace detail {

template <RealType Real>
Elastic<Real> elastic1(const KernelState<Real>& s) {
  return {s.young1, s.poisson1, s.friction1};
}
template <RealType Real>
Elastic<Real> elastic2(const KernelState<Real>& s) {
  return {s.young2, s.poisson2, s.friction2};
}
template <RealType Real>
ContactPhysics<Real> physics(const KernelState<Real>& s) {
  return {s.kn, s.ks, s.cn, s.cs, s.tan_friction};
}

// Reads the inputs of a kernel from `in` into the state; returns what lies behind them.  Once a type, and not
// once a kernel, of which there are many.
template <RealType Real>
const Real* read_inputs(const KernelInfo& info, const Real* in, KernelState<Real>& state) {
  for (const auto f : info.inputs) each_component(state, f, [&](Real& x) { x = *in++; });
  return in;
}

// Runs `kernel(state, writer)` over a batch.
template <RealType Real, class Kernel>
void run_batch(KernelId id, const Real* in, Real* out, std::uint8_t* threw, std::size_t count,
               Kernel kernel) {
  const KernelInfo& info = info_of(id);
  const std::size_t outputs = info.output_components();
  KernelState<Real> state;
  for (std::size_t i = 0; i < count; ++i) {
    in = read_inputs(info, in, state);
    try {
      ResultWriter<Real> writer(out + i * outputs);
      kernel(state, writer);
    } catch (...) {
      // Whatever it threw, the state has no result; the harness counts it as a mismatch.
      threw[i] = 1;
    }
  }
}

#define KERNEL(name, inputs, outputs, ...)                                                   \
  template <RealType Real>                                                                   \
  void batch_##name(const Real* in, Real* results, std::uint8_t* threw, std::size_t count) { \
    run_batch(KernelId::name, in, results, threw, count,                                     \
              [](const KernelState<Real>& s, ResultWriter<Real>& out) { __VA_ARGS__ });      \
  }
#include "kernels/dem/table/kernels.def"

}  // namespace detail

template <RealType Real>
const KernelTable<Real>& kernel_table() {
  static const KernelTable<Real> table = {
#define KERNEL(name, inputs, outputs, ...) &detail::batch_##name<Real>,
#include "kernels/dem/table/kernels.def"
  };
  return table;
}

}  // namespace ulpgate::dem
