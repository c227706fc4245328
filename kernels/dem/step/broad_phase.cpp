// Sort and sweep.
#include "kernels/dem/step/broad_phase.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ulpgate::dem {

namespace {

bool overlap(const CoarseBody& a, const CoarseBody& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    // Negated, so that a box of NaN overlaps everything.
    if (a.high[k] < b.low[k] || b.high[k] < a.low[k]) return false;
  }
  if (a.sphere && b.sphere) {
    double distance2 = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double d = a.centre[k] - b.centre[k];
      distance2 += d * d;
    }
    const double reach = a.reach + b.reach;
    if (distance2 > reach * reach) return false;
  }
  return a.movable || b.movable;
}

// Cells of y and z, no narrower than the widest box of the small bodies, so that a box reaches into its
// neighbours only.
struct CellGrid {
  std::array<double, 2> origin{};
  std::array<double, 2> width{1, 1};
  std::array<int, 2> count{1, 1};

  [[nodiscard]] int index(const CoarseBody& b, std::size_t k) const {
    // Clamped before it is made an integer: the box of a body that has left the numbers is infinite.
    return static_cast<int>(std::clamp((b.low[k + 1] - origin[k]) / width[k], 0.0, count[k] - 1.0));
  }
};

constexpr int most_cells = 64;

}  // namespace

void BroadPhase::sort_along_x(const std::vector<CoarseBody>& bodies) {
  if (order_.size() + large_.size() != bodies.size()) {
    order_.clear();
    large_.clear();
    // Bodies much wider than the usual would make every cell wide: they are tested against all.
    std::vector<double> widths;
    for (const CoarseBody& b : bodies) {
      if (b.sphere) widths.push_back(b.high[1] - b.low[1]);
    }
    double usual = 0;
    if (!widths.empty()) {
      std::nth_element(widths.begin(), widths.begin() + static_cast<long>(widths.size() / 2), widths.end());
      usual = widths[widths.size() / 2];
    }
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const bool small = bodies[i].sphere && bodies[i].high[1] - bodies[i].low[1] <= 4 * usual;
      (small ? order_ : large_).push_back(static_cast<std::int32_t>(i));
    }
    std::stable_sort(order_.begin(), order_.end(), [&](std::int32_t a, std::int32_t b) {
      return bodies[static_cast<std::size_t>(a)].low[0] < bodies[static_cast<std::size_t>(b)].low[0];
    });
    return;
  }
  for (std::size_t i = 1; i < order_.size(); ++i) {
    const std::int32_t id = order_[i];
    const double x = bodies[static_cast<std::size_t>(id)].low[0];
    std::size_t j = i;
    for (; j > 0 && bodies[static_cast<std::size_t>(order_[j - 1])].low[0] > x; --j)
      order_[j] = order_[j - 1];
    order_[j] = id;
  }
}

void BroadPhase::sort_pairs(std::size_t bodies, std::vector<BodyPair>& pairs) {
  start_.assign(bodies + 1, 0);
  for (const BodyPair& p : pairs) ++start_[static_cast<std::size_t>(p.first) + 1];
  for (std::size_t i = 0; i < bodies; ++i) start_[i + 1] += start_[i];
  sorted_.resize(pairs.size());
  for (const BodyPair& p : pairs) {
    sorted_[static_cast<std::size_t>(start_[static_cast<std::size_t>(p.first)]++)] = p;
  }
  std::int32_t begin = 0;
  for (std::size_t i = 0; i < bodies; ++i) {
    std::sort(sorted_.begin() + begin, sorted_.begin() + start_[i]);
    begin = start_[i];
  }
  pairs.swap(sorted_);
}

bool BroadPhase::find(const std::vector<CoarseBody>& bodies, std::vector<BodyPair>& pairs, std::size_t most) {
  pairs.clear();
  sort_along_x(bodies);
  const auto at = [&](std::int32_t i) -> const CoarseBody& { return bodies[static_cast<std::size_t>(i)]; };
  const auto add = [&](std::int32_t i, std::int32_t j) { pairs.push_back({std::min(i, j), std::max(i, j)}); };
  for (std::size_t k = 0; k < large_.size(); ++k) {
    for (const std::int32_t i : order_) {
      if (overlap(at(large_[k]), at(i))) add(large_[k], i);
    }
    for (std::size_t l = k + 1; l < large_.size(); ++l) {
      if (overlap(at(large_[k]), at(large_[l]))) add(large_[k], large_[l]);
    }
    // A body adds no more pairs than there are bodies: to look once a body is to look in time.
    if (pairs.size() > most) return false;
  }
  CellGrid grid;
  for (std::size_t k = 0; k < 2; ++k) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    double widest = 0;
    for (const std::int32_t i : order_) {
      low = std::min(low, at(i).low[k + 1]);
      high = std::max(high, at(i).low[k + 1]);
      widest = std::max(widest, at(i).high[k + 1] - at(i).low[k + 1]);
    }
    if (!(high > low) || !std::isfinite(high - low) || !(widest > 0)) continue;
    grid.origin[k] = low;
    // A hair wider, so that no rounding of the cell's number lets a box reach past its neighbour.
    grid.width[k] = std::max(widest, (high - low) / most_cells) * 1.001;
    grid.count[k] = static_cast<int>((high - low) / grid.width[k]) + 1;
  }
  cells_.resize(static_cast<std::size_t>(grid.count[0]) * static_cast<std::size_t>(grid.count[1]));
  for (auto& cell : cells_) cell.clear();
  const auto cell_number = [&](int y, int z) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.count[1]) +
           static_cast<std::size_t>(z);
  };
  for (const std::int32_t i : order_) {
    const CoarseBody& b = at(i);
    const int y = grid.index(b, 0);
    const int z = grid.index(b, 1);
    for (int cy = std::max(0, y - 1); cy <= std::min(grid.count[0] - 1, y + 1); ++cy) {
      for (int cz = std::max(0, z - 1); cz <= std::min(grid.count[1] - 1, z + 1); ++cz) {
        auto& cell = cells_[cell_number(cy, cz)];
        for (std::size_t k = 0; k < cell.size();) {
          if (at(cell[k]).high[0] < b.low[0]) {
            cell[k] = cell.back();
            cell.pop_back();
            continue;
          }
          if (overlap(at(cell[k]), b)) add(cell[k], i);
          ++k;
        }
      }
    }
    cells_[cell_number(y, z)].push_back(i);
    if (pairs.size() > most) return false;
  }
  sort_pairs(bodies.size(), pairs);
  return true;
}

}  // namespace ulpgate::dem
