// What the table of a study comes to: a sentence or two, computed from its rows; empty if they tell too little.
#pragma once

#include <string>

#include "apps/study_balance.h"
#include "apps/study_cache.h"
#include "apps/study_speedup.h"
#include "apps/study_table.h"
#include "apps/study_traffic.h"

namespace dmpc::apps {

std::string conclusion_of(const BalanceStudy& study, const Table& table);
std::string conclusion_of(const TrafficStudy& study, const Table& table);
std::string conclusion_of(const SpeedupStudy& study, const Table& table);
std::string conclusion_of(const CacheStudy& study, const Table& table);

}  // namespace dmpc::apps
