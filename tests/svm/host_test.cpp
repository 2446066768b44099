#include "svm/host.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/base/expect.h"
#include "core/picture/memory_use.h"
#include "svm/packets.h"
#include "tests/support/small_machine.h"

namespace svm_host_test {

using namespace dmpc;
using namespace dmpc::tests;
using svm::Kind;

namespace {

void receive_film(svm::HostProgram& host, std::uint32_t node, const std::vector<svm::FilmEntry>& entries, std::uint32_t planes) {
  const svm::FilmHeader header{static_cast<std::uint32_t>(entries.size())};
  Parcel parcel = parcel_of(node, Kind::film_sums, header);
  parcel.payload.resize(svm::film_packet_bytes(entries.size(), planes));
  for (std::size_t i = 0; i < entries.size(); ++i) {
    svm::put_film_entry(parcel.payload, i, planes, entries[i]);
  }
  host.receive(parcel.packet());
}

/// The host of two nodes and a picture of 3x1 pixels.
struct SmallHost {
  explicit SmallHost(nodes::Progress progress = {})
      : plan(svm::make_plan({.page_count = 4, .computer = {.node_count = 2}, .width = 3, .height = 1})),
        lone(plan, 2),
        film(3, 1),
        host(lone.node, plan, film, std::move(progress)) {}
  void film_from(std::uint32_t node, const std::vector<std::uint32_t>& pixels) {
    std::vector<svm::FilmEntry> entries;
    for (const std::uint32_t pixel : pixels) {
      entries.push_back(svm::FilmEntry{pixel, 0, {}});
      entries.back().sums.plane[0].channel[2] = pixel + 10;
    }
    receive_film(host, node, entries, 1);
  }
  void done(std::uint32_t node, std::uint64_t pixels) { host.receive(parcel_of(node, Kind::done, svm::Done{pixels}).packet()); }
  std::size_t sent(Kind kind) const {
    std::size_t count = 0;
    for (const Parcel& parcel : lone.post.parcels) {
      count += parcel.kind == svm::number_of(kind) ? 1 : 0;
    }
    return count;
  }

  svm::Plan plan;
  LoneNode lone;
  core::Film film;
  svm::HostProgram host;
};

}  // namespace

TEST_CASE("a host that assigns the work gives each item once, in order, to whoever asks, and then nothing") {
  const svm::Plan plan = svm::make_plan({.page_count = 4,
                                         .computer = {.node_count = 2},
                                         .pages = {.work_item_side = 2, .work_donor = svm::WorkDonor::host},
                                         .width = 3,
                                         .height = 3});
  LoneNode lone(plan, 2);
  core::Film film(3, 3);
  svm::HostProgram host(lone.node, plan, film, {});
  const svm::PixelRectangle items[] = {{0, 0, 2, 2}, {2, 0, 1, 2}, {0, 2, 2, 1}, {2, 2, 1, 1}, {}};
  std::uint32_t requester = 0;
  for (const svm::PixelRectangle& item : items) {
    requester = 1 - requester;
    host.receive(parcel_of(requester, Kind::work_request, svm::WorkRequest{requester, 1}).packet());
    const Parcel& parcel = lone.post.parcels.back();
    CHECK(parcel.target == nodes::NodeId{requester});
    CHECK(parcel.packet().as<svm::WorkReply>().item.rectangle() == item);
  }
  CHECK(host.items_given() == 4);
}

TEST_CASE("a host that is home to all pages replies with the one that is asked for, another one is asked for none") {
  const FakePages pages(6, 512);
  svm::PlanRequest request{.page_count = 6,
                           .page_size_bytes = 512,
                           .computer = {.node_count = 2},
                           .pages = {.homes = svm::PageHomes::host},
                           .width = 3,
                           .height = 1};
  request.database = pages.bytes();
  const svm::Plan plan = svm::make_plan(request);
  LoneNode lone(plan, 2);
  core::Film film(3, 1);
  svm::HostProgram host(lone.node, plan, film, {});
  CHECK(lone.memory.used()[core::MemoryUse::home_pages] == lone.memory.plan()[core::MemoryUse::home_pages]);
  for (const std::uint32_t page : {5U, 0U, 5U}) {
    host.receive(parcel_of(1, Kind::page_request, svm::PageRequest{svm::PageId{page}}).packet());
    const Parcel& parcel = lone.post.parcels.back();
    CHECK(parcel.target == nodes::NodeId{1});
    CHECK(parcel.kind == svm::number_of(Kind::page_reply));
    const auto payload = parcel.packet().behind(sizeof(svm::PageReplyHeader));
    CHECK(std::equal(payload.begin(), payload.end(), pages.page(page).begin()));
  }
  CHECK(host.pages_served() == 3);
  CHECK_THROWS_AS(host.receive(parcel_of(1, Kind::page_request, svm::PageRequest{svm::PageId{6}}).packet()), core::InternalError);
  SmallHost other;
  CHECK_THROWS_AS(other.host.receive(parcel_of(1, Kind::page_request, svm::PageRequest{svm::PageId{0}}).packet()),
                  core::InternalError);
}

TEST_CASE("a host that does not assign the work is asked for none") {
  SmallHost small;
  CHECK_THROWS_AS(small.host.receive(parcel_of(0, Kind::work_request, svm::WorkRequest{0, 1}).packet()), core::InternalError);
}

TEST_CASE("where the error is too large each node gets its mask part by part, and the pass begins when all have theirs") {
  const svm::Plan plan = svm::make_plan({.page_count = 4,
                                         .computer = {.node_count = 2},
                                         .width = 8000,
                                         .height = 1,
                                         .first_samples = 2,
                                         .refinement = {.error = 1e-9}});
  LoneNode lone(plan, 2);
  core::Film film(8000, 1);
  svm::HostProgram host(lone.node, plan, film, {});
  const auto sent = [&](Kind kind) {
    return std::count_if(lone.post.parcels.begin(), lone.post.parcels.end(),
                         [&](const Parcel& parcel) { return parcel.kind == svm::number_of(kind); });
  };
  for (std::uint32_t pixel = 0; pixel < 8000; ++pixel) {
    svm::FilmEntry entry{pixel, 0, {}};
    entry.sums.plane[1].channel[2] = pixel % 4000 == 10 ? 1 << 20 : 0;
    receive_film(host, 0, {entry}, 2);
  }
  for (std::uint32_t node = 0; node < 2; ++node) {
    host.receive(parcel_of(node, Kind::done, svm::Done{4000}).packet());
  }
  CHECK(sent(Kind::stop) == 0);
  CHECK(sent(Kind::mask_part) == 2);
  const auto part = lone.post.parcels.back().packet().as<svm::MaskPart>();
  for (const std::size_t pixel : {9, 10, 11}) {
    CHECK(part.steps[pixel].samples(2).first == 2);
    CHECK_FALSE(part.steps[pixel].is_none());
  }
  std::uint32_t acknowledged = 0;
  for (std::ptrdiff_t parts = 2; parts < 18; ++acknowledged) {  // 480 pixels of 4000 a part
    host.receive(parcel_of(acknowledged % 2, Kind::mask_acknowledgement, svm::MaskAcknowledgement{}).packet());
    CHECK(sent(Kind::mask_part) == ++parts);
  }
  CHECK(sent(Kind::begin_pass) == 0);
  host.receive(parcel_of(0, Kind::mask_acknowledgement, svm::MaskAcknowledgement{}).packet());
  CHECK(sent(Kind::begin_pass) == 0);
  host.receive(parcel_of(1, Kind::mask_acknowledgement, svm::MaskAcknowledgement{}).packet());
  CHECK(sent(Kind::begin_pass) == 2);
  CHECK(host.describe().find("pixels of pass 2 arrived, 0 of 2 nodes done") != std::string::npos);
}

TEST_CASE("finished pixels go onto the film and are acknowledged") {
  SmallHost small;
  small.film_from(1, {2, 0});
  CHECK(small.film.sums(2).plane[0].channel[2] == 12);
  CHECK(small.film.sums(0).plane[0].channel[2] == 10);
  CHECK(small.host.pixels_done() == 2);
  CHECK(small.sent(Kind::film_acknowledgement) == 1);
  CHECK(small.lone.post.parcels.front().target == nodes::NodeId{1});
}

TEST_CASE("a run of finished pixels puts its light on each of them, and none of them may come again or lie outside the picture") {
  SmallHost small;
  svm::FilmEntry run{1, 1, {}};
  run.sums.plane[0].channel[0] = 5;
  receive_film(small.host, 0, {run}, 1);
  CHECK(small.host.pixels_done() == 2);
  for (const std::uint32_t pixel : {1U, 2U}) {
    CHECK(small.film.sums(pixel).plane[0].channel[0] == 5);
  }
  CHECK(small.film.sums(0) == core::PixelSums{});
  CHECK_THROWS_AS(small.film_from(1, {2}), core::InternalError);
  for (const std::uint32_t more : {3U, ~std::uint32_t{0}}) {
    SmallHost other;
    CHECK_THROWS_AS(receive_film(other.host, 0, {svm::FilmEntry{0, more, {}}}, 1), core::InternalError);
  }
}

TEST_CASE("when all nodes are done and every pixel is there, every node is told to stop") {
  SmallHost small;
  small.film_from(0, {0, 1});
  small.done(0, 2);
  CHECK_FALSE(small.host.finished());
  small.film_from(1, {2});
  small.done(1, 1);
  CHECK(small.host.finished());
  CHECK(small.sent(Kind::stop) == 2);
}

TEST_CASE("a pixel that comes twice, or lies outside the picture, is an error") {
  SmallHost small;
  small.film_from(0, {1});
  CHECK_THROWS_AS(small.film_from(1, {1}), core::InternalError);
  CHECK_THROWS_AS(small.film_from(1, {3}), core::InternalError);
}

TEST_CASE("nodes that are done before every pixel has arrived are an error") {
  SmallHost small;
  small.film_from(0, {0, 1});
  small.done(0, 2);
  CHECK_THROWS_AS(small.done(1, 0), core::InternalError);
}

TEST_CASE("a film packet that is shorter than it says, and a packet for nodes, are errors") {
  SmallHost small;
  CHECK_THROWS_AS(small.host.receive(parcel_of(0, Kind::film_sums, svm::FilmHeader{1}).packet()), core::InternalError);
  CHECK_THROWS_AS(small.host.receive(parcel_of(0, Kind::stop, svm::Stop{3}).packet()), core::InternalError);
}

TEST_CASE("the host tells how far the picture is") {
  std::vector<std::uint32_t> calls;
  SmallHost small([&](std::uint32_t done, std::uint32_t total) {
    calls.push_back(done);
    calls.push_back(total);
  });
  small.film_from(0, {0});
  small.film_from(1, {1, 2});
  CHECK(calls == std::vector<std::uint32_t>{1, 3, 3, 3});
  CHECK(small.host.describe().find("3 of 3 pixels of pass 1 arrived, 0 of 2 nodes done") != std::string::npos);
}

}  // namespace svm_host_test
