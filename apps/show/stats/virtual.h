// The counters of a run in virtual time, for stats.cpp alone; stats.schema.json defines every key.
#pragma once

#include <cstdint>
#include <vector>

#include "apps/run/report.h"
#include "apps/show/stats/strategy.h"

namespace dmpc::apps {

/// Objects whose values replace nulls; empty without virtual time.
struct VirtualStats {
  Json all = Json::object(), host = Json::object();
  std::vector<Json> nodes;  ///< by number
};

VirtualStats virtual_stats(const Account& account, std::uint64_t film_hash);

}  // namespace dmpc::apps
