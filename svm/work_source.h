// The source of a node's next pixel: its own share, then items that other nodes give away, then none.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "core/picture/camera/background.h"
#include "core/picture/film/partial_picture.h"
#include "nodes/layout.h"
#include "nodes/node.h"
#include "svm/packets.h"
#include "svm/pages/node_program.h"
#include "svm/work_items.h"

namespace dmpc::svm {

/// A picture whose pixels are distributed; the same on all nodes.
struct WorkShape {
  std::uint32_t worker_count = 1;  ///< nodes that have pixels, the first ones
  std::uint32_t width = 1, height = 1;
  PixelTile tile;                             ///< maximum of a task
  std::uint32_t item_side = 3;                ///< pixels along the side of a work item; 0: no node gives work to another
  PixelShares shares = PixelShares::submaps;  ///< which pixels a node starts with
  /// The host's number, if all items are requested from it: then no node has a share.
  std::optional<std::uint32_t> dealer = std::nullopt;
  bool is_masked = false;                       ///< some pass may leave pixels out
  const core::PartialPicture* start = nullptr;  ///< what is done already, if anything; read by the constructor only
};

/// A node without pixels sends one work request at a time. It hops along the ring of workers, from i to i + 1 mod N; the first
/// that has items left answers the requester directly; the last of all others replies that there is no more work, and since
/// shares only shrink this stays true (except for a node that has not yet received the begin of a later pass: a requester that
/// gets this answer rests for that pass). The first request enters the ring at the next node, a later one at the last donor,
/// because all nodes before it had nothing. If the host assigns all items, every request goes to it.
///
/// For the same reason a node without items need not pass a request on to the next node (the skip idle-nodes): no node from
/// itself up to its last donor has any, so requests go from donor to donor; and a node that knows of no more work answers for
/// all. This is the find operation of disjoint sets (R. Tarjan, "Efficiency of a Good But Not Linear Set Union Algorithm", 1975),
/// where a node's set are those that it knows to be idle. If many run out at the same time none knows anything yet: so a node
/// that waits for an answer keeps a few of the others' requests until it has it. It keeps those of nodes of lower rank, an order
/// by hash, so no two wait for each other, and the request of the highest rank is kept by none. What a node knows holds for its
/// own pass: a request of a later one goes to the next node. Not thread-safe.
///
/// If the picture is refined, a pass after the first has the samples of its share's pixels given by the host's mask; if another
/// run began the picture, so has the first one, for the missing pixels.
class WorkSource {
 public:
  /// The first pass renders all samples that shape.start lacks.
  WorkSource(nodes::Node& node, const WorkShape& shape, bool passes_over_idle = true);
  /// The memory that the constructor takes at node `index`.
  static nodes::Layout<core::SampleStep, WorkRequest> layout(const WorkShape& shape, std::uint32_t index);

  /// Whether a pixel of the current item, of the share, or of a received item is left.
  bool has_pixel() const { return !scan_.empty() || !items_.empty(); }
  /// Requires has_pixel().
  std::uint32_t next_pixel();
  /// The next pixel's samples in this pass. Requires has_pixel().
  core::SampleStep next_step();
  /// The picture's, in pixels.
  std::uint32_t image_width() const { return image_width_; }
  /// Whether the next pixel lies in the tile of the one before.
  bool stays_in_tile() const { return scan_.stays_in_tile(); }
  /// Takes adjacent next items that show only `background`, and returns the rectangle of their pixels: empty if the next pixel is
  /// in no such item, or items have more than `height_max` rows. Only if no pass leaves pixels out and none are interleaved.
  PixelRectangle take_background(const core::BackgroundTiles& background, std::uint32_t height_max);
  /// Sends a work request, unless one is in flight or would be in vain. Requires !has_pixel().
  void ask();
  /// Gives an item to the requester, or passes the request on or keeps it for a while, or replies that there is none.
  void answer(const WorkRequest& request);
  /// Takes the answer to this node's own request.
  void take_reply(const nodes::Packet& packet);
  /// Takes a part of the next pass's mask. Requires exhausted(), as begin_pass() does.
  void take_mask(const MaskPart& part);
  /// Starts with the whole share again, as far as the mask has samples.
  void begin_pass();
  /// The first pass of another picture. Requires exhausted().
  void begin_frame();

  /// Whether no pixel is left here or elsewhere.
  bool exhausted() const { return !has_pixel() && no_more_; }
  WorkCounters counters() const { return counters_; }
  /// Number of nodes that requests from here skipped, since they were known to have no pixels.
  std::uint64_t nodes_passed_over() const { return nodes_passed_over_; }
  std::string describe() const;

 private:
  bool knows_of(const WorkRequest& request) const;
  bool keeps(const WorkRequest& request) const;
  std::uint32_t steps_to(std::uint32_t node) const;
  std::uint32_t steps_for(const WorkRequest& request) const;
  void send(std::uint32_t node, const WorkRequest& request);
  void pass_on(const WorkRequest& request);
  void pass_on_kept();
  bool is_masked() const { return !mask_.empty(); }
  void want_missing(const core::PartialPicture& start);
  ItemSteps steps_of(const PixelRectangle& item) const;
  bool is_wanted(const PixelRectangle& item) const;
  void open(const PixelRectangle& item, const ItemSteps& steps);
  void open_next();
  void skip_unwanted();
  std::optional<PixelRectangle> give();
  void reply(std::uint32_t requester, const PixelRectangle& item);

  nodes::Node* node_;
  std::uint32_t worker_count_;
  std::uint32_t self_;
  std::uint32_t image_width_;
  std::uint32_t item_side_;
  bool passes_over_idle_;
  PixelTile tile_;
  PixelRectangle share_;
  std::span<core::SampleStep> mask_;  ///< steps of the share, row by row; empty unless is_masked()
  WorkItems items_;
  PixelScan scan_;
  ItemSteps steps_;  ///< the current item's, if is_masked()
  WorkCounters counters_;
  std::uint64_t nodes_passed_over_ = 0;
  std::uint32_t first_donor_;
  std::uint32_t last_donor_;  ///< no node between this and that one has an item in this pass
  std::uint32_t pass_ = 0;
  std::span<WorkRequest> kept_;  ///< the first kept_count_ are used
  std::uint32_t kept_count_ = 0;
  bool asking_ = false;
  bool is_alone_;  ///< no other node ever gives it work
  bool no_more_;
};

}  // namespace dmpc::svm
