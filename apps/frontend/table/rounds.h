// Measuring in rounds.
#pragma once

#include <cstddef>

#include "apps/frontend/system/progress.h"

namespace dmpc::apps {

/// Calls visit(round, index) for every index below `count` before the next round, so that a busy minute of the machine hits all
/// indices alike and not the last ones.
template <class Visit>
void round_by_round(std::size_t rounds, std::size_t count, const Visit& visit) {
  for (std::size_t round = 0; round < rounds; ++round) {
    for (std::size_t index = 0; index < count; ++index) {
      visit(round, index);
    }
  }
}

/// Goes round by round with visit(index), and shows how many there have been.
template <class Visit>
void round_by_round(std::size_t rounds, std::size_t count, Progress& progress, const Visit& visit) {
  round_by_round(rounds, count, [&](std::size_t round, std::size_t index) {
    progress.update(round * count + index, rounds * count);
    visit(index);
  });
}

}  // namespace dmpc::apps
