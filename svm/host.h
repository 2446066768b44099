// The host's program: takes the finished pixels, counts finished nodes, begins passes, stops the run; and may serve pages.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/picture/film/film.h"
#include "core/picture/film/partial_picture.h"
#include "nodes/node.h"
#include "nodes/observers/watching.h"
#include "nodes/pictures/host.h"
#include "svm/packets.h"
#include "svm/pages/home_pages.h"
#include "svm/pages/page_server.h"
#include "svm/plan.h"

namespace dmpc::svm {

/// Every pixel of a pass arrives exactly once, which it checks, and with all samples: its state can be saved at any time. When
/// every node is done and the film complete, it ends the pass; if another follows, it sends each node its share's part of the
/// mask, and begins the pass when all have theirs; otherwise it sends each node a Stop. If it assigns the work, in items of the
/// whole picture, no node has a share, and replies say which samples an item's pixels have. If it is home to all pages, it
/// replies to requests for them from its own memory, as a node would.
class HostProgram final : public pictures::Host {
 public:
  /// As pictures::Host. `plan` outlives the program, and the database of its request does if nodes refer to it.
  HostProgram(nodes::Node& node, const Plan& plan, core::Film& film, nodes::Progress progress,
              const core::Continuation& continuation = {});
  /// The memory that the constructor takes.
  static nodes::MemoryPlan layout(const Plan& plan);

  /// Resets what is reported, for the next picture.
  void begin_frame(const core::FineDetail* detail) override;

  void receive(const nodes::Packet& packet) override;
  bool work() override { return false; }
  bool finished() const override { return stopped_; }
  nodes::Levels levels() const override { return {{"pixels done", pixels_done()}}; }
  std::string describe() const override;

  void keep_interrupted() const override;
  /// Number of replies to page requests.
  std::uint64_t pages_served() const { return home_ ? home_->server.served() - served_before_ : 0; }
  /// Number of work items assigned, over all passes.
  std::uint64_t items_given() const { return items_given_; }
  /// Number of pixels done by this run, over all passes.
  std::uint64_t pixels_done() const { return pixels_of_old_passes_ + pixels_with_light() - pixels_found_done_; }

 private:
  /// State of a host that is home to all pages.
  struct Home {
    HomePages pages;
    PageServer server;
  };

  void serve(const nodes::Packet& packet);
  void take_film(const nodes::Packet& packet);
  void take_done(const Done& done);
  void grant_stops();
  PixelRectangle image() const { return {0, 0, plan_.request.width, plan_.request.height}; }
  PixelRectangle share_of(std::uint32_t index) const;
  void start_dealing();
  void assign(const WorkRequest& request);
  std::optional<PixelRectangle> next_item();
  ItemSteps steps_of(const PixelRectangle& item) const;
  void end_pass();
  void send_mask(std::uint32_t index);
  void begin_pass();
  void stop();

  const Plan& plan_;
  std::vector<std::uint32_t> pixels_sent_;  ///< pixels of the mask sent to each node; empty unless the picture is refined
  std::uint32_t node_count_;
  std::uint32_t assigned_side_;  ///< side of the work items that nodes ask the host for, in pixels; 0: they ask each other
  bool is_masked_;
  WorkItems items_;  ///< not assigned yet
  std::optional<Home> home_;
  std::uint64_t served_before_ = 0;  ///< pages served for earlier pictures
  std::uint64_t items_given_ = 0;
  std::uint32_t nodes_masked_ = 0;   ///< number of nodes that have their whole mask
  std::uint32_t pixels_found_done_;  ///< pixels of the first pass that were done before the start
  std::uint32_t nodes_done_ = 0;
  std::uint64_t pixels_announced_ = 0;
  std::uint64_t pixels_of_old_passes_ = 0;
  bool stopped_ = false;
};

}  // namespace dmpc::svm
