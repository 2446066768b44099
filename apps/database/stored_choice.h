// A file with a scene's database, chosen in place of the scene.
#pragma once

#include <cstdint>
#include <filesystem>

namespace dmpc::apps {

struct StoredChoice {
  std::filesystem::path path;
  std::uint64_t digest = 0;  ///< the file's when it was chosen
};

}  // namespace dmpc::apps
