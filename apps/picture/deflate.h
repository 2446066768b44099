// What PNG and EXR files are packed with. Its .cpp alone names zlib.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace dmpc::apps {

/// The bytes as a zlib stream (RFC 1950), by so much effort of 1 to 9. Throws std::bad_alloc if there is no room for it.
std::string deflated(std::string_view bytes, int effort);

/// The cyclic redundancy check of PNG's chunks (ISO 3309).
std::uint32_t crc_32(std::string_view bytes);

}  // namespace dmpc::apps
