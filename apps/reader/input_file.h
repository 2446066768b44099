// Opens an input file without touching anything but ordinary files.
#pragma once

#include <cstdint>
#include <filesystem>

#include "apps/frontend/system/descriptor.h"

namespace dmpc::apps {

struct InputFile {
  Descriptor descriptor;
  std::filesystem::path resolved;  ///< its location, links resolved
  std::uint64_t bytes = 0;
};

/// Whether there is an ordinary file.
bool is_ordinary_file(const std::filesystem::path& path);

/// Finds the file without opening it for reading: opening a device may have effects, and opening a pipe may wait. Throws
/// core::InputError, the end of a sentence "PATH: ...", if there is none or if it is no ordinary file, and ComputerCapacityError
/// if no further file can be open.
InputFile find_input_file(const std::filesystem::path& path);

/// Opens exactly the file that was found, for reading. Throws core::InputError likewise.
void open_input_file(InputFile& file);

/// Allocated bytes, without holes, of an open file of `bytes` bytes.
std::uint64_t bytes_without_holes(const Descriptor& file, std::uint64_t bytes);

}  // namespace dmpc::apps
