// Formats amounts for people, independent of the unit in which they were counted: 105 MB instead of 105000000 bytes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace dmpc::apps {

struct ShownUnit {
  std::string name;  ///< "MB"
  double size = 1;   ///< in units of what was counted
};

/// The units for amounts counted in `unit`, from the smallest on: bytes and bytes/s by thousands, KiB by 1,024, ns, us, ms and s.
/// Any other unit is its own. Never empty.
std::vector<ShownUnit> shown_units(std::string_view unit);

/// The unit in which `largest` has at most four digits before the point.
ShownUnit shown_unit(std::string_view unit, double largest);

/// Formats an amount in the unit that suits it, with three significant digits: "1.44 MB", "64 B", "1,234,567".
std::string amount_text(double amount, std::string_view unit);

/// Bytes as KiB, for columns in KiB.
inline double kibibytes(std::uint64_t bytes) { return static_cast<double>(bytes) / 1024; }

/// Round numbers from `least` to `largest` for a legend, each with its text; integers have digit groups.
struct Tick {
  double position = 0;
  std::string text;
};
std::vector<Tick> amount_ticks(double least, double largest, bool is_logarithmic, std::string_view unit);

}  // namespace dmpc::apps
