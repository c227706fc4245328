// AdviceCase: a scene or an initial value problem with all types and integrators that advice may choose.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "harness/app/advice/work_precision_job.hpp"
#include "harness/core/work_precision/advice_search.hpp"

namespace ulpgate::app {

struct AdviceOptions {
  std::string name;    // of the scene or problem
  double error = 0;    // wanted
  double time_s = 30;  // a run may take
  double search_s = 300;
  std::string types = "all";
  std::string integrators = "all";
  std::string until;
  bool along = false;  // a problem's error is to be below the one wanted on the way, too
  std::vector<std::string> overrides;
  std::string records;  // directory
  std::string out;
  bool overwrite = false;
  bool json = false;
};

class AdviceCase {
 public:
  AdviceCase() = default;
  AdviceCase(const AdviceCase&) = delete;
  AdviceCase& operator=(const AdviceCase&) = delete;
  virtual ~AdviceCase() = default;

  enum class Steps {
    equal,    // quarter q: about 2^(q/4) times as many as quarter 0
    planned,  // of trajectories, quarter q: for a tolerance of 10^-(3 + q/4)
  };
  struct Choice {
    std::string type;
    std::string integrator;
    Steps steps = Steps::equal;
  };
  // The narrowest type first.
  [[nodiscard]] const std::vector<Choice>& choices() const { return choices_; }
  // Makes what settings are held against.  Throws std::runtime_error where there is no truth, and
  // ode::Stopped.
  virtual void prepare(const ode::StopFlag& stop) const = 0;
  // Levels of a choice, seconds of the first and what each costs more, roughly.
  [[nodiscard]] virtual AdviceCurve curve(const Choice& choice) const = 0;
  // Throws std::runtime_error where there are no such steps.
  [[nodiscard]] virtual std::unique_ptr<SettingMeasurement> setting(const Choice& choice,
                                                                    int quarter) const = 0;
  // Which of a setting's errors is to be below the one wanted.
  [[nodiscard]] virtual AdvicePoint::Wanted wanted() const = 0;

  // "1024 equal steps of 0.0061 (time of the problem)"
  [[nodiscard]] virtual std::string step_words(const WorkSetting& setting) const = 0;
  // "largest position error, relative to the scene's size of 0.08 m, up to t = 1 s"
  [[nodiscard]] virtual std::string error_words() const = 0;
  // Why an order may be lost here.
  [[nodiscard]] virtual std::string kink_words(const std::string& integrator) const = 0;
  // "20 steps a contact (t_c = 0.001 s), 0.1 of the critical step"; empty where there are no contacts.
  [[nodiscard]] virtual std::string contact_words(const WorkSetting& setting) const = 0;
  // Command lines that run the setting, and that measure it again.
  [[nodiscard]] virtual std::string run_command(const WorkSetting& setting) const = 0;
  [[nodiscard]] virtual std::string measure_command(const WorkSetting& setting) const = 0;

 protected:
  std::vector<Choice> choices_;
};

// Types whose roundoff is above the wanted error are left out: no state of theirs is that near to the truth
// but by chance.  Throws a Failure for a name, type or integrator that is not known, and where nothing is
// left to choose.
[[nodiscard]] std::unique_ptr<AdviceCase> make_advice_case(const AdviceOptions& o);

// The type after `token` in bits of those that were built, with more by at least 8; nothing behind the last.
[[nodiscard]] std::optional<std::string> wider_type(const std::string& token);

}  // namespace ulpgate::app
