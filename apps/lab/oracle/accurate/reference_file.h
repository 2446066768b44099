// References in files: KEY.exr has the picture, KEY.json what belongs to it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "apps/edge/system/files.h"
#include "apps/lab/oracle/accurate/reference.h"

namespace dmpc::apps {

/// The reference that was kept under `key`. Nothing if there is none, if a file is damaged, or if picture and figures do not
/// belong together: the figures have a hash of the picture.
std::optional<Reference> load_reference(const std::filesystem::path& folder, const std::string& key);

/// Makes the folder with those above it unless there is one. Throws core::InputError unless files can be made in it.
void make_reference_folder(const std::filesystem::path& folder);

/// Each file whole or not at all. Throws core::InputError if that fails.
void save_reference(const std::filesystem::path& folder, const std::string& key, const Reference& reference,
                    Files& files = real_files());

}  // namespace dmpc::apps
