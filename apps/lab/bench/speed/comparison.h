// What was measured of one thing, side by side with what it is held against.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "apps/lab/bench/speed/part.h"

namespace dmpc::apps {

/// Figures by round; of each round's two the ratio is taken, so that a busy minute of the machine touches both.
struct Figures {
  std::vector<double> subject = {}, rival = {};

  /// Those that have both figures.
  std::size_t rounds() const;
};

/// The middle one of the rounds' ratios of subject to rival, and the outermost ones.
struct RatioSpread {
  double median = 0, least = 0, most = 0;
};
/// Requires a round, and figures of the rival above 0.
RatioSpread ratio_of(const Figures& figures);

struct Comparison {
  SpeedPart part{};
  std::string scene;
  std::string what;            ///< "closest hit", "whole picture"
  std::string detail = {};     ///< a kind of `what`, such as the class of rays; may be empty
  std::uint32_t threads = 0;   ///< that worked, or nodes that rendered; 0: does not matter
  std::string subject, rival;  ///< whose figures they are
  std::string unit;            ///< of the figures: "Mray/s", "s"
  Figures figures = {};        ///< times are by the wall clock, unless the unit says otherwise
  Figures processor = {};      ///< the same in processor time, of what is timed by both clocks

  /// The same with one round, which has these figures.
  Comparison once(double subject_figure, double rival_figure) const;
};

/// Some of what was measured, each outliving this.
using Comparisons = std::vector<const Comparison*>;
/// Those that are meant and have a round.
Comparisons measured(std::span<const Comparison> comparisons, const std::function<bool(const Comparison&)>& is_meant);
/// In groups of such as are alike, in the order in which the first of each comes.
std::vector<Comparisons> grouped(const Comparisons& comparisons,
                                 const std::function<bool(const Comparison&, const Comparison&)>& are_alike);
/// The median one of each that has a round of those figures.
std::vector<double> ratios_of(const Comparisons& comparisons, Figures Comparison::*figures = &Comparison::figures);

}  // namespace dmpc::apps
