// Counters as JSON, by their rows, and figures of each rank.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "apps/frontend/show/counters.h"
#include "nodes/ranks/rank_figures.h"

namespace dmpc::apps {

/// Null where nodes are in one process. `is_observed`: the ranks' clocks were compared.
nlohmann::ordered_json ranks_json(std::span<const nodes::RankFigures> ranks, bool is_observed);

/// Converts a name to a key.
inline std::string key_of(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == ' ' || c == '-'; }, '_');
  return name;
}

/// Values of all `rows`, by key.
template <class T, std::size_t count>
nlohmann::ordered_json json_of(const T& counters, const std::array<Counter<T>, count>& rows) {
  nlohmann::ordered_json all;
  for (const Counter<T>& row : rows) {
    all[row.key] = row.value(counters);
  }
  return all;
}
template <class T>
nlohmann::ordered_json json_of(const T& counters) {
  return json_of(counters, counters_of<T>);
}

}  // namespace dmpc::apps
