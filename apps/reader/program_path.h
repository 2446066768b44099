// Where the programs lie that read foreign files for dmpc.
#pragma once

#include <filesystem>
#include <string>

namespace dmpc::apps {

/// Beside the running program (in the folder where it was built), in ../libexec/dmpc (where it is installed), or in ../apps (for
/// the tests). Throws core::InternalError, with the places, if it is in none of them.
std::filesystem::path reader_program(const std::string& name);

}  // namespace dmpc::apps
