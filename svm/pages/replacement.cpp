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
      {"clock", "going round, the first page that was not looked up since the last time round", false, nothing, made<Clock>},
      {"fifo", "the page that came first", false, nothing, made<FirstInFirstOut>},
      {"random", "any page, with equal chances", false, nothing, made<RandomVictim>},
      {"2q", "of new pages the one that came first, of those that have come back the least recent", true, laid_out<TwoQueues>,
       made<TwoQueues>},
      {"arc", "of pages looked up once or again the least recent, whose share learns from pages that come back", true,
       laid_out<AdaptiveReplacement>, made<AdaptiveReplacement>},
      {"s3-fifo", "of a small queue and a main one the page that came first and was not looked up again", true,
       laid_out<SmallAndMain>, made<SmallAndMain>},
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
