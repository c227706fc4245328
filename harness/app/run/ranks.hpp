// Ranks: the processes of one run that was started by MPI, as the runner sees them.  One writes the records
// and keeps the checkpoint, the others take units from it.
#pragma once

#include <exception>
#include <functional>
#include <vector>

#include "harness/app/store/checkpoint.hpp"
#include "harness/core/plan/unit_queue.hpp"

namespace ulpgate::app {

// What the writing process lets the others do.  Its members may be called from several threads.
class UnitExchange {
 public:
  virtual ~UnitExchange() = default;
  [[nodiscard]] virtual UnitQueue::Taken take(Taker taker) = 0;
  // A unit that was finished before is left as it is.
  virtual void finish(std::size_t position, double seconds, const std::vector<Summary>& summaries) = 0;
  // Ends the run; the first failure is the run's.
  virtual void fail(std::exception_ptr failure) = 0;
  // All is done, something failed, or the run was interrupted.
  [[nodiscard]] virtual bool over() = 0;
};

class Ranks {
 public:
  virtual ~Ranks() = default;
  [[nodiscard]] virtual std::size_t count() const = 0;
  // Whether this process is the one that writes.
  [[nodiscard]] virtual bool writes() const = 0;
  // After so many seconds a unit is given to another rank as well.
  [[nodiscard]] virtual double patience_s() const = 0;
  // The writing process: serves the others until the run is over.  Ranks of another identity fail the run.
  virtual void serve(UnitExchange& exchange, const RunIdentity& identity) = 0;
  // The others: take units until the writing process has no more.
  virtual void help(const RunIdentity& identity, const ShardUnits& units,
                    const std::function<std::vector<Summary>(const WorkUnit&)>& evaluate) = 0;
};

}  // namespace ulpgate::app
