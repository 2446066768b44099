#include "apps/lab/study/render_process.h"

#include <csignal>
#include <string_view>

#include "apps/edge/line/exit_status.h"
#include "core/base/expect.h"

namespace dmpc::apps {

std::string sentence_of(std::string complaint) {
  constexpr std::string_view program = "dmpc: ";
  if (complaint.starts_with(program)) {
    complaint.erase(0, program.size());
  }
  complaint.erase(complaint.find_last_not_of(" \n.") + 1);
  return complaint.empty() ? "It did not say why" : complaint;
}

std::optional<std::string> misfit_of(const WatchedProcess& process) {
  if (process.status == 0) {
    return std::nullopt;
  }
  if (process.status == -SIGKILL) {
    return "It was killed, as a computer without memory to spare does";
  }
  if (process.status == no_room_status) {
    return sentence_of(process.complaint);
  }
  if (process.status == input_status) {
    throw core::InputError(sentence_of(process.complaint));
  }
  throw core::InternalError("a render ended with status " + std::to_string(process.status) + ": " +
                            sentence_of(process.complaint));
}

}  // namespace dmpc::apps
