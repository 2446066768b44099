// Reads a file or a pipe as text of limited size.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace dmpc::apps {

/// Throws core::InputError, "PATH: ...", if the file cannot be read or has more than `bytes_max` bytes, which are all that is
/// stored; `expected` describes the expected file.
std::string bounded_text(const std::filesystem::path& file, std::uint64_t bytes_max, const std::string& expected);

}  // namespace dmpc::apps
