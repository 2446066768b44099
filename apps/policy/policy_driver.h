// apps/python/dmpc/policies.py, as a text, which python3 is started with.
#pragma once

namespace dmpc::apps {

/// Made when dmpc is built.
extern const char* const policy_driver;

}  // namespace dmpc::apps
