#include "svm/plan.h"

#include <doctest/doctest.h>

#include <array>
#include <string>

#include "core/base/expect.h"
#include "core/base/units.h"
#include "core/picture/memory_use.h"
#include "nodes/ranks/rank_links.h"
#include "nodes/size_text.h"
#include "svm/forest/strategy.h"
#include "tests/support/complaint.h"
#include "tests/support/loopback_ranks.h"

namespace svm_plan_test {

using namespace dmpc;
using core::operator""_KiB;
using core::operator""_MiB;
using svm::make_plan;
using svm::PlanRequest;

namespace {

PlanRequest request_with(std::uint32_t nodes, std::uint32_t pages) {
  return {.page_count = pages, .computer = {.node_count = nodes}, .width = 64, .height = 64};
}

std::string error_of(const PlanRequest& request) {
  return tests::complaint_of([&] { make_plan(request); });
}

}  // namespace

TEST_CASE(
    "without a memory bound the cache takes a quarter of the database, at least 64 pages, at most all that are not at home") {
  CHECK(make_plan(request_with(8, 4000)).frames == 1000);
  CHECK(make_plan(request_with(8, 100)).frames == 64);
  CHECK(make_plan(request_with(8, 40)).frames == 35);
  CHECK(make_plan(request_with(1, 4000)).frames == 0);
}

TEST_CASE("in-flight is 16 for svm and 1 for replicated unless it is given") {
  PlanRequest request = request_with(4, 100);
  CHECK(make_plan(request).in_flight == 16);
  request.pages.in_flight = 3;
  CHECK(make_plan(request).in_flight == 3);
  request.strategy = svm::replicated_strategy();
  CHECK(make_plan(request).in_flight == 3);
  request.pages.in_flight.reset();
  CHECK(make_plan(request).in_flight == 1);
}

TEST_CASE(
    "where rays walk in bundles 64 pixels are in flight, replicated 16, whole bundles of what is given, or less than one, "
    "alone") {
  PlanRequest request = request_with(4, 100);
  request.bundles = true;
  const auto check_plan = [&](std::uint32_t in_flight, std::uint32_t pixels_a_task, std::uint32_t item_side) {
    const svm::Plan plan = make_plan(request);
    CHECK(plan.in_flight == in_flight);
    CHECK(plan.pixels_a_task == pixels_a_task);
    CHECK(plan.task_count() * pixels_a_task == in_flight);
    CHECK(plan.work_item_side == item_side);
    return plan;
  };
  CHECK(check_plan(64, 16, 4).notes.empty());
  request.pages.in_flight = 47;
  REQUIRE(check_plan(32, 16, 4).notes.size() == 1);
  CHECK(make_plan(request).notes[0] == "in-flight reduced from 47 to 32 pixels: whole bundles of 16");
  request.pages.in_flight = 15;
  check_plan(15, 1, 3);
  request.pages.work_item_side = 7;
  check_plan(15, 1, 7);
  request.pages = {};
  request.strategy = svm::replicated_strategy();
  check_plan(16, 16, 4);
  request.bundles = false;
  check_plan(1, 1, 3);
}

TEST_CASE("over ranks 256 pixels are in flight where memory is not bounded, of strategies whose pages travel") {
  nodes::Loopback loopback(1);
  nodes::RankLinks links(loopback.rank(0));
  PlanRequest request = request_with(4, 100);
  request.bundles = true;
  request.computer.ranks = &links;
  CHECK(make_plan(request).in_flight == 256);
  request.pages.in_flight = 32;
  CHECK(make_plan(request).in_flight == 32);
  request.pages.in_flight.reset();
  request.computer.node_memory_bytes = 100_MiB;
  CHECK(make_plan(request).in_flight == 64);
  request.computer.node_memory_bytes.reset();
  request.strategy = svm::replicated_strategy();
  CHECK(make_plan(request).in_flight == 16);
}

TEST_CASE("with too little memory for its bundles a node has fewer, and at last its rays walk alone") {
  PlanRequest request = request_with(8, 10000);
  request.bundles = true;
  const std::size_t least = svm::smallest_node_memory_bytes(request);
  std::uint32_t before = 0;
  for (std::size_t more = 0; more < 300_KiB; more += 10_KiB) {
    request.computer.node_memory_bytes = least + more;
    const svm::Plan plan = make_plan(request);
    CHECK(plan.node_memory_max_bytes() <= least + more);
    CHECK(plan.pixels_a_task == (plan.in_flight < 16 ? 1 : 16));
    CHECK(plan.in_flight >= before);
    before = plan.in_flight;
  }
  CHECK(before == 64);
}

TEST_CASE("with a memory bound the cache takes all that is left, and not a page more fits") {
  for (const std::size_t page_size : {512U, 1024U, 4096U}) {
    PlanRequest request = request_with(8, 20000);
    request.page_size_bytes = page_size;
    request.computer.node_memory_bytes = 16_MiB;
    const svm::Plan plan = make_plan(request);
    CHECK(plan.node_memory_max_bytes() <= 16_MiB);
    svm::Plan larger = plan;
    ++larger.frames;
    CHECK((larger.node_memory_max_bytes() > 16_MiB || plan.frames == 17500));
  }
}

TEST_CASE("the cache never takes more than all pages that are not at home") {
  PlanRequest request = request_with(3, 100);
  request.computer.node_memory_bytes = 16_MiB;
  CHECK(make_plan(request).frames == 67);
  CHECK(make_plan(request).notes.empty());
}

TEST_CASE("the smallest memory that is named works, and one byte less does not") {
  for (const svm::Strategy* const strategy : {svm::svm_strategy(), svm::replicated_strategy()}) {
    for (const std::uint32_t nodes : {1U, 2U, 7U, 64U}) {
      PlanRequest request = request_with(nodes, 3000);
      request.strategy = strategy;
      const std::size_t smallest = svm::smallest_node_memory_bytes(request);
      request.computer.node_memory_bytes = smallest;
      const svm::Plan plan = make_plan(request);
      CHECK(plan.node_memory_max_bytes() == smallest);
      CHECK(plan.in_flight == 1);
      request.computer.node_memory_bytes = smallest - 1;
      const std::string error = error_of(request);
      INFO(error);
      CHECK(error.find("node_memory_bytes=" + nodes::size_text(smallest)) != std::string::npos);
    }
  }
}

TEST_CASE("a memory that is too small names the smallest node count that works with it") {
  PlanRequest request = request_with(2, 10000);
  request.computer.node_memory_bytes = 2_MiB;
  const std::string error = error_of(request);
  const std::size_t at = error.find("with this memory node_count=");
  REQUIRE(at != std::string::npos);
  request.computer.node_count =
      static_cast<std::uint32_t>(std::stoul(error.substr(at + std::string("with this memory node_count=").size())));
  CHECK(request.computer.node_count > 2);
  CHECK(error_of(request).empty());
  --request.computer.node_count;
  CHECK_FALSE(error_of(request).empty());
}

TEST_CASE("where the mailboxes of many nodes are what is too large, fewer nodes are named") {
  PlanRequest request = request_with(4096, 1338);
  request.computer.node_memory_bytes = 600_KiB;
  const std::string error = error_of(request);
  const std::size_t at = error.find("node_count=", error.find("or with this memory"));
  REQUIRE(at != std::string::npos);
  request.computer.node_count = static_cast<std::uint32_t>(std::stoul(error.substr(at + std::string("node_count=").size())));
  CHECK(request.computer.node_count < 4096);
  CHECK(make_plan(request).frames > 0);
  --request.computer.node_count;
  CHECK(!error_of(request).empty());
}

TEST_CASE("where no number of nodes helps, the message says so") {
  PlanRequest request = request_with(2, 10000);
  request.computer.node_memory_bytes = 100_KiB;
  CHECK(error_of(request).find("no number of nodes") != std::string::npos);
  request.strategy = svm::replicated_strategy();
  CHECK(error_of(request).find("strategy=svm") != std::string::npos);
}

TEST_CASE("in-flight is reduced to leave each pixel a frame, and that is noted") {
  PlanRequest request = request_with(8, 10000);
  request.computer.node_memory_bytes = svm::smallest_node_memory_bytes(request) + 20_KiB;
  request.pages.in_flight = 64;
  const svm::Plan plan = make_plan(request);
  CHECK(plan.in_flight > 1);
  CHECK(plan.in_flight < 64);
  CHECK(plan.frames >= plan.in_flight);
  REQUIRE(plan.notes.size() == 1);
  CHECK(plan.notes[0] == "in-flight reduced from 64 to " + std::to_string(plan.in_flight) + " to fit " +
                             nodes::size_text(*request.computer.node_memory_bytes));
}

TEST_CASE("a cache that was asked for is kept, or refused if it does not fit") {
  PlanRequest request = request_with(8, 10000);
  request.pages.cache_pages = 1;
  request.pages.in_flight = 64;
  request.computer.node_memory_bytes = 4_MiB;
  CHECK(make_plan(request).frames == 1);
  CHECK(make_plan(request).in_flight == 64);
  request.pages.cache_pages = 5000;
  CHECK(error_of(request).find("node_memory_bytes=4MiB is too small") != std::string::npos);
}

TEST_CASE("a cache larger than all pages that are not at home is reduced, and that is noted") {
  PlanRequest request = request_with(2, 10);
  request.pages.cache_pages = 50;
  const svm::Plan plan = make_plan(request);
  CHECK(plan.frames == 5);
  CHECK(plan.notes.size() == 1);
}

TEST_CASE("home pages differ by one page between nodes, and node 0 takes the most") {
  const svm::Plan plan = make_plan(request_with(3, 100));
  const auto home_bytes = [&](std::uint32_t node) { return plan.node_memory(node)[core::MemoryUse::home_pages]; };
  CHECK(home_bytes(0) == home_bytes(1) + 1024);
  CHECK(home_bytes(1) == home_bytes(2));
  CHECK(plan.node_memory_max_bytes() == plan.node_memory(0).total());
}

TEST_CASE("a mailbox has room for everything that may be under way to it") {
  PlanRequest request = request_with(5, 100);
  request.pages.in_flight = 3;
  const svm::Plan plan = make_plan(request);
  CHECK(plan.request_credits == 3);
  CHECK(plan.film_credits == 128);
  CHECK(plan.node_mailbox.small_slots == 4 * 3 + 4 + 1 + 128 + 1);
  CHECK(plan.node_mailbox.bulk_slots == 3);
  CHECK(plan.node_mailbox.bulk_payload_bytes == 1024 + 8);
  CHECK(plan.host_mailbox.small_slots == 5);
  CHECK(plan.host_mailbox.bulk_slots == 5 * 128);
  CHECK(plan.host_mailbox.bulk_payload_bytes <= 4096);
}

TEST_CASE("film credits are few where nodes are many, and on a modelled machine, and fewer packets wait at a node") {
  PlanRequest request = request_with(1, 100);
  for (const auto& [nodes, credits] : {std::pair{1U, 128U}, {16U, 64U}, {64U, 16U}, {4096U, 4U}}) {
    request.computer.node_count = nodes;
    const svm::Plan plan = make_plan(request);
    CHECK(plan.film_credits == credits);
    CHECK(plan.batching().packets == credits * 3 / 4);
    CHECK(plan.batching().kinds == 1U << number_of(svm::Kind::film_sums));
  }
  request.computer.machine = nodes::Machine();
  CHECK(make_plan(request).film_credits == 2);
  CHECK(make_plan(request).batching().packets == 1);
}

TEST_CASE("no node plans for more pixels in flight than it ever has") {
  PlanRequest request = request_with(4, 5000);
  request.pages.in_flight = 4096;
  request.width = 7;
  request.height = 3;
  const svm::Plan plan = make_plan(request);
  CHECK(plan.in_flight == 21);
  CHECK(plan.node_mailbox.bulk_slots == 21);
  REQUIRE(plan.notes.size() == 1);
  CHECK(plan.notes[0] == "in-flight reduced from 4096 to 21 pixels: no node ever has more");
  request.pages.work_item_side = 0;
  CHECK(make_plan(request).in_flight == 6);
  request.strategy = svm::replicated_strategy();
  CHECK(make_plan(request).in_flight == 6);
  request.width = request.height = 1;
  CHECK(make_plan(request).in_flight == 1);
  CHECK(make_plan(request).notes.at(0) == "in-flight reduced from 4096 to 1 pixel: no node ever has more");
  request.pages.in_flight.reset();
  CHECK(make_plan(request).notes.empty());
}

TEST_CASE("a node has no more faults than pages that live elsewhere, nor requests to a home than it has pages") {
  PlanRequest request = request_with(4, 10);
  request.pages.in_flight = 64;
  const svm::Plan plan = make_plan(request);
  CHECK(plan.in_flight == 64);
  CHECK(plan.faults_max() == 8);
  CHECK(plan.node_mailbox.bulk_slots == 8);
  CHECK(plan.request_credits == 3);
  request.page_count = 3;
  CHECK(make_plan(request).faults_max() == 3);
  CHECK(make_plan(request).request_credits == 1);
  request.computer.node_count = 1;
  CHECK(make_plan(request).faults_max() == 0);
}

TEST_CASE("two pixels take room for two replies, however many were asked for") {
  PlanRequest request = request_with(8, 5000);
  request.page_size_bytes = 64_KiB;
  request.pages.cache_pages = 1;
  request.width = 2;
  request.height = 1;
  request.pages.in_flight = 2;
  const nodes::MemoryPlan two = make_plan(request).node_memory(0);
  request.pages.in_flight = svm::in_flight_max;
  const nodes::MemoryPlan many = make_plan(request).node_memory(0);
  CHECK(many.total() == two.total());
  CHECK(many[nodes::Category::mailbox] < 3 * (64_KiB + 64) + 16_KiB);
}

TEST_CASE("a node of replicated keeps no room for pages of others") {
  PlanRequest request = request_with(5, 100);
  request.strategy = svm::replicated_strategy();
  const svm::Plan plan = make_plan(request);
  CHECK(plan.node_mailbox.bulk_slots == 0);
  CHECK(plan.frames == 0);
  CHECK(plan.node_memory(0)[core::MemoryUse::cache_frames] == 0);
  CHECK(plan.node_memory(4)[core::MemoryUse::home_pages] >= 100 * 1024);
}

TEST_CASE("request credits shrink as the nodes grow in number, but each home keeps one") {
  CHECK(make_plan(request_with(2, 100)).request_credits == 4);
  CHECK(make_plan(request_with(65, 1000)).request_credits == 4);
  CHECK(make_plan(request_with(129, 1000)).request_credits == 2);
  CHECK(make_plan(request_with(4096, 100)).request_credits == 1);
}

TEST_CASE("values out of range and wrong combinations are wrong use") {
  const auto is_wrong = [](const auto& change) {
    PlanRequest request = request_with(4, 100);
    change(request);
    CHECK_THROWS_AS(make_plan(request), core::UsageError);
  };
  is_wrong([](PlanRequest& request) { request.page_size_bytes = 1000; });
  is_wrong([](PlanRequest& request) { request.computer.node_count = 0; });
  is_wrong([](PlanRequest& request) { request.computer.node_count = nodes::node_count_max + 1; });
  is_wrong([](PlanRequest& request) { request.pages.in_flight = 0; });
  is_wrong([](PlanRequest& request) { request.pages.in_flight = svm::in_flight_max + 1; });
  is_wrong([](PlanRequest& request) { request.pages.cache_pages = 0; });
  is_wrong([](PlanRequest& request) {
    request.strategy = svm::replicated_strategy();
    request.pages.cache_pages = 3;
  });
}

TEST_CASE("a replacement policy needs a cache") {
  PlanRequest request = request_with(4, 100);
  request.pages.replacement = svm::Replacement::clock;
  CHECK(make_plan(request).pages().cache.replacement == svm::Replacement::clock);
  request.strategy = svm::replicated_strategy();
  CHECK_THROWS_AS(make_plan(request), core::UsageError);
}

TEST_CASE("a policy that needs no memory of its own leaves it to the cache") {
  PlanRequest request = request_with(4, 2000);
  const std::size_t lru = make_plan(request).node_memory_max_bytes();
  request.pages.replacement = svm::Replacement::fifo;
  CHECK(make_plan(request).node_memory_max_bytes() < lru);
}

TEST_CASE("page references are recorded only where they depend on neither cache nor schedule") {
  PlanRequest right = request_with(4, 100);
  right.pages.record_references = true;
  right.pages.work_item_side = 0;
  right.pages.in_flight = 1;
  CHECK_NOTHROW(make_plan(right));
  std::array<PlanRequest, 5> wrong;
  wrong.fill(right);
  wrong[0].pages.work_item_side = 3;
  wrong[1].pages.in_flight = 2;
  wrong[2].pages.in_flight.reset();
  wrong[3].strategy = svm::replicated_strategy();
  wrong[4].pages.count_pages = true;
  for (const PlanRequest& request : wrong) {
    CHECK_THROWS_AS(make_plan(request), core::UsageError);
  }
}

TEST_CASE("a host that assigns the work has a place for each worker's request, and nodes have none for each other's") {
  svm::PlanRequest request{.page_count = 4, .computer = {.node_count = 4}, .pages = {.worker_count = 3}, .width = 8, .height = 8};
  const svm::Plan ring = make_plan(request);
  request.pages.work_donor = svm::WorkDonor::host;
  const svm::Plan assigned = make_plan(request);
  CHECK(assigned.host_mailbox.small_slots == ring.host_mailbox.small_slots + 3);
  CHECK(assigned.node_mailbox.small_slots == ring.node_mailbox.small_slots - 3);
  request.pages.work_item_side = 0;
  CHECK_THROWS_AS(make_plan(request), core::UsageError);
}

TEST_CASE("pixels are interleaved where they are the nodes' own, not where the host assigns them") {
  svm::PlanRequest request{.page_count = 4,
                           .computer = {.node_count = 4},
                           .pages = {.in_flight = 4096, .work_item_side = 0, .pixel_shares = svm::PixelShares::interleaved},
                           .width = 9,
                           .height = 9};
  CHECK(make_plan(request).in_flight == 25);  // of five columns in five rows, the largest share
  request.pages.work_item_side = 3;
  CHECK(make_plan(request).in_flight == 81);
  request.pages.work_donor = svm::WorkDonor::host;
  CHECK_THROWS_WITH_AS(make_plan(request),
                       "pixel_shares=interleaved does not go with work_donor=host: where the host assigns items, no pixel is a "
                       "node's own",
                       core::UsageError);
}

TEST_CASE("where the host is home, a node has nothing of the scene but its cache, and the host has all") {
  PlanRequest request = request_with(4, 400);
  request.pages.cache_pages = 7;
  const svm::Plan spread = make_plan(request);
  request.pages.homes = svm::PageHomes::host;
  const svm::Plan host = make_plan(request);
  CHECK(host.faults_max() == spread.faults_max());
  const std::size_t page_bytes = request.page_size_bytes;
  CHECK(host.node_memory(0)[core::MemoryUse::home_pages] + 100 * page_bytes ==
        spread.node_memory(0)[core::MemoryUse::home_pages]);
  CHECK(host.node_memory(0)[core::MemoryUse::cache_frames] == spread.node_memory(0)[core::MemoryUse::cache_frames]);
  CHECK(host.host_memory()[core::MemoryUse::home_pages] == spread.node_memory(0)[core::MemoryUse::home_pages] + 300 * page_bytes);
  CHECK(host.node_mailbox.small_slots == spread.node_mailbox.small_slots - 3 * spread.request_credits);
  CHECK(host.host_mailbox.small_slots == spread.host_mailbox.small_slots + 4 * host.request_credits);
}

TEST_CASE("where the host is home, the least memory does not grow with the scene, and more nodes do not make it less") {
  PlanRequest request = request_with(4, 400);
  request.pages.homes = svm::PageHomes::host;
  const std::size_t least = smallest_node_memory_bytes(request);
  request.page_count = 400'000;
  CHECK(smallest_node_memory_bytes(request) < least + least / 10);
  request.computer.node_memory_bytes = smallest_node_memory_bytes(request);
  CHECK(make_plan(request).frames >= 1);
  request.computer.node_memory_bytes = *request.computer.node_memory_bytes - 1;
  CHECK_THROWS_AS(make_plan(request), core::CapacityError);
}

TEST_CASE("where the host is home, one node fetches pages, too, and a cache may hold all of them") {
  PlanRequest request = request_with(1, 40);
  request.pages.homes = svm::PageHomes::host;
  request.pages.cache_pages = 1000;
  const svm::Plan plan = make_plan(request);
  CHECK(plan.frames == 40);
  CHECK(plan.request_credits >= 1);
}

TEST_CASE("in a tree a node has room for the requests of all nodes below the first, beside what one of a star has") {
  PlanRequest request = request_with(64, 400);
  request.pages.cache_pages = 20;
  request.pages.homes = svm::PageHomes::host;
  const svm::Plan star = make_plan(request);
  request.pages.homes = svm::PageHomes::tree;
  constexpr std::uint32_t below = 37;
  const svm::Plan tree = make_plan(request);
  CHECK(tree.request_credits >= 1);
  CHECK(tree.node_mailbox.small_slots == star.node_mailbox.small_slots + below * tree.request_credits);
  CHECK(tree.host_mailbox.small_slots + 64 * (star.request_credits - tree.request_credits) == star.host_mailbox.small_slots);
  request.computer.node_memory_bytes = smallest_node_memory_bytes(request);
  CHECK(make_plan(request).frames == 20);
}

TEST_CASE("resident pages are a share of the frames, and one frame at least is left for others") {
  PlanRequest request = request_with(4, 400);
  request.pages.cache_pages = 40;
  for (const auto& [percent, resident] : {std::pair{0U, 0U}, {1U, 0U}, {50U, 20U}, {99U, 39U}, {100U, 39U}}) {
    request.pages.resident_percent = percent;
    const svm::Plan plan = make_plan(request);
    CHECK(plan.resident_count == resident);
    CHECK(plan.frames == 40 - resident);
  }
  request.pages.cache_pages = 1;
  CHECK(make_plan(request).resident_count == 0);
  request.computer.node_count = 1;
  CHECK(make_plan(request).resident_count == 0);
  CHECK(make_plan(request).frames == 0);
  request.pages.resident_percent = 101;
  CHECK_THROWS_AS(make_plan(request), core::UsageError);
  request.pages.resident_percent = 50;
  request.pages.cache_pages.reset();
  request.strategy = svm::replicated_strategy();
  CHECK_THROWS_AS(make_plan(request), core::UsageError);
}

TEST_CASE("pages are at home at the host where they travel alone") {
  PlanRequest request = request_with(4, 40);
  request.pages.homes = svm::PageHomes::host;
  request.strategy = svm::replicated_strategy();
  CHECK_THROWS_AS(make_plan(request), core::UsageError);
  request.strategy = svm::forest_strategy();
  CHECK_THROWS_AS(make_plan(request), core::UsageError);
}

TEST_CASE("of forest a quarter of a node's share of the picture is in flight, 16 pixels at least and 256 at most") {
  const auto in_flight = [](std::uint32_t side, std::uint32_t node_count) {
    PlanRequest request{.strategy = svm::forest_strategy(), .page_count = 40, .computer = {.node_count = node_count}};
    request.width = request.height = side;
    request.forest_page_count = 4;
    return make_plan(request).in_flight;
  };
  CHECK(in_flight(512, 4) == 256);
  CHECK(in_flight(128, 64) == 64);
  CHECK(in_flight(8, 4) == 16);
  CHECK(in_flight(2, 1) == 4);  // all that there are
}

TEST_CASE("at least one node renders, and no more than there are") {
  svm::PlanRequest request{.page_count = 4, .computer = {.node_count = 4}, .width = 8, .height = 8};
  CHECK(make_plan(request).worker_count == 4);
  for (const std::uint32_t workers : {1U, 3U, 4U}) {
    request.pages.worker_count = workers;
    CHECK(make_plan(request).worker_count == workers);
  }
  for (const std::uint32_t workers : {0U, 5U}) {
    request.pages.worker_count = workers;
    CHECK_THROWS_AS(make_plan(request), core::UsageError);
  }
}

}  // namespace svm_plan_test
