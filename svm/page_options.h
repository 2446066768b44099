// Options of runs with pages; a member of options, runs and plans.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "core/trace/bundle.h"
#include "svm/pages/home.h"
#include "svm/pages/replacement.h"
#include "svm/work_items.h"

namespace dmpc::svm {

class ReferenceLog;

/// Pixels in flight by default on a node of a modelled machine, whatever travels. From 1 to 256 this is within 3 % of the best
/// for pages on every preset with caches of a quarter, and within 30 % for questions (svm/RESULTS.md). The article's nodes had 1.
inline constexpr std::uint32_t modelled_in_flight = 16;

/// Number of pixels whose rays are traced in bundles.
inline constexpr std::uint32_t bundle_pixels = core::bundle_rays_max;

/// Which process a node without pixels asks for a work item.
enum class WorkDonor : std::uint8_t {
  ring,  ///< the nodes on the ring: each starts with a share of the pixels, and gives away what is left of it
  host   ///< the host, which has the whole picture: nodes start with nothing, and every item is assigned on demand
};
/// As the command line calls it.
constexpr const char* name_of(WorkDonor donor) { return donor == WorkDonor::ring ? "ring" : "host"; }

/// Options of svm and, except for those about pages, of replicated. `optional` without a value means: choose.
struct PageOptions {
  /// Frames of each node's cache; svm only. With a memory limit and without this, the cache takes all that is left.
  std::optional<std::uint32_t> cache_pages = std::nullopt;
  /// Where pages are at home; svm only. At the host: a node stores nothing of the scene outside its cache.
  PageHomes homes = PageHomes::spread;
  /// Share of the frames, in percent, with pages that every node keeps permanently, those that a small picture uses most
  /// (svm/resident.h); svm only. At least one frame is left for others.
  std::uint32_t resident_percent = 0;
  Replacement replacement = Replacement::lru;  ///< which page is evicted; svm only
  /// Decides in place of `replacement`; svm on modelled machines only. Outlives runs and reports.
  const OwnPolicy* own_policy = nullptr;
  /// Pixels in flight on a node, rounded down to whole bundles where rays are traced in bundles of 16. By default 64 for svm: a
  /// node whose bundle waits for a page goes on with others, while their stacks take about 3 % of a 4 MiB node; and 16 for
  /// replicated, which never waits. For single rays 16 and 1, and on modelled machines modelled_in_flight for what waits.
  std::optional<std::uint32_t> in_flight = std::nullopt;
  /// Pixels along the side of a work item; 0: no node gives work to another. By default 4, a bundle, or 3 for single rays.
  std::optional<std::uint32_t> work_item_side = std::nullopt;
  /// Bundles of neighbouring pixels' rays also on a modelled machine: with different look-ups, events and times, in less of the
  /// real computer's time. Needs 16 pixels in flight, and no observer of single pixels; svm only.
  bool bundles_on_machines = false;
  WorkDonor work_donor = WorkDonor::ring;           ///< host: not with work_item_side = 0
  PixelShares pixel_shares = PixelShares::submaps;  ///< interleaved: not with work_donor = host, where nodes start with none
  /// Number of nodes that render, the first ones; the others provide their memories and serve pages, as in the article for scenes
  /// that do not fit one memory. By default all.
  std::optional<std::uint32_t> worker_count = std::nullopt;
  bool count_pages = false;  ///< the distinct pages of each pixel; costs a bit per page for each pixel in flight
  /// Record every node's page references, run_svm() only: an instrument, whose memory is no node's and grows with the run. Needs
  /// work_item_side = 0 and in_flight = 1, otherwise the references would depend on the cache and the schedule. Not with
  /// count_pages.
  bool record_references = false;
  /// One for each node, in which run_svm() records the node's references, in any order, unless distinct pages are counted.
  /// Outlive the run.
  std::vector<ReferenceLog>* reference_logs = nullptr;
};

/// Of the policy that decides which page is evicted; valid as long as that policy.
inline std::string_view policy_name(const PageOptions& pages) {
  return pages.own_policy != nullptr ? pages.own_policy->name() : name_of(pages.replacement);
}

/// The effective work_item_side. `bundles`: rays of neighbouring pixels are traced together, where enough are in flight.
constexpr std::uint32_t work_item_side_of(const PageOptions& pages, bool bundles) {
  return pages.work_item_side.value_or(bundles && pages.in_flight.value_or(bundle_pixels) >= bundle_pixels ? 4 : 3);
}

}  // namespace dmpc::svm
