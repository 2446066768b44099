// The page of a study: what a sweep found, as plots and tables.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "apps/frontend/show/page/origin.h"
#include "apps/frontend/show/page/page.h"
#include "apps/frontend/table/plot.h"
#include "apps/frontend/table/table.h"
#include "apps/show/page/forecast_view.h"

namespace dmpc::apps::html {

/// A table and the plots of it.
struct SweepPart {
  std::string heading;  ///< heading of its section; empty: none
  const Table& table;   ///< outlives this
  std::vector<Plot> plots;
  std::string conclusion = {};  ///< a sentence; empty: none
};

/// The contents of a page.
struct Sweep {
  std::string title;
  std::vector<std::string> texts;  ///< paragraphs
  std::vector<SweepPart> parts;
  Facts results = {};                         ///< by which another run is known to be the same
  std::optional<ForecastView> forecast = {};  ///< from one of its runs, beside all of them
};

/// The whole document. Plots that cannot be drawn are reported to `complaints`. Throws core::InputError if no temporary file can
/// be written.
std::string sweep_page(const Sweep& sweep, const Origin& origin, std::ostream& complaints);

}  // namespace dmpc::apps::html
