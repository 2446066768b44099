// A folder's files as one ZIP archive with their hashes.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace dmpc::apps {

/// Returns the files, each a name and its bytes, as a ZIP archive (PKWARE, APPNOTE 6.3), compressed. They have no date, so equal
/// files give equal archives. Throws core::InputError if an archive cannot hold them: 4 GiB, 65,535 files.
std::string zip_of(const std::vector<std::pair<std::string, std::string>>& files);

/// Returns the SHA-256 hashes of files in `folder`, as `sha256sum --check` reads them. Throws core::InputError if the program
/// sha256sum fails or is missing.
std::string hashes_of(const std::filesystem::path& folder, const std::vector<std::string>& names);

}  // namespace dmpc::apps
