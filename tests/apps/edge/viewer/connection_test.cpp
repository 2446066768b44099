#include "apps/edge/viewer/connection.h"

#include <doctest/doctest.h>

#include <chrono>
#include <memory>
#include <string>

#include "core/base/expect.h"
#include "tests/support/loopback_viewer.h"

namespace dmpc::apps::viewer_connection_test {

using tests::LoopbackListener;

namespace {

constexpr std::chrono::milliseconds patience{50};

}  // namespace

TEST_CASE("an address is a host and a port") {
  CHECK(parse_viewer_address("127.0.0.1:14158", "--preview").host == "127.0.0.1");
  CHECK(parse_viewer_address("127.0.0.1:14158", "--preview").port == "14158");
  CHECK(parse_viewer_address("[::1]:99", "--preview").host == "::1");
  CHECK(ViewerAddress().port == "14158");
}

TEST_CASE("what is no address is refused") {
  for (const std::string text : {"", "localhost", ":1", "a:", "a:0", "a:65536", "a:1x", "a:-1", "a:999999"}) {
    CAPTURE(text);
    CHECK_THROWS_AS(parse_viewer_address(text, "--preview"), core::UsageError);
  }
}

TEST_CASE("all that is sent arrives") {
  LoopbackListener listener;
  const std::string bytes(3'000'000, 'x');
  {
    ViewerConnection connection({"127.0.0.1", listener.port()}, std::chrono::seconds(20));
    REQUIRE(connection.is_open());
    connection.send(bytes);
    connection.send("end");
    CHECK(connection.is_open());
  }
  CHECK(listener.received() == bytes + "end");
}

TEST_CASE("where nobody listens there is no connection, and sending does nothing") {
  std::string port;
  {
    const LoopbackListener gone(false);
    port = gone.port();
  }
  ViewerConnection connection({"127.0.0.1", port}, patience);
  CHECK_FALSE(connection.is_open());
  CHECK_NOTHROW(connection.send("nothing"));
  CHECK_FALSE(ViewerConnection({"no host of this name.invalid", "1"}, patience).is_open());
}

TEST_CASE("a viewer that takes nothing is left alone after a while") {
  const LoopbackListener listener(false);
  ViewerConnection connection({"127.0.0.1", listener.port()}, patience);
  REQUIRE(connection.is_open());
  connection.send(std::string(30'000'000, 'x'));
  CHECK_FALSE(connection.is_open());
}

TEST_CASE("a viewer that goes away is left alone") {
  auto listener = std::make_unique<LoopbackListener>(false);
  ViewerConnection connection({"127.0.0.1", listener->port()}, patience);
  listener.reset();
  for (int i = 0; i < 100 && connection.is_open(); ++i) {
    connection.send(std::string(100'000, 'x'));
  }
  CHECK_FALSE(connection.is_open());
}

}  // namespace dmpc::apps::viewer_connection_test
