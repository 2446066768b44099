// Runs the node programs on several ranks, each a process with a share of the nodes, on one thread per node or on a pool, and a
// communicating thread if they do not communicate themselves.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "nodes/chaos.h"
#include "nodes/ranks/outbox.h"
#include "nodes/ranks/rank_links.h"
#include "nodes/runner.h"

namespace dmpc::nodes {

/// As Runner, but node() and program() have only this rank's nodes. The calling thread is the one that communicates.
class RanksRunner final : public Runner {
 public:
  /// All ranks have equal specifications, of all nodes, then the host; no programs are made for those elsewhere. There are at
  /// least as many nodes as ranks, and every packet fits a frame. `links` and `observer` outlive this. An observer, which rank 0
  /// must have if any rank has one, gets reports of this rank's nodes, by its own clock, which is set to that of rank 0 before
  /// the start and compared with it again after a regular end. `pool_threads`: as in ComputerRequest, per rank.
  RanksRunner(std::span<const NodeSpecification> specifications, RankLinks& links,
              const std::optional<Chaos>& chaos = std::nullopt, Observer* observer = nullptr,
              const std::optional<std::uint32_t>& pool_threads = std::nullopt);
  ~RanksRunner() override;

  /// To be called on all ranks; again, when all have gathered, and rank 0 knows that all are about to. The end and a deadlock are
  /// detected exactly, without a timeout. It ends in the same way on all ranks: what fails on one fails on the others, with its
  /// rank and text; a stop that is requested on one stops all. A deadlock's report has all nodes on rank 0, and its own on
  /// others. Throws FabricError if a frame is lost, LostRank if a rank is.
  RunEnd run(std::stop_token stop) override;
  Node& node(std::size_t index) override;
  Program& program(std::size_t index) override;

  bool is_here(std::size_t index) const override;
  /// To be called on all ranks, or on none.
  std::vector<std::string> gather(const Report& report) override;
  /// Likewise, after gather().
  std::vector<RankReport> gather_ranks(const std::string& reported) override;
  /// After run(): up to the end of the exchange on how it had ended.
  RankTraffic traffic() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace dmpc::nodes
