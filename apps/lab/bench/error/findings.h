// What the figures of `bench error` say, in sentences.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/lab/bench/error/result.h"

namespace dmpc::apps {

/// At the root mean square error of so many uniform samples adaptive sampling takes so many times as much.
struct AdaptiveRatio {
  int samples = 16;
  std::optional<double> rays, seconds;  ///< nothing: not measured, or outside what was
  bool is_claimed = true;               ///< no error that it rests on is less than 10 times the reference's own
};

/// What uniform samples take for a root mean square error of one 8-bit step, 1/255, as a multiple of what adaptive sampling
/// takes.
struct AdaptiveGain {
  std::optional<double> seconds, rays;  ///< nothing: not measured, or outside what was
};
AdaptiveGain adaptive_gain(const SceneResult& result);

/// For 16, 32 and 64 uniform samples. Errors are those without the reference's own (result.h).
std::vector<AdaptiveRatio> adaptive_ratios(const SceneResult& result);

/// The point of the knob with the fewest rays whose deterministic error (root mean square) is below a quarter of an 8-bit step,
/// 1/1020; nothing if there is none.
std::optional<std::size_t> cheapest_point(const SceneResult& result, Knob knob);

/// About one scene: what adaptive sampling is worth in time, its reference, what adaptive sampling takes at other errors, the
/// cheapest cutoff and depth; by paths what chance in place of aiming, and no roulette, take. No line ends.
std::vector<std::string> findings_of(const SceneResult& result);

/// What one asks first, of all scenes together: what adaptive sampling is worth at an RMSE of 1/255, and how many settings are
/// told from the reference. Empty if nothing is measured.
std::string summary_of(std::span<const SceneResult> results);

/// About several: geometric means over the scenes that have a figure. Empty for less than two.
std::vector<std::string> findings_of_all(std::span<const SceneResult> results);

}  // namespace dmpc::apps
