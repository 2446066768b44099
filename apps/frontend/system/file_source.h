// A stream from a file that Files opens, which distinguishes the end of the file from an error.
#pragma once

#include <filesystem>
#include <istream>
#include <streambuf>
#include <vector>

#include "apps/frontend/system/files.h"

namespace dmpc::apps {

/// Not thread-safe. `files` outlives it.
class FileSource final : private std::streambuf, public std::istream {
 public:
  /// The first read fails if there is no such file.
  FileSource(const std::filesystem::path& path, Files& files);
  ~FileSource() override;
  FileSource(const FileSource&) = delete;
  FileSource& operator=(const FileSource&) = delete;

  /// Returns 0, or the errno of the first call that failed: then the data are incomplete.
  int error() const { return error_; }

 private:
  std::streambuf::int_type underflow() override;

  Files& files_;
  int file_ = -1;
  int error_ = 0;
  std::vector<char> kept_;
};

}  // namespace dmpc::apps
