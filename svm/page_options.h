// What a run with pages may choose: options, runs and plans have it as a member.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/trace/bundle.h"
#include "svm/pages/home.h"
#include "svm/pages/replacement.h"
#include "svm/work_items.h"

namespace dmpc::svm {

class ReferenceLog;

/// Pixels whose rays walk in bundles.
inline constexpr std::uint32_t bundle_pixels = core::bundle_rays_max;

/// Whom a node without pixels asks for a work item.
enum class WorkDonor : std::uint8_t {
  ring,  ///< the nodes round the ring: each starts with a share of the pixels, and gives of what is left of it
  host   ///< the host, which has the whole picture: nodes start with nothing, and every item is assigned on demand
};
/// As the command line calls it.
constexpr const char* name_of(WorkDonor donor) { return donor == WorkDonor::ring ? "ring" : "host"; }

/// Options of svm and, as far as no page travels, of replicated. `optional` without a value means: choose.
struct PageOptions {
  /// Frames of each node's cache; svm only. With a memory bound and without this, the cache takes all that is left.
  std::optional<std::uint32_t> cache_pages = std::nullopt;
  /// Where pages are at home; svm only. At the host: all that a node keeps of the scene is its cache.
  PageHomes homes = PageHomes::spread;
  /// How many percent of the frames have pages that every node keeps for good, those that a small picture uses most
  /// (svm/resident.h); svm only. At least one frame is left for others.
  std::uint32_t resident_percent = 0;
  Replacement replacement = Replacement::lru;  ///< which page of the cache makes room; svm only
  /// Pixels under way on a node, rounded down to whole bundles where rays walk in bundles of 16. Without it 64 for svm: a node
  /// whose bundle waits for a page has others to go on with, while their stacks take about 3 % of a 4 MiB node; and 16 for
  /// replicated, where nothing is ever waited for. Where rays walk alone 16 and 1.
  std::optional<std::uint32_t> in_flight = std::nullopt;
  /// Pixels along the side of a work item; 0: no node gives work to another. Without it 4, a bundle, or 3 where rays walk alone.
  std::optional<std::uint32_t> work_item_side = std::nullopt;
  /// On a modelled machine, too, rays of neighbouring pixels walk together: with look-ups, events and times of their own, in less
  /// of the real computer's time. Where nobody looks on pixel by pixel, and 16 pixels are in flight; svm only.
  bool bundles_on_machines = false;
  WorkDonor work_donor = WorkDonor::ring;           ///< host: not with work_item_side = 0
  PixelShares pixel_shares = PixelShares::submaps;  ///< interleaved: not with work_donor = host, where nodes start with none
  /// Nodes that render, the first ones; the others lend their memories and serve pages, as the article had for scenes that one
  /// memory does not hold. Without it all do.
  std::optional<std::uint32_t> worker_count = std::nullopt;
  bool count_pages = false;  ///< the distinct pages of each pixel; costs a bit a page for each pixel in flight
  /// Record every node's page references, run_svm() only: an instrument, whose memory is no node's and grows with the run. Needs
  /// work_item_side = 0 and in_flight = 1, else the references would depend on the cache and the schedule. Not with count_pages.
  bool record_references = false;
  /// One for each node, where run_svm() notes what the node references, in whatever order it comes, unless different pages are
  /// counted. Outlive the run.
  std::vector<ReferenceLog>* reference_logs = nullptr;
};

/// What work_item_side is. `bundles`: rays of neighbouring pixels walk together, where enough are in flight.
constexpr std::uint32_t work_item_side_of(const PageOptions& pages, bool bundles) {
  return pages.work_item_side.value_or(bundles && pages.in_flight.value_or(bundle_pixels) >= bundle_pixels ? 4 : 3);
}

}  // namespace dmpc::svm
