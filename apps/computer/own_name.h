// A name that a program gives, where it stands beside ours.
#pragma once

#include <string>

namespace dmpc::apps {

/// In quotes, so that it is no other column's.
inline std::string own_name(const std::string& name) { return "'" + name + "'"; }

}  // namespace dmpc::apps
