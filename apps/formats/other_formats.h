// Formats of scenes that people have and dmpc does not read, and what converts them.
#pragma once

#include <string>

namespace dmpc::apps {

/// Whether the path ends as such files do, whatever the case of its letters.
bool is_other_format(const std::string& path);

/// "FBX is not read: have Blender make glTF of it, and look at the result:", and a line that a shell takes. Of paths of other
/// formats alone.
std::string how_to_convert(const std::string& path);

}  // namespace dmpc::apps
