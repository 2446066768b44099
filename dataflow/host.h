// The host's program: takes the film, buffers and forwards overflowing rays, detects termination and stops the run.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/picture/film/film.h"
#include "core/picture/film/partial_picture.h"
#include "dataflow/flow_control.h"
#include "dataflow/packets.h"
#include "dataflow/plan.h"
#include "dataflow/rays/buffered_rays.h"
#include "dataflow/rays/pending_primaries.h"
#include "dataflow/termination.h"
#include "nodes/layout.h"
#include "nodes/node.h"
#include "nodes/observers/watching.h"
#include "nodes/pictures/host.h"

namespace dmpc::dataflow {

/// The primary rays of a pass, without those of pixels that are done, by node: all of them, or nothing if a stop of the run was
/// requested meanwhile.
using AssignPrimaries =
    std::function<std::optional<std::vector<std::vector<PrimaryRun>>>(const core::Pass& pass, const core::PixelMask& done)>;

/// The host's counters in addition to the packets.
struct HostCounters {
  std::uint64_t rays_in = 0;             ///< overflowed
  std::uint64_t rays_out = 0;            ///< forwarded: at the end as many
  std::uint64_t rays_buffered_max = 0;   ///< at once
  std::size_t buffered_bytes_max = 0;    ///< maximum heap, beyond the plan, for buffered rays
  std::uint64_t token_rounds = 0;        ///< rounds of termination detection (termination.h)
  std::uint64_t film_entries = 0;        ///< received
  std::uint64_t deposits_saturated = 0;  ///< on the host's film, and gatherings of its planes
};

/// Depends on nobody: film and overflow are taken and acknowledged at once. When the end of a pass is detected and
/// its film complete, it assigns the primary rays of the next, if there is one, packet by packet as nodes have free slots. If the
/// plan says so it assigns those of the first pass, too. If then the picture is to be saved, it holds primary rays back until no
/// other is left anywhere, by the same detection: then the pixels that have begun are done. A pass that could not be assigned
/// completely never ends: the host then waits for the runner to end the run.
class HostProgram final : public pictures::Host {
 public:
  /// As pictures::Host. `assign` finds the owners of primary rays that are assigned after the start; it is kept only if the plan
  /// says that all are.
  HostProgram(nodes::Node& node, const Plan& plan, core::Film& film, nodes::Progress progress, AssignPrimaries assign,
              const core::Continuation& continuation = {}, const core::FineDetail* detail = nullptr);
  /// The local memory that the constructor takes.
  static nodes::MemoryPlan layout(const Plan& plan);

  /// `assign` finds the owners of the picture's primary rays. Counters go on, except those of saturation. Only if the plan says
  /// that the host assigns all primary rays.
  void begin_frame(const core::FineDetail* detail) override;

  void receive(const nodes::Packet& packet) override;
  bool work() override;
  bool finished() const override { return stopped_; }
  nodes::Levels levels() const override { return {{"pixels with light", pixels_with_light()}, {"rays kept", kept_.size()}}; }
  std::string describe() const override;

  /// Call it only while the program is not running.
  HostCounters report() const;

 private:
  void take_film(const nodes::Packet& packet);
  void take_overflow(const nodes::Packet& packet);
  void take_done(const Done& done);
  bool can_forward(std::uint32_t owner) const;
  void forward(std::uint32_t owner);
  static nodes::Room<std::byte> packet_layout(const Plan& plan) { return {nodes::Category::queues, plan.packet_bytes()}; }
  void assign_pass();
  void end_pass();
  void go_on_dealing();
  void begin_again();
  void assign_all();
  void assign(std::uint32_t index);
  bool is_passive() const;

  AssignPrimaries assign_;
  PendingPrimaries pending_primaries_;
  BufferedRays kept_;
  Termination termination_;
  std::span<std::byte> packet_;  ///< buffer in which a packet is put together
  std::uint32_t node_count_;
  std::uint32_t ray_batch_;
  std::uint32_t tested_objects_;
  DoneBelow below_;
  HostCounters counters_;
  bool finishing_ = false;
  bool stopped_ = false;
  bool is_cut_short_ = false;  ///< the rays of the pass are unknown, as a stop was requested
};

}  // namespace dmpc::dataflow
