// The progress of a picture that is refined in passes.
#pragma once

#include <cstdint>
#include <string>

#include "apps/frontend/system/progress.h"

namespace dmpc::apps {

/// Combines passes into one monotonic progress: each pass has an equal share, whatever its number of pixels; a picture that is
/// good enough before the last pass ends early. Not thread-safe.
class PassProgress {
 public:
  /// `progress` outlives it. `first`: the first pass, from 1 on.
  PassProgress(Progress& progress, std::uint32_t first, std::uint32_t passes_max)
      : progress_(progress), pass_(first), passes_max_(passes_max) {}

  /// `done` of a pass's `total` pixels; a smaller number, or another total, begins the next pass.
  void update(std::uint32_t done, std::uint32_t total);

  /// "Pass 3 of at most 12:".
  std::string label() const;
  /// 0 to 1, over all passes.
  double share() const { return share_; }

 private:
  Progress& progress_;
  std::uint32_t pass_, passes_max_;
  std::uint32_t done_ = 0, total_ = 0;
  double share_ = 0;
};

}  // namespace dmpc::apps
