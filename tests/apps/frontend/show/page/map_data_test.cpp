#include "apps/frontend/show/page/map_data.h"

#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/frontend/system/base64.h"
#include "core/base/expect.h"

namespace dmpc::apps::html::map_data_test {

using nlohmann::json;

TEST_CASE("a map of few numbers has them, and a scale without halves where they are counted") {
  NumberMap map{.title = "Who",
                .row_label = "row",
                .column_label = "column",
                .value_label = "fetches",
                .unit = {},
                .rows = 1,
                .columns = 2,
                .values = {0, 2}};
  json data = json::parse(map_data(map));
  CHECK(data["values"] == json({0.0, 2.0}));
  CHECK(data["most"] == 2.0);
  for (const json& tick : data["ticks"]) {
    CHECK(tick[0].get<double>() == std::floor(tick[0].get<double>()));
  }
  CHECK_FALSE(data.contains("column_ticks"));
  map.column_ns = 5'000'000;
  map.unit = "%";
  map.most = 1;
  data = json::parse(map_data(map));
  CHECK(data["column_ticks"].back() == json({2.0, "10 ms"}));
  CHECK(data["most"] == 1.0);
  map.values.clear();
  CHECK_THROWS_AS(map_data(map), core::InternalError);
}

TEST_CASE("a map of many numbers has them in 255ths of the largest, and none but 0 becomes 0") {
  NumberMap map{.title = "Who", .row_label = {}, .column_label = {}, .value_label = {}, .unit = {}, .rows = 1, .columns = 4098};
  map.values.assign(4095, 1000);
  map.values.insert(map.values.begin(), {0, 1, 500});
  const json data = json::parse(map_data(map));
  CHECK_FALSE(data.contains("values"));
  CHECK(data["levels"].get<std::string>().substr(0, 4) == base64(std::string("\0\1\200", 3)));
}

}  // namespace dmpc::apps::html::map_data_test
