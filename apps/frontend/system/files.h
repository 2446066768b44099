// What is asked of the file system to keep a file and to read it back, so that tests can have each call fail and the computer
// lose its power.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <span>
#include <string_view>

namespace dmpc::apps {

/// Each call does what POSIX says of the one of its name, and returns -1 and sets errno if it fails. Thread safety: that of the
/// operating system.
class Files {
 public:
  Files() = default;
  Files(const Files&) = delete;
  Files& operator=(const Files&) = delete;
  virtual ~Files() = default;

  /// A descriptor, which a program that is started does not get. What O_CREAT makes, all may read and write whom the mask lets.
  virtual int open(const std::filesystem::path& path, int flags) = 0;
  /// How many bytes there were, up to the room for them: perhaps not all; 0 at the end.
  virtual ssize_t read(int file, std::span<char> room) = 0;
  /// How many bytes were taken: perhaps not all.
  virtual ssize_t write(int file, std::string_view bytes) = 0;
  /// Waits until the file is on the disk; a folder's are its names.
  virtual int sync(int file) = 0;
  virtual int close(int file) = 0;
  virtual int rename(const std::filesystem::path& from, const std::filesystem::path& to) = 0;
  virtual int remove(const std::filesystem::path& path) = 0;
  /// Lets those read and write the file whom the ordinary file at `like`, if there is one, lets. What fails here is no failure:
  /// file systems without modes.
  virtual void take_mode(int /*file*/, const std::filesystem::path& /*like*/) {}
};

/// This computer's file system.
Files& real_files();

}  // namespace dmpc::apps
