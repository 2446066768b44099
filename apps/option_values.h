// What the texts of the command line stand for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace dmpc::apps {

/// "300", "300B", "4KiB", "4MiB", "1GiB" in bytes. Throws core::UsageError naming `option` for anything else or more than 1 TiB.
std::size_t parse_size_bytes(std::string_view text, std::string_view option);

/// A whole number from 0 to 2^64 - 1. Throws core::UsageError naming `option` for anything else.
std::uint64_t parse_seed(std::string_view text, std::string_view option);

}  // namespace dmpc::apps
