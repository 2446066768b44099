// A file for each frame: a name with a place for the frame's number.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace dmpc::apps {

/// "out.####.png" or "out.%04d.png": the number has as many digits, with zeros in front, or more where it needs more. "%d" and
/// "#" have as many as it needs. A value.
class FrameName {
 public:
  /// Nothing if the file's name has no such place. Throws core::UsageError, naming `option`, if it has two.
  static std::optional<FrameName> in(const std::filesystem::path& path, std::string_view option);

  std::filesystem::path of(std::uint64_t frame) const;
  /// The frame whose file is called so in the folder of all; nothing if none is.
  std::optional<std::uint64_t> frame_of(const std::string& file_name) const;
  std::filesystem::path folder() const { return folder_; }

 private:
  std::string number_text(std::uint64_t frame) const;

  std::filesystem::path folder_;
  std::string before_, after_;
  std::size_t digits_ = 0;
};

}  // namespace dmpc::apps
