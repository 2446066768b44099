#include "svm/cache.h"

#include <algorithm>
#include <bit>

#include "core/base/expect.h"
#include "core/record/records.h"

namespace dmpc::svm {
namespace {

using nodes::Category;
using nodes::LocalMemory;

std::size_t frame_bytes(const CacheShape& shape) {
  return shape.frame_count == 0 ? 0 : shape.frame_count * shape.page_size_bytes + core::overread_bytes;
}

}  // namespace

/// At most half full, so that a search ends soon; at least 2, so that the shift of the hash stays below 32.
std::size_t Cache::table_size(std::uint32_t frame_count) {
  return std::bit_ceil(std::max<std::size_t>(2 * std::size_t{frame_count}, 2));
}

void Cache::add_needs(nodes::MemoryPlan& plan, const CacheShape& shape) {
  nodes::LastingPieces::add_needs(plan, Category::cache_frames, frame_bytes(shape));
  plan[Category::page_table] += LocalMemory::bytes_for<Entry>(table_size(shape.frame_count));
  plan[Category::page_table] += LocalMemory::bytes_for<std::uint64_t>(shape.frame_count);
  plan[Category::page_table] += LocalMemory::bytes_for<PageId>(shape.frame_count);
  VictimChoice::add_needs(plan, shape.replacement, shape.frame_count);
}

Cache::Cache(LocalMemory& memory, const CacheShape& shape, std::uint32_t seed)
    : hash_shift_(32U - static_cast<std::uint32_t>(std::countr_zero(table_size(shape.frame_count)))),
      frames_(memory, Category::cache_frames, frame_bytes(shape), shape.page_size_bytes),
      table_(memory.allocate<Entry>(Category::page_table, table_size(shape.frame_count))),
      stamps_(memory.allocate<std::uint64_t>(Category::page_table, shape.frame_count)),
      pages_(memory.allocate<PageId>(Category::page_table, shape.frame_count)),
      victims_(memory, shape.replacement, shape.frame_count, seed) {}

PageId Cache::install(PageId page, std::span<const std::byte> bytes) {
  return install_by(page, [&](std::uint32_t frame) { frames_.put(frame, bytes); });
}

PageId Cache::install(PageId page, const nodes::ByteSource& source, std::size_t offset_bytes) {
  return install_by(page, [&](std::uint32_t frame) { frames_.put(frame, source, offset_bytes); });
}

template <class Put>
PageId Cache::install_by(PageId page, const Put& put) {
  core::expect(!stamps_.empty(), "a page is installed only where there is a frame");
  core::expect(frame_of(page) == no_frame, "a page is in at most one frame");
  const bool is_full = filled_count_ == frame_count();
  const std::uint32_t frame = is_full ? victims_.victim(stamps_) : filled_count_++;
  const PageId evicted = is_full ? pages_[frame] : no_page;
  if (is_full) {
    erase(evicted);
  }
  put(frame);
  pages_[frame] = page;
  stamps_[frame] = ++clock_;
  insert(page, frame);
  return evicted;
}

void Cache::insert(PageId page, std::uint32_t frame) {
  std::size_t place = start_of(page);
  while (table_[place].page != no_page) {
    place = after(place);
  }
  table_[place] = {page, frame};
}

/// Closes the gap by moving back every later entry of the run that may stand there, so that no search ends too early
/// (D. E. Knuth, The Art of Computer Programming 3, section 6.4, algorithm R).
void Cache::erase(PageId page) {
  const std::size_t mask = table_.size() - 1;
  std::size_t gap = start_of(page);
  while (table_[gap].page != page) {
    core::expect(table_[gap].page != no_page, "the table finds every page that is in a frame");
    gap = after(gap);
  }
  for (std::size_t place = after(gap); table_[place].page != no_page; place = after(place)) {
    const std::size_t distance_from_start = (place - start_of(table_[place].page)) & mask;
    if (distance_from_start >= ((place - gap) & mask)) {
      table_[gap] = table_[place];
      gap = place;
    }
  }
  table_[gap] = {};
}

}  // namespace dmpc::svm
