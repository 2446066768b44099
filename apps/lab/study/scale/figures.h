// What one run of the study `scale` is found to take.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "apps/frontend/table/table.h"
#include "apps/lab/figures/figures_file.h"

namespace dmpc::apps {

/// Its columns of the table. Seconds of wall clock by phase, as `render --stats` has them, and of all; `processor` those of all
/// threads together in the phase render. Bytes as megabytes. Memory: the process's anonymous memory at its peak, above that of a
/// dmpc that does nothing; local memory: all nodes' together. Moves: how often a ray of dataflow goes on to another node.
const std::vector<Column>& scale_figure_columns();

struct ScaleFigures {
  std::map<std::string, double> by_name;  ///< of the columns, as far as they apply
  std::uint64_t primitives = 0;           ///< in the database
  std::string film_hash;

  std::optional<double> operator[](const std::string& name) const {
    const auto found = by_name.find(name);
    return found == by_name.end() ? std::nullopt : std::optional(found->second);
  }
};

/// From what `render --stats` writes, and the memory if it is known. Throws core::InternalError if figures are missing there.
ScaleFigures scale_figures_of(const std::vector<Figure>& stats, std::optional<std::size_t> memory_bytes);

/// Median by median of runs that give one film, which is asserted. Requires one at least.
ScaleFigures median_figures(const std::vector<ScaleFigures>& rounds);

/// The slope of log y over log x by least squares: y grows as x to that power. Only points with both above 0 count; nothing
/// unless two of those differ in x. Points are (x, y).
std::optional<double> growth_exponent(std::span<const std::pair<double, double>> points);

}  // namespace dmpc::apps
