// A library with dmpc's own default, the page that was looked up least recently, as somebody else would write it.

#include <dmpc/policy.h>

#include <cstdint>
#include <list>
#include <vector>

namespace {

class Lru final : public dmpc::Policy {
 public:
  Lru(std::uint32_t frame_count, std::uint32_t /*node*/) : places_(frame_count, order_.end()) {}

  void hit(std::uint32_t /*page*/, std::uint32_t frame) override { order_.splice(order_.begin(), order_, places_[frame]); }
  void insert(std::uint32_t page, std::uint32_t frame) override {
    if (places_[frame] == order_.end()) {
      places_[frame] = order_.insert(order_.begin(), frame);
    } else {
      hit(page, frame);
    }
  }
  std::uint32_t victim(std::uint32_t /*incoming*/) override { return order_.back(); }

 private:
  std::list<std::uint32_t> order_;  ///< frames, the latest in front
  std::vector<std::list<std::uint32_t>::iterator> places_;
};

}  // namespace

DMPC_POLICY(Lru, "my-lru");
