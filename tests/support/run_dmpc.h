// The program dmpc, run to its end.
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "tests/support/shell.h"

namespace dmpc::tests {

/// The words of all, one after the other.
inline std::vector<std::string> together(std::initializer_list<std::vector<std::string>> parts) {
  std::vector<std::string> all;
  for (const std::vector<std::string>& part : parts) {
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

/// `variables`: of its environment, NAME=VALUE.
inline Said run_dmpc(const std::vector<std::string>& arguments, const std::vector<std::string>& variables = {}) {
  return run(together({variables, {DMPC_PROGRAM}, arguments}));
}

}  // namespace dmpc::tests
