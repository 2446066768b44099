// How a run went for a rank that renders what rank 0 has handed out.
#pragma once

#include <cstdint>

#include "nodes/runner.h"

namespace dmpc::nodes {

struct Followed {
  RunEnd end = RunEnd::finished;
  std::uint64_t bytes_received = 0;  ///< all that it was told before the run: a job, and what its nodes keep during the run
};

}  // namespace dmpc::nodes
