// Common scene formats that dmpc does not read, and their converters.
#pragma once

#include <string>

namespace dmpc::apps {

/// Whether the path has such a format's extension, in any case.
bool is_other_format(const std::string& path);

/// "FBX is not read: have Blender make glTF of it, and look at the result:", and a shell command. Requires is_other_format().
std::string how_to_convert(const std::string& path);

}  // namespace dmpc::apps
