// The data block of a page, read back from a file that anybody may have made.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace dmpc::apps::html {

/// More bytes than a page of the most nodes has.
inline constexpr std::uint64_t page_bytes_max = std::uint64_t{64} << 20U;

/// What stands in the block; nothing if a page has none. `file` is what messages call the page. Throws core::InputError if it
/// ends within its data, or if they are no object of JSON, or one with more objects in each other than any of ours has.
std::optional<nlohmann::json> data_in(std::string_view page, const std::string& file);

/// A part of the data and where it stands, as messages say it: "a.html: data.works.2.name". Each function throws core::InputError
/// with that, what was expected, and what to do, if there is something else. The data outlive this.
class DataPart {
 public:
  DataPart(const nlohmann::json& value, std::string where) : value_(&value), where_(std::move(where)) {}

  bool has(const char* key) const { return value_->is_object() && value_->contains(key); }
  DataPart at(const char* key) const;
  DataPart at(std::size_t place) const;
  /// A list's length.
  std::size_t size(std::size_t most) const;

  std::uint64_t whole(std::uint64_t most, std::uint64_t least = 0) const;
  double number() const;
  /// A text of at most `most` bytes.
  std::string text(std::size_t most = 4096) const;
  /// As typed_array() makes it: `count` numbers, none larger than `most`.
  const nlohmann::json& numbers(std::size_t count, std::uint64_t most) const;
  /// As above, with any number of numbers; returns it.
  std::size_t count_numbers(std::uint64_t most) const;
  [[noreturn]] void refuse(const std::string& expected) const;

 private:
  const nlohmann::json* value_;
  std::string where_;
};

}  // namespace dmpc::apps::html
