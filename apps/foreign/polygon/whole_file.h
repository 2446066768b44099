// A file of one mesh, from its opening to its polygons.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "apps/foreign/polygon/indexed_mesh.h"
#include "apps/foreign/polygon/reading_progress.h"

namespace dmpc::apps {

/// What read(bytes as text, progress) makes of the file. Throws core::InputError if it cannot be opened.
template <class Read>
PlacedFile read_whole(const std::string& path, SceneFiles& files, const Read& read) {
  const std::unique_ptr<FileBytes> bytes = files.open(path);
  const std::string_view file = text_of(*bytes);
  ReadingProgress progress(files, file.size());
  return read(file, progress);
}

}  // namespace dmpc::apps
