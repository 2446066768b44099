// A replacement policy from a shared library, fed in the process that exists for it.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "apps/policy/request.h"

namespace dmpc::apps {

/// Opens the library at `path` and tells `answer` its policy's name, then the faults of each cache. Once in a process. Throws
/// core::InputError: the file may not be opened (apps/edge/system/trusted_path.h), is no library, has no policy or that of
/// another version, or the policy complains, throws, or names a frame that there is not.
void answer_by_library(const std::string& path, const PolicyRequest& request,
                       const std::function<void(const std::string& line)>& answer);

/// In which call of the policy the process is, "victim(page 7) of fault 12, with 3 frames of node 0", or "". For who tells of a
/// crash: takes no memory. Until the next call.
const char* policy_call_under_way();

}  // namespace dmpc::apps
