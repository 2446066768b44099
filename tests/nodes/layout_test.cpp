#include "nodes/layout.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <span>

#include "core/base/expect.h"

namespace dmpc::nodes::layout_test {
namespace {

/// A program's uses of memory.
enum class Use : std::uint8_t { first, second };

Layout<std::byte, std::uint64_t, std::uint32_t> small_layout() { return {{Use::first, 65}, {Use::second, 8}, {Use::first, 1}}; }

}  // namespace

TEST_CASE("a plan adds up exactly what a layout takes, category by category, in whole cache lines") {
  const MemoryPlan plan = small_layout();
  CHECK(plan[Use::first] == 3 * LocalMemory::alignment);
  CHECK(plan[Use::second] == LocalMemory::alignment);
  CHECK(plan.total() == 4 * LocalMemory::alignment);
  LocalMemory memory(plan);
  const auto [bytes, longs, shorts] = small_layout().in(memory);
  CHECK(memory.used().bytes == plan.bytes);
  CHECK(bytes.size() == 65);
  CHECK(longs.size() == 8);
  CHECK(shorts.size() == 1);
}

TEST_CASE("rooms are taken in their order") {
  LocalMemory memory(small_layout());
  const auto [bytes, longs, shorts] = small_layout().in(memory);
  CHECK(std::as_bytes(longs).data() == bytes.data() + 2 * LocalMemory::alignment);
  CHECK(std::as_bytes(shorts).data() == bytes.data() + 3 * LocalMemory::alignment);
}

TEST_CASE("rooms, layouts and plans are added, those for immutable bytes among them") {
  MemoryPlan immutable;
  immutable.immutable_bytes = immutable[Use::second] = 64;
  const MemoryPlan sum = Room<std::byte>{Use::first, 1} + small_layout() + immutable;
  CHECK(sum[Use::first] == 4 * LocalMemory::alignment);
  CHECK(sum[Use::second] == 2 * LocalMemory::alignment);
  CHECK(sum.immutable_bytes == 64);
}

TEST_CASE("no room takes nothing, and a second one is not in the plan") {
  CHECK(MemoryPlan(Room<std::uint64_t>{Use::first, 0}).total() == 0);
  const Room<std::uint64_t> room{Use::first, 8};
  LocalMemory memory(room);
  CHECK(room.in(memory).size() == 8);
  CHECK_THROWS_AS(room.in(memory), core::InternalError);
}

}  // namespace dmpc::nodes::layout_test
