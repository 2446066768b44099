// What a text packed by gzip says.
#pragma once

#include <istream>
#include <memory>
#include <streambuf>
#include <vector>

namespace dmpc::apps {

/// Reading throws core::InputError, a sentence that goes on "PATH: ...", for what is damaged or cut short. Not thread-safe.
class GzipText final : private std::streambuf, public std::istream {
 public:
  /// `packed` outlives it: one file after the other, as gzip writes and joins them (RFC 1952).
  explicit GzipText(std::istream& packed);
  ~GzipText() override;

 private:
  struct Stream;

  std::streambuf::int_type underflow() override;
  /// Some bytes more of what is packed; false at the end.
  bool take_packed();
  /// The bytes of text that are new; 0 at the end.
  std::size_t unpack();

  std::istream& packed_;
  std::unique_ptr<Stream> stream_;
  std::vector<char> input_, text_;
  bool is_between_files_ = true;
};

}  // namespace dmpc::apps
