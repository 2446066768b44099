// Files that may be packed by gzip.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace dmpc::apps::pbrt {

/// By their first two bytes (RFC 1952).
bool is_packed(std::string_view file);

/// What is packed, all of its parts one after the other. Throws core::InputError for what is damaged, cut short, or becomes more
/// than a thousand times as long, which no text or mesh does.
std::vector<char> unpacked(std::string_view file);

}  // namespace dmpc::apps::pbrt
