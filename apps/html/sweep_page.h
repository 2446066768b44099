// The page of a study: what a sweep found, as plots and tables.
#pragma once

#include <iosfwd>
#include <span>
#include <string>
#include <vector>

#include "apps/plot.h"
#include "apps/study_table.h"

namespace dmpc::apps::html {

/// A table and the plots of it.
struct SweepPart {
  std::string heading;  ///< of its section; empty: none
  const Table& table;   ///< outlives this
  std::vector<Plot> plots;
};

/// The whole document. What could not be drawn is told to `complaints`. Throws core::InputError if no temporary file can be
/// written.
std::string sweep_page(const std::string& title, const std::vector<std::string>& texts, std::span<const SweepPart> parts,
                       std::ostream& complaints);

}  // namespace dmpc::apps::html
