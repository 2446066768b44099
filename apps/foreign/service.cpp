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

/// Under the address sanitizer, which takes calls of its own, and address space beyond any limit, nothing is shut in.
Confinement confinement_for([[maybe_unused]] std::uint64_t memory_bytes, [[maybe_unused]] Matter matter) {
#if !defined(__SANITIZE_ADDRESS__)
  if (matter == Matter::foreign) {
    be_first_to_end();
    return enter_sandbox(memory_bytes);
  }
#endif
  return {};
}

void get_ready(Line& line, Matter matter) {
  const bool ends_with_dmpc = tie_to_parent();
  core::use_usual_arithmetic();
  ::dup2(STDOUT_FILENO, STDERR_FILENO);  // what libraries say of a file may be what the file has them say
  const std::optional<Message> message = line.receive(false);
  if (!message || message->saying != Saying::limits) {
    ::_exit(failed_status);
  }
  Confinement confinement = confinement_for(Unpacker(message->bytes).take<std::uint64_t>(), matter);
  confinement.ends_with_dmpc = ends_with_dmpc;
  Packer fields;
  fields.add(protocol);
  for (const bool flag : {confinement.are_calls_filtered, confinement.are_limits_set, confinement.are_files_forbidden,
                          confinement.is_reach_forbidden, confinement.ends_with_dmpc}) {
    fields.add_flag(flag);
  }
  line.send(Saying::ready, fields);
}

/// What a library throws that is no error of ours is its own complaint of the file.
void serve_one(const Message& request, Line& line, const std::function<void(const Message&, Line&)>& serve) {
  try {
    serve(request, line);
  } catch (const std::bad_alloc&) {
    line.send(Saying::out_of_memory);
  } catch (const core::CapacityError& error) {
    line.send(Saying::no_room, Packer().add_text(error.what()));
  } catch (const std::exception& error) {
    line.send(Saying::bad_input, Packer().add_text(error.what()));
  }
}

}  // namespace

void serve_requests(const std::function<void(const Message&, Line&)>& serve, Matter matter) {
  Line line{Descriptor(line_number)};
  try {
    get_ready(line, matter);
    while (const std::optional<Message> request = line.receive(true)) {
      serve_one(*request, line, serve);
    }
  } catch (const HungUp&) {
  }
  ::_exit(0);  // nothing is left to be written, and the libraries' own ends want calls that are gone
}

}  // namespace dmpc::apps
