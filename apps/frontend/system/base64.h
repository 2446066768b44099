// Bytes that stand in a text: RFC 4648's base 64.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dmpc::apps {

/// The bytes, in its alphabet or that for addresses; blanks and ends of lines are passed over, the padding
/// may be missing. Nothing if another character stands in it.
std::optional<std::vector<std::byte>> bytes_of_base64(std::string_view text);

/// With padding.
std::string base64(std::string_view bytes);

}  // namespace dmpc::apps
