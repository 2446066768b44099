// How far a file is read, told now and then.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "apps/foreign/mesh/geometry.h"
#include "apps/foreign/mesh/scene_files.h"

namespace dmpc::apps {

class ReadingProgress {
 public:
  /// `files` outlives it. `bytes`: of the whole file.
  ReadingProgress(SceneFiles& files, std::size_t bytes) : files_(files), bytes_(bytes) {}

  /// Throws as check_size() where the file has so many triangles. Cheap.
  void check_triangles(std::uint64_t count) const { check_size(size_of_triangles(count), files_.memory_bytes_max()); }
  /// So many bytes are read. Cheap.
  void show(std::size_t position) {
    if (position >= next_) {
      files_.show_progress(static_cast<float>(position) / static_cast<float>(std::max<std::size_t>(bytes_, 1)));
      next_ = position + bytes_ / 100 + 1;
    }
  }

 private:
  SceneFiles& files_;
  std::size_t bytes_, next_ = 0;
};

}  // namespace dmpc::apps
