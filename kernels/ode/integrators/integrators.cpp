// The list of integrators.
#include "kernels/ode/integrators/integrators.hpp"

#include <stdexcept>
#include <vector>

#include "kernels/ode/coefficients/composition_rows.hpp"
#include "kernels/ode/integrators/explicit_runge_kutta.hpp"

namespace ulpgate::ode {
namespace {

std::vector<IntegratorInfo> all_integrators() {
  std::vector<IntegratorInfo> list;
  for (const CompositionRow& row : composition_rows()) {
    list.push_back({std::string(row.name), IntegratorKind::splitting, row.order, row.evaluations_per_step,
                    std::string(row.citation)});
  }
  for (int stages = 1; stages <= kMostGaussStages; ++stages) {
    list.push_back({"gauss" + std::to_string(stages), IntegratorKind::collocation, 2 * stages, std::nullopt,
                    "J. C. Butcher, Math. Comp. 18 (1964) 50", stages});
  }
  for (const int stages : {2, 3, 5, 7, 9}) {
    list.push_back({"radau" + std::to_string(stages), IntegratorKind::collocation_newton, 2 * stages - 1,
                    std::nullopt,
                    "J. C. Butcher, Math. Comp. 18 (1964) 233; E. Hairer, G. Wanner, Solving Ordinary "
                    "Differential Equations II (1996), IV.5, IV.8",
                    stages});
  }
  for (const int stages : {2, 4, 6}) {
    list.push_back({"gauss" + std::to_string(stages) + "n", IntegratorKind::collocation_newton, 2 * stages,
                    std::nullopt,
                    "J. C. Butcher, Math. Comp. 18 (1964) 50; Newton's iteration as of E. Hairer, G. Wanner, "
                    "Solving Ordinary Differential Equations II (1996), IV.8",
                    stages});
  }
  list.push_back({"rodas3", IntegratorKind::rosenbrock, 3, 3,
                  "A. Sandu et al., Atmos. Environ. 31 (1997) 3459, gamma = 1/2"});
  for (const ExplicitTableau& t : explicit_tableaux()) {
    list.push_back({std::string(t.name), IntegratorKind::runge_kutta, t.order, static_cast<int>(t.b.size()),
                    std::string(t.citation)});
  }
  list.push_back({"cash_karp54", IntegratorKind::runge_kutta, 5, 6,
                  "J. R. Cash, A. H. Karp, ACM Trans. Math. Softw. 16 (1990) 201; Boost.odeint"});
  list.push_back(
      {"fehlberg78", IntegratorKind::runge_kutta, 8, 13, "E. Fehlberg, NASA TR R-287 (1968); Boost.odeint"});
  list.push_back({"extrapolation8", IntegratorKind::extrapolation, 8, 21,
                  "W. B. Gragg, SIAM J. Numer. Anal. 2 (1965) 384; R. Bulirsch, J. Stoer, Numer. Math. 8 "
                  "(1966) 1, of fixed order; Boost.odeint"});
  list.push_back({"bulirsch_stoer", IntegratorKind::extrapolation, std::nullopt, std::nullopt,
                  "R. Bulirsch, J. Stoer, Numer. Math. 8 (1966) 1, of variable order and inner steps; "
                  "Boost.odeint"});
  return list;
}

}  // namespace

std::string_view to_string(IntegratorKind kind) {
  switch (kind) {
    case IntegratorKind::splitting:
      return "splitting";
    case IntegratorKind::collocation:
      return "collocation";
    case IntegratorKind::collocation_newton:
      return "collocation by Newton";
    case IntegratorKind::rosenbrock:
      return "rosenbrock";
    case IntegratorKind::runge_kutta:
      return "runge-kutta";
    case IntegratorKind::extrapolation:
      return "extrapolation";
  }
  return "unknown";
}

std::span<const IntegratorInfo> integrators() {
  static const std::vector<IntegratorInfo> list = all_integrators();
  return list;
}

const IntegratorInfo& find_integrator(std::string_view name) {
  std::string known;
  for (const IntegratorInfo& info : integrators()) {
    if (info.name == name) return info;
    known += (known.empty() ? "" : ", ") + info.name;
  }
  throw std::invalid_argument("no integrator '" + std::string(name) + "'; there are " + known);
}

}  // namespace ulpgate::ode
