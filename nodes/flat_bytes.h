// Values put one behind the other as bytes, and taken out again in the same order, by the same program on the same kind of
// computer.
#pragma once

#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/expect.h"

namespace dmpc::nodes {

class FlatWriter {
 public:
  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(T));
  }
  /// How many there are, and then each.
  template <class T>
  void put_all(const std::vector<T>& values) {
    put(values.size());
    for (const T& value : values) {
      put(value);
    }
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Expects that there is as much as is taken. What is read outlives this.
class FlatReader {
 public:
  explicit FlatReader(std::string_view bytes) : bytes_(bytes) {}

  template <class T>
  T take() {
    static_assert(std::is_trivially_copyable_v<T>);
    core::expect(bytes_.size() >= sizeof(T), "flat bytes hold what is taken out of them");
    T value;
    std::memcpy(&value, bytes_.data(), sizeof(T));
    bytes_.remove_prefix(sizeof(T));
    return value;
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
  bool is_at_end() const { return bytes_.empty(); }

 private:
  std::string_view bytes_;
};

}  // namespace dmpc::nodes
