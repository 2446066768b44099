// What was measured of one thing, side by side with what it is held against, and contenders that are measured in turn.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "apps/frontend/system/progress.h"
#include "apps/frontend/system/stopwatch.h"
#include "apps/frontend/table/table.h"
#include "apps/lab/bench/speed/part.h"

namespace dmpc::apps {

/// Figures by round; of each round's two the ratio is taken, so that a busy minute of the machine touches both.
struct Figures {
  std::vector<double> subject = {}, baseline = {};

  /// Number of rounds with both figures.
  std::size_t rounds() const;
};

/// The middle one of the rounds' ratios of subject to baseline, and the outermost ones.
struct RatioSpread {
  double median = 0, least = 0, most = 0;
};
/// Requires a round, and figures of the baseline above 0.
RatioSpread ratio_of(const Figures& figures);

struct Comparison {
  SpeedPart part{};
  std::string scene;
  std::string what;               ///< "closest hit", "whole picture"
  std::string detail = {};        ///< a kind of `what`, such as the class of rays; may be empty
  std::uint32_t threads = 0;      ///< that worked, or nodes that rendered; 0: does not matter
  std::string subject, baseline;  ///< whose figures they are
  std::string unit;               ///< unit of the figures: "Mray/s", "s"
  Figures figures = {};           ///< times are by the wall clock, unless the unit says otherwise
  Figures processor = {};         ///< processor time, where both clocks are used

  /// As above with a single round of these figures.
  Comparison once(double subject_figure, double baseline_figure) const;
};

/// Some of what was measured, each outliving this.
using Comparisons = std::vector<const Comparison*>;
/// The comparisons that have a round.
Comparisons measured(std::span<const Comparison> comparisons);
/// In groups of such as are alike, in the order in which the first of each comes.
std::vector<Comparisons> grouped(const Comparisons& comparisons,
                                 const std::function<bool(const Comparison&, const Comparison&)>& are_alike);
/// The median one of each that has a round of those figures.
std::vector<double> ratios_of(const Comparisons& comparisons, Figures Comparison::*figures = &Comparison::figures);

/// What stands in place of a figure: a round without it is none of the comparisons that ask for it.
inline constexpr double no_figure = std::numeric_limits<double>::quiet_NaN();

/// Not thread-safe.
class Matches {
 public:
  /// The figures of one contender in one round; no_figure is one that could not be measured.
  using Measure = std::function<std::vector<double>()>;

  /// `results` outlives it, and has what was measured so far at any time.
  explicit Matches(std::vector<Comparison>& results) : results_(results) {}

  /// Returns the number by which the others know the contender.
  std::size_t add(Measure measure);
  /// Adds `comparison` to the results: of each round a figure of the subject, against the same one of the baseline. They may be
  /// one.
  void compare(std::size_t subject, std::size_t baseline, Comparison comparison, std::size_t figure = 0);
  /// Does as the other, and takes the next figure for processor time, of those who have figures_of() their times.
  void compare_timed(std::size_t subject, std::size_t baseline, Comparison comparison);

  /// All contenders, in the order in which they came, in every round. Throws what measuring throws.
  void measure(std::size_t rounds, Progress& progress);

 private:
  struct Pair {
    std::size_t subject, baseline, figure;
    std::size_t comparison;  ///< its place among the results
    Figures Comparison::*figures = &Comparison::figures;

    std::size_t later() const { return std::max(subject, baseline); }
  };

  std::vector<Comparison>& results_;
  std::vector<Measure> contenders_;
  std::vector<Pair> pairs_;
};

/// By the wall clock and by processor time; above 0, since ratios are taken to them.
std::vector<double> figures_of(const Times& times);

/// For each part, thing measured and pair the geometric mean of the ratios over scenes and kinds, in processor time, too, where
/// there are two clocks, and of each kind by itself, and the outermost ones, in the order in which they come first; no mean where
/// a ratio is 0.
Table headline_of(std::span<const Comparison> comparisons, const std::string& title);

/// A row for each comparison that has been measured, in their order.
Table table_of(std::span<const Comparison> comparisons, const std::string& title);

}  // namespace dmpc::apps
