// Reads text from a file or a pipe.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <istream>
#include <streambuf>
#include <string>
#include <vector>

#include "apps/frontend/system/descriptor.h"

namespace dmpc::apps {

/// Timeouts of a pipe for opening its other end and for the next byte.
struct PipeTimeout {
  std::chrono::milliseconds writer{1000}, byte{60'000};
};

/// The constructor throws core::InputError, "PATH: ...", if there is no file, or if it is a device or a folder. Reading throws it
/// if a pipe reaches a timeout, or delivers more than the memory for its scene.
class TextInput final : private std::streambuf, public std::istream {
 public:
  explicit TextInput(const std::filesystem::path& path, const PipeTimeout& timeout = {});

  /// Returns the bytes of an ordinary file; nothing for a pipe.
  std::uint64_t file_bytes() const { return file_bytes_; }

 private:
  std::streambuf::int_type underflow() override;
  [[noreturn]] void fail(const std::string& sentence) const;
  /// Uses errno's message.
  [[noreturn]] void fail_with(const std::string& words) const;
  std::size_t read_some();
  /// Returns the bytes read; 0 at the end.
  std::size_t read_pipe();
  void wait_for_byte();

  std::string name_;
  PipeTimeout timeout_;
  Descriptor descriptor_;
  bool is_pipe_ = false;
  std::uint64_t file_bytes_ = 0, bytes_read_ = 0;
  std::vector<char> buffer_;
};

/// Reads a file or a pipe as text. Throws core::InputError, "PATH: ...", if it cannot be read or has more than `bytes_max` bytes,
/// which are all that is stored; `expected` describes the expected file.
std::string bounded_text(const std::filesystem::path& file, std::uint64_t bytes_max, const std::string& expected);

}  // namespace dmpc::apps
