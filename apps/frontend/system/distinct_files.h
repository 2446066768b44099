// No output may fall on another one or on an input.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/frontend/system/opened_files.h"

namespace dmpc::apps {

/// A file of the command line.
struct NamedFile {
  std::string name;  ///< how the command line calls it: "SCENE", "-o", "--stats"
  std::filesystem::path path;
};

/// Throws core::UsageError if an output is the same file as an input or as another output, by whatever path: links and folders
/// are followed. Pipes and devices clash with nothing, and inputs may be equal.
void check_distinct(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs);

/// Throws core::UsageError if an output is one of the files that the scene was read from, which are known once it was.
void check_not_read(const OpenedFiles& inputs, const std::vector<NamedFile>& outputs);

}  // namespace dmpc::apps
