// The measured costs of one run of the study `scale`.
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

/// The table's columns. Seconds are wall clock by phase, as in `render --stats`, and in total; `processor` is that of all threads
/// together in the phase render. Bytes are in megabytes. Memory is the peak of the process's anonymous memory above that of an
/// idle dmpc; local memory is that of all nodes together. Moves count how often a ray of dataflow goes on to another node.
const std::vector<Column>& scale_figure_columns();

struct ScaleFigures {
  std::map<std::string, double> by_name;  ///< of the applicable columns
  std::uint64_t primitives = 0;           ///< in the database
  std::string film_hash;

  std::optional<double> operator[](const std::string& name) const {
    const auto found = by_name.find(name);
    return found == by_name.end() ? std::nullopt : std::optional(found->second);
  }
};

/// Reads them from the output of `render --stats`, with the memory if it is known. Throws core::InternalError if figures are
/// missing there.
ScaleFigures scale_figures_of(const std::vector<Figure>& stats, std::optional<std::size_t> memory_bytes);

/// Returns the medians, figure by figure, of runs with the same film, which is asserted. Requires at least one.
ScaleFigures median_figures(const std::vector<ScaleFigures>& rounds);

/// Returns the slope of log y over log x by least squares: y grows as x to that power. Only points (x, y) with both above 0
/// count; returns nothing unless two of those differ in x.
std::optional<double> growth_exponent(std::span<const std::pair<double, double>> points);

}  // namespace dmpc::apps
