// Measurement: something that takes long and is measured piece by piece, so that what is done can be kept.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "kernels/ode/stepper/stop_flag.hpp"

namespace ulpgate {

class Measurement {
 public:
  Measurement() = default;
  Measurement(const Measurement&) = delete;
  Measurement& operator=(const Measurement&) = delete;
  virtual ~Measurement() = default;

  // Nothing is left to do: all is measured, or the method refuses to go on.
  [[nodiscard]] virtual bool complete() const = 0;
  // Why the method refuses, such as a step that is too large for it.
  [[nodiscard]] const std::optional<std::string>& refusal() const { return refusal_; }

  // Steps of the integrator.
  [[nodiscard]] virtual std::uint64_t steps_done() const = 0;
  [[nodiscard]] virtual std::uint64_t expected_steps_left() const = 0;

  // Measures the next piece, of about `steps` steps where the size of a piece is free, and returns it as
  // text, exact.  Throws ode::Stopped when `stop` is raised; the measurement is of no use then.  The pieces'
  // sizes change nothing in the result.
  [[nodiscard]] std::string proceed(long steps, const ode::StopFlag& stop = {});
  // Takes over a piece instead of measuring it.  False, with nothing changed, where it is not the next one.
  [[nodiscard]] bool take(std::string_view piece);

 protected:
  // A std::runtime_error of these is a refusal.
  [[nodiscard]] virtual std::string measure_piece(long steps, const ode::StopFlag& stop) = 0;
  // Throws std::invalid_argument for a text that is no piece.
  [[nodiscard]] virtual bool take_piece(std::string_view piece) = 0;
  void refuse(std::string_view why) { refusal_ = why; }

 private:
  std::optional<std::string> refusal_;
};

}  // namespace ulpgate
