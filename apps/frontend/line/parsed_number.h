// Parses words that are numbers as a whole.
#pragma once

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

namespace dmpc::apps {

/// Parses as std::from_chars does, without blanks or a plus in front; nothing for text that is not a number, has trailing
/// characters, or exceeds the type's range.
template <class Number>
std::optional<Number> number_in(std::string_view word) {
  Number number{};
  const char* const end = word.data() + word.size();
  const auto [rest, error] = std::from_chars(word.data(), end, number);
  return error == std::errc() && rest == end ? std::optional(number) : std::nullopt;
}

}  // namespace dmpc::apps
