// A library with a policy that keeps the dearest pages, and does not cache one that is no dearer than any of them; with
// DMPC_OLD_VERSION its table is of version 1, so that it hears no prices and caches nothing once all frames are full.

#include <dmpc/policy.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace {

class Dear final : public dmpc::Policy {
 public:
  Dear(std::uint32_t frame_count, std::uint32_t /*node*/) : prices_(frame_count) {}

  void price(std::uint32_t /*page*/, std::uint32_t price) override { price_ = price; }
  void insert(std::uint32_t /*page*/, std::uint32_t frame) override { prices_[frame] = price_; }
  std::uint32_t victim(std::uint32_t /*incoming*/) override {
    const auto cheapest = std::min_element(prices_.begin(), prices_.end());
    return price_ > *cheapest ? static_cast<std::uint32_t>(cheapest - prices_.begin()) : dmpc::bypass;
  }

 private:
  std::vector<std::uint32_t> prices_;  ///< by frame
  std::uint32_t price_ = 0;
};

}  // namespace

#ifdef DMPC_OLD_VERSION
using Calls = dmpc::policy_detail::Calls<Dear>;
extern "C" __attribute__((visibility("default"))) const dmpc::PolicyTable dmpc_policy;
const dmpc::PolicyTable dmpc_policy = {
    1,
    "old",
    Calls::make,
    Calls::hit,
    Calls::insert,
    Calls::victim,
    Calls::drop,
    [](void*, std::uint32_t, std::uint32_t) -> const char* { return "a table of version 1 has no price()"; }};
#else
DMPC_POLICY(Dear, "dear");
#endif
