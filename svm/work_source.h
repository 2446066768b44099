// Where a node's next pixel comes from: its own share, then items that other nodes give away, then nowhere.
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

/// A picture whose pixels are shared out; the same on all nodes.
struct WorkShape {
  std::uint32_t worker_count = 1;  ///< the nodes that have pixels, the first ones
  std::uint32_t width = 1, height = 1;
  PixelTile tile;                             ///< pixels that a task takes at most
  std::uint32_t item_side = 3;                ///< pixels along the side of a work item; 0: no node gives work to another
  PixelShares shares = PixelShares::submaps;  ///< which pixels a node starts with
  /// The host's number, if all items are asked of it: then no node has a share.
  std::optional<std::uint32_t> dealer = std::nullopt;
  bool is_masked = false;                       ///< some pass may leave pixels out
  const core::PartialPicture* start = nullptr;  ///< what is done already, if anything; read by the constructor alone
};

/// A node without pixels sends one work request at a time. It hops along the ring of workers, from i to i + 1 mod N; the first
/// that has items left answers the requester directly; the last of all others to be asked tells it that there is no more work,
/// and since shares only shrink this stays true (except for a node that the word to begin a later pass has not reached yet:
/// a requester that is so told rests for that pass). The first request enters the ring at the next node, a later one at the node
/// that gave last, because all before it had nothing. Where the host assigns all items, every request goes to it.
///
/// For the same reason a node without items need not pass a request on to the next node (the skip idle-nodes): from itself up to
/// the node that gave it an item last, nobody has any, so requests go from donor to donor; and a node that knows of no more work
/// answers for all. This is the find of disjoint sets (R. Tarjan, "Efficiency of a Good But Not Linear Set Union Algorithm",
/// 1975), a node's set being those that it knows to be idle. Where many run out at one time nobody knows anything yet: so a node
/// that waits for an answer keeps a few of the others' requests until it has it. It keeps those of nodes of lower rank, an order
/// by hash, so no two wait for each other, and whoever ranks highest of those that ask is kept by none. What a node knows is of
/// its own pass: a request of a later one goes to the next node. Thread safety: none.
///
/// Where the picture is refined, a pass after the first has those samples of its share's pixels that the host's mask names;
/// where it was begun by another run, so has the first one, of the pixels that are missing.
class WorkSource {
 public:
  /// In the first pass all samples are wanted that shape.start lacks.
  WorkSource(nodes::Node& node, const WorkShape& shape, bool passes_over_idle = true);
  /// What the constructor takes at node `index`.
  static nodes::Layout<core::SampleStep, WorkRequest> layout(const WorkShape& shape, std::uint32_t index);

  /// A pixel of the current item, of the share, or of an item received is left.
  bool has_pixel() const { return !scan_.empty() || !items_.empty(); }
  /// Requires has_pixel().
  std::uint32_t next_pixel();
  /// What this pass brings the next pixel. Requires has_pixel().
  core::SampleStep next_step();
  /// Of the picture, in pixels.
  std::uint32_t image_width() const { return image_width_; }
  /// The next pixel lies in the tile of the one before.
  bool stays_in_tile() const { return scan_.stays_in_tile(); }
  /// Takes items that lie side by side, come next and show nothing but `background`, and returns the rectangle of their pixels:
  /// one without a pixel if the next pixel is in no such item, or items have more than `height_max` rows. Only where no pass
  /// leaves pixels out and none are interleaved.
  PixelRectangle take_background(const core::BackgroundTiles& background, std::uint32_t height_max);
  /// Sends a work request, unless one is under way or would be in vain. Requires !has_pixel().
  void ask();
  /// Gives an item to the requester, or passes the request on or keeps it for a while, or says that there is none.
  void answer(const WorkRequest& request);
  /// Takes the answer to this node's own request.
  void take_reply(const nodes::Packet& packet);
  /// Takes a part of the next pass's mask. Requires exhausted(), as begin_pass() does.
  void take_mask(const MaskPart& part);
  /// Starts with the whole share again, as far as the mask wants it.
  void begin_pass();
  /// The first pass of another picture. Requires exhausted().
  void begin_frame();

  /// No pixel is left here, and none anywhere else.
  bool exhausted() const { return !has_pixel() && no_more_; }
  WorkCounters counters() const { return counters_; }
  /// By requests that came here, since they were known to have no pixels.
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
  std::span<core::SampleStep> mask_;  ///< of the share, row by row; empty unless is_masked()
  WorkItems items_;
  PixelScan scan_;
  ItemSteps steps_;  ///< of the item under way, if is_masked()
  WorkCounters counters_;
  std::uint64_t nodes_passed_over_ = 0;
  std::uint32_t first_donor_;
  std::uint32_t last_donor_;  ///< between this node and it nobody has an item in this pass
  std::uint32_t pass_ = 0;
  std::span<WorkRequest> kept_;  ///< the first kept_count_
  std::uint32_t kept_count_ = 0;
  bool asking_ = false;
  bool is_alone_;  ///< no other node ever gives it work
  bool no_more_;
};

}  // namespace dmpc::svm
