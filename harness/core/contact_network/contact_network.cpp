// Mass, stiffness and viscosity matrices of contacts and their critical steps.
#include "harness/core/contact_network/contact_network.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <stdexcept>

#include "reference/text/text.hpp"

namespace ulpgate {

namespace {

using Matrix = Eigen::MatrixXd;
using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;

Matrix3 cross_matrix(const Vector3& n) {
  Matrix3 m;
  m << 0, -n.z(), n.y(), n.z(), 0, -n.x(), -n.y(), n.x(), 0;
  return m;
}

// Velocity at the contact of body 2 against body 1, from the six of one end, scaled by the roots of mass and
// inertia: v - r w x n = v + r n x w.
Eigen::Matrix<double, 3, 6> end_of(const NetworkBody& body, const Vector3& normal, double arm, double sign) {
  Eigen::Matrix<double, 3, 6> b;
  b.setZero();
  b.leftCols<3>() = sign * Matrix3::Identity() / std::sqrt(body.mass);
  if (body.inertia > 0) b.rightCols<3>() = arm * cross_matrix(normal) / std::sqrt(body.inertia);
  return b;
}

struct Scaled {
  Matrix stiffness;  // M^-1/2 K M^-1/2
  Matrix viscosity;  // M^-1/2 C M^-1/2
};

Scaled scaled(const ContactNetwork& network) {
  const auto size = static_cast<Eigen::Index>(6 * network.bodies.size());
  Scaled s{Matrix::Zero(size, size), Matrix::Zero(size, size)};
  for (const NetworkSpring& spring : network.springs) {
    const Vector3 n(spring.normal[0], spring.normal[1], spring.normal[2]);
    const Matrix3 along = n * n.transpose();
    const Matrix3 across = Matrix3::Identity() - along;
    const Matrix3 k = spring.kn * along + spring.ks * across;
    const Matrix3 c = spring.cn * along + spring.cs * across;
    struct End {
      Eigen::Index at;
      Eigen::Matrix<double, 3, 6> b;
      double turn;  // of the end against the other, scaled by the root of its inertia
    };
    std::vector<End> ends;
    const auto add_end = [&](std::size_t i, double arm, double sign) {
      const NetworkBody& body = network.bodies[i];
      if (body.fixed) return;
      const double turn = body.inertia > 0 ? sign / std::sqrt(body.inertia) : 0;
      ends.push_back({static_cast<Eigen::Index>(6 * i), end_of(body, n, arm, sign), turn});
    };
    add_end(spring.first, spring.arm1, -1);
    add_end(spring.second, spring.arm2, 1);
    for (const End& a : ends) {
      for (const End& b : ends) {
        s.stiffness.block<6, 6>(a.at, b.at) += a.b.transpose() * k * b.b;
        s.stiffness.block<3, 3>(a.at + 3, b.at + 3) += spring.moment * a.turn * b.turn * Matrix3::Identity();
        s.viscosity.block<6, 6>(a.at, b.at) += a.b.transpose() * c * b.b;
      }
    }
  }
  return s;
}

double largest_eigenvalue(const Matrix& m) {
  return m.size() == 0
             ? 0
             : Eigen::SelfAdjointEigenSolver<Matrix>(m, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

double from_hexfloat(const std::string& hexfloat) {
  return parse_real<double>(hexfloat);
}

}  // namespace

ContactNetwork network_of(const dem::DemEngine& engine, scenes::ContactLaw law,
                          const std::vector<std::array<int, 2>>& walls) {
  ContactNetwork network;
  std::vector<int> wall_of;
  int wall = 0;
  for (std::size_t i = 0; i < engine.bodies(); ++i) {
    const double m = engine.mass(i);
    const double r = engine.radius(i);
    network.bodies.push_back({engine.is_fixed(i), m, engine.explain().rotation ? 2 * m * r * r / 5 : 0});
    wall_of.push_back(engine.shape(i) == scenes::Shape::wall ? wall++ : -1);
  }
  const auto centre = [&](std::size_t i) {
    return Vector3(engine.approximate(dem::BodyQuantity::position, i, 0),
                   engine.approximate(dem::BodyQuantity::position, i, 1),
                   engine.approximate(dem::BodyQuantity::position, i, 2));
  };
  for (const dem::BodyPair& pair : engine.contacts()) {
    auto i = static_cast<std::size_t>(pair.first);
    auto j = static_cast<std::size_t>(pair.second);
    if (wall_of[j] >= 0) std::swap(i, j);
    Vector3 n = Vector3::Zero();
    double overlap = 0;
    if (wall_of[i] >= 0) {
      const auto& [axis, direction] = walls.at(static_cast<std::size_t>(wall_of[i]));
      n[axis] = direction;
      overlap = engine.radius(j) - direction * (centre(j)[axis] - centre(i)[axis]);
    } else {
      n = centre(j) - centre(i);
      overlap = engine.radius(i) + engine.radius(j) - n.norm();
      n.normalize();
    }
    const std::vector<std::string> constants = engine.contact_constants(pair);
    if (constants.size() != 4) throw std::logic_error("a contact without constants");
    const double half = overlap / 2;
    const bool hertz = law == scenes::ContactLaw::hertz_mindlin;
    const double root = hertz ? std::sqrt(std::fmax(overlap, 0.0)) : 1;
    network.springs.push_back({i,
                               j,
                               {n.x(), n.y(), n.z()},
                               wall_of[i] >= 0 ? 0 : engine.radius(i) - half,
                               engine.radius(j) - half,
                               from_hexfloat(constants[0]) * (hertz ? 1.5 * root : 1),
                               from_hexfloat(constants[1]) * root,
                               from_hexfloat(constants[2]),
                               from_hexfloat(constants[3])});
  }
  return network;
}

double largest_frequency(const ContactNetwork& network) {
  return std::sqrt(std::fmax(0.0, largest_eigenvalue(scaled(network).stiffness)));
}

double undamped_critical_step(const ContactNetwork& network) {
  const double omega = largest_frequency(network);
  return omega > 0 ? 2 / omega : 0;
}

CriticalMode critical_mode(const ContactNetwork& network) {
  const Scaled s = scaled(network);
  const double square = largest_eigenvalue(s.stiffness);
  if (!(square > 0)) return {};
  const Matrix identity = Matrix::Identity(s.stiffness.rows(), s.stiffness.cols());
  const auto tested = [&](double h) -> Matrix {
    return 4 * identity - 2 * h * s.viscosity - h * h * s.stiffness;
  };
  // Definite at 0, no longer above 2/omega_max, and each factor of h falls: one crossing.
  double stable = 0;
  double unstable = 2 / std::sqrt(square) * (1 + 1e-12);
  if (s.viscosity.isZero(0)) stable = unstable * (1 - 1e-11);
  while (unstable - stable > 1e-12 * unstable) {
    const double h = (stable + unstable) / 2;
    (Eigen::LLT<Matrix>(tested(h)).info() == Eigen::Success ? stable : unstable) = h;
  }
  CriticalMode mode{stable, {}};
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(tested(stable));
  Eigen::Index least = 0;
  (void)solver.eigenvalues().minCoeff(&least);
  const Eigen::VectorXd vector =
      solver.eigenvectors().col(least) / solver.eigenvectors().col(least).cwiseAbs().maxCoeff();
  for (std::size_t i = 0; i < network.bodies.size(); ++i) {
    const NetworkBody& body = network.bodies[i];
    std::array<double, 6> of_body{};
    for (std::size_t d = 0; d < 6 && !body.fixed; ++d) {
      const double scale = d < 3 ? 1 : body.inertia > 0 ? std::sqrt(body.mass / body.inertia) : 0;
      of_body[d] = vector[static_cast<Eigen::Index>(6 * i + d)] * scale;
    }
    mode.shape.push_back(of_body);
  }
  return mode;
}

double block_bound_step(const ContactNetwork& network) {
  const Scaled s = scaled(network);
  double least = 0;
  for (Eigen::Index i = 0; i < s.stiffness.rows(); i += 6) {
    const double k = 2 * largest_eigenvalue(s.stiffness.block(i, i, 6, 6));
    const double c = 2 * largest_eigenvalue(s.viscosity.block(i, i, 6, 6));
    if (!(k > 0)) continue;
    const double step = 4 / (c + std::sqrt(c * c + 4 * k));
    if (least == 0 || step < least) least = step;
  }
  return least;
}

}  // namespace ulpgate
