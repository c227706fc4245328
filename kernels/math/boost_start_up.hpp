// Keeps Boost.Math from computing values of the zeta function when the program starts.
#pragma once

#include <boost/math/special_functions/zeta.hpp>
#include <boost/multiprecision/number.hpp>
#include <boost/version.hpp>

// Boost.Math evaluates zeta once for every type before main, so that its static tables are there before
// threads start.  These Boosts keep a table for each thread, so that its first use is safe, and zeta(5) with
// 600 digits takes a tenth of a second in every process, even in one that prints its version.  Only the
// Boosts whose text was seen to be the same (1.81, 1.83, 1.88) and those between are told so; any other
// starts slowly, with the same results.
#if BOOST_VERSION >= 108100 && BOOST_VERSION < 108900
namespace boost::math::detail {

template <class Backend, boost::multiprecision::expression_template_option Expressions, class Policy,
          class Tag>
struct zeta_initializer<boost::multiprecision::number<Backend, Expressions>, Policy, Tag> {
  static void force_instantiate() {}
};

}  // namespace boost::math::detail
#endif
