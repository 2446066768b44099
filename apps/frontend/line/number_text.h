// Formats numbers for people.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace dmpc::apps {

/// 1234567 as 1,234,567.
std::string grouped(std::uint64_t value);
/// With `digits` digits after the point: 1,234.5.
std::string grouped(double value, int digits);
/// The shortest text that reads back as the same number.
std::string shortest(double value);
/// To six significant digits.
std::string rounded(double value);
/// With `digits` digits after the point.
std::string fixed(double value, int digits);
/// "3.142 s", from 10 s on "31.4 s".
std::string seconds_text(double seconds);
/// Rounded: "300 B", "1.5 KiB", "3.21 MiB".
std::string bytes_text(std::size_t bytes);
/// Rounded down to whole MiB: "16 MiB".
std::string mebibytes_text(std::uint64_t bytes);
/// The percentage of numbers of one kind; 0 of 0 is 0.
template <class Number>
double percent_of(Number part, Number whole) {
  return whole > Number{} ? 100 * static_cast<double>(part) / static_cast<double>(whole) : 0;
}
/// With `digits` digits after the point: "12.3 %".
std::string percent_text(double percent, int digits = 1);
/// The share of each part in percent with one decimal place, rounded so that the shown numbers add up to 100. All 0 if the sum is
/// 0.
std::vector<double> percent_parts(std::span<const std::uint64_t> parts);
/// "1 node", "2 nodes".
std::string counted(std::uint64_t count, const std::string& thing);
/// With four significant digits at most: "12", "0.035", "1.5e+06".
std::string legend_number(double value);
/// 16 hexadecimal digits.
std::string hash_text(std::uint64_t hash);

}  // namespace dmpc::apps
