// SubjectSetting: a function or a kernel of one type, its largest error over samples and its time.
#pragma once

#include "harness/core/subject/subject.hpp"
#include "harness/core/work_precision/setting_measurement.hpp"

namespace ulpgate {

// Functions over `samples` uniform arguments, kernels over typical states, of seed 1: what `ulpgate math` and
// `ulpgate kernels` measure.
class SubjectSetting final : public SettingMeasurement {
 public:
  SubjectSetting(const Subject& subject, std::uint64_t samples);

  [[nodiscard]] Work prepare() const override;
  [[nodiscard]] std::uint64_t parts_of_repeat() const override;

 protected:
  [[nodiscard]] WorkOutcome measure(const ode::StopFlag& stop) override;
  [[nodiscard]] std::uint64_t size() const override { return samples_; }

 private:
  const Subject& subject_;
  std::uint64_t samples_;
};

}  // namespace ulpgate
