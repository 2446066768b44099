// Maps a file's bytes into memory.
#pragma once

#include <cstdint>
#include <memory>

#include "apps/foreign/mesh/scene_files.h"
#include "apps/frontend/system/descriptor.h"

namespace dmpc::apps {

/// Throws std::bad_alloc if there is no address space for them.
std::unique_ptr<FileBytes> map_file(const Descriptor& file, std::uint64_t bytes);

}  // namespace dmpc::apps
