// How a run ends that nobody can go on with: nothing is under way, no program has work, and some are not finished.
#pragma once

#include "core/base/expect.h"

namespace dmpc::nodes {

/// Has what each node says of itself; of several ranks all have it. After it a runner's programs can be looked at, and what they
/// say be gathered.
struct StandstillError : core::InternalError {
  using InternalError::InternalError;
};

}  // namespace dmpc::nodes
