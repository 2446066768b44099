#include "apps/frontend/system/available_memory.h"

#include <doctest/doctest.h>
#include <sys/resource.h>

#include <filesystem>
#include <string>

#include "core/base/expect.h"
#include "tests/support/shell.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::apps::available_memory_test {

using tests::contains;
using tests::TemporaryFolder;
using tests::write_text;

namespace {

namespace fs = std::filesystem;

/// A root whose process is in these groups.
struct FakeRoot {
  explicit FakeRoot(const std::string& groups) {
    fs::create_directories(folder / "proc/self");
    write_text(folder / "proc/self/cgroup", groups);
  }
  void limit(const std::string& file, const std::string& text) const {
    const fs::path path = folder / ("sys/fs/cgroup/" + file);
    fs::create_directories(path.parent_path());
    write_text(path, text + "\n");
  }
  AvailableMemory room() const { return available_memory(folder.path().string()); }

  TemporaryFolder folder;
};

}  // namespace

TEST_CASE("without control groups there is at most this computer's memory") {
  const AvailableMemory room = available_memory(TemporaryFolder().path().string());
  CHECK(room.bytes > 1'000'000);
  CHECK_FALSE(room.source.empty());
}

TEST_CASE("a control group's limit counts, by either version, with its parents'") {
  const FakeRoot two("0::/a/b\n");
  two.limit("a/b/memory.max", "max");
  CHECK(two.room().bytes > 1'000'000);
  two.limit("a/memory.max", "300000");
  two.limit("a/memory.swap.max", "0");
  CHECK(two.room().bytes == 300'000);
  CHECK(contains(two.room().source, "cgroup/a/memory.max"));
  two.limit("a/b/memory.max", "200000");
  two.limit("a/b/memory.swap.max", "0");
  CHECK(two.room().bytes == 200'000);

  const FakeRoot one("5:devices:/\n4:cpu,memory:/docker/12\n");
  one.limit("memory/memory.limit_in_bytes", "9223372036854771712");
  const std::uint64_t all = one.room().bytes;
  one.limit("memory/docker/12/memory.limit_in_bytes", "100000");
  CHECK(one.room().bytes < all);
  CHECK(contains(one.room().source, "docker/12"));
}

TEST_CASE("in a container whose group has another name inside, the root's limit counts") {
  const FakeRoot root("0::/somewhere/else\n");
  root.limit("memory.max", "4096");
  root.limit("memory.swap.max", "0");
  CHECK(root.room().bytes == 4096);
}

TEST_CASE("what cannot be understood is no limit") {
  const FakeRoot root("nonsense\n0\n:::\n0::/\n");
  root.limit("memory.max", "much");
  CHECK(root.room().bytes > 1'000'000);
}

TEST_CASE("more than there is room for is refused with what would take it and who says so") {
  const AvailableMemory room{1024, "the limit of its control group"};
  check_available_memory(1024, "2 nodes", room);
  CHECK_THROWS_WITH_AS(
      check_available_memory(2048, "2 nodes", room),
      doctest::Contains("no room for 2 nodes: they take 2.0 KiB of memory together, and the limit of its control "
                        "group is 1.0 KiB; ask for fewer nodes (--nodes)"),
      core::CapacityError);
}

#if !defined(__SANITIZE_ADDRESS__)  // which reserves more than any limit
TEST_CASE("a render with less memory than its nodes take is refused before it begins") {
  const TemporaryFolder folder;
  const auto limited = [&](const std::string& limit, const std::string& nodes) {
    return tests::run({"/bin/sh", "-c",
                       "ulimit " + limit + "; exec " DMPC_PROGRAM " render tetra-7 --resolution=16x16 --nodes=" + nodes +
                           " --strategy=replicated --quiet -o " + (folder / "a.png").string()});
  };
  const tests::Said said = limited("-v 1000000", "1000");
  CHECK(said.status == 4);
  CHECK(contains(said.errors, "this computer has no room for 1,000 nodes and the host: they take "));
  CHECK(contains(said.errors, "this shell's limit (ulimit -v) is 976.56 MiB"));
  CHECK(folder.entry_count() == 0);
  CHECK(limited("-d 300000", "2").status == 0);
}
#endif

#if !defined(__SANITIZE_ADDRESS__)
TEST_CASE("where memory ends within a limit, who has set it is named") {
  const tests::Said said = tests::run({"/bin/sh", "-c", "ulimit -s 256; ulimit -d 120000; exec " DMPC_PROGRAM " info tetra-10"});
  CHECK(said.status == 4);
  CHECK_MESSAGE(contains(said.errors, "; this shell's limit (ulimit -d) is 117.19 MiB"), said.errors);
}
#endif

}  // namespace dmpc::apps::available_memory_test
