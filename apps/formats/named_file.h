// Finds files that a scene refers to, as other programs do.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dmpc::apps {

/// The regular files that `name` in a scene's file in `folder` may mean, the likeliest first: the exact name, with "%20" for a
/// blank, in other case, with a Windows path's backslashes and drive, then its last part alone in `folder` and in its folder
/// "textures". Only folders in or below `folder` are searched; an exact name may be anywhere.
std::vector<std::filesystem::path> files_meant(const std::filesystem::path& folder, const std::string& name);

/// Whether `path` is another file than the exact one of `name`, with either kind of slash, URL-encoded as in glTF or not.
bool is_under_other_name(const std::filesystem::path& folder, const std::string& name, const std::filesystem::path& path);

/// Decodes "%20" to a blank: glTF refers to files by URLs.
std::string decoded_address(const std::string& text);

}  // namespace dmpc::apps
