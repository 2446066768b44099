// What each skip is worth: the same picture without it and with it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/edge/system/interrupt.h"
#include "apps/lab/bench/speed/comparison.h"
#include "apps/lab/bench/speed/part.h"

namespace dmpc::apps {

/// One skip on one scene, in a round at least; or all of them; or none, the same picture in the same way, to show what noise
/// does.
struct Ablation {
  Comparison seconds;     ///< of processors: subject "without it", rival "with it"; `what` is the skip, `detail` who renders
  double work_ratio = 1;  ///< without over with it, by counted operations and their prices (core/trace/work.h): no noise
  std::optional<std::uint64_t> avoided = std::nullopt;  ///< of `unit`
  std::string unit = {};
  /// What a bounded skip, which changes the picture, errs by: the root mean square error of linear channels against the picture
  /// without it.
  std::optional<double> error = std::nullopt;

  double noise = 0;  ///< the largest share by which times of the same differed in a round

  bool is_exact() const { return !error; }
  bool is_control() const { return seconds.what == "none"; }
};

/// Renders each scene with all skips on, all off and each off by itself, with two cutoffs, and once more with all on, all of them
/// in every round: svm on 2 nodes; for what only dataflow skips, that on 64. Times include what a skip takes to prepare. After
/// each round of a scene `results` has its row for each skip, with the figures of whole rounds alone: of a scene whose first
/// round is not over it has none. Progress goes to stderr if that is a terminal. Throws core::InternalError if an exact skip
/// changes a film, core::InputError for a scene that will not do, Interrupted after a signal.
void measure_ablation(const SpeedSettings& settings, const Interrupt& interrupt, std::vector<Ablation>& results);

}  // namespace dmpc::apps
