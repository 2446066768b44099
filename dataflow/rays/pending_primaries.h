// The primary rays of a pass that the host assigns, packet by packet, and how it reaches a state in which whole pixels are done.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/expect.h"
#include "core/picture/sampling/refinement.h"
#include "dataflow/packets.h"
#include "dataflow/rays/pixel_order.h"
#include "dataflow/regions/primary_run.h"

namespace dmpc::dataflow {

/// A pixel has begun when one of its rays was assigned. Rays of a pixel may be assigned to several nodes, so at any time some
/// pixels have begun of which other rays are here. hold_back() leaves only these to be assigned: when they are, and no ray is
/// left anywhere, the pixels that have begun are done, all others untouched. Belongs to the host.
class PendingPrimaries {
 public:
  /// `run_rays_max`: the maximum number of rays in an assigned run, which bounds a node's memory for them; at least 1.
  PendingPrimaries(std::uint32_t node_count, std::uint64_t run_rays_max, const PixelOrder& order = {})
      : runs_(node_count), held_back_(node_count), run_rays_max_(run_rays_max), order_(order), begun_(0) {
    core::expect(run_rays_max > 0, "a run of primary rays has some");
  }

  /// Takes the rays of a pass, ascending for each node, of pixels that are not among `done`. Requires is_empty(), and that it is
  /// not held back.
  void begin_pass(std::vector<std::vector<PrimaryRun>> runs, const core::SampleRange& samples, const core::PixelMask& done) {
    core::expect(is_empty() && !holds_back_ && runs.size() == runs_.size(), "a pass begins when the one before is assigned");
    runs_ = std::move(runs);
    for (Runs& of_node : runs_) {
      std::reverse(of_node.begin(), of_node.end());
    }
    samples_ = samples;
    begun_ = done;
  }

  /// Whether some ray of this node may be assigned now.
  bool has(std::uint32_t node) const { return !runs_[node].empty(); }
  /// Whether no ray may be assigned now.
  bool is_empty() const {
    return std::all_of(runs_.begin(), runs_.end(), [](const Runs& runs) { return runs.empty(); });
  }

  /// The next packet for a node. Requires has(node).
  AssignedPrimaries take(std::uint32_t node) {
    Runs& runs = runs_[node];
    core::expect(!runs.empty(), "a node that is assigned to has rays");
    AssignedPrimaries packet{.samples = samples_};
    while (!runs.empty() && packet.count < packet.runs.size()) {
      const PrimaryRun assigned{runs.back().first, std::min(runs.back().count, run_rays_max_)};
      begin_pixels(assigned);
      packet.runs[packet.count++] = assigned;
      runs.back() = {assigned.first + assigned.count, runs.back().count - assigned.count};
      if (runs.back().count == 0) {
        runs.pop_back();
      }
    }
    return packet;
  }

  /// From now on only rays of pixels that have begun may be assigned, unless there are no others. Requires that it is not
  /// held back.
  void hold_back() {
    core::expect(!holds_back_, "rays are held back once");
    for (std::size_t node = 0; node < runs_.size(); ++node) {
      const Runs runs = std::exchange(runs_[node], {});
      for (auto run = runs.rbegin(); run != runs.rend(); ++run) {
        const std::uint64_t end = run->first + run->count;
        for (std::uint64_t first = run->first, next = 0; first < end; first = next) {
          next = end_of_stretch(first, end);
          Runs& target = begun_.has(pixel_of(first)) ? runs_[node] : held_back_[node];
          target.push_back({first, next - first});
        }
      }
      std::reverse(runs_[node].begin(), runs_[node].end());
      std::reverse(held_back_[node].begin(), held_back_[node].end());
      holds_back_ = holds_back_ || !held_back_[node].empty();
    }
  }

  /// Whether there are rays of pixels that have not begun, and they must not be assigned.
  bool holds_back() const { return holds_back_; }
  /// All rays may be assigned again. Requires is_empty().
  void release() {
    core::expect(is_empty() && holds_back_, "what was held back follows what has begun");
    holds_back_ = false;
    std::swap(runs_, held_back_);
  }

  const core::PixelMask& begun() const { return begun_; }

 private:
  /// The runs of one node, the next one last.
  using Runs = std::vector<PrimaryRun>;

  /// The end of the stretch of rays, from `first` on and before `end`, that all belong to pixels that have begun, or all to
  /// others.
  std::uint64_t end_of_stretch(std::uint64_t first, std::uint64_t end) const {
    const bool has_begun = begun_.has(pixel_of(first));
    std::uint64_t number = first;
    while (number < end && begun_.has(pixel_of(number)) == has_begun) {
      number = (std::uint64_t{place_of(number, samples_)} + 1) * samples_.count;
    }
    return std::min(number, end);
  }

  std::uint32_t pixel_of(std::uint64_t number) const { return order_.pixel_at(place_of(number, samples_)); }
  void begin_pixels(const PrimaryRun& run) {
    for (std::uint32_t place = place_of(run.first, samples_); place <= place_of(run.first + run.count - 1, samples_); ++place) {
      begun_.add(order_.pixel_at(place));
    }
  }

  std::vector<Runs> runs_;
  std::vector<Runs> held_back_;
  std::uint64_t run_rays_max_;
  PixelOrder order_;
  core::SampleRange samples_;
  core::PixelMask begun_;
  bool holds_back_ = false;
};

}  // namespace dmpc::dataflow
