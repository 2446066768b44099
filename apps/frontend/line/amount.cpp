#include "apps/frontend/line/amount.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/scale.h"

namespace dmpc::apps {

namespace {

/// Amounts up to this limit are shown as whole numbers of their unit; more digits are hard to read.
constexpr double shown_max = 10'000;

constexpr std::array<std::pair<const char*, double>, 4> times = {{{"ns", 1}, {"us", 1e3}, {"ms", 1e6}, {"s", 1e9}}};

std::vector<ShownUnit> by_steps(std::initializer_list<const char*> names, double step) {
  std::vector<ShownUnit> units;
  double size = 1;
  for (const char* const name : names) {
    units.push_back({name, size});
    size *= step;
  }
  return units;
}

std::vector<ShownUnit> times_in(double unit_ns) {
  std::vector<ShownUnit> units;
  for (const auto& [name, ns] : times) {
    units.push_back({name, ns / unit_ns});
  }
  return units;
}

/// As many digits after the point as three significant ones ask for.
int digits_of(double value) { return value >= 100 || value == 0 ? 0 : value >= 10 ? 1 : value >= 1 ? 2 : 3; }

bool is_whole(double value) { return std::abs(value - std::round(value)) < 1e-9 * std::max(1.0, std::abs(value)); }

/// A round number, and so without digits that it does not need.
std::string tick_text(double value, const std::string& unit) {
  const std::string number = is_whole(value) ? grouped(value, 0) : legend_number(value);
  return unit.empty() ? number : number + " " + unit;
}

}  // namespace

std::vector<ShownUnit> shown_units(std::string_view unit) {
  if (unit == "bytes") {
    return by_steps({"B", "KB", "MB", "GB", "TB"}, 1000);
  }
  if (unit == "bytes/s") {
    return by_steps({"B/s", "KB/s", "MB/s", "GB/s"}, 1000);
  }
  if (unit == "KiB") {
    return by_steps({"KiB", "MiB", "GiB"}, 1024);
  }
  const auto time = std::find_if(times.begin(), times.end(), [&](const auto& one) { return one.first == unit; });
  return time != times.end() ? times_in(time->second) : std::vector<ShownUnit>{{std::string(unit), 1}};
}

ShownUnit shown_unit(std::string_view unit, double largest) {
  const std::vector<ShownUnit> units = shown_units(unit);
  const auto found =
      std::find_if(units.begin(), units.end(), [&](const ShownUnit& one) { return largest < shown_max * one.size; });
  return found == units.end() ? units.back() : *found;
}

std::string amount_text(double amount, std::string_view unit) {
  const std::vector<ShownUnit> units = shown_units(unit);
  std::size_t at = units.size() - 1;
  while (at > 0 && amount < units[at].size) {
    --at;
  }
  const double value = amount / units[at].size;
  const bool is_counted = at == 0 && is_whole(value);
  const std::string number = grouped(value, is_counted ? 0 : digits_of(value));
  return units[at].name.empty() ? number : number + " " + units[at].name;
}

std::vector<Tick> amount_ticks(double least, double largest, bool is_logarithmic, std::string_view unit) {
  const bool has_words = shown_units(unit).size() > 1;  // an axis shows any other unit itself
  std::vector<Tick> ticks;
  const ShownUnit common = has_words ? shown_unit(unit, 10 * largest) : ShownUnit{};
  const NumberScale scale{is_logarithmic, least / common.size, largest / common.size};
  for (const double value : scale.ticks()) {
    const double position = value * common.size;
    const ShownUnit own = has_words && is_logarithmic ? shown_unit(unit, 10 * position) : common;
    ticks.push_back({position, tick_text(position / own.size, position == 0 ? "" : own.name)});
  }
  return ticks;
}

}  // namespace dmpc::apps
