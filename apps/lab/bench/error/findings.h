// The results of `bench error` in sentences.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/lab/bench/error/result.h"

namespace dmpc::apps {

/// The processor time of adaptive sampling over that of uniform sampling at an equal error that adaptive sampling was asked for.
struct AdaptiveShare {
  std::string error;  ///< "1/255"
  Estimate time;      ///< its interval has the noise of pixels, and of times the rounds' least and most
  double rays = 0;    ///< the same of rays

  bool is_undecided() const { return time.low <= 1 && time.high >= 1; }
};
/// Returns the shares at all such errors that both curves reach, from the largest error on. Curves are straight in logarithms
/// between points. The noise of pixels follows from leaving out one group of them after the other (the jackknife).
std::vector<AdaptiveShare> adaptive_shares(const SceneResult& result);

/// Returns "adaptive sampling takes 0.83 of uniform sampling's processor time at 1/255 (0.79 to 0.88)"; undecided shares are told
/// as no difference. Empty without shares.
std::string text_of(std::span<const AdaptiveShare> shares);

/// Returns the knob's point with the fewest rays whose deterministic error (root mean square) is below a quarter of an 8-bit
/// step, 1/1020; nothing if there is none.
std::optional<std::size_t> cheapest_point(const SceneResult& result, Knob knob);

/// Returns sentences about one scene, without line ends: what adaptive sampling takes, the reference, the cheapest cutoff and
/// depth; for paths, the cost of BSDF sampling alone, and of no roulette.
std::vector<std::string> findings_of(const SceneResult& result);

/// Returns what adaptive sampling takes, and where the range of errors ends, of each scene. Empty if nothing is measured.
std::string summary_of(std::span<const SceneResult> results);

}  // namespace dmpc::apps
