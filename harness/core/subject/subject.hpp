// Subject: what is tested in one Real type, a math function or a kernel, behind one narrow interface.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "harness/core/arguments/argument_lists.hpp"
#include "harness/core/records/row_hint.hpp"
#include "reference/types/descriptor.hpp"

namespace ulpgate {

class BatchCode;

// Families of subjects: each has strata of its own and a file of records.
enum class SubjectKind { function, kernel };
[[nodiscard]] std::span<const StratumInfo> strata_of(SubjectKind kind);

struct SubjectInput {
  std::string name;  // "x1" of a kernel's state; empty where the place alone tells
  std::size_t components;
  std::string domain;  // name of the domain map; empty for a kernel's state
};
struct SubjectPart {
  std::string name;  // "value", "re", "im", "normal_force"
  std::size_t components;
};

struct SubjectInfo {
  SubjectKind kind;
  std::string name;            // "sin", "sphere_sphere"; no two subjects of a type share one
  std::string subject_class;   // "real", "complex", "special", "kernel"
  std::string implementation;  // the code that is tested, with its version: "glibc 2.36"
  std::vector<SubjectInput> inputs;
  std::vector<SubjectPart> parts;
  // The largest error in ULP that its authors promise over the whole domain, where they do: 0.5 for the
  // operations that IEEE 754 wants correctly rounded.
  std::optional<double> claimed_ulp;
  // Words that select the code, behind those of any command that names the subject; empty where it is built
  // in.
  std::string selection = {};
  // What is known of that code: path, SONAME, build-id, ...
  std::vector<std::pair<std::string, std::string>> code_facts = {};

  [[nodiscard]] std::size_t input_components() const;
};

// Everything known about one part of the result at one point.
struct PointPart {
  std::vector<std::string> got_hex;        // by component
  std::vector<std::string> got_decimal;    // by component
  std::vector<std::string> exact_decimal;  // 30 significant digits, or more where the type has more
  Judgement judgement;                     // of the worst component
  // |got - exact| / |exact| in units of 2^-p; of kernels alone.
  std::optional<double> normwise_error;
  double condition = 0;
};
struct Point {
  std::vector<std::string> args_hex;
  std::vector<std::string> args_decimal;
  std::vector<PointPart> parts;
};

// What a subject with other code is said to be.
struct CodeNames {
  std::string implementation;
  std::optional<double> claimed_ulp;
  std::string selection;
  std::vector<std::pair<std::string, std::string>> facts;
};

// A prepared batch of arguments: evaluates its first `count` points, so many times over, and returns the
// seconds that it took, of which waking another process is none.
using TimedBatch = std::function<double(std::size_t count, int rounds)>;

class Subject {
 public:
  // `type` outlives the subject.
  Subject(SubjectInfo info, const RealDescriptor& type) : info_(std::move(info)), type_(type) {}
  Subject(const Subject&) = delete;
  Subject& operator=(const Subject&) = delete;
  virtual ~Subject() = default;

  [[nodiscard]] const SubjectInfo& info() const { return info_; }
  [[nodiscard]] const std::string& name() const { return info_.name; }
  [[nodiscard]] const RealDescriptor& type() const { return type_; }

  // The points of a listed stratum that this subject has; worst cases are no list of its own.
  [[nodiscard]] virtual ArgumentList listed(Stratum s) const = 0;
  // Whether all values of the type can be its arguments.
  [[nodiscard]] virtual bool can_exhaust() const = 0;
  // How many arguments stand behind each sample of the stratum `narrow`; 0: it has no such samples.
  [[nodiscard]] virtual std::size_t narrow_arguments() const = 0;

  // Judges points first..last-1 of a row; one summary per part.  Throws ReferenceDisagreement.  A maximum
  // that `hint` shows to be below that of the row's other units may be missing from the summary.
  [[nodiscard]] virtual std::vector<Summary> evaluate(const StratumSource& source, std::uint64_t first,
                                                      std::uint64_t last, ReferenceMode mode,
                                                      RowHint& hint) const = 0;

  // The point with index k of a row, and the point at arguments given as exact values of the type.
  [[nodiscard]] virtual Point point(const StratumSource& source, std::uint64_t k) const = 0;
  [[nodiscard]] virtual Point point(const std::vector<MpfrValue>& args) const = 0;

  // The same subject with other code behind it, which is made for this type; null where it takes none.
  [[nodiscard]] virtual std::unique_ptr<Subject> with_code(const BatchCode& /*code*/,
                                                           const CodeNames& /*names*/) const {
    return nullptr;
  }

  // Uniform arguments of a function, typical states of a kernel.
  [[nodiscard]] virtual TimedBatch timed_batch(std::size_t count) const = 0;

 private:
  SubjectInfo info_;
  const RealDescriptor& type_;
};

}  // namespace ulpgate
