#include "nodes/local_memory.h"

#include <cstring>
#include <new>
#include <string>

#include "core/expect.h"
#include "core/units.h"

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/asan_interface.h>
#else
#define ASAN_POISON_MEMORY_REGION(address, bytes) (static_cast<void>(address), static_cast<void>(bytes))
#define ASAN_UNPOISON_MEMORY_REGION(address, bytes) (static_cast<void>(address), static_cast<void>(bytes))
#endif

namespace dmpc::nodes {
namespace {

constexpr std::align_val_t block_alignment{4096};

/// Unpoisons with the size that stands in front of the block: a deleter knows the address only.
struct BlockFront {
  std::size_t bytes = 0;
};
constexpr std::size_t front_bytes = LocalMemory::alignment;
static_assert(sizeof(BlockFront) <= front_bytes);

void release(std::byte* block) {
  std::byte* const start = block - front_bytes;
  BlockFront front;
  std::memcpy(&front, start, sizeof(front));
  ASAN_UNPOISON_MEMORY_REGION(block, front.bytes);
  ::operator delete[](start, block_alignment);
}

std::byte* reserve_touched(std::size_t bytes) {
  auto* const start = static_cast<std::byte*>(::operator new[](front_bytes + bytes, block_alignment));
  std::memset(start, 0, front_bytes + bytes);
  const BlockFront front{bytes};
  std::memcpy(start, &front, sizeof(front));
  ASAN_POISON_MEMORY_REGION(start + front_bytes, bytes);
  return start + front_bytes;
}

std::size_t block_bytes(const MemoryPlan& plan) { return plan.total() - plan[Category::reserve]; }

}  // namespace

const char* name_of(Category category) {
  static constexpr std::array<const char*, category_count> names = {
      "home pages", "cache frames", "page table", "ray stacks", "mailbox", "queues", "film tiles", "constants", "reserve"};
  return names.at(static_cast<std::size_t>(category));
}

std::size_t MemoryPlan::total() const {
  std::size_t sum = 0;
  for (const std::size_t category_bytes : bytes) {
    sum += category_bytes;
  }
  return sum;
}

LocalMemory::Block LocalMemory::reserve(std::size_t bytes) {
  try {
    return {reserve_touched(bytes), release};
  } catch (const std::bad_alloc&) {
    throw core::InputError("this computer has no " + std::to_string(bytes) +
                           " bytes for a node's local memory: ask for fewer nodes or less memory a node");
  }
}

LocalMemory::LocalMemory(const MemoryPlan& plan) : plan_(plan), block_(reserve(block_bytes(plan))) {
  used_[Category::reserve] = plan[Category::reserve];
}

std::byte* LocalMemory::allocate_bytes(Category category, std::size_t bytes) {
  const std::size_t lines_bytes = core::round_up(bytes, alignment);
  core::expect(!sealed_, "nothing is allocated after the start");
  core::expect(category != Category::reserve, "the reserve is not for allocation");
  core::expect(lines_bytes <= plan_[category] - used_[category], "an allocation stays within its category's plan");
  core::expect(lines_bytes <= block_bytes(plan_) - offset_, "the categories together stay within the block");
  std::byte* const place = block_.get() + offset_;
  ASAN_UNPOISON_MEMORY_REGION(place, bytes);
  offset_ += lines_bytes;
  used_[category] += lines_bytes;
  return place;
}

}  // namespace dmpc::nodes
