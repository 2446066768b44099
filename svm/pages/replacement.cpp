#include "svm/pages/replacement.h"

#include <algorithm>
#include <limits>
#include <vector>

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

std::vector<PolicyKind>& kinds() {
  static std::vector<PolicyKind> all = {
      {"lru", "the page that was looked up least recently", false, laid_out<LeastRecentlyUsed>, made<LeastRecentlyUsed>},
      {"clock", "the first page, in circular order, that was not looked up since the last round", false, nothing, made<Clock>},
      {"fifo", "the page that was cached first", false, nothing, made<FirstInFirstOut>},
      {"random", "a random page", false, nothing, made<RandomVictim>},
      {"2q", "the oldest of the new pages, or the least recently used of those that were fetched again", true,
       laid_out<TwoQueues>, made<TwoQueues>},
      {"arc",
       "the least recently used of the pages looked up once or of those looked up again, whose shares adapt to pages that are "
       "fetched again",
       true, laid_out<AdaptiveReplacement>, made<AdaptiveReplacement>},
      {"s3-fifo", "the first page of a small or a main queue that was not looked up again", true, laid_out<SmallAndMain>,
       made<SmallAndMain>},
  };
  return all;
}

}  // namespace

Replacement add_policy(const PolicyKind& kind) {
  std::vector<PolicyKind>& all = kinds();
  core::expect(all.size() < std::numeric_limits<std::uint8_t>::max(), "there are not too many replacement policies");
  core::expect(kind.layout != nullptr && kind.make != nullptr, "a replacement policy says what it needs, and is made");
  core::expect(std::none_of(all.begin(), all.end(), [&kind](const PolicyKind& other) { return other.name == kind.name; }),
               "a replacement policy has a name of its own");
  all.push_back(kind);
  return static_cast<Replacement>(all.size() - 1);
}

std::span<const PolicyKind> policy_kinds() { return kinds(); }

const PolicyKind& kind_of(Replacement replacement) {
  const auto index = static_cast<std::size_t>(replacement);
  core::expect(index < kinds().size(), "a replacement policy is one of those that there are");
  return kinds()[index];
}

}  // namespace dmpc::svm
