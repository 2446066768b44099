// What tests/support/excerpt keeps of a run's output for a RESULTS.md.

#include <doctest/doctest.h>

#include <fstream>
#include <string>
#include <vector>

#include "tests/support/shell.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::tests::excerpt_test {

namespace {

const std::string printed = R"(**Study of rings, on
  nodes**

| nodes | system | time (s) |
|------:|--------|---------:|
|     1 | svm    |     2.50 |
|    64 | svm    |     0.25 |

| nodes | memory | load |
|------:|-------:|-----:|
|     1 |    512 |  100 |
|    64 |     64 |   50 |

- Load: that of
  the machine.
- Film: 17.
)";

/// What is kept of what was printed.
Said kept(std::vector<std::string> asked) {
  const TemporaryFolder folder;
  const std::string file = folder / "printed";
  std::ofstream(file) << printed;
  asked.insert(asked.begin(), {DMPC_SOURCE_DIR "/tests/support/excerpt", file});
  return run(asked);
}

/// `tests/run` installs it, `tests/run --quick` does without.
bool is_missing() {
  const bool is_there = is_installed("python3");
  WARN_MESSAGE(is_there, "no python3: nothing is tested");
  return !is_there;
}

}  // namespace

TEST_CASE("an excerpt has the columns and rows that are asked for, of parts that are joined again") {
  if (is_missing()) {
    return;
  }
  const Said said = kept({"--table=on nodes", "--columns=nodes;load;time (s)", "--rows=^64 "});
  CHECK(said.status == 0);
  CHECK(said.output ==
        "**Study of rings, on\n  nodes**\n\n| nodes | load | time (s) |\n|---:|---:|---:|\n| 64 | 50 | 0.25 |\n\n");
}

TEST_CASE("an excerpt has the notes that are asked for, whole") {
  if (is_missing()) {
    return;
  }
  CHECK(kept({"--notes=of the machine"}).output == "- Load: that of\n  the machine.\n\n");
}

TEST_CASE("an excerpt has the lines that are asked for as they are") {
  if (is_missing()) {
    return;
  }
  CHECK(kept({"--lines=machine|17"}).output == "```\n  the machine.\n- Film: 17.\n```\n\n");
}

TEST_CASE("an excerpt of what is not there is refused") {
  if (is_missing()) {
    return;
  }
  CHECK(kept({"--table=squares"}).errors == "excerpt: no table below squares\n");
  CHECK(kept({"--table=Study", "--columns=colour"}).errors ==
        "excerpt: no column colour: expected nodes; system; time (s); memory; load\n");
  CHECK(kept({"--table=Study", "--rows=^65 "}).errors == "excerpt: no row has ^65 \n");
  CHECK(kept({"--notes=weather"}).status == 1);
  CHECK(kept({"--lines=weather"}).status == 1);
}

}  // namespace dmpc::tests::excerpt_test
