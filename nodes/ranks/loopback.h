// Several ranks in one process: a fabric for tests, chaos and the thread sanitizer.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "nodes/atomics.h"
#include "nodes/chaos.h"
#include "nodes/ranks/fabric.h"
#include "nodes/ranks/frame.h"

namespace dmpc::nodes {

/// What is wrong with it.
struct LoopbackTrouble {
  std::uint64_t seed = 0;
  std::uint32_t late_looks_max = 0;  ///< its receiver looks for a frame in vain up to this many times
  /// From one rank to another the frame of this number is lost.
  struct Loss {
    std::uint32_t from = 0, to = 0;
    std::uint64_t frame = 0;
  };
  std::optional<Loss> loss = std::nullopt;
  std::optional<std::uint32_t> dead_rank = std::nullopt;  ///< all that it sends is lost
};

/// Outlives the threads on which its ranks run. Thread safety: each rank's end belongs to one thread at a time.
class Loopback {
 public:
  explicit Loopback(std::uint32_t rank_count, const LoopbackTrouble& trouble = {}, std::size_t frame_bytes = frame_bytes_min);
  ~Loopback();

  Fabric& rank(std::uint32_t rank);

 private:
  /// From one rank to another: two frames, written and read in turn. `sent` is the writer's, `taken` the reader's.
  struct alignas(cache_line_bytes) Lane {
    struct Frame {
      std::vector<std::byte> bytes;
      std::size_t used_bytes = 0;
      std::uint32_t late_looks = 0;
    };
    std::array<Frame, 2> frames;
    std::uint64_t lost = 0;  ///< of the frames that were to be sent; the writer's
    std::atomic<std::uint64_t> sent{0}, taken{0};
  };
  class End;

  Lane& lane(std::uint32_t from, std::uint32_t to) { return lanes_[from * rank_count_ + to]; }

  std::uint32_t rank_count_;
  LoopbackTrouble trouble_;
  std::size_t frame_bytes_;
  std::vector<Lane> lanes_;  ///< by sender, then receiver
  std::vector<std::unique_ptr<End>> ends_;
};

}  // namespace dmpc::nodes
