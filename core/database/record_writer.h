// Allocates records in pages, none across a page's border.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/expect.h"
#include "core/base/units.h"
#include "core/record/record.h"
#include "core/record/records.h"

namespace dmpc::core {

/// The first offset at or behind `end` where a record of `bytes` lies in one page.
constexpr std::size_t place_in_page(std::size_t end, std::size_t bytes, std::size_t page_size) {
  const std::size_t offset = round_up(end, record_alignment);
  return offset % page_size + bytes > page_size ? round_up(offset, page_size) : offset;
}

/// Whether a RecordWriter stores what is written, or only computes the memory that it would take.
enum class Keeps : std::uint8_t { records, nothing };

/// Addresses are ascending, so consecutive allocations share pages; unless places are given.
class RecordWriter {
 public:
  static constexpr std::uint64_t bytes_max = std::uint64_t{16} << 30U;  ///< what 31 bits of address span

  /// `places`: where the records go, in the order of their allocation (structure.h); arrays before them are separate.
  explicit RecordWriter(std::size_t page_size, std::vector<Address> places = {})
      : page_size_(page_size), instances_(std::move(places)) {}
  RecordWriter(std::size_t page_size, Keeps keeps) : page_size_(page_size), keeps_(keeps) {}

  /// Allocates a record of `bytes` in one page.
  Address allocate(std::size_t bytes) {
    expect(bytes > 0 && bytes <= record_bytes_max, "a record is at most 448 bytes long");
    if (sizes_.empty()) {
      front_bytes_ = end_;
    }
    sizes_.push_back(static_cast<std::uint16_t>(bytes));
    return take(instances_.empty() ? place_in_page(end_, bytes, page_size_) : byte_offset(instances_.at(sizes_.size() - 1)),
                bytes);
  }
  /// Allocates one of a run of records that take `share` bytes each on average, or what they need if that is more: none crosses a
  /// page's border, so some lie a little closer together than others. 0: what they need.
  Address allocate(std::size_t bytes, std::size_t share) {
    const std::size_t taken = std::max(bytes, share);
    const bool is_in_run = share > 0 || shared_end_ > 0;
    if (!is_in_run || !instances_.empty()) {
      return allocate(taken);
    }
    shared_end_ = shared_end_ == 0 ? end_ : shared_end_;
    const Address address = allocate(bytes);
    sizes_.back() = static_cast<std::uint16_t>(taken);
    shared_end_ += taken;
    end_ = std::max(end_, shared_end_);
    return address;
  }
  /// Allocates `count` consecutive records of T; T's size is a power of two, so that none crosses a page's border.
  template <class T>
  Address allocate_array(std::size_t count) {
    static_assert((sizeof(T) & (sizeof(T) - 1)) == 0);
    return take(round_up(end_, std::max(sizeof(T), record_alignment)), count * sizeof(T));
  }
  /// The next allocation begins a page.
  void begin_page() { end_ = round_up(end_, page_size_); }
  /// The next allocations, up to `bytes` of records, lie in one page.
  void keep_together(std::size_t bytes) { end_ = place_in_page(end_, bytes, page_size_); }
  /// Makes everything that has been allocated writable, so that several threads may write to different records. To be called
  /// once, after the last allocation: then finish() has nothing to move.
  void make_room() {
    bytes_.reserve(finished_bytes());
    cover();
  }
  /// Reserves this many bytes after what has been allocated, which then is never moved, without making them writable.
  void reserve(std::size_t bytes) {
    if (keeps_ == Keeps::records) {
      bytes_.reserve(end_ + bytes + page_size_ + overread_bytes);
    }
  }
  void write(Address address, std::size_t offset, std::span<const std::byte> bytes) {
    if (keeps_ == Keeps::nothing) {
      return;
    }
    cover();
    std::copy(bytes.begin(), bytes.end(), bytes_.begin() + static_cast<std::ptrdiff_t>(byte_offset(address) + offset));
  }
  template <class T>
  void write(Address address, std::size_t offset, const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    write(address, offset, std::as_bytes(std::span(&value, 1)));
  }
  /// Allocates a record and writes it.
  template <class T>
  Address add(const T& record) {
    const Address address = allocate(sizeof(T));
    write(address, 0, record);
    return address;
  }
  /// Bytes of every record so far, in the order of allocation.
  std::span<const std::uint16_t> sizes() const { return sizes_; }
  /// Bytes before the first record.
  std::size_t front_bytes() const { return front_bytes_; }
  /// Bytes of the pages so far, including the unused part of the last one: at least one page.
  std::size_t page_bytes() const { return std::max(page_size_, round_up(end_, page_size_)); }
  /// page_bytes() with one more record of `bytes`.
  std::size_t page_bytes_with(std::size_t bytes) const {
    return round_up(place_in_page(end_, bytes, page_size_) + bytes, page_size_);
  }
  /// The pages, followed by overread_bytes; empty if nothing is stored.
  std::vector<std::byte> finish() && {
    if (keeps_ == Keeps::records) {
      bytes_.resize(finished_bytes());
    }
    return std::move(bytes_);
  }

 private:
  std::size_t finished_bytes() const { return page_bytes() + overread_bytes; }

  /// Makes what has been allocated writable; capacity grows by factors.
  void cover() {
    if (bytes_.size() < end_) {
      bytes_.resize(end_);
    }
  }
  Address take(std::size_t offset, std::size_t bytes) {
    if (offset + bytes > bytes_max) {
      throw CapacityError("the scene's database would exceed 16 GiB: render a smaller scene");
    }
    end_ = std::max(end_, offset + bytes);
    return Address{static_cast<std::uint32_t>(offset / record_alignment)};
  }

  std::size_t page_size_;
  Keeps keeps_ = Keeps::records;
  std::vector<Address> instances_;
  std::vector<std::uint16_t> sizes_;
  std::size_t front_bytes_ = 0;
  std::size_t end_ = 0;         ///< end of the allocated memory
  std::size_t shared_end_ = 0;  ///< end of the shares of records, since there were some
  std::vector<std::byte> bytes_;
};

}  // namespace dmpc::core
