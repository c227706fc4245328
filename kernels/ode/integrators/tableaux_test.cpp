// Runge-Kutta tableaux at 248 digits: Gauss-Legendre, and Boost.odeint's against the conditions of all trees.
#include <gtest/gtest.h>

#include "kernels/ode/integrators/explicit_runge_kutta.hpp"
#include "kernels/ode/integrators/gauss_legendre.hpp"
#include "kernels/ode/integrators/odeint_steppers.hpp"
#include "reference/text/literal.hpp"

namespace ulpgate::ode {
namespace {

using Reference = MpfrReal<248>;

// B(2s), C(s) and D(s), of which order 2s follows: J. C. Butcher, Math. Comp. 18 (1964) 50.
TEST(GaussLegendre, MeetsTheSimplifyingAssumptions) {
  const Reference tolerance = real<Reference>("1e-244");
  for (int stages = 1; stages <= 10; ++stages) {
    const auto& t = gauss_tableau<Reference>(stages);
    const auto s = static_cast<std::size_t>(stages);
    for (int power = 1; power <= 2 * stages; ++power) {
      Reference sum(0);
      for (std::size_t i = 0; i < s; ++i) sum += t.b[i] * pow(t.c[i], power - 1);
      EXPECT_LT(abs(sum - Reference(1) / power), tolerance) << "B(" << power << "), stages " << stages;
    }
    for (int power = 1; power <= stages; ++power) {
      for (std::size_t i = 0; i < s; ++i) {
        Reference c_sum(0);
        Reference d_sum(0);
        for (std::size_t j = 0; j < s; ++j) {
          c_sum += t.a[i][j] * pow(t.c[j], power - 1);
          d_sum += t.b[j] * pow(t.c[j], power - 1) * t.a[j][i];
        }
        EXPECT_LT(abs(c_sum - pow(t.c[i], power) / power), tolerance) << "C(" << power << ")";
        EXPECT_LT(abs(d_sum - t.b[i] * (1 - pow(t.c[i], power)) / power), tolerance) << "D(" << power << ")";
      }
    }
  }
}

TEST(GaussLegendre, TwoStagesAreTheirClosedForm) {
  const auto& t = gauss_tableau<Reference>(2);
  const Reference root = sqrt(Reference(3)) / 6;
  const Reference tolerance = real<Reference>("1e-246");
  EXPECT_LT(abs(t.c[0] - (Reference(1) / 2 - root)), tolerance);
  EXPECT_LT(abs(t.a[0][1] - (Reference(1) / 4 - root)), tolerance);
  EXPECT_LT(abs(t.a[1][0] - (Reference(1) / 4 + root)), tolerance);
  EXPECT_EQ(gauss_tableau<double>(1).c[0], 0.5);
}

struct Tableau {
  std::vector<std::vector<Reference>> a;
  std::vector<Reference> b, c;
};

template <class Array>
std::vector<Reference> listed(const Array& array) {
  return {array.begin(), array.end()};
}

namespace odeint = boost::numeric::odeint;

Tableau cash_karp() {
  using R = Reference;
  return {{{},
           listed(odeint::rk54_ck_coefficients_a1<R>()),
           listed(odeint::rk54_ck_coefficients_a2<R>()),
           listed(odeint::rk54_ck_coefficients_a3<R>()),
           listed(odeint::rk54_ck_coefficients_a4<R>()),
           listed(odeint::rk54_ck_coefficients_a5<R>())},
          listed(odeint::rk54_ck_coefficients_b<R>()),
          listed(odeint::rk54_ck_coefficients_c<R>())};
}

Tableau fehlberg() {
  using R = Reference;
  return {{{},
           listed(odeint::rk78_coefficients_a1<R>()),
           listed(odeint::rk78_coefficients_a2<R>()),
           listed(odeint::rk78_coefficients_a3<R>()),
           listed(odeint::rk78_coefficients_a4<R>()),
           listed(odeint::rk78_coefficients_a5<R>()),
           listed(odeint::rk78_coefficients_a6<R>()),
           listed(odeint::rk78_coefficients_a7<R>()),
           listed(odeint::rk78_coefficients_a8<R>()),
           listed(odeint::rk78_coefficients_a9<R>()),
           listed(odeint::rk78_coefficients_a10<R>()),
           listed(odeint::rk78_coefficients_a11<R>()),
           listed(odeint::rk78_coefficients_a12<R>())},
          listed(odeint::rk78_coefficients_b<R>()),
          listed(odeint::rk78_coefficients_c<R>())};
}

// A rooted tree by what its order condition needs: sum_i b_i weight_i = 1 / density.
struct Tree {
  int order;
  Reference density;
  std::vector<Reference> weight;  // of each stage
};

// All trees of one order more than a subset of `trees`, as multisets of subtrees from index `first` on.
void graft(const Tableau& t, const std::vector<Tree>& trees, std::size_t first, const Tree& root, int order,
           std::vector<Tree>& grown) {
  if (root.order == order) {
    Tree tree = root;
    tree.density *= order;
    grown.push_back(tree);
    return;
  }
  for (std::size_t k = first; k < trees.size(); ++k) {
    if (root.order + trees[k].order > order) continue;
    Tree next{root.order + trees[k].order, root.density * trees[k].density, root.weight};
    for (std::size_t i = 0; i < t.a.size(); ++i) {
      Reference sum(0);
      for (std::size_t j = 0; j < t.a[i].size(); ++j) sum += t.a[i][j] * trees[k].weight[j];
      next.weight[i] *= sum;
    }
    graft(t, trees, k, next, order, grown);
  }
}

// The largest |sum b_i weight_i - 1/density| over the trees of each order (J. C. Butcher, J. Austral. Math.
// Soc. 3 (1963) 185).
std::vector<Reference> tree_misses(const Tableau& t, int order, std::size_t& number_of_trees) {
  std::vector<Tree> trees;
  std::vector<Reference> misses;
  for (int p = 1; p <= order; ++p) {
    std::vector<Tree> grown;
    graft(t, trees, 0, {1, Reference(1), std::vector<Reference>(t.b.size(), Reference(1))}, p, grown);
    Reference largest(0);
    for (const Tree& tree : grown) {
      Reference sum(0);
      for (std::size_t i = 0; i < t.b.size(); ++i) sum += t.b[i] * tree.weight[i];
      const Reference miss = abs(sum - 1 / tree.density);
      if (miss > largest) largest = miss;
    }
    misses.push_back(largest);
    trees.insert(trees.end(), grown.begin(), grown.end());
  }
  number_of_trees = trees.size();
  return misses;
}

void expect_order(const Tableau& t, int order, std::size_t trees) {
  std::size_t number = 0;
  const std::vector<Reference> misses = tree_misses(t, order + 1, number);
  EXPECT_EQ(number, trees);
  for (int p = 1; p <= order; ++p) {
    EXPECT_LT(misses[static_cast<std::size_t>(p - 1)], real<Reference>("1e-244")) << "order " << p;
  }
  EXPECT_GT(misses.back(), real<Reference>("1e-9"));
  for (std::size_t i = 0; i < t.a.size(); ++i) {
    Reference sum(0);
    for (const Reference& x : t.a[i]) sum += x;
    EXPECT_LT(abs(sum - t.c[i]), real<Reference>("1e-245")) << "row " << i;
  }
}

// A double in a tableau would miss by 1e-17.  Trees up to order 6 and 9: 37 and 486.
TEST(Odeint, CashKarpIsOfOrder5InFullPrecision) {
  expect_order(cash_karp(), 5, 37);
}
TEST(Odeint, FehlbergIsOfOrder8InFullPrecision) {
  expect_order(fehlberg(), 8, 486);
}

// Trees up to order p + 1: 2, 4, 8, 17 and 37.
TEST(ExplicitRungeKutta, TableauxAreOfTheirOrder) {
  const std::size_t trees[] = {2, 4, 8, 17, 37};
  for (const ExplicitTableau& tableau : explicit_tableaux()) {
    SCOPED_TRACE(tableau.name);
    Tableau t;
    for (const auto& row : tableau.a) {
      t.a.emplace_back();
      for (const Ratio& x : row) t.a.back().push_back(x.in<Reference>());
    }
    for (const Ratio& x : tableau.b) t.b.push_back(x.in<Reference>());
    for (const Ratio& x : tableau.c) t.c.push_back(x.in<Reference>());
    expect_order(t, tableau.order, trees[tableau.order - 1]);
  }
}

}  // namespace
}  // namespace ulpgate::ode
