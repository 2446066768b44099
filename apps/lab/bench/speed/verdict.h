// Whether a skip is worth keeping.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "apps/lab/bench/speed/ablation.h"

namespace dmpc::apps {

/// A skip is kept if it wins so much on some scene and loses no more than that on any other.
inline constexpr double win_share = 0.03, loss_share = 0.01;

/// What a skip does to one scene.
enum class Effect : std::uint8_t { wins, even, loses };

struct AblationVerdict {
  Effect effect = Effect::even;
  bool is_by_work = false;  ///< times differ too much from round to round to tell
  double ratio = 1;         ///< that told: the median one of times, or that of counted work
};

/// By time if all rounds say the same, and neither they differ nor noise is by more than what the skip does, or than 1 %; else by
/// counted work. Requires a round.
AblationVerdict verdict_on(const Ablation& ablation);
/// "wins (time)".
std::string text_of(const AblationVerdict& verdict);

/// A sentence on each skip by itself, over all scenes that have been measured, in their order: "any-hit: kept, wins up to 12.0 %
/// (tetra-9), loses 1 % nowhere." Bounded skips change pictures, so theirs ends with their largest error.
std::vector<std::string> verdicts_on(std::span<const Ablation> ablations);

}  // namespace dmpc::apps
