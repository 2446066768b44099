// Assimp as a rival: mesh files read as any program has them read.
#pragma once

#include <cstdint>
#include <filesystem>

namespace dmpc::apps {

/// Has Assimp read the file in this process, without any step behind the reading, and forgets it; returns how many faces its
/// meshes have. Throws core::InputError with Assimp's own words.
std::uint64_t read_by_assimp(const std::filesystem::path& path);

}  // namespace dmpc::apps
