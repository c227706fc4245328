// Archives: the state of a simulation as exact text, one named field a line, written and read by the same
// visit.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "kernels/dem/formulas/vec3.hpp"
#include "reference/text/text.hpp"

namespace ulpgate::dem {

// A text that is no state of this simulation; what() names the field.
struct ArchiveError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

template <RealType Real>
class ArchiveWriter {
 public:
  static constexpr bool reading = false;

  template <class T>
  void field(const char* name, const T& value) {
    text_ += name;
    put(value);
    text_ += '\n';
  }
  template <class T>
  void constant(const char* name, const T& value) {
    field(name, value);
  }
  [[nodiscard]] std::string text() && { return std::move(text_); }

 private:
  void put(const Real& x) { text_ += ' ' + to_hexfloat(x); }
  template <std::integral I>
  void put(I x) {
    text_ += ' ' + std::to_string(x);
  }
  void put(const Vec3<Real>& v) {
    put(v.x);
    put(v.y);
    put(v.z);
  }
  void put(const Quaternion<Real>& q) {
    put(q.w);
    put(q.x);
    put(q.y);
    put(q.z);
  }
  template <class T>
  void put(const std::vector<T>& list) {
    put(list.size());
    for (const T& x : list) put(x);
  }

  std::string text_;
};

// Reads what a writer of the same or of a lower precision wrote: every value is widened exactly.
template <RealType Real>
class ArchiveReader {
 public:
  static constexpr bool reading = true;

  // Without `take_constants` the reader's own constants (masses, stiffnesses, dt ...) stay as they are.
  ArchiveReader(std::string_view text, bool take_constants) : text_(text), take_constants_(take_constants) {}

  template <class T>
  void field(const char* name, T& value) {
    const std::string_view found = token();
    if (found != name)
      throw ArchiveError("expected the field '" + std::string(name) + "', found '" + std::string(found) +
                         "'");
    get(value);
  }
  template <class T>
  void constant(const char* name, T& value) {
    if (take_constants_) return field(name, value);
    T ignored = value;
    field(name, ignored);
  }
  [[nodiscard]] bool at_end() {
    skip();
    return at_ == text_.size();
  }

 private:
  void skip() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\n')) ++at_;
  }
  std::string_view token() {
    skip();
    const std::size_t begin = at_;
    while (at_ < text_.size() && text_[at_] != ' ' && text_[at_] != '\n') ++at_;
    return text_.substr(begin, at_ - begin);
  }
  void get(Real& x) {
    try {
      x = parse_real<Real>(token());
    } catch (const std::invalid_argument& e) {
      throw ArchiveError(e.what());
    }
  }
  template <std::integral I>
  void get(I& x) {
    const std::string word(token());
    char* end = nullptr;
    const long long value = std::strtoll(word.c_str(), &end, 10);
    if (word.empty() || *end != '\0') throw ArchiveError("not an integer: '" + word + "'");
    x = static_cast<I>(value);
  }
  void get(Vec3<Real>& v) {
    get(v.x);
    get(v.y);
    get(v.z);
  }
  void get(Quaternion<Real>& q) {
    get(q.w);
    get(q.x);
    get(q.y);
    get(q.z);
  }
  template <class T>
  void get(std::vector<T>& list) {
    std::size_t size = 0;
    get(size);
    if (size > text_.size()) throw ArchiveError("a list is longer than the text");
    list.resize(size);
    for (T& x : list) get(x);
  }

  std::string_view text_;
  std::size_t at_ = 0;
  bool take_constants_;
};

}  // namespace ulpgate::dem
