// The bounded bytes a node owns, accounted by category and sealed after the start.
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

/// How many categories a node's bytes have.
inline constexpr std::size_t category_count = 9;

/// What a node's bytes are for: the computer's own, or something of which its program alone knows the meaning.
class Category {
 public:
  enum Own : std::uint8_t {
    mailbox,
    queues,  ///< packets that wait, and the table of credits
    reserve  ///< the thread's stack
  };

  // Implicit: whoever names a use of bytes, the computer's or a program's, has named the category.
  constexpr Category(Own own) : number_(own) {}
  /// A program numbers its uses from 0 on; there is room for category_count - 3.
  template <class Use>
  requires std::is_enum_v<Use>
  constexpr Category(Use use) : number_(own_count + static_cast<std::size_t>(use)) {}

  /// Among all of a node's.
  constexpr std::size_t number() const { return number_; }
  constexpr bool operator==(const Category&) const = default;

 private:
  static constexpr std::size_t own_count = 3;
  std::size_t number_;
};

/// Bytes by category: what a program will need, known before anything is allocated.
struct MemoryPlan {
  std::array<std::size_t, category_count> bytes{};  ///< by Category::number()
  std::size_t immutable_bytes = 0;  ///< of all of them, room for ImmutablePieces, which a modelled machine's nodes do not fill

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

/// How a memory keeps bytes that never change and outlive the run: as copies, or, where the nodes are modelled, by their places.
/// Either takes the same bytes of the plan, and no program can tell.
enum class Immutable : std::uint8_t { is_copied, is_referred_to };

/// Whether objects that are value-initialised are all zero bytes, as far as that can be seen when they are compiled.
template <class T>
constexpr bool begins_as_zeros = std::is_trivially_default_constructible_v<T>;
template <class T>
requires(std::is_aggregate_v<T>&& std::is_trivially_copyable_v<T>&& std::has_unique_object_representations_v<T>&& requires {
  typename std::bool_constant<(std::bit_cast<std::array<std::uint8_t, sizeof(T)>>(T{}), true)>;
}) constexpr bool begins_as_zeros<T> =
    std::bit_cast<std::array<std::uint8_t, sizeof(T)>>(T{}) == std::array<std::uint8_t, sizeof(T)>{};
/// Words without a hidden lock.
template <std::integral T>
constexpr bool begins_as_zeros<std::atomic<T>> = std::atomic<T>::is_always_lock_free;

/// One block of memory, cut from the front and never given back; each allocation is rounded up to a cache line and counts against
/// its category's share of the plan. Thread safety: none; belongs to one node. Under ASan the bytes not handed out are poisoned,
/// the remainders of cache lines too.
class LocalMemory {
 public:
  static constexpr std::size_t alignment = 64;

  /// Reserves plan.total() bytes at once, except for the `reserve` category: that is the thread's stack, which the runner makes; it
  /// counts as used from the start. Where immutable bytes are referred to, it reserves no room for them, either. The real
  /// computer sets bytes aside when they are first written. Throws core::CapacityError if it has not so much, as far as it knows
  /// by then.
  explicit LocalMemory(const MemoryPlan& plan, Immutable immutable = Immutable::is_copied);

  /// `count` value-initialised objects; expects that the memory is not sealed and that the category's plan has room.
  /// T needs no destructor. Objects that begin as zeros are not touched: the block is zero, and so are they. The real computer
  /// sets nothing aside for them until they are written.
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
  /// What `allocate<T>(category, count)` takes: for plans.
  template <class T>
  static constexpr std::size_t bytes_for(std::size_t count) {
    return (count * sizeof(T) + alignment - 1) / alignment * alignment;
  }

  /// For ImmutablePieces.
  Immutable immutable() const { return immutable_; }
  /// For ImmutablePieces: counts as allocate<std::byte>() does, where immutable bytes are referred to, and takes nothing.
  void count_immutable(Category category, std::size_t bytes);

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
  Immutable immutable_;
  Block block_;
  std::size_t offset_ = 0;
  bool sealed_ = false;
};

}  // namespace dmpc::nodes
