// The transport between the processes of a computer that is distributed over several: the interface to MPI and the like.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>

namespace dmpc::nodes {

/// Ranks are lost, or data of theirs is: no fault of this process.
struct FabricError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A rank is gone, or the connection to it: there is no orderly end.
struct LostRank : FabricError {
  using FabricError::FabricError;
};

/// A received frame.
struct Arrival {
  std::uint32_t rank = 0;  ///< its sender
  std::span<const std::byte> frame;
};

/// One rank's endpoint. Frames from one rank to another arrive whole and in the order in which they were sent; nothing else is
/// required. Two to each rank may be in flight. It throws LostRank if it fails. Thread safety: belongs to one thread at a time.
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
  /// Memory of each rank for received frames.
  virtual std::size_t arrival_bytes() const = 0;
  /// The buffer for the next frame to another rank, frame_bytes() long; the same until it is sent. Empty while two are in flight.
  virtual std::span<std::byte> room(std::uint32_t rank) = 0;
  /// Sends the first `bytes` of room().
  virtual void send(std::uint32_t rank, std::size_t bytes) = 0;
  /// The next received frame, if there is one; it is valid until the next call.
  virtual std::optional<Arrival> take() = 0;
};

}  // namespace dmpc::nodes
