// What `ulpgate work-precision` writes: rows, fits, times, a table.
#pragma once

#include "harness/app/advice/setting_times.hpp"
#include "harness/app/store/records.hpp"
#include "harness/core/work_precision/error_fit.hpp"
#include "harness/core/work_precision/pareto_front.hpp"

namespace ulpgate::app {

// Which error of a curve is fitted.
enum class FittedError { final, energy };
[[nodiscard]] std::string_view to_string(FittedError which);  // "final_error"

// The points of one subject, integrator and type over the step, with their fits.
struct WorkCurve {
  std::vector<std::size_t> rows;  // in the order of the plan
  ErrorFit final_fit;
  ErrorFit energy_fit;
};
// Of trajectories and scenes; functions and kernels have no step.
[[nodiscard]] std::vector<WorkCurve> curves_of(const std::vector<WorkPrecisionRow>& rows);

// Lines of work_precision.jsonl, in the order of the rows: the same bytes on any number of threads.
[[nodiscard]] std::string row_lines(const std::vector<WorkPrecisionRow>& rows, const std::string& plan);
// Lines of work_precision_fits.jsonl.
[[nodiscard]] std::string fit_lines(const std::vector<WorkPrecisionRow>& rows, const std::string& plan);
// Lines of work_precision_timing.jsonl, of what has been timed; a setting is on the front where it is on that
// of all settings of its subject, of any type and integrator, by error and least time.
[[nodiscard]] std::string timing_lines(const std::vector<WorkPrecisionRow>& rows, const SettingTimes& times,
                                       const std::string& plan);
// What timing_lines wrote of the same plan; nothing where the file is absent, torn or of another plan: then
// it is done again.
[[nodiscard]] SettingTimes read_times(const std::filesystem::path& file, const std::string& plan);

void print_work_precision(const std::vector<WorkPrecisionRow>& rows, const SettingTimes& times);

// "1.2 ms", "35 ns"
[[nodiscard]] std::string shown_time(double seconds);

}  // namespace ulpgate::app
