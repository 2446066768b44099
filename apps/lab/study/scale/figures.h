// What one run of the study `scale` is found to take.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "apps/edge/table/table.h"
#include "apps/lab/figures/figures_file.h"

namespace dmpc::apps {

/// Seconds of wall clock by phase, as `render --stats` has them, and of all; `processor` those of all threads together in the
/// phase render. Bytes as megabytes. Memory: the process's anonymous memory at its peak, above that of a dmpc that does nothing;
/// local memory: all nodes' together. Moves: how often a ray of dataflow goes on to another node.
enum class ScaleFigure : std::uint8_t {
  load,
  build,
  prepare,
  render,
  total,
  processor,
  database,
  memory,
  local_memory,
  faults,
  packets,
  moves,
  pages,
};
inline constexpr std::size_t scale_figure_count = 13;

/// As a column of the table.
const Column& column_of(ScaleFigure figure);

/// Nothing where a figure does not apply.
class ScaleFigures {
 public:
  std::optional<double>& operator[](ScaleFigure figure) { return values_[static_cast<std::size_t>(figure)]; }
  const std::optional<double>& operator[](ScaleFigure figure) const { return values_[static_cast<std::size_t>(figure)]; }

  std::uint64_t primitives = 0;  ///< in the database
  std::string film_hash;

 private:
  std::array<std::optional<double>, scale_figure_count> values_;
};

/// Each by number.
std::vector<ScaleFigure> all_scale_figures();

/// From what `render --stats` writes, and the memory if it is known. Throws core::InternalError if figures are missing there.
ScaleFigures scale_figures_of(const std::vector<Figure>& stats, std::optional<std::size_t> memory_bytes);

/// Median by median of runs that give one film, which is asserted. Requires one at least.
ScaleFigures median_figures(const std::vector<ScaleFigures>& rounds);

/// The slope of log y over log x by least squares: y grows as x to that power. Only points with both above 0 count; nothing
/// unless two of those differ in x. Points are (x, y).
std::optional<double> growth_exponent(std::span<const std::pair<double, double>> points);

}  // namespace dmpc::apps
