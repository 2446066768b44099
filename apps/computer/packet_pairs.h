// Counts the traffic between pairs of nodes, outside of the emulated memory.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "nodes/flat_bytes.h"
#include "nodes/observer.h"

namespace dmpc::apps {

/// One entry per pair: traffic from node a to node b is at index a * node_count + b.
struct PacketPairs {
  std::vector<std::uint64_t> packets;
  std::vector<std::uint64_t> bytes;  ///< headers and payloads
};

/// Counts what is sent. Thread-safe as an Observer; call pairs() after the run.
class PairObserver final : public nodes::Observer {
 public:
  explicit PairObserver(std::uint32_t node_count);

  void ended(const nodes::Span&, const nodes::Program&) override {}
  void sent(const nodes::Passing& packet) override;
  void received(const nodes::Passing&) override {}
  void worked(const nodes::Worked&) override {}

  /// Serializes the traffic sent by local nodes, for add() on another rank.
  std::string bytes() const;
  void add(std::string_view bytes);

  const PacketPairs& pairs() const { return pairs_; }

 private:
  std::uint32_t node_count_;
  PacketPairs pairs_;
};

}  // namespace dmpc::apps
