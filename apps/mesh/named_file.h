// The file that is meant by a name in another one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dmpc::apps {

/// What there is of it: `name` in `folder` as it stands, with "%20" decoded, or, where neither exists, its last part in the
/// folder. The first is meant.
std::vector<std::filesystem::path> files_meant(const std::filesystem::path& folder, const std::string& name);

}  // namespace dmpc::apps
