#include "apps/option_values.h"

#include <charconv>
#include <string>
#include <utility>

#include "core/expect.h"

namespace dmpc::apps {

namespace {

[[noreturn]] void refuse(std::string_view text, std::string_view option, const char* expected) {
  throw core::UsageError(std::string(option) + "=" + std::string(text) + ": expected " + expected);
}

}  // namespace

std::size_t parse_size_bytes(std::string_view text, std::string_view option) {
  std::uint64_t count = 0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  const std::string_view unit(rest, static_cast<std::size_t>(text.data() + text.size() - rest));
  constexpr std::pair<std::string_view, unsigned> units[] = {{"", 0}, {"B", 0}, {"KiB", 10}, {"MiB", 20}, {"GiB", 30}};
  constexpr std::uint64_t bytes_max = std::uint64_t{1} << 40U;
  for (const auto& [name, shift] : units) {
    if (error == std::errc() && name == unit && count <= bytes_max >> shift) {
      return static_cast<std::size_t>(count << shift);
    }
  }
  refuse(text, option, "a size such as 4096B, 300KiB, 4MiB or 1GiB");
}

std::uint64_t parse_seed(std::string_view text, std::string_view option) {
  std::uint64_t seed = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, seed);
  if (error != std::errc() || rest != end) {
    refuse(text, option, "a whole number from 0 to 18446744073709551615");
  }
  return seed;
}

}  // namespace dmpc::apps
