// Few rows that hold every pair of values of every two factors.
#pragma once

#include <cstddef>
#include <set>
#include <tuple>
#include <vector>

namespace dmpc::tests {

/// A row gives each factor a value's index. Greedy: row after row takes, factor by factor, the value that adds most pairs not yet
/// held. Deterministic. `levels[f]` is the number of values of factor f, at least 1.
inline std::vector<std::vector<std::size_t>> pairwise(const std::vector<std::size_t>& levels) {
  using Pair = std::tuple<std::size_t, std::size_t, std::size_t, std::size_t>;  // factor, value, later factor, value
  std::set<Pair> missing;
  for (std::size_t a = 0; a < levels.size(); ++a) {
    for (std::size_t b = a + 1; b < levels.size(); ++b) {
      for (std::size_t i = 0; i < levels[a] * levels[b]; ++i) {
        missing.insert({a, i % levels[a], b, i / levels[a]});
      }
    }
  }
  std::vector<std::vector<std::size_t>> rows;
  while (!missing.empty()) {
    const auto [a, value_a, b, value_b] = *missing.begin();
    std::vector<std::size_t> row(levels.size(), levels.size() + 1000);
    std::vector<bool> chosen(levels.size(), false);
    const auto choose = [&](std::size_t factor, std::size_t value) {
      row[factor] = value;
      chosen[factor] = true;
    };
    const auto pair_of = [&](std::size_t f, std::size_t value, std::size_t g) {
      return f < g ? Pair{f, value, g, row[g]} : Pair{g, row[g], f, value};
    };
    choose(a, value_a);
    choose(b, value_b);
    for (std::size_t factor = 0; factor < levels.size(); ++factor) {
      std::size_t best = 0, best_gain = 0;
      for (std::size_t value = 0; value < levels[factor] && !chosen[factor]; ++value) {
        std::size_t gain = 0;
        for (std::size_t other = 0; other < levels.size(); ++other) {
          gain += chosen[other] && missing.contains(pair_of(factor, value, other)) ? 1 : 0;
        }
        if (gain > best_gain) {
          best = value;
          best_gain = gain;
        }
      }
      if (!chosen[factor]) {
        choose(factor, best_gain > 0 ? best : rows.size() % levels[factor]);
      }
    }
    for (std::size_t f = 0; f < levels.size(); ++f) {
      for (std::size_t g = f + 1; g < levels.size(); ++g) {
        missing.erase({f, row[f], g, row[g]});
      }
    }
    rows.push_back(row);
  }
  return rows;
}

}  // namespace dmpc::tests
