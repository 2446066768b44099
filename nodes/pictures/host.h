// What the hosts of all strategies have: the picture's film, which of its pixels have light, and the pass under way.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/picture/film/film.h"
#include "core/picture/film/partial_picture.h"
#include "core/picture/sampling/refinement.h"
#include "nodes/layout.h"
#include "nodes/node.h"
#include "nodes/observers/watching.h"
#include "nodes/program.h"

namespace dmpc::pictures {

/// The host's program, except for the packets: it takes light, and tells who looks on or keeps the picture.
class Host : public nodes::Program {
 public:
  /// The run of the picture before has ended: another one follows, on the same film, which is as new. `detail` is its own. Call
  /// it only while the program is not running.
  virtual void begin_frame(const core::FineDetail* detail);
  /// Keeps what can be kept of a run that has been interrupted, if that is wanted.
  virtual void keep_interrupted() const {}

  const core::Refinement& refinement() const { return refinement_; }
  /// On this picture's film: deposits, and gatherings of planes, that saturated a sum.
  std::uint64_t deposits_saturated() const { return deposits_saturated_ + refinement_.gatherings_saturated(); }

 protected:
  /// `film` outlives the program and is written by it alone until the run's end; it is as continuation.start has it, which is
  /// read here alone. `progress` may be empty. `samples`: of each pixel in the first pass. `detail` is the picture's, if it is
  /// refined, and outlives the program or its next frame.
  Host(nodes::Node& node, core::Film& film, const core::RefinementOptions& wanted, std::uint32_t samples,
       nodes::Progress progress, const core::Continuation& continuation, const core::FineDetail* detail);
  /// What the constructor takes.
  static nodes::Room<std::uint64_t> own_layout(std::size_t pixel_count);

  /// The light of each of the pixels `first` to `first + more`. Returns how many of them have none yet of this pass.
  std::uint32_t take_light(std::uint32_t first, std::uint32_t more, const core::PixelSums& sums);
  /// All light of the pass has come. Returns whether another follows, which has none yet.
  bool next_pass();

  const core::Film& film() const { return *film_; }
  bool has_light(std::uint32_t pixel) const { return (with_light_[pixel / 64] >> (pixel % 64) & 1U) != 0; }
  core::PixelMask with_light() const;
  std::uint32_t pixels_with_light() const { return pixels_with_light_; }
  void report_progress(std::uint32_t pixels) const;
  /// Whether what is done should be kept now.
  bool is_due() const { return continuation_.is_due && continuation_.is_due(); }
  bool may_be_kept() const { return static_cast<bool>(continuation_.keep); }
  void keep(const core::PixelMask& done) const { continuation_.keep(*film_, refinement_, done); }

  nodes::Node* node_;

 private:
  core::Film* film_;
  nodes::Progress progress_;
  core::Continuation continuation_;
  core::RefinementOptions wanted_;
  std::uint32_t first_samples_;
  core::Refinement refinement_;
  std::span<std::uint64_t> with_light_;  ///< a bit a pixel
  std::uint32_t pixels_with_light_ = 0;
  std::uint64_t deposits_saturated_ = 0;
};

}  // namespace dmpc::pictures
