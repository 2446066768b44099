// The bounded bytes a node owns, accounted by category and sealed after the start.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <span>
#include <type_traits>

#include "core/base/expect.h"

namespace dmpc::nodes {

/// What a node's bytes are for.
enum class Category : std::uint8_t {
  home_pages,
  cache_frames,
  page_table,
  ray_stacks,
  mailbox,
  queues,
  film_tiles,
  constants,
  reserve,
};
inline constexpr std::size_t category_count = 9;

/// The category in words, for messages and tables: "home pages".
const char* name_of(Category category);

/// Bytes by category: what a program will need, known before anything is allocated.
struct MemoryPlan {
  std::array<std::size_t, category_count> bytes{};
  std::size_t lasting_bytes = 0;  ///< of all of them, room for LastingPieces, which a modelled machine's nodes do not fill

  /// Bytes of one category.
  std::size_t& operator[](Category category) { return bytes[static_cast<std::size_t>(category)]; }
  std::size_t operator[](Category category) const { return bytes[static_cast<std::size_t>(category)]; }
  /// Bytes of all categories.
  std::size_t total() const;
};

/// How a memory keeps bytes that never change and outlive the run: as copies, or, where the nodes are modelled, by their places.
/// Either takes the same bytes of the plan, and no program can tell.
enum class Lasting : std::uint8_t { is_copied, is_referred_to };

/// One block of memory, cut from the front and never given back; each allocation is rounded up to a cache line and counts against
/// its category's share of the plan. Thread safety: none; belongs to one node. Under ASan the bytes not handed out are poisoned,
/// the remainders of cache lines too.
class LocalMemory {
 public:
  static constexpr std::size_t alignment = 64;

  /// Reserves plan.total() bytes at once, but for the `reserve` category: that is the thread's stack, which the runner makes; it
  /// counts as used from the start. Where lasting bytes are referred to, it reserves no room for them, either. The real computer
  /// sets bytes aside when they are first written. Throws core::RoomError if it has not so much, as far as it knows by then.
  explicit LocalMemory(const MemoryPlan& plan, Lasting lasting = Lasting::is_copied);

  /// `count` value-initialised objects; expects that the memory is not sealed and that the category's plan has room.
  /// T needs no destructor. Objects without a constructor of their own are not touched: the block is zero, and so are they.
  template <class T>
  std::span<T> allocate(Category category, std::size_t count) {
    static_assert(std::is_trivially_destructible_v<T> && alignof(T) <= alignment);
    core::expect(count <= plan_[category] / sizeof(T), "an allocation stays within its category's plan");
    std::byte* const first = allocate_bytes(category, count * sizeof(T));
    if constexpr (!std::is_trivially_default_constructible_v<T>) {
      for (std::size_t i = 0; i < count; ++i) {
        ::new (static_cast<void*>(first + i * sizeof(T))) T();
      }
    }
    return {std::launder(reinterpret_cast<T*>(first)), count};
  }
  /// What `allocate<T>(category, count)` takes: for plans.
  template <class T>
  static constexpr std::size_t bytes_for(std::size_t count) {
    return (count * sizeof(T) + alignment - 1) / alignment * alignment;
  }

  /// For LastingPieces.
  Lasting lasting() const { return lasting_; }
  /// For LastingPieces: counts as allocate<std::byte>() does, where lasting bytes are referred to, and takes nothing.
  void count_lasting(Category category, std::size_t bytes);

  /// From now on allocate() is a broken invariant.
  void seal() { sealed_ = true; }
  /// Whether seal() has been called.
  bool sealed() const { return sealed_; }
  /// What the constructor was given.
  const MemoryPlan& plan() const { return plan_; }
  /// Bytes in use by category; since nothing is given back, this is the high-water mark.
  const MemoryPlan& used() const { return used_; }

 private:
  using Block = std::unique_ptr<std::byte[], void (*)(std::byte*)>;
  static Block reserve(std::size_t bytes);
  std::size_t block_bytes() const;
  std::size_t count(Category category, std::size_t bytes);
  std::byte* allocate_bytes(Category category, std::size_t bytes);

  MemoryPlan plan_;
  MemoryPlan used_;
  Lasting lasting_;
  Block block_;
  std::size_t offset_ = 0;
  bool sealed_ = false;
};

}  // namespace dmpc::nodes
