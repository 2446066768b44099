// The file system calls for storing a file and reading it back, as an interface, so that tests can let each call fail and
// simulate a loss of power.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <span>
#include <string_view>

namespace dmpc::apps {

/// Each call behaves as the POSIX function of that name, and returns -1 and sets errno if it fails. Thread safety: that of the
/// operating system.
class Files {
 public:
  Files() = default;
  Files(const Files&) = delete;
  Files& operator=(const Files&) = delete;
  virtual ~Files() = default;

  /// Returns a descriptor that child programs do not inherit. New files (O_CREAT) have all permissions that the mask allows.
  virtual int open(const std::filesystem::path& path, int flags) = 0;
  /// Returns the number of bytes, perhaps fewer than there is space for; 0 at the end.
  virtual ssize_t read(int file, std::span<char> room) = 0;
  /// Returns the number of bytes written, perhaps fewer than all.
  virtual ssize_t write(int file, std::string_view bytes) = 0;
  /// Waits until the file is on the disk; for a folder, until its names are.
  virtual int sync(int file) = 0;
  virtual int close(int file) = 0;
  virtual int rename(const std::filesystem::path& from, const std::filesystem::path& to) = 0;
  virtual int remove(const std::filesystem::path& path) = 0;
  /// Copies the permissions of the ordinary file at `like`, if there is one. Failures are ignored: some file systems have no
  /// modes.
  virtual void take_mode(int /*file*/, const std::filesystem::path& /*like*/) {}
};

Files& real_files();

}  // namespace dmpc::apps
