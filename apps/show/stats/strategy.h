// A strategy's part of the counters, for stats.cpp alone; stats.schema.json defines every key.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "apps/run/render_options.h"
#include "core/trace/operations.h"
#include "dataflow/run.h"
#include "svm/run.h"

namespace dmpc::apps {

using Json = nlohmann::ordered_json;

/// Objects whose values replace nulls in the part that all strategies share.
struct StrategyStats {
  Json all, chaos, host;
  std::vector<Json> nodes;               ///< by number
  std::uint64_t packets_overflowed = 0;  ///< sent to the host for want of credits
};

StrategyStats strategy_stats(const RenderOptions& options, const svm::Report& report);
StrategyStats strategy_stats(const RenderOptions& options, const dataflow::Report& report);

/// Returns rays by kind and in total.
Json rays_json(const std::array<std::uint64_t, core::ray_kind_count>& rays);

}  // namespace dmpc::apps
