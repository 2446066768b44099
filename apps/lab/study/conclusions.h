// What the table of a study comes to: a sentence or two, computed from its rows; empty if they tell too little.
#pragma once

#include <string>

#include "apps/edge/table/table.h"
#include "apps/lab/study/balance.h"
#include "apps/lab/study/cache.h"
#include "apps/lab/study/speedup.h"
#include "apps/lab/study/systems.h"
#include "apps/lab/study/traffic.h"

namespace dmpc::apps {

std::string conclusion_of(const BalanceStudy& study, const Table& table);
std::string conclusion_of(const TrafficStudy& study, const Table& table);
std::string conclusion_of(const SpeedupStudy& study, const Table& table);
std::string conclusion_of(const CacheStudy& study, const Table& table);
std::string conclusion_of(const SystemsStudy& study, const Table& table);

}  // namespace dmpc::apps
