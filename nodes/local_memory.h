// The bounded bytes a node owns, accounted by category and sealed after the start.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <span>
#include <type_traits>

namespace dmpc::nodes {

enum class Category : std::uint8_t {
  home_pages, cache_frames, page_table, ray_stacks, mailbox, queues, film_tiles, constants, reserve
};
inline constexpr std::size_t category_count = 9;
const char* name_of(Category category);

/// Bytes by category: what a program will need, known before anything is allocated.
struct MemoryPlan {
  std::array<std::size_t, category_count> bytes{};

  std::size_t& operator[](Category category) { return bytes[static_cast<std::size_t>(category)]; }
  std::size_t operator[](Category category) const { return bytes[static_cast<std::size_t>(category)]; }
  std::size_t total() const;
};

/// One block of memory, cut from the front and never given back; each allocation is rounded up to a cache line and counts against its
/// category's share of the plan. Thread safety: none; belongs to one node. Under ASan the bytes not handed out are poisoned.
class LocalMemory {
 public:
  static constexpr std::size_t alignment = 64;

  /// Reserves plan.total() bytes at once (pages are touched so that the real computer backs them). The `reserve` category is accounted but
  /// not allocated here: it is the thread's stack, which the runner makes.
  explicit LocalMemory(const MemoryPlan& plan);

  /// `count` value-initialised objects; expects that the memory is not sealed and that the category's plan has room.
  /// T needs no destructor.
  template <class T>
  std::span<T> allocate(Category category, std::size_t count) {
    static_assert(std::is_trivially_destructible_v<T> && alignof(T) <= alignment);
    T* first = static_cast<T*>(allocate_bytes(category, bytes_for<T>(count)));
    for (std::size_t i = 0; i < count; ++i) {
      ::new (static_cast<void*>(first + i)) T();
    }
    return {first, count};
  }
  /// What `allocate<T>(category, count)` takes: for plans.
  template <class T>
  static constexpr std::size_t bytes_for(std::size_t count) {
    return (count * sizeof(T) + alignment - 1) / alignment * alignment;
  }

  /// From now on allocate() is a broken invariant.
  void seal() { sealed_ = true; }
  bool sealed() const { return sealed_; }
  const MemoryPlan& plan() const { return plan_; }
  /// Bytes in use by category; since nothing is given back, this is the high-water mark.
  const MemoryPlan& used() const { return used_; }

 private:
  void* allocate_bytes(Category category, std::size_t bytes);

  MemoryPlan plan_;
  MemoryPlan used_;
  std::unique_ptr<std::byte[], void (*)(std::byte*)> block_;
  std::size_t offset_ = 0;
  bool sealed_ = false;
};

}  // namespace dmpc::nodes
