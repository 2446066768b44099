#include "svm/film_gather.h"

#include <doctest/doctest.h>

#include <cstring>
#include <numeric>
#include <vector>

#include "core/base/expect.h"
#include "svm/packets.h"
#include "tests/support/small_machine.h"

namespace svm_film_gather_test {

using namespace dmpc;
using namespace dmpc::tests;

namespace {

std::vector<svm::FilmEntry> entries_of(const Parcel& parcel, std::uint32_t planes) {
  svm::FilmHeader header;
  std::memcpy(&header, parcel.payload.data(), sizeof(header));
  CHECK(parcel.payload.size() == svm::film_packet_bytes(header.count, planes));
  std::vector<svm::FilmEntry> entries;
  for (std::uint32_t i = 0; i < header.count; ++i) {
    entries.push_back(svm::film_entry_in(parcel.payload, i, planes));
  }
  return entries;
}

/// Node 1 of two on threads, with pages of 512 B, which do not matter: with one sample a pixel 127 entries to a packet of 4 KiB.
struct ThreadsGather {
  explicit ThreadsGather(std::uint32_t samples)
      : plan(svm::make_plan({.page_count = 4,
                             .page_size_bytes = 512,
                             .computer = {.node_count = 2},
                             .pages = {.in_flight = 4},
                             .width = 100,
                             .height = 100,
                             .first_samples = samples})),
        lone(plan, 1),
        film(lone.node, plan.film()) {}
  /// So many runs of 10 pixels each.
  void add_runs(std::uint32_t runs) {
    for (std::uint32_t run = 0; run < runs; ++run) {
      core::PixelSums sums;
      sums.plane[0].channel[2] = run + 7;
      film.add(run * 10, sums, 10);
    }
  }

  svm::Plan plan;
  LoneNode lone;
  svm::FilmGather film;
};

/// Node 1 of two on a modelled machine, with pages of 512 B: 73 pixels to a packet.
struct SmallGather {
  explicit SmallGather(std::uint32_t in_flight)
      : plan(svm::make_plan({.page_count = 4,
                             .page_size_bytes = 512,
                             .computer = {.node_count = 2, .machine = nodes::Machine()},
                             .pages = {.in_flight = in_flight},
                             .width = 1000,
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
      CHECK(parcel.payload.size() <= 4096);
      sent.emplace_back();
      for (const svm::FilmEntry& entry : entries_of(parcel, 2)) {
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

std::vector<std::uint32_t> pixels(std::uint32_t first, std::uint32_t count) {
  std::vector<std::uint32_t> all(count);
  std::iota(all.begin(), all.end(), first);
  return all;
}

}  // namespace

TEST_CASE("pixels leave when a packet is full") {
  SmallGather small(4);
  small.add(0, 72);
  CHECK(small.packets() == Packets{});
  small.add(72, 3);
  CHECK(small.packets() == Packets{pixels(0, 73)});
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
  small.add(0, 146);
  CHECK(small.packets().size() == 2);
  small.add(146, 74);
  small.film.flush();
  CHECK(small.packets() == Packets{});
  CHECK(small.film.has_room_for(3));
  CHECK_FALSE(small.film.has_room_for(4));
  small.film.acknowledged();
  CHECK(small.packets() == Packets{pixels(146, 73)});
  CHECK(small.film.gathered() == 1);
}

TEST_CASE("the room holds a packet and the pixels in flight, and one more is an error") {
  SmallGather small(4);
  small.add(0, 146 + 77);
  CHECK_FALSE(small.film.has_room_for(1));
  CHECK_THROWS_AS(small.add(146 + 77, 1), core::InternalError);
}

TEST_CASE("with one sample a pixel an entry has light on one plane, with more on two, on a modelled machine always") {
  CHECK(ThreadsGather(1).plan.film_planes == 1);
  CHECK(ThreadsGather(1).plan.film_entries == 127);
  CHECK(ThreadsGather(2).plan.film_planes == 2);
  CHECK(ThreadsGather(2).plan.film_entries == 73);
  CHECK(SmallGather(1).plan.film_planes == 2);
  ThreadsGather small(1);
  core::PixelSums sums;
  sums.plane[1].channel[0] = 1;
  CHECK_THROWS_AS(small.film.add(0, sums), core::InternalError);
}

TEST_CASE("a packet of one short entry is filled up, so that it takes the place of bulk that it was given") {
  ThreadsGather small(1);
  small.film.add(3, {});
  small.film.flush();
  REQUIRE(small.lone.post.parcels.size() == 1);
  const Parcel& parcel = small.lone.post.parcels.front();
  CHECK(parcel.payload.size() == nodes::small_payload_bytes + 8);
  CHECK(entries_of(parcel, 1).front().pixel == 3);
}

TEST_CASE("pixels of the same light that follow each other are one entry: none, one run, a full packet of them, one more") {
  for (const std::uint32_t runs : {0U, 1U, 127U, 128U}) {
    CAPTURE(runs);
    ThreadsGather small(1);
    small.add_runs(runs);
    CHECK(small.lone.post.parcels.size() == runs / 127);
    small.film.flush();
    std::uint32_t seen = 0;
    for (const Parcel& parcel : small.lone.post.parcels) {
      for (const svm::FilmEntry& entry : entries_of(parcel, 1)) {
        CHECK(entry.pixel == seen * 10);
        CHECK(entry.more == 9);
        CHECK(entry.sums.plane[0].channel[2] == seen + 7);
        CHECK(entry.sums.plane[1] == core::FixedColor{});
        ++seen;
      }
    }
    CHECK(seen == runs);
  }
}

TEST_CASE("an acknowledgement of nothing is an error") {
  SmallGather small(1);
  CHECK_THROWS_AS(small.film.acknowledged(), core::InternalError);
}

}  // namespace svm_film_gather_test
