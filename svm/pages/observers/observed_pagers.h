// Pagers that also record references: which pages, or how many distinct ones per pixel. They are types of their own, so that
// normal runs pay nothing for it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/units.h"
#include "svm/pages/observers/reference_log.h"
#include "svm/pages/pager.h"

namespace dmpc::svm {

/// Keeps one bit per page for each pixel in flight. Call select() before a slot runs, and forget() when a pixel starts in it. Not
/// thread-safe.
class CountingPager : public Pager {
 public:
  CountingPager(nodes::Node& node, const PageCapacity& capacity, const nodes::ByteSource& database)
      : Pager(node, capacity, database),
        geometry_(capacity.page_size_bytes()),
        words_per_slot_(words_for(capacity.page_count)),
        seen_(own_layout(capacity).in(node.memory())) {}
  /// The memory that the constructor takes in addition to Pager's.
  static nodes::Room<std::uint64_t> own_layout(const PageCapacity& capacity) {
    return {nodes::Category::queues, capacity.in_flight * words_for(capacity.page_count)};
  }

  /// Hides Pager's: counts the page, then looks it up.
  const std::byte* find(core::Address address) {
    note(index_of(geometry_.page_of(address)));
    return Pager::find(address);
  }

  /// References from now on belong to the pixel in `slot`.
  void select(std::uint32_t slot) { selected_ = seen_.subspan(slot * words_per_slot_, words_per_slot_); }
  /// The selected slot starts another pixel.
  void forget() { std::fill(selected_.begin(), selected_.end(), 0); }

  PageCounters counters() const {
    PageCounters counters = Pager::counters();
    counters.distinct_pages = distinct_pages_;
    return counters;
  }

 private:
  static std::size_t words_for(std::uint32_t page_count) { return core::ceil_divide<std::size_t>(page_count, 64); }

  void note(std::uint32_t page) {
    std::uint64_t& word = selected_[page / 64];
    const std::uint64_t bit = std::uint64_t{1} << (page % 64);
    distinct_pages_ += (word & bit) == 0 ? 1 : 0;
    word |= bit;
  }

  PageGeometry geometry_;
  std::size_t words_per_slot_;
  std::span<std::uint64_t> seen_;
  std::span<std::uint64_t> selected_;
  std::uint64_t distinct_pages_ = 0;
};
static_assert(core::Records<CountingPager>);

/// Records a reference when it is answered, so retrying a step after its page has arrived is recorded once. Pages that are stored
/// here permanently are left out: they need no frame. Takes as much local memory as a Pager; the log lies outside. Not
/// thread-safe.
class RecordingPager : public Pager {
 public:
  RecordingPager(nodes::Node& node, const PageCapacity& capacity, const nodes::ByteSource& database)
      : Pager(node, capacity, database), geometry_(capacity.page_size_bytes()) {}

  /// To be called once, before the first reference. `log` outlives this.
  void record_into(ReferenceLog& log) { log_ = &log; }

  /// Hides Pager's: looks the page up, then records it.
  const std::byte* find(core::Address address) {
    const std::byte* const record = Pager::find(address);
    const PageId page = geometry_.page_of(address);
    if (record != nullptr && !keeps(page)) {
      log_->note(page);
    }
    return record;
  }

 private:
  PageGeometry geometry_;
  ReferenceLog* log_ = nullptr;
};
static_assert(core::Records<RecordingPager>);

}  // namespace dmpc::svm
