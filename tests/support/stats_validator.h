// Files of counters held against stats.schema.json by Debian's python3-jsonschema.
#pragma once

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "apps/show/stats/schema.h"
#include "tests/support/shell.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::tests {

/// Says so where it is not there.
inline bool has_validator() {
  const bool is_there = run({"/usr/bin/python3", "-c", "import jsonschema"}).status == 0;
  if (!is_there) {
    MESSAGE("skipped: python3-jsonschema is not installed, which tests/run does");
  }
  return is_there;
}

/// What is wrong with the counters in these files; empty if nothing is.
inline std::string faults_by_schema(const std::vector<std::string>& files) {
  const TemporaryFolder folder;
  write_text(folder / "stats.schema.json", apps::stats_schema());
  std::vector<std::string> command = {"/usr/bin/python3", "-W", "ignore", "-m", "jsonschema"};
  for (const std::string& file : files) {
    command.insert(command.end(), {"-i", file});
  }
  command.emplace_back(folder / "stats.schema.json");
  const Said said = run(command);
  return said.status == 0 ? "" : said.output + said.errors + "status " + std::to_string(said.status);
}

}  // namespace dmpc::tests
