// The progress of a picture that is refined in passes, and its end by time.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "apps/frontend/system/progress.h"
#include "core/picture/sampling/refinement.h"

namespace dmpc::apps {

/// What is asked of a refined picture, and where its run starts.
struct RefinedRun {
  double error = 0;                    ///< requested
  std::optional<double> seconds = {};  ///< --time, from the run's start
  std::uint32_t pass = 1;              ///< the first
  std::uint64_t samples_done = 0;      ///< of all pixels, before it
};

/// Shows which error is reached, and the time that is left by it: errors fall with a power of the number of samples, which two
/// passes tell, else with its root. Ends a picture between two passes, nearest to its time. Not thread-safe.
class PassProgress {
 public:
  /// `progress` outlives it. `seconds` is the time since the run's start.
  PassProgress(Progress& progress, const RefinedRun& run, std::function<double()> seconds);

  /// `done` of a pass's `total` pixels; a smaller number, or another total, begins the next pass.
  void update(std::uint32_t done, std::uint32_t total);
  /// For core::Continuation.
  bool ends_before(const core::PassEnd& end);

  /// "Pass 3, error 2.31/255 of 1/255, 0:31 left:".
  std::string label() const;
  /// 0 to 1: of the samples that the error is believed to need, or of the time; while no error is known, of the pass.
  double share() const { return share_; }

 private:
  void estimate();

  Progress& progress_;
  RefinedRun run_;
  std::function<double()> seconds_;
  std::uint32_t pass_, done_ = 0, total_ = 0;
  std::optional<core::PassEnd> end_ = {};  ///< the last
  double power_ = 0.5;                     ///< of the number of samples, by which the error falls
  double share_ = 0;
  std::optional<double> seconds_left_ = {};
};

}  // namespace dmpc::apps
