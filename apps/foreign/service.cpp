#include "apps/foreign/service.h"

#include <unistd.h>

#include <exception>
#include <new>
#include <optional>

#include "apps/foreign/asked_files.h"
#include "apps/foreign/sandbox.h"
#include "core/base/expect.h"
#include "core/base/usual_arithmetic.h"

namespace dmpc::apps {
namespace {

/// Where dmpc leaves the line.
constexpr int line_number = 3;
constexpr int failed_status = 70;

void get_ready(Line& line) {
  tie_to_parent();
  core::use_usual_arithmetic();
  ::dup2(STDOUT_FILENO, STDERR_FILENO);  // what libraries say of a file may be what the file has them say
  const std::optional<Message> message = line.receive(false);
  if (!message || message->saying != Saying::limits) {
    ::_exit(failed_status);
  }
#if defined(__SANITIZE_ADDRESS__)  // which takes calls of its own, and address space beyond any limit
  const bool is_filtered = false;
#else
  const bool is_filtered = enter_sandbox(Unpacker(message->bytes).take<std::uint64_t>());
#endif
  line.send(Saying::ready, Packer().add(protocol).add(static_cast<std::uint8_t>(is_filtered)));
}

/// What a library throws that is no error of ours is its own complaint of the file.
void serve_one(const Message& request, Line& line, const std::function<void(const Message&, Line&)>& serve) {
  try {
    serve(request, line);
  } catch (const std::bad_alloc&) {
    line.send(Saying::out_of_memory);
  } catch (const core::RoomError& error) {
    line.send(Saying::no_room, Packer().add_text(error.what()));
  } catch (const std::exception& error) {
    line.send(Saying::bad_input, Packer().add_text(error.what()));
  }
}

}  // namespace

void serve_requests(const std::function<void(const Message&, Line&)>& serve) {
  Line line{Descriptor(line_number)};
  try {
    get_ready(line);
    while (const std::optional<Message> request = line.receive(true)) {
      serve_one(*request, line, serve);
    }
  } catch (const HungUp&) {
  }
  ::_exit(0);  // nothing is left to be written, and the libraries' own ends want calls that are gone
}

}  // namespace dmpc::apps
