// run_round().
#include "harness/app/search/search_round.hpp"

#include <atomic>

#include "harness/app/machine/environment.hpp"
#include "harness/app/machine/threads.hpp"
#include "harness/app/shell/failure.hpp"
#include "harness/core/watch/heartbeat.hpp"
#include "harness/foreign/foreign_failure.hpp"
#include "reference/types/mpfr_value.hpp"

namespace ulpgate::app {

bool run_round(FunctionSearch& search, std::uint64_t most, unsigned threads, const Subject& subject) {
  const std::size_t batches = search.begin_round(most);
  std::atomic<std::size_t> next{0};
  const auto work = [&](unsigned) {
    const MpfrThread mpfr;
    const WorkPlace place(subject.name(), subject.type().token, "search");
    for (std::size_t i = next++; i < batches; i = next++) {
      search.run_batch(i);
      check_environment();
    }
  };
  try {
    Threads pool(1, threads, work);
    work(0);
    pool.join();
  } catch (const ForeignHangs& e) {
    throw Failure(Standing::regression, e.what());
  } catch (const ForeignFailure& e) {
    throw Failure(Standing::environment, e.what());
  }
  const WorkPlace place(subject.name(), subject.type().token, "search");
  search.end_round();
  check_environment();
  return batches > 0;
}

}  // namespace ulpgate::app
