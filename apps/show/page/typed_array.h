// Many whole numbers within a page, as a script reads them.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>

namespace dmpc::apps::html {

/// {"type": "u1", "u2", "u4" or "f8", "data": base64}: little-endian, of the smallest type that has them all exactly, which for
/// "f8" (IEEE doubles) goes up to 2^53; expects no larger number.
nlohmann::json typed_array(std::span<const std::uint64_t> values);

}  // namespace dmpc::apps::html
