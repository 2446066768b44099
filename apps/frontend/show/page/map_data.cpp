#include "apps/frontend/show/page/map_data.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "apps/frontend/line/amount.h"
#include "apps/frontend/system/base64.h"
#include "apps/frontend/table/plot_data.h"
#include "core/base/expect.h"

namespace dmpc::apps::html {

namespace {

using nlohmann::json;

/// Round times within a map's columns.
std::vector<Tick> column_ticks(const NumberMap& map, double column_ns) {
  std::vector<Tick> ticks = amount_ticks(0, column_ns * static_cast<double>(map.columns), false, "ns");
  for (Tick& tick : ticks) {
    tick.position /= column_ns;
  }
  return ticks;
}

/// Numbers that are counted have no halves.
std::vector<Tick> scale_ticks(double most, const std::string& unit) {
  std::vector<Tick> ticks = amount_ticks(0, most, false, unit);
  std::erase_if(ticks, [&](const Tick& tick) { return unit.empty() && tick.position != std::floor(tick.position); });
  return ticks;
}

std::string levels_of(const std::vector<double>& values, double most) {
  std::string levels;
  for (const double value : values) {
    levels += static_cast<char>(most > 0 ? std::min(255.0, std::ceil(255 * value / most)) : 0);
  }
  return base64(levels);
}

}  // namespace

std::string map_data(const NumberMap& map) {
  core::expect(map.values.size() == map.rows * map.columns && !map.values.empty(), "a map of numbers has one for each place");
  const double most = map.most.value_or(*std::max_element(map.values.begin(), map.values.end()));
  json data = {{"title", map.title},
               {"row_label", map.row_label},
               {"column_label", map.column_label},
               {"value_label", map.value_label},
               {"rows", map.rows},
               {"columns", map.columns},
               {"most", most},
               {"ticks", json_of(scale_ticks(most, map.unit))}};
  if (map.column_ns) {
    data["column_ticks"] = json_of(column_ticks(map, *map.column_ns));
    data["column_ms"] = *map.column_ns / 1e6;
  }
  if (map.values.size() <= exact_numbers_max) {
    data["values"] = map.values;
  } else {
    data["levels"] = levels_of(map.values, most);
  }
  return data.dump(-1, ' ', true, json::error_handler_t::replace);
}

}  // namespace dmpc::apps::html
