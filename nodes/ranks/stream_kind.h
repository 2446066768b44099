// What a stream from rank 0 is about, by its first byte.
#pragma once

#include <cstdint>
#include <string_view>

#include "core/base/expect.h"

namespace dmpc::nodes {

enum class StreamKind : std::uint8_t {
  job,   ///< a run on new nodes, which are made of what follows
  again  ///< another run on the nodes that are there
};

/// Of what read_counted() has read first.
inline StreamKind kind_of_stream(std::string_view bytes) {
  core::expect(!bytes.empty(), "a stream says what it is about");
  return StreamKind{static_cast<std::uint8_t>(bytes.front())};
}

}  // namespace dmpc::nodes
