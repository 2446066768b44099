// A file that is written whole or not at all: to a temporary name beside it, renamed at the end.
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

/// Not thread-safe. `files` outlives it; the descriptor stays its maker's.
class FileStream final : private std::streambuf, public std::ostream {
 public:
  FileStream(Files& files, int file);

  /// Hands over what is still kept here. Returns 0, or errno's value of the first call that failed.
  int finish();

 private:
  int overflow(int character) override;
  std::streamsize xsputn(const char* text, std::streamsize count) override;
  int sync() override;
  /// Whether the file has taken everything so far.
  bool migration(std::string_view bytes);

  Files& files_;
  int file_;
  int error_ = 0;
  std::vector<char> kept_;
};

/// Throws core::InputError unless a file can be made at `path`, as far as can be known beforehand: its folder exists, a file with
/// something in it can be made there (it is removed again), and `path` is no folder. A device is asked whether it takes anything.
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
  random,    ///< any number of processes on any number of computers may write the same target
  of_target  ///< always the same, for a target that one process at a time has: of those that are killed one file is left at most
};

/// Whether a file that was committed is there after a loss of power.
enum class Durability : std::uint8_t { on_disk, until_power_loss };

/// What gives way to a file that is committed.
enum class Replaces : std::uint8_t {
  what_it_names,  ///< the file behind symbolic links; a device or a pipe is written to
  name            ///< whatever has the name, a link or a pipe itself: for folders that others may write
};

/// `.dmpc-WHO-NAME` beside `target`: hidden.
std::filesystem::path hidden_name(const std::filesystem::path& target, const std::string& who);
/// What `target`, which is no symbolic link, is called before it is whole, as TemporaryName::of_target says.
std::filesystem::path next_name(const std::filesystem::path& target);

/// The file behind a chain of symbolic links, also if it is not there yet; `path` itself if there is none. Throws
/// core::InputError if they lead round in a circle, or if the system does not let us follow them: links of others in a folder
/// where all may write.
std::filesystem::path file_behind(const std::filesystem::path& path);

/// One output under way. Whatever ends its life before commit() removes the temporary file, an Interrupt's end at once included.
/// Not thread-safe.
class OutputFile {
 public:
  struct Settings {
    TemporaryName name = TemporaryName::random;
    Durability durability = Durability::on_disk;
    Replaces replaces = Replaces::what_it_names;
    std::string option = {};  ///< that gave the target, for messages
  };

  /// Makes a new file with a hidden name in the target's folder: no file that is there, and no link, is ever opened. If the
  /// target exists and is no ordinary file (/dev/stdout, a pipe), which cannot be renamed over, it is written itself. A symbolic
  /// link is followed, so that the file behind it is replaced. A file that is replaced keeps its mode. `settings.replaces` may
  /// ask that the name itself gets the file. Throws core::InputError if that fails. `files` outlives it.
  explicit OutputFile(const std::filesystem::path& path);
  OutputFile(const std::filesystem::path& path, const Settings& settings, Files& files = real_files());
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// What is written goes to the file; whether it arrived is known after commit().
  std::ostream& stream() { return *stream_; }
  /// Writes `text`. Throws core::InputError if that fails.
  void write(std::string_view text);

  /// Gives the finished file its name, when it is on the disk, and waits until the name is, too. Throws core::InputError if that
  /// fails.
  void commit();

 private:
  bool is_temporary() const { return temporary_ != target_; }
  void open();
  void make(const std::filesystem::path& temporary);
  int close();
  /// Leaves no file that was not finished.
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

/// Writes `text` to `path`, whole or not at all. Throws core::InputError if that fails.
void write_file(const std::filesystem::path& path, std::string_view text, Durability durability = Durability::on_disk,
                Files& files = real_files());

/// Writes a text to the path, or without one to the standard output, `output`; `what` is for the message.
void write_to(const std::optional<std::filesystem::path>& path, std::string_view text, std::ostream& output,
              std::string_view what);

}  // namespace dmpc::apps
