// Ranks of one process, each on a thread of its own: for tests, chaos and the thread sanitizer.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <type_traits>
#include <vector>

#include "core/base/expect.h"
#include "nodes/atomics.h"
#include "nodes/chaos.h"
#include "nodes/ranks/fabric.h"
#include "nodes/ranks/frame.h"

namespace dmpc::nodes {

/// What is wrong with it.
struct LoopbackTrouble {
  std::uint64_t seed = 0;
  std::uint32_t late_polls_max = 0;  ///< its receiver looks for a frame in vain up to this many times
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
  explicit Loopback(std::uint32_t rank_count, const LoopbackTrouble& trouble = {}, std::size_t frame_bytes = frame_bytes_min)
      : rank_count_(rank_count), trouble_(trouble), frame_bytes_(frame_bytes), lanes_(std::size_t{rank_count} * rank_count) {
    core::expect(rank_count > 0, "there is a rank");
    for (Lane& lane : lanes_) {
      for (Lane::Frame& frame : lane.frames) {
        frame.bytes.resize(frame_bytes);
      }
    }
    for (std::uint32_t rank = 0; rank < rank_count; ++rank) {
      ends_.push_back(std::make_unique<End>(*this, rank));
    }
  }

  Fabric& rank(std::uint32_t rank) { return *ends_.at(rank); }

 private:
  /// From one rank to another: two frames, written and read in turn. `sent` is the writer's, `taken` the reader's.
  struct alignas(cache_line_bytes) Lane {
    struct Frame {
      std::vector<std::byte> bytes;
      std::size_t used_bytes = 0;
      std::uint32_t late_polls = 0;
    };
    std::array<Frame, 2> frames;
    std::uint64_t lost = 0;  ///< frames to be sent; the writer's
    std::atomic<std::uint64_t> sent{0}, taken{0};
  };
  class End final : public Fabric {
   public:
    End(Loopback& of, std::uint32_t rank) : of_(&of), rank_(rank), lateness_(core::mix(of.trouble_.seed) + rank) {}

    std::uint32_t rank() const override { return rank_; }
    std::uint32_t rank_count() const override { return of_->rank_count_; }
    std::string name_of(std::uint32_t rank) const override { return "rank " + std::to_string(rank); }

    std::size_t frame_bytes() const override { return of_->frame_bytes_; }
    /// Frames are read where they were written.
    std::size_t arrival_bytes() const override { return 0; }

    std::span<std::byte> room(std::uint32_t rank) override {
      Lane& lane = of_->lane(rank_, rank);
      const std::uint64_t sent = lane.sent.load(std::memory_order_relaxed);
      // Acquire: partner of the release in give_back(); the reader is done with the frame that lay there.
      const bool is_free = sent - lane.taken.load(std::memory_order_acquire) < lane.frames.size();
      return is_free ? std::span(lane.frames[sent % lane.frames.size()].bytes) : std::span<std::byte>();
    }

    void send(std::uint32_t rank, std::size_t bytes) override {
      Lane& lane = of_->lane(rank_, rank);
      const std::uint64_t sent = lane.sent.load(std::memory_order_relaxed);
      if (is_lost(rank, sent + lane.lost)) {
        ++lane.lost;
        return;
      }
      Lane::Frame& frame = lane.frames[sent % lane.frames.size()];
      frame.used_bytes = bytes;
      frame.late_polls = lateness_.below(of_->trouble_.late_polls_max + 1);
      lane.sent.store(sent + 1, std::memory_order_release);  // partner: take()
    }

    std::optional<Arrival> take() override {
      give_back();
      for (std::uint32_t turn = 0; turn < rank_count(); ++turn) {
        next_ = (next_ + 1) % rank_count();
        Lane& lane = of_->lane(next_, rank_);
        const std::uint64_t taken = lane.taken.load(std::memory_order_relaxed);
        if (lane.sent.load(std::memory_order_acquire) == taken) {  // partner: send()
          continue;
        }
        Lane::Frame& frame = lane.frames[taken % lane.frames.size()];
        if (frame.late_polls > 0) {
          --frame.late_polls;
          continue;
        }
        held_ = &lane;
        return Arrival{next_, std::span(frame.bytes).first(frame.used_bytes)};
      }
      return std::nullopt;
    }

   private:
    bool is_lost(std::uint32_t to, std::uint64_t frame) const {
      const LoopbackTrouble& trouble = of_->trouble_;
      return trouble.dead_rank == rank_ ||
             (trouble.loss && trouble.loss->from == rank_ && trouble.loss->to == to && trouble.loss->frame == frame);
    }

    /// The frame that was taken last.
    void give_back() {
      if (held_ != nullptr) {
        held_->taken.fetch_add(1, std::memory_order_release);  // partner: room()
        held_ = nullptr;
      }
    }

    Loopback* of_;
    std::uint32_t rank_;
    ChaosStream lateness_;
    std::uint32_t next_ = 0;  ///< the rank that was looked at last
    Lane* held_ = nullptr;
  };

  Lane& lane(std::uint32_t from, std::uint32_t to) { return lanes_[from * rank_count_ + to]; }

  std::uint32_t rank_count_;
  LoopbackTrouble trouble_;
  std::size_t frame_bytes_;
  std::vector<Lane> lanes_;  ///< by sender, then receiver
  std::vector<std::unique_ptr<End>> ends_;
};

}  // namespace dmpc::nodes

namespace dmpc::tests {

/// What a rank's function returned, or threw.
template <class T>
struct RankResult {
  std::optional<T> value;
  std::exception_ptr failure;

  /// Empty without a failure.
  std::string failure_text() const {
    try {
      if (failure) {
        std::rethrow_exception(failure);
      }
    } catch (const std::exception& error) {
      return error.what();
    }
    return {};
  }
};

/// Calls run(fabric) for each rank. By rank.
template <class Run>
auto on_ranks(std::uint32_t rank_count, const nodes::LoopbackTrouble& trouble, const Run& run,
              std::size_t frame_bytes = nodes::frame_bytes_min) {
  using T = std::invoke_result_t<const Run&, nodes::Fabric&>;
  nodes::Loopback loopback(rank_count, trouble, frame_bytes);
  std::vector<RankResult<T>> results(rank_count);
  {
    std::vector<std::jthread> threads;
    for (std::uint32_t rank = 0; rank < rank_count; ++rank) {
      threads.emplace_back([&, rank] {
        try {
          results[rank].value.emplace(run(loopback.rank(rank)));
        } catch (...) {
          results[rank].failure = std::current_exception();
        }
      });
    }
  }
  return results;
}

}  // namespace dmpc::tests
