// What takes several statements with the standard's algorithms, as one expression.
#pragma once

#include <algorithm>
#include <functional>
#include <vector>

namespace dmpc::core {

/// Returns of(item) of all items, in their order.
template <class T, class Items, class Of>
std::vector<T> mapped(const Items& items, const Of& of) {
  std::vector<T> all;
  if constexpr (requires { items.size(); }) {
    all.reserve(items.size());
  }
  for (const auto& item : items) {
    all.emplace_back(std::invoke(of, item));
  }
  return all;
}

/// Returns the sum of of(item) over all items, added in their order.
template <class Sum, class Items, class Of>
Sum sum_over(const Items& items, const Of& of) {
  Sum sum{};
  for (const auto& item : items) {
    sum += std::invoke(of, item);
  }
  return sum;
}

/// Returns the largest of(item), at least `least`.
template <class Items, class Number, class Of>
Number max_over(const Items& items, Number least, const Of& of) {
  for (const auto& item : items) {
    least = std::max<Number>(least, std::invoke(of, item));
  }
  return least;
}

/// Returns the first item whose of(item) is `value`; nullptr if there is none.
template <class Items, class Value, class Of>
auto* find_in(Items& items, const Value& value, const Of& of) {
  for (auto& item : items) {
    if (std::invoke(of, item) == value) {
      return &item;
    }
  }
  return static_cast<decltype(&*std::begin(items))>(nullptr);
}

}  // namespace dmpc::core
