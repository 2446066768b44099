// A file that is written whole or not at all: to a temporary name beside it, renamed at the end.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>

#include "apps/interrupt.h"

namespace dmpc::apps {

/// Throws core::InputError unless a file can be made at `path`: its folder exists and is writable, and `path` is no folder.
/// `option` names the option that gave it, for the message.
void check_output_path(const std::filesystem::path& path, std::string_view option);

/// Makes a folder for several files at `path` unless there is one. Throws core::InputError unless files can be made in it.
void make_output_folder(const std::filesystem::path& path, std::string_view option);

/// Whether something is at `path` that is no ordinary file: a pipe, a device, a folder.
bool is_special(const std::filesystem::path& path);

/// Whether writing to `path` would write to what the standard output is, as /dev/stdout does.
bool is_standard_output(const std::filesystem::path& path);

/// Throws core::InputError, naming `what`, unless all that was written to the standard output, `output`, has arrived.
void finish_output(std::ostream& output, std::string_view what);

/// What a file is called before it is whole.
enum class TemporaryName : std::uint8_t {
  of_process,  ///< with this process's number: two may write the same target
  of_target    ///< always the same: of processes that are killed, one after the other, one such file is left at most
};

/// `.dmpc-WHO-NAME` beside `target`: hidden, with the same extension.
std::filesystem::path hidden_name(const std::filesystem::path& target, const std::string& who);
/// What `target`, which is no symbolic link, is called before it is whole.
std::filesystem::path temporary_name(const std::filesystem::path& target, TemporaryName name);

/// The file behind a chain of symbolic links; `path` itself if there is none or if it leads nowhere.
std::filesystem::path file_behind(const std::filesystem::path& path);

/// One output under way. Whatever ends its life before commit() removes the temporary file, an Interrupt's end at once included.
/// Not thread-safe.
class OutputFile {
 public:
  /// Touches nothing yet. A symbolic link is followed, so that the file behind it is replaced.
  explicit OutputFile(const std::filesystem::path& path, TemporaryName name = TemporaryName::of_process);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Where to write: a hidden name in the same folder, with the same extension, as the TemporaryName says. It is the target
  /// itself if that exists and is no ordinary file (/dev/stdout, a pipe): those cannot be renamed over.
  const std::filesystem::path& temporary() const { return temporary_; }

  /// Writes `text` to the temporary file. Throws core::InputError if that fails.
  void write(std::string_view text) const;

  /// Gives the finished file its name. Throws core::InputError if that fails.
  void commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path temporary_;
  bool committed_ = false;
  std::optional<RemovedAtOnce> removed_at_once_;
};

/// Writes `text` to `path`, whole or not at all. Throws core::InputError if that fails.
void write_file(const std::filesystem::path& path, std::string_view text);

/// The same, or without a path to the standard output, `output`; `what` is for the message.
void write_to(const std::optional<std::filesystem::path>& path, std::string_view text, std::ostream& output,
              std::string_view what);

}  // namespace dmpc::apps
