// Why a request is refused. The message refers to fields by member, so the code that sets them can call them by other names.
#pragma once

#include <concepts>
#include <cstddef>
#include <functional>
#include <source_location>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/base/expect.h"

namespace dmpc::core {

/// A member of a struct. Two fields are equal if they are the same member of the same struct.
class Field {
 public:
  /// `path` must live as long as the program: "dmpc::svm::PageOptions::work_donor".
  constexpr explicit Field(std::string_view path) : path_(path) {}
  /// "work_donor".
  constexpr std::string_view name() const { return path_.substr(path_.rfind(':') + 1); }
  constexpr bool operator==(const Field&) const = default;

 private:
  std::string_view path_;
};

/// field_of<&svm::PageOptions::work_donor>() gets the member's name from the compiler.
template <auto Member>
consteval Field field_of() {
  const std::string_view function = std::source_location::current().function_name();  // "... [with auto Member = &...; ...]"
  const std::size_t first = function.find('&') + 1;
  return Field(function.substr(first, function.find_first_of(";]", first) - first));
}

/// A sequence of words, whole numbers and fields.
class Sentence {
 public:
  using FieldNames = std::function<std::string_view(const Field&)>;

  template <class... Parts>
  explicit Sentence(const Parts&... parts) {
    add(parts...);
  }
  template <class... Parts>
  void add(const Parts&... parts) {
    (add_part(parts), ...);
  }
  /// The text, with field names from `name_of`.
  std::string text(const FieldNames& name_of = &Field::name) const;

 private:
  void add_part(const Sentence& other) { parts_.insert(parts_.end(), other.parts_.begin(), other.parts_.end()); }
  void add_part(const Field& field) { parts_.emplace_back(field); }
  void add_part(std::string_view words) { parts_.emplace_back(std::string(words)); }
  void add_part(std::integral auto number) { parts_.emplace_back(std::to_string(number)); }

  std::vector<std::variant<Field, std::string>> parts_;
};

/// A UsageError or CapacityError whose text distinguishes fields from words.
template <class Error>
struct Refusal : Error {
  explicit Refusal(const Sentence& why) : Error(why.text()), sentence(why) {}
  Sentence sentence;
};

/// Throws a Refusal<UsageError> unless `right`.
template <class... Parts>
void check_use(bool right, const Parts&... why) {
  if (!right) {
    throw Refusal<UsageError>(Sentence(why...));
  }
}

}  // namespace dmpc::core
