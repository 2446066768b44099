// Writes a file atomically: under a temporary name in the same folder, and renamed at the end.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <ostream>
#include <streambuf>
#include <string>
#include <string_view>
#include <vector>

#include "apps/frontend/system/files.h"
#include "apps/frontend/system/interrupt.h"

namespace dmpc::apps {

/// Not thread-safe. `files` outlives it; the caller keeps the descriptor.
class FileStream final : private std::streambuf, public std::ostream {
 public:
  FileStream(Files& files, int file);

  /// Flushes. Returns 0, or the errno of the first call that failed.
  int finish();

 private:
  int overflow(int character) override;
  std::streamsize xsputn(const char* text, std::streamsize count) override;
  int sync() override;
  /// Returns whether the file has taken everything so far.
  bool migration(std::string_view bytes);

  Files& files_;
  int file_;
  int error_ = 0;
  std::vector<char> kept_;
};

/// Throws core::InputError unless a file can be made at `path`, as far as can be known in advance: its folder exists, a file with
/// contents can be made there (it is removed again), and `path` is no folder. A device is tested for accepting data. `option`
/// names the option that gave the path, for the message.
void check_output_path(const std::filesystem::path& path, std::string_view option);

/// Makes a folder for several files at `path` unless it exists. Throws core::InputError unless files can be made in it.
void make_output_folder(const std::filesystem::path& path, std::string_view option);

/// Whether `path` is not an ordinary file: a pipe, a device, a folder.
bool is_special(const std::filesystem::path& path);

/// Whether `path` is the standard output, as /dev/stdout is.
bool is_standard_output(const std::filesystem::path& path);

/// Throws core::InputError, naming `what`, unless all data for the standard output, `output`, have been written.
void finish_output(std::ostream& output, std::string_view what);

/// Choice of the temporary name.
enum class TemporaryName : std::uint8_t {
  random,    ///< processes on any number of computers may write the same target
  of_target  ///< always the same, for a target that one process at a time writes: killed processes leave at most one file
};

/// Whether a committed file survives a loss of power.
enum class Durability : std::uint8_t { on_disk, until_power_loss };

/// Returns `.dmpc-WHO-NAME` beside `target`, a hidden file.
std::filesystem::path hidden_name(const std::filesystem::path& target, const std::string& who);
/// Returns the temporary name of `target`, which is no symbolic link, for TemporaryName::of_target.
std::filesystem::path next_name(const std::filesystem::path& target);

/// Returns the file behind a chain of symbolic links, even if it does not exist yet; `path` itself if it is no link. Throws
/// core::InputError if the links form a cycle, or if the system does not let us follow them, as links of other users in a folder
/// where all may write.
std::filesystem::path file_behind(const std::filesystem::path& path);

/// One output in progress. If it is destroyed before commit(), the temporary file is removed, also by an Interrupt's immediate
/// end. Not thread-safe.
class OutputFile {
 public:
  struct Settings {
    TemporaryName name = TemporaryName::random;
    Durability durability = Durability::on_disk;
    std::string option = {};  ///< option that gave the target, for messages
  };

  /// Makes a new file with a hidden name in the target's folder: it never opens an existing file or a link. A target that is no
  /// ordinary file (/dev/stdout, a pipe) cannot be replaced by renaming and is written directly. A symbolic link is followed, so
  /// that the file behind it is replaced. The new file keeps the mode of the one that it replaces. Throws core::InputError on
  /// failure. `files` outlives it.
  explicit OutputFile(const std::filesystem::path& path);
  OutputFile(const std::filesystem::path& path, const Settings& settings, Files& files = real_files());
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Data written here go to the file; commit() reports errors.
  std::ostream& stream() { return *stream_; }
  /// Writes `text`. Throws core::InputError on failure.
  void write(std::string_view text);

  /// Gives the finished file its name once it is on the disk, and waits until the name is on the disk, too. Throws
  /// core::InputError on failure.
  void commit();

 private:
  bool is_temporary() const { return temporary_ != target_; }
  void open();
  void make(const std::filesystem::path& temporary);
  int close();
  void drop();
  void sync_folder() const;
  [[noreturn]] void fail(const std::string& what, int error) const;

  Settings settings_;
  Files& files_;
  std::filesystem::path target_;
  std::filesystem::path temporary_;
  int file_ = -1;
  bool is_renamed_ = false;
  std::optional<FileStream> stream_;
  std::optional<RemovedAtOnce> removed_at_once_;
};

/// Writes `text` to `path` atomically. Throws core::InputError on failure.
void write_file(const std::filesystem::path& path, std::string_view text, Durability durability = Durability::on_disk,
                Files& files = real_files());

}  // namespace dmpc::apps
