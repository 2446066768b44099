// Reads a whole file and reports progress.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "apps/foreign/mesh/placed_file.h"
#include "apps/foreign/mesh/scene_files.h"

namespace dmpc::apps {

class ReadingProgress {
 public:
  /// `files` outlives this object. `bytes` is the size of the whole file.
  ReadingProgress(SceneFiles& files, std::size_t bytes) : files_(files), bytes_(bytes) {}

  /// Throws core::CapacityError if the scene has no space for this size. This call is cheap.
  void ask(const GeometrySize& size) const { files_.totals().ask(size); }
  void ask_for_triangles(std::uint64_t count) const { ask(size_of_faces(count, 3 * count)); }
  /// Reports that `position` bytes have been read. This call is cheap.
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

/// Returns the result of read(bytes as text, progress). Throws core::InputError if the file cannot be opened.
template <class Read>
PlacedFile read_whole(const std::string& path, SceneFiles& files, const Read& read) {
  const std::unique_ptr<FileBytes> bytes = files.open(path);
  const std::string_view file = text_of(*bytes);
  ReadingProgress progress(files, file.size());
  return read(file, progress);
}

}  // namespace dmpc::apps
