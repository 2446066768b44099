#include "svm/work_items.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "core/base/expect.h"

namespace work_items_test {

using namespace dmpc;
using svm::PixelRectangle;

namespace {

void count_pixels(const PixelRectangle& item, std::uint32_t image_width, std::vector<int>& visits) {
  for (svm::PixelScan scan(item); !scan.empty();) {
    ++visits.at(scan.next(image_width));
  }
}

/// Takes and gives at random until every share is empty; returns how often each pixel came up.
std::vector<int> visits_of_all(std::uint32_t width, std::uint32_t height, std::uint32_t nodes, std::uint32_t side,
                               svm::PixelShares shares) {
  std::mt19937 generator(width * 7 + height * 11 + nodes * 13 + side);
  std::vector<int> visits(std::size_t{width} * height);
  for (std::uint32_t node = 0; node < nodes; ++node) {
    svm::WorkItems items(svm::share_of({0, 0, width, height}, node, nodes, shares), side);
    while (const auto item = generator() % 2 == 0 ? items.take() : items.give()) {
      count_pixels(*item, width, visits);
    }
    CHECK(items.empty());
  }
  return visits;
}

}  // namespace

TEST_CASE("submaps or interleaved pixels, and items, taken and given mixed, cover each pixel exactly once") {
  for (const auto& [width, height] : {std::pair{1U, 1U}, {1U, 17U}, {16U, 16U}, {13U, 5U}, {31U, 64U}}) {
    for (const std::uint32_t nodes : {1U, 2U, 3U, 7U, 8U, 64U, 101U}) {
      for (const std::uint32_t side : {0U, 1U, 3U, 16U, 100U}) {
        for (const svm::PixelShares shares : {svm::PixelShares::submaps, svm::PixelShares::interleaved}) {
          const std::vector<int> visits = visits_of_all(width, height, nodes, side, shares);
          INFO("width ", width, ", height ", height, ", nodes ", nodes, ", side ", side, ", ", name_of(shares));
          CHECK(std::count(visits.begin(), visits.end(), 1) == std::ptrdiff_t{width} * height);
        }
      }
    }
  }
}

TEST_CASE("submaps are of nearly equal area and at most three times as long as wide") {
  for (const std::uint32_t nodes : {2U, 3U, 5U, 7U, 8U, 13U, 32U, 61U, 64U}) {
    for (std::uint32_t node = 0; node < nodes; ++node) {
      const PixelRectangle submap = svm::submap_of({0, 0, 512, 512}, node, nodes);
      const double share = static_cast<double>(submap.pixel_count()) * nodes / (512.0 * 512.0);
      CHECK(share > 0.95);
      CHECK(share < 1.05);
      CHECK(std::max(submap.width, submap.height) <= 3 * std::min(submap.width, submap.height) + 1);
    }
  }
}

TEST_CASE("sixty-four nodes on a square picture get equal squares") {
  for (std::uint32_t node = 0; node < 64; ++node) {
    const PixelRectangle submap = svm::submap_of({0, 0, 512, 512}, node, 64);
    CHECK(submap.width == 64);
    CHECK(submap.height == 64);
  }
}

TEST_CASE("where there are more nodes than pixels, some submaps are empty") {
  std::uint64_t pixels = 0;
  for (std::uint32_t node = 0; node < 50; ++node) {
    pixels += svm::submap_of({0, 0, 3, 2}, node, 50).pixel_count();
  }
  CHECK(pixels == 6);
  CHECK(svm::submap_of({0, 0, 3, 2}, 50, 50).pixel_count() == 0);  // behind those that render
}

TEST_CASE("interleaved, a node has every m-th pixel of every n-th line, from a corner of its own") {
  // 12 nodes are 4 x 3.
  CHECK(svm::interleaved_of({0, 0, 10, 7}, 0, 12) == PixelRectangle{0, 0, 3, 3, 4, 3});
  CHECK(svm::interleaved_of({0, 0, 10, 7}, 6, 12) == PixelRectangle{2, 1, 2, 2, 4, 3});
  CHECK(svm::interleaved_of({0, 0, 10, 7}, 11, 12) == PixelRectangle{3, 2, 2, 2, 4, 3});
  CHECK(svm::interleaved_of({0, 0, 10, 7}, 12, 12) == PixelRectangle{});  // behind those that render
  CHECK(svm::interleaved_of({0, 0, 10, 7}, 0, 1) == PixelRectangle{0, 0, 10, 7});
}

TEST_CASE("interleaved, sixty-four nodes are eight by eight, and a prime number of them is one row") {
  CHECK(svm::interleaved_of({0, 0, 512, 512}, 63, 64) == PixelRectangle{7, 7, 64, 64, 8, 8});
  CHECK(svm::interleaved_of({0, 0, 20, 3}, 4, 7) == PixelRectangle{4, 0, 3, 3, 7, 1});
  CHECK(svm::interleaved_of({0, 0, 4, 3}, 4, 7).pixel_count() == 0);  // no column is left for it
}

TEST_CASE("items of interleaved pixels are as far apart as those are, and clipped where those end") {
  svm::WorkItems items({2, 1, 4, 3, 4, 3}, 3);
  CHECK(items.count() == 2);
  CHECK(items.give() == PixelRectangle{14, 1, 1, 3, 4, 3});
  const auto item = items.take();
  REQUIRE(item == PixelRectangle{2, 1, 3, 3, 4, 3});
  svm::PixelScan scan(*item, {.width = 2, .height = 2});
  std::vector<std::uint32_t> pixels;
  for (std::uint64_t place = 0; place < 9; ++place) {
    CHECK(item->pixel_at(place, 100) == 100 * (1 + place / 3 * 3) + 2 + place % 3 * 4);
    pixels.push_back(scan.next(100));
  }
  CHECK(pixels == std::vector<std::uint32_t>{102, 106, 402, 406, 110, 410, 702, 706, 710});
}

TEST_CASE("an empty submap has no items") {
  for (const std::uint32_t side : {0U, 3U}) {
    svm::WorkItems items({5, 5, 0, 7}, side);
    CHECK(items.empty());
    CHECK_FALSE(items.take());
    CHECK_FALSE(items.give());
  }
}

TEST_CASE("items are taken in scan order, given away from the far end, and clipped at the edge") {
  svm::WorkItems items({10, 20, 7, 4}, 3);
  CHECK(items.count() == 6);
  CHECK(items.take() == PixelRectangle{10, 20, 3, 3});
  CHECK(items.take() == PixelRectangle{13, 20, 3, 3});
  CHECK(items.give() == PixelRectangle{16, 23, 1, 1});
  CHECK(items.take() == PixelRectangle{16, 20, 1, 3});
  CHECK(items.give() == PixelRectangle{13, 23, 3, 1});
  CHECK(items.take() == PixelRectangle{10, 23, 3, 1});
  CHECK_FALSE(items.take());
}

TEST_CASE("side 0 makes the whole submap one item") {
  svm::WorkItems items({2, 3, 40, 30}, 0);
  CHECK(items.take() == PixelRectangle{2, 3, 40, 30});
  CHECK(items.empty());
}

TEST_CASE("a scan goes row by row and ends") {
  svm::PixelScan scan(PixelRectangle{2, 1, 2, 2});
  CHECK(scan.next(10) == 12);
  CHECK(scan.next(10) == 13);
  CHECK(scan.next(10) == 22);
  CHECK(scan.next(10) == 23);
  CHECK(scan.empty());
  CHECK_THROWS_AS(scan.next(10), core::InternalError);
  CHECK(svm::PixelScan().empty());
}

TEST_CASE("a scan in tiles goes tile by tile, says where one ends, and has what the edge leaves of the last") {
  svm::PixelScan scan(PixelRectangle{10, 0, 5, 3}, {.width = 2, .height = 2});
  std::vector<std::uint32_t> pixels;
  std::vector<std::size_t> tiles;
  while (!scan.empty()) {
    tiles.push_back(0);
    do {
      pixels.push_back(scan.next(100));
      ++tiles.back();
    } while (scan.stays_in_tile());
  }
  CHECK(pixels == std::vector<std::uint32_t>{10, 11, 110, 111, 12, 13, 112, 113, 14, 114, 210, 211, 212, 213, 214});
  CHECK(tiles == std::vector<std::size_t>{4, 4, 2, 2, 2, 1});
}

TEST_CASE("of a scan in tiles only the wanted pixels come") {
  // .x.
  // ..x
  // xx.
  svm::PixelScan scan(PixelRectangle{0, 0, 3, 3}, {.width = 2, .height = 2}, 0b011'100'010);
  CHECK(scan.next(10) == 1);
  CHECK_FALSE(scan.stays_in_tile());
  CHECK(scan.next(10) == 12);
  CHECK_FALSE(scan.stays_in_tile());
  CHECK(scan.next(10) == 20);
  CHECK(scan.stays_in_tile());
  CHECK(scan.next(10) == 21);
  CHECK(scan.empty());
  CHECK_FALSE(scan.stays_in_tile());
  CHECK(svm::PixelScan(PixelRectangle{0, 0, 3, 3}, {}, 0).empty());
}

TEST_CASE("a tile is as square as a power of two allows, of as many pixels as fill bundles with their samples") {
  CHECK(svm::tile_of(16) == svm::PixelTile{4, 4});
  CHECK(svm::tile_of(8) == svm::PixelTile{4, 2});
  CHECK(svm::tile_of(5) == svm::PixelTile{2, 2});
  CHECK(svm::tile_of(1) == svm::PixelTile{1, 1});
  CHECK(svm::tile_of(0) == svm::PixelTile{1, 1});
  CHECK(svm::tile_for(4, 16) == svm::PixelTile{2, 2});
  CHECK(svm::tile_for(16, 16) == svm::PixelTile{1, 1});
  CHECK(svm::tile_for(12, 16) == svm::PixelTile{2, 2});
  CHECK(svm::tile_for(3, 16) == svm::PixelTile{4, 4});
  CHECK(svm::tile_for(1, 1) == svm::PixelTile{1, 1});
}

}  // namespace work_items_test
