// Triangles that are there many times over: they are built once, and in memory for their number, not its square.
#include "core/database/faces/twins.h"

#include <doctest/doctest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <new>

#include "core/database/database.h"
#include "tests/support/forked_process.h"
#include "tests/support/shooting.h"

namespace dmpc::core::twins_test {

namespace {

using tests::ForkedProcess;

/// `count` triangles, each a little smaller than the one before, by `shrinking`; behind some that lie elsewhere.
Scene stacked(std::size_t count, double shrinking, std::size_t elsewhere = 0) {
  Scene scene;
  SceneBuilder builder(scene);
  for (std::size_t i = 0; i < elsewhere; ++i) {
    const double x = 1e-4 * static_cast<double>(i);
    builder.polygon({{x, 0, 1}, {x + 5e-5, 0, 1}, {x, 5e-5, 1}});
  }
  for (std::size_t i = 0; i < count; ++i) {
    const double size = 1 - shrinking * static_cast<double>(i);
    builder.polygon({{0, 0, 0}, {size, 0, 0}, {0, size, 0}});
  }
  return scene;
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // whose shadow is larger than any memory
/// From now on this process gets so many bytes more.
void limit_memory(std::size_t bytes) {
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const rlim_t most = pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) + bytes;
  const rlimit limit{most, most};
  ::setrlimit(RLIMIT_AS, &limit);
}

int build_within(std::size_t bytes, const Scene& scene) {
  try {
    limit_memory(bytes);
    static_cast<void>(build_database(scene, {.threads = 1}));
    return 0;
  } catch (const std::bad_alloc&) {
    return 1;
  }
}

constexpr std::size_t many = 300'000, room_bytes = std::size_t{350} << 20U;
#endif

}  // namespace

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST_CASE("triangles that coincide take memory in proportion to their number, equal or not, and wherever they are in the file" *
          doctest::test_suite("slow")) {
  CHECK(ForkedProcess([] { return build_within(room_bytes, stacked(many, 0)); }).status() == 0);
  CHECK(ForkedProcess([] { return build_within(room_bytes, stacked(many, 1e-7)); }).status() == 0);
  CHECK(ForkedProcess([] { return build_within(room_bytes, stacked(many, 1e-7, 20'000)); }).status() == 0);
}
#endif

TEST_CASE("of equal triangles the first is kept, whichever corner they begin with, and the others are counted") {
  Scene scene = stacked(3000, 0);
  const std::size_t first = scene.objects.size();
  for (std::size_t i = 0; i < 3000; ++i) {
    SceneBuilder(scene).polygon({{0, 1, 0}, {0, 0, 0}, {1, 0, 0}});
  }
  const Database database = build_database(scene, {.threads = 1});
  CHECK(database.primitives().size() == 1);
  CHECK(database.duplicates() == first + 2999);
  CHECK(database.sources().front().object == 0);
}

TEST_CASE("of equal triangles one that lets light through is no other's that does not") {
  Scene scene;
  SceneBuilder builder(scene);
  for (const double transmittance : {0.5, 0.0}) {
    builder.material({.transmittance = transmittance});
    for (std::size_t i = 0; i < 4000; ++i) {
      builder.polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    }
  }
  const Database database = build_database(scene, {.threads = 1});
  CHECK(database.primitives().size() == 1);
  CHECK(database.sources().front().object == 4000);  // who looks through glass at what it lies on sees that
}

TEST_CASE("triangles that are there many times over leave time to look at which others they cover") {
  Scene scene;
  SceneBuilder builder(scene);
  for (std::size_t i = 0; i < 1500; ++i) {  // in one tilted plane, and side by side
    builder.polygon({{0, 0, 0}, {1, 0, 0.5}, {0, 1, 0.25}});
    builder.polygon({{3, 3, 2.25}, {4, 3, 2.75}, {3, 4, 2.5}});
  }
  const Database database = build_database(scene, {.threads = 1});
  CHECK(database.primitives().size() == 2);
  CHECK(database.duplicates() == 2998);
  CHECK(database.planes().empty());  // which they need not share
}

TEST_CASE("of triangles that are equal for floats those stay that doubles tell apart") {
  Scene scene = stacked(3000, 0);
  SceneBuilder builder(scene);
  for (std::size_t i = 0; i < 3000; ++i) {
    builder.polygon({{0, 0, 1e-9}, {1, 0, 1e-9}, {0, 1, 1e-9}});
  }
  builder.polygon({{0, 0, 3}, {1, 0, 3}, {0, 1, 3}});
  builder.polygon({{-3, -3, -3}, {-2, -3, -3}, {-3, -2, -3}});
  const Database database = build_database(scene, {.threads = 1});
  CHECK(database.primitives().size() == 4);
  CHECK(database.duplicates() == 5998);
  CHECK(database.planes().size() == 2);
}

}  // namespace dmpc::core::twins_test
