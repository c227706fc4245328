// Assembling and solving the vibrations of contacts.
#include "harness/core/scene_cases/network_vibrations.hpp"

#include <cmath>
#include <cstdlib>

namespace ulpgate {

namespace {

using dem::BodyQuantity;

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& a) {
  Eigen::Matrix3d m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

Eigen::Vector3d position_of(const dem::DemEngine& e, std::size_t i) {
  return {e.approximate(BodyQuantity::position, i, 0), e.approximate(BodyQuantity::position, i, 1),
          e.approximate(BodyQuantity::position, i, 2)};
}

}  // namespace

NetworkVibrations::NetworkVibrations(const dem::DemEngine& engine, const std::vector<ContactSpring>& springs,
                                     bool rotation) {
  const Eigen::Index each = rotation ? 6 : 3;
  std::vector<Eigen::Index> at(engine.bodies(), -1);
  Eigen::Index size = 0;
  for (std::size_t i = 0; i < engine.bodies(); ++i) {
    if (engine.is_fixed(i) || engine.shape(i) != scenes::Shape::sphere) continue;
    at[i] = size;
    size += each;
  }
  mass_ = Eigen::VectorXd::Zero(size);
  stiffness_ = Eigen::MatrixXd::Zero(size, size);
  damping_ = stiffness_;
  for (std::size_t i = 0; i < engine.bodies(); ++i) {
    if (at[i] < 0) continue;
    mass_.segment(at[i], 3).setConstant(engine.mass(i));
    if (rotation)
      mass_.segment(at[i] + 3, 3).setConstant(0.4 * engine.mass(i) * engine.radius(i) * engine.radius(i));
  }
  for (const ContactSpring& s : springs) {
    Eigen::MatrixXd relative = Eigen::MatrixXd::Zero(3, size);
    Eigen::MatrixXd turned = Eigen::MatrixXd::Zero(3, size);
    for (const auto& [body, sign] : {std::pair(s.first, -1.0), std::pair(s.second, 1.0)}) {
      if (at[body] < 0) continue;
      relative.block(0, at[body], 3, 3) += sign * Eigen::Matrix3d::Identity();
      if (!rotation) continue;
      // -r (t x n) = r [n] t, the same sign for both bodies.
      relative.block(0, at[body] + 3, 3, 3) += engine.radius(body) * cross_matrix(s.normal);
      turned.block(0, at[body] + 3, 3, 3) += sign * Eigen::Matrix3d::Identity();
    }
    const Eigen::Matrix3d along = s.normal * s.normal.transpose();
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - along;
    stiffness_ += relative.transpose() * (s.kn * along + s.ks * across) * relative;
    stiffness_ += s.moment * turned.transpose() * turned;
    damping_ += relative.transpose() * (s.cn * along + s.cs * across) * relative;
  }
}

double NetworkVibrations::largest_frequency() const {
  if (mass_.size() == 0) return 0;
  const Eigen::VectorXd root = mass_.array().sqrt().inverse().matrix();
  const Eigen::MatrixXd scaled = root.asDiagonal() * stiffness_ * root.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scaled, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, solver.eigenvalues().maxCoeff()));
}

double NetworkVibrations::largest_stable_step() const {
  const Eigen::Index n = mass_.size();
  const Eigen::VectorXd root = mass_.array().sqrt().inverse().matrix();
  const Eigen::MatrixXd k = root.asDiagonal() * stiffness_ * root.asDiagonal();
  const Eigen::MatrixXd c = root.asDiagonal() * damping_ * root.asDiagonal();
  const auto grows = [&](double dt) {
    Eigen::MatrixXd step(2 * n, 2 * n);
    const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(n, n);
    step << one - dt * dt * k, dt * (one - dt * c), -dt * k, one - dt * c;
    // Free motions are double roots of 1, which rounding splits by its square root.
    return step.eigenvalues().cwiseAbs().maxCoeff() > 1 + 1e-6;
  };
  double low = 0;
  double high = 4 / largest_frequency();
  for (int i = 0; i < 50; ++i) {
    const double middle = (low + high) / 2;
    (grows(middle) ? high : low) = middle;
  }
  return low;
}

std::vector<ContactSpring> linear_springs(const dem::DemEngine& engine, int wall_axis) {
  std::vector<ContactSpring> springs;
  for (const auto& pair : engine.contacts()) {
    auto first = static_cast<std::size_t>(pair.first);
    auto second = static_cast<std::size_t>(pair.second);
    if (engine.shape(second) != scenes::Shape::sphere) std::swap(first, second);
    Eigen::Vector3d normal = Eigen::Vector3d::Unit(wall_axis);
    if (engine.shape(first) == scenes::Shape::sphere)
      normal = (position_of(engine, second) - position_of(engine, first)).normalized();
    const auto text = engine.contact_constants(pair);
    const auto number = [&](std::size_t i) { return std::strtod(text[i].c_str(), nullptr); };
    springs.push_back({first, second, normal, number(0), number(1), number(2), number(3)});
  }
  return springs;
}

}  // namespace ulpgate
