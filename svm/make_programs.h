// The node programs of a plan.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "core/picture/pixel_task.h"
#include "nodes/byte_source.h"
#include "nodes/node.h"
#include "nodes/watch/watching.h"
#include "svm/pages/node_program.h"
#include "svm/pages/watch/reference_log.h"
#include "svm/plan.h"

namespace dmpc::svm {

/// Makes the program of node `index`; called before the start, in order, on the calling thread.
using MakeProgram = std::function<std::unique_ptr<NodeProgram>(std::uint32_t index, nodes::Node& node)>;

/// With our own grid. `reference_logs`, one a node, are there where references are to be noted. All arguments outlive the result,
/// and what it is called with; `database` and the plan's resident pages need not once all programs are made, but on modelled
/// machines.
MakeProgram maker_of(const Plan& plan, const core::RenderSettings& settings, const nodes::ByteSource& database,
                     const nodes::Watching& watching, std::vector<ReferenceLog>* reference_logs = nullptr);

}  // namespace dmpc::svm
