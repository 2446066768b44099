// What --heat writes.
#include "apps/computer/program_outputs.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/apps/computer/adder.h"

namespace dmpc::tests::task_heat_file_test {

namespace {

/// Cells of a file whose cells need no quotes: its first line, and one for each task.
using HeatLines = std::vector<Lines>;

HeatLines heat_of(const PagedApplication& application, Lines words) {
  const TemporaryFolder folder;
  words.push_back("--heat=" + (folder / "heat.csv").string());
  const Ran done = run_adding(application, words);
  REQUIRE_MESSAGE(done.status == 0, done.errors);
  std::istringstream text(file_text(folder / "heat.csv"));
  HeatLines lines;
  for (std::string line; std::getline(text, line);) {
    Lines& cells = lines.emplace_back();
    std::size_t begin = 0;
    for (std::size_t comma = line.find(','); comma != std::string::npos; comma = line.find(',', begin)) {
      cells.push_back(line.substr(begin, comma - begin));
      begin = comma + 1;
    }
    cells.push_back(line.substr(begin));
  }
  return lines;
}

std::uint64_t sum_of(const HeatLines& lines, std::size_t column) {
  std::uint64_t sum = 0;
  for (std::size_t task = 1; task < lines.size(); ++task) {
    sum += std::stoull(lines[task][column]);
  }
  return sum;
}

}  // namespace

TEST_CASE("each task has a line, and the columns add up to the counters whose names they have") {
  for (const Lines& words :
       std::vector<Lines>{{"--nodes=1"},
                          {"--nodes=4", "--cache-pages=1", "--runner=virtual", "--machine=hdr"},
                          {"--nodes=3", "--cache-pages=2", "--runner=virtual", "--machine=ipsc2", "--in-flight=1"}}) {
    const HeatLines lines = heat_of(adding(), words);
    const nlohmann::json stats = adding_stats(adding(), words);
    REQUIRE(lines.size() == 1 + adders);
    CHECK(lines[0] == Lines{"task", "node", "steps", "pages.references", "pages.faults", "operations.addition", "computing_ps"});
    CHECK(sum_of(lines, 3) == stats["pages"]["references"]);
    CHECK(sum_of(lines, 4) == stats["pages"]["faults"]);
    CHECK(sum_of(lines, 5) == stats["operations"]["addition"]);
    CHECK(lines[1][0] == "0");
    CHECK(lines[50][0] == "49");
    CHECK(lines[50][3] == "20");
    CHECK(lines[50][5] == "20");
  }
}

TEST_CASE("in virtual time the computing of all tasks is that of the nodes, each of which ends at a whole nanosecond") {
  const Lines words = {"--nodes=4", "--cache-pages=2", "--runner=virtual", "--machine=hdr"};
  const std::uint64_t sum_ps = sum_of(heat_of(adding(), words), 6);
  const auto computing_ns = adding_stats(adding(), words)["computing_ns"].get<std::uint64_t>();
  CHECK(sum_ps >= computing_ns * 1000);
  CHECK(sum_ps < (computing_ns + 4) * 1000);
}

TEST_CASE("on threads a task has no time, and its node is that which has its part of the tasks") {
  const HeatLines lines = heat_of(adding(), {"--nodes=2", "--cache-pages=2"});
  CHECK(lines[1].back().empty());
  CHECK(lines[25][1] == "0");
  CHECK(lines[26][1] == "1");
}

TEST_CASE("a task that waits for pages takes more steps") {
  const Lines starved = {"--nodes=2", "--runner=virtual", "--cache-pages=1", "--in-flight=1"};
  const HeatLines lines = heat_of(adding(), starved);
  CHECK(sum_of(lines, 2) == 20 * adders + sum_of(lines, 4));
  CHECK(sum_of(heat_of(adding(), {"--nodes=1"}), 2) == 20 * adders);
}

TEST_CASE("heat is that of the last run") {
  const Lines words = {"--nodes=2", "--runner=virtual", "--cache-pages=2"};
  CHECK(heat_of(adding(3), words) == heat_of(adding(), words));
}

TEST_CASE("an operation's name is quoted where CSV has to quote it") {
  const apps::Vocabulary vocabulary = apps::vocabulary_of_tasks({{"a,\"b\"", 1}});
  const apps::ProgramOptions options;
  apps::ProgramRecord record{.name = "adder", .options = options, .vocabulary = vocabulary};
  record.tasks.heat = {{.node = 3, .steps = 2, .references = 5, .faults = 1}};
  std::ostringstream text;
  apps::write_task_heat(record, text);
  CHECK(text.str() == "task,node,steps,pages.references,pages.faults,\"operations.a,\"\"b\"\"\",computing_ps\n0,3,2,5,1,0,\n");
}

}  // namespace dmpc::tests::task_heat_file_test
