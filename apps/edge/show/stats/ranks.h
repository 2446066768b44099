// What is known of each rank, as --stats writes it.
#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "nodes/ranks/rank_figures.h"

namespace dmpc::apps {

/// Null where nodes are in one process. `is_observed`: the ranks' clocks were compared.
nlohmann::ordered_json ranks_json(std::span<const nodes::RankFigures> ranks, bool is_observed);

}  // namespace dmpc::apps
