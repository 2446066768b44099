// Values as bytes of a message, and back.
#pragma once

#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

#include "apps/reader/saying.h"
#include "core/base/expect.h"

namespace dmpc::apps {

/// A message that no reader of ours sends: foreign data have taken over the reader.
struct Nonsense : core::InputError {
  using core::InputError::InputError;
};

class Packer {
 public:
  template <class T>
  Packer& add(const T& value) {
    static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(T));
    return *this;
  }
  /// Truncated if it is too long.
  Packer& add_text(std::string_view text) {
    text = text.substr(0, text_bytes_max);
    add(static_cast<std::uint32_t>(text.size()));
    bytes_.append(text);
    return *this;
  }

  Packer& add_flag(bool flag) { return add(static_cast<std::uint8_t>(flag)); }
  template <class T>
  Packer& add_optional(const std::optional<T>& value) {
    return add_flag(value.has_value()).add(value.value_or(T{}));
  }

  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Throws Nonsense if there is less than is taken, or a rest at the end.
class Unpacker {
 public:
  explicit Unpacker(std::string_view bytes) : bytes_(bytes) {}

  /// Only for types for which all bit patterns are valid: no bool.
  template <class T>
  T take() {
    static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T> && !std::is_same_v<T, bool>);
    T value{};
    std::memcpy(&value, take_bytes(sizeof(T)).data(), sizeof(T));
    return value;
  }
  std::string take_text() { return std::string(take_bytes(take<std::uint32_t>())); }
  /// An enumeration whose values are 0 to `last`.
  template <class T>
  T take_choice(T last) {
    const auto value = take<std::uint8_t>();
    require(value <= static_cast<std::uint8_t>(last));
    return static_cast<T>(value);
  }
  bool take_flag() {
    const auto value = take<std::uint8_t>();
    require(value <= 1);
    return value == 1;
  }
  /// Only for trusted data: T may have flags.
  template <class T>
  std::optional<T> take_optional() {
    const bool has_value = take_flag();
    const T value = take<T>();
    return has_value ? std::optional(value) : std::nullopt;
  }
  bool is_empty() const { return bytes_.empty(); }
  void finish() const { require(bytes_.empty()); }

  static void require(bool holds) {
    if (!holds) {
      throw Nonsense("what its reader makes of it is nonsense");
    }
  }

 private:
  std::string_view take_bytes(std::size_t count) {
    require(count <= bytes_.size());
    const std::string_view taken = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return taken;
  }

  std::string_view bytes_;
};

}  // namespace dmpc::apps
