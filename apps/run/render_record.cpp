#include "apps/run/render_record.h"

#include "apps/edge/line/number_text.h"

namespace dmpc::apps {

std::string computer_text(const RenderRecord& record) {
  const RenderOptions& options = record.options;
  const std::string on_machine = options.computer.machine ? " of " + options.computer.machine->name : "";
  return std::string(name_of(options.strategy)) + ", " + counted(options.computer.node_count, "node") + on_machine;
}

}  // namespace dmpc::apps
