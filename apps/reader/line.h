// One end of the line between dmpc and a process that reads for it: messages, perhaps with an open file.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "apps/frontend/system/descriptor.h"
#include "apps/reader/packing.h"
#include "apps/reader/saying.h"

namespace dmpc::apps {

struct Message {
  Saying saying{};
  std::string bytes;
  Descriptor file;
};

/// Not thread-safe.
class Line {
 public:
  /// Takes the end of a socket pair that keeps messages apart.
  explicit Line(Descriptor socket) : socket_(std::move(socket)), buffer_(message_bytes_max + 1, '\0') {}

  int descriptor() const { return socket_.number(); }

  /// Returns whether it was sent: not if the other end is closed or, unless `waits`, takes nothing now. At most
  /// message_bytes_max.
  bool send(Saying saying, std::string_view bytes = {}, int file = -1, bool waits = true);
  bool send(Saying saying, const Packer& fields, int file = -1, bool waits = true) {
    return send(saying, fields.bytes(), file, waits);
  }
  /// Waits for the next one; nothing once the other end is closed. Files that come are closed unless `takes_file`.
  std::optional<Message> receive(bool takes_file);

 private:
  Descriptor socket_;
  std::string buffer_;
};

/// In as many messages as they take. Returns whether they were sent: not if the other end is closed.
bool send_bytes(std::span<const std::byte> bytes, Line& line);

/// Both ends; closed when another program is started. Throws ComputerCapacityError if none can be had.
std::pair<Descriptor, Descriptor> make_ends();

}  // namespace dmpc::apps
