#include "apps/lab/bench/stability/hearing.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace dmpc::apps {

bool Hearing::admissible(const core::Hit& hit, Renderer renderer) const {
  return referee_.admissible(ray_, {hit.found(), hit.primitive, hit.t}, renderer);
}

bool Hearing::distance_explained(const core::Hit& hit) const {
  std::vector<Encounter> met;
  add_encounters(ray_, database_.primitives()[hit.primitive], hit.primitive, met);
  return std::any_of(met.begin(), met.end(), [&](const Encounter& seen) {
    return std::fabs(double{hit.t} - seen.t) <= seen.t_error + level_share * std::fabs(seen.t);
  });
}

}  // namespace dmpc::apps
