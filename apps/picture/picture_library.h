// What the module dmpc_pictures.so does: writes pictures in every format that OpenImageIO knows.
#pragma once

#include <string>

namespace dmpc::apps {

/// A picture of so many channels of floats or bytes, row by row from the top left, on its way into a file.
struct PictureValues {
  int width = 0, height = 0, channels = 3;
  bool are_floats = false;  ///< linear light, else bytes on the sRGB curve
  const void* values = nullptr;
};

/// The module's interface. Nothing is thrown through it but std::bad_alloc and ComputerRoomError.
struct PictureLibrary {
  /// Whether there is a writer for files whose names end so (".tif").
  bool (*writes)(const std::string& extension);
  /// The file that would be written under this name; if there is none, `error` says why.
  std::string (*file_of)(const std::string& name, const PictureValues& picture, std::string& error);
};

/// Opened at the first call, as open_module() says. Thread-safe.
const PictureLibrary& picture_library();

}  // namespace dmpc::apps
