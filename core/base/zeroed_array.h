// Large zero-initialised arrays of constant size.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>

namespace dmpc::core {

/// How an array will be used: all of it, or sparsely.
enum class Touching : std::uint8_t { all, parts };

/// Zeroed bytes for objects of any type that is not over-aligned; memory is committed when it is first touched. For large arrays
/// that are touched completely the operating system is asked for its large pages (Linux: transparent huge pages): with pages of 4
/// KiB a film of a million pixels caused 13,000 page faults, which took as long as a third of a picture. Throws std::bad_alloc.
/// Both functions are thread-safe.
void* allocate_zeros(std::size_t bytes, Touching touching = Touching::all);
/// Frees what allocate_zeros() returned for the same number of bytes.
void free_zeros(void* first, std::size_t bytes) noexcept;

/// Objects whose value-initialised state is all zero bytes; none is touched before its owner touches it. Copied and moved like a
/// std::vector. Thread safety: as a std::vector.
template <class T>
class ZeroedArray {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T> &&
                alignof(T) <= alignof(std::max_align_t));

 public:
  ZeroedArray() = default;
  explicit ZeroedArray(std::size_t count)
      : items_(count == 0 ? nullptr : static_cast<T*>(allocate_zeros(count * sizeof(T))), Free{count * sizeof(T)}),
        count_(count) {}
  ZeroedArray(const ZeroedArray& other) : ZeroedArray(other.count_) {
    if (count_ != 0) {
      std::memcpy(items_.get(), other.items_.get(), count_ * sizeof(T));
    }
  }
  ZeroedArray(ZeroedArray&& other) noexcept : items_(std::move(other.items_)), count_(std::exchange(other.count_, 0)) {}
  ZeroedArray& operator=(ZeroedArray other) noexcept {
    std::swap(items_, other.items_);
    std::swap(count_, other.count_);
    return *this;
  }
  ~ZeroedArray() = default;

  std::size_t size() const { return count_; }
  T& operator[](std::size_t index) { return items_[index]; }
  const T& operator[](std::size_t index) const { return items_[index]; }
  std::span<const T> span() const { return {items_.get(), count_}; }

 private:
  struct Free {
    std::size_t bytes = 0;
    void operator()(T* first) const noexcept { free_zeros(first, bytes); }
  };

  std::unique_ptr<T[], Free> items_;
  std::size_t count_ = 0;
};

}  // namespace dmpc::core
