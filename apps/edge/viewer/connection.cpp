#include "apps/edge/viewer/connection.h"

#include <fcntl.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <memory>
#include <utility>

#include "core/base/expect.h"

namespace dmpc::apps {

namespace {

/// While it waits it asks so often whether to give up.
constexpr std::chrono::milliseconds look_interval{50};

using Addresses = std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)>;

Addresses addresses_of(const ViewerAddress& address) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (::getaddrinfo(address.host.c_str(), address.port.c_str(), &hints, &found) != 0) {
    found = nullptr;
  }
  return {found, &::freeaddrinfo};
}

}  // namespace

ViewerConnection::ViewerConnection(const ViewerAddress& address, std::chrono::milliseconds patience,
                                   std::function<bool()> gives_up)
    : patience_(patience), gives_up_(std::move(gives_up)) {
  const Addresses addresses = addresses_of(address);
  for (const addrinfo* at = addresses.get(); at != nullptr && socket_ < 0; at = at->ai_next) {
    const int socket = ::socket(at->ai_family, at->ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, at->ai_protocol);
    if (socket >= 0 && connects(socket, at->ai_addr, at->ai_addrlen)) {
      socket_ = socket;
    } else if (socket >= 0) {
      ::close(socket);
    }
  }
}

bool ViewerConnection::connects(int socket, const void* address, std::size_t address_bytes) const {
  if (::connect(socket, static_cast<const sockaddr*>(address), static_cast<socklen_t>(address_bytes)) == 0) {
    return true;
  }
  int error = 0;
  socklen_t size = sizeof(error);
  return errno == EINPROGRESS && waits_for_room(socket) && ::getsockopt(socket, SOL_SOCKET, SO_ERROR, &error, &size) == 0 &&
         error == 0;
}

bool ViewerConnection::waits_for_room(int socket) const {
  pollfd watched{.fd = socket, .events = POLLOUT, .revents = 0};
  int ready = 0;
  for (std::chrono::milliseconds left = patience_; ready == 0 && left.count() > 0 && !has_given_up(); left -= look_interval) {
    ready = ::poll(&watched, 1, static_cast<int>(std::min(left, look_interval).count()));
  }
  return ready == 1 && (watched.revents & (POLLERR | POLLHUP)) == 0;
}

void ViewerConnection::send(std::string_view bytes) {
  while (is_open() && !bytes.empty()) {
    if (has_given_up()) {
      return close();
    }
    const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent > 0) {
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    } else if (errno != EINTR && !((errno == EAGAIN || errno == EWOULDBLOCK) && waits_for_room(socket_))) {
      close();
    }
  }
}

void ViewerConnection::close() {
  if (is_open()) {
    ::close(socket_);
    socket_ = -1;
  }
}

}  // namespace dmpc::apps
