// A file that is read, opened without touching anything that is no ordinary file.
#pragma once

#include <cstdint>
#include <filesystem>

#include "apps/frontend/system/descriptor.h"

namespace dmpc::apps {

struct InputFile {
  Descriptor descriptor;
  std::filesystem::path resolved;  ///< where it lies, links resolved
  std::uint64_t bytes = 0;
};

/// Whether there is an ordinary file.
bool is_ordinary_file(const std::filesystem::path& path);

/// Finds the file without opening it for reading: opening a device may do things, and opening a pipe may wait. Throws
/// core::InputError, a sentence that goes on "PATH: ...", if there is none or if it is no ordinary file, and
/// ComputerCapacityError if no further file can be open.
InputFile find_input_file(const std::filesystem::path& path);

/// Opens what was found, and nothing else, for reading. Throws core::InputError likewise.
void open_input_file(InputFile& file);

/// Allocated bytes, without holes, of an open file of `bytes` bytes.
std::uint64_t bytes_without_holes(const Descriptor& file, std::uint64_t bytes);

}  // namespace dmpc::apps
