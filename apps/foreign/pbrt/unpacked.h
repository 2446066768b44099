// Decompresses files that may be compressed with gzip.
#pragma once

#include <string_view>
#include <vector>

namespace dmpc::apps::pbrt {

/// Checks the first two bytes (RFC 1952).
bool is_packed(std::string_view file);

/// Decompresses all members of the file. Throws core::InputError for damaged or truncated data, and for an expansion by more
/// than a factor of 1000, which no text or mesh reaches.
std::vector<char> unpacked(std::string_view file);

}  // namespace dmpc::apps::pbrt
