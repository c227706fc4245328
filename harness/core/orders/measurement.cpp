// Measurement.
#include "harness/core/orders/measurement.hpp"

#include <stdexcept>

namespace ulpgate {

namespace {
constexpr std::string_view refused = "refused ";
}  // namespace

std::string Measurement::proceed(long steps, const ode::StopFlag& stop) {
  try {
    return measure_piece(steps, stop);
  } catch (const std::runtime_error& e) {
    refuse(e.what());
    return std::string(refused) + e.what();
  }
}

bool Measurement::take(std::string_view piece) {
  if (complete()) return false;
  if (piece.starts_with(refused)) {
    refuse(piece.substr(refused.size()));
    return true;
  }
  try {
    return take_piece(piece);
  } catch (const std::invalid_argument&) {
    return false;
  }
}

}  // namespace ulpgate
