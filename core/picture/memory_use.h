// Categories of a ray-tracing node's memory, in addition to those of the computer itself.
#pragma once

#include <cstdint>

namespace dmpc::core {

/// One list for all strategies; each uses some of them.
enum class MemoryUse : std::uint8_t {
  home_pages,    ///< records that the node has from the start
  cache_frames,  ///< memory for records that arrive
  page_table,    ///< where these are
  ray_stacks,    ///< rays and pixels in flight
  film_tiles,    ///< light that waits to be sent to the host
  constants      ///< the picture's settings, and other data known to all nodes
};

}  // namespace dmpc::core
