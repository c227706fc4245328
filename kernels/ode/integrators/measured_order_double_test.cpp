// Measured orders of all integrators in double.
#include "kernels/ode/testing/measured_order_suite.hpp"

namespace ulpgate::ode::testing {
namespace {

INSTANTIATE_TYPED_TEST_SUITE_P(Double, MeasuredOrder, double);

}  // namespace
}  // namespace ulpgate::ode::testing
