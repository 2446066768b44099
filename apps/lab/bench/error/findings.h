// What the figures of `bench error` say, in sentences.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/lab/bench/error/result.h"

namespace dmpc::apps {

/// What uniform samples take for a root mean square error of one 8-bit step, 1/255, as a multiple of what adaptive sampling
/// takes.
struct AdaptiveGain {
  std::optional<double> seconds, rays;  ///< nothing: not measured, or outside what was
};
AdaptiveGain adaptive_gain(const SceneResult& result);

/// The point of the knob with the fewest rays whose deterministic error (root mean square) is below a quarter of an 8-bit step,
/// 1/1020; nothing if there is none.
std::optional<std::size_t> cheapest_point(const SceneResult& result, Knob knob);

/// About one scene: what adaptive sampling is worth in time, its reference, the cheapest cutoff and depth; by paths what chance
/// in place of aiming, and no roulette, take. No line ends.
std::vector<std::string> findings_of(const SceneResult& result);

/// What one asks first, of all scenes together: what adaptive sampling is worth at an RMSE of 1/255, and how many settings are
/// told from the reference. Empty if nothing is measured.
std::string summary_of(std::span<const SceneResult> results);

}  // namespace dmpc::apps
