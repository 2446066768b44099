// All results of `dmpc info`.
#pragma once

#include <cstdint>
#include <optional>

#include "apps/frontend/system/available_memory.h"
#include "apps/info/database_figures.h"
#include "apps/info/forecast.h"
#include "apps/info/scene_figures.h"
#include "apps/run/systems.h"
#include "core/picture/film/rounding_loss.h"

namespace dmpc::apps {

struct InfoRecord {
  SceneFigures scene;
  DatabaseFigures database;
  core::RoundingLoss loss;
  Forecast forecast;
  std::optional<System> system;                ///< as requested
  std::uint64_t build_peak_bytes = 0;          ///< peak memory of this process until the database was built
  AvailableMemory room;                        ///< memory available here for a render
  int width = 1, height = 1;                   ///< picture size in pixels
  double load_seconds = 0, build_seconds = 0;  ///< by the wall clock
};

}  // namespace dmpc::apps
