// A task of dataflow over a region's part of a small scene.
#pragma once

#include <cstdint>

#include "core/database/extract.h"
#include "dataflow/rays/ray_task.h"
#include "dataflow/regions/balance.h"
#include "dataflow/units/unit_pages.h"
#include "tests/support/small_scenes.h"
#include "tests/support/subject.h"

namespace dmpc::tests {

inline constexpr nodes::NodeId self{4}, other{9};
/// An address that is in no part of the scene.
inline constexpr core::Address elsewhere{0x7ffffff0};

inline const Subject& part_subject() {
  static const Subject subject(mirrors_and_glass(), {16, 16});
  return subject;
}

inline core::Region whole() { return {.high = core::grid_size(part_subject().settings().header.frame)}; }
/// The regions of two nodes.
inline core::Region half(std::uint32_t index) {
  return dataflow::equal_size_bsp(whole().high, dataflow::axes_facing(part_subject().settings().camera), 2).region_at(index);
}

/// For children of hits that do not glow.
inline constexpr auto no_shine = [](const core::Ray&, const core::Color&) {};

/// In a memory that has room for the task and no more.
template <class Task>
struct PartBench {
  explicit PartBench(const core::Region& region, std::uint32_t depth_max = 5)
      : part(core::extract(part_subject().database(), region)),
        records(part.bytes, nullptr),
        tracer(records, part.header, {}),
        settings{part.header, part_subject().settings().camera, part_subject().settings().shade},
        memory(Task::layout(depth_max)),
        task(memory, self, depth_max) {}

  core::DatabasePart part;
  dataflow::PartRecords records;
  dataflow::PartTracer tracer;
  core::RenderSettings settings;
  nodes::LocalMemory memory;
  Task task;
  core::Operations operations;
};

}  // namespace dmpc::tests
