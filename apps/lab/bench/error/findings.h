// The results of `bench error` in sentences.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/lab/bench/error/result.h"

namespace dmpc::apps {

/// The cost of uniform samples for a root mean square error of one 8-bit step, 1/255, as a multiple of the cost of adaptive
/// sampling.
struct AdaptiveGain {
  std::optional<double> seconds, rays;  ///< nothing: not measured, or outside the measured range
};
AdaptiveGain adaptive_gain(const SceneResult& result);

/// Returns the knob's point with the fewest rays whose deterministic error (root mean square) is below a quarter of an 8-bit
/// step, 1/1020; nothing if there is none.
std::optional<std::size_t> cheapest_point(const SceneResult& result, Knob knob);

/// Returns sentences about one scene, without line ends: the gain of adaptive sampling in time, the reference, the cheapest
/// cutoff and depth; for paths, the cost of BSDF sampling alone, and of no roulette.
std::vector<std::string> findings_of(const SceneResult& result);

/// Returns the summary of all scenes: the gain of adaptive sampling at an RMSE of 1/255, and how many settings can be
/// distinguished from the reference. Empty if nothing is measured.
std::string summary_of(std::span<const SceneResult> results);

}  // namespace dmpc::apps
