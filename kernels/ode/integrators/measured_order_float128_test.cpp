// Measured orders of all integrators in float128.
#include "kernels/ode/testing/measured_order_suite.hpp"

#ifdef ULPGATE_HAVE_FLOAT128
namespace ulpgate::ode::testing {
namespace {

INSTANTIATE_TYPED_TEST_SUITE_P(Float128, MeasuredOrder, Float128Real);

}  // namespace
}  // namespace ulpgate::ode::testing
#endif
