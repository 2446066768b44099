// The page of a study: the results of a sweep as plots and tables.
#pragma once

#include <string>
#include <vector>

#include "apps/frontend/show/page/origin.h"
#include "apps/frontend/show/page/page.h"
#include "apps/frontend/table/plot.h"
#include "apps/frontend/table/table.h"

namespace dmpc::apps::html {

struct SweepPart {
  std::string heading;  ///< heading of its section; empty: none
  const Table& table;   ///< outlives this
  std::vector<Plot> plots;
  std::string conclusion = {};  ///< a sentence; empty: none
};

struct Sweep {
  std::string title;
  std::vector<std::string> texts;  ///< paragraphs
  std::vector<SweepPart> parts;
  Facts results = {};  ///< identify another run with the same results
};

/// Returns the whole document. Throws core::InputError if no temporary file can be written.
std::string sweep_page(const Sweep& sweep, const Origin& origin);

}  // namespace dmpc::apps::html
