#include "core/database/structure.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "apps/lab/bench/stability/random.h"
#include "core/database/database.h"
#include "core/database/record_writer.h"
#include "core/families/scenes.h"
#include "tests/support/subject.h"

namespace record_order_test {

namespace {

using namespace dmpc;

std::vector<std::uint16_t> random_sizes(std::size_t count) {
  apps::Random random(count);
  std::vector<std::uint16_t> sizes(count);
  for (std::uint16_t& size : sizes) {
    size = static_cast<std::uint16_t>(1 + random.below(core::record_bytes_max));
  }
  return sizes;
}

core::BuildOptions scattered() {
  core::BuildOptions options;
  options.record_order = core::RecordOrder::scattered;
  return options;
}

}  // namespace

TEST_CASE("no records have no places, and a single one has the first") {
  CHECK(core::scattered_places({}, 1000, 1024).empty());
  CHECK(core::scattered_places(std::vector<std::uint16_t>{40}, 100, 1024) == std::vector{core::Address{13}});
  CHECK(core::scattered_places(std::vector<std::uint16_t>{40}, 1000, 1024) == std::vector{core::Address{128}});
}

TEST_CASE("scattered records lie apart, none across a page's border, behind the front") {
  constexpr std::size_t front_bytes = 3000, page_size = 1024;
  const std::vector<std::uint16_t> sizes = random_sizes(5000);
  const std::vector<core::Address> places = core::scattered_places(sizes, front_bytes, page_size);
  std::vector<std::pair<std::uint64_t, std::uint64_t>> extents;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const std::uint64_t first = core::byte_offset(places[i]), last = first + sizes[i] - 1;
    CHECK(first / page_size == last / page_size);
    extents.emplace_back(first, last);
  }
  std::sort(extents.begin(), extents.end());
  CHECK(extents.front().first >= front_bytes);
  for (std::size_t i = 1; i < extents.size(); ++i) {
    CHECK(extents[i - 1].second < extents[i].first);
  }
}

TEST_CASE("scattered records that were neighbours share a page no more often than by chance") {
  const std::vector<std::uint16_t> sizes(10000, 256);
  const std::vector<core::Address> places = core::scattered_places(sizes, 0, 1024);
  int together = 0;
  for (std::size_t i = 1; i < places.size(); ++i) {
    together += core::byte_offset(places[i - 1]) / 1024 == core::byte_offset(places[i]) / 1024 ? 1 : 0;
  }
  CHECK(together <= 20);  // 12 are expected: 3 of 10,000 places beside each
}

TEST_CASE("a database of scattered records gives the same picture by the same operations") {
  const core::Scene scene = core::built_in_scene(core::parse_scene_name("rings-2-t1"));
  const tests::Subject spatial(scene, {48, 48, 1}), other(scene, {48, 48, 1}, scattered());
  CHECK(other.outcome() == spatial.outcome());
  CHECK_FALSE(std::ranges::equal(spatial.database().bytes(), other.database().bytes()));
  CHECK(static_cast<double>(other.database().page_count()) ==
        doctest::Approx(static_cast<double>(spatial.database().page_count())).epsilon(0.1));
}

TEST_CASE("scattered records are the same bytes whenever they are built") {
  const core::Scene scene = core::built_in_scene(core::parse_scene_name("tetra-4"));
  CHECK(std::ranges::equal(core::build_database(scene, scattered()).bytes(), core::build_database(scene, scattered()).bytes()));
}

}  // namespace record_order_test
