// Reads the data block back from a page, which is an untrusted file.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace dmpc::apps::html {

/// More bytes than a page of the largest number of nodes has.
inline constexpr std::uint64_t page_bytes_max = std::uint64_t{64} << 20U;

/// Returns the contents of the block; nothing if a page has none. `file` names the page in messages. Throws core::InputError if
/// the page ends within its data, or if they are no JSON object, or nest objects deeper than any of our pages.
std::optional<nlohmann::json> data_in(std::string_view page, const std::string& file);

/// A part of the data and its location for messages: "a.html: data.works.2.name". Each function throws core::InputError with that
/// location, what was expected, and what to do, if there is something else. The data outlive this.
class DataPart {
 public:
  DataPart(const nlohmann::json& value, std::string where) : value_(&value), where_(std::move(where)) {}

  bool has(const char* key) const { return value_->is_object() && value_->contains(key); }
  DataPart at(const char* key) const;
  DataPart at(std::size_t place) const;
  std::size_t size(std::size_t most) const;

  std::uint64_t whole(std::uint64_t most, std::uint64_t least = 0) const;
  double number() const;
  /// Returns a text of at most `most` bytes.
  std::string text(std::size_t most = 4096) const;
  /// Returns an array as from typed_array(): `count` numbers, none larger than `most`.
  const nlohmann::json& numbers(std::size_t count, std::uint64_t most) const;
  /// Checks an array of any number of numbers, and returns that number.
  std::size_t count_numbers(std::uint64_t most) const;
  [[noreturn]] void refuse(const std::string& expected) const;

 private:
  const nlohmann::json* value_;
  std::string where_;
};

}  // namespace dmpc::apps::html
