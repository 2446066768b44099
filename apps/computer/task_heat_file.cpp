#include "apps/computer/task_heat_file.h"

#include <ostream>
#include <string>

#include "apps/edge/table/table.h"

namespace dmpc::apps {
namespace {

std::string heat_line(const PagedRecord& record, std::size_t task) {
  const svm::TaskTaken& taken = record.heat[task];
  std::string line = std::to_string(task);
  for (const std::uint64_t number : {std::uint64_t{taken.node}, taken.steps, taken.references, taken.faults}) {
    line += "," + std::to_string(number);
  }
  for (Index i = 0; i < record.operations.size(); ++i) {
    line += "," + std::to_string(taken.charges[charge_of(i)]);
  }
  const nodes::Machine* const machine = record.options.program.computer.model();
  return line + "," + (machine == nullptr ? "" : std::to_string(machine->price_ps(taken.charges))) + "\n";
}

}  // namespace

void write_task_heat(const PagedRecord& record, std::ostream& output) {
  output << "task,node,steps,pages.references,pages.faults";
  for (const OperationNeed& operation : record.operations) {
    output << "," << csv_text("operations." + operation.name);
  }
  output << ",computing_ps\n";
  for (std::size_t task = 0; task < record.heat.size(); ++task) {
    output << heat_line(record, task);
  }
}

}  // namespace dmpc::apps
