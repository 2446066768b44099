#include "svm/pages/watch/policy_misses.h"

#include <array>
#include <cstddef>

#include "nodes/local_memory.h"
#include "svm/pages/cache.h"

namespace dmpc::svm {

std::uint64_t policy_misses(Replacement replacement, std::span<const PageId> references, std::uint32_t cache_pages,
                            std::uint32_t seed) {
  if (cache_pages == 0) {
    return references.size();
  }
  constexpr std::array<std::byte, 1> page_bytes{};
  const CacheShape shape{cache_pages, page_bytes.size(), replacement};
  nodes::LocalMemory memory(Cache::layout(shape));
  Cache cache(memory, shape, seed);
  std::uint64_t misses = 0;
  for (const PageId page : references) {
    if (const std::uint32_t frame = cache.frame_of(page); frame != Cache::no_frame) {
      cache.touch(frame);
    } else {
      ++misses;
      cache.install(page, page_bytes);
    }
  }
  return misses;
}

}  // namespace dmpc::svm
