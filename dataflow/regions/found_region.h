// The region that a finest cell lies in.
#pragma once

#include <cstdint>

#include "core/base/region.h"

namespace dmpc::dataflow {

/// Its number, and its box in finest cells.
struct FoundRegion {
  std::uint32_t index = 0;
  core::Region box;
};

}  // namespace dmpc::dataflow
