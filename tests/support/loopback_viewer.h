// A program that listens on a port of this computer, as a viewer does, and understands tev's packets in its own way.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <thread>
#include <vector>

#include "core/base/expect.h"

namespace dmpc::tests {

/// Listens at once; with `reads` it takes all that one connection sends until that is closed.
class LoopbackListener {
 public:
  explicit LoopbackListener(bool reads = true) : listener_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof(address);
    auto* const any = reinterpret_cast<sockaddr*>(&address);
    core::expect(::bind(listener_, any, size) == 0 && ::listen(listener_, 1) == 0, "a port can be listened on");
    core::expect(::getsockname(listener_, any, &size) == 0, "a port has a number");
    port_ = ntohs(address.sin_port);
    if (reads) {
      reader_ = std::jthread([this] { read_all(); });
    }
  }
  ~LoopbackListener() {
    ::shutdown(listener_, SHUT_RDWR);  // wakes who waits for a connection
    if (reader_.joinable()) {
      reader_.join();
    }
    ::close(listener_);
  }
  LoopbackListener(const LoopbackListener&) = delete;
  LoopbackListener& operator=(const LoopbackListener&) = delete;

  std::string port() const { return std::to_string(port_); }
  /// All that came. Waits until the sender has closed its end.
  const std::string& received() {
    reader_.join();
    return bytes_;
  }

 private:
  void read_all() {
    const int connection = ::accept(listener_, nullptr, nullptr);
    char part[4096];
    for (ssize_t count = 0; connection >= 0 && (count = ::read(connection, part, sizeof(part))) > 0;) {
      bytes_.append(part, static_cast<std::size_t>(count));
    }
    ::close(connection);
  }

  int listener_;
  std::uint16_t port_ = 0;
  std::string bytes_;
  std::jthread reader_;
};

/// Without a last packet that its sender has not ended, since it went away without a word.
inline std::string whole_packets(const std::string& bytes) {
  std::size_t end = 0;
  for (std::uint32_t length = 0; end + sizeof(length) <= bytes.size(); end += length) {
    std::memcpy(&length, bytes.data() + end, sizeof(length));
    if (length == 0 || end + length > bytes.size()) {
      break;
    }
  }
  return bytes.substr(0, end);
}

/// What a viewer shows after these bytes. A packet that is not as documented is an internal error.
class ShownPicture {
 public:
  explicit ShownPicture(const std::string& bytes) {
    for (std::size_t begin = 0; begin < bytes.size();) {
      std::uint32_t length = 0;
      core::expect(begin + 5 <= bytes.size(), "a packet has a length and an operation");
      std::memcpy(&length, bytes.data() + begin, sizeof(length));
      core::expect(length >= 5 && begin + length <= bytes.size(), "a packet is as long as it says");
      take(bytes.substr(begin + 4, length - 4));
      begin += length;
    }
  }

  std::string name;
  std::int32_t width = 0, height = 0;
  std::vector<float> rgb;
  std::uint32_t packets = 0;

 private:
  void take(const std::string& packet) {
    packet_ = packet;
    place_ = 1;
    ++packets;
    packet_[0] == 4 ? create() : update();
    core::expect(place_ == packet_.size(), "nothing follows what a packet needs");
  }
  void create() {
    core::expect(packets == 1 && number<char>() == 1, "the picture is made first, and shown");
    name = text();
    width = number<std::int32_t>();
    height = number<std::int32_t>();
    take_channels();
    rgb.resize(static_cast<std::size_t>(width * height) * 3);
  }
  void update() {
    core::expect(packet_[0] == 6 && number<char>() == 0 && text() == name, "the picture that was made is changed");
    take_channels();
    const auto left = number<std::int32_t>(), top = number<std::int32_t>();
    const auto columns = number<std::int32_t>(), rows = number<std::int32_t>();
    core::expect(left >= 0 && top >= 0 && columns > 0 && rows > 0 && left + columns <= width && top + rows <= height,
                 "a part of a picture lies in it");
    for (const std::int64_t expected : {0, 1, 2, 3, 3, 3}) {
      core::expect(number<std::int64_t>() == expected, "the channels of a pixel stand side by side");
    }
    for (std::int32_t y = top; y < top + rows; ++y) {
      for (std::int32_t value = 3 * left; value < 3 * (left + columns); ++value) {
        rgb[static_cast<std::size_t>(y * 3 * width + value)] = number<float>();
      }
    }
  }
  void take_channels() {
    core::expect(number<std::int32_t>() == 3 && text() == "R" && text() == "G" && text() == "B", "there are three channels");
  }
  template <class Number>
  Number number() {
    Number value{};
    core::expect(place_ + sizeof(value) <= packet_.size(), "a number is in its packet");
    std::memcpy(&value, packet_.data() + place_, sizeof(value));
    place_ += sizeof(value);
    return value;
  }
  std::string text() {
    const std::size_t end = packet_.find('\0', place_);
    core::expect(end != std::string::npos, "a text ends in its packet");
    const std::string found = packet_.substr(place_, end - place_);
    place_ = end + 1;
    return found;
  }

  std::string packet_;
  std::size_t place_ = 0;
};

}  // namespace dmpc::tests
