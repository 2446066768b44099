// A file that is written whole or not at all: to a temporary name beside it, renamed at the end.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace dmpc::apps {

/// Throws core::InputError unless a file can be made at `path`: its folder exists and is writable, and `path` is no folder.
/// `option` names the option that gave it, for the message.
void check_output_path(const std::filesystem::path& path, std::string_view option);

/// One output under way. Whatever ends its life before commit() removes the temporary file. Not thread-safe.
class OutputFile {
 public:
  /// Touches nothing yet. A symbolic link is followed, so that the file behind it is replaced.
  explicit OutputFile(const std::filesystem::path& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Where to write: a hidden name in the same folder, with the same extension and this process's number in it. It is the target
  /// itself if that exists and is no ordinary file (/dev/stdout, a pipe): those cannot be renamed over.
  const std::filesystem::path& temporary() const { return temporary_; }

  /// Gives the finished file its name. Throws core::InputError if that fails.
  void commit();

  /// Writes `text` to the temporary file and commits. Throws core::InputError if that fails.
  void write(std::string_view text);

 private:
  std::filesystem::path target_;
  std::filesystem::path temporary_;
  bool committed_ = false;
};

}  // namespace dmpc::apps
