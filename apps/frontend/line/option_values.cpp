#include "apps/frontend/line/option_values.h"

#include <charconv>
#include <cmath>
#include <set>
#include <utility>

#include "apps/frontend/line/parsed_number.h"
#include "apps/frontend/line/words.h"
#include "core/base/expect.h"

namespace dmpc::apps {

namespace {

[[noreturn]] void refuse(std::string_view text, std::string_view option, const char* expected) {
  throw core::UsageError(std::string(option) + "=" + std::string(text) + ": expected " + expected);
}

}  // namespace

double finite_number(std::string_view text) {
  const double number = number_in<double>(text).value_or(std::numeric_limits<double>::quiet_NaN());
  return std::isfinite(number) ? number : std::numeric_limits<double>::quiet_NaN();
}

double parse_within(std::string_view text, std::string_view option, double least, double most, const char* expected) {
  const double number = finite_number(text);
  return number >= least && number <= most ? number : (refuse(text, option, expected), 0);
}

double amount_in(std::string_view text) {
  const std::size_t slash = text.find('/');
  const double divisor = slash == std::string_view::npos ? 1 : finite_number(text.substr(slash + 1));
  const double amount = finite_number(text.substr(0, slash)) / divisor;
  return amount >= 0 && divisor > 0 ? amount : std::numeric_limits<double>::quiet_NaN();
}

double parse_share(std::string_view text, std::string_view option, bool or_zero) {
  const std::size_t slash = text.find('/');
  const double divisor = slash == std::string_view::npos ? 1 : finite_number(text.substr(slash + 1));
  const double share = finite_number(text.substr(0, slash)) / divisor;
  if (share > 0 && share <= 1 && divisor >= 1) {
    return share;
  }
  if (or_zero && share == 0 && divisor >= 1) {
    return 0;
  }
  refuse(text, option,
         or_zero ? "a number from 0 to 1 such as 0.004 or 1/255" : "a number above 0, at most 1, such as 0.004 or 1/255");
}

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
    if (error != std::errc::invalid_argument && name == unit) {
      refuse(text, option, "at most 1024GiB");
    }
  }
  refuse(text, option, "a size such as 4096B, 300KiB, 4MiB or 1GiB");
}

std::uint64_t parse_seed(std::string_view text, std::string_view option) {
  const auto seed = number_in<std::uint64_t>(text);
  if (!seed) {
    refuse(text, option, "a whole number from 0 to 18446744073709551615");
  }
  return *seed;
}

std::vector<std::uint32_t> parse_numbers(std::string_view text, const std::string& option, std::uint32_t most) {
  std::vector<std::uint32_t> numbers;
  for (const std::string& word : words_between_commas(std::string(text), option)) {
    numbers.push_back(number_in<std::uint32_t>(word).value_or(0));
    if (numbers.back() < 1 || numbers.back() > most) {
      throw core::UsageError(option + "=" + std::string(text) + ": expected numbers from 1 to " + std::to_string(most) +
                             " with commas between them, such as 4,8,16");
    }
  }
  return numbers;
}

std::vector<std::uint32_t> parse_different_numbers(std::string_view text, const std::string& option, std::uint32_t most) {
  const std::vector<std::uint32_t> numbers = parse_numbers(text, option, most);
  const std::set<std::uint32_t> different(numbers.begin(), numbers.end());
  return {different.begin(), different.end()};
}

}  // namespace dmpc::apps
