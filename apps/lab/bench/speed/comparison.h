// Compares measurements of a subject with a baseline, for contenders that are measured in turn.
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

/// Figures by round. The ratio is taken within each round, so that a temporary load on the machine affects both figures.
struct Figures {
  std::vector<double> subject = {}, baseline = {};

  /// Returns the number of rounds with both figures.
  std::size_t rounds() const;
};

/// The median of the rounds' ratios of subject to baseline, and the extremes.
struct RatioSpread {
  double median = 0, least = 0, most = 0;
};
/// Requires at least one round, and figures of the baseline above 0.
RatioSpread ratio_of(const Figures& figures);

struct Comparison {
  SpeedPart part{};
  std::string scene;
  std::string what;               ///< "closest hit", "whole picture"
  std::string detail = {};        ///< a kind of `what`, such as the class of rays; may be empty
  std::uint32_t threads = 0;      ///< threads that worked, or nodes that rendered; 0: irrelevant
  std::string subject, baseline;  ///< names of the contenders
  std::string unit;               ///< unit of the figures: "Mray/s", "s"
  Figures figures = {};           ///< times are wall clock, unless the unit says otherwise
  Figures processor = {};         ///< processor time, if both clocks are used
  bool is_main = false;           ///< among those that say most

  /// As above with a single round of these figures.
  Comparison once(double subject_figure, double baseline_figure) const;
};

/// Some measured comparisons, which outlive this.
using Comparisons = std::vector<const Comparison*>;
/// Returns the comparisons that have a round.
Comparisons measured(std::span<const Comparison> comparisons);
/// Groups comparisons that are alike, in the order of the first of each group.
std::vector<Comparisons> grouped(const Comparisons& comparisons,
                                 const std::function<bool(const Comparison&, const Comparison&)>& are_alike);
/// Returns the median ratio of each comparison that has a round of those figures.
std::vector<double> ratios_of(const Comparisons& comparisons, Figures Comparison::*figures = &Comparison::figures);

/// Marks a missing figure: comparisons that use it skip the round.
inline constexpr double no_figure = std::numeric_limits<double>::quiet_NaN();

/// Not thread-safe.
class Matches {
 public:
  /// Returns the figures of one contender in one round; no_figure for one that could not be measured.
  using Measure = std::function<std::vector<double>()>;

  /// `results` outlives it, and has what was measured so far at any time.
  explicit Matches(std::vector<Comparison>& results) : results_(results) {}

  /// Returns the index of the contender for compare().
  std::size_t add(Measure measure);
  /// Adds `comparison` to the results: of each round a figure of the subject, against the same figure of the baseline. They may
  /// be the same contender.
  void compare(std::size_t subject, std::size_t baseline, Comparison comparison, std::size_t figure = 0);
  /// As above, and takes the next figure as processor time, for contenders whose times come from figures_of().
  void compare_timed(std::size_t subject, std::size_t baseline, Comparison comparison);

  /// Measures all contenders, in the order in which they were added, in every round. Throws what measuring throws.
  void measure(std::size_t rounds, Progress& progress);

 private:
  struct Pair {
    std::size_t subject, baseline, figure;
    std::size_t comparison;  ///< its index among the results
    Figures Comparison::*figures = &Comparison::figures;

    std::size_t later() const { return std::max(subject, baseline); }
  };

  std::vector<Comparison>& results_;
  std::vector<Measure> contenders_;
  std::vector<Pair> pairs_;
};

/// Returns wall clock and processor time, both above 0, since ratios to them are taken.
std::vector<double> figures_of(const Times& times);

/// Returns, for each part, measured quantity and pair, the geometric mean of the ratios over scenes and kinds (also in processor
/// time if there are two clocks), the mean for each kind, and the extremes, in the order of first occurrence; no mean if a ratio
/// is 0. Unless `all` are asked for, only of the main ones.
Table headline_of(std::span<const Comparison> comparisons, const std::string& title, bool all);

/// Returns a row for each comparison that has been measured, in their order.
Table table_of(std::span<const Comparison> comparisons, const std::string& title);

}  // namespace dmpc::apps
