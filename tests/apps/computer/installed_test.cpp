// The examples as who has installed dmpc builds and runs them, with what their heads say of them.
#include <doctest/doctest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/frontend/line/number_text.h"
#include "tests/support/shell.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests::installed_test {

namespace {

using Words = std::vector<std::string>;

bool has(const Said& said, const std::string& part) { return said.output.find(part) != std::string::npos; }

/// A page that is asked for takes a question and an answer.
std::string packets_of(std::uint64_t pages) { return apps::counted(2 * pages, "packet"); }

/// What dmpc itself says of the picture that image_parallel renders.
std::string film_of_rings(const std::filesystem::path& folder) {
  const std::string stats = folder / "rings.json";
  REQUIRE(
      run({DMPC_PROGRAM, "render", "rings-3-t1", "--resolution=64x64", "--stats=" + stats, "-o", folder / "rings.exr"}).status ==
      0);
  return nlohmann::json::parse(file_text(stats))["film_hash"];
}

}  // namespace

TEST_CASE("the examples are built from an installed prefix with all warnings, and come to what they say" *
          doctest::test_suite("slow")) {
  const TemporaryFolder folder;
  const std::string prefix = folder / "a prefix", build = folder / "build";
  REQUIRE(run({"cmake", "--install", DMPC_BUILD_DIR, "--component", "development", "--prefix", prefix}).status == 0);
  const Said configured =
      run({"cmake", "-G", "Ninja", "-S", prefix + "/share/doc/libdmpc-dev/examples", "-B", build, "-D",
           "CMAKE_PREFIX_PATH=" + prefix, "-D", "CMAKE_CXX_FLAGS=-Wall -Wextra -Wconversion -Wshadow -Werror"});
  REQUIRE_MESSAGE(configured.status == 0, configured.errors);
  const Said built = run({"cmake", "--build", build});
  REQUIRE_MESSAGE(built.status == 0, built.output);

  const auto ring = [&](const std::string& nodes) {
    return run({build + "/ring_product", "--size=128", "--runner=virtual", "--machine=hdr", "--nodes=" + nodes});
  };
  CHECK(has(ring("1"), "as expected\n1 node of hdr: 1.05 ms"));
  CHECK(has(ring("16"), "as expected\n16 nodes of hdr: 83.5 us"));
  CHECK(has(ring("64"), "as expected\n64 nodes of hdr: 219 us"));
  CHECK(run({build + "/ring_product", "--size=64", "--report=" + (folder / "ring.html").string()}).errors.empty());
  CHECK(file_text(folder / "ring.html").find("Who sent packets to whom") != std::string::npos);

  const auto sorted = [&](const std::string& nodes, const std::string& keys) {
    return run({build + "/sample_sort", "--runner=virtual", "--machine=gigabit", "--nodes=" + nodes, "--keys=" + keys});
  };
  CHECK(has(sorted("1", "65536"), "sorted; the fullest node has 100 % of its share\n1 node of gigabit: 4.46 ms"));
  CHECK(has(sorted("16", "4096"), "16 nodes of gigabit: 1.06 ms"));
  CHECK(has(sorted("64", "1024"), "64 nodes of gigabit: 2.16 ms"));
  const auto ranked = [&](const std::string& cache_pages, const std::string& replacement = "lru") {
    return run({build + "/page_rank", "--runner=virtual", "--machine=hdr", "--cache-pages=" + cache_pages,
                "--replacement=" + replacement});
  };
  CHECK(has(ranked("16"), "as in one memory\n8 nodes of hdr: 66.1 ms"));
  CHECK(has(ranked("16"), "31.0 % of them faults"));
  CHECK(has(ranked("64"), "8 nodes of hdr: 24.5 ms"));
  CHECK(has(ranked("64"), "11.6 % of them faults"));
  CHECK(has(ranked("128"), "1.2 % of them faults"));
  CHECK(has(ranked("128", "fifo"), "2.9 % of them faults"));
  CHECK(has(ranked("256"), "8 nodes of hdr: 2.54 ms"));
  CHECK(has(ranked("256"), "0.6 % of them faults"));
  const auto sent = [&](const Words& words) {
    Words all = {build + "/broadcast", "--runner=virtual", "--machine=hdr", "--nodes=16", "--bytes=1000000"};
    all.insert(all.end(), words.begin(), words.end());
    return run(all);
  };
  CHECK(has(sent({}), "16 of 16 nodes have the 1000000 bytes\n16 nodes of hdr: 173 us"));
  CHECK(has(sent({"--children=1"}), "16 nodes of hdr: 648 us"));
  CHECK(has(sent({"--children=1", "--pieces=64"}), "16 nodes of hdr: 75.3 us"));
  const auto passed = [&](const Words& words) {
    Words all = {build + "/passing_ring", "--runner=virtual", "--machine=hdr", "--nodes=16"};
    all.insert(all.end(), words.begin(), words.end());
    return run(all);
  };
  CHECK(has(passed({}), "256 items have come\n16 nodes of hdr: 436 us"));
  CHECK(has(passed({"--places=2"}), "16 nodes of hdr: 235 us"));
  CHECK(passed({"--lanes=1", "--places=2"}).errors.find("in a circle: node 0 waits for node 1, that for") != std::string::npos);
  const auto rendered = [&](const std::string& kept) {
    return run({build + "/image_parallel", "--runner=virtual", "--machine=hdr", "--kept=" + kept});
  };
  const std::string film = "film " + film_of_rings(folder.path());
  CHECK(has(rendered("4"), film + "\n8 nodes of hdr: 61.1 ms"));
  CHECK(has(rendered("4"), "; " + packets_of(113'668)));
  CHECK(has(rendered("64"), film + "\n8 nodes of hdr: 19.0 ms"));
  CHECK(has(rendered("64"), "; " + packets_of(31'789)));
  CHECK(has(rendered("256"), film + "\n8 nodes of hdr: 5.03 ms"));
  CHECK(has(rendered("256"), "; " + packets_of(6'066)));
  for (int seed = 1; seed <= 4; ++seed) {
    INFO("seed ", seed);
    CHECK(has(run({build + "/ring_product", "--size=64", "--chaos=" + std::to_string(seed)}), "as expected"));
    CHECK(has(run({build + "/page_rank", "--vertices=2000", "--cache-pages=2", "--chaos=" + std::to_string(seed)}),
              "as in one memory"));
    CHECK(has(run({build + "/passing_ring", "--chaos=" + std::to_string(seed)}), "128 items have come"));
    CHECK(has(run({build + "/image_parallel", "--nodes=3", "--chaos=" + std::to_string(seed)}), film));
    CHECK(has(run({build + "/sample_sort", "--keys=1000", "--chaos=" + std::to_string(seed)}), "8000 keys, sorted"));
  }
}

TEST_CASE("a program that is built from an installed prefix runs on ranks, by the module that is installed there" *
          doctest::test_suite("slow")) {
  if (!std::filesystem::exists(std::filesystem::path(DMPC_PROGRAM).parent_path() / "dmpc_mpi.so")) {
    MESSAGE("left out: there is no MPI");
    return;
  }
  const TemporaryFolder folder;
  const std::string prefix = folder / "a prefix", build = folder / "build";
  for (const std::string component : {"development", "mpi"}) {
    REQUIRE(run({"cmake", "--install", DMPC_BUILD_DIR, "--component", component, "--prefix", prefix}).status == 0);
  }
  REQUIRE(run({"cmake", "-G", "Ninja", "-S", prefix + "/share/doc/libdmpc-dev/examples", "-B", build, "-D",
               "CMAKE_PREFIX_PATH=" + prefix})
              .status == 0);
  REQUIRE(run({"cmake", "--build", build, "--target", "ring_product"}).status == 0);
  const Words line = {"/usr/bin/env",
                      "OMPI_ALLOW_RUN_AS_ROOT=1",
                      "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1",
                      "HWLOC_COMPONENTS=-gl,-opencl",
                      "mpirun",
                      "-n",
                      "2",
                      "--oversubscribe",
                      build + "/ring_product",
                      "--size=64",
                      "--nodes=4",
                      "--runner=mpi"};
  const Said said = run(line);
  CHECK_MESSAGE(said.status == 0, said.errors);
  CHECK(has(said, "as expected\n4 nodes on ranks: "));
  std::filesystem::remove(prefix + "/lib/dmpc/dmpc_mpi.so");
  const Said without = run(line);
  CHECK(without.status == 3);
  CHECK_MESSAGE(
      without.errors.find("the module dmpc_mpi.so, with which dmpc runs on several ranks (Debian's package is dmpc-mpi), "
                          "cannot be opened") != std::string::npos,
      without.errors);
}

TEST_CASE("a component that there is not is refused by name") {
  const TemporaryFolder folder;
  const std::string prefix = folder / "prefix";
  REQUIRE(run({"cmake", "--install", DMPC_BUILD_DIR, "--component", "development", "--prefix", prefix}).status == 0);
  write_text(
      folder / "CMakeLists.txt",
      "cmake_minimum_required(VERSION 3.25)\nproject(wrong LANGUAGES CXX)\nfind_package(dmpc REQUIRED COMPONENTS cellar)\n");
  const Said said = run({"cmake", "-S", folder.path(), "-B", folder / "build", "-D", "CMAKE_PREFIX_PATH=" + prefix});
  CHECK(said.status != 0);
  CHECK(said.errors.find("dmpc has no component cellar") != std::string::npos);
}

}  // namespace dmpc::tests::installed_test
