// How much Table 3 depends on each figure of the modelled machine.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "apps/frontend/table/table.h"
#include "apps/lab/study/paper/catalogue.h"
#include "nodes/machine.h"

namespace dmpc::apps {

/// A machine with one of its figures changed.
struct Variation {
  std::string figure;
  std::string value;   ///< unchanged value with its unit; empty for a switch
  std::string change;  ///< "-20 %", "+20 %"; other changes are in words and not in the picture
  nodes::Machine machine;
};

/// Returns these variations: each price of an operation other than zero a fifth lower and higher, all of them together, the
/// figures of messages and of the interrupt likewise, a home look-up (free in the presets) at a fifth of a cached one's price,
/// and no contention. Prices of operations that no run of Table 3 performs are left out: spheres, cones, and travelling rays.
std::vector<Variation> variations_of(const nodes::Machine& machine);

/// The cells whose efficiencies are compared: Mountain on 2 and 64 nodes, Rings4 on 64, Tetra9 on 32 and 64.
inline constexpr std::array<PaperPlace, 5> watched_cells = {{{1, 1}, {1, 6}, {2, 6}, {3, 5}, {3, 6}}};

/// The runs of one variation, by scene and column: those of the watched cells and of their bases.
struct VariedRuns {
  Variation variation;
  std::array<RunsByNodeCount, paper_scenes.size()> timed{};
};

/// Adds the runs of all variations of Table 3's machine, one variation after the other, to the catalogue.
std::vector<VariedRuns> add_variations(Catalogue& catalogue);

/// Returns a row for each variation whose runs have ended: its effect on the watched cells' efficiencies, and on their
/// differences from the printed ones.
Table sensitivity(const Catalogue& catalogue, const PaperResults& results, const std::vector<VariedRuns>& varied);

}  // namespace dmpc::apps
