// Tests of every formula in four types: verdicts as known, published outcomes, truths against closed forms.
#include "harness/core/formula_cases/formula_cases.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/gmp.hpp>
#include <set>

#include "harness/core/formula_cases/formula_engine_impl.hpp"
#include "harness/core/formula_cases/formula_judgement.hpp"

namespace ulpgate {
namespace {

const FormulaProblem& problem_of(std::string_view name) {
  const auto& all = formula_problems();
  const auto it = std::find_if(all.begin(), all.end(), [&](const auto& p) { return p.name == name; });
  EXPECT_NE(it, all.end()) << name;
  return *it;
}

const FormulaForm& form_of(const FormulaProblem& problem, std::string_view name) {
  const auto& all = problem.forms;
  const auto it = std::find_if(all.begin(), all.end(), [&](const auto& f) { return f.name == name; });
  EXPECT_NE(it, all.end()) << problem.name << ' ' << name;
  return *it;
}

template <RealType Real>
StressRow row_of(std::string_view problem, std::string_view form) {
  const auto& p = problem_of(problem);
  const FormulaEngineOf<Real> engine;
  const auto row = judge_formula(p, form_of(p, form), engine, {});
  EXPECT_TRUE(row) << problem << ' ' << form;
  return row.value_or(StressRow{});
}

double result_of(std::string_view problem, std::string_view form) {
  const auto row = row_of<double>(problem, form);
  return row.figures.contains("result") ? row.figures.at("result") : NAN;
}

template <RealType Real>
int expect_known_verdicts(std::string_view token) {
  const FormulaEngineOf<Real> engine;
  int measured = 0;
  for (const auto& problem : formula_problems()) {
    if (!exists_in(problem, token)) continue;
    for (const auto& form : problem.forms) {
      const auto row = judge_formula(problem, form, engine, {});
      if (!row) continue;
      ++measured;
      StressCase c;
      c.known = form.known;
      const auto standing = standing_of(c, token, *row);
      EXPECT_TRUE(standing.as_known) << problem.name << '/' << form.name << ' ' << token << ": "
                                     << to_string(row->verdict) << " instead of " << standing.expected
                                     << ", E " << row->error.value_or(-1) << ", kappa "
                                     << row->condition.value_or(-1);
      const bool good =
          row->verdict == StressVerdict::stable || row->verdict == StressVerdict::ill_conditioned;
      EXPECT_TRUE(good || !row->first_wrong.empty()) << problem.name << '/' << form.name;
      for (const auto& [name, value] : row->figures) EXPECT_TRUE(std::isfinite(value)) << name;
    }
  }
  return measured;
}

TEST(FormulaCases, VerdictsAreAsKnown) {
  EXPECT_EQ(expect_known_verdicts<float>("float"), 86) << "1e100 and 1e200 are no floats";
  EXPECT_EQ(expect_known_verdicts<double>("double"), 91);
#ifdef ULPGATE_HAVE_FLOAT128
  EXPECT_EQ(expect_known_verdicts<Float128Real>("float128"), 88)
      << "the harmonic sum is float's and double's";
#endif
  EXPECT_EQ(expect_known_verdicts<MpfrReal<62>>("mpfr62"), 88);
}

TEST(FormulaCases, EveryFormHasAProblemAndBack) {
  std::set<std::pair<std::string, std::string>> rows;
  for (const auto& f : formulas::named_forms<double>()) {
    EXPECT_TRUE(rows.emplace(f.problem, f.form).second) << f.problem << ' ' << f.form << " twice";
  }
  std::set<std::string> names;
  for (const auto& p : formula_problems()) {
    EXPECT_TRUE(names.insert(p.name).second) << p.name << " twice";
    EXPECT_FALSE(p.title.empty() || p.at.empty()) << p.name;
    for (const auto& f : p.forms) {
      EXPECT_EQ(rows.erase({p.name, f.name}), 1U) << p.name << ' ' << f.name << " is missing in forms.def";
      if (!f.stall_form.empty()) {
        EXPECT_EQ(rows.erase({p.name, f.stall_form}), 1U) << p.name << ' ' << f.stall_form;
      }
      for (const auto& k : f.known) EXPECT_FALSE(k.cause.empty()) << p.name << ' ' << f.name;
    }
  }
  for (const auto& [problem, form] : rows)
    ADD_FAILURE() << problem << ' ' << form << " belongs to no problem";
  std::size_t forms = 0;
  for (const auto& p : formula_problems()) forms += p.forms.size();
  EXPECT_EQ(formula_cases().size(), forms);
}

TEST(FormulaCases, PublishedOutcomesInDouble) {
  struct Published {
    const char* problem;
    const char* form;
    double result;
    double within;  // relative: the digits that were published
  };
  const Published table[] = {
      {"rump_1988", "original_order", -1.1805916207174113e21, 1e-15},
      {"rump_1988", "reordered", 1.1726039400531787, 1e-15},
      {"rump_1983", "expanded", 2, 0},
      {"rump_1983", "factored", 1, 0},
      {"muller", "recurrence", 100, 1e-12},
      {"muller", "closed_form", 6.0056486887714202, 1e-15},
      {"bank_account", "forward", 1201807247.4104486, 1e-15},
      {"bank_account", "backward", 0.039938729673230207, 1e-15},
      {"roots_then_squares", "naive", 1, 0},
      {"kahans_monster", "naive", 0, 0},
      {"kahans_monster", "expm1", 1, 0},
      {"one_minus_cosine", "naive", 0.7709882115452477, 1e-15},
      {"one_minus_cosine", "half_angle", 0.5, 1e-15},
      {"exponential_quotient", "naive", 1.1102230246251565, 1e-15},
      {"quadratic_small_root", "naive", 7.450580596923828e-9, 1e-15},
      {"quadratic_small_root", "stable", 1e-8, 1e-15},
      {"variance_1e9", "one_pass", -512.0 / 3, 1e-15},
      {"variance_1e9", "two_pass", 30, 0},
      {"small_angle", "arc_cosine", 0, 0},
      {"small_angle", "arc_tangent", 1e-8, 1e-15},
      {"log_of_one_plus", "naive", 0, 0},
      {"big_pair_1e100", "naive", 0, 0},
      {"big_pair_1e100", "kahan", 0, 0},
      {"big_pair_1e100", "neumaier", 2, 0},
      {"wilkinson_root_14", "product", 14, 0},
  };
  for (const auto& t : table) {
    const double got = result_of(t.problem, t.form);
    EXPECT_LE(std::abs(got - t.result), t.within * std::abs(t.result))
        << t.problem << '/' << t.form << ' ' << got;
  }
  EXPECT_EQ(row_of<double>("hypot_1e200", "naive").verdict, StressVerdict::diverged);
  EXPECT_EQ(row_of<double>("log_sum_exp_1000", "naive").verdict, StressVerdict::diverged);
}

TEST(FormulaCases, ConditionIsOfTheProblem) {
  EXPECT_NEAR(row_of<double>("rump_1988", "reordered").condition.value(), 3.8e37, 0.05e37);
  EXPECT_NEAR(row_of<double>("wilkinson_root_14", "product").condition.value(), 5.4e13, 0.05e13);
  EXPECT_NEAR(row_of<double>("big_pair_1e100", "naive").condition.value(), 1e100, 1e88);
  // 25! (e - 1) / a_25
  EXPECT_NEAR(row_of<double>("bank_account", "forward").condition.value(), 6.67e26, 0.01e26);
  EXPECT_EQ(row_of<double>("quadratic_small_root", "naive").condition.value(),
            row_of<double>("quadratic_small_root", "stable").condition.value());
  // 60 steps of 1 bit, times what the last angle makes of it
  const double chaos = row_of<double>("logistic_map", "recurrence").condition.value();
  EXPECT_GT(chaos, 0x1p53);
  EXPECT_LT(chaos, 0x1p64);
}

TEST(FormulaCases, FloatsHarmonicSumStalls) {
  const auto row = row_of<float>("harmonic_sum", "naive");
  EXPECT_EQ(row.figures.at("stalls_at"), 2097152);
  EXPECT_EQ(row.first_wrong, "n = 2097152, where it stalls");
  EXPECT_FALSE(row_of<double>("harmonic_sum", "naive").figures.contains("stalls_at"));
}

TEST(FormulaCases, FirstWrongIsWhereConditionNoLongerExplains) {
  // Of the half angle nothing goes wrong; the naive form is good at 1 and lost before 2^-14, its sqrt u.
  EXPECT_EQ(row_of<float>("one_minus_cosine", "half_angle").first_wrong, "");
  EXPECT_EQ(row_of<double>("one_minus_cosine", "naive").first_wrong, "x = 2^-3");
  EXPECT_EQ(row_of<double>("roots_then_squares", "naive").first_wrong, "n = 5");
}

TEST(FormulaCases, AgreeingTypesDoNotFool) {
#ifdef ULPGATE_HAVE_FLOAT128
  // float and float128, its RealHP<4>, agree on 1.1726; nothing of that is right.
  const auto rump = row_of<float>("rump_1988", "reordered");
  EXPECT_NEAR(rump.figures.at("result"), 1.1726, 1e-4);
  EXPECT_EQ(rump.figures.at("agreement_misleads"), 1);
  EXPECT_EQ(rump.figures.at("perturbed_evaluation_differs"), 1);
  EXPECT_EQ(rump.verdict, StressVerdict::ill_conditioned);
  EXPECT_GT(rump.error.value(), 1);
  EXPECT_FALSE(rump.why.empty());
#endif
  const auto monster = row_of<MpfrReal<62>>("kahans_monster", "naive");
  EXPECT_EQ(monster.figures.at("reference_error"), 1) << "0 in 248 digits as well";
  EXPECT_EQ(monster.figures.at("agreement_misleads"), 1);
  EXPECT_EQ(monster.verdict, StressVerdict::unstable);
  EXPECT_FALSE(monster.why.empty());
  EXPECT_EQ(row_of<double>("quadratic_small_root", "stable").figures.at("agreement_misleads"), 0);
}

// As an exact rational.
mp::mpq_rational exact(const FormulaNumber& x) {
  mp::mpq_rational q;
  mpfr_get_q(q.backend().data(), x.backend().data());
  return q;
}

TEST(FormulaTruths, AreClosedFormsAndRationals) {
  const WideExponentRange wide;
  const FloatFormat format = float_format<MpfrReal<150>>();
  const auto truth = [&](std::string_view name) {
    const auto& p = problem_of(name);
    return p.truth(p.input(format)).front();
  };
  EXPECT_EQ(truth("rump_1988"), FormulaNumber(-54767) / 66192);
  EXPECT_EQ(truth("rump_1983"), 1);
  EXPECT_EQ(truth("wilkinson_root_14"), 14);
  EXPECT_EQ(truth("big_pair_1e100"), 2);
  EXPECT_EQ(truth("variance_1e9"), 30);
  const FormulaNumber tiny = power_of_two(-2000);
  // Muller's recurrence in rationals
  mp::mpq_rational before = 2;
  mp::mpq_rational u = -4;
  for (int k = 1; k < 30; ++k) {
    const mp::mpq_rational next = 111 - 1130 / u + 3000 / (u * before);
    before = u;
    u = next;
  }
  EXPECT_LT(abs(exact(truth("muller")) - u), exact(tiny));
  // a_25 = 1/26 + 1/(26 27) + ...
  mp::mpq_rational sum = 0;
  mp::mpq_rational term = 1;
  for (int k = 26; k < 500; ++k) sum += (term /= k);
  EXPECT_LT(abs(exact(truth("bank_account")) - sum), exact(tiny));
  // four steps of the logistic map in rationals
  mp::mpq_rational x(1, 8);
  for (int k = 0; k < 4; ++k) x = 4 * x * (1 - x);
  const auto map = problem_of("logistic_map").truth({{number("0.125")}, 4}).front();
  EXPECT_LT(abs(exact(map) - x), exact(tiny));
  mp::mpq_rational harmonic = 0;
  for (int k = 1; k <= 100; ++k) harmonic += mp::mpq_rational(1, k);
  EXPECT_LT(abs(exact(problem_of("harmonic_sum").truth({{}, 100}).front()) - harmonic), exact(tiny));
  // A triangle with sides 3, 4, 5, and an angle whose tangent is 1e-8
  EXPECT_LT(abs(problem_of("triangle_area").truth({{3, 4, 5}, 0}).front() - 6), tiny);
  EXPECT_LT(abs(truth("small_angle") - atan(number("1e-8"))), tiny);
}

TEST(FormulaJudgement, ErrorsByNorm) {
  const FormulaNumbers truth{FormulaNumber(4), FormulaNumber(1)};
  const FormulaNumbers value{FormulaNumber(4), FormulaNumber(2)};
  EXPECT_EQ(formula_error(value, truth, FormulaNorm::largest), 0.25);
  EXPECT_EQ(formula_error(value, truth, FormulaNorm::each), 1);
  EXPECT_EQ(formula_error(value, truth, FormulaNorm::signs), 0.5);
  const FormulaNumbers nan{FormulaNumber(4), std::numeric_limits<FormulaNumber>::quiet_NaN()};
  EXPECT_TRUE(std::isinf(formula_error(nan, truth, FormulaNorm::largest)));
  EXPECT_TRUE(std::isinf(formula_error({FormulaNumber(4)}, truth, FormulaNorm::largest)))
      << "a part is missing";
}

TEST(FormulaJudgement, UnknownFormsAndStopsAreErrors) {
  const FormulaEngineOf<double> engine;
  const auto& problem = problem_of("muller");
  EXPECT_THROW(static_cast<void>(judge_formula(problem, {"no_such_form"}, engine, {})),
               std::invalid_argument);
  const std::atomic<bool> raised(true);
  EXPECT_THROW(static_cast<void>(judge_formula(problem, problem.forms[0], engine, ode::StopFlag(raised))),
               ode::Stopped);
}

TEST(FormulaEngine, ArgumentsOutOfRangeAreNoArguments) {
  const FormulaEngineOf<float> engine;
  EXPECT_FALSE(engine.rounded({{number("1e200")}, 0})) << "overflows";
  EXPECT_FALSE(engine.rounded({{number("1e-200")}, 0})) << "becomes 0";
  EXPECT_TRUE(engine.rounded({{number("0")}, 0}));
  EXPECT_EQ(engine.rounded({{number("0.1")}, 0})->x[0], FormulaNumber(0.1F));
  const FormulaEngineOf<MpfrReal<300>> wide;
  EXPECT_FALSE(wide.rounded({{number("1")}, 0})) << "no truth of twice the digits";
}

}  // namespace
}  // namespace ulpgate
