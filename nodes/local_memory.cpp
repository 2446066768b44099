#include "nodes/local_memory.h"

#include <cstring>
#include <string>

#include "core/base/ranges.h"
#include "core/base/units.h"
#include "core/base/zeroed_array.h"

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/asan_interface.h>
#else
#define ASAN_POISON_MEMORY_REGION(address, bytes) (static_cast<void>(address), static_cast<void>(bytes))
#define ASAN_UNPOISON_MEMORY_REGION(address, bytes) (static_cast<void>(address), static_cast<void>(bytes))
#endif

namespace dmpc::nodes {
namespace {

constexpr std::size_t block_alignment = 4096;

/// What a deleter, which knows only the block's address, needs; it precedes the block.
struct BlockFront {
  std::size_t bytes = 0;
  void* start = nullptr;  ///< of the allocation
};
static_assert(sizeof(BlockFront) <= block_alignment && LocalMemory::alignment <= block_alignment);

void release(std::byte* block) {
  BlockFront front;
  std::memcpy(&front, block - sizeof(front), sizeof(front));
  ASAN_UNPOISON_MEMORY_REGION(block, front.bytes);
  core::free_zeros(front.start, front.bytes + 2 * block_alignment);
}

/// Zero. Of a large block only its front has been touched.
std::byte* reserve_zero(std::size_t bytes) {
  const BlockFront front{bytes, core::allocate_zeros(bytes + 2 * block_alignment, core::Touching::parts)};
  const auto offset = reinterpret_cast<std::uintptr_t>(front.start) % block_alignment;
  std::byte* const block = static_cast<std::byte*>(front.start) + (2 * block_alignment - offset);
  std::memcpy(block - sizeof(front), &front, sizeof(front));
  return block;
}

}  // namespace

std::size_t MemoryPlan::total() const {
  return core::sum_over<std::size_t>(bytes, [&](const std::size_t category_bytes) { return category_bytes; });
}

MemoryPlan& MemoryPlan::operator+=(const MemoryPlan& more) {
  for (std::size_t category = 0; category < bytes.size(); ++category) {
    bytes[category] += more.bytes[category];
  }
  immutable_bytes += more.immutable_bytes;
  return *this;
}

LocalMemory::Block LocalMemory::reserve(std::size_t bytes) {
  try {
    Block block(reserve_zero(bytes), release);
    ASAN_POISON_MEMORY_REGION(block.get(), bytes);
    return block;
  } catch (const std::bad_alloc&) {
    throw core::CapacityError("this computer has no " + std::to_string(bytes) +
                              " bytes for a node's local memory: ask for fewer nodes or less memory a node");
  }
}

LocalMemory::LocalMemory(const MemoryPlan& plan, Immutable immutable)
    : plan_(plan), immutable_(immutable), block_(reserve(block_bytes())) {
  used_[Category::reserve] = plan[Category::reserve];
}

std::size_t LocalMemory::block_bytes() const {
  return plan_.total() - plan_[Category::reserve] - (immutable_ == Immutable::is_referred_to ? plan_.immutable_bytes : 0);
}

/// Returns the bytes of the cache lines that `bytes` occupy.
std::size_t LocalMemory::count(Category category, std::size_t bytes) {
  const std::size_t lines_bytes = core::round_up(bytes, alignment);
  core::expect(!sealed_, "nothing is allocated after the start");
  core::expect(category != Category::reserve, "the reserve is not for allocation");
  core::expect(lines_bytes <= plan_[category] - used_[category], "an allocation stays within its category's plan");
  used_[category] += lines_bytes;
  return lines_bytes;
}

void LocalMemory::count_immutable(Category category, std::size_t bytes) {
  core::expect(immutable_ == Immutable::is_referred_to, "bytes that are copied are allocated");
  used_.immutable_bytes += count(category, bytes);
  core::expect(used_.immutable_bytes <= plan_.immutable_bytes, "immutable bytes stay within the plan of them");
}

std::byte* LocalMemory::allocate_bytes(Category category, std::size_t bytes) {
  const std::size_t lines_bytes = count(category, bytes);
  core::expect(lines_bytes <= block_bytes() - offset_, "the categories together stay within the block");
  std::byte* const place = block_.get() + offset_;
  ASAN_UNPOISON_MEMORY_REGION(place, bytes);
  offset_ += lines_bytes;
  return place;
}

}  // namespace dmpc::nodes
