// SubjectSetting.
#include "harness/core/work_precision/subject_setting.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "harness/core/records/row_hint.hpp"

namespace ulpgate {

namespace {

constexpr std::size_t batch_size = 512;
constexpr std::uint64_t slice = 256;

WorkSetting setting_of(const Subject& subject) {
  WorkSetting s;
  s.subject = subject.info().kind == SubjectKind::function ? WorkSubject::function : WorkSubject::kernel;
  s.name = subject.name();
  s.type = subject.type().token;
  return s;
}

}  // namespace

SubjectSetting::SubjectSetting(const Subject& subject, std::uint64_t samples)
    : SettingMeasurement(setting_of(subject)), subject_(subject), samples_(samples) {}

SettingMeasurement::Work SubjectSetting::prepare() const {
  return [batch = subject_.timed_batch(batch_size)](const ode::StopFlag& stop) {
    stop.check();
    batch(batch_size, 1);
  };
}

std::uint64_t SubjectSetting::parts_of_repeat() const {
  return batch_size;
}

WorkOutcome SubjectSetting::measure(const ode::StopFlag& stop) {
  const bool kernel = subject_.info().kind == SubjectKind::kernel;
  const StratumSource source{kernel ? Stratum::typical : Stratum::uniform, 1, samples_, nullptr};
  RowHint hint(subject_.info().parts.size());
  std::vector<Summary> whole(subject_.info().parts.size());
  for (std::uint64_t first = 0; first < samples_; first += slice) {
    stop.check();
    const auto summaries =
        subject_.evaluate(source, first, std::min(first + slice, samples_), ReferenceMode::screened, hint);
    for (std::size_t part = 0; part < whole.size(); ++part) whole[part].merge(summaries[part]);
  }
  const int p = subject_.type().significand_bits;
  WorkOutcome o;
  o.evaluations = samples_;
  double ulp = 0;
  double relative = 0;
  std::uint64_t mismatches = 0;
  for (const Summary& s : whole) {
    mismatches += s.mismatches();
    ulp = std::max(ulp, s.max_error.value);
    relative = std::max(relative, kernel ? std::ldexp(s.normwise.value, -p) : std::ldexp(ulp, 1 - p));
  }
  if (mismatches > 0) {
    o.failure = WorkFailure::mismatch;
    o.why = std::to_string(mismatches) + " of " + std::to_string(samples_) +
            " results are no numbers that an error describes";
    return o;
  }
  o.largest_error_ulp = ulp;
  o.largest_error = relative;
  o.correct_digits = correct_digits_of(relative, p * std::numbers::log10e * std::numbers::ln2);
  return o;
}

}  // namespace ulpgate
