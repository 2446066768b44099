// What a server bears. No sentence asserts a time: what is to end is waited for, for a minute at most.
#include "apps/frontend/web/web_server.h"

#include <doctest/doctest.h>

#include <atomic>
#include <cerrno>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/text.h"
#include "tests/support/web_client.h"

namespace dmpc::apps::web_server_test {

namespace {

using tests::contains;
using tests::repeated;
using tests::WebClient;

/// Answers "/" and unknown paths by "here", "/large" by a page of 8 MB, and "/stream" by letters without end.
class SmallServer {
 public:
  explicit SmallServer(std::size_t threads = 4) {
    server_ = web_library().listen({.threads = threads, .answer = [this](const WebRequest& request) { return answer(request); }});
    REQUIRE(server_);
  }
  std::uint16_t port() const { return server_->port(); }
  std::string host() const { return "127.0.0.1:" + std::to_string(port()); }
  std::size_t asked() const { return asked_; }
  std::size_t streams_ended() const { return streams_ended_; }
  void end() { server_.reset(); }

  /// All that is answered.
  std::string got(const std::string& path, const std::string& headers = "") const {
    WebClient client(port());
    client.get(path, host(), headers);
    return client.heard_all();
  }

 private:
  WebAnswer answer(const WebRequest& request) {
    ++asked_;
    if (request.path == "/large") {
      return {.body = std::string(std::size_t{8} << 20U, 'x')};
    }
    if (request.path != "/stream") {
      return {.body = "here"};
    }
    return {.body = "", .stream = [this](WebStream& viewer) {
              const std::string letters(100'000, 'y');
              while (viewer.send(letters)) {
                ::usleep(10'000);
              }
              ++streams_ended_;
            }};
  }

  std::atomic<std::size_t> asked_ = 0, streams_ended_ = 0;
  std::unique_ptr<WebServer> server_;  ///< ends first
};

bool is_answered(const SmallServer& server) { return contains(server.got("/"), "\r\n\r\nhere"); }

/// Until it is so.
template <class Condition>
void wait_for(const Condition& condition) {
  for (int attempt = 0; attempt < 6000 && !condition(); ++attempt) {
    ::usleep(10'000);
  }
  CHECK(condition());
}

}  // namespace

TEST_CASE("a server answers at its port of 127.0.0.1, and at no other address") {
  const SmallServer server;
  CHECK(is_answered(server));
  CHECK_FALSE(WebClient(server.port(), "127.0.0.2").is_connected());
}

TEST_CASE("a port that somebody has is not had twice, and is free when he ends") {
  SmallServer server;
  const WebOptions same{.port = server.port(), .threads = 1, .answer = [](const WebRequest&) { return WebAnswer(); }};
  CHECK(web_library().listen(same) == nullptr);
  CHECK(errno == EADDRINUSE);
  server.end();
  CHECK(web_library().listen(same) != nullptr);
}

TEST_CASE("a page is given whole, as it is, whatever parts or packing are asked for") {
  const SmallServer server;
  const std::string answer = server.got("/", "Range: bytes=0-0,0-0,1-2\r\nAccept-Encoding: br, gzip\r\n");
  CHECK(contains(answer, "200 OK"));
  CHECK(contains(answer, "\r\n\r\nhere"));
  CHECK_FALSE(contains(answer, "Content-Encoding"));
  CHECK_FALSE(contains(answer, "Content-Range"));
}

TEST_CASE("who says nothing, or a letter now and then, is left alone, and others are answered meanwhile") {
  const SmallServer server(3);
  WebClient silent(server.port()), slow(server.port());
  std::jthread letters([&] {
    while (slow.send("G")) {
      ::usleep(100'000);
    }
  });
  CHECK(is_answered(server));
  silent.heard_all();
  letters.join();
  CHECK(silent.is_over());
  CHECK(server.asked() == 1);
}

TEST_CASE("who takes nothing is dropped, and who listens hears on") {
  SmallServer server;
  WebClient deaf(server.port()), other(server.port());
  deaf.get("/stream", server.host());
  other.get("/stream", server.host());
  std::jthread hearing([&] { other.heard_all(); });
  wait_for([&] { return server.streams_ended() == 1; });
  CHECK(is_answered(server));
  server.end();
  hearing.join();
  CHECK(server.streams_ended() == 2);
}

TEST_CASE("an answer that has begun is finished where the server ends") {
  SmallServer server;
  WebClient client(server.port());
  client.get("/large", server.host());
  client.heard_until("xxx");
  std::jthread hearing([&] { client.heard_all(); });
  server.end();
  hearing.join();
  CHECK(contains(client.heard_all(), std::string(std::size_t{8} << 20U, 'x')));
}

TEST_CASE("who comes where all threads are held and as many wait is told to come later") {
  SmallServer server(1);
  WebClient first(server.port());
  first.get("/stream", server.host());
  first.heard_until("yyy");  // so it has the thread before the next one comes
  const WebClient second(server.port());
  std::jthread hearing([&] { first.heard_all(); });
  wait_for([&] { return contains(server.got("/"), "503 Service Unavailable"); });
  server.end();
}

TEST_CASE("a request that is too long is cut off before anybody sees it") {
  const SmallServer server;
  for (const std::string& endless :
       {"GET /" + std::string(40'000, 'a'), "GET / HTTP/1.1\r\nHost: " + std::string(40'000, 'a') + "\r\n\r\n",
        "GET / HTTP/1.1\r\n" + repeated(10, "a: " + std::string(4000, 'b') + "\r\n") + "\r\n"}) {
    WebClient client(server.port());
    client.send(endless);
    client.heard_all();
    CHECK(client.is_over());
  }
  CHECK(server.asked() == 0);
  CHECK(is_answered(server));
}

TEST_CASE("bytes that are no request, and parts of requests, do no harm") {
  const SmallServer server(8);
  std::mt19937 random(20261127);
  const std::string model =
      "GET / HTTP/1.1\r\nHost: 127.0.0.1\r\nRange: bytes=0-99999999999999999999\r\nContent-Length: 9\r\n"
      "Expect: 100-continue\r\nTransfer-Encoding: chunked\r\nContent-Type: multipart/form-data\r\n\r\n";
  for (int i = 0; i < 400; ++i) {
    std::string bytes = model.substr(0, random() % (model.size() + 1));
    for (std::size_t changes = random() % 8; changes > 0 && !bytes.empty(); --changes) {
      bytes[random() % bytes.size()] = static_cast<char>(random());
    }
    if (i % 4 == 0) {
      bytes.assign(random() % 3000, '\0');
      for (char& letter : bytes) {
        letter = static_cast<char>(random());
      }
    }
    WebClient client(server.port());
    client.send(bytes);
    client.close_own_side();
    client.heard_all();
    CHECK(client.is_over());
  }
  for (const std::string& header :
       {"Range: bytes=" + repeated(1900, "0-0,") + "0-0", "Range: bytes=" + std::string(8000, '9') + "-",
        "Content-Length: " + std::string(8000, '9'), std::string("Content-Length: -1"), repeated(4000, "a: b\r\n") + "c: d",
        "Host: " + std::string(8000, '%'), "Content-Type: multipart/form-data; boundary=" + std::string(8000, '-')}) {
    WebClient client(server.port());
    client.get("/", server.host(), header + "\r\n");
    client.close_own_side();
    client.heard_all();
    CHECK(client.is_over());
  }
  CHECK(is_answered(server));
}

}  // namespace dmpc::apps::web_server_test
