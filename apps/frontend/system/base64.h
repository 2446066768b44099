// Base 64 (RFC 4648).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dmpc::apps {

/// Decodes the standard or the URL-safe alphabet; blanks and line ends are skipped, and padding is optional. Returns nothing if
/// the text has any other character.
std::optional<std::vector<std::byte>> bytes_of_base64(std::string_view text);

/// Encodes with padding.
std::string base64(std::string_view bytes);

}  // namespace dmpc::apps
