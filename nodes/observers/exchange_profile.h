// The traffic between the nodes of a modelled machine over time, and their fill levels; an instrument outside of the computer,
// whose memory is no node's.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "nodes/observer.h"
#include "nodes/observers/step_counts.h"
#include "nodes/program.h"
#include "nodes/topology.h"

namespace dmpc::nodes {

/// What an ExchangeProfile records.
struct ExchangeChoice {
  std::uint32_t node_count = 1;
  TopologyKind topology = TopologyKind::crossbar;
  std::uint32_t uplinks = 1;
  std::uint32_t pair_kinds = 0;    ///< a bit for each kind of packet that counts between pairs
  std::uint32_t number_count = 0;  ///< these packets begin with a number below it, by which they are counted, too; 0: they do not
};

/// For one run on a modelled machine, which is on one thread: not thread-safe. Memory: at most 24 MB, and 4 bytes a pair of
/// nodes.
class ExchangeProfile final : public Observer {
 public:
  explicit ExchangeProfile(const ExchangeChoice& choice);

  void ended(const Span& span, const Program& program) override;
  void received(const Passing& packet) override;

  /// Packets that count: for each receiver, the host being the last, from a sender at receiver * (node_count + 1) + sender.
  const StepCounts& pairs() const { return pairs_; }
  /// These packets by their first number.
  const StepCounts& numbers() const { return numbers_; }
  /// Bytes that a link has carried, including headers, by arrival time. `from` and `to` are named as in LinkUse; empty for a link
  /// that carried nothing, and for a memory port.
  std::span<const std::uint64_t> link_bytes(std::string_view from, std::string_view to) const;
  const StepCounts& links() const { return links_; }

  const std::vector<std::string>& level_names() const { return level_names_; }
  /// The maximum of each node's level in each step, summed over nodes.
  std::vector<std::uint64_t> level_sums(std::size_t level) const;
  const StepCounts& levels() const { return levels_; }

 private:
  /// A link that begins at a place.
  struct LinkTo {
    std::uint32_t to = 0, number = 0;
  };
  /// A node's levels as reported last.
  struct LevelsNow {
    std::uint64_t time_ns = 0;
    std::array<std::uint64_t, Levels::count_max> values{};
  };

  std::uint32_t host_place() const { return topology_.place_count(); }
  std::uint32_t place_of(std::string_view name) const;
  void pass_links(const Passing& packet);
  std::uint32_t number_of(const Link& link);

  ExchangeChoice choice_;
  Topology topology_;
  StepCounts pairs_, numbers_, links_, levels_;
  std::vector<std::vector<LinkTo>> links_from_;  ///< by place
  std::uint32_t link_count_ = 0;
  std::vector<Link> route_;
  std::vector<std::string> level_names_;
  std::vector<LevelsNow> levels_now_;  ///< by node
};

}  // namespace dmpc::nodes
