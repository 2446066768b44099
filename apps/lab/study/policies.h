// The option of studies that load replacement policies.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/edge/line/command_line.h"
#include "apps/policy/foreign_policy.h"

namespace dmpc::apps {

/// Declares --policy, several times: where policies are, as ForeignPolicy takes it.
void add_policies(OptionSet set, std::vector<std::string>& places);

/// In their order, each with a name of its own. `check` is called meanwhile and may throw. Throws core::InputError as
/// ForeignPolicy does.
std::vector<ForeignPolicy> load_policies(const std::vector<std::string>& places, const std::function<void()>& check);

}  // namespace dmpc::apps
