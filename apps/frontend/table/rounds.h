// Measures in rounds.
#pragma once

#include <cstddef>

#include "apps/frontend/system/progress.h"

namespace dmpc::apps {

/// Calls visit(round, index) for every index below `count` before the next round, so that a temporary load on the machine affects
/// all indices alike.
template <class Visit>
void round_by_round(std::size_t rounds, std::size_t count, const Visit& visit) {
  for (std::size_t round = 0; round < rounds; ++round) {
    for (std::size_t index = 0; index < count; ++index) {
      visit(round, index);
    }
  }
}

/// Calls visit(index) round by round, and shows the number of finished rounds.
template <class Visit>
void round_by_round(std::size_t rounds, std::size_t count, Progress& progress, const Visit& visit) {
  round_by_round(rounds, count, [&](std::size_t round, std::size_t index) {
    progress.update(round * count + index, rounds * count);
    visit(index);
  });
}

}  // namespace dmpc::apps
