#include "apps/frontend/line/number_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iomanip>
#include <numeric>
#include <sstream>
#include <utility>

#include "core/base/expect.h"

namespace dmpc::apps {

namespace {

/// Commas between each three of the first `count` digits.
std::string with_commas(std::string text, std::size_t count) {
  for (std::size_t place = count; place > 3; place -= 3) {
    text.insert(place - 3, 1, ',');
  }
  return text;
}

}  // namespace

std::string grouped(std::uint64_t value) {
  const std::string text = std::to_string(value);
  return with_commas(text, text.size());
}

std::string grouped(double value, int digits) {
  const std::string text = fixed(std::abs(value), digits);
  return (value < 0 ? "-" : "") + with_commas(text, std::min(text.size(), text.find('.')));
}

std::string shortest(double value) {
  std::array<char, 32> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
  core::expect(error == std::errc(), "the shortest text of a real number has a bound");
  return {text.data(), end};
}

std::string rounded(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

std::string fixed(double value, int digits) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(digits) << value;
  return text.str();
}

std::string seconds_text(double seconds) { return fixed(seconds, seconds < 10 ? 3 : 1) + " s"; }

std::string bytes_text(std::size_t bytes) {
  const auto value = static_cast<double>(bytes);
  if (bytes < 1024) {
    return std::to_string(bytes) + " B";
  }
  return bytes < (std::size_t{1} << 20U) ? fixed(value / 1024, 1) + " KiB" : fixed(value / 1048576, 2) + " MiB";
}

std::string mebibytes_text(std::uint64_t bytes) { return std::to_string(bytes >> 20U) + " MiB"; }

std::string percent_text(double percent, int digits) { return fixed(percent, digits) + " %"; }

std::vector<double> percent_parts(std::span<const std::uint64_t> parts) {
  const auto whole = static_cast<double>(std::accumulate(parts.begin(), parts.end(), std::uint64_t{0}));
  std::vector<double> percent(parts.size());
  std::uint64_t end = 0;
  double end_tenths = 0;  // rounded: each part is the distance of two such ends
  for (std::size_t i = 0; i < parts.size() && whole > 0; ++i) {
    end += parts[i];
    const double begin_tenths = std::exchange(end_tenths, std::floor(1000 * static_cast<double>(end) / whole + 0.5));
    percent[i] = (end_tenths - begin_tenths) / 10;
  }
  return percent;
}

std::string counted(std::uint64_t count, const std::string& thing) {
  return grouped(count) + " " + thing + (count == 1 ? "" : "s");
}

std::string legend_number(double value) {
  char text[32];
  static_cast<void>(std::snprintf(text, sizeof(text), "%.4g", value));
  return text;
}

std::string hash_text(std::uint64_t hash) {
  std::string text(16, '0');
  for (std::size_t digit = 16; digit-- > 0; hash >>= 4U) {
    text[digit] = "0123456789abcdef"[hash & 15U];
  }
  return text;
}

}  // namespace dmpc::apps
