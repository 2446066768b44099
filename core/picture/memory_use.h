// What a node that traces rays spends its memory on, beside what the computer itself takes of it.
#pragma once

#include <cstdint>

namespace dmpc::core {

/// One list for all strategies, each of which has some of them.
enum class MemoryUse : std::uint8_t {
  home_pages,    ///< records that the node has from the start
  cache_frames,  ///< room for records that come
  page_table,    ///< where these are
  ray_stacks,    ///< rays and pixels under way
  film_tiles,    ///< light that waits for its way to the host
  constants      ///< the picture's settings, and what else all nodes know
};

}  // namespace dmpc::core
