// CostModel: what the remaining points of a run will cost, from what its points have cost so far.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ulpgate {

// A row is a function of a type over a stratum; rows of one function and type form a group and have similar
// costs.  A row that was not measured yet is taken to cost what its group costs, then what its trial said,
// then its prior times the mean ratio of measured costs to priors.
class CostModel {
 public:
  struct Row {
    std::size_t group;
    double prior;          // relative cost of a point, in any unit common to all rows
    std::uint64_t points;  // to be evaluated
  };
  explicit CostModel(std::vector<Row> rows);

  // `points` points of the row are done and took `seconds` of one thread.
  void add(std::size_t row, std::uint64_t points, double seconds);
  // The rest of the row turns out to need no evaluation.
  void drop(std::size_t row) { rows_[row].points = 0; }
  // A trial of a few points of the row, which are still to be done.
  void add_trial(std::size_t row, std::uint64_t points, double seconds);

  [[nodiscard]] bool is_known(std::size_t row) const;
  // Seconds of one thread: spent, and still to be spent.
  [[nodiscard]] double spent_s() const { return spent_s_; }
  [[nodiscard]] double remaining_s() const;

 private:
  struct Sum {
    double seconds = 0;
    double points = 0;
    double prior = 0;  // of those points
    void add(double s, std::uint64_t n, double row_prior) {
      seconds += s;
      points += static_cast<double>(n);
      prior += static_cast<double>(n) * row_prior;
    }
  };
  std::vector<Row> rows_;
  std::vector<Sum> by_row_;
  std::vector<Sum> by_group_;
  std::vector<Sum> trials_;  // by group
  double spent_s_ = 0;
};

}  // namespace ulpgate
