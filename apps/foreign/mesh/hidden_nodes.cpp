#include "apps/foreign/mesh/hidden_nodes.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <optional>
#include <string>

#include "apps/foreign/mesh/trimmed.h"
#include "apps/foreign/text/line_words.h"

namespace dmpc::apps {
namespace {

/// As FBX has a string in binary: a letter, its length, its bytes.
std::string packed(std::string_view text) {
  std::string bytes = "S....";
  const auto length = static_cast<std::uint32_t>(text.size());
  std::memcpy(bytes.data() + 1, &length, sizeof length);
  return bytes.append(text);
}

/// Passes over one string in binary; false if none is there.
bool skip_string(std::string_view& rest) {
  constexpr std::size_t head = 5;
  std::uint32_t length = 0;
  if (rest.size() < head || rest[0] != 'S') {
    return false;
  }
  std::memcpy(&length, rest.data() + 1, sizeof length);
  rest.remove_prefix(std::min<std::size_t>(head + length, rest.size()));
  return true;
}

/// The number behind a property's name and type: two strings, and its value as a letter says, little-endian.
std::optional<double> packed_number(std::string_view rest) {
  if (!skip_string(rest) || !skip_string(rest) || rest.empty()) {
    return std::nullopt;
  }
  const auto as = [&]<class T>(T value) {
    const bool is_there = rest.size() > sizeof value;
    std::memcpy(&value, rest.data() + 1, is_there ? sizeof value : 0);
    return is_there ? std::optional(static_cast<double>(value)) : std::nullopt;
  };
  return rest[0] == 'D' ? as(double{}) : rest[0] == 'F' ? as(float{}) : rest[0] == 'I' ? as(std::int32_t{}) : std::nullopt;
}

/// The last of a line in text.
std::optional<double> number_at_end(std::string_view rest) {
  const std::string_view line = rest.substr(0, rest.find_first_of("\r\n"));
  return decimal_number(trimmed(line.substr(line.find_last_of(',') + 1)));
}

template <class Number>
std::uint64_t count_zeros(std::string_view file, const std::string& property, const Number& number) {
  std::uint64_t count = 0;
  for (std::size_t at = file.find(property); at != std::string_view::npos; at = file.find(property, at)) {
    at += property.size();
    const std::optional<double> value = number(file.substr(at));
    count += value && *value == 0 ? 1 : 0;
  }
  return count;
}

}  // namespace

std::uint64_t count_hidden_nodes(std::string_view file) {
  if (file.starts_with("Kaydara FBX Binary")) {
    return count_zeros(file, packed("Visibility") + packed("Visibility"), packed_number) +
           count_zeros(file, packed("Show") + packed("bool"), packed_number);
  }
  return count_zeros(file, R"("Visibility", "Visibility", )", number_at_end) +
         count_zeros(file, R"("Show", "bool", )", number_at_end);
}

}  // namespace dmpc::apps
