// The bounded local memory of a node, accounted by category and sealed after the start.
#pragma once

#include <array>
#include <atomic>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <span>
#include <type_traits>

#include "core/base/expect.h"

namespace dmpc::nodes {

/// The number of categories of a node's bytes.
inline constexpr std::size_t category_count = 9;

/// The use of a node's bytes: the computer's own, or one whose meaning only its program knows.
class Category {
 public:
  enum Own : std::uint8_t {
    mailbox,
    queues,  ///< waiting packets, and the table of credits
    reserve  ///< the thread's stack
  };

  // Implicit: the name of a use of bytes, the computer's or a program's, is the category.
  constexpr Category(Own own) : number_(own) {}
  /// A program numbers its uses from 0 on, below category_count - 3.
  template <class Use>
  requires std::is_enum_v<Use>
  constexpr Category(Use use) : number_(own_count + static_cast<std::size_t>(use)) {}

  /// The number among all of a node's categories.
  constexpr std::size_t number() const { return number_; }
  constexpr bool operator==(const Category&) const = default;

 private:
  static constexpr std::size_t own_count = 3;
  std::size_t number_;
};

/// Bytes by category: what a program needs, known before anything is allocated.
struct MemoryPlan {
  std::array<std::size_t, category_count> bytes{};  ///< by Category::number()
  std::size_t immutable_bytes = 0;                  ///< part of these, for ImmutablePieces: not filled where they are referred to

  /// Bytes of one category.
  std::size_t& operator[](Category category) { return bytes[index_of(category)]; }
  std::size_t operator[](Category category) const { return bytes[index_of(category)]; }
  /// Bytes of all categories.
  std::size_t total() const;
  /// Category by category.
  MemoryPlan& operator+=(const MemoryPlan& more);

 private:
  static std::size_t index_of(Category category) {
    core::expect(category.number() < category_count, "a program has no more uses of bytes than there is room for");
    return category.number();
  }
};

inline MemoryPlan operator+(MemoryPlan sum, const MemoryPlan& more) { return sum += more; }

/// How a memory stores bytes that never change and outlive the run: as copies or by address (ComputerRequest::immutable()). Both
/// take the same bytes of the plan, and programs see no difference.
enum class Immutable : std::uint8_t { is_copied, is_referred_to };

/// Whether value-initialised objects are all zero bytes, as far as the compiler can tell.
template <class T>
constexpr bool begins_as_zeros = std::is_trivially_default_constructible_v<T>;
template <class T>
requires(std::is_aggregate_v<T>&& std::is_trivially_copyable_v<T>&& std::has_unique_object_representations_v<T>&& requires {
  typename std::bool_constant<(std::bit_cast<std::array<std::uint8_t, sizeof(T)>>(T{}), true)>;
}) constexpr bool begins_as_zeros<T> =
    std::bit_cast<std::array<std::uint8_t, sizeof(T)>>(T{}) == std::array<std::uint8_t, sizeof(T)>{};
/// Types of integers without a hidden lock.
template <std::integral T>
constexpr bool begins_as_zeros<std::atomic<T>> = std::atomic<T>::is_always_lock_free;

/// One block of memory, allocated from the front and never freed; each allocation is rounded up to a cache line and counts
/// against its category's share of the plan. Not thread-safe; belongs to one node. Under ASan the unallocated bytes are poisoned,
/// including the remainders of cache lines.
class LocalMemory {
 public:
  static constexpr std::size_t alignment = 64;

  /// Reserves plan.total() bytes at once, except for the `reserve` category: that is the thread's stack, which the runner makes;
  /// it counts as used from the start. Immutable bytes that are referred to are not reserved either. The real computer commits
  /// bytes when they are first written. Throws core::CapacityError if it has not enough memory, as far as it knows by then.
  explicit LocalMemory(const MemoryPlan& plan, Immutable immutable = Immutable::is_copied);

  /// `count` value-initialised objects; expects that the memory is not sealed and that the category's plan has as much left. T
  /// needs no destructor. Objects whose initial value is zero are not touched, since the block is zero: the real computer commits
  /// nothing for them until they are written.
  template <class T>
  std::span<T> allocate(Category category, std::size_t count) {
    static_assert(std::is_trivially_destructible_v<T> && alignof(T) <= alignment);
    core::expect(count <= plan_[category] / sizeof(T), "an allocation stays within its category's plan");
    std::byte* const first = allocate_bytes(category, count * sizeof(T));
    if constexpr (!begins_as_zeros<T>) {
      for (std::size_t i = 0; i < count; ++i) {
        ::new (static_cast<void*>(first + i * sizeof(T))) T();
      }
    }
    return {std::launder(reinterpret_cast<T*>(first)), count};
  }
  /// The bytes that `allocate<T>(category, count)` takes: for plans.
  template <class T>
  static constexpr std::size_t bytes_for(std::size_t count) {
    return (count * sizeof(T) + alignment - 1) / alignment * alignment;
  }

  /// For ImmutablePieces.
  Immutable immutable() const { return immutable_; }
  /// For ImmutablePieces: counts like allocate<std::byte>(), where immutable bytes are referred to, but takes nothing.
  void count_immutable(Category category, std::size_t bytes);

  /// After this, calling allocate() is a broken invariant.
  void seal() { sealed_ = true; }
  /// Whether seal() has been called.
  bool sealed() const { return sealed_; }
  /// The constructor's argument.
  const MemoryPlan& plan() const { return plan_; }
  /// Bytes in use by category; since nothing is freed, this is the high-water mark.
  const MemoryPlan& used() const { return used_; }

 private:
  using Block = std::unique_ptr<std::byte[], void (*)(std::byte*)>;
  static Block reserve(std::size_t bytes);
  std::size_t block_bytes() const;
  std::size_t count(Category category, std::size_t bytes);
  std::byte* allocate_bytes(Category category, std::size_t bytes);

  MemoryPlan plan_;
  MemoryPlan used_;
  Immutable immutable_;
  Block block_;
  std::size_t offset_ = 0;
  bool sealed_ = false;
};

}  // namespace dmpc::nodes
