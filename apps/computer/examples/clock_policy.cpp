// The clock as a user-defined replacement policy: a hand moves around the frames and clears the reference mark of each until it
// finds one without a mark (F. J. Corbato, "A Paging Experiment with the Multics System", 1968). A newly arrived page has a mark.
//
//   dmpc study references trace.csv --policy=$PWD/build/libclock_policy.so
//
// adds a column beside dmpc's own clock, with the same faults. Result: another rule is another victim().
#include <dmpc/policy.h>

#include <cstdint>
#include <vector>

class Clock final : public dmpc::Policy {
 public:
  Clock(std::uint32_t frame_count, std::uint32_t /*node*/) : has_mark_(frame_count) {}

  void hit(std::uint32_t /*page*/, std::uint32_t frame) override { has_mark_[frame] = true; }
  void insert(std::uint32_t /*page*/, std::uint32_t frame) override { has_mark_[frame] = true; }
  std::uint32_t victim(std::uint32_t /*incoming*/) override {
    while (has_mark_[hand_]) {
      has_mark_[hand_] = false;
      go_on();
    }
    const std::uint32_t frame = hand_;
    go_on();
    return frame;
  }

 private:
  void go_on() { hand_ = hand_ + 1 < has_mark_.size() ? hand_ + 1 : 0; }

  std::vector<bool> has_mark_;
  std::uint32_t hand_ = 0;
};

DMPC_POLICY(Clock, "my-clock");
