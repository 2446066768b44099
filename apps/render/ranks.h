// `render` on several ranks: rank 0 does everything except running the others' nodes.
#pragma once

#include <cstddef>
#include <functional>
#include <stop_token>

#include "apps/run/render_options.h"
#include "nodes/ranks/fabric.h"
#include "nodes/ranks/rank_links.h"

namespace dmpc::apps {

/// The maximum payload of packets in a render with these options.
std::size_t payload_bytes_max(const RenderOptions& options);

/// Throws core::UsageError, in words of the command line, if there are fewer nodes than ranks or more than the strategy allows.
void check_nodes_on_ranks(const RenderOptions& options, std::uint32_t rank_count);

/// Renders: reads, plans, writes and prints, and returns the status of the process.
using RenderOnRanks = std::function<int(nodes::RankLinks&)>;

/// Called on all ranks of `fabric` with the options of one command line. Rank 0 calls render(links), whose end, also by an
/// exception, ends all; the others work, write and print nothing, and return rank 0's status. A rank that stops by `stop` stops
/// the whole run. Throws what render() throws, on rank 0; nodes::LostRank if a rank is lost.
int render_as_rank(nodes::Fabric& fabric, const RenderOptions& options, const RenderOnRanks& render, const std::stop_token& stop);

}  // namespace dmpc::apps
