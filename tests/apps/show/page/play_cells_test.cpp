#include "apps/show/page/play_cells.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <vector>

namespace dmpc::apps::html::play_cells_test {

using Values = std::vector<std::uint64_t>;

TEST_CASE("a picture with few pixels is played pixel by pixel") {
  const PlayCells cells(3, 2, 6);
  CHECK(cells.side() == 1);
  const Values values = {5, 1, 4, 2, 3, 0};
  CHECK(cells.sums(values) == values);
  CHECK(cells.largest(values) == values);
  CHECK(cells.of_last(values, values) == values);
}

TEST_CASE("one with more is played in squares, the last of which are what is left") {
  const PlayCells cells(3, 3, 8);
  CHECK(cells.side() == 2);
  CHECK(cells.wide() == 2);
  CHECK(cells.high() == 2);
  const Values values = {1, 2, 3,  //
                         4, 5, 6,  //
                         7, 8, 9};
  CHECK(cells.sums(values) == Values{12, 9, 15, 9});
  CHECK(cells.largest(values) == Values{5, 6, 8, 9});
}

TEST_CASE("a square belongs to the node of the pixel that was done last, of several the first") {
  const PlayCells cells(2, 2, 1);
  CHECK(cells.side() == 2);
  CHECK(cells.of_last(Values{7, 8, 9, 6}, Values{1, 5, 5, 2}) == Values{8});
  CHECK(cells.of_last(Values{7, 8, 9, 6}, Values{0, 0, 0, 0}) == Values{7});
}

TEST_CASE("squares grow until they are few enough") {
  CHECK(PlayCells(4096, 2160, std::size_t{1} << 18U).side() == 8);
  CHECK(PlayCells(512, 512, std::size_t{1} << 18U).side() == 1);
  CHECK(PlayCells(513, 512, std::size_t{1} << 18U).side() == 2);
  CHECK(PlayCells(1000, 1, 1).wide() == 1);
}

}  // namespace dmpc::apps::html::play_cells_test
