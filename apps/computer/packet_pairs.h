// Who sends whom how much: an instrument beside the computer, whose memory is no node's.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "nodes/flat_bytes.h"
#include "nodes/observer.h"

namespace dmpc::apps {

/// By pair of nodes: what node a sent to node b stands at a * node_count + b.
struct PacketPairs {
  std::vector<std::uint64_t> packets;
  std::vector<std::uint64_t> bytes;  ///< headers and payloads
};

/// Counts what is sent. Thread safety: as an Observer; pairs() when the run is over.
class PairObserver final : public nodes::Observer {
 public:
  explicit PairObserver(std::uint32_t node_count);

  void ended(const nodes::Span&, const nodes::Program&) override {}
  void sent(const nodes::Passing& packet) override;
  void received(const nodes::Passing&) override {}
  void worked(const nodes::Worked&) override {}

  /// What nodes that are here have sent, for add() of another rank's.
  std::string bytes() const;
  void add(std::string_view bytes);

  const PacketPairs& pairs() const { return pairs_; }

 private:
  std::uint32_t node_count_;
  PacketPairs pairs_;
};

}  // namespace dmpc::apps
