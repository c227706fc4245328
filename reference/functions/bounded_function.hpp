// BoundedFunction<W>: a function at many points in W, with a bound of each error.
#pragma once

#include <cstddef>

namespace ulpgate {

#ifdef ULPGATE_HAVE_FLOAT128
using Binary128 = __float128;
#endif

// Evaluates f at `count` points: args holds count * arity values.  |results[i] - f(args of i)| is at most
// bounds[i] ulp of results[i] in W, wherever results[i] is a normal number of W; a negative bound says that
// nothing is known.  Otherwise a NaN says that f is not defined there, an infinity that it has a pole or
// exceeds W, a zero that f is zero or less than W's least normal number.  `argument_bits`: the arguments have
// no more significant bits than that, which makes some operations exact.
template <class W>
using BoundedFunction = void (*)(const W* args, W* results, double* bounds, std::size_t count,
                                 int argument_bits);

}  // namespace ulpgate
