#include "svm/pages/pager.h"

#include <doctest/doctest.h>

#include <cstring>
#include <vector>

#include "core/base/expect.h"
#include "svm/packets.h"
#include "tests/support/small_machine.h"
#include "tests/support/small_pages.h"

namespace pager_test {

using namespace dmpc;
using namespace dmpc::tests;
using svm::Kind;
using svm::PageId;

namespace {

svm::Plan plan_with(std::uint32_t nodes, std::uint32_t cache_pages, std::uint32_t in_flight) {
  return svm::make_plan({.page_count = page_count,
                         .page_size_bytes = page_size,
                         .computer = {.node_count = nodes},
                         .pages = {.cache_pages = cache_pages, .in_flight = in_flight},
                         .width = 64,
                         .height = 1});
}

/// The pager of node 0.
struct SmallPager {
  SmallPager(std::uint32_t nodes, std::uint32_t cache_pages, std::uint32_t in_flight,
             nodes::Immutable immutable = nodes::Immutable::is_copied)
      : plan(plan_with(nodes, cache_pages, in_flight)),
        lone(plan, 0, immutable),
        pages(page_count, page_size),
        pager(lone.node, plan.pages(), pages.bytes()) {}

  bool finds(std::uint32_t page) {
    const std::byte* record = pager.find(core::advance(start_of(page), 16));
    return record != nullptr && std::memcmp(record, pages.page(page).data() + 16, page_size - 16) == 0;
  }
  /// The reply that the page's home would send; returns the slots that go on.
  std::vector<std::uint32_t> reply(std::uint32_t page) {
    Parcel parcel = parcel_of(page % plan.request.computer.node_count, Kind::page_reply, svm::PageReplyHeader{PageId{page}});
    parcel.payload.insert(parcel.payload.end(), pages.page(page).begin(), pages.page(page).end());
    std::vector<std::uint32_t> slots;
    for (std::uint32_t slot = pager.install(parcel.packet()); slot != svm::no_slot; slot = pager.next_waiting(slot)) {
      slots.push_back(slot);
    }
    return slots;
  }
  /// The pages asked for since the last call.
  std::vector<std::uint32_t> requests() {
    std::vector<std::uint32_t> asked;
    for (const Parcel& parcel : lone.post.parcels) {
      const auto page = svm::index_of(parcel.packet().as<svm::PageRequest>().page);
      CHECK(parcel.target == nodes::NodeId{page % plan.request.computer.node_count});
      asked.push_back(page);
    }
    lone.post.parcels.clear();
    return asked;
  }

  svm::Plan plan;
  LoneNode lone;
  FakePages pages;
  svm::Pager pager;
};

using Pages = std::vector<std::uint32_t>;

}  // namespace

TEST_CASE("a home page is found without asking") {
  SmallPager small(4, 2, 2);
  for (std::uint32_t page = 0; page < page_count; page += 4) {
    CHECK(small.finds(page));
  }
  CHECK(small.requests() == Pages{});
  CHECK(small.pager.counters().home_hits == 10);
  CHECK(small.pager.counters().misses == 0);
}

TEST_CASE("one request leaves however many pixels wait for a page") {
  SmallPager small(4, 2, 3);
  for (std::uint32_t slot = 0; slot < 3; ++slot) {
    CHECK_FALSE(small.finds(5));
    small.pager.park(slot, start_of(5));
  }
  CHECK(small.requests() == Pages{5});
  CHECK(small.pager.counters().misses == 3);
  CHECK(small.pager.counters().faults == 1);
  CHECK(small.reply(5) == Pages{0, 1, 2});
  CHECK(small.finds(5));
}

TEST_CASE("a retried reference is not a second one") {
  SmallPager small(4, 2, 1);
  CHECK_FALSE(small.finds(5));
  small.pager.park(0, start_of(5));
  small.reply(5);
  small.pager.retried();
  CHECK(small.finds(5));
  CHECK(small.pager.counters().references == 1);
  CHECK(small.finds(5));
  CHECK(small.pager.counters().references == 2);
  CHECK(small.pager.counters().cache_hits == 1);
}

TEST_CASE("a page that was evicted is absent again, also when it was the last one referenced") {
  SmallPager small(4, 1, 1);
  small.pager.park(0, start_of(5));
  small.reply(5);
  CHECK(small.finds(5));
  small.pager.park(0, start_of(6));
  small.reply(6);
  CHECK(small.pager.find(start_of(5)) == nullptr);
  CHECK(small.finds(6));
  CHECK(small.pager.counters().evictions == 1);
}

TEST_CASE("a request without credit waits for a reply from the same home") {
  SmallPager small(2, 8, 8);
  REQUIRE(small.plan.request_credits == 4);
  for (std::uint32_t slot = 0; slot < 6; ++slot) {
    small.pager.park(slot, start_of(2 * slot + 1));
  }
  CHECK(small.requests() == Pages{1, 3, 5, 7});
  CHECK(small.pager.faults() == 6);
  small.reply(3);
  CHECK(small.requests() == Pages{9});
  small.reply(1);
  CHECK(small.requests() == Pages{11});
  small.reply(5);
  CHECK(small.requests() == Pages{});
  CHECK(small.lone.node.credits(nodes::NodeId{1}, svm::request_channel) == 1);
}

TEST_CASE("a home replies with the page at once, to whoever asks") {
  SmallPager small(4, 1, 1);
  for (const std::uint32_t requester : {3U, 1U, 1U, 2U}) {
    small.pager.serve(parcel_of(requester, Kind::page_request, svm::PageRequest{PageId{8}}).packet());
    REQUIRE(small.lone.post.parcels.size() == 1);
    const Parcel parcel = small.lone.post.parcels.front();
    small.lone.post.parcels.clear();
    CHECK(parcel.target == nodes::NodeId{requester});
    REQUIRE(parcel.payload.size() == 8 + page_size);
    CHECK(std::memcmp(parcel.payload.data() + 8, small.pages.page(8).data(), page_size) == 0);
  }
  CHECK(small.pager.counters().served == 4);
}

TEST_CASE("in a tree a node replies with what it has, to whoever asked first, and passes on what it has not") {
  svm::Plan plan =
      svm::make_plan({.page_count = page_count,
                      .page_size_bytes = page_size,
                      .computer = {.node_count = 40},  // node 3 is below node 0, and above nodes 12 and, below that, 39
                      .pages = {.cache_pages = 4, .homes = svm::PageHomes::tree, .resident_percent = 50, .in_flight = 1},
                      .width = 64,
                      .height = 1});
  REQUIRE(plan.resident_count == 2);
  REQUIRE(plan.frames == 2);
  plan.resident = {PageId{7}, PageId{3}};
  LoneNode lone(plan, 3);
  const FakePages pages(page_count, page_size);
  svm::Pager pager(lone.node, plan.pages(), pages.bytes());
  const auto last_parcel = [&] { return lone.post.parcels.back(); };

  CHECK(pager.find(start_of(3)) != nullptr);
  CHECK(pager.counters().home_hits == 1);
  CHECK(pager.find(start_of(9)) == nullptr);
  pager.park(0, start_of(9));
  CHECK(last_parcel().target == nodes::NodeId{0});
  CHECK(last_parcel().kind == svm::number_of(Kind::page_request));

  pager.serve(parcel_of(12, Kind::page_request, svm::PageRequest{PageId{9}}).packet());
  CHECK(last_parcel().target == nodes::NodeId{0});
  CHECK(last_parcel().kind == svm::number_of(Kind::passed_request));
  CHECK(last_parcel().packet().as<svm::PassedRequest>().page == PageId{9});
  CHECK(last_parcel().packet().as<svm::PassedRequest>().requester == 12);
  pager.serve(parcel_of(12, Kind::passed_request, svm::PassedRequest{PageId{8}, 39}).packet());
  CHECK(last_parcel().packet().as<svm::PassedRequest>().requester == 39);
  CHECK(pager.counters().served == 0);

  const svm::PageReplyHeader header{PageId{9}};
  const auto reply_from = [&](std::uint32_t source) {
    return nodes::Packet{nodes::NodeId{source}, svm::number_of(Kind::page_reply), std::as_bytes(std::span(&header, 1)),
                         pages.page(9)};
  };
  CHECK_THROWS_AS(pager.install(reply_from(12)), core::InternalError);
  pager.install(reply_from(40));  // the host's: node 0 did not have it
  for (const std::uint32_t page : {9U, 7U}) {
    pager.serve(parcel_of(12, Kind::passed_request, svm::PassedRequest{PageId{page}, 39}).packet());
    CHECK(last_parcel().target == nodes::NodeId{39});
    CHECK(last_parcel().kind == svm::number_of(Kind::page_reply));
    CHECK(std::memcmp(last_parcel().payload.data() + 8, pages.page(page).data(), page_size) == 0);
  }
  CHECK(pager.counters().served == 2);
  CHECK(lone.node.credits(nodes::NodeId{0}, svm::request_channel) == plan.request_credits);
}

TEST_CASE("on a modelled machine pages at home and in the cache are where they are in the database, and count as copies") {
  SmallPager copying(4, 2, 2), referring(4, 2, 2, nodes::Immutable::is_referred_to);
  for (SmallPager* const small : {&copying, &referring}) {
    for (const std::uint32_t page : {5U, 6U, 7U}) {
      CHECK_FALSE(small->finds(page));
      small->pager.park(0, start_of(page));
      const svm::PageReplyHeader header{PageId{page}};
      small->pager.install({nodes::NodeId{page % 4}, svm::number_of(Kind::page_reply), std::as_bytes(std::span(&header, 1)),
                            small->pages.page(page)});
      CHECK(small->finds(page));
    }
    CHECK(small->finds(6));
    CHECK_FALSE(small->finds(5));
    CHECK(small->lone.memory.used().bytes == copying.lone.memory.used().bytes);
    CHECK(small->pager.counters().evictions == 1);
  }
  for (const std::uint32_t page : {8U, 6U, 7U}) {
    CHECK(referring.pager.find(start_of(page)) == referring.pages.page(page).data());
    CHECK(copying.pager.find(start_of(page)) != copying.pages.page(page).data());
  }
}

TEST_CASE("a page that bypasses the cache serves all who waited for it, from its packet, and nobody else") {
  struct TakesNone final : svm::OwnPolicyRun, svm::ReplacementPolicy {
    std::unique_ptr<svm::ReplacementPolicy> make(const svm::PolicySite& /*site*/) override {
      return std::make_unique<TakesNone>();
    }
    void finish() override {}
    std::uint32_t victim(PageId /*incoming*/) override { return svm::bypass; }
  };
  struct Waiting {
    svm::Pager& pager;
    const FakePages& pages;
    std::vector<std::uint32_t> went_on = {};

    bool finds(std::uint32_t page) const {
      const std::byte* const record = pager.find(core::advance(start_of(page), 16));
      return record != nullptr && std::memcmp(record, pages.page(page).data() + 16, page_size - 16) == 0;
    }
    void go_on(std::uint32_t slot) {
      went_on.push_back(slot);
      CHECK(finds(7));
      CHECK(finds(5));
      CHECK(finds(0));
      CHECK(finds(7));
    }
  };
  for (const nodes::Immutable immutable : {nodes::Immutable::is_copied, nodes::Immutable::is_referred_to}) {
    svm::Plan plan = plan_with(4, 2, 2);
    TakesNone policy;
    plan.own_policy = &policy;
    LoneNode lone(plan, 0, immutable);
    const FakePages pages(page_count, page_size);
    svm::Pager pager(lone.node, plan.pages(), pages.bytes());
    Waiting waiting{pager, pages};
    const auto receive = [&](std::uint32_t page) {
      const svm::PageReplyHeader header{PageId{page}};
      pager.receive(
          {nodes::NodeId{page % 4}, svm::number_of(Kind::page_reply), std::as_bytes(std::span(&header, 1)), pages.page(page)},
          waiting);
    };
    for (const std::uint32_t page : {5U, 6U}) {
      CHECK(pager.find(start_of(page)) == nullptr);
      pager.park(0, start_of(page));
      const svm::PageReplyHeader header{PageId{page}};
      pager.install(
          {nodes::NodeId{page % 4}, svm::number_of(Kind::page_reply), std::as_bytes(std::span(&header, 1)), pages.page(page)});
      CHECK(waiting.finds(page));
      pager.retried();
    }
    for (int time = 0; time < 2; ++time) {
      for (const std::uint32_t slot : {0U, 1U}) {
        CHECK(pager.find(start_of(7)) == nullptr);
        pager.park(slot, start_of(7));
      }
      receive(7);
      CHECK(pager.find(start_of(7)) == nullptr);
      CHECK(waiting.finds(5));
      CHECK(waiting.finds(6));
    }
    CHECK(waiting.went_on.size() == 4);
    const svm::PageCounters counters = pager.counters();
    CHECK(counters.evictions == 0);
    CHECK(counters.faults == 4);
    CHECK(counters.misses == 8);
    CHECK(counters.home_hits == 4);
    CHECK(counters.cache_hits == 2 + 4 * 3 - 4 + 4 - 2);
  }
}

TEST_CASE("a request at the wrong home, for a page that does not exist, or a reply of the wrong size is an error") {
  SmallPager small(4, 1, 1);
  CHECK_THROWS_AS(small.pager.serve(parcel_of(1, Kind::page_request, svm::PageRequest{PageId{5}}).packet()), core::InternalError);
  CHECK_THROWS_AS(small.pager.serve(parcel_of(1, Kind::page_request, svm::PageRequest{PageId{page_count}}).packet()),
                  core::InternalError);
  CHECK_THROWS_AS(small.pager.install(parcel_of(1, Kind::page_reply, svm::PageReplyHeader{PageId{5}}).packet()),
                  core::InternalError);
}

TEST_CASE("bytes behind the last home page and the last frame are readable") {
  SmallPager small(4, 1, 1);
  small.pager.park(0, start_of(5));
  small.reply(5);
  std::array<std::byte, core::overread_bytes> beyond;
  for (const std::uint32_t page : {36U, 5U}) {
    const std::byte* bytes = small.pager.find(start_of(page));
    REQUIRE(bytes != nullptr);
    std::memcpy(beyond.data(), bytes + page_size, beyond.size());
  }
}

}  // namespace pager_test
