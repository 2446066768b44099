// The primary rays of a pass that the host deals, packet by packet, and how it comes to a point where whole pixels are done.
#pragma once

#include <cstdint>
#include <vector>

#include "core/picture/refinement.h"
#include "dataflow/packets.h"
#include "dataflow/rays/pixel_order.h"
#include "dataflow/regions/primary_run.h"

namespace dmpc::dataflow {

/// A pixel has begun when one of its rays was dealt. Rays of a pixel may be dealt to several nodes, so at any time some pixels
/// have begun whose other rays are here. hold_back() leaves only these to be dealt: when they are, and no ray is left anywhere,
/// the pixels that have begun are done, all others untouched. Belongs to the host.
class Undealt {
 public:
  /// `run_rays_max`: no run that is dealt has more rays, which bounds those that a node has room for; at least 1.
  Undealt(std::uint32_t node_count, std::uint64_t run_rays_max, const PixelOrder& order = {});

  /// Takes the rays of a pass, ascending for each node, of pixels that are not among `done`. Requires is_empty(), and that none
  /// is held back.
  void begin_pass(std::vector<std::vector<PrimaryRun>> runs, const core::SampleRange& samples, const core::PixelMask& done);

  /// Some ray of this node's may be dealt now.
  bool has(std::uint32_t node) const { return !runs_[node].empty(); }
  /// No ray may be dealt now.
  bool is_empty() const;
  /// The next packet for a node. Requires has(node).
  DealtPrimaries take(std::uint32_t node);

  /// From now on only rays of pixels that have begun may be dealt, unless there are no others. Requires that none is held back.
  void hold_back();
  /// There are rays of pixels that have not begun, and they must not be dealt.
  bool holds_back() const { return holds_back_; }
  /// All may be dealt again. Requires is_empty().
  void release();

  const core::PixelMask& begun() const { return begun_; }

 private:
  /// The runs of one node, the next one last.
  using Runs = std::vector<PrimaryRun>;

  std::uint64_t end_of_stretch(std::uint64_t first, std::uint64_t end) const;
  std::uint32_t pixel_of(std::uint64_t number) const { return order_.pixel_at(place_of(number, samples_)); }
  void begin_pixels(const PrimaryRun& run);

  std::vector<Runs> runs_;
  std::vector<Runs> held_back_;
  std::uint64_t run_rays_max_;
  PixelOrder order_;
  core::SampleRange samples_;
  core::PixelMask begun_;
  bool holds_back_ = false;
};

}  // namespace dmpc::dataflow
