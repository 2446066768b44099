// Policies in Python that tests write, or that stand beside them.
#pragma once

#include <string>

#include "tests/support/temporary_folder.h"
#include "tests/support/trusted_folder.h"

namespace dmpc::tests {

/// Of <name>.py beside this file, whose lines some tests count.
inline std::string policy_source(const std::string& name) {
  return file_text(std::string(DMPC_SOURCE_DIR "/tests/apps/policy/") + name + ".py");
}

/// Where nobody else may write.
struct PolicyFile {
  TrustedFolder folder{DMPC_BUILD_DIR};
  std::string file = folder / "policy.py";

  explicit PolicyFile(const std::string& source) { write_text(file, source); }
  std::string place(const std::string& name = "Mine") const { return "python:" + file + ":" + name; }
};

}  // namespace dmpc::tests
