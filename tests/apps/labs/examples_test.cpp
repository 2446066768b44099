// Counters of programs of one's own, of messages and of tasks, as stats.schema.json says.

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/stats_validator.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests::examples_test {

namespace {

/// The counters of an example in this file.
void keep_stats(const std::string& example, const std::string& file, std::vector<std::string> words) {
  words.insert(words.begin(), DMPC_EXAMPLES "/" + example);
  words.push_back("--stats=" + file);
  const Said said = run(words);
  CHECK_MESSAGE(said.status == 0, said.errors);
}

}  // namespace

TEST_CASE("the schema knows the counters of programs of one's own, of messages and of tasks, on threads and machines") {
  if (!has_validator()) {
    return;
  }
  const TemporaryFolder folder;
  std::vector<std::string> files;
  for (const char* example : {"passing_ring", "ranked_pages"}) {
    for (const char* runner : {"--runner=threads", "--runner=virtual"}) {
      files.push_back(folder / (std::to_string(files.size()) + ".json"));
      keep_stats(example, files.back(), {"--nodes=4", runner});
    }
  }
  CHECK(faults_by_schema(files) == "");
  for (const std::string& file : files) {
    nlohmann::json json = nlohmann::json::parse(file_text(file));
    json["per_node"][1]["unknown"] = 1;
    write_text(folder / "changed.json", json.dump());
    CHECK(faults_by_schema({folder / "changed.json"}) != "");
  }
}

}  // namespace dmpc::tests::examples_test
