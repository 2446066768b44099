// A stream of bytes to a program that shows pictures, if one listens.
#pragma once

#include <chrono>
#include <functional>
#include <string_view>

#include "apps/edge/viewer/address.h"

namespace dmpc::apps {

/// Never throws, and never waits for longer than `patience` for a viewer that takes nothing. Not thread-safe.
/// `gives_up` is asked again and again while it sends: once it says so, the connection is closed. May be empty.
class ViewerConnection {
 public:
  /// Connects, if somebody listens.
  ViewerConnection(const ViewerAddress& address, std::chrono::milliseconds patience, std::function<bool()> gives_up = {});
  ~ViewerConnection() { close(); }
  ViewerConnection(const ViewerConnection&) = delete;
  ViewerConnection& operator=(const ViewerConnection&) = delete;

  bool is_open() const { return socket_ >= 0; }
  /// Sends all, or closes: for good, since what follows half a packet would be misunderstood.
  void send(std::string_view bytes);
  /// For good.
  void close();

 private:
  bool connects(int socket, const void* address, std::size_t address_bytes) const;
  bool waits_for_room(int socket) const;
  bool has_given_up() const { return gives_up_ && gives_up_(); }

  std::chrono::milliseconds patience_;
  std::function<bool()> gives_up_;
  int socket_ = -1;
};

}  // namespace dmpc::apps
