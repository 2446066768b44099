#include "apps/frontend/show/page/number_map.h"

#include <doctest/doctest.h>

#include <vector>

#include "core/base/expect.h"
#include "tests/support/text.h"

namespace dmpc::apps::html::number_map_test {

using tests::contains;

namespace {

NumberMap map_of(std::size_t rows, std::size_t columns) {
  NumberMap map{.title = "Who & whom",
                .row_label = "requester",
                .column_label = "home",
                .value_label = "fetches",
                .unit = {},
                .rows = rows,
                .columns = columns};
  for (std::size_t i = 0; i < rows * columns; ++i) {
    map.values.push_back(1000.0 * static_cast<double>(i));
  }
  return map;
}

}  // namespace

TEST_CASE("numbers go from dark to light, and what lies beyond the scale has its last colour") {
  CHECK(color_numbers(std::vector<double>{0, 1, 2, 4, 5}, 4) == std::vector<std::uint8_t>{0, 64, 128, 255, 255});
  CHECK(color_numbers(std::vector<double>{0}, 0) == std::vector<std::uint8_t>{0});
}

TEST_CASE("a map has names on its axes, ticks, and a scale with numbers") {
  const std::string svg = svg_of(map_of(20, 20));
  for (const char* const part : {"Who &amp; whom", ">requester<", ">home<", ">fetches<", ">0<", ">5<", ">15<", ">100,000<",
                                 ">300,000<", "href=\"data:image/png;base64,", "prefers-color-scheme:dark"}) {
    CHECK_MESSAGE(contains(svg, part), part);
  }
  CHECK_FALSE(contains(svg, ">19<"));  // ticks are round
}

TEST_CASE("few squares have their numbers in them, many have none") {
  CHECK(contains(svg_of(map_of(2, 2)), ">3,000</text>"));
  CHECK(contains(svg_of(map_of(2, 2)), "class=\"in dark\""));
  CHECK_FALSE(contains(svg_of(map_of(12, 12)), "class=\"in"));
}

TEST_CASE("a scale of counts has no halves") {
  NumberMap map = map_of(1, 2);
  map.most = 2;
  CHECK(contains(svg_of(map), ">2</text>"));
  CHECK_FALSE(contains(svg_of(map), ">0.5</text>"));
  map.unit = "%";
  CHECK(contains(svg_of(map), ">0.5</text>"));
}

TEST_CASE("columns of time have a tick at round times") {
  NumberMap map = map_of(1, 10);
  map.column_ns = 2'500'000;
  map.most = 20'000;
  const std::string svg = svg_of(map);
  CHECK(contains(svg, ">5 ms<"));
  CHECK(contains(svg, ">25 ms<"));
  CHECK(contains(svg, ">20,000<"));
}

TEST_CASE("nothing but zeros is a map, and nothing at all is a mistake") {
  NumberMap map = map_of(1, 1);
  CHECK(contains(svg_of(map), "<svg"));
  map.values.clear();
  CHECK_THROWS_AS(svg_of(map), core::InternalError);
}

}  // namespace dmpc::apps::html::number_map_test
