// MpiRanks: Ranks over MPI.  Rank 0 writes; the others ask it for units and report them, a text each. Nothing
// is summed by MPI: rank 0 merges whole summaries, so that neither order nor number of ranks changes a byte.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "harness/app/run/ranks.hpp"

namespace ulpgate::app {

class MpiRanks : public Ranks {
 public:
  // MPI is initialised and is used by the calling thread alone.
  explicit MpiRanks(double patience_s);

  [[nodiscard]] std::size_t count() const override { return left_.size(); }
  [[nodiscard]] bool writes() const override { return rank_ == 0; }
  [[nodiscard]] double patience_s() const override { return patience_s_; }
  void serve(UnitExchange& exchange, const RunIdentity& identity) override;
  // Throws a Failure (environment) where rank 0 is silent for ten minutes.
  void help(const RunIdentity& identity, const ShardUnits& units,
            const std::function<std::vector<Summary>(const WorkUnit&)>& evaluate) override;

  // The end, on every rank.  Rank 0 waits until all others have left and returns those that are silent for
  // longer than the patience.  Another rank leaves, with its failure, if it has one.
  std::vector<int> dismiss();
  void leave(const std::string& failure);

 private:
  struct Report {
    int rank;
    std::string text;
  };
  // Positions of units are orders of their own.
  static constexpr std::int64_t wait = -1;
  static constexpr std::int64_t leave_now = -2;

  [[nodiscard]] static std::optional<Report> next_report();
  static void send_order(int rank, std::int64_t order);
  static void send_report(char kind, const std::string& text);
  [[nodiscard]] static std::int64_t next_order();
  void take_in(const Report& report, UnitExchange& exchange, const RunIdentity& identity);
  [[nodiscard]] bool any_busy() const;

  int rank_ = 0;
  double patience_s_;
  std::vector<bool> left_;  // by rank
  std::vector<bool> busy_;  // has a unit
};

}  // namespace ulpgate::app
