// Parses the values of command line options.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace dmpc::apps {

/// "300", "300B", "4KiB", "4MiB", "1GiB" in bytes. Throws core::UsageError naming `option` for anything else or more than 1 TiB.
std::size_t parse_size_bytes(std::string_view text, std::string_view option);

/// A number such as 0.004, 4e-3 or 1/255, above 0 and at most 1; with `or_zero` 0 as well. Throws core::UsageError naming
/// `option` for anything else.
double parse_share(std::string_view text, std::string_view option, bool or_zero = false);

/// A number from `least` to `most`, such as above_0. Throws core::UsageError naming `option`, with what was `expected`, for
/// anything else.
double parse_within(std::string_view text, std::string_view option, double least, double most, const char* expected);
inline constexpr double above_0 = std::numeric_limits<double>::denorm_min();

/// A finite number that fills the whole text, or NaN.
double finite_number(std::string_view text);

/// A number or fraction such as 0.004 or 1/255, from 0 on, that fills the whole text, or NaN.
double amount_in(std::string_view text);

/// "4,8,16": whole numbers from 1 to `most`. Throws core::UsageError naming `option` for anything else.
std::vector<std::uint32_t> parse_numbers(std::string_view text, const std::string& option, std::uint32_t most);

/// Parses a list of distinct numbers in ascending order.
std::vector<std::uint32_t> parse_different_numbers(std::string_view text, const std::string& option, std::uint32_t most);

/// A whole number from 0 to 2^64 - 1. Throws core::UsageError naming `option` for anything else.
std::uint64_t parse_seed(std::string_view text, std::string_view option);

}  // namespace dmpc::apps
