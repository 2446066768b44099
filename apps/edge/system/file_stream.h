// A stream of text or bytes into a file that Files has opened.
#pragma once

#include <ostream>
#include <streambuf>
#include <vector>

#include "apps/edge/system/files.h"

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
  bool hand_over(std::string_view bytes);

  Files& files_;
  int file_;
  int error_ = 0;
  std::vector<char> kept_;
};

}  // namespace dmpc::apps
