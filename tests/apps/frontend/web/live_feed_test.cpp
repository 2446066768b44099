#include "apps/frontend/web/live_feed.h"

#include <doctest/doctest.h>

#include <chrono>
#include <string>
#include <thread>
#include <vector>

namespace dmpc::apps::live_feed_test {

namespace {

/// Receives everything, or leaves after a number of words.
class Viewer final : public WebStream {
 public:
  explicit Viewer(std::size_t words_max = 1000) : words_max_(words_max) {}
  bool send(std::string_view bytes) override {
    if (heard.size() == words_max_) {
      return false;
    }
    heard.emplace_back(bytes);
    return true;
  }
  std::vector<std::string> heard;

 private:
  std::size_t words_max_;
};

constexpr std::chrono::milliseconds at_once{0};

}  // namespace

TEST_CASE("who comes late gets the newest of each kind, once") {
  LiveFeed feed(1, 100, at_once);
  feed.put(0, "step", "1");
  feed.put(0, "step", "2");
  feed.put(1, "tile", "a");
  feed.put(3, "tile", "b");
  feed.put(1, "tile", "c");
  feed.close("end", "all");
  Viewer viewer;
  feed.follow(viewer);
  REQUIRE(viewer.heard.size() == 4);
  CHECK(viewer.heard[0] == "event: step\ndata: 2\n\n");
  CHECK((viewer.heard[1] + viewer.heard[2]).find("data: a") == std::string::npos);
  CHECK(viewer.heard[3] == "event: end\ndata: all\n\n");
}

TEST_CASE("a viewer that goes away is left alone, and others hear on") {
  LiveFeed feed(1, 100, at_once);
  feed.put(0, "step", "1");
  feed.put(1, "tile", "a");
  Viewer gone(1);
  feed.follow(gone);
  CHECK(gone.heard.size() == 1);
  feed.close("end", "all");
  Viewer other;
  feed.follow(other);
  CHECK(other.heard.size() == 3);
}

TEST_CASE("a viewer that listens hears what comes, until the feed is closed") {
  LiveFeed feed(1, 2, at_once);
  Viewer viewer;
  std::jthread following([&] { feed.follow(viewer); });
  for (std::size_t place = 0; place < 50; ++place) {
    feed.put(place, "tile", std::to_string(place));
  }
  feed.close("end", "all");
  following.join();
  CHECK(viewer.heard.size() == 51);
}

TEST_CASE("of what is not important a viewer gets so many bytes at a time, each kind in its turn") {
  LiveFeed feed(1, 1, at_once);
  for (std::size_t place = 0; place < 4; ++place) {
    feed.put(place, "tile", std::to_string(place));
  }
  struct Impatient final : WebStream {
    explicit Impatient(LiveFeed& reported_by) : feed(reported_by) {}
    bool send(std::string_view bytes) override {
      heard += bytes.substr(bytes.find("data: ") + 6, 1);
      if (heard.size() < 8) {
        feed.put(1, "tile", "1");  // which is new each time, and keeps no other waiting
      }
      return heard.size() < 8;
    }
    LiveFeed& feed;
    std::string heard;
  } viewer(feed);
  feed.follow(viewer);
  CHECK(viewer.heard == "01231111");
}

TEST_CASE("there are seats for so many, and one that is left is another's") {
  LiveFeed feed(1);
  const auto first = feed.take_seat(2);
  auto second = feed.take_seat(2);
  CHECK((first && second && feed.seats_taken() == 2));
  CHECK(feed.take_seat(2) == nullptr);
  second.reset();
  CHECK(feed.take_seat(2) != nullptr);
  CHECK(feed.seats_taken() == 1);
}

TEST_CASE("only the first end counts, and who comes after it is told all and it") {
  LiveFeed feed(1, 1, at_once);
  feed.put(0, "step", "1");
  feed.put(5, "tile", "a");
  feed.put(6, "tile", "b");
  feed.close("end", "first");
  feed.close("end", "second");
  Viewer viewer;
  feed.follow(viewer);
  REQUIRE(viewer.heard.size() == 4);
  CHECK(viewer.heard.back() == "event: end\ndata: first\n\n");
}

}  // namespace dmpc::apps::live_feed_test
