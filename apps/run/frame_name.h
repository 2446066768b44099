// File names of frames: a name with a field for the frame's number.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace dmpc::apps {

/// "out.####.png" or "out.%04d.png": the field gives the minimum number of digits, zero-padded. "%d" and "#" do not pad.
class FrameName {
 public:
  /// Returns nothing if the file name has no such field. Throws core::UsageError, naming `option`, if it has two.
  static std::optional<FrameName> in(const std::filesystem::path& path, std::string_view option);

  std::filesystem::path of(std::uint64_t frame) const;
  /// Returns the number of the frame with this file name in the frames' folder, or nothing.
  std::optional<std::uint64_t> frame_of(const std::string& file_name) const;
  std::filesystem::path folder() const { return folder_; }

 private:
  std::string number_text(std::uint64_t frame) const;

  std::filesystem::path folder_;
  std::string before_, after_;
  std::size_t digits_ = 0;
};

}  // namespace dmpc::apps
