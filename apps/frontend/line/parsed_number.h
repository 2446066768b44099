// Numbers that are all of a word.
#pragma once

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

namespace dmpc::apps {

/// As std::from_chars reads it, without blanks or a plus before it; nothing for what is none, has anything behind it, or is more
/// than the type holds.
template <class Number>
std::optional<Number> number_in(std::string_view word) {
  Number number{};
  const char* const end = word.data() + word.size();
  const auto [rest, error] = std::from_chars(word.data(), end, number);
  return error == std::errc() && rest == end ? std::optional(number) : std::nullopt;
}

}  // namespace dmpc::apps
