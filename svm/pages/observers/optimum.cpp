#include "svm/pages/observers/optimum.h"

#include <algorithm>
#include <array>

#include "core/base/expect.h"
#include "nodes/local_memory.h"
#include "svm/pages/cache.h"

namespace dmpc::svm {

namespace {

constexpr std::uint32_t never = 0xffffffffU;

/// The cached pages by the time of their next reference. A referenced page leaves its old time behind, which is now past: it is
/// below every valid time, so it does not reach the top while there is one, and is removed later.
class Future {
 public:
  explicit Future(std::size_t cached_max) : size_max_(2 * cached_max + 1024) {}

  /// At time `now` a cached page is known to be referenced next at `time`.
  void add(std::uint32_t time, std::uint32_t now) {
    if (times_.size() == size_max_) {
      times_.erase(std::remove_if(times_.begin(), times_.end(), [now](std::uint32_t past) { return past <= now; }), times_.end());
      std::make_heap(times_.begin(), times_.end());
    }
    times_.push_back(time);
    std::push_heap(times_.begin(), times_.end());
  }
  /// Takes the page with the furthest reference.
  std::uint32_t take_furthest(std::uint32_t now) {
    core::expect(!times_.empty() && times_.front() > now, "a page of a full cache leaves");
    std::pop_heap(times_.begin(), times_.end());
    const std::uint32_t furthest = times_.back();
    times_.pop_back();
    return furthest;
  }

 private:
  std::size_t size_max_;
  std::vector<std::uint32_t> times_;
};

std::uint64_t all_miss(std::size_t references, const Missed& missed) {
  for (std::size_t reference = 0; missed && reference < references; ++reference) {
    missed(reference);
  }
  return references;
}

/// `shape` is that of a cache whose pages have one byte.
std::uint64_t misses_of(const CacheShape& shape, std::span<const PageId> references, std::uint32_t seed, const Missed& missed) {
  if (shape.frame_count == 0) {
    return all_miss(references.size(), missed);
  }
  constexpr std::array<std::byte, 1> page_bytes{};
  nodes::LocalMemory memory(Cache::layout(shape));
  Cache cache(memory, shape, seed);
  std::uint64_t misses = 0;
  PageId passing = no_page;
  for (std::size_t reference = 0; reference < references.size(); ++reference) {
    const PageId page = references[reference];
    if (page == passing) {
      continue;
    }
    passing = no_page;
    if (const std::uint32_t frame = cache.frame_of(page); frame != Cache::no_frame) {
      cache.touch(frame);
      continue;
    }
    ++misses;
    if (missed) {
      missed(reference);
    }
    passing = cache.install(page, page_bytes) == page ? page : no_page;
  }
  return misses;
}

}  // namespace

Optimum::Optimum(std::span<const PageId> references)
    : references_(references), page_bound_(page_bound_of(references)), next_(references.size(), never) {
  core::expect(references.size() < never, "references have 32-bit times");
  std::vector<std::uint32_t> next_of_page(page_bound_, never);
  for (std::size_t time = references.size(); time-- > 0;) {
    std::uint32_t& next = next_of_page[index_of(references[time])];
    next_[time] = next;
    next = static_cast<std::uint32_t>(time);
  }
}

std::uint64_t Optimum::misses(std::uint32_t cache_pages, const Missed& missed) const {
  if (cache_pages == 0) {
    return all_miss(references_.size(), missed);
  }
  std::vector<bool> is_cached(page_bound_);
  Future future(cache_pages);
  std::uint64_t misses = 0;
  std::uint32_t free_frames = cache_pages;
  for (std::uint32_t now = 0; now < references_.size(); ++now) {
    const std::uint32_t page = index_of(references_[now]);
    if (!is_cached[page]) {
      ++misses;
      if (missed) {
        missed(now);
      }
      if (free_frames > 0) {
        --free_frames;
      } else {
        is_cached[index_of(references_[future.take_furthest(now)])] = false;
      }
    }
    // A page that is never needed again is evicted at once in effect: its frame is free.
    is_cached[page] = next_[now] != never;
    if (is_cached[page]) {
      future.add(next_[now], now);
    } else {
      ++free_frames;
    }
  }
  return misses;
}

std::uint64_t policy_misses(Replacement replacement, std::span<const PageId> references, std::uint32_t cache_pages,
                            std::uint32_t seed, const Missed& missed) {
  return misses_of({cache_pages, 1, replacement}, references, seed, missed);
}

std::uint64_t policy_misses(OwnPolicyRun& policy, std::span<const PageId> references, std::uint32_t cache_pages,
                            std::uint32_t seed, const Missed& missed) {
  return misses_of({.frame_count = cache_pages, .page_size_bytes = 1, .own = &policy}, references, seed, missed);
}

}  // namespace dmpc::svm
