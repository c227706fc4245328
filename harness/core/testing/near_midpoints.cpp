// Search for results next to midpoints: local expansions, and multiples of a slope that come close to
// integers.
#include "harness/core/testing/near_midpoints.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "harness/core/arguments/random_words.hpp"
#include "reference/oracle/oracle.hpp"
#include "reference/types/rounding.hpp"

namespace ulpgate {

namespace {

constexpr auto nearest = MPFR_RNDN;
using Turn = unsigned __int128;  // a fraction of 1 in units of 2^-128, modulo 1
using SignedTurn = __int128;

constexpr double one_turn = 0x1p128;
// Points farther from what they were to be close to are dropped.
constexpr double greatest_distance = 0x1p-6;

long spacing_of(mpfr_srcptr x, const FloatFormat& format) {
  return std::max(binade(x), format.exponent_min) - (format.precision - 1);
}

Turn fraction_of(mpfr_srcptr x) {
  MpfrValue part(mpfr_get_prec(x));
  mpfr_frac(part, x, nearest);
  mpfr_mul_2si(part, part, 128, nearest);
  mpz_t z;
  mpz_init(z);
  mpfr_get_z(z, part, nearest);
  std::uint64_t words[3] = {};  // a fraction may be rounded up to 1
  mpz_export(words, nullptr, -1, sizeof words[0], 0, 0, z);
  const Turn size = (static_cast<Turn>(words[1]) << 64U) | words[0];
  const Turn turn = mpz_sgn(z) < 0 ? -size : size;
  mpz_clear(z);
  return turn;
}

// f(x + k u) is a + b k + c k^2 ULP of f(x), modulo 1.
struct Expansion {
  Turn a;
  Turn b;
  double c;
};

class Graph {
 public:
  Graph(const FunctionInfo& f, const FloatFormat& format) : function_(f), format_(format) {
    const long bits = format.precision + 128;
    argument_.emplace_back(format.precision + 64);
    value_.emplace_back(bits);
    for (MpfrValue* v : {&low_, &middle_, &high_}) mpfr_set_prec(*v, bits);
  }

  // Nothing where f has no ordinary values; `target` is subtracted from a.
  std::optional<Expansion> expand(mpfr_srcptr x, double target) {
    if (!evaluate(x, 0, middle_)) return std::nullopt;
    const long ulp = spacing_of(middle_, format_);
    const long reach_bits = format_.precision / 3;
    const long reach = 1L << reach_bits;
    if (!evaluate(x, -reach, low_) || !evaluate(x, reach, high_)) return std::nullopt;
    for (MpfrValue* v : {&low_, &middle_, &high_}) mpfr_mul_2si(*v, *v, -ulp, nearest);
    Expansion e{};
    mpfr_sub(value_[0], high_, low_, nearest);
    mpfr_div_2si(value_[0], value_[0], reach_bits + 1, nearest);
    e.b = fraction_of(value_[0]);
    mpfr_add(value_[0], high_, low_, nearest);
    mpfr_sub(value_[0], value_[0], middle_, nearest);
    mpfr_sub(value_[0], value_[0], middle_, nearest);
    e.c = std::ldexp(std::fabs(mpfr_get_d(value_[0], nearest)), -2 * static_cast<int>(reach_bits) - 1);
    mpfr_sub_d(middle_, middle_, target, nearest);
    e.a = fraction_of(middle_);
    return e;
  }

 private:
  bool evaluate(mpfr_srcptr x, long k, MpfrValue& out) {
    mpfr_set_si_2exp(argument_[0], k, spacing_of(x, format_), nearest);
    mpfr_add(argument_[0], argument_[0], x, nearest);
    exact_value(function_, argument_, value_);
    if (mpfr_regular_p(value_[0].get()) == 0 || binade(value_[0]) < format_.exponent_min ||
        binade(value_[0]) > format_.exponent_max)
      return false;
    mpfr_set(out, value_[0], nearest);
    return true;
  }

  const FunctionInfo& function_;
  FloatFormat format_;
  std::vector<MpfrValue> argument_;
  std::vector<MpfrValue> value_;
  MpfrValue low_, middle_, high_;
};

struct Step {
  long k;
  double left;  // of a + k b modulo 1
};

// k in [0, limit] for which a + k b is close to an integer.  Euclid's algorithm makes of b and 1 - b ever
// smaller turns forwards and backwards, which are multiples of b by ever larger numbers (the convergents and
// intermediate fractions of b); what is left of a is walked off with each of them in turn.
Step closest_multiple(Turn a, Turn b, long limit) {
  Turn forwards = b;
  Turn backwards = -b;
  Turn k_forwards = 1;
  Turn k_backwards = 1;
  Turn k = 0;
  auto left = static_cast<SignedTurn>(a);
  const auto most = static_cast<Turn>(limit);
  const auto walk_off = [&] {
    const Turn turn = left > 0 ? backwards : forwards;
    const Turn cost = left > 0 ? k_backwards : k_forwards;
    const Turn size = left > 0 ? static_cast<Turn>(left) : -static_cast<Turn>(left);
    Turn n = size / turn;
    if (size % turn > turn / 2) ++n;
    n = std::min(n, (most - k) / cost);
    k += n * cost;
    left = static_cast<SignedTurn>(static_cast<Turn>(left) + (left > 0 ? -n : n) * turn);
  };
  while (forwards != 0 && backwards != 0 && left != 0) {
    walk_off();
    const bool reduce_forwards = forwards > backwards;
    Turn& larger = reduce_forwards ? forwards : backwards;
    const Turn smaller = reduce_forwards ? backwards : forwards;
    Turn& k_larger = reduce_forwards ? k_forwards : k_backwards;
    const Turn k_smaller = reduce_forwards ? k_backwards : k_forwards;
    const Turn whole = (larger - 1) / smaller;
    const Turn n = std::min(whole, (most - k_larger) / k_smaller);
    if (n == 0) break;
    larger -= n * smaller;
    k_larger += n * k_smaller;
    if (n < whole) {
      walk_off();
      break;
    }
  }
  return {static_cast<long>(k), std::fabs(static_cast<double>(left)) / one_turn};
}

// A number of the domain next to which f may have ordinary values: half of them about 1, the others down to
// the roundoff, and some as far from 1.
void draw(mpfr_ptr x, const FunctionInfo& f, const FloatFormat& format, const RandomStream& stream,
          std::uint64_t k) {
  std::uint64_t words[4];
  stream.fill(k, 0, words);
  const bool about_one = (words[1] & 1U) != 0;
  const bool next_to_one = (words[1] & 6U) == 0;
  const long least = about_one ? -6 : -(format.precision + 3);
  const long greatest = about_one ? 9 : 0;
  const long e = least + static_cast<long>(words[2] % static_cast<std::uint64_t>(greatest - least + 1));
  MpfrValue m(128);
  mpfr_set_uj(m, words[0] | (std::uint64_t{1} << 63U), nearest);
  mpfr_mul_2si(m, m, 64, nearest);
  mpfr_add_d(m, m, static_cast<double>(words[3] >> 11U), nearest);
  mpfr_mul_2si(m, m, e - 127, nearest);
  if ((words[1] & 8U) != 0) mpfr_neg(m, m, nearest);
  const DomainMap map = f.domain[0];
  if (map == DomainMap::GT1) mpfr_abs(m, m, nearest);
  if (next_to_one || map == DomainMap::GT1) mpfr_add_ui(m, m, 1, nearest);
  if (map == DomainMap::GT0) mpfr_abs(m, m, nearest);
  mpfr_set(x, m, nearest);
  round_to_format(x, format);
}

void move(mpfr_ptr x, long k, const FloatFormat& format) {
  MpfrValue step(64);
  mpfr_set_si_2exp(step, k, spacing_of(x, format), nearest);
  mpfr_add(x, x, step, nearest);
}

long whole(double x, double most) {
  return static_cast<long>(std::clamp(x, 16.0, most));
}

// Moves x to where f is closer to `target`, 0 or 1/2, modulo 1; false where f has no ordinary values.
bool approach(mpfr_ptr x, Graph& graph, const FloatFormat& format, double target) {
  const double most = std::ldexp(1.0, static_cast<int>(std::min(44L, format.precision - 4)));
  for (int attempt = 0; attempt < 4; ++attempt) {
    const auto e = graph.expand(x, target);
    if (!e) return false;
    // From the middle of the window.
    const auto closest = [&](long half) {
      const Step step = closest_multiple(e->a - static_cast<Turn>(half) * e->b, e->b, 2 * half);
      return Step{step.k - half, step.left};
    };
    const long half = whole(std::cbrt(1 / (4 * e->c)), most);
    Step step = closest(half);
    // Where the slope is next to a simple fraction a window passes only little of a turn: there the way is
    // longer, and the curve asks for another look from its end.
    const bool far = step.left > 8 / static_cast<double>(half);
    if (far) step = closest(whole(std::sqrt(1 / (16 * e->c)), most));
    move(x, step.k, format);
    if (mpfr_regular_p(x) == 0) return false;
    if (!far) return true;
  }
  return true;
}

}  // namespace

NearMidpoint hardness_of(const FunctionInfo& f, const FloatFormat& format, mpfr_srcptr x) {
  const WideExponentRange wide;
  NearMidpoint point{MpfrValue(mpfr_get_prec(x)), 0, false};
  mpfr_set(point.argument, x, nearest);
  std::vector<MpfrValue> argument;
  argument.emplace_back(mpfr_get_prec(x));
  mpfr_set(argument[0], x, nearest);
  std::vector<MpfrValue> value;
  value.emplace_back(2 * format.precision + 160);
  exact_value(f, argument, value);
  MpfrValue& halves = value[0];
  if (mpfr_regular_p(halves.get()) == 0) return point;
  mpfr_mul_2si(halves, halves, 1 - spacing_of(halves, format), nearest);
  MpfrValue integer(mpfr_get_prec(halves));
  mpfr_rint(integer, halves, nearest);
  mpfr_sub(halves, halves, integer, nearest);
  point.distance_ulp = std::fabs(mpfr_get_d(halves, nearest)) / 2;
  mpfr_div_2ui(integer, integer, 1, nearest);
  point.midpoint = mpfr_integer_p(integer) == 0;
  return point;
}

std::vector<NearMidpoint> near_midpoints(const FunctionInfo& f, const FloatFormat& format, std::size_t count,
                                         std::uint64_t seed, int windows) {
  std::vector<NearMidpoint> points;
  if (f.function_class != FunctionClass::real || f.arity != 1 || f.id == FunctionId::logb) return points;
  const WideExponentRange wide;
  const RandomStream stream(seed, f.name, "near_midpoint");
  Graph graph(f, format);
  MpfrValue x(format.precision);
  std::optional<NearMidpoint> best;
  // Functions that have few such points, or none of the wanted kind in a window, must come to an end.
  const std::uint64_t most_draws = 8 * static_cast<std::uint64_t>(windows) * count;
  int looked = 0;
  for (std::uint64_t k = 0; k < most_draws && points.size() < count; ++k) {
    draw(x, f, format, stream, k);
    const double target = points.size() % 2 == 0 ? 0.5 : 0;
    if (mpfr_regular_p(x) == 0 || !approach(x, graph, format, target)) continue;
    NearMidpoint found = hardness_of(f, format, x);
    if (found.distance_ulp > 0 && found.distance_ulp < (best ? best->distance_ulp : greatest_distance))
      best = std::move(found);
    if (++looked < windows) continue;
    looked = 0;
    if (best) points.push_back(std::move(*best));
    best.reset();
  }
  return points;
}

}  // namespace ulpgate
