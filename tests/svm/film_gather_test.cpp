#include "svm/film_gather.h"

#include <doctest/doctest.h>

#include <cstring>
#include <vector>

#include "core/base/expect.h"
#include "svm/packets.h"
#include "tests/support/small_machine.h"

namespace svm_film_gather_test {

using namespace dmpc;
using namespace dmpc::tests;

namespace {

/// Node 1 of two, with pages of 512 B: 9 pixels to a packet.
struct SmallGather {
  explicit SmallGather(std::uint32_t in_flight)
      : plan(svm::make_plan({.page_count = 4,
                             .page_size_bytes = 512,
                             .computer = {.node_count = 2, .machine = nodes::Machine()},
                             .pages = {.in_flight = in_flight},
                             .width = 100,
                             .height = 1})),
        lone(plan, 1),
        film(lone.node, plan.film()) {}
  void add(std::uint32_t first, std::uint32_t count) {
    for (std::uint32_t pixel = first; pixel < first + count; ++pixel) {
      core::PixelSums sums;
      sums.plane[0].channel[0] = pixel * 3;
      film.add(pixel, sums);
    }
  }
  /// The pixels of each packet sent since the last call.
  std::vector<std::vector<std::uint32_t>> packets() {
    std::vector<std::vector<std::uint32_t>> sent;
    for (const Parcel& parcel : lone.post.parcels) {
      CHECK(parcel.target == nodes::NodeId{2});
      CHECK(parcel.payload.size() <= 512);
      sent.emplace_back();
      for (std::size_t at = sizeof(svm::FilmHeader); at < parcel.payload.size(); at += sizeof(svm::FilmEntry)) {
        svm::FilmEntry entry;
        std::memcpy(&entry, parcel.payload.data() + at, sizeof(entry));
        CHECK(entry.sums.plane[0].channel[0] == entry.pixel * 3);
        sent.back().push_back(entry.pixel);
      }
    }
    lone.post.parcels.clear();
    return sent;
  }

  svm::Plan plan;
  LoneNode lone;
  svm::FilmGather film;
};

using Packets = std::vector<std::vector<std::uint32_t>>;

}  // namespace

TEST_CASE("pixels leave when a packet is full") {
  SmallGather small(4);
  small.add(0, 8);
  CHECK(small.packets() == Packets{});
  small.add(8, 3);
  CHECK(small.packets() == Packets{{0, 1, 2, 3, 4, 5, 6, 7, 8}});
  CHECK(small.film.gathered() == 2);
}

TEST_CASE("a flush sends what is there, and nothing when nothing is there") {
  SmallGather small(4);
  small.film.flush();
  CHECK(small.packets() == Packets{});
  small.add(7, 1);
  small.film.flush();
  CHECK(small.packets() == Packets{{7}});
  CHECK_FALSE(small.film.settled());
  small.film.acknowledged();
  CHECK(small.film.settled());
}

TEST_CASE("a third packet waits for an acknowledgement, and no pixel may start once the room is spoken for") {
  SmallGather small(4);
  small.add(0, 18);
  CHECK(small.packets().size() == 2);
  small.add(18, 10);
  small.film.flush();
  CHECK(small.packets() == Packets{});
  CHECK(small.film.has_room_for(3));
  CHECK_FALSE(small.film.has_room_for(4));
  small.film.acknowledged();
  CHECK(small.packets() == Packets{{18, 19, 20, 21, 22, 23, 24, 25, 26}});
  CHECK(small.film.gathered() == 1);
}

TEST_CASE("the room holds a packet and the pixels in flight, and one more is an error") {
  SmallGather small(4);
  small.add(0, 18 + 13);
  CHECK_FALSE(small.film.has_room_for(1));
  CHECK_THROWS_AS(small.add(31, 1), core::InternalError);
}

TEST_CASE("an acknowledgement of nothing is an error") {
  SmallGather small(1);
  CHECK_THROWS_AS(small.film.acknowledged(), core::InternalError);
}

}  // namespace svm_film_gather_test
