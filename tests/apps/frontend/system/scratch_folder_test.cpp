#include "apps/frontend/system/scratch_folder.h"

#include <doctest/doctest.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>

#include "apps/frontend/system/output_file.h"
#include "tests/support/forked_process.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::tests::scratch_folder_test {

TEST_CASE("a scratch folder is there while it lives and goes with its files") {
  std::filesystem::path file;
  {
    const apps::ScratchFolder folder, other;
    file = folder / "file";
    CHECK(file != other / "file");
    apps::write_file(file, "text");
    CHECK(std::filesystem::exists(file));
  }
  CHECK_FALSE(std::filesystem::exists(file.parent_path()));
}

TEST_CASE("a scratch folder goes with its files when the process is ended at once") {
  static const TemporaryFolder place;
  const ForkedProcess process([] {
    ::setenv("TMPDIR", place.path().c_str(), 1);
    apps::Interrupt interrupt;
    const apps::Interrupt::EndAtOnce end_at_once(interrupt);
    const apps::ScratchFolder folder;
    apps::write_file(folder / "file", "text");
    ::kill(::getpid(), SIGINT);
    ::sleep(10);
    return 0;
  });
  CHECK(process.status() == 130);
  CHECK(place.entry_count() == 0);
}

}  // namespace dmpc::tests::scratch_folder_test
