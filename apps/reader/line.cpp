#include "apps/reader/line.h"

#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "apps/frontend/system/resource_exhaustion.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

/// Room for one descriptor beside a message.
struct alignas(cmsghdr) Control {
  std::array<char, CMSG_SPACE(sizeof(int))> bytes{};
};

void attach(msghdr& header, Control& control, int file) {
  header.msg_control = control.bytes.data();
  header.msg_controllen = control.bytes.size();
  cmsghdr* const part = CMSG_FIRSTHDR(&header);
  part->cmsg_level = SOL_SOCKET;
  part->cmsg_type = SCM_RIGHTS;
  part->cmsg_len = CMSG_LEN(sizeof(int));
  std::memcpy(CMSG_DATA(part), &file, sizeof(int));
}

Descriptor attached(msghdr& header) {
  const cmsghdr* const part = CMSG_FIRSTHDR(&header);
  if (part == nullptr || part->cmsg_level != SOL_SOCKET || part->cmsg_type != SCM_RIGHTS) {
    return Descriptor();
  }
  int file = -1;
  std::memcpy(&file, CMSG_DATA(part), sizeof(int));
  return Descriptor(file);
}

}  // namespace

bool Line::send(Saying saying, std::string_view bytes, int file, bool waits) {
  core::expect(bytes.size() <= message_bytes_max, "a message is not too long");
  std::array<iovec, 2> parts{{{&saying, 1}, {const_cast<char*>(bytes.data()), bytes.size()}}};
  msghdr header{};
  header.msg_iov = parts.data();
  header.msg_iovlen = parts.size();
  Control control;
  if (file >= 0) {
    attach(header, control, file);
  }
  ssize_t sent = 0;
  do {
    sent = ::sendmsg(socket_.number(), &header, MSG_NOSIGNAL | (waits ? 0 : MSG_DONTWAIT));
  } while (sent < 0 && errno == EINTR);
  return sent >= 0;
}

std::optional<Message> Line::receive(bool takes_file) {
  iovec part{buffer_.data(), buffer_.size()};
  msghdr header{};
  header.msg_iov = &part;
  header.msg_iovlen = 1;
  Control control;
  if (takes_file) {
    header.msg_control = control.bytes.data();
    header.msg_controllen = control.bytes.size();
  }
  ssize_t count = 0;
  do {
    count = ::recvmsg(socket_.number(), &header, MSG_CMSG_CLOEXEC);
  } while (count < 0 && errno == EINTR);
  if (count < 1) {
    return std::nullopt;
  }
  Message message;
  message.file = takes_file ? attached(header) : Descriptor();
  Unpacker::require((header.msg_flags & MSG_TRUNC) == 0 &&
                    static_cast<std::uint8_t>(buffer_[0]) <= static_cast<std::uint8_t>(Saying::left_to_another));
  message.saying = static_cast<Saying>(buffer_[0]);
  message.bytes.assign(buffer_, 1, static_cast<std::size_t>(count) - 1);
  return message;
}

bool send_bytes(std::span<const std::byte> bytes, Line& line) {
  for (std::size_t first = 0; first < bytes.size(); first += message_bytes_max) {
    const auto part = bytes.subspan(first, std::min(message_bytes_max, bytes.size() - first));
    if (!line.send(Saying::bytes, {reinterpret_cast<const char*>(part.data()), part.size()})) {
      return false;
    }
  }
  return true;
}

std::pair<Descriptor, Descriptor> make_ends() {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    const int error = errno;
    const std::string what = "no line to a process that reads files can be made";
    throw_if_short(error, what);
    throw core::InternalError(what + ": " + std::strerror(error));
  }
  return {Descriptor(ends[0]), Descriptor(ends[1])};
}

}  // namespace dmpc::apps
