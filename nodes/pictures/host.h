// What the hosts of all strategies share: the picture's film, the set of its pixels with light, and the current pass.
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

/// The length of a full packet of film, which is the same for all strategies, so that no other option decides how often the host
/// receives one. Longer packets would save nothing worth the memory of their mailbox slots.
inline constexpr std::size_t film_packet_bytes_max = 4096;

/// The host's program without the packets: it takes light, and calls observers and the saving of pictures.
class Host : public nodes::Program {
 public:
  /// To be called when the run of a picture has ended and another one follows, on the same film, which is reset. `detail` is the
  /// new picture's. Call it only while the program is not running.
  virtual void begin_frame(const core::FineDetail* detail);
  /// Saves what can be saved of a run that has been interrupted, if that is wanted.
  virtual void keep_interrupted() const {}

  const core::Refinement& refinement() const { return refinement_; }
  /// On this picture's film: deposits, and gatherings of planes, that saturated a sum.
  std::uint64_t deposits_saturated() const { return deposits_saturated_ + refinement_.gatherings_saturated(); }

 protected:
  /// `film` outlives the program and is written only by it until the run's end; it is in the state of continuation.start, which
  /// is read only here. `progress` may be empty. `samples`: per pixel in the first pass. `detail` is the picture's, if it is
  /// refined, and outlives the program or its next frame.
  Host(nodes::Node& node, core::Film& film, const core::RefinementOptions& wanted, std::uint32_t samples,
       nodes::Progress progress, const core::Continuation& continuation, const core::FineDetail* detail);
  /// The memory that the constructor takes.
  static nodes::Room<std::uint64_t> own_layout(std::size_t pixel_count);

  /// Takes the light of each of the pixels `first` to `first + more`. Returns the number of those that had none in this pass.
  std::uint32_t take_light(std::uint32_t first, std::uint32_t more, const core::PixelSums& sums);
  /// To be called when all light of the pass has arrived. Returns whether another follows, which has none yet.
  bool next_pass();

  const core::Film& film() const { return *film_; }
  bool has_light(std::uint32_t pixel) const { return (with_light_[pixel / 64] >> (pixel % 64) & 1U) != 0; }
  core::PixelMask with_light() const;
  std::uint32_t pixels_with_light() const { return pixels_with_light_; }
  void report_progress(std::uint32_t pixels) const;
  /// Whether the state should be saved now.
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
