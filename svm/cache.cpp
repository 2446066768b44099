#include "svm/cache.h"

#include <algorithm>
#include <bit>

#include "core/expect.h"
#include "core/records.h"

namespace dmpc::svm {
namespace {

using nodes::Category;
using nodes::LocalMemory;

std::size_t frame_bytes(std::uint32_t frame_count, std::size_t page_size_bytes) {
  return frame_count == 0 ? 0 : frame_count * page_size_bytes + core::overread_bytes;
}

}  // namespace

/// At most half full, so that a search ends soon; at least 2, so that the shift of the hash stays below 32.
std::size_t Cache::table_size(std::uint32_t frame_count) {
  return std::bit_ceil(std::max<std::size_t>(2 * std::size_t{frame_count}, 2));
}

std::size_t Cache::candidate_capacity(std::uint32_t frame_count) { return std::min(frame_count, candidate_count_max); }

void Cache::add_needs(nodes::MemoryPlan& plan, std::uint32_t frame_count, std::size_t page_size_bytes) {
  plan[Category::cache_frames] += LocalMemory::bytes_for<std::byte>(frame_bytes(frame_count, page_size_bytes));
  plan[Category::page_table] += LocalMemory::bytes_for<Entry>(table_size(frame_count));
  plan[Category::page_table] += LocalMemory::bytes_for<std::uint64_t>(frame_count);
  plan[Category::page_table] += LocalMemory::bytes_for<PageId>(frame_count);
  plan[Category::page_table] += LocalMemory::bytes_for<Candidate>(candidate_capacity(frame_count));
}

Cache::Cache(LocalMemory& memory, std::uint32_t frame_count, std::size_t page_size_bytes)
    : page_size_bytes_(page_size_bytes),
      hash_shift_(32U - static_cast<std::uint32_t>(std::countr_zero(table_size(frame_count)))),
      frames_(memory.allocate<std::byte>(Category::cache_frames, frame_bytes(frame_count, page_size_bytes))),
      table_(memory.allocate<Entry>(Category::page_table, table_size(frame_count))),
      stamps_(memory.allocate<std::uint64_t>(Category::page_table, frame_count)),
      pages_(memory.allocate<PageId>(Category::page_table, frame_count)),
      candidates_(memory.allocate<Candidate>(Category::page_table, candidate_capacity(frame_count))) {
  std::fill(pages_.begin(), pages_.end(), no_page);
}

PageId Cache::install(PageId page, std::span<const std::byte> bytes) {
  core::expect(!stamps_.empty(), "a page is installed only where there is a frame");
  core::expect(bytes.size() == page_size_bytes_, "an installed page is whole");
  core::expect(frame_of(page) == no_frame, "a page is in at most one frame");
  const std::uint32_t frame = least_recently_used();
  const PageId evicted = pages_[frame];
  if (evicted != no_page) {
    erase(evicted);
  }
  std::copy(bytes.begin(), bytes.end(), frames_.begin() + static_cast<std::ptrdiff_t>(frame * page_size_bytes_));
  pages_[frame] = page;
  stamps_[frame] = ++clock_;
  insert(page, frame);
  return evicted;
}

std::uint32_t Cache::least_recently_used() {
  while (true) {
    while (next_candidate_ < candidate_count_) {
      const Candidate& candidate = candidates_[next_candidate_++];
      if (stamps_[candidate.frame] == candidate.stamp) {
        return candidate.frame;
      }
    }
    seek_candidates();
  }
}

/// One pass with a heap whose top is the youngest of the oldest. Stamp 0 may be shared by empty frames: these go in frame
/// order.
void Cache::seek_candidates() {
  const auto older = [](const Candidate& a, const Candidate& b) {
    return a.stamp < b.stamp || (a.stamp == b.stamp && a.frame < b.frame);
  };
  const auto begin = candidates_.begin();
  auto end = begin;
  for (std::uint32_t frame = 0; frame < frame_count(); ++frame) {
    if (end != candidates_.end()) {
      *end++ = {stamps_[frame], frame};
      std::push_heap(begin, end, older);
    } else if (stamps_[frame] < begin->stamp) {
      std::pop_heap(begin, end, older);
      *(end - 1) = {stamps_[frame], frame};
      std::push_heap(begin, end, older);
    }
  }
  std::sort_heap(begin, end, older);
  candidate_count_ = static_cast<std::size_t>(end - begin);
  next_candidate_ = 0;
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
