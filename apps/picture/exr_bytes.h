// The byte order before OpenEXR's zip compression.
#pragma once

#include <cstdint>
#include <span>

namespace dmpc::apps {

/// Writes first the bytes at even positions, then those at odd ones, each except the first as its difference to the one before
/// plus 128: the inverse of OpenEXR's transform after decompression. Requires buffers of equal, even size above 0.
void split_bytes(std::span<const std::uint8_t> bytes, std::span<std::uint8_t> room);

}  // namespace dmpc::apps
