// Answers a mesh file's reader, and receives the scene.
#pragma once

#include <string>

#include "apps/formats/mesh_file.h"

namespace dmpc::apps {

/// Throws core::InputError, with "PATH: ..." or the end of such a sentence.
MeshFile read_in_session(const std::string& path, const MeshOptions& options, bool shows_progress, const ReaderLimits& limits);

}  // namespace dmpc::apps
