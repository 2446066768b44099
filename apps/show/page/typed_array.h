// Arrays of whole numbers within a page, in a form that a script reads.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <vector>

namespace dmpc::apps::html {

/// Limit up to which a script's whole numbers are exact: 2^53.
inline constexpr std::uint64_t exact_number_max = std::uint64_t{1} << 53U;

/// Returns {"type": "u1", "u2", "u4" or "f8", "data": base64}: little-endian, of the smallest type that holds all numbers
/// exactly, which for "f8" (IEEE doubles) goes up to 2^53. Requires that no number is larger.
nlohmann::json typed_array(std::span<const std::uint64_t> values);
/// Returns the numbers of such an object; nothing if it is none. A number that typed_array() would not have made becomes 2^64 -
/// 1.
std::optional<std::vector<std::uint64_t>> numbers_of(const nlohmann::json& array);

}  // namespace dmpc::apps::html
