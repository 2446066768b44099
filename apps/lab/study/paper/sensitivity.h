// How much of Table 3 hangs on each figure of the modelled machine.
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
  std::string value;   ///< as it is unchanged, with its unit; empty for a switch
  std::string change;  ///< "-20 %", "+20 %"; in words if it is neither, and then no part of the picture
  nodes::Machine machine;
};

/// Each price of an operation that is not zero by a fifth less and more, all of them together, the figures of messages and of the
/// interrupt likewise, a home look-up (which is free in the presets) at a fifth of a cached one's price, and without contention.
/// Prices of operations that no run of Table 3 does are left out: spheres, cones, and rays that travel.
std::vector<Variation> variations_of(const nodes::Machine& machine);

/// The runs whose efficiencies are watched: Mountain on 2 and 64 nodes, Rings4 on 64, Tetra9 on 32 and 64.
inline constexpr std::array<PaperPlace, 5> watched_cells = {{{1, 1}, {1, 6}, {2, 6}, {3, 5}, {3, 6}}};

/// The runs of one variation, by scene and column: those of the watched cells and of what they are held against.
struct VariedRuns {
  Variation variation;
  std::array<Catalogue::ByNodeCount, paper_scenes.size()> timed{};
};

/// Adds the runs of all variations of Table 3's machine, one variation after the other, to the catalogue.
std::vector<VariedRuns> add_variations(Catalogue& catalogue);

/// A row a variation whose runs have ended: what becomes of the watched cells' efficiencies, and of how far they lie from what is
/// printed.
Table sensitivity(const Catalogue& catalogue, const PaperResults& results, const std::vector<VariedRuns>& varied);

}  // namespace dmpc::apps
