// The node program of dataflow: rays that come in, go on, hit, and leave for other regions.
//
// A quantum follows the table of flow_control.h: one ray, or one bundle of rays of a kind, is traced, from where it starts or
// enters until it ends or leaves the region; then rays go out one by one, as long as none of them has made a packet wait: the
// others stay in the bundle. What keeps the last node moving, and why every queue is bounded, is said there; the sums are in
// plan.cpp.
//
// Primary rays are started by credit: while a packet of this node's waits for one, or another node's queue is long, none is. A
// node that holds its primary rays back has no other work. It is not passive, so it keeps the token; but like one that rests it
// keeps nobody's credit. So when all have come to rest or hold back, every credit comes home, and one of them goes on.
//
// Who claims a hit: the owner of the cell in which the walk proves it the nearest. If that owner has met the same (t, primitive)
// itself, it shades the hit with its own copy of the record. If not, the hit goes to its finder, which alone knows where the
// record is. Either way one node shades it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "core/trace/operations.h"
#include "dataflow/backpressure.h"
#include "dataflow/film_gather.h"
#include "dataflow/flow_control.h"
#include "dataflow/moving_units.h"
#include "dataflow/no_units.h"
#include "dataflow/node_deal.h"
#include "dataflow/places.h"
#include "dataflow/plan.h"
#include "dataflow/rays/bundle_task.h"
#include "dataflow/rays/gather.h"
#include "dataflow/rays/next_stop.h"
#include "dataflow/rays/pixel_order.h"
#include "dataflow/rays/primaries.h"
#include "dataflow/rays/ray_queue.h"
#include "dataflow/rays/ray_task.h"
#include "dataflow/regions/regions.h"
#include "dataflow/termination.h"
#include "dataflow/units/movement.h"
#include "nodes/node.h"
#include "nodes/program.h"
#include "nodes/watch/meter.h"

namespace dmpc::dataflow {

/// What a node counts beside core's operations and the packets.
struct RayCounters {
  std::array<std::uint64_t, core::ray_kind_count> in{}, out{};  ///< rays received and sent, by kind; confirmed hits included
  std::uint64_t ended = 0;                                      ///< hit or miss; over all nodes as many as were shot
  std::uint64_t hits_sent_back = 0;                             ///< confirmed here, shaded by their finder
  std::uint64_t rests = 0;                                      ///< times that the node ran out of work
  std::uint64_t tests_avoided = 0;  ///< lanes that rays had tested where they came from (RayOptions::tested_objects)
  std::uint64_t holds = 0;          ///< times that it asked the others to hold primary rays back
};

/// A value.
struct ProgramCounts {
  core::Operations operations;
  RayCounters rays;
  Gather::Counters gather;
  FilmGather::Counters film;
  MovementCounters movement;
  std::uint32_t backlog_high_water = 0;  ///< the most rays in the backlog at once
};
static_assert(std::is_trivially_copyable_v<ProgramCounts>, "it travels as bytes to the host's rank");

/// All that a program counted.
struct ProgramReport : ProgramCounts {
  std::vector<SentToOwner> pairs;  ///< by owner, ascending; of whom there was a ray
};

/// What all node programs of dataflow are, whatever their rays share.
class NodeProgram : public nodes::Program {
 public:
  /// What the program of the plan takes at node `index`.
  static nodes::MemoryPlan layout(const Plan& plan, std::uint32_t index);
  /// Call it only while the program is not running.
  virtual ProgramReport report() const = 0;
  /// The run of the picture before has ended: another one follows, of the same size and samples, from another place. The node
  /// keeps its regions, and what it counts goes on. Of `settings` the header is the whole database's. Call it only while the
  /// program is not running, where the host deals all primary rays.
  virtual void begin_frame(const core::RenderSettings& settings) = 0;

 protected:
  /// What never changes but for whose the regions are, in local memory.
  struct Constants {
    core::RenderSettings settings;  ///< header: the part's
    Regions regions;
    core::DatabaseHeader outline;
  };
};

/// `RaysTask` is RayTask or BundleTask, `Units` NoUnits or MovingUnits, as the plan says.
template <class RaysTask, class Units = NoUnits>
class RayProgram final : public NodeProgram {
 public:
  /// Takes all its memory and credits from `node`. `meter` is there where somebody wants to know what is done for which pixel: a
  /// quantum that works on a ray is that ray's pixel's; what rays cost when they come in, and sending what waits, is nobody's.
  RayProgram(nodes::Node& node, const Plan& plan, const NodeDeal& deal, const std::optional<nodes::Meter>& meter = std::nullopt);

  void receive(const nodes::Packet& packet) override;
  bool work() override;
  bool finished() const override { return stopped_; }
  bool has_leftovers() const override { return puts_off_flush_; }
  nodes::Charges charges() const override;
  nodes::Levels levels() const override;
  std::string describe() const override;
  ProgramReport report() const override;
  void begin_frame(const core::RenderSettings& settings) override;

 private:
  /// What is known of the ray that was started, taken up or made last; `sample`: that of the primary ray started last.
  struct Newest {
    std::uint32_t pixel = 0, sample = 0, depth = 1;
  };
  NodeState state() const;
  bool packet_waits() const { return gather_.waits() || film_.waits(); }
  bool puts_off(Task task);
  void perform(Task task);
  void perform_metered(Task task);
  nodes::HeatTotals totals() const;
  void wake();
  void receive_primaries(const DealtPrimaries& dealt);
  void receive_rays(const nodes::Packet& packet);
  void take_credits(nodes::NodeId receiver, std::uint32_t count);
  void announce();
  void take_hold(nodes::NodeId teller, const Hold& hold);
  void hold_told_below();
  void send_waiting();
  void take_received();
  void take_up(std::span<const std::byte> message, std::uint32_t account);
  bool has_primaries() const { return !primaries_.empty() || units_.primaries_left() > 0; }
  void start_primaries();
  void start_primary();
  void leave_background(std::uint32_t pixel, std::uint32_t sample);
  core::FixedColor fixed(const core::Color& found) const;
  void leave_light(const core::Ray& ray, const core::Color& found);
  void go_on();
  void trace();
  template <class Make>
  void shoot(const Make& make);
  void go_to_stop();
  void end_ray();
  void end_hit();
  void end_blocked();
  void shade_at_finder(const RayMessage& hit);
  void count_claim(core::RayKind kind);
  void end_miss(const core::Ray& ray);
  core::Color light_of_sky(const core::Ray& ray);
  void dispatch(nodes::NodeId owner, const RayMessage& message);
  void give_back(std::uint32_t account, bool rests);
  void grant_places();
  void send_credits(nodes::NodeId sender, std::uint32_t count);
  void rest();
  void be_passive();
  void finish();
  void settle();

  std::optional<nodes::Meter> meter_;
  nodes::Node* node_;
  nodes::NodeId host_;
  Constants* constants_;
  Units units_;
  PartRecords records_;
  Surroundings surroundings_;
  PartTracer tracer_;
  Primaries primaries_;
  RayQueue backlog_;
  Places places_;
  std::uint32_t tested_objects_;
  PixelOrder pixel_order_;
  bool leaves_runs_;  ///< of background
  RaysTask task_;
  Gather gather_;
  FilmGather film_;
  bool tells_host_alone_;          ///< what others are to hold back
  std::uint32_t holds_below_ = 0;  ///< members below that have been told what to hold back, and have not acknowledged it
  Backpressure backpressure_;
  Termination termination_;
  DoneBelow below_;
  core::Operations operations_;
  RayCounters counters_;
  Newest newest_;                ///< of the quantum under way or just over, if it was one that works on a ray
  bool finishing_ = false;       ///< the host has proved that no ray of the pass is left
  bool flushes_ = false;         ///< or would have, in the last quantum
  bool puts_off_flush_ = false;  ///< until it is known that no packet comes soon
  bool done_ = false;
  bool stopped_ = false;
};

extern template class RayProgram<RayTask>;
extern template class RayProgram<BundleTask>;
extern template class RayProgram<RayTask, MovingUnits>;
extern template class RayProgram<BundleTask, MovingUnits>;

/// The program of the plan.
std::unique_ptr<NodeProgram> make_node_program(nodes::Node& node, const Plan& plan, const NodeDeal& deal,
                                               const std::optional<nodes::Meter>& meter = std::nullopt);

}  // namespace dmpc::dataflow
