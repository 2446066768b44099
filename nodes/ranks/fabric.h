// What carries bytes between the processes of a computer that is spread over several: the seam to MPI and its like.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>

namespace dmpc::nodes {

/// Ranks are lost, or what they send is: nothing that this process has done wrong.
struct FabricError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A rank is gone, or the way to it: there is no orderly end.
struct LostRank : FabricError {
  using FabricError::FabricError;
};

/// A frame that has come.
struct Arrival {
  std::uint32_t rank = 0;  ///< its sender
  std::span<const std::byte> frame;
};

/// One rank's end of it. Frames from one rank to another arrive whole and in the order in which they were sent; of more it need
/// not know anything. Two to each rank may be under way. What it can no longer do is a LostRank. Thread safety: belongs to one
/// thread at a time.
class Fabric {
 public:
  virtual ~Fabric() = default;

  /// 0 .. rank_count() - 1.
  virtual std::uint32_t rank() const = 0;
  virtual std::uint32_t rank_count() const = 0;
  /// For messages: "rank 2 on host b".
  virtual std::string name_of(std::uint32_t rank) const = 0;

  /// The longest frame, the same on all ranks.
  virtual std::size_t frame_bytes() const = 0;
  /// What each rank sets aside for frames that have come.
  virtual std::size_t arrival_bytes() const = 0;
  /// Where the next frame to another rank is put together, frame_bytes() long; the same until it is sent. Empty while two are
  /// under way.
  virtual std::span<std::byte> room(std::uint32_t rank) = 0;
  /// Sends the first `bytes` of the room.
  virtual void send(std::uint32_t rank, std::size_t bytes) = 0;
  /// The next frame that has come, if one has; it lasts until the next call.
  virtual std::optional<Arrival> take() = 0;
};

}  // namespace dmpc::nodes
