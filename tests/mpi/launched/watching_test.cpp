// Who looks on at several processes sees all of them, on one clock.
#include <doctest/doctest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/mpi/launched/mpirun.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"
#include "tests/support/trace_events.h"

namespace dmpc::tests::watching_test {

namespace {

using Json = nlohmann::json;

const std::vector<std::string> render = {"render",           "balls-2", "--resolution=32x24", "--nodes=5", "--cache-pages=3",
                                         "--page-size=512B", "--quiet"};

std::vector<std::string> with_outputs(const TemporaryFolder& folder) {
  std::vector<std::string> line = render;
  line.insert(line.end(),
              {"--runner=mpi", "--trace=" + (folder / "trace.pftrace").string(),
               "--heatmap=references:" + (folder / "heat.exr").string(), "--report=" + (folder / "page.html").string(),
               "--stats=" + (folder / "stats.json").string(), "-o", (folder / "a.exr").string()});
  return line;
}

Json json_in(const std::filesystem::path& file) { return Json::parse(file_text(file)); }

std::vector<TraceEvent> events_in(const TemporaryFolder& folder) { return trace_events(file_text(folder / "trace.pftrace")); }

std::uint64_t last_ns(const std::vector<TraceEvent>& events) {
  std::uint64_t last = 0;
  for (const TraceEvent& event : events) {
    last = std::max(last, event.time_ns);
  }
  return last;
}

void check_watched(const TemporaryFolder& folder, std::size_t rank_count) {
  const Json stats = json_in(folder / "stats.json");
  REQUIRE(stats["ranks"].size() == rank_count);
  CHECK(stats["heat_maps"][0]["sum"] == stats["pages"]["references"]);
  CHECK(messages_in_order(events_in(folder)) == stats["packets"]["sent"].get<std::size_t>());
  CHECK(contains(file_text(folder / "page.html"), "</html>"));
}

/// Whether a process may be given a clock of its own here.
bool may_set_clocks() { return run({"/usr/bin/unshare", "--time", "--monotonic", "5000", "--fork", "/bin/true"}).status == 0; }

}  // namespace

TEST_CASE("a trace, heat and a page have the nodes of all processes, over shared memory and TCP") {
  for (const std::string& way : {shared_memory, tcp}) {
    CAPTURE(way);
    const TemporaryFolder folder;
    const Said ended = run(mpirun(3, with_outputs(folder), way));
    REQUIRE_MESSAGE(ended.status == 0, ended.errors);
    check_watched(folder, 3);
  }
}

TEST_CASE("a process whose clock shows another time tells its times by that of rank 0") {
  if (!may_set_clocks()) {
    MESSAGE("skipped: no process may have a clock of its own here (unshare --time)");
    return;
  }
  const TemporaryFolder folder;
  const std::vector<std::string> line = with_outputs(folder);
  std::vector<std::string> command = mpirun(1, line);
  command.insert(command.end(), {":", "-n", "1", "/usr/bin/unshare", "--time", "--monotonic", "5000", "--fork", DMPC_PROGRAM});
  command.insert(command.end(), line.begin(), line.end());
  const Said ended = run(command);
  REQUIRE_MESSAGE(ended.status == 0, ended.errors);
  check_watched(folder, 2);
  CHECK(last_ns(events_in(folder)) < 2'000'000'000'000);
}

}  // namespace dmpc::tests::watching_test
