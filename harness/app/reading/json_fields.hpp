// Fields of JSON objects: which keys an object may have and what their values must be.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace ulpgate::app {

using Json = nlohmann::ordered_json;

// What a value must be: in words, and as a predicate.
struct FieldKind {
  std::string_view words;
  bool (*accepts)(const Json& value);
};

namespace field {
[[nodiscard]] bool is_text(const Json& j);
[[nodiscard]] bool is_word(const Json& j);
[[nodiscard]] bool is_name(const Json& j);
[[nodiscard]] bool is_hash(const Json& j);
[[nodiscard]] bool is_flag(const Json& j);
[[nodiscard]] bool is_count(const Json& j);
[[nodiscard]] bool is_positive(const Json& j);
[[nodiscard]] bool is_steps(const Json& j);
[[nodiscard]] bool is_number(const Json& j);
[[nodiscard]] bool is_size(const Json& j);
[[nodiscard]] bool is_object(const Json& j);
[[nodiscard]] bool are_texts(const Json& j);
[[nodiscard]] bool are_objects(const Json& j);

inline constexpr FieldKind text = {"a text", is_text};
inline constexpr FieldKind word = {"a text that is not empty", is_word};
// May become part of a file's name.
inline constexpr FieldKind name = {"a name without '/'", is_name};
// Of plans, states and checksums.
inline constexpr FieldKind hash = {"a text of 16 hexadecimal digits", is_hash};
inline constexpr FieldKind flag = {"true or false", is_flag};
inline constexpr FieldKind count = {"an integer from 0 on", is_count};
inline constexpr FieldKind positive = {"a finite number above 0", is_positive};
inline constexpr FieldKind steps = {"an integer from 1 on", is_steps};
// Null stands where there is none.
inline constexpr FieldKind number = {"a number, \"inf\", \"-inf\", \"nan\" or null", is_number};
inline constexpr FieldKind size = {"a number from 0 on, \"inf\", \"nan\" or null", is_size};
inline constexpr FieldKind object = {"an object", is_object};
inline constexpr FieldKind texts = {"a list of texts", are_texts};
inline constexpr FieldKind objects = {"a list of objects", are_objects};
}  // namespace field

enum class Presence { required, optional };

// As it stands in tables of fields.
inline constexpr auto optional = Presence::optional;

struct Field {
  std::string_view key;
  FieldKind kind;
  Presence presence = Presence::required;
};

// What a field of the kind `number` holds of it.
[[nodiscard]] inline Json number_or_null(const std::optional<double>& x) {
  return x ? Json(*x) : Json(nullptr);
}

enum class UnknownKeys { refuse, ignore };

// The object that `text` is.  Throws a Failure of bad_input that begins with `place` where it is none.
[[nodiscard]] Json parse_object(std::string_view text, const std::string& place);
// Throws a Failure of bad_input that names place and key unless every field is what it must be.
void check_fields(const Json& object, std::span<const Field> fields, UnknownKeys unknown,
                  const std::string& place);

}  // namespace ulpgate::app
