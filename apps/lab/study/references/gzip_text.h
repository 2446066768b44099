// Reads a text packed by gzip.
#pragma once

#include <istream>
#include <memory>
#include <streambuf>
#include <vector>

namespace dmpc::apps {

/// Reading throws core::InputError, a sentence that continues "PATH: ...", if the data are damaged or truncated. Not thread-safe.
class GzipText final : private std::streambuf, public std::istream {
 public:
  /// `packed` outlives it; it has one or several files in sequence, as gzip writes and joins them (RFC 1952).
  explicit GzipText(std::istream& packed);
  ~GzipText() override;

 private:
  struct Stream;

  std::streambuf::int_type underflow() override;
  /// Reads more packed bytes; returns false at the end.
  bool take_packed();
  /// Returns the number of new bytes of text; 0 at the end.
  std::size_t unpack();

  std::istream& packed_;
  std::unique_ptr<Stream> stream_;
  std::vector<char> input_, text_;
  bool is_between_files_ = true;
};

}  // namespace dmpc::apps
