// The pictures of the study `paper`.
#pragma once

#include <string>
#include <vector>

#include "apps/edge/table/plot.h"

namespace dmpc::apps {

/// A plot of one of its tables.
struct PaperPlot {
  std::string table;  ///< by the name of its files: "table_3"
  Plot plot;
};

/// What the article prints is drawn as points, what we found as lines or bars.
std::vector<PaperPlot> paper_plots();

}  // namespace dmpc::apps
