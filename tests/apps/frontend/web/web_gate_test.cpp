#include "apps/frontend/web/web_gate.h"

#include <doctest/doctest.h>

#include <string>

namespace dmpc::apps::web_gate_test {

namespace {

const std::string token(32, 'a');
const WebGate gate(token, 8080);

/// What a browser asks for that was given the address.
WebRequest ours(const std::string& place = "") {
  return {.method = "GET", .path = "/" + token + "/" + place, .host = "127.0.0.1:8080", .origin = "", .fetch_site = "none"};
}

}  // namespace

TEST_CASE("who has the address may look, and is told what stands behind it") {
  CHECK(gate.address() == "http://127.0.0.1:8080/" + token + "/");
  CHECK(gate.refusal(ours()) == 0);
  CHECK(gate.place_of(ours()).empty());
  CHECK(gate.place_of(ours("events")) == "events");
  WebRequest request = ours();
  request.host = "localhost:8080";
  request.origin = "http://localhost:8080";
  request.fetch_site = "same-origin";
  CHECK(gate.refusal(request) == 0);
}

TEST_CASE("who has not the whole token may not") {
  for (const std::string& path : {std::string("/"), std::string(), "/" + token, "/" + token + "x",
                                  "/" + std::string(31, 'a') + "b/", "x" + token + "/", "/" + std::string(31, 'a') + "/"}) {
    WebRequest request = ours();
    request.path = path;
    CHECK_MESSAGE(gate.refusal(request) == 403, path);
  }
}

TEST_CASE("a name that leads here, another page, or another site may not") {
  for (const std::string host : {"", "evil.example:8080", "127.0.0.1", "127.0.0.1:80", "127.0.0.1:8080.evil.example"}) {
    WebRequest request = ours();
    request.host = host;
    CHECK_MESSAGE(gate.refusal(request) == 403, host);
  }
  for (const std::string origin : {"null", "http://evil.example", "https://127.0.0.1:8080", "http://127.0.0.1:8081"}) {
    WebRequest request = ours();
    request.origin = origin;
    CHECK_MESSAGE(gate.refusal(request) == 403, origin);
  }
  for (const std::string site : {"cross-site", "same-site", "x"}) {
    WebRequest request = ours();
    request.fetch_site = site;
    CHECK_MESSAGE(gate.refusal(request) == 403, site);
  }
}

TEST_CASE("JSON may be sent here, and nothing else") {
  WebRequest request = ours();
  request.method = "POST";
  CHECK(gate.refusal(request) == 415);
  request.brings_json = true;
  CHECK(gate.refusal(request) == 0);
  request.origin = "http://evil.example";
  CHECK(gate.refusal(request) == 403);
  request.origin = "";
  for (const char* const method : {"PUT", "HEAD", "OPTIONS", ""}) {
    request.method = method;
    CHECK_MESSAGE(gate.refusal(request) == 405, method);
  }
}

TEST_CASE("each token has 128 bits of its own") {
  CHECK(random_token().size() == 32);
  CHECK(random_token() != random_token());
  CHECK(random_token().find_first_not_of("0123456789abcdef") == std::string::npos);
}

}  // namespace dmpc::apps::web_gate_test
