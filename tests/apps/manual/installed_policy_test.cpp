// Replacement policies of one's own, as who has installed dmpc writes, compiles and loads them.

#include <doctest/doctest.h>

#include <filesystem>
#include <string>

#include "tests/support/shell.h"
#include "tests/support/text.h"
#include "tests/support/trusted_folder.h"

namespace dmpc::tests::installed_policy_test {

namespace {

namespace fs = std::filesystem;

/// Where Python's packages are below a prefix.
fs::path modules_below(const fs::path& prefix) {
  for (const fs::directory_entry& python : fs::directory_iterator(prefix / "lib")) {
    if (fs::exists(python.path() / "dist-packages/dmpc")) {
      return python.path() / "dist-packages";
    }
  }
  return "none";
}

}  // namespace

TEST_CASE(
    "the examples of policies that are installed, one in Python, one compiled with the header alone, fault as dmpc's own clock") {
  const TrustedFolder folder(DMPC_BUILD_DIR);
  const std::string prefix = folder / "prefix", library = folder / "libclock.so", trace = folder / "trace.csv";
  for (const std::string component : {"program", "python", "development"}) {
    const Said installed = run({"cmake", "--install", DMPC_BUILD_DIR, "--component", component, "--prefix", prefix});
    REQUIRE_MESSAGE(installed.status == 0, installed.errors);
  }
  const Said compiled =
      run({"c++", "-std=c++20", "-shared", "-fPIC", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Werror",
           "-I" + prefix + "/include", prefix + "/share/doc/libdmpc-dev/examples/clock_policy.cpp", "-o", library});
  REQUIRE_MESSAGE(compiled.status == 0, compiled.errors);
  std::string lines = "node,page\n";
  for (int i = 0; i < 2000; ++i) {
    lines += std::to_string(i % 3) + "," + std::to_string((i * i / 7 + i % 11) % 23) + "\n";
  }
  write_text(trace, lines);
  const std::string python = "python:" + prefix + "/share/doc/python3-dmpc/clock.py:Clock";
  const Said studied = run({prefix + "/bin/dmpc", "study", "references", trace, "--cache-pages=1,5,11,22", "--format=csv",
                            "--policy=" + python, "--policy=" + library});
  REQUIRE_MESSAGE(studied.status == 0, studied.errors);
  const Said compared = run({"python3", "-c",
                             "import csv, sys\n"
                             "rows = list(csv.DictReader(sys.argv[1].splitlines()))\n"
                             "assert len(rows) == 4, rows\n"
                             "for row in rows:\n"
                             "  assert row['faults clock'] == row['faults Clock'] == row['faults my-clock'] > '', row\n",
                             studied.output});
  CHECK_MESSAGE(compared.status == 0, compared.errors);

  const Said simulated = run({"env", "PYTHONPATH=" + (modules_below(prefix) / "dmpc").string(), "python3", "-c",
                              "import runpy, sys, policies\n"
                              "clock = runpy.run_path(sys.argv[1])['Clock']\n"
                              "print(policies.simulate(clock, [1, 2, 3, 4, 1, 2, 5, 1, 2, 3, 4, 5], 4))\n",
                              prefix + "/share/doc/python3-dmpc/clock.py"});
  CHECK_MESSAGE(simulated.output == "10\n", simulated.errors);
}

TEST_CASE("the calls of the module for Python are what the program says of its options") {
  for (const std::string file : {"calls.py", "study.py", "commas.py"}) {
    CHECK_MESSAGE(file_text(DMPC_BUILD_DIR "/apps/manual/" + file) == file_text(DMPC_SOURCE_DIR "/apps/python/dmpc/" + file),
                  "cp " DMPC_BUILD_DIR "/apps/manual/*.py apps/python/dmpc/");
  }
}

}  // namespace dmpc::tests::installed_policy_test
