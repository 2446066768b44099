// The host's program: takes the finished pixels, counts who is done, begins passes, stops the run; and serves pages if asked to.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/picture/film.h"
#include "core/picture/partial_picture.h"
#include "core/picture/refinement.h"
#include "nodes/node.h"
#include "nodes/program.h"
#include "nodes/watch/watching.h"
#include "svm/packets.h"
#include "svm/pages/home_pages.h"
#include "svm/pages/page_capacity.h"
#include "svm/pages/page_server.h"

namespace dmpc::svm {

/// A picture and who renders it.
struct HostShape {
  std::uint32_t node_count = 1;
  std::uint32_t worker_count = 1;  ///< as WorkShape has it
  std::uint32_t width = 1, height = 1;
  std::uint32_t first_samples = 1;  ///< of each pixel in the first pass
  std::uint32_t planes = 2;         ///< that an entry of film has light on
  std::uint32_t dealt_side = 0;     ///< of the work items that nodes ask the host for, in pixels; 0: they ask each other
  PixelShares shares = PixelShares::submaps;  ///< as WorkShape has it
  bool is_masked = false;                     ///< as WorkShape has it
  core::RefinementOptions refinement;
  const core::PartialPicture* start = nullptr;       ///< what is done already, if anything; read by the constructor alone
  const core::FineDetail* detail = nullptr;          ///< the picture's, if it is refined; outlives the host
  std::optional<PageCapacity> pages = std::nullopt;  ///< if the host is home to all of them
  std::span<const std::byte> database = {};          ///< in this case; read by the constructor, on modelled machines throughout

  std::uint32_t pixel_count() const { return width * height; }
};

/// Every pixel of a pass arrives exactly once, which it checks, and whole: what has arrived can be kept at any time. When every
/// node is done and the film complete, it ends the pass; if another follows, it sends each node its share's part of the mask,
/// and begins it when all have theirs; else it sends each node a Stop. Where it deals the work, in items of the whole picture, no
/// node has a share, and it tells each asker which samples an item's pixels have. Where it is home to all pages, it
/// replies to requests for them from its own memory, as a node would.
class HostProgram final : public nodes::Program {
 public:
  /// `film` outlives the program and is written by it alone until the run's end; it is as shape.start has it.
  /// `progress` may be empty.
  HostProgram(nodes::Node& node, const HostShape& shape, core::Film& film, nodes::Progress progress,
              const core::Continuation& continuation = {});
  /// What the constructor takes.
  static nodes::MemoryPlan layout(const HostShape& shape);

  /// The run of the picture before has ended: another one follows, on the same film, which is as new. `detail` is its own, as
  /// shape.detail was the first one's. What is reported is of this one. Call it only while the program is not running.
  void begin_frame(const core::FineDetail* detail);

  void receive(const nodes::Packet& packet) override;
  bool work() override { return false; }
  bool finished() const override { return stopped_; }
  nodes::Levels levels() const override { return {{"pixels done", pixels_done()}}; }
  std::string describe() const override;

  /// Deposits, and gatherings of planes, that saturated a sum on the host's film.
  std::uint64_t deposits_saturated() const { return deposits_saturated_ + refinement_.gatherings_saturated(); }
  /// Keeps what has arrived, if that is wanted: for when the run has been interrupted.
  void keep() const;
  /// Replies to requests for pages.
  std::uint64_t pages_served() const { return home_ ? home_->server.served() - served_before_ : 0; }
  /// Work items dealt, over all passes.
  std::uint64_t items_given() const { return items_given_; }
  /// By this run, over all passes.
  std::uint64_t pixels_done() const { return pixels_of_old_passes_ + pixels_done_ - pixels_found_done_; }
  const core::Refinement& refinement() const { return refinement_; }

 private:
  /// All pages.
  struct Home {
    HomePages pages;
    PageServer server;
  };

  void serve(const nodes::Packet& packet);
  void take_film(const nodes::Packet& packet);
  void take_pixel(std::uint32_t pixel, const core::PixelSums& sums);
  void take_done(const Done& done);
  PixelRectangle image() const { return {0, 0, width_, height_}; }
  PixelRectangle share_of(std::uint32_t index) const;
  bool has_arrived(std::uint32_t pixel) const { return (arrived_[pixel / 64] >> (pixel % 64) & 1U) != 0; }
  void start_dealing();
  void deal(const WorkRequest& request);
  std::optional<PixelRectangle> next_item();
  ItemSteps steps_of(const PixelRectangle& item) const;
  void end_pass();
  void send_mask(std::uint32_t index);
  void begin_pass();
  void stop();

  nodes::Node* node_;
  core::Film* film_;
  nodes::Progress progress_;
  core::Continuation continuation_;
  core::RefinementOptions wanted_;
  std::uint32_t first_samples_;
  core::Refinement refinement_;
  std::span<std::uint64_t> arrived_;        ///< a bit a pixel
  std::vector<std::uint32_t> pixels_sent_;  ///< of the mask, to each node; empty unless the picture is refined
  std::uint32_t node_count_, worker_count_, width_, height_, planes_, dealt_side_;
  PixelShares shares_;
  bool is_masked_;
  WorkItems items_;  ///< not dealt yet
  std::optional<Home> home_;
  std::uint64_t served_before_ = 0;  ///< pages, for earlier pictures
  std::uint64_t items_given_ = 0;
  std::uint32_t nodes_masked_ = 0;  ///< how many have their whole mask
  std::uint32_t pixels_done_ = 0;
  std::uint32_t pixels_found_done_ = 0;  ///< of them, before the start
  std::uint32_t nodes_done_ = 0;
  std::uint64_t pixels_announced_ = 0;
  std::uint64_t pixels_of_old_passes_ = 0;
  std::uint64_t deposits_saturated_ = 0;
  bool stopped_ = false;
};

}  // namespace dmpc::svm
