// The distance from an empty macro cell to the nearest occupied one.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/record/record.h"

namespace dmpc::core {

/// Gives every empty entry of a directory of `size` macro cells its radius: the Chebyshev distance to the nearest occupied one,
/// at most radius_max.
void measure_empty_space(const std::array<std::int32_t, 3>& size, std::span<DirectoryEntry> directory);

}  // namespace dmpc::core
