// Sums and differences of structs that consist of counters only. No counter is named here, so a new one is only declared.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <type_traits>
#include <utility>

namespace dmpc::core {

/// Whether T{n, n, ...} compiles with this many numbers: then each initializes one member, or one element within it.
template <class T, std::size_t... I>
constexpr bool is_made_of(std::index_sequence<I...>) {
  return requires(std::uint64_t n) { T{(static_cast<void>(I), n)...}; };
}

/// An aggregate that contains only std::uint64_t, arrays of them and aggregates of them.
template <class T>
concept MadeOfCounts = std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(std::uint64_t) == 0 &&
                       is_made_of<T>(std::make_index_sequence<sizeof(T) / sizeof(std::uint64_t)>());

/// Adds each count of `more` to the corresponding one of `sum`, and returns `sum`.
template <MadeOfCounts T>
T& add_counts(T& sum, const T& more) {
  using Numbers = std::array<std::uint64_t, sizeof(T) / sizeof(std::uint64_t)>;
  auto numbers = std::bit_cast<Numbers>(sum);
  const auto others = std::bit_cast<Numbers>(more);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    numbers[i] += others[i];
  }
  return sum = std::bit_cast<T>(numbers);
}

/// The differences of corresponding counts, `now` - `before`.
template <MadeOfCounts T>
T counts_since(const T& now, const T& before) {
  using Numbers = std::array<std::uint64_t, sizeof(T) / sizeof(std::uint64_t)>;
  auto numbers = std::bit_cast<Numbers>(now);
  const auto others = std::bit_cast<Numbers>(before);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    numbers[i] -= others[i];
  }
  return std::bit_cast<T>(numbers);
}

/// The sum of of(item), which returns counts, over all items.
template <class Items, class Of>
auto total_of(const Items& items, const Of& of) {
  std::remove_cvref_t<decltype(std::invoke(of, *items.begin()))> sum{};
  for (const auto& item : items) {
    add_counts(sum, std::invoke(of, item));
  }
  return sum;
}

}  // namespace dmpc::core
