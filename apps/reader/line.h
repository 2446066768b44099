// One end of the connection between dmpc and a reader process: messages, each with an optional open file.
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
  /// Takes the end of a socket pair that preserves message boundaries.
  explicit Line(Descriptor socket) : socket_(std::move(socket)), buffer_(message_bytes_max + 1, '\0') {}

  int descriptor() const { return socket_.number(); }

  /// Returns whether it was sent: not if the other end is closed or, unless `waits`, its buffer is full. At most
  /// message_bytes_max.
  bool send(Saying saying, std::string_view bytes = {}, int file = -1, bool waits = true);
  bool send(Saying saying, const Packer& fields, int file = -1, bool waits = true) {
    return send(saying, fields.bytes(), file, waits);
  }
  /// Waits for the next message; nothing once the other end is closed. Received files are closed unless `takes_file`.
  std::optional<Message> receive(bool takes_file);

 private:
  Descriptor socket_;
  std::string buffer_;
};

/// Sends as many messages as needed. Returns false if the other end is closed.
bool send_bytes(std::span<const std::byte> bytes, Line& line);

/// Both ends; closed when another program is started. Throws ComputerCapacityError if none can be made.
std::pair<Descriptor, Descriptor> make_ends();

}  // namespace dmpc::apps
