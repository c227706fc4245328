// The scan for stable steps: grid, hidden extrema, bisected edges.
#include "harness/core/step_limits/stable_set.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ulpgate {

namespace {

// Excess above rounding; what is no number is above everything.
struct Margin {
  const ExcessOfStep& excess;
  const RoundingOfStep& rounding;

  [[nodiscard]] double operator()(double z) const {
    const double e = excess(z);
    return std::isfinite(e) ? e - rounding(z) : HUGE_VAL;
  }
};

std::vector<double> points(double z_max, double spacing) {
  std::vector<double> z;
  // Below the first point of the grid by factors of 2: methods that grow from the start.
  for (double small = spacing / 2; small > 1e-4; small /= 2) z.push_back(small);
  for (int i = 1; i * spacing < z_max; ++i) z.push_back(i * spacing);
  for (int n = 3; n <= 6; ++n) {
    for (int m = 1; 2 * m <= n; ++m) {
      const double at = 2 * std::sin(std::numbers::pi * m / n);
      for (const double off : {-3e-3, -1e-3, -1e-4, 0.0, 1e-4, 1e-3, 3e-3}) z.push_back(at * (1 + off));
    }
  }
  z.push_back(z_max);
  std::sort(z.begin(), z.end());
  z.erase(std::unique(z.begin(), z.end()), z.end());
  while (z.back() > z_max) z.pop_back();
  return z;
}

// The place of the largest margin between a and b by golden section.
double highest(const Margin& margin, double a, double b) {
  const double part = (std::sqrt(5.0) - 1) / 2;
  double left = b - part * (b - a);
  double right = a + part * (b - a);
  double at_left = margin(left);
  double at_right = margin(right);
  for (int i = 0; i < 60 && b - a > 1e-12 * b; ++i) {
    if (at_left > at_right) {
      b = right;
      right = left;
      at_right = at_left;
      left = b - part * (b - a);
      at_left = margin(left);
    } else {
      a = left;
      left = right;
      at_left = at_right;
      right = a + part * (b - a);
      at_right = margin(right);
    }
    if (at_left > 0 || at_right > 0) break;
  }
  return at_left > at_right ? left : right;
}

// Between a on one side of stability and b on the other.
double edge(const Margin& margin, double a, double b) {
  const bool a_unstable = margin(a) > 0;
  while (b - a > 1e-9 * b) {
    const double middle = a + (b - a) / 2;
    ((margin(middle) > 0) == a_unstable ? a : b) = middle;
  }
  return a + (b - a) / 2;
}

}  // namespace

std::optional<double> StableSet::limit() const {
  for (const StepInterval& i : unstable) {
    if (i.to - i.from > 0.01 * i.from) return i.from;
  }
  return std::nullopt;
}

std::vector<StepInterval> StableSet::gaps() const {
  std::vector<StepInterval> list;
  for (const StepInterval& i : unstable) {
    if (i.to - i.from > 0.01 * i.from) break;
    list.push_back(i);
  }
  return list;
}

std::vector<StepInterval> StableSet::reentries() const {
  std::vector<StepInterval> list;
  const std::size_t first = gaps().size();
  for (std::size_t k = first; k < unstable.size(); ++k) {
    const double from = unstable[k].to;
    const double to = k + 1 < unstable.size() ? unstable[k + 1].from : scanned_to;
    if (to > from) list.push_back({from, to, 0, from});
  }
  return list;
}

StableSet find_stable_set(const ExcessOfStep& excess, const RoundingOfStep& rounding, double z_max,
                          double spacing) {
  const Margin margin{excess, rounding};
  struct Point {
    double z;
    double margin;
  };
  std::vector<Point> line;
  for (const double z : points(z_max, spacing)) line.push_back({z, margin(z)});
  // Maxima that hide between two stable points, and minima between two unstable ones.
  const std::size_t on_grid = line.size();
  for (std::size_t i = 1; i + 1 < on_grid; ++i) {
    const double before = line[i - 1].margin;
    const double here = line[i].margin;
    const double after = line[i + 1].margin;
    if (here <= 0 && here >= before && here >= after && here > -0.2) {
      const double z = highest(margin, line[i - 1].z, line[i + 1].z);
      line.push_back({z, margin(z)});
    } else if (here > 0 && here <= before && here <= after && std::isfinite(here)) {
      const ExcessOfStep turned = [&](double z) { return -margin(z); };
      const RoundingOfStep none = [](double) { return 0.0; };
      const double z = highest(Margin{turned, none}, line[i - 1].z, line[i + 1].z);
      line.push_back({z, margin(z)});
    }
  }
  std::sort(line.begin(), line.end(), [](const Point& a, const Point& b) { return a.z < b.z; });
  StableSet set;
  set.scanned_to = z_max;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (!(line[i].margin > 0)) continue;
    StepInterval interval;
    // Where the first point already grows, it does so from 0 on.
    interval.from = i == 0 ? 0 : edge(margin, line[i - 1].z, line[i].z);
    interval.largest_at = line[i].z;
    interval.largest_excess = excess(line[i].z);
    std::size_t last = i;
    while (last + 1 < line.size() && line[last + 1].margin > 0) {
      ++last;
      const double e = excess(line[last].z);
      if (!(e <= interval.largest_excess)) {
        interval.largest_excess = e;
        interval.largest_at = line[last].z;
      }
    }
    interval.to = last + 1 < line.size() ? edge(margin, line[last].z, line[last + 1].z) : z_max;
    if (interval.to - interval.from < 0.01 * interval.from && last + 1 < line.size()) {
      // The top of a narrow gap lies between its edges.
      const ExcessOfStep& e = excess;
      double top = 0;
      for (int k = 1; k < 64; ++k) {
        const double z = interval.from + (interval.to - interval.from) * k / 64;
        const double here = e(z);
        if (here > top) {
          top = here;
          interval.largest_at = z;
        }
      }
      interval.largest_excess = top;
    }
    set.unstable.push_back(interval);
    i = last;
  }
  return set;
}

}  // namespace ulpgate
