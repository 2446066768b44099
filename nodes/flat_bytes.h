// Serialisation of values as bytes, to be read in the same order by the same program on the same kind of computer.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/expect.h"

namespace dmpc::nodes {

class FlatWriter {
 public:
  template <class... T>
  void put(const T&... values) {
    static_assert((std::is_trivially_copyable_v<T> && ...));
    (bytes_.append(reinterpret_cast<const char*>(&values), sizeof(T)), ...);
  }
  /// The number of values, and then each.
  template <class Values>
  void put_all(const Values& values) {
    put(std::size_t{values.size()});
    for (const auto& value : values) {
      put(value);
    }
  }
  /// The number of bytes, then these.
  void put_bytes(std::string_view bytes) {
    put(std::size_t{bytes.size()});
    bytes_.append(bytes);
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Expects that there is as much as is read. The bytes outlive this.
class FlatReader {
 public:
  explicit FlatReader(std::string_view bytes) : bytes_(bytes) {}

  template <class T>
  T take() {
    static_assert(std::is_trivially_copyable_v<T>);
    core::expect(bytes_.size() >= sizeof(T), "flat bytes hold what is taken out of them");
    std::array<std::byte, sizeof(T)> bytes;
    std::memcpy(bytes.data(), bytes_.data(), sizeof(T));
    bytes_.remove_prefix(sizeof(T));
    return std::bit_cast<T>(bytes);
  }
  /// Reads each of these.
  template <class... T>
  void take_into(T&... values) {
    ((values = take<T>()), ...);
  }
  template <class T>
  std::vector<T> take_all() {
    const auto count = take<std::size_t>();
    core::expect(count <= bytes_.size() / sizeof(T), "flat bytes hold what is taken out of them");
    std::vector<T> values;
    for (std::size_t i = 0; i < count; ++i) {
      values.push_back(take<T>());
    }
    return values;
  }
  /// Reads values into a container of the same size.
  template <class T>
  void take_all(std::span<T> values) {
    core::expect(take<std::size_t>() == values.size(), "flat bytes hold as many as are taken out of them");
    for (T& value : values) {
      value = take<T>();
    }
  }
  /// A view of bytes in the input.
  std::string_view take_bytes() {
    const auto count = take<std::size_t>();
    core::expect(count <= bytes_.size(), "flat bytes hold what is taken out of them");
    const std::string_view taken = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return taken;
  }
  bool is_at_end() const { return bytes_.empty(); }

 private:
  std::string_view bytes_;
};

}  // namespace dmpc::nodes
