// SceneSetting: a scene by one integrator in one type with one step.
#pragma once

#include "harness/app/advice/scene_reference.hpp"

namespace ulpgate::app {

class SceneSetting final : public SettingMeasurement {
 public:
  // `scene` of the setting's dt, steps and integrator.
  SceneSetting(WorkSetting setting, SceneRequest scene, const SceneInstants& instants,
               SharedReference reference);

  [[nodiscard]] Work prepare() const override;

 protected:
  [[nodiscard]] WorkOutcome measure(const ode::StopFlag& stop) override;

 private:
  void judge(const SceneView& view, WorkOutcome& o, const ode::StopFlag& stop) const;

  SceneRequest scene_;
  SceneInstants instants_;
  SharedReference reference_;
};

// d ln(error)/dt over the second half of a run, 1/s, by least squares; nothing of fewer than six errors that
// are numbers above 0 there.  `errors` are at equal distances of time, the last at until_s.
[[nodiscard]] std::optional<double> growth_of(const std::vector<double>& errors, double until_s);

}  // namespace ulpgate::app
