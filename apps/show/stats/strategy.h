// What one strategy adds to the counters: for stats.cpp alone; stats.schema.json says what every key means.
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

/// Objects whose values take the places of nulls in what all strategies have in common.
struct StrategyStats {
  Json all, chaos, host;
  std::vector<Json> nodes;               ///< by number
  std::uint64_t packets_overflowed = 0;  ///< to the host for want of credits
};

StrategyStats strategy_stats(const RenderOptions& options, const svm::Report& report);
StrategyStats strategy_stats(const RenderOptions& options, const dataflow::Report& report);

/// Rays by kind and in total.
Json rays_json(const std::array<std::uint64_t, core::ray_kind_count>& rays);

}  // namespace dmpc::apps
