// Environment.
#include "harness/app/machine/environment.hpp"

#include <fmt/format.h>

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

void check_environment(std::string_view what) {
  const FloatEnvironment now = FloatEnvironment::now();
  if (now == FloatEnvironment::standard()) return;
  FloatEnvironment::standard().restore();
  if (what.empty()) what = WorkPlace::name();
  throw Failure(Standing::environment,
                fmt::format("{} left the floating-point environment changed ({}): what was computed with it "
                            "is void",
                            what.empty() ? "the work" : what, now.deviation()));
}

}  // namespace ulpgate::app
