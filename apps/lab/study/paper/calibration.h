// The two figures of the modelled iPSC/2 that are fitted to two cells of the article's Table 3: Mountain on one node and on two.
#pragma once

#include <array>
#include <optional>

#include "apps/frontend/table/table.h"
#include "apps/lab/study/paper/catalogue.h"
#include "nodes/machine.h"

namespace dmpc::apps {

/// Factors for the figures.
struct Fit {
  double operations = 1;     ///< for the prices of all operations, including a cached look-up
  double cached_lookup = 1;  ///< an additional factor for a cached look-up
};

/// Seconds of the calibration's scene on a machine: on one node, on two, and on two with the price of a cached look-up doubled.
struct FitTimes {
  double one = 0, two = 0, two_with_dearer_lookups = 0;
};

/// Returns the factors that turn `found` into the `printed` seconds on one node and on two. The time on one node is assumed
/// proportional to the prices of operations (it has no look-ups of cached pages), that on two linear in the price of such a
/// look-up. Returns nothing if dearer look-ups took no longer, or if no price were low enough.
std::optional<Fit> fit_of(const FitTimes& found, const std::array<double, calibrated_places.size()>& printed);

nodes::Machine fitted(nodes::Machine machine, const Fit& fit);

/// Returns both figures, as in the preset and as the printed times require, from the three runs that they depend on and no
/// others.
Table calibration(const Catalogue& catalogue, const PaperResults& results);

}  // namespace dmpc::apps
