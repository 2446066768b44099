// What browsers are given while a picture comes, and in the end. Here each viewer is a connection that the test reads from.
#include "apps/render/live_view.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/text.h"
#include "tests/support/web_client.h"

namespace dmpc::apps::live_view_test {

namespace {

using tests::contains;
using tests::WebClient;

/// A live view of a picture of 100x70 pixels that two nodes and a test make.
struct SmallView {
  SmallView() { view->begin(head, nullptr); }

  std::string host() const { return view->address().substr(7, view->address().find('/', 7) - 7); }
  std::uint16_t port() const { return static_cast<std::uint16_t>(std::stoi(host().substr(host().find(':') + 1))); }
  /// With the token.
  std::string path(const std::string& place = "") const { return view->address().substr(7 + host().size()) + place; }
  std::string got(const std::string& place, const std::string& headers = "") const {
    WebClient client(port());
    client.get(path(place), host(), headers);
    return client.heard_all();
  }
  std::unique_ptr<WebClient> viewer() const {
    auto client = std::make_unique<WebClient>(port());
    client->get(path("events"), host());
    return client;
  }
  void light(std::uint32_t pixel) {
    core::PixelSums sums;
    sums.plane[0] = core::to_fixed({1, 1, 1});
    film.deposit(pixel, sums);
    view->watch(film, pass, pixel);
  }

  const LiveHead head{.width = 100, .height = 70, .node_count = 2};
  std::unique_ptr<LiveView> view = std::make_unique<LiveView>(0, "dmpc render <small>", [] {});
  core::Film film{100, 70};
  core::Refinement pass{{}, 1, 100, 70};
};

/// Body of an HTTP answer.
std::string body_of(const std::string& answer) { return answer.substr(answer.find("\r\n\r\n") + 4); }

}  // namespace

TEST_CASE("the page is at its address alone, with a policy, for nobody else's frames, to be kept by nobody") {
  const SmallView small;
  const std::string page = small.got("");
  CHECK(contains(page, "200 OK"));
  CHECK(contains(page, "dmpc render &lt;small&gt;"));
  for (const std::string header :
       {"Content-Security-Policy: default-src 'none'", "connect-src 'self'; frame-ancestors 'none'", "Cache-Control: no-store",
        "Referrer-Policy: no-referrer", "X-Content-Type-Options: nosniff", "Cross-Origin-Resource-Policy: same-origin"}) {
    CHECK_MESSAGE(contains(page, header), header);
  }
  CHECK_FALSE(contains(page, "Access-Control"));
  CHECK(contains(small.got("other"), "404 Not Found"));
  CHECK(contains(small.got("../../etc/passwd"), "404 Not Found"));
  CHECK(contains(small.got("events/"), "404 Not Found"));
}

TEST_CASE("who has not the address, or comes from elsewhere, is told nothing") {
  const SmallView small;
  for (const std::string& path : {std::string("/"), std::string("/events"), "/" + std::string(32, '0') + "/"}) {
    WebClient client(small.port());
    client.get(path, small.host());
    CHECK(contains(client.heard_all(), "403 Forbidden"));
  }
  WebClient rebound(small.port());
  rebound.get(small.path(), "evil.example:" + std::to_string(small.port()));
  CHECK(contains(rebound.heard_all(), "403 Forbidden"));
  CHECK(contains(small.got("events", "Origin: http://evil.example\r\n"), "403 Forbidden"));
  CHECK(contains(small.got("", "Sec-Fetch-Site: cross-site\r\n"), "403 Forbidden"));
  WebClient sender(small.port());
  sender.send("POST " + small.path() + " HTTP/1.1\r\nHost: " + small.host() +
              "\r\nContent-Type: application/json\r\nContent-Length: 2\r\n\r\n{}");
  CHECK(contains(sender.heard_all(), "405 Method Not Allowed"));
  CHECK_FALSE(small.view->has_had_visitors());
}

TEST_CASE("a viewer is told of the picture, its tiles, and how far it is, and one that comes late of all so far") {
  SmallView small;
  const auto first = small.viewer();
  CHECK(contains(first->heard_until("\"steps\""), "event: head\ndata: {"));
  small.view->say("It comes.");
  small.view->update(64, 7000);
  first->heard_until("It comes.");
  for (std::uint32_t pixel = 0; pixel < 64; ++pixel) {
    small.light(pixel);
  }
  first->heard_until("event: tile");
  first->heard_until("event: step");
  const auto late = small.viewer();
  for (const std::string event : {"event: head", "event: tile", "event: step", "event: state"}) {
    CHECK_MESSAGE(contains(late->heard_until(event), event), event);
  }
  CHECK(contains(late->heard_until("\"done\":64"), "\"total\":7000"));
}

TEST_CASE("in the end viewers are told to ask for the page, which is there for who comes later, too") {
  SmallView small;
  const auto viewer = small.viewer();
  viewer->heard_until("event: head");
  small.view->show(small.film);
  std::string asked_for;
  std::jthread asking([&] {
    viewer->heard_all();
    asked_for = body_of(small.got(""));
  });
  small.view->end({.said = "All is done.", .page = "<!DOCTYPE html>the last"});
  asking.join();
  CHECK(contains(viewer->heard_all(), "event: end\ndata: {\"figures\":\"\",\"page\":true,\"said\":\"All is done.\"}"));
  CHECK(asked_for == "<!DOCTYPE html>the last");
  CHECK(tests::count(viewer->heard_all(), "event: tile") == 4);
  CHECK(body_of(small.got("")) == "<!DOCTYPE html>the last");
  CHECK(small.view->complaint().empty());
}

TEST_CASE("where there is no page in the end, viewers have the last of the picture, then why") {
  SmallView small;
  const auto viewer = small.viewer();
  viewer->heard_until("event: head");
  small.view->show(small.film);
  small.view->end({.said = "It was \"stopped\".", .figures = "rays 7\n"});
  const std::string& heard = viewer->heard_all();
  CHECK(contains(heard, R"(event: end)"
                        "\n"
                        R"(data: {"figures":"rays 7\n","page":false,"said":"It was \"stopped\"."})"));
  CHECK(heard.rfind("event: tile") < heard.find("event: end"));
  CHECK(contains(small.got(""), "dmpc render &lt;small&gt;"));
  CHECK(contains(small.viewer()->heard_all(), "event: end"));
}

TEST_CASE("whoever looks on when all goes away is told that it is the end") {
  SmallView small;
  const auto viewer = small.viewer();
  viewer->heard_until("event: head");
  small.view.reset();
  CHECK(contains(viewer->heard_all(), "dmpc has ended before its picture was done."));
}

TEST_CASE("the next picture on the same nodes begins with nothing counted, and says its number") {
  SmallView small;
  const auto viewer = small.viewer();
  viewer->heard_until("event: step");
  LiveHead next = small.head;
  next.frame = 2;
  small.view->begin(next, nullptr);
  CHECK(contains(viewer->heard_until("\"frame\":2"), "\"frame\":0"));
  small.light(0);
  small.view->show(small.film);
  CHECK(contains(viewer->heard_until("event: tile"), "event: tile"));
}

TEST_CASE("where it is not shown what nodes do nobody looks on at them, and the picture comes") {
  LiveView view(0, "", [] {});
  view.begin({.width = 100, .height = 70}, nullptr);
  CHECK(view.observer() == nullptr);
  view.begin({.width = 100, .height = 70, .frame = 2}, nullptr);
  view.end({.said = "All is done."});
}

TEST_CASE("as many look on as there are places, ten of them deaf, and who comes then is told so until one goes") {
  SmallView small;
  std::vector<std::unique_ptr<WebClient>> viewers;
  for (std::size_t i = 0; i < PageServer::viewers_max; ++i) {
    viewers.push_back(small.viewer());
    if (i >= 10) {
      viewers.back()->heard_until("event: state");
    }
  }
  CHECK(contains(small.got("events"), "503 Service Unavailable"));
  CHECK(contains(small.got("events"), "48 viewers are connected already"));
  CHECK(contains(small.got(""), "200 OK"));
  viewers.resize(20);  // 28 go away, which is detected when an event is sent to them
  bool is_let_in = false;
  for (int attempt = 0; attempt < 3000 && !is_let_in; ++attempt) {
    ::usleep(10'000);
    const auto viewer = small.viewer();
    is_let_in = contains(viewer->heard_until("event: "), "event: ");
  }
  CHECK(is_let_in);
}

}  // namespace dmpc::apps::live_view_test
