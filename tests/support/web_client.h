// Who asks a server of this computer for something, byte by byte if he likes.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace dmpc::tests {

/// A connection to a port of 127.0.0.1, or of another address.
class WebClient {
 public:
  explicit WebClient(std::uint16_t port, const char* address = "127.0.0.1") : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(port);
    ::inet_pton(AF_INET, address, &to.sin_addr);
    is_connected_ = ::connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof(to)) == 0;
  }
  ~WebClient() { ::close(socket_); }
  WebClient(const WebClient&) = delete;
  WebClient& operator=(const WebClient&) = delete;

  bool is_connected() const { return is_connected_; }

  /// False if the other side takes no more.
  bool send(std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (sent <= 0) {
        return false;
      }
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
    return true;
  }
  void get(const std::string& path, const std::string& host, const std::string& more = "") const {
    send("GET " + path + " HTTP/1.1\r\nHost: " + host + "\r\n" + more + "\r\n");
  }
  /// That is all there is to be said.
  void close_own_side() const { ::shutdown(socket_, SHUT_WR); }

  /// What has come until `words` did, or the end; a minute at most.
  const std::string& heard_until(std::string_view words) {
    while (heard_.find(words) == std::string::npos && hear()) {
    }
    return heard_;
  }
  /// All so far.
  const std::string& heard() const { return heard_; }
  /// Waits for more; false at the end, or after a minute.
  bool hear_more() { return hear(); }
  /// All until the other side ends it, which is_over() then.
  const std::string& heard_all() {
    while (hear()) {
    }
    return heard_;
  }
  bool is_over() const { return is_over_; }

 private:
  bool hear() {
    constexpr int minute_ms = 60'000;
    pollfd polled{.fd = socket_, .events = POLLIN, .revents = 0};
    if (is_over_ || ::poll(&polled, 1, minute_ms) <= 0) {
      return false;
    }
    char buffer[4096];
    const ssize_t count = ::recv(socket_, buffer, sizeof(buffer), 0);
    if (count <= 0) {
      is_over_ = true;
      return false;
    }
    heard_.append(buffer, static_cast<std::size_t>(count));
    return true;
  }

  int socket_;
  bool is_connected_ = false, is_over_ = false;
  std::string heard_;
};

}  // namespace dmpc::tests
