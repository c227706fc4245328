// Linear systems of some rows to some hundred, in any number: Gaussian elimination with row pivots.
//
// Ours, since a library's costs every translation unit five to ten seconds a type: it brings products by
// blocks that systems of this size do not need.
#pragma once

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace ulpgate::ode {

// P A = L U (N. J. Higham, Accuracy and Stability of Numerical Algorithms (2002), 9), of a square matrix.
template <class Number>
class LuDecomposition {
 public:
  // `a`: row by row, n rows of n numbers.
  void decompose(std::vector<Number> a, std::size_t n) {
    using std::abs;
    n_ = n;
    lu_ = std::move(a);
    order_.resize(n);
    for (std::size_t r = 0; r < n; ++r) order_[r] = r;
    for (std::size_t c = 0; c < n; ++c) {
      std::size_t pivot = c;
      for (std::size_t r = c + 1; r < n; ++r) {
        if (abs(at(r, c)) > abs(at(pivot, c))) pivot = r;
      }
      if (pivot != c) {
        for (std::size_t k = 0; k < n; ++k) std::swap(at(c, k), at(pivot, k));
        std::swap(order_[c], order_[pivot]);
      }
      for (std::size_t r = c + 1; r < n; ++r) {
        at(r, c) /= at(c, c);
        const Number& factor = at(r, c);
        for (std::size_t k = c + 1; k < n; ++k) at(r, k) -= factor * at(c, k);
      }
    }
  }

  // Whether all of it are numbers, and no pivot is 0.
  [[nodiscard]] bool is_regular() const {
    using std::isfinite;
    for (const Number& x : lu_) {
      if (!isfinite(x)) return false;
    }
    for (std::size_t r = 0; r < n_; ++r) {
      if (at(r, r) == 0) return false;
    }
    return true;
  }

  // x of A x = right.
  [[nodiscard]] std::vector<Number> solve(const std::vector<Number>& right) const {
    std::vector<Number> x(n_);
    for (std::size_t r = 0; r < n_; ++r) {
      x[r] = right[order_[r]];
      for (std::size_t k = 0; k < r; ++k) x[r] -= at(r, k) * x[k];
    }
    for (std::size_t r = n_; r-- > 0;) {
      for (std::size_t k = n_; k-- > r + 1;) x[r] -= at(r, k) * x[k];
      x[r] /= at(r, r);
    }
    return x;
  }

  // Row by row.
  [[nodiscard]] std::vector<Number> inverse() const {
    std::vector<Number> inverse(n_ * n_);
    std::vector<Number> unit(n_, Number(0));
    for (std::size_t c = 0; c < n_; ++c) {
      unit[c] = Number(1);
      const std::vector<Number> column = solve(unit);
      for (std::size_t r = 0; r < n_; ++r) inverse[r * n_ + c] = column[r];
      unit[c] = Number(0);
    }
    return inverse;
  }

 private:
  [[nodiscard]] Number& at(std::size_t r, std::size_t c) { return lu_[r * n_ + c]; }
  [[nodiscard]] const Number& at(std::size_t r, std::size_t c) const { return lu_[r * n_ + c]; }

  std::size_t n_ = 0;
  std::vector<Number> lu_;          // L below the diagonal, whose own is 1, and U
  std::vector<std::size_t> order_;  // of A's rows
};

}  // namespace ulpgate::ode
