// The runs of the study `paper`: the article's scenes on modelled machines, as many at a time as there are cores.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/frontend/run/time_parts.h"
#include "apps/frontend/system/interrupt.h"
#include "apps/lab/study/paper/data.h"
#include "apps/run/strategy_options.h"
#include "apps/scene/subject.h"
#include "core/database/structure.h"
#include "core/trace/charge.h"
#include "dataflow/ray_options.h"
#include "nodes/machine.h"
#include "svm/page_options.h"

namespace dmpc::apps {

struct PaperRun {
  std::string scene;  ///< a built-in scene's name
  std::uint32_t node_count = 1;
  Strategy strategy = Strategy::svm;
  nodes::Machine machine;
  std::optional<double> cache_share = std::nullopt;  ///< svm: size of a node's cache as a share of the database; at least a page
  std::optional<std::uint32_t> cache_pages = std::nullopt;  ///< svm: size of a node's cache, in place of a share
  /// svm, in place of either: pages of a node's shared memory. The cache gets what the node's own pages leave of them, at most
  /// all others, at least a page.
  std::optional<std::uint32_t> shared_pages = std::nullopt;
  /// Grid is dmpc's own structure; voxels is the article's, by core::article_voxels, without the skips that its program did not
  /// have.
  core::Structure structure = core::Structure::grid;
  bool lacks_later_skips = false;             ///< grid and extents: also without those skips
  svm::PageOptions pages = {.in_flight = 1};  ///< svm and replicated, except for the cache
  dataflow::RayOptions rays = {};             ///< dataflow; regions are mapped onto the machine
  std::optional<std::size_t> node_memory_bytes = std::nullopt;
  std::uint32_t resolution = 512;  ///< pixels a side
  /// One light in the middle of the scene, which is Rings4, replaces its own lights, which are outside. Rays then also visit
  /// regions on their way in which they hit nothing.
  bool has_inner_light = false;
};

struct PaperResult {
  std::uint64_t total_ns = 0;
  TimeParts parts;  ///< summed over the nodes
  std::uint64_t rays = 0, references = 0, faults = 0, page_bytes = 0;
  std::uint64_t tests = 0;        ///< of rays against primitives
  core::ChargeCounts charges{};   ///< operations that computing was charged for, if pages travelled
  double average_load = 0;        ///< mean over maximum of the nodes' work, if rays travelled
  double overflowed = 0;          ///< packets of rays sent by way of the host over all, in [0, 1]
  std::uint64_t ray_bytes = 0;    ///< of the packets with rays, by either way
  double flood = 0;               ///< arrivals at a light's region or at a page's home, over the mean (hot_spots.h)
  std::uint32_t cache_pages = 0;  ///< of a node, if pages travelled
  double pages_a_pixel = 0;       ///< if they were counted
  std::size_t database_bytes = 0;
  std::uint64_t film_hash = 0;

  double seconds() const { return 1e-9 * static_cast<double>(total_ns); }
  /// Returns the percentage of the nodes' time.
  double percent(TimePart part) const { return parts.percent()[static_cast<std::size_t>(part)]; }
  /// Returns the share of page look-ups for which a page had to travel.
  double miss_ratio() const { return references == 0 ? 0 : static_cast<double>(faults) / static_cast<double>(references); }
  /// Returns the bytes of pages that a node receives per second.
  double page_rate(std::uint32_t node_count) const {
    return static_cast<double>(page_bytes) / static_cast<double>(node_count) / seconds();
  }
};

/// A scene of the study, built once.
struct PaperSubject {
  std::string scene;
  std::uint32_t resolution = 0;
  bool has_inner_light = false;
  core::Structure structure = core::Structure::grid;
  bool lacks_later_skips = false;
  Subject subject;

  /// Returns whether this is the run's scene.
  bool is_of(const PaperRun& run) const {
    return scene == run.scene && resolution == run.resolution && has_inner_light == run.has_inner_light &&
           structure == run.structure && lacks_later_skips == run.lacks_later_skips;
  }
};
/// Loads the scenes that the runs need. The largest takes about a second.
std::vector<PaperSubject> paper_subjects(std::span<const PaperRun> runs);
/// Returns the subject that the run needs, which must exist.
const Subject& subject_of(const PaperRun& run, std::span<const PaperSubject> subjects);

/// Results by a run's index; nothing if it was not completed.
using PaperResults = std::vector<std::optional<PaperResult>>;

/// Stores each run's result in `results`, which has as many elements as there are runs, and then reports it to `told`; after a
/// signal some results, mostly the last, are left unchanged. Progress goes to stderr if that is a terminal. Throws
/// core::InternalError if two runs of one scene and size give different films, and whatever a run throws: `results` has what was
/// finished before.
void carry_out(
    std::span<const PaperRun> runs, std::span<const PaperSubject> subjects, const Interrupt& interrupt, PaperResults& results,
    const std::function<void()>& reported = [] {});

}  // namespace dmpc::apps
