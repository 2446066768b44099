#include "core/database/shading/alias_table.h"

#include <algorithm>
#include <numeric>

#include "core/base/expect.h"

namespace dmpc::core {

std::vector<EmitterChoice> alias_table(std::span<const double> weights) {
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0), count = static_cast<double>(weights.size());
  expect(sum > 0.0 && sum <= 1e300, "there is something to be drawn");
  std::vector<double> left(weights.size());  // what is left of each share, in slots
  std::vector<std::uint32_t> small, large;
  for (std::uint32_t i = 0; i < weights.size(); ++i) {
    left[i] = weights[i] / sum * count;
    (left[i] < 1.0 ? small : large).push_back(i);
  }
  std::vector<EmitterChoice> table(weights.size());
  while (!small.empty() && !large.empty()) {
    const std::uint32_t filled = small.back(), donor = large.back();
    small.pop_back();
    table[filled] = {static_cast<float>(left[filled]), donor};
    left[donor] -= 1.0 - left[filled];
    if (left[donor] < 1.0) {
      large.pop_back();
      small.push_back(donor);
    }
  }
  // Except for rounding, the remaining entries fill a slot of their own.
  for (const std::vector<std::uint32_t>& rest : {small, large}) {
    for (const std::uint32_t i : rest) {
      table[i] = {1.0F, i};
    }
  }
  return table;
}

std::vector<double> chances_of(std::span<const EmitterChoice> table) {
  std::vector<double> chances(table.size());
  const double place = 1.0 / static_cast<double>(table.size());
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double own = std::min(double{table[i].threshold}, 1.0);
    chances[i] += own * place;
    chances[table[i].other] += (1.0 - own) * place;
  }
  return chances;
}

}  // namespace dmpc::core
