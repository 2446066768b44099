// A sweep that is killed.
#include <doctest/doctest.h>

#include <csignal>
#include <string>

#include "tests/support/child_process.h"
#include "tests/support/processes.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::tests::sweep_killed_test {

TEST_CASE("a sweep that is killed leaves neither renders nor files that nobody wants to keep") {
  const TemporaryFolder place;
  const std::string picture = place.path() / "dmpc-";
  ChildProcess sweep({"/usr/bin/env", "TMPDIR=" + place.path().string(), DMPC_PROGRAM, "study", "sweep", "balls-4",
                      "--resolution=4096x4096", "--runner=virtual", "--vary=nodes:2,4", "--quiet"});
  const auto renders = [&] { return processes_with("--output=" + picture).size(); };
  CHECK(comes_to([&] { return renders() > 0; }));
  sweep.send(SIGKILL);
  CHECK(sweep.status() == 1000 + SIGKILL);
  CHECK(comes_to([&] { return renders() == 0; }));
  CHECK(comes_to([&] { return place.entry_count() == 0; }));
}

}  // namespace dmpc::tests::sweep_killed_test
