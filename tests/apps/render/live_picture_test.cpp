#include "apps/render/live_picture.h"

#include <doctest/doctest.h>

#include <map>

namespace dmpc::apps::live_picture_test {

namespace {

/// A film of 100x70 pixels, tile by tile 64x64 at most, on which pixels get the light of their numbers.
struct SmallFilm {
  void light(std::uint32_t pixel) {
    core::PixelSums sums;
    sums.plane[0] = core::to_fixed({static_cast<float>(pixel), 1, 0});
    film.deposit(pixel, sums);
  }

  core::Film film{100, 70};
  core::Refinement pass{{}, 1, 100, 70};
};

}  // namespace

TEST_CASE("tiles on which light has fallen are handed over once they are asked for, with what has come of each pixel") {
  SmallFilm small;
  LivePicture picture(100, 70);
  CHECK(picture.tile_count() == 4);
  for (std::uint32_t pixel = 0; pixel < 63; ++pixel) {
    small.light(pixel);
    picture.watch(small.film, small.pass, pixel);
  }
  CHECK(picture.take().empty());  // nobody had asked
  small.light(63);
  picture.watch(small.film, small.pass, 63);
  const std::vector<PictureTile> tiles = picture.take();
  REQUIRE(tiles.size() == 1);
  CHECK(tiles[0].index == 0);
  CHECK(tiles[0].rgb[3 * 7] == 7);
  CHECK(tiles[0].rgb[3 * 63] == 63);
  CHECK(tiles[0].rgb[3 * 64 + 1] == 0);  // the second row is still empty
  CHECK(picture.take().empty());
}

TEST_CASE("the next picture begins with no tile that light has fallen on") {
  SmallFilm small;
  LivePicture picture(100, 70);
  picture.take();
  small.light(0);
  picture.watch(small.film, small.pass, 0);
  small.light(1);
  picture.watch(small.film, small.pass, 1);
  picture.begin_again();
  small.light(99);
  picture.watch(small.film, small.pass, 99);
  const std::vector<PictureTile> tiles = picture.take();
  REQUIRE(tiles.size() == 1);
  CHECK(tiles[0].index == 1);
}

TEST_CASE("in the end there is the whole picture, each pixel in one tile") {
  SmallFilm small;
  LivePicture picture(100, 70);
  for (std::uint32_t pixel = 0; pixel < 7000; ++pixel) {
    small.light(pixel);
  }
  small.pass.next_pass(small.film);
  std::uint32_t pixels = 0;
  for (const PictureTile& tile : picture.finish(small.film)) {
    pixels += tile.width * tile.height;
    CHECK(tile.rgb[0] == static_cast<float>(tile.y * 100 + tile.x));
  }
  CHECK(pixels == 7000);
}

}  // namespace dmpc::apps::live_picture_test
