// ulpgate-mpi: `ulpgate math` by the ranks of an MPI job; the same options, records and checkpoints.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <thread>

#define OMPI_SKIP_MPICXX 1
#define MPICH_SKIP_MPICXX 1
#include <mpi.h>

#include "harness/app/commands/commands.hpp"
#include "harness/app/machine/build_facts.hpp"
#include "harness/app/machine/ending.hpp"
#include "harness/app/machine/watchdog.hpp"
#include "harness/app/run/mpi_ranks.hpp"
#include "harness/app/shell/crash_report.hpp"
#include "harness/app/shell/strict_options.hpp"
#include "reference/types/mpfr_value.hpp"

namespace ulpgate::app {
namespace {

bool goes_on_without_the_dead() {
  return std::getenv("OMPI_MCA_orte_enable_recovery") != nullptr;
}

// mpirun does not always tell the others of a rank's death, and then finalising never ends.  Everything is
// written by now, and a job that goes on without the dead may miss a rank that ends like this one.
void end_without_finalising(int code) {
  if (!goes_on_without_the_dead()) return;
  std::thread([code] {
    std::this_thread::sleep_for(std::chrono::seconds(10));
    std::_Exit(code);
  }).detach();
}

// Rank 0 speaks for all; the others are told apart by it.
int main_of_rank(int argc, char** argv, int rank) {
  CLI::App app(
      "ulpgate-mpi runs `ulpgate math` on the ranks of an MPI job: mpirun -np N ulpgate-mpi math ...",
      "ulpgate-mpi");
  app.set_version_flag("--version", fmt::format("ulpgate-mpi {}", build_facts::version));
  app.require_subcommand(1);
  double patience_s = 60;
  app.add_option("--patience", patience_s,
                 "seconds after which the unit of a rank is given to an idle one as well, and after which a "
                 "rank is not waited for at the end")
      ->capture_default_str()
      ->check(CLI::Range(0.1, 1e6));
  app.footer(
      "Every rank is one thread.  With the same --out and --resume a job that died goes on, also as `ulpgate "
      "math --resume`.\nExit codes as of ulpgate; `mpirun --enable-recovery` goes on without a rank that "
      "died, "
      "and gives 0 whatever happened.");
  Action action;
  std::optional<MpiRanks> ranks;
  add_math_command(app, action, [&]() -> Ranks* { return &*ranks; });
  double timeout_s = 60;
  add_timeout_option(app, timeout_s);
  make_options_strict(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    const bool asked = e.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success);
    const std::string wrong = asked ? "" : wrong_verb(app, argc, argv);
    if (rank == 0 && !wrong.empty()) fmt::print(stderr, "ulpgate-mpi: {}\n", wrong);
    if (rank == 0 && wrong.empty()) app.exit(e);
    return exit_code(asked ? Standing::pass : Standing::bad_input);
  }
  ranks.emplace(patience_s);
  const Ending ending = end_of(action, timeout_s);
  if (rank != 0) {
    ranks->leave(ending.message);
    return exit_code(Standing::pass);
  }
  if (!ending.message.empty()) fmt::print(stderr, "ulpgate-mpi: {}\n", ending.message);
  const auto code = exit_code(ending.standing);
  if (const auto silent = ranks->dismiss(); !silent.empty()) {
    fmt::print(stderr, "ulpgate-mpi: note: no answer from rank {}; other ranks did its units\n",
               fmt::join(silent, ", "));
    // To finalise is to wait for all, unless mpirun knows that a rank is dead and goes on without.
    if (!goes_on_without_the_dead()) MPI_Abort(MPI_COMM_WORLD, code);
  }
  return code;
}

}  // namespace
}  // namespace ulpgate::app

int main(int argc, char** argv) {
  ulpgate::app::install_crash_report();
  int provided = 0;
  int rank = 0;
  if (MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided) != MPI_SUCCESS ||
      provided < MPI_THREAD_FUNNELED) {
    fmt::print(stderr, "ulpgate-mpi: this MPI knows no threads\n");
    ulpgate::app::ends_by_itself();
    return ulpgate::exit_code(ulpgate::Standing::environment);
  }
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  int code = 0;
  {
    const ulpgate::MpfrThread mpfr;
    code = ulpgate::app::main_of_rank(argc, argv, rank);
  }
  ulpgate::app::end_without_finalising(code);
  MPI_Finalize();
  ulpgate::app::ends_by_itself();
  return code;
}
