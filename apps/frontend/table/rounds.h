// Measures in rounds.
#pragma once

#include <cstddef>

#include "apps/frontend/system/progress.h"

namespace dmpc::apps {

/// Calls visit(index) for every index below `count` before the next round, so that a temporary load on the machine affects all
/// indices alike, and shows the number of visits.
template <class Visit>
void round_by_round(std::size_t rounds, std::size_t count, Progress& progress, const Visit& visit) {
  for (std::size_t done = 0; done < rounds * count; ++done) {
    progress.update(done, rounds * count);
    visit(done % count);
  }
}

}  // namespace dmpc::apps
