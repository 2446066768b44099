#include "apps/computer/task_heat_file.h"

#include <ostream>
#include <string>

#include "apps/edge/table/table.h"

namespace dmpc::apps {
namespace {

std::string heat_line(const ProgramRecord& record, std::size_t task) {
  const svm::TaskTaken& taken = record.tasks.heat[task];
  std::string line = std::to_string(task);
  for (const std::uint64_t number : {std::uint64_t{taken.node}, taken.steps, taken.references, taken.faults}) {
    line += "," + std::to_string(number);
  }
  for (const NamedOperation& operation : record.vocabulary.operations) {
    line += "," + std::to_string(taken.charges.count[operation.charge]);
  }
  const nodes::Machine* const machine = record.options.computer.model();
  return line + "," + (machine == nullptr ? "" : std::to_string(machine->price_ps(taken.charges))) + "\n";
}

}  // namespace

void write_task_heat(const ProgramRecord& record, std::ostream& output) {
  output << "task,node,steps,pages.references,pages.faults";
  for (const NamedOperation& operation : record.vocabulary.operations) {
    output << "," << csv_text("operations." + operation.name);
  }
  output << ",computing_ps\n";
  for (std::size_t task = 0; task < record.tasks.heat.size(); ++task) {
    output << heat_line(record, task);
  }
}

}  // namespace dmpc::apps
