// A name that looks like a place for a file until it is written: in the place of a disk that fills up while a command runs.
#pragma once

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "core/base/expect.h"

namespace dmpc::tests {

/// Makes a socket at `path`, in folders made for it: nobody asks it beforehand, and it cannot be opened as a file.
inline void make_unwritable(const std::filesystem::path& path) {
  std::filesystem::create_directories(path.parent_path());
  sockaddr_un name{};
  name.sun_family = AF_UNIX;
  const std::string text = path.string();
  core::expect(text.size() < sizeof name.sun_path, "a socket has a short name");
  text.copy(name.sun_path, text.size());
  const int socket = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const bool is_made = ::bind(socket, reinterpret_cast<const sockaddr*>(&name), sizeof name) == 0;
  ::close(socket);
  core::expect(is_made, "a socket can be made");
}

}  // namespace dmpc::tests
