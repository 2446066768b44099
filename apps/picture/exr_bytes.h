// The bytes of numbers in the order in which OpenEXR's zip packs them.
#pragma once

#include <cstdint>
#include <span>

namespace dmpc::apps {

/// First the bytes at even places, then those at odd ones, each but the first as what it is more than the one before it, plus
/// 128: what OpenEXR undoes when it has unpacked a block. Requires as much room as there are bytes, an even number, not 0.
void split_bytes(std::span<const std::uint8_t> bytes, std::span<std::uint8_t> room);

}  // namespace dmpc::apps
