// A library with a policy that does something else wrong with caches of each size; with DMPC_OTHER_VERSION a policy of another
// version.

#include <dmpc/policy.h>

#include <cstdio>
#include <cstdlib>
#include <stdexcept>

namespace {

class Hostile final : public dmpc::Policy {
 public:
  Hostile(std::uint32_t frame_count, std::uint32_t /*node*/) : frame_count_(frame_count) {
    if (frame_count == 2) {
      throw std::length_error("two are too few");
    }
  }
  std::uint32_t victim(std::uint32_t /*incoming*/) override {
    switch (frame_count_) {
      case 3:
        throw std::runtime_error("no idea");
      case 4:
        return 4;
      case 5:
        *volatile_nothing = 1;
        return 0;
      case 6:
        std::exit(0);
      case 7:
        std::abort();
      case 8:
        while (true) std::fputs("", stderr);
      case 9:
        while (true) std::puts("a line of which there are a great many, until somebody has had enough of them");
      case 10:
        throw 7;
      default:
        return 0;
    }
  }
  void hit(std::uint32_t page, std::uint32_t frame) override { deep_ = frame_count_ == 11 ? fall(page + frame) : deep_; }

 private:
  static int fall(std::uint32_t depth) {
    volatile char stack[1000] = {static_cast<char>(depth)};
    return depth == 0 ? 0 : fall(depth + 1) + stack[depth % 1000];  // 0 after four billions
  }
  static inline volatile int* volatile volatile_nothing = nullptr;
  std::uint32_t frame_count_;
  int deep_ = 0;
};

}  // namespace

#ifdef DMPC_OTHER_VERSION
extern "C" __attribute__((visibility("default"))) const dmpc::PolicyTable dmpc_policy;
const dmpc::PolicyTable dmpc_policy = {dmpc::policy_version + 1, "hostile", nullptr, nullptr, nullptr, nullptr, nullptr, nullptr};
#else
DMPC_POLICY(Hostile, "hostile");
#endif
