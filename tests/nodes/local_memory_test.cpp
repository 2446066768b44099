#include "nodes/local_memory.h"

#include <doctest/doctest.h>
#include <sys/mman.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "nodes/packet.h"

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/asan_interface.h>
#endif

namespace dmpc::nodes::local_memory_test {
namespace {

/// A program's uses of memory.
enum class OwnUse : std::uint8_t { first = 0, last = 5, too_much = 6 };

MemoryPlan queues_of(std::size_t bytes) {
  MemoryPlan plan;
  plan[Category::queues] = bytes;
  return plan;
}

TEST_CASE("a plan's total is the sum of its categories") {
  MemoryPlan plan;
  CHECK(plan.total() == 0);
  plan[OwnUse::first] = 4096;
  plan[Category::reserve] = 100;
  CHECK(plan.total() == 4196);
}

TEST_CASE("a program's categories are none of the computer's, and as many as there is room for") {
  MemoryPlan plan;
  plan[Category::mailbox] = 1;
  plan[Category::queues] = 2;
  plan[Category::reserve] = 4;
  plan[OwnUse::first] = 8;
  plan[OwnUse::last] = 16;
  CHECK(plan.total() == 31);
  CHECK(plan[Category::reserve] == 4);
  CHECK(plan[OwnUse::first] == 8);
  CHECK(plan.bytes.back() == 16);
  CHECK_THROWS_AS(plan[OwnUse::too_much] = 1, core::InternalError);
}

TEST_CASE("a memory of nothing hands out nothing") {
  LocalMemory memory{MemoryPlan{}};
  CHECK(memory.allocate<int>(Category::queues, 0).empty());
  CHECK_THROWS_AS(memory.allocate<int>(Category::queues, 1), core::InternalError);
}

TEST_CASE("allocations are zero, aligned, apart, and counted in whole cache lines") {
  LocalMemory memory(queues_of(256));
  const auto first = memory.allocate<std::uint32_t>(Category::queues, 17);
  const auto second = memory.allocate<std::uint8_t>(Category::queues, 1);
  CHECK(first.size() == 17);
  CHECK(first[16] == 0);
  CHECK(reinterpret_cast<std::uintptr_t>(first.data()) % LocalMemory::alignment == 0);
  CHECK(reinterpret_cast<std::uintptr_t>(second.data()) - reinterpret_cast<std::uintptr_t>(first.data()) == 128);
  CHECK(memory.used()[Category::queues] == 192);
  CHECK(memory.used().total() == LocalMemory::bytes_for<std::uint32_t>(17) + LocalMemory::bytes_for<std::uint8_t>(1));
}

TEST_CASE("allocations are zero in a memory that was used before") {
  for (const std::size_t bytes : {std::size_t{64}, std::size_t{4096}, std::size_t{3} << 20U}) {
    for (int again = 0; again < 3; ++again) {
      LocalMemory memory(queues_of(bytes));
      const auto all = memory.allocate<std::byte>(Category::queues, bytes);
      CHECK(std::all_of(all.begin(), all.end(), [](std::byte one) { return one == std::byte{0}; }));
      CHECK(reinterpret_cast<std::uintptr_t>(all.data()) % LocalMemory::alignment == 0);
      std::memset(all.data(), 0xff, bytes);
    }
  }
}

TEST_CASE("objects with a constructor of their own are made by it") {
  struct Made {
    int value = 7;
  };
  LocalMemory memory(queues_of(256));
  for (const Made& made : memory.allocate<Made>(Category::queues, 5)) {
    CHECK(made.value == 7);
  }
}

#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST_CASE("a memory takes nothing of the real computer until it is written") {
  constexpr std::size_t bytes = std::size_t{64} << 20U, page_bytes = 4096;
  const auto resident = [](std::span<std::byte> memory) {
    std::vector<unsigned char> is_resident(memory.size() / page_bytes);
    CHECK(::mincore(memory.data(), memory.size(), is_resident.data()) == 0);
    return static_cast<std::size_t>(
        std::count_if(is_resident.begin(), is_resident.end(), [](unsigned char one) { return (one & 1U) != 0; }));
  };
  LocalMemory memory(queues_of(bytes));
  const auto all = memory.allocate<std::byte>(Category::queues, bytes);
  CHECK(resident(all) == 0);
  all[bytes / 2] = std::byte{1};
  CHECK(resident(all) == 1);
  std::memset(all.data(), 1, bytes);
  CHECK(resident(all) == bytes / page_bytes);

  // malloc() keeps what it had of the system, and calloc() would write zeros there.
  for (const std::size_t size : {std::size_t{256} << 10U, std::size_t{1} << 20U}) {
    std::vector<std::vector<char>>(3, std::vector<char>(std::size_t{16} << 20U)).clear();
    std::vector<std::vector<char>>(64, std::vector<char>(size)).clear();
    LocalMemory small(queues_of(size));
    CHECK(resident(small.allocate<std::byte>(Category::queues, size)) == 0);
  }

  struct Counter {
    std::uint64_t count = 0;
  };
  LocalMemory counters(queues_of(bytes));
  CHECK(resident(std::as_writable_bytes(counters.allocate<Counter>(Category::queues, bytes / sizeof(Counter)))) == 0);
  LocalMemory words(queues_of(bytes));
  CHECK(resident(std::as_writable_bytes(words.allocate<std::atomic<std::uint32_t>>(Category::queues, bytes / 4))) == 0);
}
#endif

TEST_CASE("objects that begin as zeros are told from those that do not") {
  struct Zeros {
    std::uint32_t a = 0;
    std::uint16_t b = 0, c = 0;
  };
  struct Number {
    std::uint32_t a = 0, b = 1;
  };
  struct Padded {
    std::uint32_t a = 0;
    std::uint8_t b = 0;
  };
  CHECK(begins_as_zeros<int>);
  CHECK(begins_as_zeros<Zeros>);
  CHECK(begins_as_zeros<std::atomic<std::uint64_t>>);
  CHECK_FALSE(begins_as_zeros<Number>);
  CHECK_FALSE(begins_as_zeros<Padded>);  // what lies between its members is nobody's, so it is made by its constructor
}

TEST_CASE("a category can be filled to its last byte and no further") {
  LocalMemory memory(queues_of(128));
  CHECK(memory.allocate<std::byte>(Category::queues, 128).size() == 128);
  CHECK_THROWS_AS(memory.allocate<std::byte>(Category::queues, 1), core::InternalError);
}

TEST_CASE("a count whose bytes overflow is refused") {
  LocalMemory memory(queues_of(128));
  CHECK_THROWS_AS(memory.allocate<std::uint64_t>(Category::queues, SIZE_MAX / 4), core::InternalError);
}

TEST_CASE("one category does not live on another's share") {
  MemoryPlan plan = queues_of(64);
  plan[Category::mailbox] = 64;
  LocalMemory memory(plan);
  CHECK_THROWS_AS(memory.allocate<std::byte>(Category::mailbox, 65), core::InternalError);
  CHECK(memory.allocate<std::byte>(Category::mailbox, 64).size() == 64);
}

TEST_CASE("the reserve counts as used and is not for allocation") {
  MemoryPlan plan;
  plan[Category::reserve] = 1024;
  LocalMemory memory(plan);
  CHECK(memory.used()[Category::reserve] == 1024);
  CHECK_THROWS_AS(memory.allocate<std::byte>(Category::reserve, 1), core::InternalError);
}

TEST_CASE("a sealed memory hands out nothing") {
  LocalMemory memory(queues_of(64));
  CHECK_FALSE(memory.sealed());
  memory.seal();
  CHECK(memory.sealed());
  CHECK_THROWS_AS(memory.allocate<std::byte>(Category::queues, 1), core::InternalError);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // whose allocators end the process instead
TEST_CASE("more memory than the real computer has is bad input") {
  CHECK_THROWS_AS(LocalMemory(queues_of(std::size_t{1} << 60U)), core::InputError);
}
#endif

#if defined(__SANITIZE_ADDRESS__)
TEST_CASE("bytes that were not handed out are poisoned, the rest of a cache line too") {
  LocalMemory memory(queues_of(256));
  const auto bytes = memory.allocate<std::byte>(Category::queues, 20);
  CHECK(__asan_region_is_poisoned(bytes.data(), 20) == nullptr);
  CHECK(__asan_address_is_poisoned(bytes.data() + 20) == 1);
  CHECK(__asan_address_is_poisoned(bytes.data() + 64) == 1);
}
#endif

}  // namespace
}  // namespace dmpc::nodes::local_memory_test
