// Contenders that are measured in turn, and which of them are held against which others.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

#include "apps/edge/system/progress.h"
#include "apps/edge/system/stopwatch.h"
#include "apps/lab/bench/speed/comparison.h"

namespace dmpc::apps {

/// What stands in place of a figure: a round without it is none of the comparisons that ask for it.
inline constexpr double no_figure = std::numeric_limits<double>::quiet_NaN();

/// Not thread-safe.
class Matches {
 public:
  /// The figures of one contender in one round; no_figure is one that could not be told.
  using Measure = std::function<std::vector<double>()>;

  /// `results` outlives it, and has what was measured so far at any time.
  explicit Matches(std::vector<Comparison>& results) : results_(results) {}

  /// Returns the number by which the others know the contender.
  std::size_t add(Measure measure);
  /// Adds `comparison` to the results: of each round a figure of the subject, against the same one of the rival. They may be one.
  void compare(std::size_t subject, std::size_t rival, Comparison comparison, std::size_t figure = 0);
  /// Does as the other, and takes the next figure for processor time, of those who have figures_of() their times.
  void compare_timed(std::size_t subject, std::size_t rival, Comparison comparison, std::size_t figure = 0);

  /// All contenders, in the order in which they came, in every round. Throws what measuring throws.
  void measure(std::size_t rounds, Progress& progress);

 private:
  struct Pair {
    std::size_t subject, rival, figure;
    std::size_t comparison;  ///< its place among the results
    Figures Comparison::*figures = &Comparison::figures;

    std::size_t later() const { return std::max(subject, rival); }
  };

  std::vector<Comparison>& results_;
  std::vector<Measure> contenders_;
  std::vector<Pair> pairs_;
};

/// By the wall clock and by processor time; above 0, since ratios are taken to them.
std::vector<double> figures_of(const Times& times);

}  // namespace dmpc::apps
