#include "svm/pages/replacement.h"

#include <array>

#include "core/base/expect.h"
#include "svm/pages/policy/remembering.h"
#include "svm/pages/policy/small_and_main.h"
#include "svm/pages/policy/stamped.h"

namespace dmpc::svm {
namespace {

nodes::MemoryPlan nothing(std::uint32_t /*frame_count*/) { return {}; }

template <class Policy>
nodes::MemoryPlan laid_out(std::uint32_t frame_count) {
  return Policy::layout(frame_count);
}

template <class Policy>
std::unique_ptr<ReplacementPolicy> made(const PolicySite& site) {
  return std::make_unique<Policy>(site);
}

constexpr std::array kinds = {
    PolicyKind{"lru", "the page that was looked up least recently", false, laid_out<LeastRecentlyUsed>, made<LeastRecentlyUsed>},
    PolicyKind{"clock", "the first page, in circular order, that was not looked up since the last round", false, nothing,
               made<Clock>},
    PolicyKind{"fifo", "the page that was cached first", false, nothing, made<FirstInFirstOut>},
    PolicyKind{"random", "a random page", false, nothing, made<RandomVictim>},
    PolicyKind{"2q", "the oldest of the new pages, or the least recently used of those that were fetched again", true,
               laid_out<TwoQueues>, made<TwoQueues>},
    PolicyKind{
        "arc",
        "the least recently used of the pages looked up once or of those looked up again, whose shares adapt to pages that are "
        "fetched again",
        true, laid_out<AdaptiveReplacement>, made<AdaptiveReplacement>},
    PolicyKind{"s3-fifo", "the first page of a small or a main queue that was not looked up again", true, laid_out<SmallAndMain>,
               made<SmallAndMain>},
};

}  // namespace

std::span<const PolicyKind> policy_kinds() { return kinds; }

const PolicyKind& kind_of(Replacement replacement) {
  const auto index = static_cast<std::size_t>(replacement);
  core::expect(index < kinds.size(), "a replacement policy is one of those that there are");
  return kinds[index];
}

}  // namespace dmpc::svm
