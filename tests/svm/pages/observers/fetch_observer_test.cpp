#include "svm/pages/observers/fetch_observer.h"

#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <numeric>

#include "svm/packets.h"

namespace dmpc::svm::fetch_observer_test {

namespace {

constexpr std::uint32_t watched_nodes = 3, watched_pages = 10;

/// Tells a watch what messages there were.
struct WatchedNodes {
  explicit WatchedNodes(std::size_t sample_max = 100'000) : observer(watched_nodes, watched_pages, sample_max) {}

  nodes::Passing passing(std::uint32_t node, std::uint32_t peer, Kind kind, std::uint32_t page,
                         const nodes::MessageTimes& times) {
    words = {page, 0};
    return {.node = nodes::NodeId{node},
            .peer = nodes::NodeId{peer},
            .kind = number_of(kind),
            .payload = std::as_bytes(std::span(words)),
            .times = times};
  }
  void asks(std::uint32_t requester, std::uint32_t page, const nodes::MessageTimes& times = {}) {
    observer.sent(passing(requester, page % watched_nodes, Kind::page_request, page, times));
  }
  void is_asked(std::uint32_t requester, std::uint32_t page, const nodes::MessageTimes& times = {}) {
    observer.received(passing(page % watched_nodes, requester, Kind::page_request, page, times));
  }
  void serves(std::uint32_t requester, std::uint32_t page, const nodes::MessageTimes& times = {}) {
    observer.sent(passing(page % watched_nodes, requester, Kind::page_reply, page, times));
  }
  void takes(std::uint32_t requester, std::uint32_t page, const nodes::MessageTimes& times = {}) {
    observer.received(passing(requester, page % watched_nodes, Kind::page_reply, page, times));
  }
  void fetches(std::uint32_t requester, std::uint32_t page) {
    asks(requester, page);
    is_asked(requester, page);
    serves(requester, page);
    takes(requester, page);
  }

  FetchObserver observer;
  std::array<std::uint32_t, 2> words{};
};

}  // namespace

TEST_CASE("a watch that has seen nothing says so") {
  const Fetches fetches = WatchedNodes().observer.take();
  CHECK(fetches.by_pair == std::vector<std::uint64_t>(9, 0));
  CHECK(fetches.by_page == std::vector<std::uint64_t>(10, 0));
  CHECK(fetches.sample.empty());
  CHECK(fetches.every == 1);
}

TEST_CASE("the parts of a fetch follow each other from the request to the page") {
  WatchedNodes reported;
  reported.asks(0, 7, {.sending_ns = 100, .left_ns = 130});
  reported.is_asked(0, 7, {.links_ns = 5, .arrived_ns = 200, .received_ns = 250});
  reported.serves(0, 7, {.sending_ns = 280, .left_ns = 300});
  reported.takes(0, 7, {.links_ns = 6, .arrived_ns = 410, .received_ns = 500});
  const Fetches fetches = reported.observer.take();
  REQUIRE(fetches.sample.size() == 1);
  const Fetch& fetch = fetches.sample.front();
  CHECK(fetch.requester == 0);
  CHECK(fetch.home == 1);
  CHECK(fetch.page == 7);
  CHECK(fetch.part_ns == std::array<std::uint64_t, 6>{30, 70, 50, 50, 110, 90});
  CHECK(fetch.total_ns() == 500 - 100);
  CHECK(fetch.links_ns == 11);
}

TEST_CASE("where nobody tells when a message arrives, waits are part of its way") {
  WatchedNodes reported;
  reported.asks(0, 7, {.sending_ns = 100, .left_ns = 100});
  reported.is_asked(0, 7, {.received_ns = 250});
  reported.serves(0, 7, {.sending_ns = 300, .left_ns = 300});
  reported.takes(0, 7, {.received_ns = 500});
  CHECK(reported.observer.take().sample.at(0).part_ns == std::array<std::uint64_t, 6>{0, 150, 0, 50, 200, 0});
}

TEST_CASE("fetches under way at a time are told apart") {
  WatchedNodes reported;
  reported.asks(0, 1, {.sending_ns = 10});
  reported.asks(0, 4, {.sending_ns = 20});
  reported.asks(2, 4, {.sending_ns = 15});
  for (const auto& [requester, page] : {std::pair{2U, 4U}, {0U, 1U}, {0U, 4U}}) {
    reported.is_asked(requester, page);
  }
  for (const auto& [requester, page] : {std::pair{0U, 1U}, {2U, 4U}, {0U, 4U}}) {
    reported.serves(requester, page, {.left_ns = 50 + page});
  }
  reported.takes(0, 1, {.received_ns = 110});
  reported.takes(0, 4, {.received_ns = 220});
  reported.takes(2, 4, {.received_ns = 330});
  const Fetches fetches = reported.observer.take();
  REQUIRE(fetches.sample.size() == 3);
  CHECK(fetches.sample[0].part_ns[4] == 110 - 51);
  CHECK(fetches.sample[1].part_ns[4] == 220 - 54);
  CHECK(fetches.sample[2].part_ns[4] == 330 - 54);
}

TEST_CASE("fetches are counted by who asks whom, and by page") {
  WatchedNodes reported;
  for (const auto& [requester, page] : {std::pair{0U, 1U}, {0U, 4U}, {0U, 1U}, {1U, 9U}, {2U, 9U}}) {
    reported.fetches(requester, page);
  }
  const Fetches fetches = reported.observer.take();
  CHECK(fetches.by_pair == std::vector<std::uint64_t>{0, 3, 0, 1, 0, 0, 1, 0, 0});
  CHECK(fetches.by_page == std::vector<std::uint64_t>{0, 2, 0, 0, 1, 0, 0, 0, 0, 2});
}

TEST_CASE("where the host is home, it is the last of those who are asked") {
  FetchObserver observer(2, 5, svm::fetch_sample_max, svm::PageHomes::host);
  const std::uint32_t page = 3;
  const auto passing = [&](std::uint32_t node, std::uint32_t peer, Kind kind) {
    return nodes::Passing{.node = nodes::NodeId{node},
                          .peer = nodes::NodeId{peer},
                          .kind = number_of(kind),
                          .payload = std::as_bytes(std::span(&page, 1)),
                          .times = {}};
  };
  observer.sent(passing(1, 2, Kind::page_request));
  observer.received(passing(2, 1, Kind::page_request));
  observer.sent(passing(2, 1, Kind::page_reply));
  observer.received(passing(1, 2, Kind::page_reply));
  const Fetches fetches = observer.take();
  CHECK(fetches.peer_count == 3);
  CHECK(fetches.by_pair == std::vector<std::uint64_t>{0, 0, 0, 0, 0, 1, 0, 0, 0});
  CHECK(fetches.by_page == std::vector<std::uint64_t>{0, 0, 0, 1, 0});
  REQUIRE(fetches.sample.size() == 1);
  CHECK(fetches.sample[0].home == 2);
  CHECK(fetches.home_of(3) == 2);
}

TEST_CASE("other packets are not looked at") {
  WatchedNodes reported;
  reported.observer.sent(reported.passing(0, 1, Kind::film_sums, 7, {}));
  reported.observer.received(reported.passing(1, 0, Kind::work_request, 7, {}));
  const Fetches fetches = reported.observer.take();
  CHECK(std::accumulate(fetches.by_pair.begin(), fetches.by_pair.end(), std::uint64_t{0}) == 0);
}

TEST_CASE("of many fetches a share is kept, and all are counted") {
  WatchedNodes reported(300);
  for (std::uint32_t i = 0; i < 4000; ++i) {
    reported.fetches(i % 2 == 0 ? 0 : 2, 1);
  }
  const Fetches fetches = reported.observer.take();
  CHECK(fetches.by_page[1] == 4000);
  CHECK(std::has_single_bit(fetches.every));
  CHECK(fetches.every >= 32);
  CHECK(fetches.sample.size() <= 300);
  CHECK(fetches.sample.size() > 20);
}

TEST_CASE("a fetch that did not end is counted, but not shown") {
  WatchedNodes reported;
  reported.asks(0, 1);
  reported.is_asked(0, 1);
  const Fetches fetches = reported.observer.take();
  CHECK(fetches.by_page[1] == 1);
  CHECK(fetches.sample.empty());
}

TEST_CASE("fetches between ranks are those of one watch, at whichever ends they were seen") {
  WatchedNodes together, first, second;
  const auto fetch = [](WatchedNodes& requester, WatchedNodes& home, std::uint32_t node, std::uint32_t page,
                        std::uint64_t time_ns) {
    requester.asks(node, page, {.sending_ns = time_ns, .left_ns = time_ns});
    home.is_asked(node, page, {.received_ns = time_ns + 10});
    home.serves(node, page, {.left_ns = time_ns + 30});
    requester.takes(node, page, {.received_ns = time_ns + 60});
  };
  for (std::uint64_t i = 0; i < 5; ++i) {
    fetch(together, together, 0, 1, 100 * i);  // node 0 is on one rank, nodes 1 and 2 on another
    fetch(together, together, 1, 3, 100 * i);
    fetch(together, together, 2, 7, 100 * i);
    fetch(first, second, 0, 1, 100 * i);
    fetch(second, first, 1, 3, 100 * i);
    fetch(second, second, 2, 7, 100 * i);
  }
  first.observer.add(second.observer.bytes(), {});
  const Fetches expected = together.observer.take(), found = first.observer.take();
  CHECK(found.by_pair == expected.by_pair);
  CHECK(found.by_page == expected.by_page);
  REQUIRE(found.sample.size() == 15);
  for (std::size_t i = 0; i < found.sample.size(); ++i) {
    CHECK(found.sample[i].requester == expected.sample[i].requester);
    CHECK(found.sample[i].home == expected.sample[i].home);
    CHECK(found.sample[i].page == expected.sample[i].page);
    CHECK(found.sample[i].part_ns == expected.sample[i].part_ns);
  }
}

}  // namespace dmpc::svm::fetch_observer_test
