// dmpc where memory or threads run out at any call: it ends as it should have, or with a message and status 1 or 4, and leaves no
// part of a file. DMPC_FAILING_CALLS in the environment: how many calls of each command are tried, spread over all;
// tests/failing_calls.
#ifdef DMPC_FAILING_ALLOCATION

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/child_process.h"
#include "tests/support/environment.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests::failing_allocation_test {

namespace {

namespace fs = std::filesystem;

std::size_t tries_of_each() { return tests::number_from_environment("DMPC_FAILING_CALLS", 4); }

/// A line of what tests/failing_allocation/preload.cpp says.
struct FailedCall {
  std::size_t number = 0, calls = 0;
  int status = 0;
};

std::vector<FailedCall> fail_calls(const fs::path& folder, std::size_t first, std::size_t step, std::size_t count,
                                   const std::string& mode, const std::vector<std::string>& arguments) {
  std::vector<std::string> command = {"/usr/bin/env", "LD_PRELOAD=" DMPC_FAILING_ALLOCATION,
                                      "DMPC_FAILURES=" + folder.string() + "," + std::to_string(first) + "," +
                                          std::to_string(step) + "," + std::to_string(count) + "," + mode,
                                      DMPC_PROGRAM};
  command.insert(command.end(), arguments.begin(), arguments.end());
  ChildProcess process(command);
  REQUIRE(process.status() == 0);
  std::istringstream lines(process.output());
  std::vector<FailedCall> failed;
  for (FailedCall call; lines >> call.number >> call.calls >> call.status;) {
    failed.push_back(call);
  }
  REQUIRE(failed.size() == std::max<std::size_t>(count, 1));
  return failed;
}

std::map<std::string, std::string> files_in(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    files[entry.path().filename().string()] = file_text(entry.path());
  }
  return files;
}

/// Files with times in them are whole if they end alike.
bool is_whole(const std::string& name, const std::string& text, const std::string& calm) {
  return name.ends_with(".json") ? !text.empty() && text.ends_with(calm.substr(calm.size() - 4)) : text == calm;
}

/// What a run that ended so has left in its folder.
void check_files(const fs::path& folder, const std::map<std::string, std::string>& calm, bool is_done) {
  const auto files = files_in(folder);
  for (const auto& [name, text] : files) {
    CAPTURE(name);
    REQUIRE(calm.contains(name));
    CHECK(is_whole(name, text, calm.at(name)));
  }
  CHECK((!is_done || files.size() == calm.size()));
}

/// Fails allocations from the first to the last, in `tries` runs.
void check_failures(const std::string& mode, const std::vector<std::string>& arguments, std::size_t tries) {
  CAPTURE(mode);
  CAPTURE(arguments.front());
  const TemporaryFolder calm_folder, folder;
  const FailedCall calm = fail_calls(calm_folder.path(), 0, 1, 0, mode, arguments).front();
  const auto calm_files = files_in(calm_folder / "r0");
  REQUIRE(calm.calls > 0);
  const std::size_t step = std::max<std::size_t>(1, calm.calls / tries);
  const std::size_t count = std::min(tries, calm.calls);
  std::size_t run = 0;
  for (const FailedCall& failed : fail_calls(folder.path(), 1 + (step - 1) / 2, step, count, mode, arguments)) {
    CAPTURE(failed.number);
    const std::string errors = file_text(folder / (std::to_string(run) + ".errors"));
    CAPTURE(errors);
    CHECK((failed.status == calm.status || failed.status == 1 || failed.status == 4));
    CHECK((failed.status == 0 || contains(errors, "dmpc: ")));
    CHECK_FALSE(contains(errors, "bug in dmpc"));
    check_files(folder / ("r" + std::to_string(run)), calm_files, failed.status == 0);
    ++run;
  }
}

const std::vector<std::string> tiny_render = {"render", "tetra-2", "--resolution=8x8", "--nodes=3",           "--quiet",
                                              "-o",     "a.png",   "--stats=a.json",   "--heatmap=rays:h.png"};

}  // namespace

TEST_CASE("wherever memory runs out, dmpc says so and leaves no part of a file") {
  const TemporaryFolder folder;
  write_text(folder / "a.obj", "v 0 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::vector<std::vector<std::string>> commands = {
      {"--help"},
      {"info", "tetra-2"},
      {"scene", "tetra-2", "-o", "a.nff"},
      {"render", "--no-such-option=3"},
      {"render", folder / "a.obj", "--resolution=8x8", "--quiet", "-o", "a.png"},
      {"render", "tetra-2", "--strategy=dataflow", "--nodes=3", "--resolution=8x8", "--quiet", "-o", "a.exr", "--checkpoint=c",
       "--checkpoint-every=0.000001"},
      tiny_render};
  for (const auto& command : commands) {
    check_failures("one", command, tries_of_each());
    check_failures("all", command, tries_of_each());
  }
}

TEST_CASE("where no thread can be started any more, dmpc says so") {
  for (const std::string strategy : {"svm", "dataflow"}) {
    std::vector<std::string> command = tiny_render;
    command.push_back("--strategy=" + strategy);
    check_failures("threads", command, tries_of_each());
  }
}

TEST_CASE("too few threads for the nodes are status 4, with how many there would have to be") {
  const TemporaryFolder folder;
  const FailedCall failed = fail_calls(folder.path(), 4, 1, 1, "threads", tiny_render).front();
  CHECK(failed.status == 4);
  CHECK(contains(file_text(folder / "0.errors"), "a computer of 3 nodes takes 4 threads, and this one lets dmpc start but "));
}

}  // namespace dmpc::tests::failing_allocation_test

#endif
