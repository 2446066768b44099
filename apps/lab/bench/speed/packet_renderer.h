// A plain renderer of packets: as a good engineer would write it over Embree where speed is all.
#pragma once

#include <cstdint>
#include <memory>

#include "apps/lab/bench/speed/plain_renderer.h"
#include "apps/oracle/oracle.h"
#include "apps/scene/subject.h"

namespace dmpc::apps {

/// Renders the PlainRenderer's picture with 16 rays at a time: rtcIntersect16 and rtcOccluded16, and shading in vectors. Threads
/// take the next tile; a tile's rays go on depth by depth, those of a depth and kind closed up into full packets, which carry
/// what they count for. No recursion. Immutable; render() is thread-safe.
class PacketRenderer {
 public:
  /// Builds the tree, of high quality, on all cores; in mode fast it may miss where triangles meet. `subject` outlives it.
  PacketRenderer(const Subject& subject, EmbreeMode mode);
  ~PacketRenderer();
  PacketRenderer(const PacketRenderer&) = delete;
  PacketRenderer& operator=(const PacketRenderer&) = delete;

  /// Memory for the picture and starting the threads are part of it.
  PlainPicture render(std::uint32_t thread_count) const;

 private:
  struct Tables;
  class Painter;
  std::unique_ptr<Tables> tables_;
};

}  // namespace dmpc::apps
