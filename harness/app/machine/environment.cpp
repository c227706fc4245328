// Environment.
#include "harness/app/machine/environment.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <vector>

#include "harness/app/shell/failure.hpp"
#include "harness/core/watch/float_environment.hpp"
#include "harness/core/watch/heartbeat.hpp"

namespace ulpgate::app {

void assert_floating_point_environment() {
  const std::string deviation = FloatEnvironment::now().deviation();
  if (deviation.empty()) return;
  throw Failure(Standing::environment,
                fmt::format("the floating-point environment is {}; results would not be those of the types",
                            deviation));
}

namespace {

[[noreturn]] void refuse_changed(const FloatEnvironment& now, std::string_view what) {
  if (what.empty()) what = WorkPlace::name();
  throw Failure(Standing::environment,
                fmt::format("{} left the floating-point environment changed ({}): what was computed with it "
                            "is void",
                            what.empty() ? "the work" : what, now.deviation()));
}

}  // namespace

void check_environment(std::string_view what) {
  const FloatEnvironment now = FloatEnvironment::now();
  if (now == FloatEnvironment::standard()) return;
  FloatEnvironment::standard().restore();
  refuse_changed(now, what);
}

void check_environment_of_team(int threads) {
  std::vector<FloatEnvironment> found(static_cast<std::size_t>(std::max(threads, 1)),
                                      FloatEnvironment::standard());
  // The runtime keeps its threads from one parallel region to the next: these are those that computed.
#pragma omp parallel num_threads(threads) if (threads > 1)
  {
    FloatEnvironment& mine = found[static_cast<std::size_t>(omp_get_thread_num())];
    mine = FloatEnvironment::now();
    if (mine != FloatEnvironment::standard()) FloatEnvironment::standard().restore();
  }
  for (const FloatEnvironment& e : found)
    if (e != FloatEnvironment::standard()) refuse_changed(e, {});
}

}  // namespace ulpgate::app
