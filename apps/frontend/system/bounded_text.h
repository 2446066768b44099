// A file, or a pipe, as one text that has an end.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace dmpc::apps {

/// All of it. Throws core::InputError, "PATH: ...", if it cannot be read, or has more than `bytes_max`, of which not a byte more
/// is kept; `expected` says what it should have been.
std::string bounded_text(const std::filesystem::path& file, std::uint64_t bytes_max, const std::string& expected);

}  // namespace dmpc::apps
