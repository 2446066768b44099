#include "dataflow/film_gather.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <vector>

#include "core/base/expect.h"
#include "dataflow/rays/pixel_order.h"
#include "nodes/threads/threads_runner.h"
#include "tests/support/shuffled_machine.h"

namespace dataflow_film_gather_test {

using namespace dmpc;
using dataflow::FilmEntry;
using dataflow::FilmGather;

namespace {

struct FilmSender {
  explicit FilmSender(std::uint32_t credits, std::uint32_t at_once = 1)
      : FilmSender(
            FilmGather::Capacity{.credits = credits, .packet_entries = dataflow::film_packet_entries, .at_once = at_once}) {}
  explicit FilmSender(const FilmGather::Capacity& capacity)
      : single(FilmGather::layout(capacity.packet_entries) + nodes::credit_table(2), 0, 2), film(single.node, capacity) {}

  void fill(std::uint32_t first_pixel) {
    for (std::uint32_t i = 0; i < dataflow::film_packet_entries; ++i) {
      film.add(first_pixel + i, 0, {{1, 2, 3}});
    }
  }

  tests::SingleNode single;
  FilmGather film;
};

FilmEntry entry_in(const tests::Parcel& parcel, std::uint32_t index) {
  FilmEntry entry;
  std::memcpy(&entry, parcel.payload.data() + dataflow::film_packet_bytes(index), sizeof(entry));
  return entry;
}

}  // namespace

TEST_CASE("light on one plane of a pixel is one entry") {
  FilmSender sender(2);
  sender.film.add(7, 0, {{1, 2, 3}});
  sender.film.add(7, 1, {{5, 0, 0}});
  sender.film.add(8, 0, {{9, 9, 9}});
  sender.film.add(7, 0, {{10, 20, 30}});
  CHECK(sender.film.gathered() == 3);
  sender.film.flush();
  const tests::Parcel parcel = sender.single.take();
  CHECK(parcel.payload.size() == dataflow::film_packet_bytes(3));
  CHECK(entry_in(parcel, 0).pixel == 7);
  CHECK(entry_in(parcel, 0).light == core::FixedColor{{11, 22, 33}});
  CHECK(entry_in(parcel, 1).plane == 1);
  CHECK(sender.film.counters().deposits == 4);
  CHECK(sender.film.counters().entries == 3);
}

TEST_CASE("a full film packet leaves at once, a third waits until the host acknowledges one") {
  FilmSender sender(2);
  sender.fill(0);
  sender.fill(100);
  CHECK_FALSE(sender.film.waits());
  sender.fill(200);
  CHECK(sender.film.waits());
  CHECK_THROWS_AS(sender.film.add(1, 0, {{1, 1, 1}}), core::InternalError);
  CHECK(sender.single.post.parcels.size() == 2);
  sender.film.acknowledged();
  CHECK_FALSE(sender.film.waits());
  CHECK(sender.single.post.parcels.size() == 3);
  CHECK(entry_in(sender.single.post.parcels.back(), 0).pixel == 200);
}

TEST_CASE("pixels that follow each other and have one light share an entry: none, one, all that it can have, one more") {
  for (const std::uint32_t pixels : {0U, 1U, dataflow::film_entry_pixels_max, dataflow::film_entry_pixels_max + 1}) {
    CAPTURE(pixels);
    FilmSender sender(1);
    for (std::uint32_t pixel = 0; pixel < pixels; ++pixel) {
      sender.film.add_only(pixel + 10, 0, {{1, 2, 3}});
    }
    sender.film.flush();
    CHECK(sender.film.counters().deposits == pixels);
    CHECK(sender.film.counters().entries == (pixels + dataflow::film_entry_pixels_max - 1) / dataflow::film_entry_pixels_max);
    if (pixels > 0) {
      const tests::Parcel parcel = sender.single.take();
      CHECK(entry_in(parcel, 0).pixel == 10);
      CHECK(entry_in(parcel, 0).more + 1U == std::min(pixels, dataflow::film_entry_pixels_max));
      CHECK(entry_in(parcel, 0).light == core::FixedColor{{1, 2, 3}});
    }
  }
}

TEST_CASE("where pixels come square by square, those of a row that follow each other share an entry as well") {
  constexpr std::uint32_t width = 40, height = 8;
  const auto order = dataflow::PixelOrder::squares(width, height);
  FilmSender sender(1);
  for (std::uint32_t place = 0; place < width * height; ++place) {
    sender.film.add_only(order.pixel_at(place), 0, {{1, 2, 3}});
  }
  sender.film.flush();
  const tests::Parcel parcel = sender.single.take();
  REQUIRE(sender.film.counters().entries == height - 1);  // the last row of the first squares goes on in the next squares' first
  std::vector<int> times(width * height);
  for (std::uint32_t i = 0; i < height - 1; ++i) {
    const FilmEntry entry = entry_in(parcel, i);
    for (std::uint32_t pixel = entry.pixel; pixel <= entry.pixel + entry.more; ++pixel) {
      ++times.at(pixel);
    }
  }
  CHECK(times == std::vector<int>(width * height, 1));
}

TEST_CASE("pixels of other light, of another plane or apart do not share an entry, and a packet of them leaves when it is full") {
  FilmSender sender(2);
  sender.film.add_only(1, 0, {{1, 2, 3}});
  sender.film.add_only(2, 0, {{1, 2, 4}});
  sender.film.add_only(3, 1, {{1, 2, 4}});
  sender.film.add_only(5, 1, {{1, 2, 4}});
  sender.film.add_only(6, 1, {{1, 2, 4}});
  sender.film.add(5, 1, {{1, 0, 0}});  // which is of pixel 5 alone
  CHECK(sender.film.gathered() == 5);
  for (std::uint32_t i = 5; i < dataflow::film_packet_entries; ++i) {
    sender.film.add_only(10 * i, 0, {{1, 2, 3}});
  }
  CHECK(sender.film.gathered() == 0);
  CHECK(sender.single.take().payload.size() == dataflow::film_packet_bytes(dataflow::film_packet_entries));
  sender.film.add_only(10 * dataflow::film_packet_entries, 0, {{1, 2, 3}});
  CHECK(sender.film.gathered() == 1);
}

TEST_CASE("a packet waits for as long as it has no room for what may come at once") {
  FilmSender sender(1, 4);
  sender.fill(0);
  CHECK(sender.single.take().payload.size() == dataflow::film_packet_bytes(dataflow::film_packet_entries - 3));
  CHECK(sender.film.gathered() == 3);
  std::uint32_t pixel = 100;
  while (!sender.film.waits()) {
    sender.film.add(pixel++, 0, {{1, 2, 3}});
  }
  for (int more = 0; more < 3; ++more) {
    sender.film.add(pixel++, 0, {{1, 2, 3}});
  }
  CHECK_THROWS_AS(sender.film.add(pixel, 0, {{1, 2, 3}}), core::InternalError);
}

TEST_CASE("in a long packet a pixel's light finds that of two bundles before it, and older light of it stays an entry apart") {
  FilmSender sender({.packet_entries = 100});
  for (std::uint32_t pixel = 0; pixel < 40; ++pixel) {
    sender.film.add(pixel, 0, {{1, 2, 3}});
  }
  sender.film.add(8, 0, {{1, 0, 0}});  // the 32nd from the end
  CHECK(sender.film.gathered() == 40);
  sender.film.add(7, 0, {{1, 0, 0}});
  CHECK(sender.film.gathered() == 41);
  sender.film.flush();
  const tests::Parcel parcel = sender.single.take();
  CHECK(entry_in(parcel, 8).light == core::FixedColor{{2, 2, 3}});
  CHECK(entry_in(parcel, 40).light == core::FixedColor{{1, 0, 0}});
}

TEST_CASE("the film is settled when all has been sent and acknowledged") {
  FilmSender sender(1);
  CHECK(sender.film.settled());
  sender.film.flush();
  CHECK(sender.single.post.parcels.empty());
  sender.film.add(1, 1, {{1, 1, 1}});
  CHECK_FALSE(sender.film.settled());
  sender.film.flush();
  CHECK_FALSE(sender.film.settled());
  sender.film.acknowledged();
  CHECK(sender.film.settled());
  CHECK_THROWS_AS(sender.film.acknowledged(), core::InternalError);
}

TEST_CASE("light that saturates an entry is counted") {
  FilmSender sender(1);
  sender.film.add(1, 0, {{std::numeric_limits<std::int64_t>::max(), 0, 0}});
  sender.film.add(1, 0, {{1, 0, 0}});
  CHECK(sender.film.counters().saturated == 1);
}

}  // namespace dataflow_film_gather_test
