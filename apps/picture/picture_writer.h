// Pictures as files of all the formats that OpenImageIO writes, by a process of their own: its 250 libraries are none of dmpc's.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "apps/reader/process.h"

namespace dmpc::apps {

/// A picture of three channels, floats or bytes, row by row from the top left, on its way into a file.
struct PictureValues {
  int width = 0, height = 0;
  bool are_floats = false;  ///< linear light, else bytes on the sRGB curve
  std::span<const std::byte> values;
};

/// Its process, dmpc_picture_writer, starts at the first call and waits until the end, so that a picture that is done has a
/// writer: where it has died another is started. Both throw core::InternalError or
/// InstallationError where there is none, and core::RoomError where this computer has no room for it. Not
/// thread-safe.
class PictureWriter {
 public:
  PictureWriter();

  /// Whether there is a writer for files whose names end so (".tif").
  bool writes(const std::string& extension);
  /// The file that would be written under this name. Throws core::InputError, a sentence that goes on "PATH: ...", if there is
  /// none.
  std::string file_of(const std::string& name, const PictureValues& picture);

 private:
  template <class Ask>
  auto ask(const Ask& ask_process);

  ReadingBudget budget_;
  std::optional<ReaderProcess> process_;
};

/// The one of this process.
PictureWriter& picture_writer();

}  // namespace dmpc::apps
