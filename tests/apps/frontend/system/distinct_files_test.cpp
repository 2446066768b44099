#include "apps/frontend/system/distinct_files.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <functional>

#include "core/base/expect.h"
#include "tests/support/complaint.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::apps::distinct_files_test {

namespace {

namespace fs = std::filesystem;

/// Whether an output at `b` may stand beside an output at `a`, and over an input at `a`: the same answer.
bool may_stand_beside(const fs::path& a, const fs::path& b) {
  const auto complaint = tests::complaint_of<core::UsageError, std::function<void()>>;
  const bool beside = complaint([&] { check_distinct({}, {{"-o", a}, {"--stats", b}}); }).empty();
  const bool over = complaint([&] { check_distinct({{"SCENE", a}}, {{"-o", b}}); }).empty();
  core::expect(beside == over, "inputs and outputs are told apart from outputs in the same way");
  return beside;
}

}  // namespace

TEST_CASE("files of different names are distinct, whether they exist or not") {
  const tests::TemporaryFolder folder;
  tests::write_text(folder / "a", "");
  tests::write_text(folder / "b", "");
  CHECK(may_stand_beside(folder / "a", folder / "b"));
  CHECK(may_stand_beside(folder / "a", folder / "new"));
  CHECK(may_stand_beside(folder / "new", folder / "newer"));
  CHECK_NOTHROW(check_distinct({}, {}));
}

TEST_CASE("one file is one file by whatever path, whether it exists or not") {
  const tests::TemporaryFolder folder;
  fs::create_directory(folder / "sub");
  fs::create_directory_symlink(folder / "sub", folder / "link");
  for (const char* name : {"new", "old"}) {
    CAPTURE(name);
    CHECK_FALSE(may_stand_beside(folder / "sub" / name, folder / "sub" / name));
    CHECK_FALSE(may_stand_beside(folder / "sub" / name, folder / "sub/../link/./" / name));
    CHECK_FALSE(may_stand_beside(fs::relative(folder / "sub" / name), folder / "sub" / name));
    tests::write_text(folder / "sub/old", "");
  }
  CHECK_FALSE(may_stand_beside("new", fs::current_path() / "new"));
}

TEST_CASE("a link to a file is that file") {
  const tests::TemporaryFolder folder;
  tests::write_text(folder / "a", "");
  fs::create_symlink("a", folder / "soft");
  fs::create_hard_link(folder / "a", folder / "hard");
  CHECK_FALSE(may_stand_beside(folder / "a", folder / "soft"));
  CHECK_FALSE(may_stand_beside(folder / "a", folder / "hard"));
}

TEST_CASE("devices clash with nothing, and inputs may be equal") {
  CHECK(may_stand_beside("/dev/null", "/dev/null"));
  CHECK_NOTHROW(check_distinct({{"A", "a"}, {"B", "a"}}, {{"--difference", "d"}}));
}

TEST_CASE("the message names both files as the command line does") {
  CHECK_THROWS_WITH_AS(check_distinct({{"SCENE", "a.nff"}}, {{"-o", "b.png"}, {"--stats", "./a.nff"}}),
                       "--stats ./a.nff: this is the same file as SCENE a.nff, give another name", core::UsageError);
}

}  // namespace dmpc::apps::distinct_files_test
