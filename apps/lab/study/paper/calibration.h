// The two figures of the modelled iPSC/2 that are fitted to two cells of the article's Table 3, Mountain on one node and on two.
#pragma once

#include <array>
#include <optional>

#include "apps/frontend/table/table.h"
#include "apps/lab/study/paper/catalogue.h"
#include "nodes/machine.h"

namespace dmpc::apps {

/// What the figures are to be multiplied by.
struct Fit {
  double operations = 1;     ///< the prices of all operations, that of a cached look-up too
  double cached_lookup = 1;  ///< that of a cached look-up once more
};

/// Seconds of the calibration's scene on a machine: on one node, on two, and on two with the price of a cached look-up doubled.
struct FitTimes {
  double one = 0, two = 0, two_with_dearer_lookups = 0;
};

/// What makes `found` the `printed` seconds on one node and on two. The time on one node is taken to be in proportion to the
/// prices of operations (it has no look-ups of cached pages), that on two to be linear in the price of such a look-up. Nothing if
/// dearer look-ups took no longer, or if none were cheap enough.
std::optional<Fit> fit_of(const FitTimes& found, const std::array<double, calibration_cell_count>& printed);

/// The machine with fitted prices.
nodes::Machine fitted(nodes::Machine machine, const Fit& fit);

/// Both figures, as they are in the preset and as the printed times ask for, from the three runs that they rest on and no others.
Table calibration(const Catalogue& catalogue, const PaperResults& results);

}  // namespace dmpc::apps
