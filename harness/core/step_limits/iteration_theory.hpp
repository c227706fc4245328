// Where fixed-point iteration of the stages of a Gauss method converges on the linear problem, from its
// matrix.
#pragma once

namespace ulpgate {

// Fixed-point iteration of the stages of the Gauss method of `stages` stages on y' = mu y, mu = iz or -z.
enum class Axis { imaginary, real };
// The spectral radius of a sweep in which each stage uses those already renewed.
[[nodiscard]] double sweep_radius(int stages, Axis axis, double z);
// The smallest z at which that radius reaches `radius`.
[[nodiscard]] double sweep_limit(int stages, Axis axis, double radius);
// 1/rho(A): where an iteration that renews all stages at once ceases to converge, on any axis.
[[nodiscard]] double jacobi_limit(int stages);

}  // namespace ulpgate
