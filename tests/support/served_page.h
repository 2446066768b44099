// A program that serves a page to browsers of this computer, as nobody's terminal is its stderr.
#pragma once

#include <doctest/doctest.h>
#include <unistd.h>

#include <cstdint>
#include <string>
#include <vector>

#include "tests/support/child_process.h"
#include "tests/support/text.h"
#include "tests/support/web_client.h"

namespace dmpc::tests {

/// Started by its making, which waits until the address is said.
class ServedPage {
 public:
  explicit ServedPage(const std::vector<std::string>& line) : process(line) {
    for (int attempt = 0; attempt < 60'000 && !contains(process.errors(), "/\n"); ++attempt) {
      ::usleep(1000);
    }
    REQUIRE_MESSAGE(contains(process.errors(), "http://"), process.errors());
    const std::string said = process.errors();
    address = said.substr(said.find("http://"), said.find('\n', said.find("http://")) - said.find("http://"));
    host = address.substr(7, address.find('/', 7) - 7);
    port = static_cast<std::uint16_t>(std::stoi(host.substr(host.find(':') + 1)));
  }

  /// Behind the token.
  std::string path(const std::string& place = "") const { return address.substr(7 + host.size()) + place; }
  /// An answer to who asks for this place.
  std::string got(const std::string& place) const {
    WebClient client(port);
    client.get(path(place), host);
    return client.heard_all();
  }
  /// An answer to who sends this there.
  std::string sent(const std::string& place, const std::string& json, const std::string& headers = "") const {
    WebClient client(port);
    client.send("POST " + path(place) + " HTTP/1.1\r\nHost: " + host + "\r\nContent-Type: application/json\r\nContent-Length: " +
                std::to_string(json.size()) + "\r\n" + headers + "\r\n" + json);
    return client.heard_all();
  }

  ChildProcess process;
  std::string address, host;
  std::uint16_t port = 0;
};

}  // namespace dmpc::tests
