// CostModel.
#include "harness/core/plan/cost_model.hpp"

#include <algorithm>

namespace ulpgate {

CostModel::CostModel(std::vector<Row> rows) : rows_(std::move(rows)), by_row_(rows_.size()) {
  std::size_t groups = 0;
  for (const auto& row : rows_) groups = std::max(groups, row.group + 1);
  by_group_.resize(groups);
  trials_.resize(groups);
}

void CostModel::add(std::size_t row, std::uint64_t points, double seconds) {
  Row& r = rows_[row];
  by_row_[row].add(seconds, points, r.prior);
  by_group_[r.group].add(seconds, points, r.prior);
  r.points -= std::min(points, r.points);
  spent_s_ += seconds;
}

void CostModel::add_trial(std::size_t row, std::uint64_t points, double seconds) {
  trials_[rows_[row].group].add(seconds, points, rows_[row].prior);
}

bool CostModel::is_known(std::size_t row) const {
  const std::size_t group = rows_[row].group;
  return by_group_[group].points > 0 || trials_[group].points > 0;
}

double CostModel::remaining_s() const {
  Sum all;
  for (std::size_t g = 0; g < by_group_.size(); ++g) {
    // A trial stands for its group until the group is measured.
    const Sum& s = by_group_[g].points > 0 ? by_group_[g] : trials_[g];
    all.seconds += s.seconds;
    all.prior += s.prior;
  }
  const double per_prior = all.prior > 0 ? all.seconds / all.prior : 0;
  double seconds = 0;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Row& r = rows_[i];
    if (r.points == 0) continue;
    double cost_s = r.prior * per_prior;
    for (const Sum* s : {&by_row_[i], &by_group_[r.group], &trials_[r.group]}) {
      if (s->points == 0) continue;
      cost_s = s->seconds / s->points;
      break;
    }
    seconds += cost_s * static_cast<double>(r.points);
  }
  return seconds;
}

}  // namespace ulpgate
