// Files that a scene refers to, found as other programs find them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dmpc::apps {

/// The regular files that may be meant by `name` in a scene's file that lies in `folder`, the likeliest first: the file of this
/// name, the same with "%20" for a blank, in other letters' case, with a Windows path's backslashes and drive, then its last part
/// alone in `folder` and in a folder "textures" there. Only folders in or below `folder` are looked through; what a name says
/// outright may lie anywhere.
std::vector<std::filesystem::path> files_meant(const std::filesystem::path& folder, const std::string& name);

/// Whether `path` is another file than the one that `name` says outright, with whatever strokes between its parts, in glTF's
/// spelling or plainly.
bool is_under_other_name(const std::filesystem::path& folder, const std::string& name, const std::filesystem::path& path);

/// "%20" as a blank: glTF names files by addresses.
std::string decoded_address(const std::string& text);

}  // namespace dmpc::apps
