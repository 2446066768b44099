// What a node is dealt.
#pragma once

#include <cstdint>
#include <span>

#include "core/database/extract.h"
#include "core/picture/pixel_task.h"
#include "dataflow/regions/primary_run.h"
#include "dataflow/regions/regions.h"
#include "nodes/byte_source.h"

namespace dmpc::dataflow {

/// What a node is given before the start, read in the constructor of its program and never again.
struct NodeDeal {
  const core::DatabaseHeader& header;  ///< of its part of the database
  nodes::ByteSource records;           ///< which are these
  std::span<const PrimaryRun> primaries;
  const core::RenderSettings& settings;  ///< the whole picture's
  const Regions& regions;
  const core::DatabasePart& outline;                 ///< of the whole database
  std::span<const std::uint32_t> pages = {};         ///< where regions move: the numbers of those that the part consists of
  std::span<const std::uint32_t> runs_of_unit = {};  ///< where regions move: how many of the runs are each unit's, in turn
};

}  // namespace dmpc::dataflow
