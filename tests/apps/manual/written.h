// What the scripts of apps/manual write about a program.
#pragma once

#include <doctest/doctest.h>

#include <string>

#include "apps/frontend/line/description_json.h"
#include "tests/support/shell.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests {

/// The text of "dmpc.1" or "dmpc.bash".
inline std::string written(const apps::CommandDescription& program, const std::string& name) {
  const TemporaryFolder folder;
  write_text(folder / "declared.json", apps::description_json(program, "1"));
  const Said said = run({"python3", "-B", DMPC_SOURCE_DIR "/apps/manual/write.py", folder / "declared.json", folder / "."});
  CHECK_MESSAGE(said.status == 0, said.errors);
  return file_text(folder / name);
}

}  // namespace dmpc::tests
