// Reads a file or a pipe as text of limited size.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace dmpc::apps {

/// Throws core::InputError, "PATH: ...", if it cannot be read, or has more than `bytes_max`, of which no further byte is stored;
/// `expected` describes the expected file.
std::string bounded_text(const std::filesystem::path& file, std::uint64_t bytes_max, const std::string& expected);

}  // namespace dmpc::apps
