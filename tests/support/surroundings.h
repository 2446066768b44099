// What a node of dataflow knows of all of space, from a test's parts.
#pragma once

#include "core/database/proxy.h"
#include "dataflow/rays/next_stop.h"

namespace dmpc::tests {

/// All outlive it.
inline dataflow::Surroundings surroundings(const dataflow::Regions& regions, const core::DatabasePart& proxy) {
  return {regions, proxy.header, core::LocalRecords(proxy.bytes), {}};
}

/// The next stop in a database of which only the regions that hold nothing are known.
inline dataflow::NextStop next_stop_without_proxy(const core::Ray& ray, const core::Passage& passage,
                                                  const core::GridFrame& frame, const dataflow::Regions& regions,
                                                  core::Operations& operations) {
  const core::DatabaseHeader header{.frame = frame, .region = {.high = core::grid_size(frame)}};
  return dataflow::next_stop(ray, passage, {regions, header, core::LocalRecords({}), {}}, std::nullopt, operations);
}

}  // namespace dmpc::tests
