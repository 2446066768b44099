// Amounts as people read them, whatever unit they were counted in: 105 MB in place of 105000000 bytes.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dmpc::apps {

/// A unit to show amounts in.
struct ShownUnit {
  std::string name;  ///< "MB"
  double size = 1;   ///< in units of what was counted
};

/// The units for amounts counted in `unit`, from the smallest on: bytes and bytes/s by thousands, KiB by 1,024, ns, us, ms and s.
/// Any other unit is its own. Never empty.
std::vector<ShownUnit> shown_units(std::string_view unit);

/// The one of them in which `largest` has at most four digits before the point.
ShownUnit shown_unit(std::string_view unit, double largest);

/// In a unit of its own, with three significant digits: "1.44 MB", "64 B", "1,234,567".
std::string amount_text(double amount, std::string_view unit);

/// Bytes as KiB, for columns in KiB.
inline double kibibytes(std::uint64_t bytes) { return static_cast<double>(bytes) / 1024; }

/// Round numbers from `least` to `largest`, as a legend has them, each with its text: whole counts grouped.
struct Tick {
  double position = 0;
  std::string text;
};
std::vector<Tick> amount_ticks(double least, double largest, bool is_logarithmic, std::string_view unit);

}  // namespace dmpc::apps
