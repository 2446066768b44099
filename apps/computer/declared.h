// Validates the declarations of programs: unique names, maximum numbers, prices. Formats such names for display.
#pragma once

#include <algorithm>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "apps/computer/dmpc/computer.h"
#include "core/base/expect.h"

namespace dmpc::apps {

/// Quotes a name, so that it differs from all built-in columns.
inline std::string own_name(const std::string& name) { return "'" + name + "'"; }

/// Throws core::UsageError for a need without a unique name on one line. `what` names the needs, in the plural.
template <class Need>
void check_different(const std::vector<Need>& needs, const std::string& what) {
  std::set<std::string> names;
  for (const Need& need : needs) {
    if (need.name.empty() || !names.insert(need.name).second) {
      throw core::UsageError("two " + what + " are called '" + need.name + "', or one has no name: give each its own");
    }
    if (std::any_of(need.name.begin(), need.name.end(), [](unsigned char letter) { return letter < ' ' || letter == 0x7f; })) {
      throw core::UsageError("one of the " + what + " has a name with a control character: expected one line of text");
    }
  }
}

/// Throws core::UsageError for more than `most`, the maximum of `program`.
void check_count(std::size_t count, std::size_t most, const std::string& what, const std::string& program = "a program");

/// Applies both checks to operations, and refuses prices above a millisecond.
void check_operations(const std::vector<OperationNeed>& operations, std::size_t most, const std::string& program = "a program");

}  // namespace dmpc::apps
