// Fields of JSON objects.
#include "harness/app/reading/json_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/app/shell/failure.hpp"

namespace ulpgate::app {

namespace field {

bool is_text(const Json& j) {
  return j.is_string();
}
bool is_word(const Json& j) {
  return j.is_string() && !j.get_ref<const std::string&>().empty();
}
bool is_name(const Json& j) {
  return is_word(j) && j.get_ref<const std::string&>().find('/') == std::string::npos;
}
bool is_hash(const Json& j) {
  if (!j.is_string()) return false;
  const auto& text = j.get_ref<const std::string&>();
  return text.size() == 16 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}
bool is_flag(const Json& j) {
  return j.is_boolean();
}
bool is_count(const Json& j) {
  return j.is_number_unsigned();
}
bool is_positive(const Json& j) {
  return j.is_number() && std::isfinite(j.get<double>()) && j.get<double>() > 0;
}
bool is_steps(const Json& j) {
  return j.is_number_unsigned() && j.get<std::uint64_t>() > 0;
}
bool is_number(const Json& j) {
  return j.is_null() || j.is_number() || j == "inf" || j == "-inf" || j == "nan";
}
bool is_size(const Json& j) {
  return is_number(j) && j != "-inf" && !(j.is_number() && j.get<double>() < 0);
}
bool are_texts(const Json& j) {
  return j.is_array() && std::ranges::all_of(j, is_text);
}
bool is_object(const Json& j) {
  return j.is_object();
}
bool are_objects(const Json& j) {
  return j.is_array() && std::ranges::all_of(j, is_object);
}

}  // namespace field

namespace {

// A long or deep value says nothing in a message: its type does.
std::string shown(const Json& value) {
  constexpr std::size_t longest = 60;
  if (value.is_structured()) return value.is_array() ? "a list" : "an object";
  const std::string text = value.dump();
  return text.size() > longest ? "a long text" : text;
}

}  // namespace

Json parse_object(std::string_view text, const std::string& place) {
  Json value;
  try {
    value = Json::parse(text);
  } catch (const Json::exception& e) {
    throw Failure(Standing::bad_input, fmt::format("{}: not JSON: {}", place, e.what()));
  }
  if (!value.is_object())
    throw Failure(Standing::bad_input, fmt::format("{}: {}, not an object", place, shown(value)));
  return value;
}

void check_fields(const Json& object, std::span<const Field> fields, UnknownKeys unknown,
                  const std::string& place) {
  for (const auto& f : fields) {
    const auto it = object.find(f.key);
    if (it == object.end()) {
      if (f.presence == Presence::optional) continue;
      throw Failure(Standing::bad_input, fmt::format("{}: '{}' is missing", place, f.key));
    }
    if (!f.kind.accepts(*it)) {
      throw Failure(Standing::bad_input,
                    fmt::format("{}: '{}' is {}, not {}", place, f.key, shown(*it), f.kind.words));
    }
  }
  if (unknown == UnknownKeys::ignore) return;
  for (const auto& [key, value] : object.items()) {
    if (std::ranges::find(fields, std::string_view(key), &Field::key) == fields.end())
      throw Failure(Standing::bad_input, fmt::format("{}: unknown key '{}'", place, key));
  }
}

}  // namespace ulpgate::app
