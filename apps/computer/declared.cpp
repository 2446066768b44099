#include "apps/computer/declared.h"

#include "apps/frontend/line/number_text.h"

namespace dmpc::apps {

void check_count(std::size_t count, std::size_t most, const std::string& what, const std::string& program) {
  if (count > most) {
    throw core::UsageError(std::to_string(count) + " " + what + " are declared: " + program + " has at most " +
                           std::to_string(most));
  }
}

void check_operations(const std::vector<OperationNeed>& operations, std::size_t most, const std::string& program) {
  check_count(operations.size(), most, "operations", program);
  check_different(operations, "operations");
  for (const OperationNeed& operation : operations) {
    if (!(operation.nanoseconds >= 0 && operation.nanoseconds <= 1e6)) {
      throw core::UsageError("the operation '" + operation.name + "' takes " + shortest(operation.nanoseconds) +
                             " ns: expected 0 to 1,000,000");
    }
  }
}

}  // namespace dmpc::apps
