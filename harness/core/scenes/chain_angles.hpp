// Interior angles of a chain of bodies 0, 1, 2 ...: what the pendulum records.
#pragma once

#include <vector>

#include "kernels/dem/engine/engine.hpp"
#include "reference/types/mpfr_value.hpp"

namespace ulpgate {

// The angle (rad, 0 to pi) at each inner node, between the directions to its neighbours; none of a chain of
// fewer than three bodies.  Positions are rounded to double first, the angles are good to some 1e-16.
[[nodiscard]] std::vector<double> chain_angles(const dem::DemEngine& engine);

// Their product; 1 of none.
[[nodiscard]] double product_of(const std::vector<double>& angles);

// The same angles from the exact positions.  `bits` is the precision that they and their product are wanted
// in; they are computed with 64 more and not rounded back.
struct ExactChainAngles {
  std::vector<MpfrValue> angles;
  MpfrValue product;
};
[[nodiscard]] ExactChainAngles exact_chain_angles(const dem::DemEngine& engine, mpfr_prec_t bits);

}  // namespace ulpgate
