// Judges the answers to one ray by the referee.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "apps/lab/oracle/exact_intersection.h"
#include "apps/lab/oracle/referee.h"
#include "core/database/database.h"
#include "core/record/hit.h"
#include "core/record/ray.h"

namespace dmpc::apps {

/// Distances within this share of each other need no explanation.
inline constexpr double level_share = 1e-6;

/// Asks `referee`, which has the primitives of `database`, about the answers to `ray`. Both outlive the hearing. Thread-safe.
class Hearing {
 public:
  Hearing(const core::Database& database, const Referee& referee, const core::Ray& ray)
      : database_(database), referee_(referee), ray_(ray) {}

  /// Returns whether rounding can have made `renderer` give this answer. For a shadow ray only found() counts.
  bool admissible(const core::Hit& hit, Renderer renderer) const {
    return referee_.admissible(ray_, {hit.found(), hit.primitive, hit.t}, renderer);
  }
  /// Returns whether rounding can have given the distance of `hit`, which is admissible.
  bool distance_explained(const core::Hit& hit) const {
    std::vector<ExactIntersection> met;
    add_exact_intersections(ray_, database_.primitives()[hit.primitive], hit.primitive, met);
    return std::any_of(met.begin(), met.end(), [&](const ExactIntersection& seen) {
      return std::fabs(double{hit.t} - seen.t) <= seen.t_error + level_share * std::fabs(seen.t);
    });
  }

 private:
  const core::Database& database_;
  const Referee& referee_;
  core::Ray ray_;
};

}  // namespace dmpc::apps
