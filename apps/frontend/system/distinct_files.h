// Checks that outputs do not overwrite each other or an input.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/frontend/system/opened_files.h"

namespace dmpc::apps {

/// A file of the command line.
struct NamedFile {
  std::string name;  ///< its name on the command line: "SCENE", "-o", "--stats"
  std::filesystem::path path;
};

/// Throws core::UsageError if an output is the same file as an input or another output. Links and folders are followed. Pipes and
/// devices never clash, and inputs may be equal.
void check_distinct(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs);

/// Throws core::UsageError if an output is a file that the scene was read from; those files are known only after reading.
void check_not_read(const OpenedFiles& inputs, const std::vector<NamedFile>& outputs);

}  // namespace dmpc::apps
