#include "apps/picture/png_filter.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <vector>

#include "core/base/expect.h"

namespace dmpc::tests::png_filter_test {

namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes filtered(const Bytes& row, const Bytes& above = {}) {
  Bytes room(1 + row.size());
  apps::PngFilter(row.size()).filter(row, above, room);
  return room;
}

}  // namespace

TEST_CASE("a row takes the filter whose differences are the least in sum, and of two such the first") {
  CHECK(filtered({1, 0, 255, 0, 1, 0}) == Bytes{0, 1, 0, 255, 0, 1, 0});                               // none
  CHECK(filtered({90, 50, 20, 91, 50, 19}) == Bytes{1, 90, 50, 20, 1, 0, 255});                        // the pixel to the left
  CHECK(filtered({90, 50, 20, 7, 200, 5}, {90, 51, 20, 7, 200, 4}) == Bytes{2, 0, 255, 0, 0, 0, 1});   // above
  CHECK(filtered({40, 41, 42, 60, 60, 60}, {80, 82, 85, 80, 80, 79}) == Bytes{3, 0, 0, 0, 0, 0, 0});   // the mean of both
  CHECK(filtered({80, 20, 30, 80, 99, 30}, {10, 20, 30, 10, 99, 30}) == Bytes{4, 70, 0, 0, 0, 0, 0});  // Paeth's
}

TEST_CASE("a filter begins anew with each row") {
  apps::PngFilter filter(3);
  Bytes first(4), second(4);
  filter.filter(Bytes{9, 8, 7}, Bytes{9, 8, 7}, first);
  filter.filter(Bytes{9, 8, 7}, {}, second);
  CHECK(first == Bytes{2, 0, 0, 0});
  CHECK(second == Bytes{0, 9, 8, 7});
}

TEST_CASE("a row of another length is a bug") {
  Bytes room(4);
  CHECK_THROWS_AS(apps::PngFilter(3).filter(Bytes(2), {}, room), core::InternalError);
  CHECK_THROWS_AS(apps::PngFilter(3).filter(Bytes(3), Bytes(2), room), core::InternalError);
}

}  // namespace dmpc::tests::png_filter_test
